/* mesh.c - Mesh: a mw_mesh as an object. */
#include "core.h"

#include <string.h>

PyObject *mesh_new(core_state *state, PyObject *class, mw_mesh *mesh)
{
    mesh_object *object = objects_new(class, state->mesh_type);
    if (!object) {
        mw_mesh_destroy(mesh);
        return NULL;
    }
    object->state = state;
    object->mesh = mesh;
    return (PyObject *)object;
}

PyObject *mesh_borrow(core_state *state, PyObject *class, mw_mesh *mesh, PyObject *owner)
{
    mesh_object *object = objects_new(class, state->mesh_type);
    if (!object) return NULL;
    object->state = state;
    object->owner = Py_NewRef(owner);
    object->mesh = mesh;
    return (PyObject *)object;
}

static void mesh_dealloc(PyObject *self)
{
    mesh_object *object = (mesh_object *)self;
    if (!object->owner) mw_mesh_destroy(object->mesh);
    Py_XDECREF(object->owner);
    objects_free(self);
}

/* mesh_from_arrays(cls, points, triangles, tolerant, layout, threads, progress) */
static PyObject *mesh_from_arrays(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *class, *points, *triangles, *function;
    mw_mesh_options options = {0};
    mw_progress progress;
    int layout;
    buffer_mesh given;
    mw_mesh *mesh;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOpiO&O", &class, &points, &triangles, &options.tolerant, &layout,
                          option_threads, &options.threads, &function))
        return NULL;
    options.layout = (mw_mesh_layout)layout;
    options.progress = progress_begin(state, function, &progress);
    if (buffer_get_mesh(points, triangles, 2, &given)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    status = mw_mesh_create(&given.arrays, &options, &mesh, &error);
    Py_END_ALLOW_THREADS
    buffer_release_mesh(&given);
    return status ? errors_raise(state, &error) : mesh_new(state, class, mesh);
}

/* copy_points(out): fill two doubles a vertex */
static PyObject *mesh_copy_points(PyObject *self, PyObject *out)
{
    const mw_mesh *mesh = ((mesh_object *)self)->mesh;
    uint32_t count = mw_mesh_vertex_count(mesh);
    Py_buffer view;
    if (buffer_get_writable(out, sizeof(double), 2 * (size_t)count, &view)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    for (uint32_t i = 0; i < count; i++)
        mw_mesh_vertex(mesh, i, (double *)view.buf + 2 * (size_t)i);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    Py_RETURN_NONE;
}

/* copy_triangles(out): fill three uint32 a triangle */
static PyObject *mesh_copy_triangles(PyObject *self, PyObject *out)
{
    const mw_mesh *mesh = ((mesh_object *)self)->mesh;
    uint32_t count = mw_mesh_triangle_count(mesh);
    Py_buffer view;
    if (buffer_get_writable(out, sizeof(uint32_t), 3 * (size_t)count, &view)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    for (uint32_t t = 0; t < count; t++)
        mw_mesh_triangle(mesh, t, (uint32_t *)view.buf + 3 * (size_t)t);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    Py_RETURN_NONE;
}

/* copy_neighbours(out): fill three uint32 a triangle */
static PyObject *mesh_copy_neighbours(PyObject *self, PyObject *out)
{
    const mw_mesh *mesh = ((mesh_object *)self)->mesh;
    uint32_t count = mw_mesh_triangle_count(mesh);
    Py_buffer view;
    if (buffer_get_writable(out, sizeof(uint32_t), 3 * (size_t)count, &view)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    for (uint32_t t = 0; t < count; t++)
        for (unsigned edge = 0; edge < 3; edge++)
            ((uint32_t *)view.buf)[3 * (size_t)t + edge] = mw_mesh_neighbour(mesh, t, edge, NULL);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    Py_RETURN_NONE;
}

/* interpolate_table(values, narrow, locations, out, threads, progress): doubles, or floats if
 * `narrow`, a row for each vertex. The answers lie in rows for the locations, or, where the values
 * of a vertex do not lie side by side, in rows for the columns. */
static PyObject *mesh_interpolate_table(PyObject *self, PyObject *args)
{
    mesh_object *object = (mesh_object *)self;
    PyObject *values, *locations, *out, *function;
    mw_progress progress;
    mw_interpolate_options options = {0};
    int narrow;
    buffer_table table;
    Py_buffer location_view, out_view;
    size_t count;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OpOOO&O", &values, &narrow, &locations, &out, option_threads,
                          &options.threads, &function) ||
        buffer_get_table(values, narrow, mw_mesh_vertex_count(object->mesh), &table))
        return NULL;
    if (buffer_get_all(locations, sizeof(mw_location), &location_view, &count)) {
        PyBuffer_Release(&table.view);
        return NULL;
    }
    if (buffer_get_writable(out, table.size, count * table.table.count, &out_view)) {
        PyBuffer_Release(&location_view);
        PyBuffer_Release(&table.view);
        return NULL;
    }
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_interpolate_table(object->mesh, &table.table, location_view.buf, count, &options,
                                  out_view.buf, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&out_view);
    PyBuffer_Release(&location_view);
    PyBuffer_Release(&table.view);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* copy_field(name as bytes, out): fill one double a vertex */
static PyObject *mesh_copy_field(PyObject *self, PyObject *args)
{
    const mw_mesh *mesh = ((mesh_object *)self)->mesh;
    const size_t count = mw_mesh_vertex_count(mesh);
    const char *name;
    const double *values;
    PyObject *out;
    Py_buffer view;
    if (!PyArg_ParseTuple(args, "yO", &name, &out)) return NULL;
    values = mw_mesh_field(mesh, name);
    if (!values) return PyErr_Format(PyExc_KeyError, "no field '%s'", name);
    if (buffer_get_writable(out, sizeof(double), count, &view)) return NULL;
    if (count) memcpy(view.buf, values, count * sizeof(double));
    PyBuffer_Release(&view);
    Py_RETURN_NONE;
}

/* recover(values, out): doubles of the triangles, and at the vertices */
static PyObject *mesh_recover(PyObject *self, PyObject *args)
{
    mesh_object *object = (mesh_object *)self;
    PyObject *values, *out;
    Py_buffer given, view;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO", &values, &out) ||
        buffer_get_packed(values, sizeof(double), mw_mesh_triangle_count(object->mesh), &given))
        return NULL;
    if (buffer_get_writable(out, sizeof(double), mw_mesh_vertex_count(object->mesh), &view)) {
        PyBuffer_Release(&given);
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS
    status = mw_recover_vertex_values(object->mesh, given.buf, NULL, view.buf, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    PyBuffer_Release(&given);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* _hilbert_order(triangles, vertices): fill a uint32 for each */
static PyObject *mesh_hilbert_order(PyObject *self, PyObject *args)
{
    mesh_object *object = (mesh_object *)self;
    PyObject *triangles, *vertices;
    Py_buffer triangle_view, vertex_view;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO", &triangles, &vertices) ||
        buffer_get_writable(triangles, sizeof(uint32_t), mw_mesh_triangle_count(object->mesh),
                            &triangle_view))
        return NULL;
    if (buffer_get_writable(vertices, sizeof(uint32_t), mw_mesh_vertex_count(object->mesh),
                            &vertex_view)) {
        PyBuffer_Release(&triangle_view);
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS
    status = mw_mesh_hilbert_order(object->mesh, triangle_view.buf, vertex_view.buf, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&vertex_view);
    PyBuffer_Release(&triangle_view);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

static PyObject *mesh_info_dict(const mw_mesh_info *info)
{
    return Py_BuildValue(
        "{s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:N,s:N,s:N,s:N,s:(dd),s:(dd),s:d}", "vertices",
        info->vertices, "triangles", info->triangles, "unused_vertices", info->unused_vertices,
        "flat_triangles", info->flat_triangles, "clockwise_triangles", info->clockwise_triangles,
        "clashing_edges", info->clashing_edges, "border_edges", info->border_edges, "border_loops",
        info->border_loops, "components", info->components, "holes", info->holes, "oriented",
        PyBool_FromLong(info->oriented), "embedding", PyBool_FromLong(info->embedding), "convex",
        PyBool_FromLong(info->convex), "delaunay", PyBool_FromLong(info->delaunay), "low",
        info->low[0], info->low[1], "high", info->high[0], info->high[1], "area", info->area);
}

/* describe(): a dictionary of the members of mw_mesh_info */
static PyObject *mesh_describe(PyObject *self, PyObject *unused)
{
    mesh_object *object = (mesh_object *)self;
    mw_mesh_info info;
    mw_error error;
    mw_status status;
    (void)unused;
    Py_BEGIN_ALLOW_THREADS
    status = mw_mesh_describe(object->mesh, NULL, &info, &error);
    Py_END_ALLOW_THREADS
    return status ? errors_raise(object->state, &error) : mesh_info_dict(&info);
}

static PyObject *mesh_vertex_count(PyObject *self, void *unused)
{
    (void)unused;
    return PyLong_FromUnsignedLong(mw_mesh_vertex_count(((mesh_object *)self)->mesh));
}

static PyObject *mesh_triangle_count(PyObject *self, void *unused)
{
    (void)unused;
    return PyLong_FromUnsignedLong(mw_mesh_triangle_count(((mesh_object *)self)->mesh));
}

static PyObject *mesh_bytes(PyObject *self, void *unused)
{
    (void)unused;
    return PyLong_FromSize_t(mw_mesh_bytes(((mesh_object *)self)->mesh));
}

static PyMethodDef mesh_methods[] = {
    {"_copy_points", mesh_copy_points, METH_O, NULL},
    {"_copy_triangles", mesh_copy_triangles, METH_O, NULL},
    {"_copy_neighbours", mesh_copy_neighbours, METH_O, NULL},
    {"_interpolate_table", mesh_interpolate_table, METH_VARARGS, NULL},
    {"_copy_field", mesh_copy_field, METH_VARARGS, NULL},
    {"_recover", mesh_recover, METH_VARARGS, NULL},
    {"_hilbert_order", mesh_hilbert_order, METH_VARARGS, NULL},
    {"_describe", mesh_describe, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyGetSetDef mesh_members[] = {
    {"vertex_count", mesh_vertex_count, NULL, "Number of vertices.", NULL},
    {"triangle_count", mesh_triangle_count, NULL, "Number of triangles.", NULL},
    {"nbytes", mesh_bytes, NULL, "Memory of the library's mesh, in bytes; fields not counted.",
     NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

static PyType_Slot mesh_slots[] = {
    {Py_tp_doc, "A mesh of the library."},
    {Py_tp_dealloc, mesh_dealloc},
    {Py_tp_methods, mesh_methods},
    {Py_tp_getset, mesh_members},
    {0, NULL},
};

static PyType_Spec mesh_spec = {
    .name = "meshwalk._core.Mesh",
    .basicsize = sizeof(mesh_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = mesh_slots,
};

static PyMethodDef mesh_functions[] = {
    {"mesh_from_arrays", mesh_from_arrays, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int mesh_init(PyObject *module, core_state *state)
{
    state->mesh_type = objects_add_type(module, &mesh_spec);
    return state->mesh_type ? PyModule_AddFunctions(module, mesh_functions) : -1;
}
