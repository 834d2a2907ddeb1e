/* location.c - Location: where one point lies, as an object. */
#include "core.h"

#include <string.h>

typedef struct location_object {
    PyObject_HEAD
    core_state *state;
    mw_location location;
} location_object;

static const mw_location *location_of(PyObject *self)
{
    return &((location_object *)self)->location;
}

PyObject *location_new(core_state *state, const mw_location *location)
{
    location_object *object = PyObject_New(location_object, state->location_type);
    if (!object) return NULL;
    object->state = state;
    object->location = *location;
    return (PyObject *)object;
}

static void location_dealloc(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    PyObject_Free(self);
    Py_DECREF(type);
}

static PyObject *location_number(uint32_t number)
{
    return PyLong_FromLong(number == MW_NONE ? -1 : (long)number);
}

static PyObject *location_triangle(PyObject *self, void *unused)
{
    (void)unused;
    return location_number(location_of(self)->triangle);
}

static PyObject *location_hole(PyObject *self, void *unused)
{
    (void)unused;
    return location_number(location_of(self)->hole);
}

static PyObject *location_where(PyObject *self, void *unused)
{
    (void)unused;
    return PySequence_GetItem(((location_object *)self)->state->where_members,
                              location_of(self)->where);
}

static PyObject *location_local(PyObject *self, void *unused)
{
    const uint8_t local = location_of(self)->local;
    (void)unused;
    return PyLong_FromLong(local == UINT8_MAX ? -1 : local);
}

static PyObject *location_weights(PyObject *self, void *unused)
{
    const double *weight = location_of(self)->weight;
    (void)unused;
    return Py_BuildValue("(ddd)", weight[0], weight[1], weight[2]);
}

static PyObject *location_inside(PyObject *self, void *unused)
{
    (void)unused;
    return PyBool_FromLong(location_of(self)->where <= MW_ON_VERTEX);
}

static PyObject *location_repr(PyObject *self)
{
    const mw_location *location = location_of(self);
    PyObject *text, *weights;
    const char *name = mw_where_name((mw_where)location->where);
    if (location->where == MW_IN_HOLE)
        return PyUnicode_FromFormat("<Location: in hole %u>", location->hole);
    if (location->triangle == MW_NONE) return PyUnicode_FromFormat("<Location: %s>", name);
    weights = location_weights(self, NULL);
    if (!weights) return NULL;
    text = PyUnicode_FromFormat("<Location: %s of triangle %u, weights %S>", name,
                                location->triangle, weights);
    Py_DECREF(weights);
    return text;
}

/* A pickle holds the record as it is. */
static PyObject *location_reduce(PyObject *self, PyObject *unused)
{
    PyObject *module = PyImport_ImportModule("meshwalk._core");
    PyObject *make = module ? PyObject_GetAttrString(module, "location_from_bytes") : NULL;
    PyObject *result = make ? Py_BuildValue("O(y#)", make, (const char *)location_of(self),
                                            (Py_ssize_t)sizeof(mw_location))
                            : NULL;
    (void)unused;
    Py_XDECREF(make);
    Py_XDECREF(module);
    return result;
}

/* location_from_bytes(record) */
static PyObject *location_from_bytes(PyObject *module, PyObject *args)
{
    const char *bytes;
    Py_ssize_t size;
    mw_location location;
    if (!PyArg_ParseTuple(args, "y#", &bytes, &size)) return NULL;
    if (size != sizeof location) return PyErr_Format(PyExc_ValueError, "this is no location");
    memcpy(&location, bytes, sizeof location);
    if (location.where >= MW_WHERE_COUNT)
        return PyErr_Format(PyExc_ValueError, "this is no location");
    return location_new(PyModule_GetState(module), &location);
}

static PyMethodDef location_methods[] = {
    {"__reduce__", location_reduce, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyMethodDef location_functions[] = {
    {"location_from_bytes", location_from_bytes, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyGetSetDef location_members[] = {
    {"triangle", location_triangle, NULL, "Number of the triangle, -1 for none.", NULL},
    {"where", location_where, NULL, "A member of Where: inside, on an edge, outside ...", NULL},
    {"local", location_local, NULL, "The local edge or vertex that the point is on, else -1.",
     NULL},
    {"weights", location_weights, NULL,
     "Weights of the triangle's three vertices; NaN without a triangle.", NULL},
    {"hole", location_hole, NULL, "Number of the hole that the point is in, -1 for none.", NULL},
    {"inside", location_inside, NULL, "True if a triangle contains the point, its border included.",
     NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

static PyType_Slot location_slots[] = {
    {Py_tp_doc, "Where one point lies: the answer of Locator.locate_one."},
    {Py_tp_dealloc, location_dealloc},
    {Py_tp_repr, location_repr},
    {Py_tp_methods, location_methods},
    {Py_tp_getset, location_members},
    {0, NULL},
};

static PyType_Spec location_spec = {
    .name = "meshwalk.Location",
    .basicsize = sizeof(location_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = location_slots,
};

/* The members of meshwalk.Where, which are numbered as those of mw_where. */
static PyObject *location_find_where(void)
{
    PyObject *module = PyImport_ImportModule("meshwalk._where");
    PyObject *class = module ? PyObject_GetAttrString(module, "Where") : NULL;
    PyObject *members = class ? PySequence_Tuple(class) : NULL;
    Py_XDECREF(class);
    Py_XDECREF(module);
    return members;
}

int location_init(PyObject *module, core_state *state)
{
    state->where_members = location_find_where();
    if (!state->where_members) return -1;
    state->location_type = objects_add_type(module, &location_spec);
    return state->location_type ? PyModule_AddFunctions(module, location_functions) : -1;
}
