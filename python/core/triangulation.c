/* triangulation.c - meshes made of points, with and without constraints. */
#include "core.h"

#include <string.h>

/* Points, and the array that tells which of them are duplicates. */
typedef struct triangulation_input {
    buffer_points points;
    Py_buffer duplicate_of;
} triangulation_input;

static int triangulation_get_input(PyObject *points, PyObject *duplicates, triangulation_input *in)
{
    if (buffer_get_points(points, 2, &in->points)) return -1;
    if (!buffer_get_writable(duplicates, sizeof(uint32_t), in->points.count, &in->duplicate_of))
        return 0;
    PyBuffer_Release(&in->points.view);
    return -1;
}

static void triangulation_release_input(triangulation_input *in)
{
    PyBuffer_Release(&in->points.view);
    PyBuffer_Release(&in->duplicate_of);
}

/* delaunay(cls, points, duplicate_of, threads, progress): a mesh and the number of duplicates */
static PyObject *triangulation_delaunay(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    mw_progress progress;
    PyObject *function, *class, *points, *duplicates, *object;
    mw_delaunay_options options = {0};
    mw_delaunay_report report;
    triangulation_input in;
    mw_mesh *mesh;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOO&O", &class, &points, &duplicates, option_threads,
                          &options.threads, &function) ||
        triangulation_get_input(points, duplicates, &in))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_delaunay(in.points.points, in.points.count, in.points.stride, &options,
                         in.duplicate_of.buf, &report, &mesh, &error);
    Py_END_ALLOW_THREADS
    triangulation_release_input(&in);
    if (status) return errors_raise(state, &error);
    object = mesh_new(state, class, mesh);
    return object ? Py_BuildValue("Nn", object, (Py_ssize_t)report.duplicates) : NULL;
}

static const char *triangulation_kind_name(int kind)
{
    return mw_kind_name((mw_triangulation_kind)kind);
}

/* The kind of a name; MW_KIND_COUNT with an exception for none. */
static mw_triangulation_kind triangulation_kind_by_name(const char *name)
{
    for (int kind = 0; kind < MW_KIND_COUNT; kind++)
        if (strcmp(mw_kind_name((mw_triangulation_kind)kind), name) == 0)
            return (mw_triangulation_kind)kind;
    option_raise_unknown("kind of triangulation", name, triangulation_kind_name, MW_KIND_COUNT);
    return MW_KIND_COUNT;
}

/* The weights of a regular triangulation; *view stays empty without any. 0, or -1 with an
 * exception. */
static int triangulation_get_weights(PyObject *weights, triangulation_input *in, Py_buffer *view)
{
    if (weights == Py_None || !buffer_get_packed(weights, sizeof(double), in->points.count, view))
        return 0;
    triangulation_release_input(in);
    return -1;
}

/* triangulate(cls, points, duplicate_of, kind, weights, limit, threads, progress): a mesh, the
 * number of duplicates, and whether it is optimal */
static PyObject *triangulation_of_kind(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    mw_progress progress;
    PyObject *function, *class, *points, *duplicates, *weights, *object;
    Py_buffer weight_view = {0};
    const char *name;
    mw_triangulation_kind kind;
    mw_kind_options options = {0};
    mw_kind_report report;
    triangulation_input in;
    mw_mesh *mesh;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOsOO&O&O", &class, &points, &duplicates, &name, &weights,
                          option_uint32, &options.limit, option_threads, &options.threads,
                          &function) ||
        (kind = triangulation_kind_by_name(name)) == MW_KIND_COUNT ||
        triangulation_get_input(points, duplicates, &in) ||
        triangulation_get_weights(weights, &in, &weight_view))
        return NULL;
    options.weights = weight_view.buf;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_triangulate(kind, in.points.points, in.points.count, in.points.stride, &options,
                            in.duplicate_of.buf, &report, &mesh, &error);
    Py_END_ALLOW_THREADS
    triangulation_release_input(&in);
    if (weight_view.buf) PyBuffer_Release(&weight_view);
    if (status) return errors_raise(state, &error);
    object = mesh_new(state, class, mesh);
    if (!object) return NULL;
    return Py_BuildValue("NnN", object, (Py_ssize_t)report.delaunay.duplicates,
                         PyBool_FromLong(report.optimal));
}

/* Beside the points: the buffers of segments, their polygons, and seeds of holes. */
typedef struct triangulation_constraints {
    triangulation_input in;
    Py_buffer segments, polygons;
    buffer_points seeds;
    mw_constraints given;
} triangulation_constraints;

static int triangulation_get_segments(PyObject *segments, PyObject *polygons,
                                      triangulation_constraints *c)
{
    size_t count;
    if (buffer_get_all(segments, 2 * sizeof(uint32_t), &c->segments, &count)) return -1;
    c->given.segments = c->segments.buf;
    c->given.segment_count = count;
    if (polygons == Py_None) return 0;
    if (!buffer_get_packed(polygons, sizeof(uint32_t), count, &c->polygons)) {
        c->given.polygon = c->polygons.buf;
        return 0;
    }
    PyBuffer_Release(&c->segments);
    return -1;
}

static void triangulation_release_segments(triangulation_constraints *c)
{
    PyBuffer_Release(&c->segments);
    if (c->given.polygon) PyBuffer_Release(&c->polygons);
}

static void triangulation_release_constraints(triangulation_constraints *c)
{
    triangulation_release_input(&c->in);
    triangulation_release_segments(c);
    PyBuffer_Release(&c->seeds.view);
}

/* Seeds have no gaps between their rows. */
static int triangulation_get_seeds(PyObject *seeds, triangulation_constraints *c)
{
    if (buffer_get_points(seeds, 2, &c->seeds)) return -1;
    c->given.hole_seeds = c->seeds.points;
    c->given.hole_seed_count = c->seeds.count;
    if (c->seeds.stride == 2) return 0;
    PyErr_SetString(PyExc_ValueError, "expected seeds without gaps");
    PyBuffer_Release(&c->seeds.view);
    return -1;
}

static int triangulation_get_constraints(PyObject *const *objects, triangulation_constraints *c)
{
    if (triangulation_get_input(objects[0], objects[1], &c->in)) return -1;
    if (triangulation_get_segments(objects[2], objects[3], c)) {
        triangulation_release_input(&c->in);
        return -1;
    }
    if (triangulation_get_seeds(objects[4], c)) {
        triangulation_release_segments(c);
        triangulation_release_input(&c->in);
        return -1;
    }
    c->given.points = c->in.points.points;
    c->given.point_count = c->in.points.count;
    c->given.stride = c->in.points.stride;
    return 0;
}

/* The error, with the numbers of the segments that cross. */
static PyObject *triangulation_raise(core_state *state, const mw_error *error,
                                     const mw_constrain_report *report)
{
    PyObject *type, *value, *trace, *segments;
    errors_raise(state, error);
    if (report->crossing_segments[0] == MW_NONE) return NULL;
    PyErr_Fetch(&type, &value, &trace);
    PyErr_NormalizeException(&type, &value, &trace);
    segments = Py_BuildValue("II", report->crossing_segments[0], report->crossing_segments[1]);
    if (segments && PyObject_SetAttrString(value, "segments", segments)) PyErr_Clear();
    Py_XDECREF(segments);
    PyErr_Restore(type, value, trace);
    return NULL;
}

/* (mesh, number of duplicates, edges, segment of each edge, holes that removed nothing, the first
 * of them) */
static PyObject *triangulation_constrained_result(core_state *state, PyObject *class, mw_mesh *mesh,
                                                  const mw_constrain_report *report,
                                                  mw_constrained_edges *edges)
{
    PyObject *object = mesh_new(state, class, mesh);
    PyObject *ends = memory_new(state, edges->edge, 2 * edges->count * sizeof(uint32_t));
    PyObject *segments = memory_new(state, edges->segment, edges->count * sizeof(uint32_t));
    PyObject *result =
        object && ends && segments
            ? Py_BuildValue("OnOOnn", object, (Py_ssize_t)report->delaunay.duplicates, ends,
                            segments, (Py_ssize_t)report->idle_holes,
                            (Py_ssize_t)report->first_idle_hole)
            : NULL;
    Py_XDECREF(object);
    Py_XDECREF(ends);
    Py_XDECREF(segments);
    return result;
}

/* constrained_delaunay(cls, points, duplicate_of, segments, polygons or None, seeds, keep, split,
 * threads, progress) */
static PyObject *triangulation_constrained(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    mw_progress progress;
    PyObject *function, *class, *objects[5];
    int keep;
    mw_constrain_options options = {0};
    mw_constrain_report report = {.crossing_segments = {MW_NONE, MW_NONE}};
    mw_constrained_edges edges = {0};
    triangulation_constraints c = {0};
    mw_mesh *mesh;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOOOOipO&O", &class, &objects[0], &objects[1], &objects[2],
                          &objects[3], &objects[4], &keep, &options.split, option_threads,
                          &options.threads, &function) ||
        triangulation_get_constraints(objects, &c))
        return NULL;
    options.keep = (mw_keep)keep;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_constrained_delaunay(&c.given, &options, c.in.duplicate_of.buf, &report, &edges,
                                     &mesh, &error);
    Py_END_ALLOW_THREADS
    triangulation_release_constraints(&c);
    if (status) return triangulation_raise(state, &error, &report);
    return triangulation_constrained_result(state, class, mesh, &report, &edges);
}

static PyMethodDef triangulation_functions[] = {
    {"delaunay", triangulation_delaunay, METH_VARARGS, NULL},
    {"triangulate", triangulation_of_kind, METH_VARARGS, NULL},
    {"constrained_delaunay", triangulation_constrained, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int triangulation_init(PyObject *module)
{
    return PyModule_AddFunctions(module, triangulation_functions);
}
