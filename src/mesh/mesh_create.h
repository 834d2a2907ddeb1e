/* mesh_create.h - makes a planar mesh within a longer job. Private. */
#ifndef MW_SRC_MESH_MESH_CREATE_H
#define MW_SRC_MESH_MESH_CREATE_H

#include "base/job.h"
#include "mesh/mesh.h"

/* As mw_mesh_create, as stages of the present part of the job. The threads and the progress of the
 * options are those of the job. *out is not changed on failure. */
mw_status mw__mesh_create(const mw_arrays *arrays, const mw_mesh_options *options, mw_job *job,
                          mw_mesh **out, mw_error *error);

#endif
