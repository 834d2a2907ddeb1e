/* borrowed.c - location in arrays that stay the caller's: a view of them for each call. */
#include "core.h"

/* What a call has: arrays, points and room for where they lie. */
typedef struct borrowed_call {
    buffer_mesh mesh;
    Py_buffer neighbours;
    buffer_batch batch;
    mw_borrowed_arrays arrays;
} borrowed_call;

/* 0, or -1 with an exception; released by borrowed_release. */
static int borrowed_get(PyObject *const arrays[3], PyObject *points, PyObject *out,
                        borrowed_call *call)
{
    size_t size;
    if (buffer_get_mesh(arrays[0], arrays[1], 2, &call->mesh)) return -1;
    size = call->mesh.arrays.integer_type == MW_INT64 ? sizeof(int64_t) : sizeof(int32_t);
    if (buffer_get_packed(arrays[2], size, 3 * call->mesh.arrays.triangle_count,
                          &call->neighbours)) {
        buffer_release_mesh(&call->mesh);
        return -1;
    }
    call->arrays.mesh = call->mesh.arrays;
    call->arrays.neighbours = call->neighbours.buf;
    if (buffer_get_batch(points, 2, out, sizeof(mw_location), Py_None, &call->batch) == 0) return 0;
    PyBuffer_Release(&call->neighbours);
    buffer_release_mesh(&call->mesh);
    return -1;
}

static void borrowed_release(borrowed_call *call)
{
    buffer_release_batch(&call->batch);
    PyBuffer_Release(&call->neighbours);
    buffer_release_mesh(&call->mesh);
}

static mw_status borrowed_run(const borrowed_call *call, const mw_borrow_options *options,
                              const mw_borrowed_query_options *query, int *convex, mw_error *error)
{
    mw_borrowed *mesh;
    mw_borrowed_info info;
    mw_status status = mw_mesh_borrow(&call->arrays, options, &mesh, error);
    if (status) return status;
    mw_borrowed_describe(mesh, &info);
    *convex = info.convex;
    if (call->batch.points.count > 0)
        status = mw_borrowed_locate_batch(mesh, call->batch.points.points, call->batch.points.count,
                                          call->batch.points.stride, query, call->batch.out.buf,
                                          NULL, error);
    mw_borrowed_release(mesh);
    return status;
}

/* borrowed_locate(points, triangles, neighbours, across_edge, unchecked, convex, xy, out, walk,
 * threads, progress): do the triangles fill their convex hull, as far as that is known? */
static PyObject *borrowed_locate(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *arrays[3], *points, *out, *function;
    mw_progress progress;
    mw_borrow_options options = {0};
    mw_borrowed_query_options query = {0};
    borrowed_call call = {0};
    const char *walk;
    int across, convex = 0;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOpppOOsO&O", &arrays[0], &arrays[1], &arrays[2], &across,
                          &options.unchecked, &options.convex, &points, &out, &walk, option_threads,
                          &query.threads, &function))
        return NULL;
    query.walk = mw_walk_by_name(walk);
    if (query.walk == MW_WALK_COUNT)
        return option_raise_unknown("walk", walk, option_walk_name, MW_WALK_COUNT);
    if (borrowed_get(arrays, points, out, &call)) return NULL;
    call.arrays.layout = across ? MW_NEIGHBOUR_ACROSS_EDGE : MW_NEIGHBOUR_OPPOSITE;
    options.threads = query.threads;
    options.progress = query.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = borrowed_run(&call, &options, &query, &convex, &error);
    Py_END_ALLOW_THREADS
    borrowed_release(&call);
    return status ? errors_raise(state, &error) : PyBool_FromLong(convex);
}

static PyMethodDef borrowed_functions[] = {
    {"borrowed_locate", borrowed_locate, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int borrowed_init(PyObject *module)
{
    return PyModule_AddFunctions(module, borrowed_functions);
}
