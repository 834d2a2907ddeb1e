/* raster_mesh.h - the mesh that a raster is made of. */
#ifndef MW_CLI_RASTER_RASTER_MESH_H
#define MW_CLI_RASTER_RASTER_MESH_H

#include "cli/frame/options.h"
#include "cli/input/mesh_field.h"

typedef struct raster_mesh_settings {
    const common_settings *common;
    mesh_field_choice field;
    const char *crs; /* of the mesh; NULL: not given */
    double max_edge; /* 0: not given */
    bool over_time;  /* the file's own values are not asked for: `values` is empty */
    bool border;     /* the nearest point of the border will be asked for */
    bool cut;        /* a mesh that goes round the globe is cut */
} raster_mesh_settings;

typedef struct raster_mesh {
    mw_prepared *map; /* of a prepared file, which has mesh and locator; or NULL */
    mw_mesh *mesh;
    const mw_locator *locator;
    mw_locator *own_locator;
    double *values;    /* one for each vertex, NaN where it is missing */
    mw_operator *seam; /* makes them of `own` where the mesh was cut (mesh_seam.h); else NULL */
    double *own;       /* one for each vertex of the file, then */
    double west;       /* where the longitudes of the pieces begin */
    size_t file_vertices;
    uint32_t *numbers; /* in the file, of the triangles that --max-edge has left; NULL: the same */
    double *cells;     /* one for each face of the file, where those are asked for; not owned */
    uint32_t *faces;   /* in the file, of its triangles; NULL: triangle i is face i */
    size_t face_count; /* of the file */
    size_t peeled;     /* triangles that --max-edge took away */
    double extent[4];  /* xmin, ymin, xmax, ymax of the vertices that triangles have */
    uint64_t vertices; /* that triangles have */
    char *crs;         /* NULL: not known */
} raster_mesh;

/* The face of the file that a triangle is a part of. */
static inline uint32_t raster_mesh_face(const raster_mesh *m, uint32_t triangle)
{
    uint32_t t = m->numbers ? m->numbers[triangle] : triangle;
    return m->faces ? m->faces[t] : t;
}

/* Returns 0, or an exit code after a complaint; release it in both cases. */
int raster_mesh_read(raster_mesh *m, const char *path, const raster_mesh_settings *settings);
void raster_mesh_release(raster_mesh *m);

/* Make the values of those at the file's vertices, if the mesh was cut. */
int raster_mesh_spread(raster_mesh *m);

/* The area of the triangles. */
double raster_mesh_area(const raster_mesh *m);

#endif
