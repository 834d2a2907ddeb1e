/* objects.c - memory of objects whose classes are derived from in Python. */
#include "core.h"

void *objects_new(PyObject *class, PyTypeObject *type)
{
    allocfunc allocate;
    if (!PyType_Check(class) || !PyType_IsSubtype((PyTypeObject *)class, type)) {
        PyErr_Format(PyExc_TypeError, "expected a class derived from %R, got %R", type, class);
        return NULL;
    }
    allocate = (allocfunc)PyType_GetSlot((PyTypeObject *)class, Py_tp_alloc);
    return allocate((PyTypeObject *)class, 0);
}

void objects_free(PyObject *object)
{
    PyTypeObject *type = Py_TYPE(object);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    release(object);
    Py_DECREF(type);
}

PyTypeObject *objects_add_type(PyObject *module, PyType_Spec *spec)
{
    PyTypeObject *type = (PyTypeObject *)PyType_FromModuleAndSpec(module, spec, NULL);
    if (type && PyModule_AddType(module, type)) Py_CLEAR(type);
    return type;
}
