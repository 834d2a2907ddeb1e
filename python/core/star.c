/* star.c - Star: a mw_star as an object, which keeps its surface alive; longitude and latitude. */
#include "core.h"

/* star_from_surface(cls, surface, x, y, z, borrow, unchecked, threads, progress) */
static PyObject *star_from_surface(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *class, *surface, *function;
    mw_star_options options = {0};
    mw_progress progress;
    star_object *object;
    mw_star *star;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OO!dddppO&O", &class, state->surface_type, &surface,
                          &options.centre[0], &options.centre[1], &options.centre[2],
                          &options.borrow, &options.unchecked, option_threads, &options.threads,
                          &function))
        return NULL;
    options.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_star_create(((surface_object *)surface)->surface, &options, &star, &error);
    Py_END_ALLOW_THREADS
    if (status) return errors_raise(state, &error);
    object = objects_new(class, state->star_type);
    if (!object) {
        mw_star_destroy(star);
        return NULL;
    }
    object->state = state;
    object->surface = Py_NewRef(surface);
    object->star = star;
    return (PyObject *)object;
}

static int star_traverse(PyObject *self, visitproc visit, void *arg)
{
    Py_VISIT(Py_TYPE(self));
    Py_VISIT(((star_object *)self)->surface);
    return 0;
}

static void star_dealloc(PyObject *self)
{
    star_object *object = (star_object *)self;
    PyObject_GC_UnTrack(self);
    mw_star_destroy(object->star);
    Py_XDECREF(object->surface);
    objects_free(self);
}

static const char *star_walk_name(int walk)
{
    return mw_star_walk_name((mw_star_walk_kind)walk);
}

static const char *star_start_name(int start)
{
    return mw_star_start_name((mw_star_start_kind)start);
}

/* _locate(points, out, walk, start, threads, progress) */
static PyObject *star_locate(PyObject *self, PyObject *args)
{
    star_object *object = (star_object *)self;
    PyObject *points, *out, *function;
    const char *walk, *start;
    mw_progress progress;
    mw_star_query_options options = {0};
    buffer_batch batch;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOssO&O", &points, &out, &walk, &start, option_threads,
                          &options.threads, &function))
        return NULL;
    options.walk = mw_star_walk_by_name(walk);
    options.start = mw_star_start_by_name(start);
    if (options.walk == MW_STAR_WALK_COUNT)
        return option_raise_unknown("walk", walk, star_walk_name, MW_STAR_WALK_COUNT);
    if (options.start == MW_STAR_START_COUNT)
        return option_raise_unknown("start", start, star_start_name, MW_STAR_START_COUNT);
    if (buffer_get_batch(points, 3, out, sizeof(mw_location), Py_None, &batch)) return NULL;
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_star_locate_batch(object->star, batch.points.points, batch.points.count,
                                  batch.points.stride, &options, batch.out.buf, NULL, &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* _project(points, out, locations, threads, progress): x, y, z for each point */
static PyObject *star_project(PyObject *self, PyObject *args)
{
    star_object *object = (star_object *)self;
    PyObject *points, *out, *locations, *function;
    mw_progress progress;
    mw_star_query_options options = {0};
    buffer_batch batch;
    Py_buffer view;
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "OOOO&O", &points, &out, &locations, option_threads,
                          &options.threads, &function) ||
        buffer_get_batch(points, 3, out, 3 * sizeof(double), Py_None, &batch))
        return NULL;
    if (buffer_get_writable(locations, sizeof(mw_location), batch.points.count, &view)) {
        buffer_release_batch(&batch);
        return NULL;
    }
    options.progress = progress_begin(object->state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_star_project_batch(object->star, batch.points.points, batch.points.count,
                                   batch.points.stride, &options, batch.out.buf, view.buf, &error);
    Py_END_ALLOW_THREADS
    PyBuffer_Release(&view);
    buffer_release_batch(&batch);
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* _remesh(level, points, triangles, locations, threads, progress): doubles, uint32, locations, as
 * many as icosphere_size tells */
static PyObject *star_remesh(PyObject *self, PyObject *args)
{
    star_object *object = (star_object *)self;
    PyObject *given[3], *function;
    Py_buffer views[3];
    mw_progress progress;
    mw_remesh_options options = {0};
    uint32_t level, vertices, triangles;
    mw_error error;
    mw_status status = MW_OK;
    int got = 0;
    if (!PyArg_ParseTuple(args, "O&OOOO&O", option_uint32, &level, &given[0], &given[1], &given[2],
                          option_threads, &options.threads, &function))
        return NULL;
    if (mw_icosphere_size(level, &vertices, &triangles, &error))
        return errors_raise(object->state, &error);
    if (!buffer_get_writable(given[0], 3 * sizeof(double), vertices, &views[got])) got++;
    if (got == 1 && !buffer_get_writable(given[1], 3 * sizeof(uint32_t), triangles, &views[got]))
        got++;
    if (got == 2 && !buffer_get_writable(given[2], sizeof(mw_location), vertices, &views[got]))
        got++;
    if (got == 3) {
        options.progress = progress_begin(object->state, function, &progress);
        Py_BEGIN_ALLOW_THREADS
        status = mw_star_remesh(object->star, level, &options, views[0].buf, views[1].buf,
                                views[2].buf, &error);
        Py_END_ALLOW_THREADS
    }
    for (int i = 0; i < got; i++) PyBuffer_Release(&views[i]);
    if (got < 3) return NULL;
    if (status) return errors_raise(object->state, &error);
    Py_RETURN_NONE;
}

/* icosphere_size(level): vertices and triangles */
static PyObject *star_icosphere_size(PyObject *module, PyObject *args)
{
    uint32_t level, vertices, triangles;
    mw_error error;
    if (!PyArg_ParseTuple(args, "O&", option_uint32, &level)) return NULL;
    if (mw_icosphere_size(level, &vertices, &triangles, &error))
        return errors_raise(PyModule_GetState(module), &error);
    return Py_BuildValue("(II)", vertices, triangles);
}

/* describe(): a dictionary of the members of mw_star_info */
static PyObject *star_describe(PyObject *self, PyObject *unused)
{
    mw_star_info info;
    (void)unused;
    mw_star_describe(((star_object *)self)->star, &info);
    return Py_BuildValue("{s:n,s:n,s:I,s:(ddd)}", "bytes", (Py_ssize_t)info.bytes, "angle_bytes",
                         (Py_ssize_t)info.angle_bytes, "flat_facets", info.flat_facets, "centre",
                         info.centre[0], info.centre[1], info.centre[2]);
}

static PyObject *star_surface(PyObject *self, void *unused)
{
    (void)unused;
    return Py_NewRef(((star_object *)self)->surface);
}

/* Two buffers: `from` of rows that are to be converted to the rows of `to`. */
typedef struct star_rows {
    buffer_points from;
    Py_buffer to;
} star_rows;

static int star_get_rows(PyObject *args, size_t from_width, size_t to_width, star_rows *rows)
{
    PyObject *from, *to;
    if (!PyArg_ParseTuple(args, "OO", &from, &to) ||
        buffer_get_points(from, from_width, &rows->from))
        return -1;
    if (!buffer_get_writable(to, to_width * sizeof(double), rows->from.count, &rows->to)) return 0;
    PyBuffer_Release(&rows->from.view);
    return -1;
}

static PyObject *star_release_rows(star_rows *rows)
{
    PyBuffer_Release(&rows->from.view);
    PyBuffer_Release(&rows->to);
    Py_RETURN_NONE;
}

/* lonlat_to_direction(lonlat, out) */
static PyObject *star_from_lonlat(PyObject *module, PyObject *args)
{
    star_rows rows;
    (void)module;
    if (star_get_rows(args, 2, 3, &rows)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    for (size_t i = 0; i < rows.from.count; i++) {
        const double *lonlat = rows.from.points + i * rows.from.stride;
        mw_lonlat_to_direction(lonlat[0], lonlat[1], (double *)rows.to.buf + 3 * i);
    }
    Py_END_ALLOW_THREADS
    return star_release_rows(&rows);
}

/* direction_to_lonlat(directions, out) */
static PyObject *star_to_lonlat(PyObject *module, PyObject *args)
{
    star_rows rows;
    (void)module;
    if (star_get_rows(args, 3, 2, &rows)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    for (size_t i = 0; i < rows.from.count; i++) {
        double *lonlat = (double *)rows.to.buf + 2 * i;
        mw_direction_to_lonlat(rows.from.points + i * rows.from.stride, &lonlat[0], &lonlat[1]);
    }
    Py_END_ALLOW_THREADS
    return star_release_rows(&rows);
}

static PyMethodDef star_methods[] = {
    {"_locate", star_locate, METH_VARARGS, NULL},
    {"_project", star_project, METH_VARARGS, NULL},
    {"_remesh", star_remesh, METH_VARARGS, NULL},
    {"_describe", star_describe, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static PyObject *star_ready(PyObject *self, void *unused)
{
    int ready;
    (void)unused;
    Py_BEGIN_ALLOW_THREADS
    ready = mw_star_ready(((star_object *)self)->star);
    Py_END_ALLOW_THREADS
    return PyBool_FromLong(ready);
}

static PyGetSetDef star_members[] = {
    {"surface", star_surface, NULL, "The surface that rays meet.", NULL},
    {"ready", star_ready, NULL, "Whether the surface is star-shaped now, and the star answers.",
     NULL},
    {NULL, NULL, NULL, NULL, NULL},
};

static PyType_Slot star_slots[] = {
    {Py_tp_doc, "A star of the library."}, {Py_tp_dealloc, star_dealloc},
    {Py_tp_traverse, star_traverse},       {Py_tp_methods, star_methods},
    {Py_tp_getset, star_members},          {0, NULL},
};

static PyType_Spec star_spec = {
    .name = "meshwalk._core.Star",
    .basicsize = sizeof(star_object),
    .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE | Py_TPFLAGS_HAVE_GC |
             Py_TPFLAGS_DISALLOW_INSTANTIATION,
    .slots = star_slots,
};

static PyMethodDef star_functions[] = {
    {"star_from_surface", star_from_surface, METH_VARARGS, NULL},
    {"icosphere_size", star_icosphere_size, METH_VARARGS, NULL},
    {"lonlat_to_direction", star_from_lonlat, METH_VARARGS, NULL},
    {"direction_to_lonlat", star_to_lonlat, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int star_init(PyObject *module, core_state *state)
{
    state->star_type = objects_add_type(module, &star_spec);
    return state->star_type ? PyModule_AddFunctions(module, star_functions) : -1;
}
