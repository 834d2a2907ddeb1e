/* mend.c - arrays of a mesh, mended. */
#include "core.h"

/* An array of the mended mesh as memory, which is no longer its own. */
static PyObject *mend_take(core_state *state, uint32_t **array, size_t count)
{
    void *bytes = *array;
    *array = NULL;
    return memory_new(state, bytes, count * sizeof(uint32_t));
}

/* (kind, text, triangle, vertex, other); -1 for numbers that do not apply */
static PyObject *mend_change_tuple(const mw_mend_change *change)
{
    char text[256];
    long numbers[3];
    const uint32_t given[3] = {change->triangle, change->vertex, change->other};
    for (int k = 0; k < 3; k++) numbers[k] = given[k] == MW_NONE ? -1 : (long)given[k];
    mw_mend_change_describe(change, text, sizeof text);
    return Py_BuildValue("(islll)", (int)change->kind, text, numbers[0], numbers[1], numbers[2]);
}

static PyObject *mend_change_list(const mw_mended *mended)
{
    PyObject *list = PyList_New((Py_ssize_t)mended->change_count);
    for (size_t i = 0; list && i < mended->change_count; i++) {
        PyObject *change = mend_change_tuple(&mended->changes[i]);
        if (!change)
            Py_CLEAR(list);
        else
            PyList_SetItem(list, (Py_ssize_t)i, change);
    }
    return list;
}

/* mend_arrays(points, triangles, repairs, space, tolerance, progress): memory of triangles,
 * vertex_from, vertex_to, triangle_from; a list of changes */
static PyObject *mend_arrays(PyObject *module, PyObject *args)
{
    PyObject *points, *triangles, *function;
    core_state *state = PyModule_GetState(module);
    mw_mend_options options = {0};
    mw_progress progress;
    buffer_mesh given;
    mw_mended mended;
    mw_error error;
    mw_status status;
    int space;
    if (!PyArg_ParseTuple(args, "OOO&pdO", &points, &triangles, option_uint32, &options.repairs,
                          &space, &options.tolerance, &function) ||
        buffer_get_mesh(points, triangles, space ? 3 : 2, &given))
        return NULL;
    options.space = (uint32_t)space;
    options.progress = progress_begin(state, function, &progress);
    const size_t count = given.arrays.point_count;
    Py_BEGIN_ALLOW_THREADS
    status = mw_mend_arrays(&given.arrays, &options, &mended, &error);
    Py_END_ALLOW_THREADS
    buffer_release_mesh(&given);
    if (status) return errors_raise(state, &error);
    PyObject *parts[5] = {
        mend_take(state, &mended.triangles, 3 * mended.triangle_count),
        mend_take(state, &mended.vertex_from, mended.vertex_count),
        mend_take(state, &mended.vertex_to, count),
        mend_take(state, &mended.triangle_from, mended.triangle_count),
        mend_change_list(&mended),
    };
    mw_mended_release(&mended);
    if (parts[0] && parts[1] && parts[2] && parts[3] && parts[4])
        return Py_BuildValue("(NNNNN)", parts[0], parts[1], parts[2], parts[3], parts[4]);
    for (int k = 0; k < 5; k++) Py_XDECREF(parts[k]);
    return NULL;
}

static PyMethodDef mend_functions[] = {
    {"mend_arrays", mend_arrays, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int mend_init(PyObject *module)
{
    return PyModule_AddFunctions(module, mend_functions);
}
