/* points.c - points in files: all rows of a table, read at once. */
#include "core.h"

#include <stdlib.h>
#include <string.h>

/* Rows that were read; grows as they come. */
typedef struct point_rows {
    double *values;
    size_t count, capacity, width;
} point_rows;

enum { POINT_ROWS_BLOCK = 65536 };

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

static mw_status point_rows_read(point_rows *rows, mw_point_reader *reader, mw_error *error)
{
    mw_status status = MW_OK;
    size_t more = 1;
    rows->width = mw_point_reader_width(reader);
    while (!status && more) {
        if (rows->count == rows->capacity) status = point_rows_grow(rows, error);
        if (!status)
            status = mw_point_reader_read(reader, rows->values + rows->count * rows->width,
                                          rows->capacity - rows->count, &more, error);
        if (!status) rows->count += more;
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

/* read_points(path as bytes, columns as bytes or None, 256 classes as bytes) */
static PyObject *points_read(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    const char *path, *classes;
    Py_ssize_t size;
    mw_point_reader_options options = {0};
    mw_point_reader *reader;
    point_rows rows = {0};
    PyObject *result;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "yzy#", &path, &options.columns, &classes, &size)) return NULL;
    if (size != sizeof options.classes)
        return PyErr_Format(PyExc_ValueError, "expected 256 classes");
    memcpy(options.classes, classes, sizeof options.classes);
    Py_BEGIN_ALLOW_THREADS
    status = mw_point_reader_open(path, &options, &reader, &error);
    if (!status) status = point_rows_read(&rows, reader, &error);
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
