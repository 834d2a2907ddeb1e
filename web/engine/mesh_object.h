/* mesh_object.h - a mesh as a file had it, and as the library takes it. */
#ifndef MW_WEB_MESH_OBJECT_H
#define MW_WEB_MESH_OBJECT_H

#include "engine/engine.h"

typedef struct web_mesh {
    mw_mesh_file file;
    mw_mesh *mesh; /* NULL until it is asked for */
} web_mesh;

/* The mesh of the plane, made by the first call; NULL if the arrays are unusable (web_error). */
mw_mesh *web_mesh_planar(web_mesh *m);

#endif
