/* progress.c - reports of long calls: Ctrl-C ends them, and so does an exception of the caller's
 * function. */
#include "core.h"

/* On the thread that made the call, which has released the interpreter lock. An exception stays
 * with the thread until errors_raise meets MW_CANCELLED. */
static int progress_report(void *context, const char *stage, double fraction)
{
    PyObject *function = context;
    PyGILState_STATE lock = PyGILState_Ensure();
    /* After the last report nothing is left to cancel: the interpreter looks for signals itself. */
    int stop = fraction < 1 && PyErr_CheckSignals();
    if (!stop && function != Py_None && !PyCallable_Check(function)) {
        PyErr_Format(PyExc_TypeError,
                     "progress must be a function of a text and a fraction, not %R", function);
        if (fraction >= 1) PyErr_WriteUnraisable(function);
        stop = fraction < 1;
    } else if (!stop && function != Py_None) {
        PyObject *result = PyObject_CallFunction(function, "sd", stage, fraction);
        Py_XDECREF(result);
        if (!result && fraction >= 1) PyErr_WriteUnraisable(function);
        stop = !result && fraction < 1;
    }
    PyGILState_Release(lock);
    return stop;
}

const mw_progress *progress_begin(const core_state *state, PyObject *function,
                                  mw_progress *progress)
{
    /* Signals reach the main thread only; another would take the lock for nothing. */
    if (function == Py_None && PyThread_get_thread_ident() != state->main_thread) return NULL;
    *progress = (mw_progress){.report = progress_report, .context = function};
    return progress;
}
