/* UGRID 1.0: a variable with cf_role = mesh_topology names all others in its attributes. */
#include "io/layouts/ugrid.h"

#include "io/layouts/layout_axis.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Cut the next word off a text; NULL at its end. */
static char *ugrid_word(char **text)
{
    char *word = *text + strspn(*text, " \t\n");
    if (!*word) return NULL;
    char *end = word + strcspn(word, " \t\n");
    *text = *end ? end + 1 : end;
    *end = 0;
    return word;
}

/* The variable that an attribute of the topology names as its word number `index`. NULL without an
 * error: no such attribute or word. */
static mw_status ugrid_variable(const mw_netcdf *file, const mw_netcdf_variable *topology,
                                const char *attribute, int index, const mw_netcdf_variable **out,
                                mw_error *error)
{
    char *text;
    *out = NULL;
    mw_status status = mw__netcdf_text(file, topology, attribute, &text, error);
    if (status || !text) return status;
    char *rest = text, *word = NULL;
    for (int i = 0; i <= index; i++) word = ugrid_word(&rest);
    if (word) *out = mw__netcdf_find(file, word);
    if (word && !*out)
        status = mw__netcdf_fail(file, topology, error, "%s names '%.80s', which is not there",
                                 attribute, word);
    free(text);
    return status;
}

/* The heights under the name that D-Flow uses; UGRID defines none. NULL: there are none. */
static const mw_netcdf_variable *ugrid_heights(const mw_netcdf *file, const mw_layout *layout)
{
    char name[MW_NETCDF_NAME + 8];
    snprintf(name, sizeof name, "%s_node_z", layout->topology->name);
    const mw_netcdf_variable *z = mw__netcdf_find(file, name);
    bool fits = z && z->rank == 1 && z->dimensions[0] == layout->x->dimensions[0];
    return fits ? z : NULL;
}

/* "x y", or "lat lon" where somebody wrote that. */
static mw_status ugrid_coordinates(const mw_netcdf *file, mw_layout *layout, mw_error *error)
{
    const mw_netcdf_variable *axes[3];
    mw_axis_kind kind;
    bool radians;
    mw_status status = MW_OK;
    for (int k = 0; k < 3 && !status; k++)
        status = ugrid_variable(file, layout->topology, "node_coordinates", k, &axes[k], error);
    if (status) return status;
    if (!axes[0] || !axes[1])
        return mw__netcdf_fail(file, layout->topology, error,
                               "node_coordinates does not name two variables");
    status = mw__layout_axis(file, axes[0], &kind, &radians, error);
    bool swapped = kind == MW_AXIS_LATITUDE || kind == MW_AXIS_NORTHING;
    layout->x = axes[swapped];
    layout->y = axes[!swapped];
    layout->z = axes[2] ? axes[2] : ugrid_heights(file, layout);
    return status;
}

/* The dimension of the faces, if attributes name it; else -1. */
static mw_status ugrid_face_dimension(const mw_netcdf *file, mw_layout *layout, mw_error *error)
{
    char *name;
    const mw_netcdf_variable *centre;
    mw_status status = mw__netcdf_text(file, layout->topology, "face_dimension", &name, error);
    if (status) return status;
    layout->face_dimension = name ? mw__netcdf_dimension_find(file, name, NULL) : -1;
    free(name);
    if (layout->face_dimension >= 0) return MW_OK;
    status = ugrid_variable(file, layout->topology, "face_coordinates", 0, &centre, NULL);
    if (status == MW_ERROR_MEMORY) return mw__fail_memory(error);
    if (!status && centre && centre->rank == 1) layout->face_dimension = centre->dimensions[0];
    return MW_OK;
}

static mw_status ugrid_mesh(const mw_netcdf *file, mw_layout *layout, mw_error *error)
{
    mw_status status = ugrid_coordinates(file, layout, error);
    if (!status)
        status = ugrid_variable(file, layout->topology, "face_node_connectivity", 0,
                                &layout->corners, error);
    if (status) return status;
    if (!layout->corners)
        return mw__netcdf_fail(file, layout->topology, error,
                               "it has no face_node_connectivity: this is no mesh of faces");
    return ugrid_face_dimension(file, layout, error);
}

/* Is this the topology of a mesh of faces? That of a network has the dimension 1. */
static mw_status ugrid_is_topology(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                   bool *is, mw_error *error)
{
    double dimension;
    mw_status status =
        mw__layout_attribute_is(file, variable, "cf_role", "mesh_topology", is, error);
    if (status || !*is) return status;
    if (mw__netcdf_number(file, variable, "topology_dimension", &dimension)) *is = dimension == 2;
    return MW_OK;
}

mw_status mw__layout_ugrid(const mw_netcdf *file, mw_layout *layout, mw_error *error)
{
    for (size_t i = 0; i < mw__netcdf_variable_count(file); i++) {
        const mw_netcdf_variable *variable = mw__netcdf_variable_at(file, i);
        bool is;
        mw_status status = ugrid_is_topology(file, variable, &is, error);
        if (status) return status;
        if (!is) continue;
        layout->topology = variable;
        return ugrid_mesh(file, layout, error);
    }
    return MW_OK;
}
