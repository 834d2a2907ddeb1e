/* errors.c - exceptions: what a mw_error becomes in Python.
 *
 * MW_ERROR_INPUT and MW_ERROR_LIMIT become meshwalk.InputError and meshwalk.LimitError, with the
 * place as attributes; the others the exceptions that Python has for them. */
#include "core.h"

#include <string.h>

int errors_init(core_state *state)
{
    PyObject *module = PyImport_ImportModule("meshwalk._errors");
    if (!module) return -1;
    state->input_error = PyObject_GetAttrString(module, "InputError");
    state->limit_error = PyObject_GetAttrString(module, "LimitError");
    Py_DECREF(module);
    return state->input_error && state->limit_error ? 0 : -1;
}

/* A number of the error, or None for -1. */
static int errors_set_place(PyObject *exception, const char *name, int64_t number)
{
    PyObject *value = number < 0 ? Py_NewRef(Py_None) : PyLong_FromLongLong(number);
    int failed = !value || PyObject_SetAttrString(exception, name, value);
    Py_XDECREF(value);
    return failed;
}

/* The class, called with the message. Names of files that are no text are shown escaped. */
static PyObject *errors_new(PyObject *class, const mw_error *error)
{
    const Py_ssize_t length = (Py_ssize_t)strlen(error->message);
    PyObject *text = PyUnicode_DecodeUTF8(error->message, length, "backslashreplace");
    PyObject *exception = text ? PyObject_CallFunctionObjArgs(class, text, NULL) : NULL;
    Py_XDECREF(text);
    return exception;
}

static PyObject *errors_raise_plain(PyObject *class, const mw_error *error)
{
    PyObject *exception = errors_new(class, error);
    if (exception) PyErr_SetObject(class, exception);
    Py_XDECREF(exception);
    return NULL;
}

static PyObject *errors_raise_placed(PyObject *class, const mw_error *error)
{
    PyObject *exception = errors_new(class, error);
    if (!exception) return NULL;
    if (!errors_set_place(exception, "triangle", error->triangle) &&
        !errors_set_place(exception, "vertex", error->vertex) &&
        !errors_set_place(exception, "line", error->line))
        PyErr_SetObject(class, exception);
    Py_DECREF(exception);
    return NULL;
}

PyObject *errors_raise(core_state *state, const mw_error *error)
{
    switch (error->status) {
    case MW_ERROR_INPUT: return errors_raise_placed(state->input_error, error);
    case MW_ERROR_LIMIT: return errors_raise_placed(state->limit_error, error);
    case MW_CANCELLED: /* by the exception that a report has left */
        return PyErr_Occurred() ? NULL : errors_raise_plain(PyExc_RuntimeError, error);
    case MW_ERROR_MEMORY: return PyErr_NoMemory();
    case MW_ERROR_SYSTEM: return errors_raise_plain(PyExc_OSError, error);
    default: return errors_raise_plain(PyExc_ValueError, error);
    }
}
