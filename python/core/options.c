/* options.c - numbers of options, checked: for "O&" of PyArg_ParseTuple. */
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
