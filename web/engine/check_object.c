/* check_object.c - the defects of a mesh, in the plane or as a surface in space. */
#include "engine/mesh_object.h"

#include <stdlib.h>

/* web/js/mesh.js reads defects by these places. */
_Static_assert(sizeof(mw_defect) == 20, "defects as JavaScript reads them");

mw_check *WEB_EXPORT(web_check)(const web_mesh *m, int as_surface)
{
    mw_arrays arrays = mw_mesh_file_arrays(&m->file);
    mw_check *check = calloc(1, sizeof *check);
    if (!check) return NULL;
    mw_status status = as_surface ? mw_surface_check_arrays(&arrays, 0, NULL, check, &web_error)
                                  : mw_check_arrays(&arrays, NULL, check, &web_error);
    if (status == MW_OK) return check;
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
