/* layouts.c - where the members of the library's answers stand, as NumPy wants to know it. */
#include "core.h"

static int layout_add(PyObject *module, const char *name, PyObject *layout)
{
    int failed = !layout || PyModule_AddObjectRef(module, name, layout);
    Py_XDECREF(layout);
    return failed ? -1 : 0;
}

#define LAYOUT_MEMBER(type, name, member) name, (Py_ssize_t)offsetof(type, member)

static int layout_add_location(PyObject *module)
{
    return layout_add(module, "LOCATION_LAYOUT",
                      Py_BuildValue("{s:n,s:n,s:n,s:n,s:n,s:n}",
                                    LAYOUT_MEMBER(mw_location, "weights", weight),
                                    LAYOUT_MEMBER(mw_location, "triangle", triangle),
                                    LAYOUT_MEMBER(mw_location, "hole", hole),
                                    LAYOUT_MEMBER(mw_location, "where", where),
                                    LAYOUT_MEMBER(mw_location, "local", local), "itemsize",
                                    (Py_ssize_t)sizeof(mw_location)));
}

static int layout_add_touch(PyObject *module)
{
    return layout_add(
        module, "TOUCH_LAYOUT",
        Py_BuildValue(
            "{s:n,s:n,s:n,s:n,s:n,s:n,s:n,s:n}", LAYOUT_MEMBER(mw_touch, "distance", distance),
            LAYOUT_MEMBER(mw_touch, "weights", weight),
            LAYOUT_MEMBER(mw_touch, "triangle", triangle), LAYOUT_MEMBER(mw_touch, "state", state),
            LAYOUT_MEMBER(mw_touch, "where", where), LAYOUT_MEMBER(mw_touch, "local", local),
            LAYOUT_MEMBER(mw_touch, "back", back), "itemsize", (Py_ssize_t)sizeof(mw_touch)));
}

static int layout_add_nearest(PyObject *module)
{
    return layout_add(module, "NEAREST_LAYOUT",
                      Py_BuildValue("{s:n,s:n,s:n,s:n,s:n}",
                                    LAYOUT_MEMBER(mw_nearest_surface_point, "triangle", triangle),
                                    LAYOUT_MEMBER(mw_nearest_surface_point, "distance", distance),
                                    LAYOUT_MEMBER(mw_nearest_surface_point, "point", point),
                                    LAYOUT_MEMBER(mw_nearest_surface_point, "weights", weight),
                                    "itemsize", (Py_ssize_t)sizeof(mw_nearest_surface_point)));
}

static int layout_add_border(PyObject *module)
{
    return layout_add(module, "BORDER_LAYOUT",
                      Py_BuildValue("{s:n,s:n,s:n,s:n,s:n,s:n}",
                                    LAYOUT_MEMBER(mw_nearest_border_point, "triangle", triangle),
                                    LAYOUT_MEMBER(mw_nearest_border_point, "edge", edge),
                                    LAYOUT_MEMBER(mw_nearest_border_point, "distance", distance),
                                    LAYOUT_MEMBER(mw_nearest_border_point, "point", point),
                                    LAYOUT_MEMBER(mw_nearest_border_point, "weights", weight),
                                    "itemsize", (Py_ssize_t)sizeof(mw_nearest_border_point)));
}

static int layout_add_piece(PyObject *module)
{
    return layout_add(module, "PIECE_LAYOUT",
                      Py_BuildValue("{s:n,s:n,s:n,s:n,s:n,s:n,s:n,s:n}",
                                    LAYOUT_MEMBER(mw_segment_piece, "start", from),
                                    LAYOUT_MEMBER(mw_segment_piece, "stop", to),
                                    LAYOUT_MEMBER(mw_segment_piece, "triangle", triangle),
                                    LAYOUT_MEMBER(mw_segment_piece, "start_at", from_at),
                                    LAYOUT_MEMBER(mw_segment_piece, "stop_at", to_at),
                                    LAYOUT_MEMBER(mw_segment_piece, "along", along),
                                    LAYOUT_MEMBER(mw_segment_piece, "gap", gap), "itemsize",
                                    (Py_ssize_t)sizeof(mw_segment_piece)));
}

static int layout_add_changed(PyObject *module)
{
    return layout_add(module, "CHANGED_LAYOUT",
                      Py_BuildValue("{s:n,s:n,s:n}",
                                    LAYOUT_MEMBER(mw_changed_triangle, "triangle", triangle),
                                    LAYOUT_MEMBER(mw_changed_triangle, "before", before),
                                    "itemsize", (Py_ssize_t)sizeof(mw_changed_triangle)));
}

static int layout_add_changed_vertex(PyObject *module)
{
    return layout_add(module, "CHANGED_VERTEX_LAYOUT",
                      Py_BuildValue("{s:n,s:n,s:n}",
                                    LAYOUT_MEMBER(mw_changed_vertex, "vertex", vertex),
                                    LAYOUT_MEMBER(mw_changed_vertex, "other", other), "itemsize",
                                    (Py_ssize_t)sizeof(mw_changed_vertex)));
}

static int layout_add_sight(PyObject *module)
{
    return layout_add(module, "SIGHT_LAYOUT",
                      Py_BuildValue("{s:n,s:n,s:n,s:n}", LAYOUT_MEMBER(mw_sight, "at", at),
                                    LAYOUT_MEMBER(mw_sight, "triangle", triangle),
                                    LAYOUT_MEMBER(mw_sight, "state", state), "itemsize",
                                    (Py_ssize_t)sizeof(mw_sight)));
}

int layouts_init(PyObject *module)
{
    return layout_add_location(module) || layout_add_touch(module) || layout_add_nearest(module) ||
                   layout_add_changed(module) || layout_add_changed_vertex(module) ||
                   layout_add_piece(module) || layout_add_border(module) || layout_add_sight(module)
               ? -1
               : 0;
}
