/* sight.c - lines of sight from one viewpoint to many targets. */
#include "core.h"

/* Lines of sight from a viewpoint to targets: x, y and height of each. */
typedef struct sight_search {
    mw_viewpoint view;
    const buffer_points *targets;
    int absolute;
    mw_sight *sights;
    const mw_progress *progress;
} sight_search;

static mw_status sight_run(sight_search *s, mw_error *error)
{
    enum { REPORTS = 200 };
    const size_t count = s->targets->count;
    size_t told = 0;
    for (size_t i = 0; i < count; i++) {
        const double *p = s->targets->points + i * s->targets->stride;
        const mw_sight_end to = {.x = p[0], .y = p[1], .height = p[2], .absolute = s->absolute};
        s->sights[i] = mw_sight_to(&s->view, &to);
        if (!s->progress || (i + 1) * REPORTS / count == told) continue;
        told = (i + 1) * REPORTS / count;
        if (s->progress->report(s->progress->context, "looking", (double)told / REPORTS) &&
            told < REPORTS)
            return error->status = MW_CANCELLED;
    }
    return MW_OK;
}

/* sights(locator, heights, (x, y, height, absolute), targets, absolute, out, progress) */
static PyObject *sight_look(PyObject *module, PyObject *args)
{
    core_state *state = PyModule_GetState(module);
    PyObject *object, *heights, *targets, *out, *function;
    mw_sight_end from = {0};
    mw_progress progress;
    Py_buffer height_view;
    buffer_batch batch;
    sight_search search = {.targets = &batch.points};
    mw_error error;
    mw_status status;
    if (!PyArg_ParseTuple(args, "O!O(dddp)OpOO", state->locator_type, &object, &heights, &from.x,
                          &from.y, &from.height, &from.absolute, &targets, &search.absolute, &out,
                          &function))
        return NULL;
    const mw_locator *locator = ((locator_object *)object)->locator;
    if (buffer_get_packed(heights, sizeof(double), mw_mesh_vertex_count(locator_get_mesh(object)),
                          &height_view))
        return NULL;
    if (buffer_get_batch(targets, 3, out, sizeof(mw_sight), Py_None, &batch)) {
        PyBuffer_Release(&height_view);
        return NULL;
    }
    search.sights = batch.out.buf;
    search.progress = progress_begin(state, function, &progress);
    Py_BEGIN_ALLOW_THREADS
    status = mw_viewpoint_init(locator, height_view.buf, &from, &search.view, &error);
    if (!status) status = sight_run(&search, &error);
    Py_END_ALLOW_THREADS
    buffer_release_batch(&batch);
    PyBuffer_Release(&height_view);
    if (status) return errors_raise(state, &error);
    Py_RETURN_NONE;
}

static PyMethodDef sight_functions[] = {
    {"sights", sight_look, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

int sight_init(PyObject *module)
{
    return PyModule_AddFunctions(module, sight_functions);
}
