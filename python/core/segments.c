/* segments.c - the pieces of segments: memory of offsets and pieces. */
#include "core.h"

/* Tuple of memory: offsets (size_t), pieces (mw_segment_piece). Takes what is in `pieces`. */
static PyObject *segments_wrap(core_state *state, mw_segment_pieces *pieces)
{
    PyObject *offset, *piece;
    size_t *offsets = pieces->offset;
    mw_segment_piece *all = pieces->piece;
    size_t offset_bytes = (pieces->segment_count + 1) * sizeof *offsets,
           piece_bytes = pieces->piece_count * sizeof *all;
    *pieces = (mw_segment_pieces){0};
    offset = memory_new(state, offsets, offset_bytes);
    piece = memory_new(state, all, piece_bytes);
    if (offset && piece) return Py_BuildValue("NN", offset, piece);
    Py_XDECREF(offset);
    Py_XDECREF(piece);
    return NULL;
}

/* Arguments: ends (rows of four doubles), threads, progress. */
PyObject *segments_follow(core_state *state, const mw_locator *locator, PyObject *args)
{
    PyObject *ends, *function;
    mw_segment_options options = {0};
    mw_progress progress;
    buffer_points points;
    mw_segment_pieces pieces;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO&O", &ends, option_threads, &options.threads, &function) ||
        buffer_get_points(ends, 4, &points))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_segment_batch(locator, points.points, points.count, points.stride, &options,
                              &pieces, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&points.view);
    return status ? errors_raise(state, &error) : segments_wrap(state, &pieces);
}

static void segments_weigh(const mw_mesh *mesh, const buffer_points *ends, const int64_t *segment,
                           const mw_segment_piece *piece, size_t count, double *weights,
                           double *points)
{
    for (size_t i = 0; i < count; i++) {
        const double *a = ends->points + (size_t)segment[i] * ends->stride;
        for (int end = 0; end < 2; end++, weights += 3, points += 2)
            mw_segment_weights(mesh, a, a + 2, &piece[i], end, weights, points);
    }
}

/* Are these pieces of segments of this mesh? */
static int segments_check(const mw_mesh *mesh, const buffer_points *ends, const int64_t *segment,
                          const mw_segment_piece *piece, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (segment[i] < 0 || (size_t)segment[i] >= ends->count ||
            piece[i].triangle >= mw_mesh_triangle_count(mesh)) {
            PyErr_SetString(PyExc_ValueError, "these are not pieces of this mesh");
            return -1;
        }
    return 0;
}

/* segment_weights(mesh, ends, segment, pieces, weights, points): for both ends of each piece three
 * weights and two coordinates are written; segment (int64) tells the segment of each piece */
static PyObject *segments_weights(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *mesh, *given[5];
    buffer_points ends;
    Py_buffer view[4];
    static const size_t sizes[4] = {sizeof(int64_t), sizeof(mw_segment_piece), 6 * sizeof(double),
                                    4 * sizeof(double)};
    size_t count = 0;
    int got = 0;
    if (!PyArg_ParseTuple(args, "O!OOOOO", state->mesh_type, &mesh, &given[0], &given[1], &given[2],
                          &given[3], &given[4]) ||
        buffer_get_points(given[0], 4, &ends))
        return NULL;
    if (!buffer_get_all(given[1], sizes[0], &view[0], &count)) {
        for (got = 1; got < 4; got++)
            if (got == 1 ? buffer_get_packed(given[2], sizes[1], count, &view[1])
                         : buffer_get_writable(given[got + 1], sizes[got], count, &view[got]))
                break;
        if (got == 4 &&
            !segments_check(((mesh_object *)mesh)->mesh, &ends, view[0].buf, view[1].buf, count)) {
            Py_BEGIN_ALLOW_THREADS
            segments_weigh(((mesh_object *)mesh)->mesh, &ends, view[0].buf, view[1].buf, count,
                           view[2].buf, view[3].buf);
            Py_END_ALLOW_THREADS
        }
    }
    for (int i = 0; i < got; i++) PyBuffer_Release(&view[i]);
    PyBuffer_Release(&ends.view);
    if (PyErr_Occurred()) return NULL;
    Py_RETURN_NONE;
}

static PyMethodDef segments_functions[] = {
    {"segment_weights", segments_weights, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int segments_init(PyObject *module)
{
    return PyModule_AddFunctions(module, segments_functions);
}
