/* surface_editor.c - SurfaceEditor: a mw_surface_editor as an object. It keeps alive what is
 * attached to it. meshwalk.SurfaceEditor calls it under the lock of its surface. */
#include "core.h"

typedef struct surface_editor_object {
    PyObject_HEAD
    core_state *state;
    PyObject *surface, *followers; /* a list of probers and stars */
    mw_surface_editor *editor;
} surface_editor_object;

static mw_surface_editor *surface_editor_of(PyObject *self)
{
    return ((surface_editor_object *)self)->editor;
}

/* surface_editor_from_surface(cls, surface, undo) */
static PyObject *surface_editor_from_surface(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *class, *surface;
    uint64_t undo;
    surface_editor_object *object;
    mw_surface_editor_options options = {0};
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO!O&", &class, state->surface_type, &surface, option_uint64,
                          &undo))
        return NULL;
    object = objects_new(class, state->surface_editor_type);
    if (!object) return NULL;
    object->state = state;
    options.undo = (size_t)undo;
    object->followers = PyList_New(0);
    if (!object->followers) {
        Py_DECREF(object);
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS
    status = mw_surface_editor_create(((surface_object *)surface)->surface, &options,
                                      &object->editor, &error);
    Py_END_ALLOW_THREADS
    if (status) {
        Py_DECREF(object);
        return errors_raise(state, &error);
    }
    object->surface = Py_NewRef(surface);
    return (PyObject *)object;
}

static void surface_editor_dealloc(PyObject *self)
{
    surface_editor_object *object = (surface_editor_object *)self;
    PyObject_GC_UnTrack(self);
    mw_surface_editor_destroy(object->editor);
    Py_XDECREF(object->followers);
    Py_XDECREF(object->surface);
    objects_free(self);
}

static int surface_editor_traverse(PyObject *self, visitproc visit, void *arg)
{
    Py_VISIT(((surface_editor_object *)self)->surface);
    Py_VISIT(((surface_editor_object *)self)->followers);
    Py_VISIT(Py_TYPE(self));
    return 0;
}

/* --- what follows --- */

/* _attach(prober or star) */
static PyObject *surface_editor_attach(PyObject *self, PyObject *follower)
{
    surface_editor_object *object = (surface_editor_object *)self;
    mw_error error;
    mw_status status;
    int star = PyObject_TypeCheck(follower, object->state->star_type);
    if (!star && !PyObject_TypeCheck(follower, object->state->prober_type)) {
        PyErr_SetString(PyExc_TypeError, "a meshwalk.Prober or a meshwalk.Star is wanted");
        return NULL;
    }
    if (PyList_Append(object->followers, follower)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    status = star ? mw_surface_editor_attach_star(object->editor, ((star_object *)follower)->star,
                                                  &error)
                  : mw_surface_editor_attach_prober(object->editor,
                                                    ((prober_object *)follower)->prober, &error);
    Py_END_ALLOW_THREADS
    if (!status) Py_RETURN_NONE;
    const Py_ssize_t last = PyList_Size(object->followers) - 1;
    PyList_SetSlice(object->followers, last, last + 1, NULL);
    return errors_raise(object->state, &error);
}

/* _detach(prober or star) */
static PyObject *surface_editor_detach(PyObject *self, PyObject *follower)
{
    surface_editor_object *object = (surface_editor_object *)self;
    for (Py_ssize_t i = PyList_Size(object->followers); i-- > 0;) {
        if (PyList_GetItem(object->followers, i) != follower) continue;
        if (PyObject_TypeCheck(follower, object->state->star_type))
            mw_surface_editor_detach_star(object->editor, ((star_object *)follower)->star);
        else
            mw_surface_editor_detach_prober(object->editor, ((prober_object *)follower)->prober);
        if (PyList_SetSlice(object->followers, i, i + 1, NULL)) return NULL;
    }
    Py_RETURN_NONE;
}

/* --- edits --- */

/* (made, reused, freed, vertices_made, vertices_freed, vertices_moved, triangles, vertices) */
static PyObject *surface_editor_change(const mw_surface_change *c)
{
    const size_t triangles = c->made + c->reused + c->freed,
                 vertices = c->vertices_made + c->vertices_freed + c->vertices_moved;
    return Py_BuildValue("nnnnnny#y#", (Py_ssize_t)c->made, (Py_ssize_t)c->reused,
                         (Py_ssize_t)c->freed, (Py_ssize_t)c->vertices_made,
                         (Py_ssize_t)c->vertices_freed, (Py_ssize_t)c->vertices_moved,
                         (const char *)c->triangle, (Py_ssize_t)(triangles * sizeof *c->triangle),
                         (const char *)c->vertex, (Py_ssize_t)(vertices * sizeof *c->vertex));
}

/* Paths of an edit: buffers of uint32, or None. */
typedef struct surface_editor_paths {
    Py_buffer path, other;
} surface_editor_paths;

static void surface_editor_release_paths(surface_editor_paths *paths)
{
    if (paths->path.obj) PyBuffer_Release(&paths->path);
    if (paths->other.obj) PyBuffer_Release(&paths->other);
}

static int surface_editor_get_paths(PyObject *path, PyObject *other, mw_surface_edit *edit,
                                    surface_editor_paths *paths)
{
    *paths = (surface_editor_paths){0};
    if (path != Py_None && buffer_get_all(path, sizeof(uint32_t), &paths->path, &edit->path_count))
        return -1;
    if (other != Py_None &&
        buffer_get_packed(other, sizeof(uint32_t), edit->path_count, &paths->other)) {
        surface_editor_release_paths(paths);
        return -1;
    }
    edit->path = paths->path.buf;
    edit->other = paths->other.buf;
    return 0;
}

/* _apply(kind, triangle, vertex 0, 1, 2, x, y, z, path or None, other or None): what its kind does
 * not name is not read */
static PyObject *surface_editor_apply(PyObject *self, PyObject *args)
{
    surface_editor_object *object = (surface_editor_object *)self;
    PyObject *path, *other;
    int kind;
    mw_surface_edit edit = {0};
    mw_surface_change change = {0};
    surface_editor_paths paths;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "iO&O&O&O&dddOO", &kind, option_uint32, &edit.triangle,
                          option_uint32, &edit.vertex[0], option_uint32, &edit.vertex[1],
                          option_uint32, &edit.vertex[2], &edit.point[0], &edit.point[1],
                          &edit.point[2], &path, &other) ||
        surface_editor_get_paths(path, other, &edit, &paths))
        return NULL;
    edit.kind = (mw_surface_edit_kind)kind;
    Py_BEGIN_ALLOW_THREADS
    status = mw_surface_edit_apply(object->editor, &edit, &change, &error);
    Py_END_ALLOW_THREADS
    surface_editor_release_paths(&paths);
    return status ? errors_raise(object->state, &error) : surface_editor_change(&change);
}

/* _undo() */
static PyObject *surface_editor_undo(PyObject *self, PyObject *unused)
{
    surface_editor_object *object = (surface_editor_object *)self;
    mw_surface_change change = {0};
    mw_error error;
    mw_status status;
    (void)unused;
    Py_BEGIN_ALLOW_THREADS
    status = mw_surface_edit_undo(object->editor, &change, &error);
    Py_END_ALLOW_THREADS
    return status ? errors_raise(object->state, &error) : surface_editor_change(&change);
}

/* _compact(triangles, vertices): fill the new number of each */
static PyObject *surface_editor_compact(PyObject *self, PyObject *args)
{
    surface_editor_object *object = (surface_editor_object *)self;
    PyObject *triangles, *vertices;
    editing_maps maps;
    mw_surface_editor_info info;
    mw_error error;
    mw_status status;
    mw_surface_editor_describe(object->editor, &info);
    if (!PyArg_ParseTuple(args, "OO", &triangles, &vertices) ||
        editing_get_maps(triangles, info.triangle_range, vertices, info.vertex_range, &maps))
        return NULL;
    Py_BEGIN_ALLOW_THREADS
    status =
        mw_surface_editor_compact(object->editor, maps.triangles.buf, maps.vertices.buf, &error);
    Py_END_ALLOW_THREADS
    editing_release_maps(&maps);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* --- what is there --- */

/* _describe(): a dictionary of the members of mw_surface_editor_info */
static PyObject *surface_editor_describe(PyObject *self, PyObject *unused)
{
    mw_surface_editor_info info;
    (void)unused;
    mw_surface_editor_describe(surface_editor_of(self), &info);
    return Py_BuildValue("{s:I,s:I,s:I,s:I,s:I,s:n,s:n,s:n,s:K}", "vertices", info.vertices,
                         "triangles", info.triangles, "vertex_range", info.vertex_range,
                         "triangle_range", info.triangle_range, "border_edges", info.border_edges,
                         "undoable", (Py_ssize_t)info.undoable, "bytes", (Py_ssize_t)info.bytes,
                         "undo_bytes", (Py_ssize_t)info.undo_bytes, "edits",
                         (unsigned long long)info.edits);
}

/* _triangle(number): its vertices, or None */
static PyObject *surface_editor_triangle(PyObject *self, PyObject *number)
{
    uint32_t triangle, v[3];
    if (!option_uint32(number, &triangle)) return NULL;
    return editing_triangle(mw_surface_editor_triangle(surface_editor_of(self), triangle, v), v);
}

/* _vertex(number): its place, or None */
static PyObject *surface_editor_vertex(PyObject *self, PyObject *number)
{
    uint32_t vertex;
    double point[3];
    if (!option_uint32(number, &vertex)) return NULL;
    return editing_vertex(mw_surface_editor_vertex(surface_editor_of(self), vertex, point), point,
                          3);
}

/* _living(out): fill a byte for each number of a vertex, 1 where there is one */
static PyObject *surface_editor_living(PyObject *self, PyObject *out)
{
    const mw_surface_editor *editor = surface_editor_of(self);
    mw_surface_editor_info info;
    Py_buffer view;
    double point[3];
    mw_surface_editor_describe(editor, &info);
    if (buffer_get_writable(out, 1, info.vertex_range, &view)) return NULL;
    for (uint32_t v = 0; v < info.vertex_range; v++)
        ((uint8_t *)view.buf)[v] = (uint8_t)mw_surface_editor_vertex(editor, v, point);
    PyBuffer_Release(&view);
    Py_RETURN_NONE;
}

/* _triangles_of(vertex): [triangle] */
static PyObject *surface_editor_triangles_of(PyObject *self, PyObject *number)
{
    uint32_t vertex, *numbers;
    size_t count;
    PyObject *list;
    if (!option_uint32(number, &vertex)) return NULL;
    count = mw_surface_editor_triangles_of(surface_editor_of(self), vertex, NULL, 0);
    numbers = PyMem_Calloc(count + 1, sizeof *numbers);
    if (!numbers) return PyErr_NoMemory();
    mw_surface_editor_triangles_of(surface_editor_of(self), vertex, numbers, count);
    list = editing_numbers(numbers, count);
    PyMem_Free(numbers);
    return list;
}

/* _edge(a, b): [triangle], of at most two */
static PyObject *surface_editor_edge(PyObject *self, PyObject *args)
{
    uint32_t a, b, triangles[2];
    if (!PyArg_ParseTuple(args, "O&O&", option_uint32, &a, option_uint32, &b)) return NULL;
    return editing_numbers(triangles,
                           mw_surface_editor_edge(surface_editor_of(self), a, b, triangles));
}

static PyObject *surface_editor_surface(PyObject *self, void *unused)
{
    (void)unused;
    return Py_NewRef(((surface_editor_object *)self)->surface);
}

static PyMethodDef surface_editor_methods[] = {
    {"_attach", surface_editor_attach, METH_O, NULL},
    {"_detach", surface_editor_detach, METH_O, NULL},
    {"_apply", surface_editor_apply, METH_VARARGS, NULL},
    {"_undo", surface_editor_undo, METH_NOARGS, NULL},
    {"_compact", surface_editor_compact, METH_VARARGS, NULL},
    {"_describe", surface_editor_describe, METH_NOARGS, NULL},
    {"_triangle", surface_editor_triangle, METH_O, NULL},
    {"_vertex", surface_editor_vertex, METH_O, NULL},
    {"_living", surface_editor_living, METH_O, NULL},
    {"_triangles_of", surface_editor_triangles_of, METH_O, NULL},
    {"_edge", surface_editor_edge, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyGetSetDef surface_editor_members[] = {
    {"surface", surface_editor_surface, NULL, "The surface that is edited.", NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

static PyType_Slot surface_editor_slots[] = {
    {Py_tp_doc, "An editor of the library, of a surface."},
    {Py_tp_dealloc, surface_editor_dealloc},
    {Py_tp_traverse, surface_editor_traverse},
    {Py_tp_methods, surface_editor_methods},
    {Py_tp_getset, surface_editor_members},
    {0, NULL},
};

static PyType_Spec surface_editor_spec = {
    .name = "meshwalk._core.SurfaceEditor",
    .basicsize = sizeof(surface_editor_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC |
             Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = surface_editor_slots,
};

static PyMethodDef surface_editor_functions[] = {
    {"surface_editor_from_surface", surface_editor_from_surface, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int surface_editor_init(PyObject *module, core_state *state)
{
    state->surface_editor_type = objects_add_type(module, &surface_editor_spec);
    return state->surface_editor_type ? PyModule_AddFunctions(module, surface_editor_functions)
                                      : -1;
}
