/* check.c - the public check of a mesh that is still arrays, however damaged. */
#include "domain/survey.h"
#include "mesh/damage.h"

#include <stdlib.h>

/* Survey a mesh, and append what it finds to `defects`, but for what concerns replaced triangles (NULL: there are
 * none). */
static mw_status survey_mesh(const mw_mesh *mesh, const uint8_t *replaced, mw_defects *defects, mw_error *error)
{
    mw_survey survey;
    mw_status status = mw__survey_create(&survey, mesh, error);
    for (size_t i = 0; i < survey.defects.count && !status; i++) {
        const mw_defect *defect = &survey.defects.list[i];
        if (replaced && replaced[defect->triangle]) continue;
        if (!mw__defects_add(defects, *defect)) status = mw__fail_memory(error);
    }
    mw__survey_release(&survey);
    return status;
}

/* Arrays that mw_mesh_create refuses: list what is unusable, take the rest as a tolerant mesh. */
static mw_status check_damaged(const mw_arrays *arrays, mw_defects *defects, mw_error *error)
{
    mw_repair repair;
    mw_mesh *mesh = NULL;
    mw_mesh_options tolerant = {.tolerant = 1};
    mw_status status = mw__repair(&repair, arrays, defects, error);
    if (!status && arrays->point_count > 0) {
        status = mw_mesh_create(&repair.arrays, &tolerant, &mesh, error);
        if (!status) status = survey_mesh(mesh, repair.replaced, defects, error);
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
        status = survey_mesh(mesh, NULL, &defects, error);
    else if (status == MW_ERROR_INPUT)
        status = check_damaged(arrays, &defects, error);
    mw_mesh_destroy(mesh);
    if (status) {
        mw__defects_release(&defects);
        return status;
    }
    check->defects = defects.list;
    check->defect_count = defects.count;
    check->valid = defects.count == 0 || defects.list[0].kind == MW_DEFECT_FLAT; /* the last kind in their order */
    return MW_OK;
}

void mw_check_release(mw_check *check)
{
    if (!check) return;
    free(check->defects);
    *check = (mw_check){0};
}
