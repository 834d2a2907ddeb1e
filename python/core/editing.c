/* editing.c - what both editors hand out: numbers, corners and places, and room for new numbers. */
#include "core.h"

PyObject *editing_numbers(const uint32_t *numbers, size_t count)
{
    PyObject *list = PyList_New((Py_ssize_t)count);
    for (size_t i = 0; list && i < count; i++) {
        PyObject *item = PyLong_FromUnsignedLong(numbers[i]);
        if (!item)
            Py_CLEAR(list);
        else
            PyList_SetItem(list, (Py_ssize_t)i, item);
    }
    return list;
}

PyObject *editing_triangle(int there, const uint32_t v[3])
{
    if (!there) Py_RETURN_NONE;
    return Py_BuildValue("III", v[0], v[1], v[2]);
}

PyObject *editing_vertex(int there, const double *point, unsigned dimensions)
{
    if (!there) Py_RETURN_NONE;
    return dimensions == 2 ? Py_BuildValue("dd", point[0], point[1])
                           : Py_BuildValue("ddd", point[0], point[1], point[2]);
}

int editing_get_maps(PyObject *triangles, uint32_t triangle_range, PyObject *vertices,
                     uint32_t vertex_range, editing_maps *maps)
{
    if (buffer_get_writable(triangles, sizeof(uint32_t), triangle_range, &maps->triangles))
        return -1;
    if (!buffer_get_writable(vertices, sizeof(uint32_t), vertex_range, &maps->vertices)) return 0;
    PyBuffer_Release(&maps->triangles);
    return -1;
}

void editing_release_maps(editing_maps *maps)
{
    PyBuffer_Release(&maps->triangles);
    PyBuffer_Release(&maps->vertices);
}
