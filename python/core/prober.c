/* prober.c - Prober: a mw_prober as an object, which keeps its surface alive. */
#include "core.h"

#include <stdlib.h>
#include <string.h>

/* prober_from_surface(cls, surface, boxes, guide, threads, progress) */
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
    if (!PyArg_ParseTuple(args, "OO!ppO&O", &class, state->surface_type, &surface, &options.boxes,
                          &options.guide, option_threads, &options.threads, &function))
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

/* The number of a name in a list; `count` if it is not there. */
static int prober_choice(const char *(*name_of)(int number), int count, const char *name)
{
    int i = 0;
    while (i < count && strcmp(name_of(i), name) != 0) i++;
    return i;
}

static const char *prober_start_name(int i)
{
    return mw_probe_start_name((mw_probe_start)i);
}
static const char *prober_extent_name(int i)
{
    return mw_probe_extent_name((mw_probe_extent)i);
}
static const char *prober_faces_name(int i)
{
    return mw_probe_faces_name((mw_probe_faces)i);
}

/* Set options->extent and ->faces. Returns -1 with an exception for an unknown name. */
static int prober_set_ray(mw_probe_options *options, const char *extent, const char *faces)
{
    options->extent =
        (mw_probe_extent)prober_choice(prober_extent_name, MW_PROBE_EXTENT_COUNT, extent);
    options->faces = (mw_probe_faces)prober_choice(prober_faces_name, MW_PROBE_FACES_COUNT, faces);
    if (options->extent == MW_PROBE_EXTENT_COUNT)
        option_raise_unknown("extent", extent, prober_extent_name, MW_PROBE_EXTENT_COUNT);
    else if (options->faces == MW_PROBE_FACES_COUNT)
        option_raise_unknown("faces", faces, prober_faces_name, MW_PROBE_FACES_COUNT);
    return PyErr_Occurred() ? -1 : 0;
}

/* _probe(queries, out, min_distance, max_distance, certain, extent, faces, start, iterations,
 * threads, progress): six doubles a query */
static PyObject *prober_probe(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    PyObject *queries, *out, *function;
    const char *start, *extent, *faces;
    mw_progress progress;
    mw_probe_options options = {0};
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOddpsssO&O&O", &queries, &out, &options.min_distance,
                          &options.max_distance, &options.certain, &extent, &faces, &start,
                          option_uint32, &options.iterations, option_threads, &options.threads,
                          &function))
        return NULL;
    options.start = prober_start_by_name(start);
    if (options.start == MW_PROBE_START_COUNT)
        return option_raise_unknown("start", start, prober_start_name, MW_PROBE_START_COUNT);
    if (prober_set_ray(&options, extent, faces)) return NULL;
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

/* _any(queries, out, extent, faces, min_distance, max_distance, threads, progress): six doubles a
 * query, and a byte of mw_touch_state for each */
static PyObject *prober_any(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    PyObject *queries, *out, *function;
    const char *extent, *faces;
    mw_progress progress;
    mw_probe_options options = {.certain = 1};
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOssddO&O", &queries, &out, &extent, &faces, &options.min_distance,
                          &options.max_distance, option_threads, &options.threads, &function) ||
        prober_set_ray(&options, extent, faces) ||
        buffer_get_batch(queries, 6, out, 1, Py_None, &batch))
        return NULL;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_probe_any_batch(object->prober, batch.points.points, batch.points.count,
                                batch.points.stride, &options, batch.out.buf, NULL, &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* Tuple of memory: offsets (size_t), touches (mw_touch). Takes what is in `lists`. */
static PyObject *prober_wrap_lists(core_state *state, const mw_touch_lists *lists)
{
    PyObject *offset =
                 memory_new(state, lists->offset, (lists->probe_count + 1) * sizeof *lists->offset),
             *touch = memory_new(state, lists->touch, lists->touch_count * sizeof *lists->touch);
    if (offset && touch) return Py_BuildValue("NN", offset, touch);
    Py_XDECREF(offset);
    Py_XDECREF(touch);
    return NULL;
}

/* _lists(queries, one_per_place, extent, faces, min_distance, max_distance, threads, progress): six
 * doubles a query; memory of offsets and touches */
static PyObject *prober_lists(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    PyObject *queries, *function;
    const char *extent, *faces;
    int one_per_place;
    mw_progress progress;
    mw_probe_options options = {.certain = 1};
    buffer_points rows;
    mw_touch_lists lists;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OpssddO&O", &queries, &one_per_place, &extent, &faces,
                          &options.min_distance, &options.max_distance, option_threads,
                          &options.threads, &function) ||
        prober_set_ray(&options, extent, faces) || buffer_get_points(queries, 6, &rows))
        return NULL;
    options.one_per_place = one_per_place != 0;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_probe_all_batch(object->prober, rows.points, rows.count, rows.stride, &options,
                                &lists, NULL, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&rows.view);
    return status ? errors_raise(object->state, &error) : prober_wrap_lists(object->state, &lists);
}

/* _nearest(points, out, max_distance, threads, progress) */
static PyObject *prober_nearest(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    PyObject *points, *out, *function;
    mw_progress progress;
    mw_nearest_options options = {0};
    double max_distance;
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOdO&O", &points, &out, &max_distance, option_threads,
                          &options.threads, &function) ||
        buffer_get_batch(points, 3, out, sizeof(mw_nearest_surface_point), Py_None, &batch))
        return NULL;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_nearest_on_surface_batch(object->prober, batch.points.points, batch.points.count,
                                         batch.points.stride, max_distance, &options, batch.out.buf,
                                         &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* _deviation(surface, threads, progress): a dictionary of the members of mw_deviation */
static PyObject *prober_deviation(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    PyObject *surface, *function;
    mw_progress progress;
    mw_remesh_options options = {0};
    mw_deviation d;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!O&O", object->state->surface_type, &surface, option_threads,
                          &options.threads, &function))
        return NULL;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_surface_deviation(((surface_object *)surface)->surface, object->prober, &options,
                                  &d, &error);
    Py_END_ALLOW_THREADS
    if (status) return errors_raise(object->state, &error);
    return Py_BuildValue("{s:d,s:d,s:d,s:(ddd),s:(ddd),s:I,s:I,s:K,s:d}", "largest", d.largest,
                         "at_most", d.at_most, "mean", d.mean, "point", d.point[0], d.point[1],
                         d.point[2], "nearest", d.nearest[0], d.nearest[1], d.nearest[2],
                         "triangle", d.triangle, "nearest_triangle", d.nearest_triangle, "samples",
                         (unsigned long long)d.samples, "area", d.area);
}

/* All touches of a probe, to be released by free(). */
typedef struct prober_touches {
    mw_touch *touches;
    size_t count;
    mw_touch_state state;
} prober_touches;

/* The surface may change between two searches, so each has to find room for all that it finds.
 * Returns -1 when out of memory. */
static int prober_find_all(const mw_prober *prober, mw_probe_cursor *cursor, const double query[6],
                           prober_touches *found)
{
    size_t room = 32;
    for (;;) {
        found->touches = malloc(room * sizeof *found->touches);
        if (!found->touches) return -1;
        found->count =
            mw_probe_all(prober, cursor, query, query + 3, found->touches, room, &found->state);
        if (found->count <= room) return 0;
        room = found->count;
        free(found->touches);
    }
}

/* _all(query, extent, faces, min_distance, max_distance): memory of touches */
static PyObject *prober_all(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    const char *extent, *faces;
    double q[6];
    mw_probe_options options = {.certain = 1};
    mw_probe_cursor cursor;
    mw_error error;
    prober_touches found;
    int failed;
    if (!PyArg_ParseTuple(args, "(dddddd)ssdd", &q[0], &q[1], &q[2], &q[3], &q[4], &q[5], &extent,
                          &faces, &options.min_distance, &options.max_distance) ||
        prober_set_ray(&options, extent, faces))
        return NULL;
    if (mw_probe_cursor_init(object->prober, &options, &cursor, &error) != MW_OK)
        return errors_raise(object->state, &error);
    Py_BEGIN_ALLOW_THREADS
    failed = prober_find_all(object->prober, &cursor, q, &found);
    Py_END_ALLOW_THREADS
    if (failed) return PyErr_NoMemory();
    if (found.state != MW_TOUCH_BAD)
        return memory_new(object->state, found.touches, found.count * sizeof *found.touches);
    free(found.touches);
    return PyErr_Format(PyExc_ValueError, "a coordinate is not finite, or the motion is zero");
}

/* _inside(points, out, threads): a byte for each point */
static PyObject *prober_inside(PyObject *self, PyObject *args)
{
    prober_object *object = (prober_object *)self;
    PyObject *points, *out;
    uint32_t threads;
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOO&", &points, &out, option_threads, &threads) ||
        buffer_get_batch(points, 3, out, 1, Py_None, &batch))
        return NULL;
    Py_BEGIN_ALLOW_THREADS
    status = mw_inside_surface(object->prober, batch.points.points, batch.points.count,
                               batch.points.stride, threads, batch.out.buf, &error);
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
    {"_deviation", prober_deviation, METH_VARARGS, NULL},
    {"_all", prober_all, METH_VARARGS, NULL},
    {"_any", prober_any, METH_VARARGS, NULL},
    {"_lists", prober_lists, METH_VARARGS, NULL},
    {"_inside", prober_inside, METH_VARARGS, NULL},
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
