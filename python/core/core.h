/* core.h - what the files of the extension share: the state of the module, its objects, errors.
 *
 * The extension is the library as Python sees it, and nothing more: it checks that buffers have the
 * layout that the library wants, releases the interpreter lock round each call that may take long,
 * and turns errors into exceptions. What users see is made of it in python/meshwalk: there arrays
 * are made and converted. So the arguments here are those of our own Python, but a wrong one never
 * reads or writes outside of a buffer. */
#ifndef CORE_H
#define CORE_H

#define Py_LIMITED_API 0x030B0000 /* 3.11, the first with buffers in the stable interface */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <meshwalk/meshwalk.h>

/* What the module owns; each object keeps a pointer to it, which its type keeps alive. */
typedef struct core_state {
    PyTypeObject *mesh_type, *locator_type, *location_type, *memory_type;
    PyTypeObject *surface_type, *star_type, *prober_type, *editor_type, *surface_editor_type,
        *operator_type, *polygons_type;
    PyObject *input_error, *limit_error;
    unsigned long main_thread; /* the one that imported the module */
    PyObject *where_members;   /* a tuple: the members of meshwalk.Where, by their numbers */
} core_state;

typedef struct mesh_object {
    PyObject_HEAD
    core_state *state;
    PyObject *owner; /* a mapped file that has the mesh; NULL: the mesh is the object's own */
    mw_mesh *mesh;
} mesh_object;

typedef struct locator_object {
    PyObject_HEAD
    core_state *state;
    PyObject *owner; /* as of mesh_object */
    PyObject *mesh;
    mw_locator *locator;
    mw_cursor cursor; /* of single queries: used only under the interpreter lock */
} locator_object;

typedef struct surface_object {
    PyObject_HEAD
    core_state *state;
    mw_surface *surface;
} surface_object;

/* What is kept beside a surface keeps it alive. */
typedef struct star_object {
    PyObject_HEAD
    core_state *state;
    PyObject *surface;
    mw_star *star;
} star_object;

typedef struct prober_object {
    PyObject_HEAD
    core_state *state;
    PyObject *surface;
    mw_prober *prober;
} prober_object;

/* --- errors.c: exceptions --- */

/* Raise what the error says; returns NULL, for `return errors_raise(...)`. */
PyObject *errors_raise(core_state *state, const mw_error *error);

/* Find the classes of exceptions in meshwalk._errors; -1 with an exception on failure. */
int errors_init(core_state *state);

/* --- objects.c: memory of objects --- */

/* A zeroed object of a class that is `type` or derived from it; NULL with an exception. */
void *objects_new(PyObject *class, PyTypeObject *type);
/* The end of tp_dealloc. */
void objects_free(PyObject *object);
/* Add a type to the module; a new reference, or NULL with an exception. */
PyTypeObject *objects_add_type(PyObject *module, PyType_Spec *spec);

/* --- buffers.c: arrays of the caller --- */

/* A buffer in use: released by PyBuffer_Release. */
typedef struct buffer_points {
    Py_buffer view;
    const double *points;
    size_t count, stride; /* in doubles */
} buffer_points;

/* Rows of at least `width` doubles side by side: the buffer of a two-dimensional array. 0, or -1
 * with an exception. */
int buffer_get_points(PyObject *object, size_t width, buffer_points *points);
/* `count` members of `size` bytes, without gaps. */
int buffer_get_packed(PyObject *object, size_t size, size_t count, Py_buffer *view);
int buffer_get_writable(PyObject *object, size_t size, size_t count, Py_buffer *view);
/* Members in a buffer of members of `size` bytes without gaps; their number goes to *count. */
int buffer_get_all(PyObject *object, size_t size, Py_buffer *view, size_t *count);

/* Queries of a batch, room for the answers, and hints where there are any. */
typedef struct buffer_batch {
    buffer_points points;
    Py_buffer out, hints; /* hints.buf is NULL without hints */
} buffer_batch;

/* `points` are rows of `width` doubles; `out` has room for an answer of `size` bytes for each, and
 * `hints` for a uint32, or is None. 0, or -1 with an exception; released by buffer_release_batch.
 * */
int buffer_get_batch(PyObject *points, size_t width, PyObject *out, size_t size, PyObject *hints,
                     buffer_batch *batch);
void buffer_release_batch(buffer_batch *batch);

/* Values at vertices: the buffer of a two-dimensional array. */
typedef struct buffer_table {
    Py_buffer view;
    mw_value_table table;
    size_t size; /* of a value, in bytes */
} buffer_table;

/* `count` rows of doubles, or of floats if `narrow`; they may lie in any way that goes forward. */
int buffer_get_table(PyObject *object, int narrow, size_t count, buffer_table *table);

/* Points and triangles as the library takes them. */
typedef struct buffer_mesh {
    buffer_points points;
    Py_buffer triangles;
    mw_arrays arrays;
} buffer_mesh;

/* Triangles are rows of three int32, uint32 or int64, without gaps. 0, or -1 with an exception;
 * released by buffer_release_mesh. */
int buffer_get_mesh(PyObject *points, PyObject *triangles, size_t width, buffer_mesh *mesh);
void buffer_release_mesh(buffer_mesh *mesh);

/* --- options.c: numbers, for "O&", and names --- */

int option_uint32(PyObject *object, void *number);
/* A number of threads, a uint32: the message names the argument. */
int option_threads(PyObject *object, void *number);
/* A ValueError that lists the names from name_of(0) to name_of(count - 1); returns NULL. */
PyObject *option_raise_unknown(const char *what, const char *name, const char *(*name_of)(int),
                               int count);
/* Names of walks and starts in the plane by their numbers, for option_raise_unknown. */
const char *option_walk_name(int walk);
const char *option_start_name(int start);
/* Add both lists to the module. */
int options_init(PyObject *module);
int option_uint64(PyObject *object, void *number);

/* --- progress.c: long calls are watched --- */

/* Fill *progress for a call: `function` is called with a stage and a fraction, unless it is None;
 * Ctrl-C is looked for in any case. NULL where nobody watches. */
const mw_progress *progress_begin(const core_state *state, PyObject *function,
                                  mw_progress *progress);

/* --- memory.c: memory of the library, as a buffer --- */

/* A memoryview whose object frees the memory with free(); takes it over also on failure, which is
 * NULL with an exception. */
PyObject *memory_new(core_state *state, void *bytes, size_t size);
/* A memoryview of memory that belongs to `owner`, which it keeps alive; it cannot be written. */
PyObject *memory_borrow(core_state *state, PyObject *owner, const void *bytes, size_t size);
int memory_init(PyObject *module, core_state *state);

/* --- editing.c: what both editors hand out --- */

/* A list of numbers; NULL with an exception. */
PyObject *editing_numbers(const uint32_t *numbers, size_t count);
/* The corners of a triangle, or the place of a vertex in 2 or 3 dimensions, as a tuple; None if
 * there is no such triangle or vertex. */
PyObject *editing_triangle(int there, const uint32_t v[3]);
PyObject *editing_vertex(int there, const double *point, unsigned dimensions);

/* Two arrays of numbers, one for each triangle and vertex that there was. */
typedef struct editing_maps {
    Py_buffer triangles, vertices;
} editing_maps;

/* 0, or -1 with an exception; released by editing_release_maps. */
int editing_get_maps(PyObject *triangles, uint32_t triangle_range, PyObject *vertices,
                     uint32_t vertex_range, editing_maps *maps);
void editing_release_maps(editing_maps *maps);

/* --- files.c: fields of meshes in files --- */

/* Names and values of fields that are to be written; zero-initialised ones are empty. */
typedef struct file_fields {
    Py_buffer *views;
    char **names;
    double **values;
    size_t count;
} file_fields;

/* Take names and buffers of a list of (bytes, array); the names are the list's. 0, or -1 with an
 * exception; released by file_release_fields in either case. */
int file_get_fields(PyObject *list, size_t value_count, file_fields *fields);
void file_release_fields(file_fields *fields);
/* The coordinate system as str; None: not known. */
PyObject *file_get_crs(const char *crs);

/* --- one file for each kind of object or function; init adds them to the module --- */

int mesh_init(PyObject *module, core_state *state);
/* A mesh object that takes the mesh over, also on failure. */
PyObject *mesh_new(core_state *state, PyObject *class, mw_mesh *mesh);
/* A mesh object whose mesh belongs to `owner`. */
PyObject *mesh_borrow(core_state *state, PyObject *class, mw_mesh *mesh, PyObject *owner);
int location_init(PyObject *module, core_state *state);
PyObject *location_new(core_state *state, const mw_location *location);
int locator_init(PyObject *module, core_state *state);
/* A locator object of a mesh object; takes the locator over, also on failure, unless it belongs to
 * `owner`. */
PyObject *locator_new(core_state *state, PyObject *class, PyObject *mesh, mw_locator *locator,
                      PyObject *owner);
/* The mesh of a locator object. */
const mw_mesh *locator_get_mesh(PyObject *locator);
int segments_init(PyObject *module);
/* The pieces of segments, as memory of offsets and of pieces; args: ends, threads, progress. */
PyObject *segments_follow(core_state *state, const mw_locator *locator, PyObject *args);
int surface_init(PyObject *module, core_state *state);
int star_init(PyObject *module, core_state *state);
int prober_init(PyObject *module, core_state *state);
int editor_init(PyObject *module, core_state *state);
int surface_editor_init(PyObject *module, core_state *state);
int operator_init(PyObject *module, core_state *state);
/* An operator object that takes the operator over, also on failure. */
PyObject *operator_new(core_state *state, mw_operator *weights);
int overlap_init(PyObject *module);
int sight_init(PyObject *module);
int prepared_init(PyObject *module);
int polygons_init(PyObject *module, core_state *state);
int check_init(PyObject *module);
int mend_init(PyObject *module);
int borrowed_init(PyObject *module);
int layouts_init(PyObject *module);
int triangulation_init(PyObject *module);
int files_init(PyObject *module);
int points_init(PyObject *module);

#endif
