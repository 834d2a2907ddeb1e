/* mesh_check.c - the public check of a mesh that is still arrays, with any damage. */
#include "tiling/embedding_check.h"
#include "mesh/array_defects.h"

#include <stdlib.h>

/* Append the defects of a mesh to `defects`, except those of replaced triangles (NULL: none are
 * replaced). */
static mw_status mesh_find_defects(const mw_mesh *mesh, const uint8_t *replaced, mw_defects *defects, mw_error *error)
{
    mw_embedding_check check_of_mesh;
    mw_status status = mw__embedding_check_create(&check_of_mesh, mesh, error);
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
static mw_status mesh_check_damaged(const mw_arrays *arrays, mw_defects *defects, mw_error *error)
{
    mw_repair repair;
    mw_mesh *mesh = NULL;
    mw_mesh_options tolerant = {.tolerant = 1};
    mw_status status = mw__repair_create(&repair, arrays, defects, error);
    if (!status && arrays->point_count > 0) {
        status = mw_mesh_create(&repair.arrays, &tolerant, &mesh, error);
        if (!status) status = mesh_find_defects(mesh, repair.replaced, defects, error);
    }
    mw_mesh_destroy(mesh);
    mw__repair_release(&repair);
    return status;
}

mw_status mw_check_arrays(const mw_arrays *arrays, mw_check *check, mw_error *error)
{
    if (!check) return mw__fail(error, MW_ERROR_ARGUMENT, "no place for the check");
    *check = (mw_check){0};
    mw_defects defects = {0};
    mw_mesh *mesh;
    mw_status status = mw_mesh_create(arrays, NULL, &mesh, error);
    if (status == MW_OK)
        status = mesh_find_defects(mesh, NULL, &defects, error);
    else if (status == MW_ERROR_INPUT)
        status = mesh_check_damaged(arrays, &defects, error);
    mw_mesh_destroy(mesh);
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

void mw_check_release(mw_check *check)
{
    if (!check) return;
    free(check->defects);
    *check = (mw_check){0};
}
