/* mesh_layout.h - what is known of a mesh in a netCDF file before it is read. Private. */
#ifndef MW_SRC_IO_LAYOUTS_MESH_LAYOUT_H
#define MW_SRC_IO_LAYOUTS_MESH_LAYOUT_H

#include "io/netcdf/netcdf_file.h"

typedef struct mw_layout {
    const char *name;
    const mw_netcdf_variable *topology; /* UGRID's variable that names the others; or NULL */
    const mw_netcdf_variable *x, *y; /* of the vertices; without `corners` of each face's corners */
    const mw_netcdf_variable *z;     /* heights of the vertices; NULL: none */
    const mw_netcdf_variable *corners; /* vertices of the faces; NULL: x and y of each corner */
    const mw_netcdf_variable *counts;  /* corners of each face; NULL: as many as are not missing */
    int vertex_dimension;              /* -1: no variable can be over the vertices */
    int face_dimension;                /* -1: no variable can be over the faces that are kept */
    size_t face_count, corner_count;   /* lengths of the dimensions of `corners` */
    bool corner_first;                 /* the faces are its last dimension */
    int first_number;                  /* of the vertices in `corners`: 0 or 1 */
    bool first_stated;                 /* by the file or the user: no other is tried */
    bool zero_missing;                 /* vertices count from 1, and 0 is none */
    bool open_dropped;                 /* faces that lack a corner are left out */
    bool lonlat;                       /* x and y are longitudes and latitudes */
    double scale, offset[2];           /* what makes x and y from the numbers in the file */
} mw_layout;

#endif
