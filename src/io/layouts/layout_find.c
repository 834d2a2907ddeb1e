#include "io/layouts/layout_find.h"

#include "io/layouts/layout_axis.h"
#include "io/layouts/ugrid.h"

#include <meshwalk/io.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A layout, recognised by the names of its variables. The first pair of coordinates that exists and
 * is not constant is used. */
typedef struct named_layout {
    const char *name, *corners, *counts;
    const char *pairs[2][2];
    const char *z[2];
    int first_number;
    bool zero_missing, open_dropped, radians;
} named_layout;

/* FVCOM: nv(three, nele); runs in metres have lon and lat of zeros, those in degrees x and y.
 * MPAS: the dual triangles, whose vertices are the centres of the cells, where most values are.
 * ICON: a grid file has vertex_of_cell; output has the corners of each cell only. */
static const named_layout layouts[] = {
    {.name = "ugrid"},
    {.name = "schism",
     .corners = "SCHISM_hgrid_face_nodes",
     .pairs = {{"SCHISM_hgrid_node_x", "SCHISM_hgrid_node_y"}},
     .first_number = 1},
    {.name = "fvcom", .corners = "nv", .pairs = {{"lon", "lat"}, {"x", "y"}}, .first_number = 1},
    {.name = "adcirc", .corners = "element", .pairs = {{"x", "y"}}, .first_number = 1},
    {.name = "anuga",
     .corners = "volumes",
     .pairs = {{"x", "y"}},
     .z = {"elevation", "z"},
     .first_number = 0},
    {.name = "fesom", .corners = "face_nodes", .pairs = {{"lon", "lat"}}, .first_number = 1},
    {.name = "fesom", .corners = "elements", .pairs = {{"lon", "lat"}}, .first_number = 1},
    {.name = "fesom", .corners = "elem", .pairs = {{"lon", "lat"}}, .first_number = 1},
    {.name = "icon",
     .corners = "vertex_of_cell",
     .pairs = {{"vlon", "vlat"}, {"longitude_vertices", "latitude_vertices"}},
     .first_number = 1,
     .radians = true},
    {.name = "icon", .pairs = {{"clon_bnds", "clat_bnds"}}, .radians = true},
    {.name = "icon", .pairs = {{"clon_vertices", "clat_vertices"}}, .radians = true},
    {.name = "mpas",
     .corners = "cellsOnVertex",
     .pairs = {{"lonCell", "latCell"}, {"xCell", "yCell"}},
     .first_number = 1,
     .zero_missing = true,
     .open_dropped = true,
     .radians = true},
    {.name = "tuflowfv",
     .corners = "cell_node",
     .counts = "cell_Nvert",
     .pairs = {{"node_X", "node_Y"}},
     .z = {"node_Zb"},
     .first_number = 1,
     .zero_missing = true},
};
enum { LAYOUT_COUNT = sizeof layouts / sizeof *layouts };

/* Degrees or radians, longitudes or metres. */
static mw_status layout_units(const mw_netcdf *file, mw_layout *layout, bool radians_known,
                              mw_error *error)
{
    mw_axis_kind x, y;
    bool radians[2];
    mw_status status = mw__layout_axis(file, layout->x, &x, &radians[0], error);
    if (!status) status = mw__layout_axis(file, layout->y, &y, &radians[1], error);
    if (status) return status;
    bool named = strncmp(layout->x->name, "lon", 3) == 0 && strncmp(layout->y->name, "lat", 3) == 0;
    bool unknown = x == MW_AXIS_UNKNOWN && y == MW_AXIS_UNKNOWN;
    layout->lonlat = (x == MW_AXIS_LONGITUDE && y == MW_AXIS_LATITUDE) || (unknown && named) ||
                     (radians[0] && radians[1]) || radians_known;
    bool degrees = layout->lonlat && !unknown && !radians[0];
    bool turn = (radians[0] && radians[1]) || (radians_known && !degrees);
    layout->scale = turn ? 180 / 3.14159265358979323846 : 1;
    return MW_OK;
}

/* Are all values equal? Then this is not a coordinate: a run in metres has zeros as longitudes. */
static mw_status layout_constant(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                 bool *constant, mw_error *error)
{
    enum { LOOKED_AT = 1024 };
    double values[LOOKED_AT];
    size_t start[MW_NETCDF_RANK] = {0}, counts[MW_NETCDF_RANK] = {0};
    counts[0] = variable->lengths[0] < LOOKED_AT ? variable->lengths[0] : LOOKED_AT;
    mw_status status = mw__netcdf_doubles(file, variable, start, counts, values, error);
    *constant = counts[0] > 1;
    for (size_t i = 1; !status && i < counts[0]; i++)
        if (values[i] != values[0]) *constant = false;
    return status;
}

static mw_status layout_pair(const mw_netcdf *file, const named_layout *named, mw_layout *layout,
                             mw_error *error)
{
    for (int k = 0; k < 2 && named->pairs[k][0]; k++) {
        const mw_netcdf_variable *x = mw__netcdf_find(file, named->pairs[k][0]);
        const mw_netcdf_variable *y = mw__netcdf_find(file, named->pairs[k][1]);
        if (!x || !y) continue;
        bool constant = false;
        layout->x = x;
        layout->y = y;
        if (k == 0 && named->pairs[1][0] && x->rank == 1) {
            mw_status status = layout_constant(file, x, &constant, error);
            if (status) return status;
        }
        if (!constant) return MW_OK;
    }
    return MW_OK;
}

static mw_status layout_named(const mw_netcdf *file, const named_layout *named, mw_layout *layout,
                              mw_error *error)
{
    if (named->corners) layout->corners = mw__netcdf_find(file, named->corners);
    if (named->corners && !layout->corners) return MW_OK;
    mw_status status = layout_pair(file, named, layout, error);
    if (status || !layout->x) return status;
    if (named->counts) status = mw__netcdf_need(file, named->counts, &layout->counts, error);
    for (int k = 0; k < 2 && named->z[k] && !layout->z; k++) {
        layout->z = mw__netcdf_find(file, named->z[k]);
        if (layout->z && layout->z->rank != 1) layout->z = NULL;
    }
    layout->first_number = named->first_number;
    layout->zero_missing = named->zero_missing;
    layout->open_dropped = named->open_dropped;
    return status;
}

/* Which dimension of a table is that of the faces? In UGRID it is the first unless attributes say
 * otherwise. Some programs write the corners first without saying so; then the shorter dimension is
 * that of the corners. */
static bool layout_corner_first(const mw_layout *layout, const mw_netcdf_variable *table)
{
    enum { COMMON_CORNERS = 4, MANY_CORNERS = 12 };
    if (layout->face_dimension >= 0 && table->dimensions[0] != table->dimensions[1]) {
        if (table->dimensions[0] == layout->face_dimension) return false;
        if (table->dimensions[1] == layout->face_dimension) return true;
    }
    bool as_fortran = strcmp(layout->name, "fvcom") == 0 || strcmp(layout->name, "fesom") == 0 ||
                      (strcmp(layout->name, "icon") == 0 && layout->corners);
    if (as_fortran) return table->lengths[0] == 3;
    return table->lengths[0] <= COMMON_CORNERS && table->lengths[0] >= 3 &&
           table->lengths[1] > MANY_CORNERS;
}

static mw_status layout_check_table(const mw_netcdf *file, mw_layout *layout, mw_error *error)
{
    const mw_netcdf_variable *table = layout->corners ? layout->corners : layout->x;
    if (table->rank != 2)
        return mw__netcdf_fail(file, table, error,
                               "it has %zu dimensions, not two: faces and their corners",
                               table->rank);
    layout->corner_first = layout_corner_first(layout, table);
    layout->face_count = table->lengths[layout->corner_first];
    layout->corner_count = table->lengths[!layout->corner_first];
    layout->face_dimension = layout->open_dropped ? -1 : table->dimensions[layout->corner_first];
    if (layout->corner_count < 3)
        return mw__netcdf_fail(file, table, error,
                               "its faces have %zu corners; at least 3 are needed",
                               layout->corner_count);
    return MW_OK;
}

static mw_status layout_check(const mw_netcdf *file, mw_layout *layout, mw_error *error)
{
    size_t rank = layout->corners ? 1 : 2;
    const mw_netcdf_variable *axes[] = {layout->x, layout->y, layout->z};
    for (int k = 0; k < 3; k++) {
        if (!axes[k]) continue;
        if (axes[k]->rank != rank)
            return mw__netcdf_fail(file, axes[k], error,
                                   "it is a coordinate, but has %zu dimensions", axes[k]->rank);
        if (axes[k]->dimensions[rank - 1] != layout->x->dimensions[rank - 1])
            return mw__netcdf_fail(file, axes[k], error, "its dimensions are not those of %.80s",
                                   layout->x->name);
    }
    layout->vertex_dimension = layout->corners ? layout->x->dimensions[0] : -1;
    mw_status status = layout_check_table(file, layout, error);
    if (status || !layout->counts) return status;
    if (layout->counts->rank != 1 || layout->counts->lengths[0] != layout->face_count)
        return mw__netcdf_fail(file, layout->counts, error, "it is not one number for each face");
    return MW_OK;
}

/* start_index, which some write as a text or as a real number. */
static mw_status layout_first_number(const mw_netcdf *file, mw_layout *layout, mw_error *error)
{
    double first;
    char *text;
    if (!layout->corners || layout->first_stated) return MW_OK;
    mw_status status = mw__netcdf_text(file, layout->corners, "start_index", &text, error);
    if (status) return status;
    bool found = mw__netcdf_number(file, layout->corners, "start_index", &first);
    if (text) {
        first = strcmp(text, "0") == 0 ? 0 : strcmp(text, "1") == 0 ? 1 : NAN;
        found = true;
        free(text);
    }
    if (!found) return MW_OK;
    if (first != 0 && first != 1)
        return mw__netcdf_fail(file, layout->corners, error, "start_index is neither 0 nor 1");
    layout->first_number = (int)first;
    layout->first_stated = true;
    return MW_OK;
}

/* ANUGA counts from a corner of its own. */
static void layout_origin(const mw_netcdf *file, mw_layout *layout)
{
    if (strcmp(layout->name, "anuga") != 0) return;
    mw__netcdf_number(file, MW_NETCDF_FILE, "xllcorner", &layout->offset[0]);
    mw__netcdf_number(file, MW_NETCDF_FILE, "yllcorner", &layout->offset[1]);
}

/* The length of the name in NAME or NAME:n. */
static size_t layout_name_length(const char *wanted)
{
    return strcspn(wanted, ":");
}

static bool layout_is(const named_layout *named, const char *wanted)
{
    size_t length = layout_name_length(wanted);
    return strlen(named->name) == length && memcmp(named->name, wanted, length) == 0;
}

const char *mw_layout_name(size_t i)
{
    for (size_t k = 0; k < LAYOUT_COUNT; k++) {
        bool again = k > 0 && strcmp(layouts[k].name, layouts[k - 1].name) == 0;
        if (!again && i-- == 0) return layouts[k].name;
    }
    return NULL;
}

/* All layouts, for a message. */
static void layout_list(char *text, size_t size)
{
    size_t used = 0;
    const char *name;
    text[0] = 0;
    for (size_t i = 0; used < size && (name = mw_layout_name(i)); i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", name);
}

static bool layout_known(const char *wanted)
{
    for (size_t i = 0; i < LAYOUT_COUNT; i++)
        if (layout_is(&layouts[i], wanted)) return true;
    return false;
}

mw_status mw__layout_check(const char *wanted, mw_error *error)
{
    char names[128];
    layout_list(names, sizeof names);
    if (!wanted) return MW_OK;
    if (!layout_known(wanted))
        return mw__fail(error, MW_ERROR_ARGUMENT, "no layout '%.40s' (there are %s)", wanted,
                        names);
    const char *first = wanted + layout_name_length(wanted);
    if (!*first || strcmp(first, ":0") == 0 || strcmp(first, ":1") == 0) return MW_OK;
    return mw__fail(
        error, MW_ERROR_ARGUMENT,
        "layout '%.40s': after the colon, expected 0 or 1, the number of the first vertex", wanted);
}

/* Try one layout; layout->x stays NULL if it is not that of the file. */
static mw_status layout_try(const mw_netcdf *file, const named_layout *named, mw_layout *layout,
                            mw_error *error)
{
    mw_layout asked = *layout;
    layout->name = named->name;
    mw_status status = named->pairs[0][0] ? layout_named(file, named, layout, error)
                                          : mw__layout_ugrid(file, layout, error);
    if (status) return status;
    if (!layout->x) {
        *layout = asked;
        return MW_OK;
    }
    if (asked.first_stated) layout->first_number = asked.first_number;
    status = layout_first_number(file, layout, error);
    if (!status) status = layout_check(file, layout, error);
    if (!status)
        status =
            layout_units(file, layout, named->radians && strstr(layout->x->name, "lon"), error);
    layout_origin(file, layout);
    return status;
}

mw_status mw__layout_find(const mw_netcdf *file, const char *wanted, mw_layout *layout,
                          mw_error *error)
{
    char names[128];
    *layout = (mw_layout){.face_dimension = -1, .vertex_dimension = -1, .scale = 1};
    mw_status status = mw__layout_check(wanted, error);
    const char *first = wanted ? wanted + layout_name_length(wanted) : "";
    if (*first) {
        layout->first_number = first[1] - '0';
        layout->first_stated = true;
    }
    for (size_t i = 0; i < LAYOUT_COUNT && !status && !layout->x; i++)
        if (!wanted || layout_is(&layouts[i], wanted))
            status = layout_try(file, &layouts[i], layout, error);
    if (status || layout->x) return status;
    layout_list(names, sizeof names);
    if (wanted)
        return mw__netcdf_fail(file, NULL, error, "no mesh in the layout %.*s",
                               (int)layout_name_length(wanted), wanted);
    return mw__netcdf_fail(file, NULL, error, "no mesh in a known layout (%s)", names);
}
