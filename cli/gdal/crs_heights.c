#include "cli/gdal/crs_heights.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_crs.h"

#ifdef MW_GDAL

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What heights are in a system. */
typedef struct crs_heights {
    bool known;    /* by the system, which has three axes */
    double metres; /* the unit of heights; or of the plane, if heights are not known */
    bool plane;    /* is that so? */
    char name[CRS_NAME], unit[40];
} crs_heights;

static void heights_take_unit(crs_heights *h, double metres, const char *name)
{
    h->metres = metres;
    snprintf(h->unit, sizeof h->unit, "%.30s", name ? name : "its own units");
}

static void heights_describe(crs_heights *h, const gdal_functions *gdal,
                             OGRSpatialReferenceH system)
{
    char *unit = NULL;
    const char *vertical = gdal->OSRGetAttrValue(system, "VERT_CS", 0);
    h->known = gdal->OSRIsCompound(system) || gdal->OSRGetAxesCount(system) == 3;
    if (h->known) {
        double metres = vertical ? gdal->OSRGetTargetLinearUnits(system, "VERT_CS", &unit) : 1;
        heights_take_unit(h, metres, vertical ? unit : "metre");
        snprintf(h->name, sizeof h->name, "%.100s", vertical ? vertical : "ellipsoidal height");
    } else if (gdal->OSRIsProjected(system)) {
        h->plane = true;
        double metres = gdal->OSRGetLinearUnits(system, &unit);
        heights_take_unit(h, metres, unit);
    }
}

static crs_heights heights_of(const char *crs)
{
    crs_heights h = {0};
    const gdal_functions *gdal = gdal_library_load();
    OGRSpatialReferenceH system = gdal ? crs_parse(gdal, crs, true) : NULL;
    if (!system) return h;
    heights_describe(&h, gdal, system);
    gdal->OSRRelease(system);
    return h;
}

/* Units as far apart as the two feet of America count as one. */
static bool units_differ(const crs_heights *a, const crs_heights *b)
{
    return fabs(a->metres - b->metres) > 1e-5 * a->metres;
}

void crs_warn_of_heights(const char *path, const char *from, const char *to)
{
    char names[2][CRS_NAME];
    crs_heights a = heights_of(from), b = heights_of(to);
    if (a.known && b.known && (strcmp(a.name, b.name) != 0 || units_differ(&a, &b)))
        complain("%s: warning: heights are not transformed: they stay '%s' in %s, where %s has "
                 "'%s' in %s",
                 path, a.name, a.unit, crs_name(to, names[0]), b.name, b.unit);
    else if (a.known && !b.known)
        complain("%s: warning: heights are not transformed: they stay '%s' in %s, and %s tells "
                 "nothing of heights",
                 path, a.name, a.unit, crs_name(to, names[0]));
    else if (!a.known && b.known)
        complain("%s: warning: heights are not transformed: %s tells nothing of them, %s has '%s' "
                 "in %s",
                 path, crs_name(from, names[0]), crs_name(to, names[1]), b.name, b.unit);
    else if (a.plane && b.plane && units_differ(&a, &b))
        complain("%s: warning: heights are not transformed: if they are in %s, as %s counts, they "
                 "stay so, where %s counts in %s",
                 path, a.unit, crs_name(from, names[0]), crs_name(to, names[1]), b.unit);
}

#else

void crs_warn_of_heights(const char *path, const char *from, const char *to)
{
    (void)path;
    (void)from;
    (void)to;
}

#endif
