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
    char name[CRS_NAME], unit[CRS_UNIT];
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

/* Units that differ as little as the two American feet count as equal. */
static bool units_differ(const crs_heights *a, const crs_heights *b)
{
    return fabs(a->metres - b->metres) > 1e-5 * a->metres;
}

void crs_warn_of_heights(const char *path, const char *from, const char *to)
{
    char names[2][CRS_NAME];
    crs_heights a = heights_of(from), b = heights_of(to);
    if (a.known && b.known && (strcmp(a.name, b.name) != 0 || units_differ(&a, &b)))
        complain("%s: warning: heights are not transformed: they stay '%s' in %s, but heights in "
                 "%s are '%s' in %s",
                 path, a.name, a.unit, crs_name(to, names[0]), b.name, b.unit);
    else if (a.known && !b.known)
        complain("%s: warning: heights are not transformed: they stay '%s' in %s; %s does not "
                 "define heights",
                 path, a.name, a.unit, crs_name(to, names[0]));
    else if (!a.known && b.known)
        complain("%s: warning: heights are not transformed: %s does not define them; heights in %s "
                 "are '%s' in %s",
                 path, crs_name(from, names[0]), crs_name(to, names[1]), b.name, b.unit);
    else if (a.plane && b.plane && units_differ(&a, &b))
        complain("%s: warning: heights are not transformed: they stay in %s if that is their unit, "
                 "as it is of x and y in %s; the unit of %s is %s",
                 path, a.unit, crs_name(from, names[0]), crs_name(to, names[1]), b.unit);
}

int crs_check_heights(const char *a_path, const char *a, const char *b_path, const char *b,
                      bool quiet)
{
    crs_heights of_a = heights_of(a), of_b = heights_of(b);
    if (of_a.known && of_b.known &&
        (strcmp(of_a.name, of_b.name) != 0 || units_differ(&of_a, &of_b))) {
        complain("%s has heights '%s' in %s, but %s has '%s' in %s: transform one of them first",
                 a_path, of_a.name, of_a.unit, b_path, of_b.name, of_b.unit);
        return END_INPUT;
    }
    if (of_a.known != of_b.known && !quiet)
        complain("%s: warning: its coordinate system does not define heights, and those of %s are "
                 "'%s' in %s: they are taken to be the same",
                 of_a.known ? b_path : a_path, of_a.known ? a_path : b_path,
                 of_a.known ? of_a.name : of_b.name, of_a.known ? of_a.unit : of_b.unit);
    return 0;
}

bool crs_unit(const char *crs, char unit[CRS_UNIT])
{
    const gdal_functions *gdal = gdal_library_load();
    OGRSpatialReferenceH system = gdal ? crs_parse(gdal, crs, false) : NULL;
    char *name = NULL;
    bool known = system && gdal->OSRIsProjected(system);
    if (known) gdal->OSRGetLinearUnits(system, &name);
    if (known && name) snprintf(unit, CRS_UNIT, "%.30s", name);
    if (system) gdal->OSRRelease(system);
    return known && name;
}

#else

int crs_check_heights(const char *a_path, const char *a, const char *b_path, const char *b,
                      bool quiet)
{
    (void)a_path;
    (void)a;
    (void)b_path;
    (void)b;
    (void)quiet;
    return 0;
}

bool crs_unit(const char *crs, char unit[CRS_UNIT])
{
    (void)crs;
    (void)unit;
    return false;
}

void crs_warn_of_heights(const char *path, const char *from, const char *to)
{
    (void)path;
    (void)from;
    (void)to;
}

#endif
