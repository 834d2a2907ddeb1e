/* mesh_check.c - the public check of a mesh that is still arrays, with any damage. */
#include "tiling/embedding_check.h"
#include "base/options.h"
#include "mesh/array_defects.h"
#include "mesh/mesh_create.h"

/* Append the defects of a mesh to `defects`, except those of replaced triangles (NULL: none are
 * replaced). */
static mw_status mesh_find_defects(const mw_mesh *mesh, const uint8_t *replaced, mw_job *job,
                                   mw_defects *defects, mw_error *error)
{
    mw_embedding_check check_of_mesh;
    mw_status status = mw__embedding_check_create(&check_of_mesh, mesh, job, error);
    for (size_t i = 0; i < check_of_mesh.defects.count && !status; i++) {
        const mw_defect *defect = &check_of_mesh.defects.list[i];
        if (replaced && replaced[defect->triangle]) continue;
        if (!mw__defects_add(defects, *defect)) status = mw__fail_memory(error);
    }
    mw__embedding_check_release(&check_of_mesh);
    return status;
}

/* Check arrays that mw_mesh_create refuses: list the unusable triangles, and make a tolerant mesh
 * of the rest. */
static mw_status mesh_check_damaged(const mw_arrays *arrays, mw_job *job, mw_defects *defects,
                                    mw_error *error)
{
    mw_repair repair;
    mw_mesh *mesh = NULL;
    mw_mesh_options tolerant = {.tolerant = 1};
    mw_status status = mw__repair_create(&repair, arrays, defects, error);
    if (!status && arrays->point_count > 0) {
        mw_job_span outer = mw__job_part(job, 0.3);
        status = mw__mesh_create(&repair.arrays, &tolerant, job, &mesh, error);
        mw__job_part_end(job, outer);
        outer = mw__job_part(job, 0.7);
        if (!status) status = mesh_find_defects(mesh, repair.replaced, job, defects, error);
        mw__job_part_end(job, outer);
    }
    mw_mesh_destroy(mesh);
    mw__repair_release(&repair);
    return status;
}

/* The mesh takes 0.3 of the whole, its check the rest. A damaged mesh is made again. */
static mw_status mesh_check(const mw_arrays *arrays, mw_job *job, mw_defects *defects,
                            mw_error *error)
{
    static const mw_mesh_options plain;
    mw_mesh *mesh = NULL;
    mw_job_span outer = mw__job_part(job, 0.3);
    mw_status status = mw__mesh_create(arrays, &plain, job, &mesh, error);
    mw__job_part_end(job, outer);
    outer = mw__job_part(job, 0.7);
    if (status == MW_OK)
        status = mesh_find_defects(mesh, NULL, job, defects, error);
    else if (status == MW_ERROR_INPUT)
        status = mesh_check_damaged(arrays, job, defects, error);
    mw__job_part_end(job, outer);
    mw_mesh_destroy(mesh);
    return status;
}

mw_status mw_check_arrays(const mw_arrays *arrays, const mw_check_options *options, mw_check *check,
                          mw_error *error)
{
    static const mw_check_options defaults;
    if (!check) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the report is NULL");
    *check = (mw_check){0};
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_check_options, options, error);
    if (status) return status;
    mw_defects defects = {0};
    mw_job job = mw__job(options->threads, options->progress);
    status = mw__job_end(&job, mesh_check(arrays, &job, &defects, error), error);
    if (status) {
        mw__defects_release(&defects);
        return status;
    }
    check->defects = defects.list;
    check->defect_count = defects.count;
    /* Flat triangles come last in their order. */
    check->valid = defects.count == 0 || defects.list[0].kind == MW_DEFECT_FLAT;
    return MW_OK;
}
