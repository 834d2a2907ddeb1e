/* check.c - the defects of arrays, as tuples. */
#include "core.h"

#include <string.h>

/* A number of a defect; -1 for one that does not apply. */
static long check_number(uint32_t number, uint32_t none)
{
    return number == none ? -1 : (long)number;
}

/* (kind, text, triangle, other, vertex, edge, other_edge) */
static PyObject *check_defect_tuple(const mw_defect *defect)
{
    char text[256];
    mw_defect_describe(defect, text, sizeof text);
    return Py_BuildValue(
        "(sslllll)", mw_defect_text(defect->kind), text, check_number(defect->triangle, MW_NONE),
        check_number(defect->other, MW_NONE), check_number(defect->vertex, MW_NONE),
        check_number(defect->edge, UINT8_MAX), check_number(defect->other_edge, UINT8_MAX));
}

static PyObject *check_defect_list(const mw_check *check)
{
    PyObject *list = PyList_New((Py_ssize_t)check->defect_count);
    for (size_t i = 0; list && i < check->defect_count; i++) {
        PyObject *defect = check_defect_tuple(&check->defects[i]);
        if (!defect)
            Py_CLEAR(list);
        else
            PyList_SetItem(list, (Py_ssize_t)i, defect);
    }
    return list;
}

/* What the arrays are to be: names of checks in Python. */
typedef struct check_request {
    const char *kind; /* "mesh", "surface" or "star" */
    int weld;
    mw_star_options star;
    mw_check_options check; /* of the others */
} check_request;

static mw_status check_run(const check_request *request, const mw_arrays *arrays, mw_check *check,
                           mw_error *error)
{
    if (strcmp(request->kind, "star") == 0)
        return mw_star_check_arrays(arrays, request->weld, &request->star, check, error);
    if (strcmp(request->kind, "surface") == 0)
        return mw_surface_check_arrays(arrays, request->weld, &request->check, check, error);
    return mw_check_arrays(arrays, &request->check, check, error);
}

/* check_arrays(kind, points, triangles, weld, (x, y, z), progress): is it sound, and a list of
 * defects */
static PyObject *check_arrays(PyObject *module, PyObject *args)
{
    PyObject *points, *triangles, *list, *function;
    core_state *state = PyModule_GetState(module);
    mw_progress progress;
    check_request request = {0};
    double *centre = request.star.centre;
    buffer_mesh given;
    mw_check check;
    mw_error error;
    mw_status status;
    int valid;
    if (!PyArg_ParseTuple(args, "sOOp(ddd)O", &request.kind, &points, &triangles, &request.weld,
                          &centre[0], &centre[1], &centre[2], &function) ||
        buffer_get_mesh(points, triangles, strcmp(request.kind, "mesh") == 0 ? 2 : 3, &given))
        return NULL;
    request.check.progress = progress_begin(state, function, &progress);
    request.star.progress = request.check.progress;
    Py_BEGIN_ALLOW_THREADS
    status = check_run(&request, &given.arrays, &check, &error);
    Py_END_ALLOW_THREADS
    buffer_release_mesh(&given);
    if (status) return errors_raise(state, &error);
    list = check_defect_list(&check);
    valid = check.valid;
    mw_check_release(&check);
    return list ? Py_BuildValue("NN", PyBool_FromLong(valid), list) : NULL;
}

static PyMethodDef check_functions[] = {
    {"check_arrays", check_arrays, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int check_init(PyObject *module)
{
    return PyModule_AddFunctions(module, check_functions);
}
