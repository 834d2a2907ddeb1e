/* memory.c - Memory: what the library allocated, as a buffer that NumPy makes an array of, without
 * a copy. */
#include "core.h"

#include <stdint.h>
#include <stdlib.h>

typedef struct memory_object {
    PyObject_HEAD
    PyObject *owner; /* of the bytes; NULL: the object frees them */
    void *bytes;
    size_t size;
} memory_object;

static PyObject *memory_wrap(core_state *state, const memory_object *given)
{
    PyObject *view;
    memory_object *memory = objects_new((PyObject *)state->memory_type, state->memory_type);
    if (!memory) {
        if (!given->owner) free(given->bytes);
        return NULL;
    }
    memory->owner = Py_XNewRef(given->owner);
    memory->bytes = given->bytes;
    memory->size = given->size;
    view = PyMemoryView_FromObject((PyObject *)memory);
    Py_DECREF(memory);
    return view;
}

PyObject *memory_new(core_state *state, void *bytes, size_t size)
{
    const memory_object given = {.bytes = bytes, .size = size};
    return memory_wrap(state, &given);
}

PyObject *memory_borrow(core_state *state, PyObject *owner, const void *bytes, size_t size)
{
    const memory_object given = {.owner = owner, .bytes = (void *)(uintptr_t)bytes, .size = size};
    return memory_wrap(state, &given);
}

static void memory_dealloc(PyObject *self)
{
    memory_object *memory = (memory_object *)self;
    if (!memory->owner) free(memory->bytes);
    Py_XDECREF(memory->owner);
    objects_free(self);
}

static int memory_get_buffer(PyObject *self, Py_buffer *view, int flags)
{
    static char nothing; /* an empty buffer has an address, too */
    memory_object *memory = (memory_object *)self;
    void *bytes = memory->bytes ? memory->bytes : &nothing;
    return PyBuffer_FillInfo(view, self, bytes, (Py_ssize_t)memory->size, memory->owner != NULL,
                             flags);
}

static PyType_Slot memory_slots[] = {
    {Py_tp_doc, "Memory that the library allocated, as a buffer."},
    {Py_tp_dealloc, memory_dealloc},
    {Py_bf_getbuffer, memory_get_buffer},
    {0, NULL},
};

static PyType_Spec memory_spec = {
    .name = "meshwalk._core.Memory",
    .basicsize = sizeof(memory_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = memory_slots,
};

int memory_init(PyObject *module, core_state *state)
{
    state->memory_type = objects_add_type(module, &memory_spec);
    return state->memory_type ? 0 : -1;
}
