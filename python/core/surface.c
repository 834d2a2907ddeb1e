/* surface.c - Surface: a mw_surface as an object, with the updates of what is kept beside it. */
#include "core.h"

#include <string.h>

/* Surfaces are made `shared`: a query of one thread waits for an update of another. What changes a
 * surface, or what is kept beside it, is called under a lock of meshwalk.Surface. */

/* surface_from_arrays(cls, points, triangles, tolerant, weld, progress) */
static PyObject *surface_from_arrays(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *class, *points, *triangles, *function;
    mw_progress progress;
    mw_surface_options options = {.shared = 1};
    buffer_mesh given;
    surface_object *object;
    mw_surface *surface;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOppO", &class, &points, &triangles, &options.tolerant,
                          &options.weld, &function) ||
        buffer_get_mesh(points, triangles, 3, &given))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_surface_create(&given.arrays, &options, &surface, &error);
    Py_END_ALLOW_THREADS
    buffer_release_mesh(&given);
    if (status) return errors_raise(state, &error);
    object = objects_new(class, state->surface_type);
    if (!object) {
        mw_surface_destroy(surface);
        return NULL;
    }
    object->state = state;
    object->surface = surface;
    return (PyObject *)object;
}

static void surface_dealloc(PyObject *self)
{
    mw_surface_destroy(((surface_object *)self)->surface);
    objects_free(self);
}

/* copy_points(out): fill three doubles a vertex */
static PyObject *surface_copy_points(PyObject *self, PyObject *out)
{
    mw_surface *surface = ((surface_object *)self)->surface;
    const size_t count = 3 * (size_t)mw_surface_vertex_count(surface);
    Py_buffer view;
    if (buffer_get_writable(out, sizeof(double), count, &view)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    if (count) memcpy(view.buf, mw_surface_points(surface), count * sizeof(double));
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    Py_RETURN_NONE;
}

/* copy_triangles(out): fill three uint32 a triangle */
static PyObject *surface_copy_triangles(PyObject *self, PyObject *out)
{
    const mw_surface *surface = ((surface_object *)self)->surface;
    uint32_t count = mw_surface_triangle_count(surface);
    Py_buffer view;
    if (buffer_get_writable(out, sizeof(uint32_t), 3 * (size_t)count, &view)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    for (uint32_t t = 0; t < count; t++)
        mw_surface_triangle(surface, t, (uint32_t *)view.buf + 3 * (size_t)t);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    Py_RETURN_NONE;
}

/* What is kept beside a surface, to be brought up to date. */
typedef struct surface_kept {
    mw_star **stars;
    mw_prober **probers;
    size_t star_count, prober_count;
} surface_kept;

static int surface_sort_kept(core_state *state, PyObject *list, surface_kept *kept)
{
    const size_t count = (size_t)PyList_Size(list);
    kept->stars = PyMem_Calloc(count + 1, sizeof *kept->stars);
    kept->probers = PyMem_Calloc(count + 1, sizeof *kept->probers);
    if (!kept->stars || !kept->probers) {
        PyErr_NoMemory();
        return -1;
    }
    for (size_t i = 0; i < count; i++) {
        PyObject *object = PyList_GetItem(list, (Py_ssize_t)i);
        if (PyObject_TypeCheck(object, state->star_type))
            kept->stars[kept->star_count++] = ((star_object *)object)->star;
        else if (PyObject_TypeCheck(object, state->prober_type))
            kept->probers[kept->prober_count++] = ((prober_object *)object)->prober;
    }
    return 0;
}

static void surface_release_kept(surface_kept *kept)
{
    PyMem_Free(kept->stars);
    PyMem_Free(kept->probers);
}

/* How far vertices moved, or -1; and which, or NULL. */
typedef struct surface_motion {
    double farthest;
    const uint32_t *vertices;
    size_t count;
    uint32_t threads;
} surface_motion;

/* The first error of a star is told; all are brought up to date that can be. */
static mw_status surface_update_kept(const surface_kept *kept, const surface_motion *motion,
                                     mw_error *error)
{
    mw_star_update_options options = {.moved = motion->vertices,
                                      .moved_count = motion->vertices ? motion->count : 0,
                                      .threads = motion->threads};
    mw_status status = MW_OK;
    for (size_t i = 0; i < kept->star_count; i++) {
        mw_error more;
        mw_status one = mw_star_update(kept->stars[i], &options, &more);
        if (!one || status) continue;
        status = one;
        *error = more;
    }
    for (size_t i = 0; i < kept->prober_count; i++)
        mw_prober_update(kept->probers[i], motion->farthest, motion->threads);
    return status;
}

/* Vertices that are to move: all, or those of a list of numbers that are below the count. */
static void surface_overwrite(mw_surface *surface, const double *points, const uint32_t *vertices,
                              size_t count)
{
    double *own = mw_surface_points(surface);
    if (!vertices && count) memcpy(own, points, 3 * count * sizeof(double));
    for (size_t i = 0; vertices && i < count; i++)
        memcpy(own + 3 * (size_t)vertices[i], points + 3 * i, 3 * sizeof(double));
}

/* _move(points, vertices or None, kept, moved, threads): three doubles for each vertex; `vertices`
 * were checked */
static PyObject *surface_move(PyObject *self, PyObject *args)
{
    surface_object *object = (surface_object *)self;
    PyObject *points, *numbers, *list;
    surface_motion motion = {0};
    size_t count = mw_surface_vertex_count(object->surface);
    Py_buffer point_view, number_view = {0};
    surface_kept kept = {0};
    mw_error error;
    mw_status status = MW_OK;
    int failed;
    if (!PyArg_ParseTuple(args, "OOO!dO&", &points, &numbers, &PyList_Type, &list, &motion.farthest,
                          option_threads, &motion.threads))
        return NULL;
    if (numbers != Py_None && buffer_get_all(numbers, sizeof(uint32_t), &number_view, &count))
        return NULL;
    failed = buffer_get_packed(points, 3 * sizeof(double), count, &point_view);
    if (!failed) {
        failed = surface_sort_kept(object->state, list, &kept);
        if (!failed) {
            Py_BEGIN_ALLOW_THREADS
            mw_surface_begin_update(object->surface);
            surface_overwrite(object->surface, point_view.buf, number_view.buf, count);
            motion.vertices = number_view.buf;
            motion.count = count;
            status = surface_update_kept(&kept, &motion, &error);
            mw_surface_end_update(object->surface);
            Py_END_ALLOW_THREADS
        }
        surface_release_kept(&kept);
        PyBuffer_Release(&point_view);
    }
    if (numbers != Py_None) PyBuffer_Release(&number_view);
    if (failed) return NULL;
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* _flip(triangle, edge, kept, threads): the numbers were checked */
static PyObject *surface_flip(PyObject *self, PyObject *args)
{
    surface_object *object = (surface_object *)self;
    PyObject *list;
    uint32_t triangle, edge, threads;
    surface_kept kept = {0};
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O&O&O!O&", option_uint32, &triangle, option_uint32, &edge,
                          &PyList_Type, &list, option_threads, &threads))
        return NULL;
    if (surface_sort_kept(object->state, list, &kept)) {
        surface_release_kept(&kept);
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS
    mw_surface_begin_update(object->surface);
    status = mw_surface_flip(object->surface, triangle, edge, &error);
    {
        mw_error later;
        mw_status update = surface_update_kept(
            &kept, &(surface_motion){.farthest = -1, .threads = threads}, &later);
        if (!status && update) {
            status = update;
            error = later;
        }
    }
    mw_surface_end_update(object->surface);
    Py_END_ALLOW_THREADS
    surface_release_kept(&kept);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

static PyObject *surface_info_dict(const mw_surface_info *info)
{
    return Py_BuildValue(
        "{s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:I,s:N,s:N,s:L,s:(ddd),s:(ddd),s:d,s:d}", "vertices",
        info->vertices, "triangles", info->triangles, "unused_vertices", info->unused_vertices,
        "flat_triangles", info->flat_triangles, "clashing_edges", info->clashing_edges,
        "pinched_vertices", info->pinched_vertices, "border_edges", info->border_edges,
        "border_loops", info->border_loops, "components", info->components, "closed",
        PyBool_FromLong(info->closed), "oriented", PyBool_FromLong(info->oriented), "euler",
        (long long)info->euler, "low", info->low[0], info->low[1], info->low[2], "high",
        info->high[0], info->high[1], info->high[2], "area", info->area, "volume", info->volume);
}

/* describe(): a dictionary of the members of mw_surface_info */
static PyObject *surface_describe(PyObject *self, PyObject *unused)
{
    surface_object *object = (surface_object *)self;
    mw_surface_info info;
    mw_error error;
    mw_status status;
    (void)unused;
    Py_BEGIN_ALLOW_THREADS
    status = mw_surface_describe(object->surface, &info, &error);
    Py_END_ALLOW_THREADS
    return status ? errors_raise(object->state, &error) : surface_info_dict(&info);
}

static PyObject *surface_vertex_count(PyObject *self, void *unused)
{
    (void)unused;
    return PyLong_FromUnsignedLong(mw_surface_vertex_count(((surface_object *)self)->surface));
}

static PyObject *surface_triangle_count(PyObject *self, void *unused)
{
    (void)unused;
    return PyLong_FromUnsignedLong(mw_surface_triangle_count(((surface_object *)self)->surface));
}

static PyMethodDef surface_methods[] = {
    {"_copy_points", surface_copy_points, METH_O, NULL},
    {"_copy_triangles", surface_copy_triangles, METH_O, NULL},
    {"_move", surface_move, METH_VARARGS, NULL},
    {"_flip", surface_flip, METH_VARARGS, NULL},
    {"_describe", surface_describe, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyGetSetDef surface_members[] = {
    {"vertex_count", surface_vertex_count, NULL, "Number of vertices.", NULL},
    {"triangle_count", surface_triangle_count, NULL, "Number of triangles.", NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

static PyType_Slot surface_slots[] = {
    {Py_tp_doc, "A surface of the library."},
    {Py_tp_dealloc, surface_dealloc},
    {Py_tp_methods, surface_methods},
    {Py_tp_getset, surface_members},
    {0, NULL},
};

static PyType_Spec surface_spec = {
    .name = "meshwalk._core.Surface",
    .basicsize = sizeof(surface_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = surface_slots,
};

static PyMethodDef surface_functions[] = {
    {"surface_from_arrays", surface_from_arrays, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int surface_init(PyObject *module, core_state *state)
{
    state->surface_type = objects_add_type(module, &surface_spec);
    return state->surface_type ? PyModule_AddFunctions(module, surface_functions) : -1;
}
