/* locator.c - Locator: a mw_locator as an object, which keeps its mesh alive. */
#include "core.h"

#include <math.h>
#include <stdlib.h>

/* What a query of a batch is asked with; the strings are names of walks and starts. */
typedef struct locator_query {
    mw_query_options options;
    const char *walk, *start;
} locator_query;

static int locator_resolve_names(locator_query *query)
{
    mw_query_options *options = &query->options;
    options->walk = mw_walk_by_name(query->walk);
    options->start = mw_start_by_name(query->start);
    if (options->walk == MW_WALK_COUNT)
        option_raise_unknown("walk", query->walk, option_walk_name, MW_WALK_COUNT);
    else if (options->start == MW_START_COUNT)
        option_raise_unknown("start", query->start, option_start_name, MW_START_COUNT);
    else
        return 0;
    return -1;
}

PyObject *locator_new(core_state *state, PyObject *class, PyObject *mesh, mw_locator *locator,
                      PyObject *owner)
{
    locator_object *object = objects_new(class, state->locator_type);
    if (!object) {
        if (!owner) mw_locator_destroy(locator);
        return NULL;
    }
    object->state = state;
    object->owner = Py_XNewRef(owner);
    object->mesh = Py_NewRef(mesh);
    object->locator = locator;
    return (PyObject *)object;
}

/* locator_from_mesh(cls, mesh, any, border, areas, late_chains, fill, queries, threads,
 * progress) */
static PyObject *locator_from_mesh(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *class, *mesh, *function;
    mw_locator_options options = {0};
    mw_progress progress;
    int fill, late_chains;
    mw_locator *locator;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO!ppppiO&O&O", &class, state->mesh_type, &mesh, &options.any,
                          &options.border, &options.areas, &late_chains, &fill, option_uint64,
                          &options.queries, option_threads, &options.threads, &function))
        return NULL;
    options.fill = (mw_fill_mode)fill;
    options.no_late_chains = !late_chains;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_locator_create(((mesh_object *)mesh)->mesh, &options, &locator, &error);
    Py_END_ALLOW_THREADS
    return status ? errors_raise(state, &error) : locator_new(state, class, mesh, locator, NULL);
}

const mw_mesh *locator_get_mesh(PyObject *locator)
{
    return ((mesh_object *)((locator_object *)locator)->mesh)->mesh;
}

static int locator_traverse(PyObject *self, visitproc visit, void *arg)
{
    Py_VISIT(Py_TYPE(self));
    Py_VISIT(((locator_object *)self)->mesh);
    return 0;
}

/* The mesh stays until the end: queries use it. Cycles are broken by the attributes of the mesh. */
static void locator_dealloc(PyObject *self)
{
    locator_object *object = (locator_object *)self;
    PyObject_GC_UnTrack(self);
    if (!object->owner) mw_locator_destroy(object->locator);
    Py_XDECREF(object->mesh);
    Py_XDECREF(object->owner);
    objects_free(self);
}

/* _locate(points, out, hints, walk, start, tolerance, lanes, threads, progress): hints, unless they
 * are None, are read and written */
static PyObject *locator_locate(PyObject *self, PyObject *args)
{
    locator_object *object = (locator_object *)self;
    PyObject *points, *out, *hints, *function;
    mw_progress progress;
    locator_query query = {0};
    mw_query_options *options = &query.options;
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOssdO&O&O", &points, &out, &hints, &query.walk, &query.start,
                          &options->tolerance, option_uint32, &options->lanes, option_threads,
                          &options->threads, &function) ||
        locator_resolve_names(&query) ||
        buffer_get_batch(points, 2, out, sizeof(mw_location), hints, &batch))
        return NULL;
    options->hints = batch.hints.buf;
    options->progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_locate_batch(object->locator, batch.points.points, batch.points.count,
                             batch.points.stride, options, batch.out.buf, NULL, &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

PyDoc_STRVAR(locator_one_doc, "locate_one(x, y, /)\n--\n\n"
                              "Locate one point, as fast as a call from Python can be.\n\n"
                              "Parameters\n----------\n"
                              "x, y : float\n    The point, in the units of the mesh.\n\n"
                              "Returns\n-------\n"
                              "Location\n    With the attributes `triangle`, `where`, "
                              "`local`, `weights`, `hole`, `inside`.\n\n"
                              "Notes\n-----\n"
                              "The answer is that of `locate`, without a tolerance.");

static PyObject *locator_locate_one(PyObject *self, PyObject *const *args, Py_ssize_t count)
{
    locator_object *object = (locator_object *)self;
    mw_location location;
    double x, y;
    if (count != 2)
        return PyErr_Format(PyExc_TypeError, "locate_one() takes x and y (%zd given)", count);
    x = PyFloat_AsDouble(args[0]);
    if (x == -1 && PyErr_Occurred()) return NULL;
    y = PyFloat_AsDouble(args[1]);
    if (y == -1 && PyErr_Occurred()) return NULL;
    location = mw_locate(object->locator, &object->cursor, x, y);
    return location_new(object->state, &location);
}

/* nearest_border(x, y): triangle, edge, distance, point, weights */
static PyObject *locator_nearest_border(PyObject *self, PyObject *args)
{
    locator_object *object = (locator_object *)self;
    double x, y;
    mw_nearest_border_point nearest;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "dd", &x, &y)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    status = mw_nearest_border(object->locator, x, y, &nearest, &error);
    Py_END_ALLOW_THREADS
    if (status) return errors_raise(object->state, &error);
    return Py_BuildValue("IId(dd)(ddd)", nearest.triangle, nearest.edge, nearest.distance,
                         nearest.point[0], nearest.point[1], nearest.weight[0], nearest.weight[1],
                         nearest.weight[2]);
}

/* Answer many points; one that is not finite has none. */
static mw_status locator_fill_borders(const mw_locator *locator, const buffer_points *points,
                                      mw_nearest_border_point *out, mw_error *error)
{
    mw_status status = MW_OK;
    for (size_t i = 0; i < points->count && !status; i++) {
        const double *p = points->points + i * points->stride;
        if (isfinite(p[0]) && isfinite(p[1]))
            status = mw_nearest_border(locator, p[0], p[1], &out[i], error);
        else
            out[i] = (mw_nearest_border_point){
                MW_NONE, MW_NONE, NAN, {NAN, NAN}, {NAN, NAN, NAN},
            };
    }
    return status;
}

/* _nearest_borders(points, out): a mw_nearest_border_point for each point */
static PyObject *locator_nearest_borders(PyObject *self, PyObject *args)
{
    locator_object *object = (locator_object *)self;
    PyObject *points, *out;
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO", &points, &out) ||
        buffer_get_batch(points, 2, out, sizeof(mw_nearest_border_point), Py_None, &batch))
        return NULL;
    Py_BEGIN_ALLOW_THREADS
    status = locator_fill_borders(object->locator, &batch.points, batch.out.buf, &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* The triangles of a walk, and how many; NULL when out of memory. Each call begins anew, so two of
 * them are of one length. */
static uint32_t *locator_walk(const mw_locator *locator, const mw_cursor *begin,
                              const double point[2], size_t *count)
{
    mw_cursor cursor = *begin;
    uint32_t *triangles;
    *count = mw_walk_path(locator, &cursor, point[0], point[1], NULL, 0, NULL);
    triangles = malloc((*count + 1) * sizeof *triangles);
    if (!triangles) return NULL;
    cursor = *begin;
    mw_walk_path(locator, &cursor, point[0], point[1], triangles, *count, NULL);
    return triangles;
}

/* _walk_path(x, y, walk, start, seed): memory of the numbers of triangles */
static PyObject *locator_walk_path(PyObject *self, PyObject *args)
{
    locator_object *object = (locator_object *)self;
    locator_query query = {0};
    double point[2];
    uint32_t *triangles;
    size_t count;
    mw_cursor cursor;
    mw_error error;
    if (!PyArg_ParseTuple(args, "ddssO&", &point[0], &point[1], &query.walk, &query.start,
                          option_uint64, &query.options.seed) ||
        locator_resolve_names(&query))
        return NULL;
    if (mw_cursor_init(object->locator, &query.options, &cursor, &error))
        return errors_raise(object->state, &error);
    Py_BEGIN_ALLOW_THREADS
    triangles = locator_walk(object->locator, &cursor, point, &count);
    Py_END_ALLOW_THREADS
    return triangles ? memory_new(object->state, triangles, count * sizeof *triangles)
                     : PyErr_NoMemory();
}

/* _segment(ends, threads, progress): memory of offsets (size_t) and of pieces */
static PyObject *locator_segment(PyObject *self, PyObject *args)
{
    locator_object *object = (locator_object *)self;
    return segments_follow(object->state, object->locator, args);
}

/* describe(): a dictionary of the members of mw_locator_info, and of the void promise, or None */
static PyObject *locator_describe(PyObject *self, PyObject *unused)
{
    const mw_locator *locator = ((locator_object *)self)->locator;
    mw_locator_info info;
    (void)unused;
    mw_locator_describe(locator, &info);
    return Py_BuildValue(
        "{s:n,s:n,s:n,s:n,s:n,s:n,s:z,s:I,s:I,s:I,s:N,s:N,s:N,s:z}", "bytes",
        (Py_ssize_t)info.bytes, "border_bytes", (Py_ssize_t)info.border_bytes, "area_bytes",
        (Py_ssize_t)info.area_bytes, "fill_bytes", (Py_ssize_t)info.fill_bytes, "guide_bytes",
        (Py_ssize_t)info.guide_bytes, "chain_bytes", (Py_ssize_t)info.chain_bytes, "guide",
        info.guide == MW_START_AUTO ? NULL : mw_start_name(info.guide), "ghost_triangles",
        info.ghost_triangles, "holes", info.holes, "components", info.components, "copied",
        PyBool_FromLong(info.copied), "embedding", PyBool_FromLong(info.embedding), "unfilled",
        PyBool_FromLong(info.unfilled), "void_promise", mw_locator_void_promise(locator));
}

static PyObject *locator_mesh(PyObject *self, void *unused)
{
    (void)unused;
    return Py_NewRef(((locator_object *)self)->mesh);
}

static PyMethodDef locator_methods[] = {
    {"_locate", locator_locate, METH_VARARGS, NULL},
    {"locate_one", (PyCFunction)(void (*)(void))locator_locate_one, METH_FASTCALL, locator_one_doc},
    {"_nearest_border", locator_nearest_border, METH_VARARGS, NULL},
    {"_nearest_borders", locator_nearest_borders, METH_VARARGS, NULL},
    {"_walk_path", locator_walk_path, METH_VARARGS, NULL},
    {"_segment", locator_segment, METH_VARARGS, NULL},
    {"_describe", locator_describe, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyGetSetDef locator_members[] = {
    {"mesh", locator_mesh, NULL, "The mesh that is searched.", NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

static PyType_Slot locator_slots[] = {
    {Py_tp_doc, "A locator of the library."}, {Py_tp_dealloc, locator_dealloc},
    {Py_tp_traverse, locator_traverse},       {Py_tp_methods, locator_methods},
    {Py_tp_getset, locator_members},          {0, NULL},
};

static PyType_Spec locator_spec = {
    .name = "meshwalk._core.Locator",
    .basicsize = sizeof(locator_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC |
             Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = locator_slots,
};

static PyMethodDef locator_functions[] = {
    {"locator_from_mesh", locator_from_mesh, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int locator_init(PyObject *module, core_state *state)
{
    state->locator_type = objects_add_type(module, &locator_spec);
    return state->locator_type ? PyModule_AddFunctions(module, locator_functions) : -1;
}
