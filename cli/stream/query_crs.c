#include "cli/stream/query_crs.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/gdal/crs_heights.h"
#include "cli/gdal/gdal_crs.h"

#include <string.h>

/* What --points-crs says of points that are in the system of the mesh. */
static const char as_mesh[] = "same";

static bool option_means_mesh(const char *option)
{
    return option && strcmp(option, as_mesh) == 0;
}

int query_crs_check(const char *mesh_option, const char *points_option)
{
    int end = crs_check_option("crs", mesh_option);
    if (end || !points_option || option_means_mesh(points_option)) return end;
    end = crs_check_option("points-crs", points_option);
    if (end || (mesh_option && crs_same(mesh_option, points_option))) return end;
    return gdal_transform_check("option '--points-crs'");
}

query_preference query_crs_prefers(const query_crs_settings *s)
{
    const char *crs = s->option && !option_means_mesh(s->option) ? s->option : s->mesh_crs;
    if (s->domain != QUERIES_IN_PLANE || !crs) return PREFER_NOTHING;
    return crs_is_lonlat(crs) ? PREFER_LONLAT : PREFER_OTHERS;
}

/* The system that the file tells; NULL if it names none that is known. */
static const char *crs_of_source(const query_crs_settings *s, const char *points,
                                 const query_source *source)
{
    const char *crs = query_source_crs(source);
    if (!crs || crs_known(crs)) return crs;
    if (!s->quiet)
        complain("%s: warning: its coordinate system is not understood: %.200s", points, crs);
    return NULL;
}

/* The system of the queries by what the user or the file says. */
static const char *crs_told(const query_crs_settings *s, const char *points,
                            const query_source *source)
{
    char names[2][CRS_NAME];
    const char *of_file = crs_of_source(s, points, source);
    if (!s->option) return of_file;
    if (of_file && !s->quiet && !crs_same(of_file, s->option))
        complain(
            "%s: warning: its file says that it is in %s, but --points-crs says %s, which is used",
            points, crs_name(of_file, names[0]), crs_name(s->option, names[1]));
    return s->option;
}

/* Both are known. */
static int query_crs_join(query_crs *c, const query_crs_settings *s, const char *points,
                          const char *mesh_crs)
{
    char names[2][CRS_NAME];
    bool rough = false;
    gdal_transform_ends ends = {.of = points, .from = c->of_rows, .in = s->mesh, .to = mesh_crs};
    if (s->heights && !s->quiet) crs_warn_of_heights(s->mesh, mesh_crs, c->of_rows);
    if (crs_same(c->of_rows, mesh_crs)) return 0;
    int end = gdal_transform_open(&c->transform, &ends, &rough);
    if (end || s->quiet) return end;
    if (rough)
        complain("%s: warning: only a rough transformation from %s to %s is known, without a shift "
                 "between the datums",
                 points, crs_name(c->of_rows, names[0]), crs_name(mesh_crs, names[1]));
    return 0;
}

static void warn_of_unknown(const query_crs_settings *s, const char *points, const char *known)
{
    char name[CRS_NAME];
    if (s->quiet) return;
    if (known == s->mesh_crs)
        complain("%s: warning: its coordinate system is not known, and %s is in %s: the points are "
                 "taken as they are; "
                 "--points-crs names their system, or 'same'",
                 points, s->mesh, crs_name(known, name));
    else
        complain("%s: warning: its coordinate system is not known, and %s is in %s: the points are "
                 "taken as they are; "
                 "--crs names that of the mesh",
                 s->mesh, points, crs_name(known, name));
}

/* Columns that are called longitude and latitude, of a file that says no more. */
static int query_crs_suppose_lonlat(query_crs *c, const query_crs_settings *s, const char *points)
{
    if (!s->mesh_crs) return 0;
    c->of_rows = CRS_LONLAT;
    if (!s->quiet && !crs_same(CRS_LONLAT, s->mesh_crs))
        complain("%s: remark: its longitudes and latitudes are taken as WGS 84 (" CRS_LONLAT
                 "); --points-crs names "
                 "another system",
                 points);
    return query_crs_join(c, s, points, s->mesh_crs);
}

/* Queries about a mesh in the plane. */
static int query_crs_open_plane(query_crs *c, const query_crs_settings *s, const char *points,
                                const query_source *source)
{
    c->of_rows = crs_told(s, points, source);
    c->told = c->of_rows != NULL;
    bool lonlat = query_source_is_lonlat(source);
    if (lonlat && !s->option && c->of_rows && !crs_is_lonlat(c->of_rows))
        c->of_rows = NULL, c->told = false;
    if (c->of_rows && s->mesh_crs) return query_crs_join(c, s, points, s->mesh_crs);
    if (lonlat && !c->of_rows) return query_crs_suppose_lonlat(c, s, points);
    if (c->of_rows) warn_of_unknown(s, points, c->of_rows);
    if (!c->of_rows && s->mesh_crs) {
        warn_of_unknown(s, points, s->mesh_crs);
        c->of_rows = s->mesh_crs;
    }
    return 0;
}

int query_crs_open(query_crs *c, const query_crs_settings *s, const char *path,
                   const query_source *source)
{
    const char *points = files_is_standard(path) ? "standard input" : path;
    *c = (query_crs){0};
    if (option_means_mesh(s->option)) {
        c->of_rows = s->mesh_crs;
        c->told = s->mesh_crs != NULL;
        return 0;
    }
    if (s->domain == QUERIES_IN_PLANE) return query_crs_open_plane(c, s, points, source);
    c->of_rows = crs_of_source(s, points, source);
    c->told = c->of_rows != NULL;
    if (s->domain == QUERIES_IN_SPACE || !c->of_rows || crs_is_lonlat(c->of_rows)) return 0;
    return query_crs_join(c, s, points, CRS_LONLAT);
}

void query_crs_close(query_crs *c)
{
    gdal_transform_close(c->transform);
    *c = (query_crs){0};
}
