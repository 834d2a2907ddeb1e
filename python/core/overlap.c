/* overlap.c - what two meshes have in common: volumes, areas, and conservative weights. */
#include "core.h"

#include <stdlib.h>
#include <string.h>

/* Heights at the vertices of the mesh of a locator object. */
static int overlap_get_heights(PyObject *heights, PyObject *locator, Py_buffer *view)
{
    const size_t count = mw_mesh_vertex_count(locator_get_mesh(locator));
    return buffer_get_packed(heights, sizeof(double), count, view);
}

static mw_locator *overlap_locator(PyObject *object)
{
    return ((locator_object *)object)->locator;
}

static PyObject *overlap_volume_tuple(const mw_volume_info *v)
{
    return Py_BuildValue("(ddddddddK)", v->cut, v->fill, v->cut_area, v->fill_area, v->level_area,
                         v->area, v->surface_only, v->other_only, (unsigned long long)v->parts);
}

/* volume_above(locator, heights, base, threads, progress): the members of mw_volume_info */
static PyObject *overlap_volume_above(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *surface, *heights, *function;
    double base;
    mw_volume_options options = {0};
    mw_progress progress;
    Py_buffer view;
    mw_volume_info info;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!OdO&O", state->locator_type, &surface, &heights, &base,
                          option_threads, &options.threads, &function) ||
        overlap_get_heights(heights, surface, &view))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_volume_above(overlap_locator(surface), view.buf, base, &options, &info, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    return status ? errors_raise(state, &error) : overlap_volume_tuple(&info);
}

/* volume_between(locator, heights, other, other_heights, threads, progress): as volume_above */
static PyObject *overlap_volume_between(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *surface, *heights, *other, *other_heights, *function;
    mw_volume_options options = {0};
    mw_progress progress;
    Py_buffer view, other_view;
    mw_volume_info info;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!OO!OO&O", state->locator_type, &surface, &heights,
                          state->locator_type, &other, &other_heights, option_threads,
                          &options.threads, &function) ||
        overlap_get_heights(heights, surface, &view))
        return NULL;
    if (overlap_get_heights(other_heights, other, &other_view)) {
        PyBuffer_Release(&view);
        return NULL;
    }
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_volume_between(overlap_locator(surface), view.buf, overlap_locator(other),
                               other_view.buf, &options, &info, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&other_view);
    PyBuffer_Release(&view);
    return status ? errors_raise(state, &error) : overlap_volume_tuple(&info);
}

/* surface_area(locator, heights, region, threads, progress): the members of mw_surface_area_info */
static PyObject *overlap_surface_area(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *surface, *heights, *region, *function;
    mw_volume_options options = {0};
    mw_progress progress;
    Py_buffer view;
    mw_surface_area_info info;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!OO!O&O", state->locator_type, &surface, &heights,
                          state->locator_type, &region, option_threads, &options.threads,
                          &function) ||
        overlap_get_heights(heights, surface, &view))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_surface_area(overlap_locator(surface), view.buf, overlap_locator(region), &options,
                             &info, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    if (status) return errors_raise(state, &error);
    return Py_BuildValue("(dddK)", info.area, info.surface_area, info.region_area,
                         (unsigned long long)info.parts);
}

/* --- conservative weights --- */

/* A mesh whose cells are numbered by a buffer of uint32, or are its triangles. */
typedef struct overlap_cells {
    mw_remap_mesh mesh;
    Py_buffer view; /* its buf is NULL without one */
} overlap_cells;

static int overlap_get_cells(PyObject *locator, PyObject *face, size_t count, overlap_cells *cells)
{
    *cells = (overlap_cells){.mesh = {.locator = overlap_locator(locator)}};
    if (face == Py_None) return 0;
    const mw_mesh *mesh = locator_get_mesh(locator);
    if (buffer_get_packed(face, sizeof(uint32_t), mw_mesh_triangle_count(mesh), &cells->view))
        return -1;
    cells->mesh.face = cells->view.buf;
    cells->mesh.face_count = count;
    return 0;
}

static void overlap_release_cells(overlap_cells *cells)
{
    if (cells->mesh.face) PyBuffer_Release(&cells->view);
}

/* (operator, areas and fractions of the source and of the target, sums); takes what is in `r`. */
static PyObject *overlap_take_remap(core_state *state, mw_remap *r)
{
    mw_operator_info info;
    mw_operator_describe(r->weights, &info);
    const size_t rows = info.rows * sizeof(double), columns = info.columns * sizeof(double);
    const mw_remap all = *r;
    *r = (mw_remap){0};
    PyObject *part[5] = {
        operator_new(state, all.weights),
        memory_new(state, all.source_area, columns),
        memory_new(state, all.source_fraction, columns),
        memory_new(state, all.target_area, rows),
        memory_new(state, all.target_fraction, rows),
    };
    PyObject *result = NULL;
    if (part[0] && part[1] && part[2] && part[3] && part[4])
        result = Py_BuildValue("(OOOOOdd)", part[0], part[1], part[2], part[3], part[4],
                               all.source_sum, all.common_sum);
    for (int i = 0; i < 5; i++) Py_XDECREF(part[i]);
    return result;
}

/* remap_to_mesh(source, cell of each triangle or None, number of cells, target, cells, number,
 * vertices, degrees, covered, threads, progress) */
static PyObject *overlap_remap_to_mesh(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *locator[2], *face[2], *function;
    Py_ssize_t count[2];
    mw_remap_options options = {0};
    mw_progress progress;
    overlap_cells source, target;
    mw_remap remap;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!OnO!OnpppO&O", state->locator_type, &locator[0], &face[0],
                          &count[0], state->locator_type, &locator[1], &face[1], &count[1],
                          &options.vertices, &options.degrees, &options.covered, option_threads,
                          &options.threads, &function) ||
        overlap_get_cells(locator[0], face[0], (size_t)count[0], &source))
        return NULL;
    if (overlap_get_cells(locator[1], face[1], (size_t)count[1], &target)) {
        overlap_release_cells(&source);
        return NULL;
    }
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_remap_to_mesh(&source.mesh, &target.mesh, &options, &remap, &error);
    Py_END_ALLOW_THREADS
    overlap_release_cells(&source);
    overlap_release_cells(&target);
    return status ? errors_raise(state, &error) : overlap_take_remap(state, &remap);
}

/* remap_to_pixels(source, cell of each triangle or None, number of cells, (west, north, width,
 * height, columns, rows), vertices, degrees, covered, threads, progress) */
static PyObject *overlap_remap_to_pixels(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *locator, *face, *function;
    Py_ssize_t count;
    mw_remap_pixels pixels;
    mw_remap_options options = {0};
    mw_progress progress;
    overlap_cells source;
    mw_remap remap;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!On(ddddO&O&)pppO&O", state->locator_type, &locator, &face,
                          &count, &pixels.west, &pixels.north, &pixels.width, &pixels.height,
                          option_uint32, &pixels.columns, option_uint32, &pixels.rows,
                          &options.vertices, &options.degrees, &options.covered, option_threads,
                          &options.threads, &function) ||
        overlap_get_cells(locator, face, (size_t)count, &source))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_remap_to_pixels(&source.mesh, &pixels, &options, &remap, &error);
    Py_END_ALLOW_THREADS
    overlap_release_cells(&source);
    return status ? errors_raise(state, &error) : overlap_take_remap(state, &remap);
}

/* (points, triangles, cells, longitude where they begin); takes what is in `pieces`. */
static PyObject *overlap_take_pieces(core_state *state, mw_seam_pieces *pieces)
{
    const mw_seam_pieces all = *pieces;
    *pieces = (mw_seam_pieces){0};
    mw_operator_destroy(all.values);
    PyObject *part[3] = {
        memory_new(state, all.points, 2 * all.point_count * sizeof *all.points),
        memory_new(state, all.triangles, 3 * all.triangle_count * sizeof *all.triangles),
        memory_new(state, all.faces, all.triangle_count * sizeof *all.faces),
    };
    PyObject *result = NULL;
    if (part[0] && part[1] && part[2])
        result = Py_BuildValue("(OOOd)", part[0], part[1], part[2], all.west);
    for (int i = 0; i < 3; i++) Py_XDECREF(part[i]);
    return result;
}

/* The pieces of a mesh, or None if it does not cross the seam. */
static PyObject *overlap_cut(core_state *state, const mw_arrays *mesh, const uint32_t *cells)
{
    mw_seam_pieces pieces;
    mw_error error;
    mw_status status = MW_OK;
    int crosses;
    Py_BEGIN_ALLOW_THREADS
    crosses = mw_seam_crosses(mesh);
    if (crosses) status = mw_seam_cut(mesh, cells, &pieces, &error);
    Py_END_ALLOW_THREADS
    if (!crosses) Py_RETURN_NONE;
    return status ? errors_raise(state, &error) : overlap_take_pieces(state, &pieces);
}

/* seam_cut(points, triangles as uint32, cell of each triangle or None): None if the mesh does not
 * cross the seam of its longitudes; else the arrays of the pieces, packed, and where they begin */
static PyObject *overlap_seam_cut(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *points, *triangles, *cells, *result;
    buffer_mesh mesh;
    Py_buffer view = {0};
    if (!PyArg_ParseTuple(args, "OOO", &points, &triangles, &cells) ||
        buffer_get_mesh(points, triangles, 2, &mesh))
        return NULL;
    if (cells != Py_None &&
        buffer_get_packed(cells, sizeof(uint32_t), mesh.arrays.triangle_count, &view)) {
        buffer_release_mesh(&mesh);
        return NULL;
    }
    result = overlap_cut(state, &mesh.arrays, view.buf);
    if (cells != Py_None) PyBuffer_Release(&view);
    buffer_release_mesh(&mesh);
    return result;
}

static PyMethodDef overlap_functions[] = {
    {"volume_above", overlap_volume_above, METH_VARARGS, NULL},
    {"volume_between", overlap_volume_between, METH_VARARGS, NULL},
    {"surface_area", overlap_surface_area, METH_VARARGS, NULL},
    {"remap_to_mesh", overlap_remap_to_mesh, METH_VARARGS, NULL},
    {"remap_to_pixels", overlap_remap_to_pixels, METH_VARARGS, NULL},
    {"seam_cut", overlap_seam_cut, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int overlap_init(PyObject *module)
{
    return PyModule_AddFunctions(module, overlap_functions);
}
