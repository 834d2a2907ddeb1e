/* check_object.c - the defects of a mesh: in the plane, as a surface in space, or as a star. */
#include "engine/mesh_object.h"

#include <stdlib.h>

/* web/js/mesh.js reads defects by these places. */
_Static_assert(sizeof(mw_defect) == 20, "defects as JavaScript reads them");

static mw_status check_run(const web_mesh *m, int as, const double centre[3], mw_check *check)
{
    mw_arrays arrays = mw_mesh_file_arrays(&m->file);
    mw_star_options star = {.centre = {centre[0], centre[1], centre[2]}};
    if (as == 0) return mw_check_arrays(&arrays, NULL, check, &web_error);
    if (as == 1) return mw_surface_check_arrays(&arrays, 0, NULL, check, &web_error);
    return mw_star_check_arrays(&arrays, 1, &star, check, &web_error);
}

/* 0: in the plane; 1: as a surface; 2: as a polyhedron that is star-shaped about a centre. */
mw_check *WEB_EXPORT(web_check)(const web_mesh *m, int as, double x, double y, double z)
{
    mw_check *check = calloc(1, sizeof *check);
    if (!check || check_run(m, as, (const double[3]){x, y, z}, check) == MW_OK) return check;
    free(check);
    return NULL;
}

int WEB_EXPORT(web_check_valid)(const mw_check *check)
{
    return check->valid;
}

size_t WEB_EXPORT(web_check_count)(const mw_check *check)
{
    return check->defect_count;
}

const mw_defect *WEB_EXPORT(web_check_defects)(const mw_check *check)
{
    return check->defects;
}

const char *WEB_EXPORT(web_defect_text)(int kind)
{
    return mw_defect_text((mw_defect_kind)kind);
}

/* Valid until the next call. */
const char *WEB_EXPORT(web_check_describe)(const mw_check *check, size_t i)
{
    static char text[256];
    mw_defect_describe(&check->defects[i], text, sizeof text);
    return text;
}

void WEB_EXPORT(web_check_free)(mw_check *check)
{
    if (!check) return;
    mw_check_release(check);
    free(check);
}
