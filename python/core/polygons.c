/* polygons.c - Polygons: which polygons contain a point, by a locator of their own. */
#include "core.h"

#include <stdlib.h>

typedef struct polygons_object {
    PyObject_HEAD
    core_state *state;
    mw_polygons *polygons;
    mw_locator *locator;
} polygons_object;

/* What is listed for points. */
typedef struct polygons_list {
    mw_location *locations;
    uint64_t *offsets; /* one more than points */
    mw_polygon_hit *hits;
} polygons_list;

static void polygons_dealloc(PyObject *self)
{
    polygons_object *object = (polygons_object *)self;
    mw_locator_destroy(object->locator);
    mw_polygons_destroy(object->polygons);
    objects_free(self);
}

static mw_status polygons_make(const mw_constraints *rings, const mw_progress *progress,
                               uint32_t threads, polygons_object *made, mw_error *error)
{
    const mw_polygons_options options = {.threads = threads, .progress = progress};
    const mw_locator_options locating = {.threads = threads, .progress = progress};
    mw_status status = mw_polygons_create(rings, &options, &made->polygons, error);
    if (status) return status;
    return mw_locator_create(mw_polygons_mesh(made->polygons), &locating, &made->locator, error);
}

/* polygons_from_rings(points, segments, polygon, threads, progress): two points a segment, and its
 * polygon, as uint32 */
static PyObject *polygons_from_rings(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *points, *segments, *polygon, *function;
    mw_progress progress;
    uint32_t threads;
    buffer_points rows;
    Py_buffer ends, owner;
    size_t count;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOO&O", &points, &segments, &polygon, option_threads, &threads,
                          &function) ||
        buffer_get_points(points, 2, &rows))
        return NULL;
    if (buffer_get_all(polygon, sizeof(uint32_t), &owner, &count)) {
        PyBuffer_Release(&rows.view);
        return NULL;
    }
    if (buffer_get_packed(segments, 2 * sizeof(uint32_t), count, &ends)) {
        PyBuffer_Release(&owner);
        PyBuffer_Release(&rows.view);
        return NULL;
    }
    polygons_object *object = objects_new((PyObject *)state->polygons_type, state->polygons_type);
    status = MW_OK;
    if (object) {
        const mw_constraints rings = {
            .points = rows.points,
            .point_count = rows.count,
            .stride = rows.stride,
            .segments = ends.buf,
            .segment_count = count,
            .polygon = owner.buf,
        };
        const mw_progress *watching = progress_begin(state, function, &progress);
        object->state = state;
        Py_BEGIN_ALLOW_THREADS
        status = polygons_make(&rings, watching, threads, object, &error);
        Py_END_ALLOW_THREADS
    }
    PyBuffer_Release(&ends);
    PyBuffer_Release(&owner);
    PyBuffer_Release(&rows.view);
    if (!status) return (PyObject *)object;
    Py_DECREF(object);
    return errors_raise(state, &error);
}

/* Twice through the points: how many polygons, then which. */
static mw_status polygons_fill(const polygons_object *object, const buffer_points *points,
                               polygons_list *list, mw_error *error)
{
    size_t total = 0;
    for (int turn = 0; turn < 2; turn++) {
        for (size_t i = 0, at = 0; i < points->count; i++) {
            mw_polygon_hit *room = turn ? list->hits + at : NULL;
            size_t capacity = turn ? list->offsets[i + 1] - list->offsets[i] : 0;
            size_t count = mw_polygons_at(object->polygons, points->points + i * points->stride,
                                          &list->locations[i], room, capacity);
            at += count;
            list->offsets[i + 1] = total = at;
        }
        if (turn) break;
        list->hits = malloc((total + 1) * sizeof *list->hits);
        if (list->hits) continue;
        *error = (mw_error){.status = MW_ERROR_MEMORY};
        return MW_ERROR_MEMORY;
    }
    return MW_OK;
}

static mw_status polygons_locate(const polygons_object *object, const buffer_points *points,
                                 const mw_query_options *options, polygons_list *list,
                                 mw_error *error)
{
    list->locations = malloc((points->count + 1) * sizeof *list->locations);
    list->offsets = calloc(points->count + 1, sizeof *list->offsets);
    if (!list->locations || !list->offsets) {
        *error = (mw_error){.status = MW_ERROR_MEMORY};
        return MW_ERROR_MEMORY;
    }
    mw_status status = mw_locate_batch(object->locator, points->points, points->count,
                                       points->stride, options, list->locations, NULL, error);
    return status ? status : polygons_fill(object, points, list, error);
}

/* at(points, threads, progress): memory of offsets (uint64), and of polygons with 1 on a border
 * (uint32 each) */
static PyObject *polygons_at(PyObject *self, PyObject *args)
{
    polygons_object *object = (polygons_object *)self;
    PyObject *points, *function;
    mw_progress progress;
    mw_query_options options = {0};
    polygons_list list = {0};
    buffer_points rows;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO&O", &points, option_threads, &options.threads, &function) ||
        buffer_get_points(points, 2, &rows))
        return NULL;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = polygons_locate(object, &rows, &options, &list, &error);
    Py_END_ALLOW_THREADS
    const size_t count = rows.count, hits = status ? 0 : list.offsets[count];
    PyBuffer_Release(&rows.view);
    free(list.locations);
    if (status) {
        free(list.hits);
        free(list.offsets);
        return errors_raise(object->state, &error);
    }
    PyObject *offsets = memory_new(object->state, list.offsets, (count + 1) * sizeof(uint64_t));
    PyObject *found = memory_new(object->state, list.hits, hits * sizeof(mw_polygon_hit));
    if (offsets && found) return Py_BuildValue("(NN)", offsets, found);
    Py_XDECREF(offsets);
    Py_XDECREF(found);
    return NULL;
}

/* crossing(): the polygons whose own segments cross, as a list */
static PyObject *polygons_crossing(PyObject *self, PyObject *unused)
{
    const polygons_object *object = (polygons_object *)self;
    const size_t count = mw_polygons_crossing(object->polygons, NULL, 0);
    uint32_t *numbers = malloc((count + 1) * sizeof *numbers);
    (void)unused;
    if (!numbers) return PyErr_NoMemory();
    mw_polygons_crossing(object->polygons, numbers, count);
    return memory_new(object->state, numbers, count * sizeof *numbers);
}

/* describe(): polygons, vertices, bytes of all but the mesh */
static PyObject *polygons_describe(PyObject *self, PyObject *unused)
{
    const polygons_object *object = (polygons_object *)self;
    mw_polygons_info info;
    (void)unused;
    mw_polygons_describe(object->polygons, &info);
    return Py_BuildValue("(IIn)", info.polygons,
                         mw_mesh_vertex_count(mw_polygons_mesh(object->polygons)),
                         (Py_ssize_t)info.bytes);
}

static PyMethodDef polygons_methods[] = {
    {"at", polygons_at, METH_VARARGS, NULL},
    {"crossing", polygons_crossing, METH_NOARGS, NULL},
    {"describe", polygons_describe, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot polygons_slots[] = {
    {Py_tp_doc, "Polygons of the library."},
    {Py_tp_dealloc, polygons_dealloc},
    {Py_tp_methods, polygons_methods},
    {0, NULL},
};

static PyType_Spec polygons_spec = {
    .name = "meshwalk._core.Polygons",
    .basicsize = sizeof(polygons_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = polygons_slots,
};

static PyMethodDef polygons_functions[] = {
    {"polygons_from_rings", polygons_from_rings, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int polygons_init(PyObject *module, core_state *state)
{
    state->polygons_type = objects_add_type(module, &polygons_spec);
    return state->polygons_type ? PyModule_AddFunctions(module, polygons_functions) : -1;
}
