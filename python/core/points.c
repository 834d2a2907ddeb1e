/* points.c - points in files: all rows of a table, read at once. */
#include "core.h"

#include <stdlib.h>
#include <string.h>

/* Rows that were read; grows as they come. */
typedef struct point_rows {
    double *values;
    size_t count, capacity, width;
} point_rows;

enum { POINT_ROWS_BLOCK = 65536, POINT_ROWS_AT_A_TIME = 1 << 20 };

static mw_status point_rows_grow(point_rows *rows, mw_error *error)
{
    const size_t capacity = rows->capacity ? 2 * rows->capacity : POINT_ROWS_BLOCK;
    double *values = realloc(rows->values, capacity * rows->width * sizeof(double));
    if (!values) {
        error->status = MW_ERROR_MEMORY;
        return MW_ERROR_MEMORY;
    }
    rows->values = values;
    rows->capacity = capacity;
    return MW_OK;
}

/* The next rows have been read. Returns MW_CANCELLED if that is enough. */
static mw_status point_rows_report(const mw_point_reader *reader, const mw_progress *progress,
                                   int ended, mw_error *error)
{
    const double fraction = mw_point_reader_fraction(reader);
    if (!progress || (fraction < 0 && !ended)) return MW_OK;
    if (!progress->report(progress->context, "reading points", ended ? 1 : fraction) || ended)
        return MW_OK;
    return error->status = MW_CANCELLED;
}

static mw_status point_rows_read(point_rows *rows, mw_point_reader *reader,
                                 const mw_progress *progress, mw_error *error)
{
    mw_status status = MW_OK;
    size_t more = 1;
    rows->width = mw_point_reader_width(reader);
    while (!status && more) {
        size_t room;
        if (rows->count == rows->capacity) status = point_rows_grow(rows, error);
        if (status) break;
        room = rows->capacity - rows->count;
        if (room > POINT_ROWS_AT_A_TIME) room = POINT_ROWS_AT_A_TIME;
        status = mw_point_reader_read(reader, rows->values + rows->count * rows->width, room, &more,
                                      error);
        if (status) break;
        rows->count += more;
        status = point_rows_report(reader, progress, more == 0, error);
    }
    return status;
}

/* [name] */
static PyObject *points_column_names(const mw_point_reader *reader)
{
    PyObject *list = PyList_New(0);
    const char *name;
    for (size_t i = 0; list && (name = mw_point_reader_column(reader, i)); i++) {
        PyObject *text = PyUnicode_DecodeUTF8(name, (Py_ssize_t)strlen(name), "surrogateescape");
        if (!text || PyList_Append(list, text)) Py_CLEAR(list);
        Py_XDECREF(text);
    }
    return list;
}

/* (memory of the rows, names of the columns) */
static PyObject *points_result(core_state *state, point_rows *rows, const mw_point_reader *reader)
{
    PyObject *values = memory_new(state, rows->values, rows->count * rows->width * sizeof(double));
    PyObject *names = values ? points_column_names(reader) : NULL;
    PyObject *result = names ? Py_BuildValue("OO", values, names) : NULL;
    Py_XDECREF(values);
    Py_XDECREF(names);
    return result;
}

/* read_points(path as bytes, columns as bytes or None, 256 classes as bytes, progress) */
static PyObject *points_read(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    const char *path, *classes;
    Py_ssize_t size;
    mw_point_reader_options options = {0};
    mw_point_reader *reader;
    point_rows rows = {0};
    PyObject *result, *function;
    mw_progress progress;
    const mw_progress *watching;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "yzy#O", &path, &options.columns, &classes, &size, &function))
        return NULL;
    if (size != sizeof options.classes)
        return PyErr_Format(PyExc_ValueError, "expected 256 classes");
    memcpy(options.classes, classes, sizeof options.classes);
    watching = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_point_reader_open(path, &options, &reader, &error);
    if (!status) status = point_rows_read(&rows, reader, watching, &error);
    Py_END_ALLOW_THREADS
    if (status) {
        free(rows.values);
        mw_point_reader_close(reader);
        return errors_raise(state, &error);
    }
    result = points_result(state, &rows, reader);
    mw_point_reader_close(reader);
    return result;
}

static PyMethodDef points_functions[] = {
    {"read_points", points_read, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int points_init(PyObject *module)
{
    return PyModule_AddFunctions(module, points_functions);
}
