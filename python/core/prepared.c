/* prepared.c - prepared meshes: mapped, with their locators, and written. */
#include "core.h"

#include <stdint.h>
#include <string.h>

static const char capsule_name[] = "meshwalk._core.prepared";

static void prepared_close(PyObject *capsule)
{
    mw_prepared_close(PyCapsule_GetPointer(capsule, capsule_name));
}

/* Values in the file, not copied. */
typedef struct prepared_columns {
    char **names;
    double **values;
    size_t count, value_count;
} prepared_columns;

/* {name: memory} */
static PyObject *prepared_borrow_columns(core_state *state, PyObject *owner,
                                         prepared_columns columns)
{
    PyObject *fields = PyDict_New();
    for (size_t i = 0; fields && i < columns.count; i++) {
        const char *text = columns.names[i];
        PyObject *name = PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "surrogateescape");
        PyObject *values =
            memory_borrow(state, owner, columns.values[i], columns.value_count * sizeof(double));
        if (!name || !values || PyDict_SetItem(fields, name, values)) Py_CLEAR(fields);
        Py_XDECREF(values);
        Py_XDECREF(name);
    }
    return fields;
}

/* (locator, fields, triangle fields, crs, checksum, border) */
static PyObject *prepared_wrap(core_state *state, PyObject *classes[2], mw_prepared *prepared,
                               PyObject *owner)
{
    mw_mesh *inner = mw_prepared_mesh(prepared);
    const mw_mesh_file *values = mw_prepared_values(prepared);
    const prepared_columns of_vertices = {values->field_names, values->fields, values->field_count,
                                          mw_mesh_vertex_count(inner)},
                           of_triangles = {values->triangle_field_names, values->triangle_fields,
                                           values->triangle_field_count,
                                           mw_mesh_triangle_count(inner)};
    mw_prepared_info info;
    mw_prepared_describe(prepared, &info);
    mw_locator *found = (mw_locator *)(uintptr_t)mw_prepared_locator(prepared);
    PyObject *mesh = mesh_borrow(state, classes[0], inner, owner);
    PyObject *locator = mesh ? locator_new(state, classes[1], mesh, found, owner) : NULL;
    PyObject *fields = prepared_borrow_columns(state, owner, of_vertices);
    PyObject *others = prepared_borrow_columns(state, owner, of_triangles);
    PyObject *crs = file_get_crs(values->crs);
    PyObject *result = NULL;
    if (locator && fields && others && crs)
        result = Py_BuildValue("(OOOOKN)", locator, fields, others, crs,
                               (unsigned long long)info.checksum, PyBool_FromLong(info.border));
    Py_XDECREF(mesh);
    Py_XDECREF(locator);
    Py_XDECREF(fields);
    Py_XDECREF(others);
    Py_XDECREF(crs);
    return result;
}

/* map_prepared(class of the mesh, class of the locator, path as bytes, trust, threads, progress) */
static PyObject *prepared_map(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *classes[2], *function;
    const char *path;
    mw_map_options options = {0};
    mw_progress progress;
    mw_prepared *prepared;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOypO&O", &classes[0], &classes[1], &path, &options.trust,
                          option_threads, &options.threads, &function))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_mesh_map(path, &options, &prepared, &error);
    Py_END_ALLOW_THREADS
    if (status) return errors_raise(state, &error);
    PyObject *owner = PyCapsule_New(prepared, capsule_name, prepared_close);
    if (!owner) {
        mw_prepared_close(prepared);
        return NULL;
    }
    PyObject *result = prepared_wrap(state, classes, prepared, owner);
    Py_DECREF(owner);
    return result;
}

/* What write_prepared and write_tiles are given. */
typedef struct prepared_request {
    const mw_locator *locator;
    const char *path;
    mw_mesh_file values;
    file_fields vertex, triangle;
    uint32_t tiles; /* 0: a file */
    mw_progress progress;
} prepared_request;

static int prepared_get_values(prepared_request *r, PyObject *locator, PyObject *fields,
                               PyObject *others, const char *crs)
{
    const mw_mesh *mesh = locator_get_mesh(locator);
    const uint32_t vertices = mw_mesh_vertex_count(mesh), triangles = mw_mesh_triangle_count(mesh);
    r->locator = ((locator_object *)locator)->locator;
    if (file_get_fields(fields, vertices, &r->vertex) ||
        file_get_fields(others, triangles, &r->triangle))
        return -1;
    r->values = (mw_mesh_file){
        .point_count = vertices,
        .triangle_count = triangles,
        .field_names = r->vertex.names,
        .fields = r->vertex.values,
        .field_count = r->vertex.count,
        .triangle_field_names = r->triangle.names,
        .triangle_fields = r->triangle.values,
        .triangle_field_count = r->triangle.count,
        .crs = (char *)(uintptr_t)crs,
    };
    return 0;
}

static mw_status prepared_write_request(const prepared_request *r, const mw_progress *progress,
                                        mw_error *error)
{
    const mw_prepare_options file = {.values = &r->values, .progress = progress};
    const mw_tile_options folder = {.tiles = r->tiles, .values = &r->values, .progress = progress};
    return r->tiles ? mw_write_tiles(r->locator, r->path, &folder, error)
                    : mw_write_prepared(r->locator, r->path, &file, error);
}

/* write_prepared(locator, path as bytes, [(name, values)] of vertices and of triangles, crs or
 * None, how many tiles (0: one file), progress) */
static PyObject *prepared_write(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *object, *list, *other, *function;
    const char *crs;
    prepared_request request = {0};
    mw_error error;
    mw_status status = MW_OK;
    if (!PyArg_ParseTuple(args, "O!yO!O!zO&O", state->locator_type, &object, &request.path,
                          &PyList_Type, &list, &PyList_Type, &other, &crs, option_uint32,
                          &request.tiles, &function))
        return NULL;
    const int failed = prepared_get_values(&request, object, list, other, crs);
    if (!failed) {
        const mw_progress *progress = progress_begin(state, function, &request.progress);
        Py_BEGIN_ALLOW_THREADS
        status = prepared_write_request(&request, progress, &error);
        Py_END_ALLOW_THREADS
    }
    file_release_fields(&request.vertex);
    file_release_fields(&request.triangle);
    if (failed) return NULL;
    if (status) return errors_raise(state, &error);
    Py_RETURN_NONE;
}

static PyMethodDef prepared_functions[] = {
    {"map_prepared", prepared_map, METH_VARARGS, NULL},
    {"write_prepared", prepared_write, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int prepared_init(PyObject *module)
{
    return PyModule_AddFunctions(module, prepared_functions);
}
