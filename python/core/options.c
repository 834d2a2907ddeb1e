/* options.c - options, checked: numbers, for "O&" of PyArg_ParseTuple, and names. */
#include "core.h"

int option_uint32(PyObject *object, void *number)
{
    PyObject *whole = PyNumber_Index(object); /* NumPy's integers, too */
    if (!whole) return 0;
    const unsigned long value = PyLong_AsUnsignedLong(whole);
    int large = value > UINT32_MAX;
    Py_DECREF(whole);
    if (value == (unsigned long)-1 && PyErr_Occurred()) {
        if (!PyErr_ExceptionMatches(PyExc_OverflowError)) return 0;
        PyErr_Clear();
        large = 1;
    }
    if (large) {
        PyErr_Format(PyExc_OverflowError, "%R is not from 0 to 2**32 - 1", object);
        return 0;
    }
    *(uint32_t *)number = (uint32_t)value;
    return 1;
}

int option_threads(PyObject *object, void *number)
{
    PyObject *index = PyNumber_Index(object); /* a NumPy integer will do */
    unsigned long value = index ? PyLong_AsUnsignedLong(index) : 0;
    const int whole = index != NULL;
    Py_XDECREF(index);
    if (!PyErr_Occurred() && value <= UINT32_MAX) {
        *(uint32_t *)number = (uint32_t)value;
        return 1;
    }
    PyErr_Clear();
    if (whole)
        PyErr_Format(PyExc_ValueError, "threads must be from 0 to 2**32 - 1, not %R", object);
    else
        PyErr_Format(PyExc_TypeError, "threads must be a whole number, not %R", object);
    return 0;
}

const char *option_walk_name(int walk)
{
    return mw_walk_name((mw_walk_kind)walk);
}

const char *option_start_name(int start)
{
    return mw_start_name((mw_start_kind)start);
}

/* A tuple of names; NULL with an exception. */
static PyObject *option_list_names(const char *(*name_of)(int), int count)
{
    PyObject *names = PyTuple_New(count);
    for (int i = 0; names && i < count; i++) {
        PyObject *text = PyUnicode_FromString(name_of(i));
        if (!text || PyTuple_SetItem(names, i, text)) Py_CLEAR(names);
    }
    return names;
}

static int option_add_names(PyObject *module, const char *attribute, const char *(*name_of)(int),
                            int count)
{
    PyObject *names = option_list_names(name_of, count);
    const int failed = !names || PyModule_AddObjectRef(module, attribute, names);
    Py_XDECREF(names);
    return failed ? -1 : 0;
}

int options_init(PyObject *module)
{
    return option_add_names(module, "WALK_NAMES", option_walk_name, MW_WALK_COUNT) ||
                   option_add_names(module, "START_NAMES", option_start_name, MW_START_COUNT)
               ? -1
               : 0;
}

PyObject *option_raise_unknown(const char *what, const char *name, const char *(*name_of)(int),
                               int count)
{
    PyObject *comma = PyUnicode_FromString(", "), *names = option_list_names(name_of, count), *all;
    all = comma && names ? PyUnicode_Join(comma, names) : NULL;
    if (all) PyErr_Format(PyExc_ValueError, "there is no %s '%s'; there are %U", what, name, all);
    Py_XDECREF(all);
    Py_XDECREF(names);
    Py_XDECREF(comma);
    return NULL;
}

int option_uint64(PyObject *object, void *number)
{
    PyObject *whole = PyNumber_Index(object);
    if (!whole) return 0;
    unsigned long long value = PyLong_AsUnsignedLongLong(whole);
    Py_DECREF(whole);
    if (value == (unsigned long long)-1 && PyErr_Occurred()) return 0;
    *(uint64_t *)number = value;
    return 1;
}
