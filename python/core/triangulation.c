/* triangulation.c - meshes made of points. */
#include "core.h"

/* delaunay(cls, points, duplicate_of or None, threads): a mesh and the number of duplicates */
static PyObject *triangulation_delaunay(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *class, *points, *duplicates, *object;
    mw_delaunay_options options = {0};
    mw_delaunay_report report;
    buffer_points given;
    Py_buffer duplicate_of = {0};
    mw_mesh *mesh;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOO&", &class, &points, &duplicates, option_uint32,
                          &options.threads))
        return NULL;
    if (buffer_get_points(points, 2, &given)) return NULL;
    if (buffer_get_writable(duplicates, sizeof(uint32_t), given.count, &duplicate_of)) {
        PyBuffer_Release(&given.view);
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS status = mw_delaunay(given.points, given.count, given.stride, &options,
                                                duplicate_of.buf, &report, &mesh, &error);
    Py_END_ALLOW_THREADS PyBuffer_Release(&duplicate_of);
    PyBuffer_Release(&given.view);
    if (status) return errors_raise(state, &error);
    object = mesh_new(state, class, mesh);
    return object ? Py_BuildValue("Nn", object, (Py_ssize_t)report.duplicates) : NULL;
}

static PyMethodDef triangulation_functions[] = {
    {"delaunay", triangulation_delaunay, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int triangulation_init(PyObject *module)
{
    return PyModule_AddFunctions(module, triangulation_functions);
}
