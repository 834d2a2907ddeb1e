/* files.c - meshes in files, read and written; constraints, read. */
#include "core.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* An array of the file as memory, which is no longer the file's. */
static PyObject *file_take(core_state *state, void **array, size_t size)
{
    void *bytes = *array;
    *array = NULL;
    return memory_new(state, bytes, size);
}

/* Values at the points of a file. */
typedef struct file_columns {
    char **names;
    double **values;
    size_t count, point_count;
} file_columns;

/* {name: memory} */
static PyObject *file_take_columns(core_state *state, file_columns columns)
{
    PyObject *fields = PyDict_New();
    for (size_t i = 0; fields && i < columns.count; i++) {
        const char *text = columns.names[i];
        PyObject *name = PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "surrogateescape");
        PyObject *values = name ? file_take(state, (void **)&columns.values[i],
                                            columns.point_count * sizeof(double))
                                : NULL;
        if (!values || PyDict_SetItem(fields, name, values)) Py_CLEAR(fields);
        Py_XDECREF(values);
        Py_XDECREF(name);
    }
    return fields;
}

PyObject *file_get_crs(const char *crs)
{
    if (!crs) Py_RETURN_NONE;
    return PyUnicode_DecodeUTF8(crs, (Py_ssize_t)strlen(crs), "replace");
}

/* (points, triangles, has_z, fields, triangle fields, crs) */
static PyObject *file_take_all(core_state *state, mw_mesh_file *file)
{
    PyObject *fields =
        file_take_columns(state, (file_columns){file->field_names, file->fields, file->field_count,
                                                file->point_count});
    PyObject *of_triangles =
        file_take_columns(state, (file_columns){file->triangle_field_names, file->triangle_fields,
                                                file->triangle_field_count, file->triangle_count});
    PyObject *points =
        file_take(state, (void **)&file->points, 3 * file->point_count * sizeof(double));
    PyObject *triangles =
        file_take(state, (void **)&file->triangles, 3 * file->triangle_count * sizeof(uint32_t));
    PyObject *crs = file_get_crs(file->crs);
    PyObject *result =
        fields && of_triangles && points && triangles && crs
            ? Py_BuildValue("OOiOOO", points, triangles, file->has_z, fields, of_triangles, crs)
            : NULL;
    Py_XDECREF(crs);
    Py_XDECREF(fields);
    Py_XDECREF(of_triangles);
    Py_XDECREF(points);
    Py_XDECREF(triangles);
    return result;
}

/* read_mesh(path, layout, progress): path as bytes */
static PyObject *file_read_mesh(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    const char *path;
    PyObject *result, *function;
    mw_progress progress;
    mw_file_options options = {0};
    mw_mesh_file file;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "yzO", &path, &options.layout, &function)) return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_read_mesh(path, &options, &file, &error);
    Py_END_ALLOW_THREADS
    if (status) return errors_raise(state, &error);
    result = file_take_all(state, &file);
    mw_mesh_file_release(&file);
    return result;
}

/* (points, has_z, segments, polygons, records, seeds, fields, name of a record, skipped) */
static PyObject *file_take_constraints(core_state *state, mw_constraint_file *file)
{
    const size_t n = file->segment_count, k = file->skipped_count;
    PyObject *part[7] = {
        file_take_columns(state, (file_columns){file->field_names, file->fields, file->field_count,
                                                file->point_count}),
        file_take(state, (void **)&file->points, 3 * file->point_count * sizeof(double)),
        file_take(state, (void **)&file->segments, 2 * n * sizeof(uint32_t)),
        file_take(state, (void **)&file->polygon, n * sizeof(uint32_t)),
        file_take(state, (void **)&file->record, n * sizeof(uint32_t)),
        file_take(state, (void **)&file->hole_seeds, 2 * file->hole_seed_count * sizeof(double)),
        file_take(state, (void **)&file->skipped, k * sizeof(mw_skipped_ring)),
    };
    PyObject *result = NULL;
    int there = 1;
    for (int i = 0; i < 7; i++) there &= part[i] != NULL;
    if (there)
        result = Py_BuildValue("OiOOOOOsO", part[1], file->has_z, part[2], part[3], part[4],
                               part[5], part[0], file->record_name, part[6]);
    for (int i = 0; i < 7; i++) Py_XDECREF(part[i]);
    return result;
}

/* read_constraints(path, progress): path as bytes */
static PyObject *file_read_constraints(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    const char *path;
    PyObject *result, *function;
    mw_progress progress;
    mw_file_options options = {0};
    mw_constraint_file file;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "yO", &path, &function)) return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_read_constraints(path, &options, &file, &error);
    Py_END_ALLOW_THREADS
    if (status) return errors_raise(state, &error);
    result = file_take_constraints(state, &file);
    mw_constraint_file_release(&file);
    return result;
}

void file_release_fields(file_fields *fields)
{
    for (size_t i = 0; i < fields->count; i++) PyBuffer_Release(&fields->views[i]);
    free(fields->views);
    free(fields->names);
    free(fields->values);
}

int file_get_fields(PyObject *list, size_t value_count, file_fields *fields)
{
    const size_t count = (size_t)PyList_Size(list);
    fields->views = calloc(count + 1, sizeof *fields->views);
    fields->names = calloc(count + 1, sizeof *fields->names);
    fields->values = calloc(count + 1, sizeof *fields->values);
    if (!fields->views || !fields->names || !fields->values) {
        PyErr_NoMemory();
        return -1;
    }
    for (size_t i = 0; i < count; i++) {
        PyObject *values;
        if (!PyArg_ParseTuple(PyList_GetItem(list, (Py_ssize_t)i), "yO", &fields->names[i],
                              &values) ||
            buffer_get_packed(values, sizeof(double), value_count, &fields->views[i]))
            return -1;
        fields->values[i] = fields->views[i].buf;
        fields->count++;
    }
    return 0;
}

/* Values at vertices, and of triangles. */
typedef struct file_values {
    file_fields vertex, triangle;
} file_values;

static mw_status file_write(const char *path, const buffer_mesh *mesh, int has_z, const char *crs,
                            const file_values *values, const char *format,
                            const mw_progress *progress, mw_error *error)
{
    const mw_file_options options = {.progress = progress};
    const mw_mesh_file file = {
        .points = mesh->points.view.buf,
        .triangles = mesh->triangles.buf,
        .point_count = mesh->points.count,
        .triangle_count = mesh->arrays.triangle_count,
        .has_z = has_z,
        .field_names = values->vertex.names,
        .fields = values->vertex.values,
        .field_count = values->vertex.count,
        .triangle_field_names = values->triangle.names,
        .triangle_fields = values->triangle.values,
        .triangle_field_count = values->triangle.count,
        .crs = (char *)(uintptr_t)crs,
    };
    return mw_write_mesh(path, &file, format, &options, error);
}

/* write_mesh(path, format or None, points, has_z, triangles, [(name, values)] at vertices and of
 * triangles, crs or None, progress): three doubles a vertex, without gaps */
static PyObject *file_write_mesh(PyObject *module, PyObject *args)
{
    const char *path, *format, *crs;
    int has_z;
    PyObject *points, *triangles, *list, *other, *function;
    mw_progress progress;
    buffer_mesh mesh;
    file_values values = {0};
    mw_error error;
    mw_status status = MW_OK;
    int failed;
    if (!PyArg_ParseTuple(args, "yzOpOO!O!zO", &path, &format, &points, &has_z, &triangles,
                          &PyList_Type, &list, &PyList_Type, &other, &crs, &function) ||
        buffer_get_mesh(points, triangles, 3, &mesh))
        return NULL;
    failed = file_get_fields(list, mesh.points.count, &values.vertex) ||
             file_get_fields(other, mesh.arrays.triangle_count, &values.triangle);
    if (!failed && (mesh.points.stride != 3 || mesh.arrays.integer_type == MW_INT64)) {
        PyErr_SetString(PyExc_ValueError, "expected points without gaps and triangles of 32 bits");
        failed = -1;
    }
    if (!failed) {
        const mw_progress *watching =
            progress_begin(PyModule_GetState(module), function, &progress);
        Py_BEGIN_ALLOW_THREADS
        status = file_write(path, &mesh, has_z, crs, &values, format, watching, &error);
        Py_END_ALLOW_THREADS
    }
    file_release_fields(&values.triangle);
    file_release_fields(&values.vertex);
    buffer_release_mesh(&mesh);
    if (failed) return NULL;
    if (status) return errors_raise(PyModule_GetState(module), &error);
    Py_RETURN_NONE;
}

static PyMethodDef file_functions[] = {
    {"read_mesh", file_read_mesh, METH_VARARGS, NULL},
    {"read_constraints", file_read_constraints, METH_VARARGS, NULL},
    {"write_mesh", file_write_mesh, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

/* (name, ...) of the formats that write_mesh takes */
static PyObject *file_formats(void)
{
    PyObject *tuple, *list = PyList_New(0);
    const char *name;
    for (size_t i = 0; list && (name = mw_mesh_format_name(i)); i++) {
        PyObject *text = PyUnicode_FromString(name);
        if (!text || PyList_Append(list, text)) Py_CLEAR(list);
        Py_XDECREF(text);
    }
    tuple = list ? PyList_AsTuple(list) : NULL;
    Py_XDECREF(list);
    return tuple;
}

int files_init(PyObject *module)
{
    PyObject *formats = file_formats();
    int failed = !formats || PyModule_AddObjectRef(module, "MESH_FORMATS", formats);
    Py_XDECREF(formats);
    return failed ? -1 : PyModule_AddFunctions(module, file_functions);
}
