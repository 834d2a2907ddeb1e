/* options.c - numbers of options, checked: for "O&" of PyArg_ParseTuple. */
#include "core.h"

int option_uint32(PyObject *object, void *number)
{
    unsigned long value = PyLong_AsUnsignedLong(object);
    if (value == (unsigned long)-1 && PyErr_Occurred()) return 0;
    if (value > UINT32_MAX) {
        PyErr_Format(PyExc_OverflowError, "%lu is more than 2**32 - 1", value);
        return 0;
    }
    *(uint32_t *)number = (uint32_t)value;
    return 1;
}

int option_uint64(PyObject *object, void *number)
{
    unsigned long long value = PyLong_AsUnsignedLongLong(object);
    if (value == (unsigned long long)-1 && PyErr_Occurred()) return 0;
    *(uint64_t *)number = value;
    return 1;
}
