/* check.c - the public check of a mesh that is still arrays, however damaged. */
#include "domain/survey.h"

#include <stdlib.h>

/* The triangles with numbers out of range replaced by 0 0 0, so that a tolerant mesh can be made of the rest. */
typedef struct repair {
    uint32_t *triangles;
    uint8_t *replaced;
} repair;

static bool repair_triangle(repair *r, const mw_arrays *arrays, uint32_t t, mw_defects *defects)
{
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t v = mw__index_at(arrays, 3 * (size_t)t + k);
        r->triangles[3 * (size_t)t + k] = v;
        if (v < arrays->point_count) continue;
        mw_defect defect = mw__defect(MW_DEFECT_INDEX, t);
        defect.vertex = v;
        r->replaced[t] = 1;
        if (!mw__defects_add(defects, defect)) return false;
    }
    for (uint32_t k = 0; k < 3 && r->replaced[t]; k++) r->triangles[3 * (size_t)t + k] = 0;
    return true;
}

static bool repair_triangles(repair *r, const mw_arrays *arrays, mw_defects *defects)
{
    r->triangles = mw__alloc(3 * arrays->triangle_count, sizeof *r->triangles);
    r->replaced = mw__calloc(arrays->triangle_count, sizeof *r->replaced);
    if (!r->triangles || !r->replaced) return false;
    for (uint32_t t = 0; t < arrays->triangle_count; t++)
        if (!repair_triangle(r, arrays, t, defects)) return false;
    return true;
}

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
    repair r = {0};
    mw_mesh *mesh = NULL;
    mw_mesh_options tolerant = {.tolerant = 1};
    mw_status status = repair_triangles(&r, arrays, defects) ? MW_OK : mw__fail_memory(error);
    if (!status && arrays->point_count > 0) {
        mw_arrays repaired = *arrays;
        repaired.triangles = r.triangles;
        repaired.index_type = MW_UINT32;
        status = mw_mesh_create(&repaired, &tolerant, &mesh, error);
        if (!status) status = survey_mesh(mesh, r.replaced, defects, error);
    }
    mw_mesh_destroy(mesh);
    free(r.triangles);
    free(r.replaced);
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
    check->embedding = defects.count == 0 || defects.list[0].kind == MW_DEFECT_FLAT; /* the last kind in their order */
    return MW_OK;
}

void mw_check_release(mw_check *check)
{
    if (!check) return;
    free(check->defects);
    *check = (mw_check){0};
}
