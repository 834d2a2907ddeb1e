/* buffers.c - arrays of the caller, by the buffer protocol.
 *
 * Python has converted what users gave; here the layout is checked once more, so that no wrong call
 * reaches the library. */
#include "core.h"

/* The letter of a native format, 0 for any other ("<i" is native on a little-endian machine, but
 * NumPy says "i" there). */
static char buffer_letter(const Py_buffer *view)
{
    const char *format = view->format ? view->format : "B";
    return format[0] && !format[1] ? format[0] : 0;
}

/* A two-dimensional array of `letter`, whose rows the library can step over. */
static int buffer_get_rows(PyObject *object, char letter, Py_ssize_t size, Py_buffer *view)
{
    if (PyObject_GetBuffer(object, view, PyBUF_STRIDES | PyBUF_FORMAT)) return -1;
    if (view->ndim == 2 && buffer_letter(view) == letter &&
        (view->shape[0] == 0 || view->shape[1] <= 1 || view->strides[1] == size) &&
        (view->shape[0] <= 1 ||
         (view->strides[0] % size == 0 && view->strides[0] >= size * view->shape[1])))
        return 0;
    PyErr_Format(PyExc_ValueError, "expected rows of '%c' side by side", letter);
    PyBuffer_Release(view);
    return -1;
}

/* From one row to the next, in members. */
static size_t buffer_row_stride(const Py_buffer *view)
{
    return (size_t)(view->shape[0] > 1 ? view->strides[0] / view->itemsize : view->shape[1]);
}

int buffer_get_points(PyObject *object, size_t width, buffer_points *points)
{
    Py_buffer *view = &points->view;
    if (buffer_get_rows(object, 'd', sizeof(double), view)) return -1;
    if (view->shape[1] != (Py_ssize_t)width) {
        PyErr_Format(PyExc_ValueError, "expected rows of %zu doubles", width);
        PyBuffer_Release(view);
        return -1;
    }
    points->points = view->buf;
    points->count = (size_t)view->shape[0];
    points->stride = buffer_row_stride(view);
    return 0;
}

/* Steps of at least one member, all of them whole. */
static int buffer_steps_forward(const Py_buffer *view)
{
    if (view->len == 0) return 1;
    for (int k = 0; k < view->ndim; k++)
        if (view->shape[k] > 1 &&
            (view->strides[k] < view->itemsize || view->strides[k] % view->itemsize))
            return 0;
    return 1;
}

/* From one member to the next along an axis, in members. */
static size_t buffer_step(const Py_buffer *view, int axis)
{
    return view->shape[axis] > 1 ? (size_t)(view->strides[axis] / view->itemsize) : 0;
}

int buffer_get_table(PyObject *object, int narrow, size_t count, buffer_table *table)
{
    Py_buffer *view = &table->view;
    const size_t size = narrow ? sizeof(float) : sizeof(double);
    if (PyObject_GetBuffer(object, view, PyBUF_STRIDES | PyBUF_FORMAT)) return -1;
    if (view->ndim != 2 || buffer_letter(view) != (narrow ? 'f' : 'd') ||
        view->shape[0] != (Py_ssize_t)count || !buffer_steps_forward(view)) {
        PyErr_Format(PyExc_ValueError, "expected %zu rows of '%c', one after the other", count,
                     narrow ? 'f' : 'd');
        PyBuffer_Release(view);
        return -1;
    }
    table->size = size;
    table->table = (mw_value_table){
        .values = view->buf,
        .type = narrow ? MW_FLOAT32 : MW_FLOAT64,
        .count = (size_t)view->shape[1],
        .stride = buffer_step(view, 0),
        .step = buffer_step(view, 1),
    };
    return 0;
}

static int buffer_get_flat(PyObject *object, int flags, size_t size, Py_buffer *view, size_t *count)
{
    if (PyObject_GetBuffer(object, view, flags | PyBUF_C_CONTIGUOUS)) return -1;
    if ((size_t)view->len % size) {
        PyErr_Format(PyExc_ValueError, "expected members of %zu bytes", size);
        PyBuffer_Release(view);
        return -1;
    }
    *count = (size_t)view->len / size;
    return 0;
}

int buffer_get_all(PyObject *object, size_t size, Py_buffer *view, size_t *count)
{
    return buffer_get_flat(object, 0, size, view, count);
}

static int buffer_get_counted(PyObject *object, int flags, size_t size, size_t count,
                              Py_buffer *view)
{
    size_t there;
    if (buffer_get_flat(object, flags, size, view, &there)) return -1;
    if (there == count) return 0;
    PyErr_Format(PyExc_ValueError, "expected %zu members of %zu bytes, got %zu", count, size,
                 there);
    PyBuffer_Release(view);
    return -1;
}

int buffer_get_packed(PyObject *object, size_t size, size_t count, Py_buffer *view)
{
    return buffer_get_counted(object, 0, size, count, view);
}

int buffer_get_writable(PyObject *object, size_t size, size_t count, Py_buffer *view)
{
    return buffer_get_counted(object, PyBUF_WRITABLE, size, count, view);
}

int buffer_get_batch(PyObject *points, size_t width, PyObject *out, size_t size, PyObject *hints,
                     buffer_batch *batch)
{
    batch->hints = (Py_buffer){0};
    if (buffer_get_points(points, width, &batch->points)) return -1;
    if (!buffer_get_writable(out, size, batch->points.count, &batch->out)) {
        if (hints == Py_None ||
            !buffer_get_writable(hints, sizeof(uint32_t), batch->points.count, &batch->hints))
            return 0;
        PyBuffer_Release(&batch->out);
    }
    PyBuffer_Release(&batch->points.view);
    return -1;
}

void buffer_release_batch(buffer_batch *batch)
{
    PyBuffer_Release(&batch->hints); /* does nothing without hints */
    PyBuffer_Release(&batch->out);
    PyBuffer_Release(&batch->points.view);
}

/* The type of vertex numbers; -1 for none that the library takes. */
static int buffer_integer_type(const Py_buffer *view)
{
    const char letter = buffer_letter(view);
    if (view->itemsize == 4 && (letter == 'i' || letter == 'l')) return MW_INT32;
    if (view->itemsize == 4 && (letter == 'I' || letter == 'L')) return MW_UINT32;
    if (view->itemsize == 8 && (letter == 'l' || letter == 'q')) return MW_INT64;
    return -1;
}

int buffer_get_mesh(PyObject *points, PyObject *triangles, size_t width, buffer_mesh *mesh)
{
    Py_buffer *view = &mesh->triangles;
    int type;
    if (buffer_get_points(points, width, &mesh->points)) return -1;
    if (PyObject_GetBuffer(triangles, view, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT)) {
        PyBuffer_Release(&mesh->points.view);
        return -1;
    }
    type = buffer_integer_type(view);
    if (view->ndim != 2 || view->shape[1] != 3 || type < 0) {
        PyErr_SetString(PyExc_ValueError, "expected rows of three int32, uint32 or int64");
        buffer_release_mesh(mesh);
        return -1;
    }
    mesh->arrays = (mw_arrays){
        .points = mesh->points.points,
        .point_count = mesh->points.count,
        .point_stride = mesh->points.stride,
        .triangles = view->buf,
        .triangle_count = (size_t)view->shape[0],
        .integer_type = (mw_integer_type)type,
    };
    return 0;
}

void buffer_release_mesh(buffer_mesh *mesh)
{
    PyBuffer_Release(&mesh->points.view);
    PyBuffer_Release(&mesh->triangles);
}
