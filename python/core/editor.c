/* editor.c - Editor: a mw_editor as an object. meshwalk.Editor sees to it, by a lock, that no query
 * and no other edit runs during an edit. */
#include "core.h"

typedef struct editor_object {
    PyObject_HEAD
    core_state *state;
    mw_editor *editor;
    mw_cursor cursor;     /* of single queries                                        */
    mw_progress progress; /* the editor's; watches only while a call that may be long */
    int busy;             /* such a call runs: the function that it reports to must keep off */
} editor_object;

static mw_editor *editor_of(PyObject *self)
{
    return ((editor_object *)self)->editor;
}

/* The fields of the list [(name as bytes, values)] become those of the mesh. */
static int editor_set_fields(core_state *state, mw_mesh *mesh, PyObject *list)
{
    const Py_ssize_t count = PyList_Size(list);
    for (Py_ssize_t i = 0; i < count; i++) {
        const char *name;
        PyObject *values;
        Py_buffer view;
        mw_error error;
        mw_status status;
        if (!PyArg_ParseTuple(PyList_GetItem(list, i), "yO", &name, &values) ||
            buffer_get_packed(values, sizeof(double), mw_mesh_vertex_count(mesh), &view))
            return -1;
        status = mw_mesh_set_field(mesh, name, view.buf, 0, &error);
        PyBuffer_Release(&view);
        if (status) {
            errors_raise(state, &error);
            return -1;
        }
    }
    return 0;
}

/* A long call begins. */
static void editor_watch(editor_object *object, PyObject *function)
{
    if (!progress_begin(object->state, function, &object->progress))
        object->progress = (mw_progress){0};
    object->busy = 1;
}

static void editor_watch_end(editor_object *object)
{
    object->progress = (mw_progress){0};
    object->busy = 0;
}

static int editor_is_busy(const editor_object *object)
{
    if (!object->busy) return 0;
    PyErr_SetString(PyExc_RuntimeError, "the editor is at work: what watches it may not use it");
    return -1;
}

/* editor_from_mesh(cls, mesh, fields, delaunay, undo, log, constrained_edges, threads, progress):
 * not while another thread makes an editor of the mesh */
static PyObject *editor_from_mesh(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *class, *mesh, *fields, *edges, *function;
    mw_editor_options options = {0};
    int mode;
    uint64_t undo;
    Py_buffer edge_view;
    editor_object *object;
    mw_error error;
    mw_status status = MW_OK;
    if (!PyArg_ParseTuple(args, "OO!O!iO&pOO&O", &class, state->mesh_type, &mesh, &PyList_Type,
                          &fields, &mode, option_uint64, &undo, &options.log, &edges,
                          option_threads, &options.threads, &function) ||
        editor_set_fields(state, ((mesh_object *)mesh)->mesh, fields) ||
        buffer_get_all(edges, 2 * sizeof(uint32_t), &edge_view, &options.constrained_edge_count))
        return NULL;
    object = objects_new(class, state->editor_type);
    if (object) {
        object->state = state;
        options.delaunay = (mw_delaunay_mode)mode;
        options.undo = (size_t)undo;
        options.constrained_edges = edge_view.buf;
        options.progress = &object->progress;
        editor_watch(object, function);
        Py_BEGIN_ALLOW_THREADS
        status = mw_editor_create(((mesh_object *)mesh)->mesh, &options, &object->editor, &error);
        Py_END_ALLOW_THREADS
        editor_watch_end(object);
    }
    PyBuffer_Release(&edge_view);
    if (!status) return (PyObject *)object;
    Py_DECREF(object);
    return errors_raise(state, &error);
}

static void editor_dealloc(PyObject *self)
{
    mw_editor_destroy(editor_of(self));
    objects_free(self);
}

/* --- edits --- */

/* -1 for MW_NONE. */
static long long editor_number(uint32_t number)
{
    return number == MW_NONE ? -1 : (long long)number;
}

/* (vertex, vertices_made, vertices_freed, flips, constrained_edges, made, reused, freed, bytes) */
static PyObject *editor_change_tuple(const mw_change *change)
{
    const size_t count = change->made + change->reused + change->freed;
    const Py_ssize_t size = (Py_ssize_t)(count * sizeof *change->triangle);
    return Py_BuildValue("LIIIInnny#", editor_number(change->vertex), change->vertices_made,
                         change->vertices_freed, change->flips, change->constrained_edges,
                         (Py_ssize_t)change->made, (Py_ssize_t)change->reused,
                         (Py_ssize_t)change->freed, (const char *)change->triangle, size);
}

/* _apply(kind, vertex, other, field, x, y, value): what its kind does not name is not read */
static PyObject *editor_apply(PyObject *self, PyObject *args)
{
    editor_object *object = (editor_object *)self;
    int kind;
    mw_edit edit = {0};
    mw_change change = {.vertex = MW_NONE};
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "iO&O&O&ddd", &kind, option_uint32, &edit.vertex, option_uint32,
                          &edit.other, option_uint32, &edit.field, &edit.x, &edit.y, &edit.value))
        return NULL;
    edit.kind = (mw_edit_kind)kind;
    if (editor_is_busy(object)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    status = mw_edit_apply(object->editor, &edit, &change, &error);
    Py_END_ALLOW_THREADS
    return status ? errors_raise(object->state, &error) : editor_change_tuple(&change);
}

/* _insert_points(points, vertices, progress): fill the number of the vertex at each point */
static PyObject *editor_insert_points(PyObject *self, PyObject *args)
{
    editor_object *object = (editor_object *)self;
    PyObject *points, *vertices, *function;
    buffer_points given;
    Py_buffer numbers;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOO", &points, &vertices, &function) || editor_is_busy(object) ||
        buffer_get_points(points, 2, &given))
        return NULL;
    if (buffer_get_writable(vertices, sizeof(uint32_t), given.count, &numbers)) {
        PyBuffer_Release(&given.view);
        return NULL;
    }
    editor_watch(object, function);
    Py_BEGIN_ALLOW_THREADS
    status = mw_edit_insert_points(object->editor, given.points, given.count, given.stride,
                                   numbers.buf, NULL, &error);
    Py_END_ALLOW_THREADS
    editor_watch_end(object);
    PyBuffer_Release(&numbers);
    PyBuffer_Release(&given.view);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* _undo(progress) */
static PyObject *editor_undo(PyObject *self, PyObject *function)
{
    editor_object *object = (editor_object *)self;
    mw_change change = {.vertex = MW_NONE};
    mw_error error;
    mw_status status;
    if (editor_is_busy(object)) return NULL;
    editor_watch(object, function);
    Py_BEGIN_ALLOW_THREADS
    status = mw_edit_undo(object->editor, &change, &error);
    Py_END_ALLOW_THREADS
    editor_watch_end(object);
    return status ? errors_raise(object->state, &error) : editor_change_tuple(&change);
}

/* _log(): [(kind, vertex, other, field, x, y, value)] */
static PyObject *editor_log(PyObject *self, PyObject *unused)
{
    size_t count;
    const mw_edit *log = mw_editor_log(editor_of(self), &count);
    PyObject *list = PyList_New((Py_ssize_t)count);
    (void)unused;
    for (size_t i = 0; list && i < count; i++) {
        const mw_edit *edit = &log[i];
        PyObject *tuple = Py_BuildValue("iIIIddd", (int)edit->kind, edit->vertex, edit->other,
                                        edit->field, edit->x, edit->y, edit->value);
        if (!tuple)
            Py_CLEAR(list);
        else
            PyList_SetItem(list, (Py_ssize_t)i, tuple);
    }
    return list;
}

/* --- what is there --- */

/* args: triangles, vertices, progress */
static int editor_get_maps(PyObject *self, PyObject *args, editing_maps *maps, PyObject **function)
{
    PyObject *triangles, *vertices;
    mw_editor_info info;
    mw_editor_describe(editor_of(self), &info);
    if (!PyArg_ParseTuple(args, "OOO", &triangles, &vertices, function) ||
        editor_is_busy((editor_object *)self))
        return -1;
    return editing_get_maps(triangles, info.triangle_range, vertices, info.vertex_range, maps);
}

/* _compact(triangles, vertices, progress): fill the new number of each */
static PyObject *editor_compact(PyObject *self, PyObject *args)
{
    editor_object *object = (editor_object *)self;
    PyObject *function;
    editing_maps maps;
    mw_error error;
    mw_status status;
    if (editor_get_maps(self, args, &maps, &function)) return NULL;
    editor_watch(object, function);
    Py_BEGIN_ALLOW_THREADS
    status = mw_editor_compact(object->editor, maps.triangles.buf, maps.vertices.buf, &error);
    Py_END_ALLOW_THREADS
    editor_watch_end(object);
    editing_release_maps(&maps);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* _mesh(cls, (triangles, vertices, progress)): a mesh with its fields; fill its number of each */
static PyObject *editor_mesh(PyObject *self, PyObject *args)
{
    editor_object *object = (editor_object *)self;
    PyObject *class, *arrays, *function;
    editing_maps maps;
    mw_mesh *mesh;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO!", &class, &PyTuple_Type, &arrays) ||
        editor_get_maps(self, arrays, &maps, &function))
        return NULL;
    editor_watch(object, function);
    Py_BEGIN_ALLOW_THREADS
    status = mw_editor_mesh(object->editor, maps.triangles.buf, maps.vertices.buf, &mesh, &error);
    Py_END_ALLOW_THREADS
    editor_watch_end(object);
    editing_release_maps(&maps);
    return status ? errors_raise(object->state, &error) : mesh_new(object->state, class, mesh);
}

/* describe(): a dictionary of the members of mw_editor_info */
static PyObject *editor_describe(PyObject *self, PyObject *unused)
{
    mw_editor_info info;
    (void)unused;
    mw_editor_describe(editor_of(self), &info);
    return Py_BuildValue(
        "{s:I,s:I,s:I,s:I,s:I,s:N,s:N,s:n,s:n,s:n,s:n,s:K,s:K}", "vertices", info.vertices,
        "triangles", info.triangles, "vertex_range", info.vertex_range, "triangle_range",
        info.triangle_range, "constrained_edges", info.constrained_edges, "delaunay",
        PyBool_FromLong(info.delaunay), "convex", PyBool_FromLong(info.convex), "undoable",
        (Py_ssize_t)info.undoable, "bytes", (Py_ssize_t)info.bytes, "undo_bytes",
        (Py_ssize_t)info.undo_bytes, "index_bytes", (Py_ssize_t)info.index_bytes, "edits",
        (unsigned long long)info.edits, "refreshes", (unsigned long long)info.refreshes);
}

/* _triangle(number): its vertices, or None */
static PyObject *editor_triangle(PyObject *self, PyObject *number)
{
    uint32_t triangle, v[3];
    if (!option_uint32(number, &triangle)) return NULL;
    return editing_triangle(mw_editor_triangle(editor_of(self), triangle, v), v);
}

/* _vertex(number): its place, or None */
static PyObject *editor_vertex(PyObject *self, PyObject *number)
{
    uint32_t vertex;
    double point[2];
    if (!option_uint32(number, &vertex)) return NULL;
    return editing_vertex(mw_editor_vertex(editor_of(self), vertex, point), point, 2);
}

/* _adjacent(number): [vertex] */
static PyObject *editor_adjacent(PyObject *self, PyObject *number)
{
    uint32_t vertex, *numbers;
    size_t count;
    PyObject *list;
    if (!option_uint32(number, &vertex)) return NULL;
    count = mw_editor_adjacent_vertices(editor_of(self), vertex, NULL, 0);
    numbers = PyMem_Calloc(count + 1, sizeof *numbers);
    if (!numbers) return PyErr_NoMemory();
    mw_editor_adjacent_vertices(editor_of(self), vertex, numbers, count);
    list = editing_numbers(numbers, count);
    PyMem_Free(numbers);
    return list;
}

/* _edge(from, to): a mw_edge_kind */
static PyObject *editor_edge(PyObject *self, PyObject *args)
{
    uint32_t from, to;
    if (!PyArg_ParseTuple(args, "O&O&", option_uint32, &from, option_uint32, &to)) return NULL;
    return PyLong_FromLong(mw_editor_edge(editor_of(self), from, to));
}

/* _field(name as bytes): its number, -1 for none */
static PyObject *editor_field(PyObject *self, PyObject *args)
{
    const char *name;
    if (!PyArg_ParseTuple(args, "y", &name)) return NULL;
    return PyLong_FromLongLong(editor_number(mw_editor_field_by_name(editor_of(self), name)));
}

/* _value(field, vertex) */
static PyObject *editor_value(PyObject *self, PyObject *args)
{
    uint32_t field, vertex;
    if (!PyArg_ParseTuple(args, "O&O&", option_uint32, &field, option_uint32, &vertex)) return NULL;
    return PyFloat_FromDouble(mw_editor_value(editor_of(self), field, vertex));
}

/* _constrained_edges(): memory of two uint32 an edge */
static PyObject *editor_constrained_edges(PyObject *self, PyObject *unused)
{
    editor_object *object = (editor_object *)self;
    size_t count = 0;
    uint32_t *edges = mw_editor_constrained_edges(object->editor, &count);
    (void)unused;
    if (!edges) return PyErr_NoMemory();
    return memory_new(object->state, edges, 2 * count * sizeof *edges);
}

/* --- location in between --- */

/* _locate(points, out, hints, threads, progress): as that of a locator */
static PyObject *editor_locate(PyObject *self, PyObject *args)
{
    editor_object *object = (editor_object *)self;
    PyObject *points, *out, *hints, *function;
    mw_progress progress;
    mw_query_options options = {0};
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOO&O", &points, &out, &hints, option_threads, &options.threads,
                          &function) ||
        editor_is_busy(object) ||
        buffer_get_batch(points, 2, out, sizeof(mw_location), hints, &batch))
        return NULL;
    options.hints = batch.hints.buf;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status =
        mw_locate_batch(mw_editor_locator(object->editor), batch.points.points, batch.points.count,
                        batch.points.stride, &options, batch.out.buf, NULL, &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* _locate_one(x, y) */
static PyObject *editor_locate_one(PyObject *self, PyObject *args)
{
    editor_object *object = (editor_object *)self;
    mw_location location;
    double x, y;
    if (!PyArg_ParseTuple(args, "dd", &x, &y) || editor_is_busy(object)) return NULL;
    location = mw_locate(mw_editor_locator(object->editor), &object->cursor, x, y);
    return location_new(object->state, &location);
}

/* _interpolate(field, locations, out): one double for each location in the mesh as it is */
static PyObject *editor_interpolate(PyObject *self, PyObject *args)
{
    PyObject *locations, *out;
    uint32_t field;
    Py_buffer location_view, out_view;
    size_t count;
    if (!PyArg_ParseTuple(args, "O&OO", option_uint32, &field, &locations, &out) ||
        buffer_get_all(locations, sizeof(mw_location), &location_view, &count))
        return NULL;
    if (buffer_get_writable(out, sizeof(double), count, &out_view)) {
        PyBuffer_Release(&location_view);
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS
    mw_editor_interpolate(editor_of(self), field, location_view.buf, count, out_view.buf);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&out_view);
    PyBuffer_Release(&location_view);
    Py_RETURN_NONE;
}

static PyMethodDef editor_methods[] = {
    {"_apply", editor_apply, METH_VARARGS, NULL},
    {"_insert_points", editor_insert_points, METH_VARARGS, NULL},
    {"_undo", editor_undo, METH_O, NULL},
    {"_log", editor_log, METH_NOARGS, NULL},
    {"_compact", editor_compact, METH_VARARGS, NULL},
    {"_mesh", editor_mesh, METH_VARARGS, NULL},
    {"_describe", editor_describe, METH_NOARGS, NULL},
    {"_triangle", editor_triangle, METH_O, NULL},
    {"_vertex", editor_vertex, METH_O, NULL},
    {"_adjacent", editor_adjacent, METH_O, NULL},
    {"_edge", editor_edge, METH_VARARGS, NULL},
    {"_field", editor_field, METH_VARARGS, NULL},
    {"_value", editor_value, METH_VARARGS, NULL},
    {"_constrained_edges", editor_constrained_edges, METH_NOARGS, NULL},
    {"_locate", editor_locate, METH_VARARGS, NULL},
    {"_locate_one", editor_locate_one, METH_VARARGS, NULL},
    {"_interpolate", editor_interpolate, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot editor_slots[] = {
    {Py_tp_doc, "An editor of the library."},
    {Py_tp_dealloc, editor_dealloc},
    {Py_tp_methods, editor_methods},
    {0, NULL},
};

static PyType_Spec editor_spec = {
    .name = "meshwalk._core.Editor",
    .basicsize = sizeof(editor_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = editor_slots,
};

static PyMethodDef editor_functions[] = {
    {"editor_from_mesh", editor_from_mesh, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int editor_init(PyObject *module, core_state *state)
{
    state->editor_type = objects_add_type(module, &editor_spec);
    return state->editor_type ? PyModule_AddFunctions(module, editor_functions) : -1;
}
