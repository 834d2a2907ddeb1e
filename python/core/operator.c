/* operator.c - Operator: a mw_operator as an object. It keeps nothing of its mesh. */
#include "core.h"

#include <string.h>

typedef struct operator_object {
    PyObject_HEAD
    core_state *state;
    mw_operator *weights;
} operator_object;

static mw_operator *operator_of(PyObject *self)
{
    return ((operator_object *)self)->weights;
}

PyObject *operator_new(core_state *state, mw_operator *weights)
{
    operator_object *object = objects_new((PyObject *)state->operator_type, state->operator_type);
    if (!object) {
        mw_operator_destroy(weights);
        return NULL;
    }
    object->state = state;
    object->weights = weights;
    return (PyObject *)object;
}

/* operator_from_locations(mesh, locations, threads, progress) */
static PyObject *operator_from_locations(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *mesh, *locations, *function;
    mw_operator_options options = {0};
    mw_progress progress;
    Py_buffer view;
    size_t count;
    mw_operator *weights;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!OO&O", state->mesh_type, &mesh, &locations, option_threads,
                          &options.threads, &function) ||
        buffer_get_all(locations, sizeof(mw_location), &view, &count))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_operator_create(((mesh_object *)mesh)->mesh, view.buf, count, &options, &weights,
                                &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    return status ? errors_raise(state, &error) : operator_new(state, weights);
}

/* operator_on_surface(surface, kind, records, threads, progress); kind: "locations", "touches" or
 * "nearest" */
static PyObject *operator_on_surface(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *surface, *records, *function;
    const char *kind;
    mw_operator_options options = {0};
    mw_progress progress;
    Py_buffer view;
    size_t count;
    mw_operator *weights;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!sOO&O", state->surface_type, &surface, &kind, &records,
                          option_threads, &options.threads, &function))
        return NULL;
    const int touches = strcmp(kind, "touches") == 0, nearest = strcmp(kind, "nearest") == 0;
    const size_t size = touches   ? sizeof(mw_touch)
                        : nearest ? sizeof(mw_nearest_surface_point)
                                  : sizeof(mw_location);
    if (buffer_get_all(records, size, &view, &count)) return NULL;
    const mw_hits hits = touches   ? mw_hits_of_touches(view.buf, count)
                         : nearest ? mw_hits_of_nearest(view.buf, count)
                                   : mw_hits_of_locations(view.buf, count);
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_operator_create_on_surface(((surface_object *)surface)->surface, &hits, &options,
                                           &weights, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    return status ? errors_raise(state, &error) : operator_new(state, weights);
}

/* operator_from_entries(row, column, weight, rows, columns): of uint32 from 0, and doubles */
static PyObject *operator_from_entries(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *given[3];
    Py_buffer views[3];
    mw_operator_entries entries = {0};
    mw_operator *weights = NULL;
    mw_error error;
    mw_status status = MW_OK;
    int got = 0;
    if (!PyArg_ParseTuple(args, "OOOO&O&", &given[0], &given[1], &given[2], option_uint32,
                          &entries.rows, option_uint32, &entries.columns))
        return NULL;
    if (!buffer_get_all(given[0], sizeof(uint32_t), &views[got], &entries.count)) got++;
    if (got == 1 && !buffer_get_packed(given[1], sizeof(uint32_t), entries.count, &views[got]))
        got++;
    if (got == 2 && !buffer_get_packed(given[2], sizeof(double), entries.count, &views[got])) got++;
    if (got == 3) {
        entries.row = views[0].buf;
        entries.column = views[1].buf;
        entries.weight = views[2].buf;
        Py_BEGIN_ALLOW_THREADS
        status = mw_operator_create_from_entries(&entries, NULL, &weights, &error);
        Py_END_ALLOW_THREADS
    }
    for (int i = 0; i < got; i++) PyBuffer_Release(&views[i]);
    if (got < 3) return NULL;
    return status ? errors_raise(state, &error) : operator_new(state, weights);
}

/* transpose(threads, progress) */
static PyObject *operator_transpose(PyObject *self, PyObject *args)
{
    core_state *state = ((operator_object *)self)->state;
    PyObject *function;
    mw_operator_options options = {0};
    mw_progress progress;
    mw_operator *turned;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O&O", option_threads, &options.threads, &function)) return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_operator_transpose(operator_of(self), &options, &turned, &error);
    Py_END_ALLOW_THREADS
    return status ? errors_raise(state, &error) : operator_new(state, turned);
}

/* apply(values, narrow, out, left_out, zero, threads, progress): a row of values for each column,
 * as of Mesh._interpolate_table */
static PyObject *operator_apply(PyObject *self, PyObject *args)
{
    operator_object *object = (operator_object *)self;
    PyObject *values, *out, *function;
    mw_operator_apply_options options = {0};
    mw_operator_info info;
    mw_progress progress;
    buffer_table table;
    Py_buffer out_view;
    mw_error error;
    mw_status status;
    int narrow, left_out;
    mw_operator_describe(object->weights, &info);
    if (!PyArg_ParseTuple(args, "OpOppO&O", &values, &narrow, &out, &left_out, &options.zero_empty,
                          option_threads, &options.threads, &function) ||
        buffer_get_table(values, narrow, info.columns, &table))
        return NULL;
    if (buffer_get_writable(out, table.size, info.rows * table.table.count, &out_view)) {
        PyBuffer_Release(&table.view);
        return NULL;
    }
    options.missing = left_out ? MW_MISSING_LEFT_OUT : MW_MISSING_SPREADS;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_operator_apply(object->weights, &table.table, &options, out_view.buf, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&out_view);
    PyBuffer_Release(&table.view);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* copy(first, column, weight): compressed sparse rows, as uint64, uint32 and doubles */
static PyObject *operator_copy(PyObject *self, PyObject *args)
{
    PyObject *first, *column, *weight;
    Py_buffer views[3];
    mw_operator_info info;
    int got = 0;
    mw_operator_describe(operator_of(self), &info);
    if (!PyArg_ParseTuple(args, "OOO", &first, &column, &weight)) return NULL;
    if (!buffer_get_writable(first, sizeof(uint64_t), (size_t)info.rows + 1, &views[got])) got++;
    if (got == 1 && !buffer_get_writable(column, sizeof(uint32_t), info.entries, &views[got]))
        got++;
    if (got == 2 && !buffer_get_writable(weight, sizeof(double), info.entries, &views[got])) got++;
    if (got == 3) {
        Py_BEGIN_ALLOW_THREADS
        mw_operator_copy(operator_of(self), views[0].buf, views[1].buf, views[2].buf);
        Py_END_ALLOW_THREADS
    }
    for (int i = 0; i < got; i++) PyBuffer_Release(&views[i]);
    if (got < 3) return NULL;
    Py_RETURN_NONE;
}

/* describe(): rows, columns, entries, empty rows, bytes */
static PyObject *operator_describe(PyObject *self, PyObject *unused)
{
    mw_operator_info info;
    (void)unused;
    mw_operator_describe(operator_of(self), &info);
    return Py_BuildValue("(IInIn)", info.rows, info.columns, (Py_ssize_t)info.entries,
                         info.empty_rows, (Py_ssize_t)info.bytes);
}

static void operator_dealloc(PyObject *self)
{
    mw_operator_destroy(operator_of(self));
    objects_free(self);
}

static PyMethodDef operator_methods[] = {
    {"transpose", operator_transpose, METH_VARARGS, NULL},
    {"apply", operator_apply, METH_VARARGS, NULL},
    {"copy", operator_copy, METH_VARARGS, NULL},
    {"describe", operator_describe, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyType_Slot operator_slots[] = {
    {Py_tp_doc, "Weights of the library."},
    {Py_tp_dealloc, operator_dealloc},
    {Py_tp_methods, operator_methods},
    {0, NULL},
};

static PyType_Spec operator_spec = {
    .name = "meshwalk._core.Operator",
    .basicsize = sizeof(operator_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = operator_slots,
};

static PyMethodDef operator_functions[] = {
    {"operator_from_entries", operator_from_entries, METH_VARARGS, NULL},
    {"operator_from_locations", operator_from_locations, METH_VARARGS, NULL},
    {"operator_on_surface", operator_on_surface, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int operator_init(PyObject *module, core_state *state)
{
    state->operator_type = objects_add_type(module, &operator_spec);
    return state->operator_type ? PyModule_AddFunctions(module, operator_functions) : -1;
}
