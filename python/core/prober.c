/* prober.c - Prober: a mw_prober as an object, which keeps its surface alive. */
#include "core.h"

#include <string.h>

/* prober_from_surface(cls, surface, boxes, threads, progress) */
static PyObject *prober_from_surface(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *class, *surface, *function;
    mw_progress progress;
    mw_prober_options options = {0};
    prober_object *object;
    mw_prober *prober;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO!pO&O", &class, state->surface_type, &surface, &options.boxes,
                          option_uint32, &options.threads, &function))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_prober_create(((surface_object *)surface)->surface, &options, &prober, &error);
    Py_END_ALLOW_THREADS
    if (status) return errors_raise(state, &error);
    object = objects_new(class, state->prober_type);
    if (!object) {
        mw_prober_destroy(prober);
        return NULL;
    }
    object->state = state;
    object->surface = Py_NewRef(surface);
    object->prober = prober;
    return (PyObject *)object;
}

static int prober_traverse(PyObject *self, visitproc visit, void *arg)
{
    Py_VISIT(Py_TYPE(self));
    Py_VISIT(((prober_object *)self)->surface);
    return 0;
}

static void prober_dealloc(PyObject *self)
{
    prober_object *object = (prober_object *)self;
    PyObject_GC_UnTrack(self);
    mw_prober_destroy(object->prober);
    Py_XDECREF(object->surface);
    objects_free(self);
}

static mw_probe_start prober_start_by_name(const char *name)
{
    int start = 0;
    while (start < MW_PROBE_START_COUNT &&
           strcmp(mw_probe_start_name((mw_probe_start)start), name) != 0)
        start++;
    return (mw_probe_start)start;
}

/* _probe(queries, out, max_distance, certain, start, iterations, threads, progress): six doubles a
 * query */
static PyObject *prober_probe(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    PyObject *queries, *out, *function;
    const char *start;
    mw_progress progress;
    mw_probe_options options = {0};
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOdpsO&O&O", &queries, &out, &options.max_distance,
                          &options.certain, &start, option_uint32, &options.iterations,
                          option_uint32, &options.threads, &function))
        return NULL;
    options.start = prober_start_by_name(start);
    if (options.start == MW_PROBE_START_COUNT)
        return PyErr_Format(PyExc_ValueError, "there is no start '%s'", start);
    if (buffer_get_batch(queries, 6, out, sizeof(mw_touch), Py_None, &batch)) return NULL;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_probe_batch(object->prober, batch.points.points, batch.points.count,
                            batch.points.stride, &options, batch.out.buf, NULL, &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* The points that are nearest to several, one after the other. */
typedef struct prober_search {
    const mw_prober *prober;
    const buffer_points *given;
    double max_distance;
    mw_nearest_surface_point *nearest;
    const mw_progress *progress;
} prober_search;

static mw_status prober_search_run(const prober_search *s, mw_error *error)
{
    enum { REPORTS = 200 };
    mw_status status = MW_OK;
    size_t told = 0;
    for (size_t i = 0; i < s->given->count && !status; i++) {
        status = mw_nearest_on_surface(s->prober, s->given->points + i * s->given->stride,
                                       s->max_distance, &s->nearest[i], error);
        if (status || !s->progress || (i + 1) * REPORTS / s->given->count == told) continue;
        told = (i + 1) * REPORTS / s->given->count;
        if (s->progress->report(s->progress->context, "finding nearest points",
                                (double)told / REPORTS) &&
            told < REPORTS)
            status = error->status = MW_CANCELLED;
    }
    return status;
}

/* _nearest(points, out, max_distance, progress) */
static PyObject *prober_nearest(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    PyObject *points, *out, *function;
    mw_progress progress;
    buffer_batch batch;
    prober_search search = {.prober = object->prober, .given = &batch.points};
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOdO", &points, &out, &search.max_distance, &function) ||
        buffer_get_batch(points, 3, out, sizeof(mw_nearest_surface_point), Py_None, &batch))
        return NULL;
    search.nearest = batch.out.buf;
    search.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = prober_search_run(&search, &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

static PyObject *prober_surface(PyObject *self, void *unused)
{
    (void)unused;
    return Py_NewRef(((prober_object *)self)->surface);
}

static PyMethodDef prober_methods[] = {
    {"_probe", prober_probe, METH_VARARGS, NULL},
    {"_nearest", prober_nearest, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyGetSetDef prober_members[] = {
    {"surface", prober_surface, NULL, "The surface that is probed.", NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

static PyType_Slot prober_slots[] = {
    {Py_tp_doc, "A prober of the library."}, {Py_tp_dealloc, prober_dealloc},
    {Py_tp_traverse, prober_traverse},       {Py_tp_methods, prober_methods},
    {Py_tp_getset, prober_members},          {0, NULL},
};

static PyType_Spec prober_spec = {
    .name = "meshwalk._core.Prober",
    .basicsize = sizeof(prober_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC |
             Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = prober_slots,
};

static PyMethodDef prober_functions[] = {
    {"prober_from_surface", prober_from_surface, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int prober_init(PyObject *module, core_state *state)
{
    state->prober_type = objects_add_type(module, &prober_spec);
    return state->prober_type ? PyModule_AddFunctions(module, prober_functions) : -1;
}
