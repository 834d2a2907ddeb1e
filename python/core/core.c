/* core.c - the module meshwalk._core: its state, and what is in it. */
#include "core.h"

static int core_add_numbers(PyObject *module)
{
    return PyModule_AddIntConstant(module, "MAX_TRIANGLES", MW_MAX_TRIANGLES) ||
           PyModule_AddStringConstant(module, "version", mw_version());
}

static int core_exec(PyObject *module)
{
    core_state *state = PyModule_GetState(module);
    state->main_thread = PyThread_get_thread_ident();
    return errors_init(state) || memory_init(module, state) || mesh_init(module, state) ||
                   location_init(module, state) || locator_init(module, state) ||
                   surface_init(module, state) || star_init(module, state) ||
                   prober_init(module, state) || editor_init(module, state) ||
                   surface_editor_init(module, state) || operator_init(module, state) ||
                   polygons_init(module, state) || check_init(module) || mend_init(module) ||
                   layouts_init(module) || triangulation_init(module) || files_init(module) ||
                   points_init(module) || borrowed_init(module) || segments_init(module) ||
                   overlap_init(module) || sight_init(module) || prepared_init(module) ||
                   options_init(module) || core_add_numbers(module)
               ? -1
               : 0;
}

static int core_traverse(PyObject *module, visitproc visit, void *arg)
{
    core_state *state = PyModule_GetState(module);
    Py_VISIT(state->mesh_type);
    Py_VISIT(state->locator_type);
    Py_VISIT(state->location_type);
    Py_VISIT(state->surface_type);
    Py_VISIT(state->star_type);
    Py_VISIT(state->prober_type);
    Py_VISIT(state->editor_type);
    Py_VISIT(state->surface_editor_type);
    Py_VISIT(state->operator_type);
    Py_VISIT(state->polygons_type);
    Py_VISIT(state->memory_type);
    Py_VISIT(state->input_error);
    Py_VISIT(state->limit_error);
    Py_VISIT(state->where_members);
    return 0;
}

static int core_clear(PyObject *module)
{
    core_state *state = PyModule_GetState(module);
    Py_CLEAR(state->mesh_type);
    Py_CLEAR(state->locator_type);
    Py_CLEAR(state->location_type);
    Py_CLEAR(state->surface_type);
    Py_CLEAR(state->star_type);
    Py_CLEAR(state->prober_type);
    Py_CLEAR(state->editor_type);
    Py_CLEAR(state->surface_editor_type);
    Py_CLEAR(state->operator_type);
    Py_CLEAR(state->polygons_type);
    Py_CLEAR(state->memory_type);
    Py_CLEAR(state->input_error);
    Py_CLEAR(state->limit_error);
    Py_CLEAR(state->where_members);
    return 0;
}

static void core_free(void *module)
{
    core_clear(module);
}

static PyModuleDef_Slot core_slots[] = {{Py_mod_exec, core_exec}, {0, NULL}};

static PyModuleDef core_module = {
    PyModuleDef_HEAD_INIT,
    .m_name = "meshwalk._core",
    .m_doc = "The library as it is. Use the package meshwalk instead.",
    .m_size = sizeof(core_state),
    .m_slots = core_slots,
    .m_traverse = core_traverse,
    .m_clear = core_clear,
    .m_free = core_free,
};

PyMODINIT_FUNC PyInit__core(void);
PyMODINIT_FUNC PyInit__core(void)
{
    return PyModuleDef_Init(&core_module);
}
