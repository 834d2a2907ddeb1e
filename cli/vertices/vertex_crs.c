#include "cli/vertices/vertex_crs.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/gdal/crs_heights.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/gdal/gdal_transform.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

int vertex_crs_check(const vertex_crs_settings *s)
{
    int end = crs_check_option("crs", s->mesh);
    if (end == 0) end = crs_check_option("points-crs", s->points);
    return end ? end : crs_check_option("constraints-crs", s->constraints);
}

/* Points in a file, and the system that they are in. */
typedef struct located_file {
    const char *path; /* NULL: there is none */
    const char *crs;  /* NULL: not known */
    const char *option;
} located_file;

static located_file located_file_of(const char *path, const char *name, const char *given,
                                    const char *of_file, bool quiet)
{
    char names[2][CRS_NAME];
    located_file f = {path && files_is_standard(path) ? "standard input" : path,
                      given ? given : of_file, name};
    if (path && given && of_file && !quiet && !crs_same(given, of_file))
        complain("%s: warning: its file says that it is in %s, but --%s says %s, which is used",
                 f.path, crs_name(of_file, names[0]), name, crs_name(given, names[1]));
    if (path && !given && of_file && !crs_known(of_file)) {
        if (!quiet)
            complain("%s: warning: its coordinate system is not understood: %.200s", f.path,
                     of_file);
        f.crs = NULL;
    }
    return f;
}

static void warn_of_unknown_crs(const located_file *unknown, const located_file *known, bool quiet)
{
    char name[CRS_NAME];
    if (!quiet)
        complain("%s: warning: its coordinate system is not known, and %s is in %s: its points are "
                 "taken as they are; "
                 "--%s names it",
                 unknown->path, known->path, crs_name(known->crs, name), unknown->option);
}

/* Transform points, if their system is not that of the mesh. Their heights, if they have any, stay.
 * `more` points follow elsewhere. */
static int located_file_move(const located_file *f, const located_file *mesh,
                             const common_settings *common, bool heights, double *points,
                             size_t count, double *more, size_t more_count)
{
    bool rough = false;
    char names[2][CRS_NAME];
    gdal_transform *t;
    gdal_transform_ends ends = {.of = f->path, .from = f->crs, .in = mesh->path, .to = mesh->crs};
    if (heights && !common->quiet) crs_warn_of_heights(f->path, f->crs, mesh->crs);
    if (crs_same(f->crs, mesh->crs)) return 0;
    int end = gdal_transform_open(&t, &ends, &rough);
    if (end == 0 && rough && !common->quiet)
        complain("%s: warning: only a rough transformation from %s to %s is known, without a shift "
                 "between the datums",
                 f->path, crs_name(f->crs, names[0]), crs_name(mesh->crs, names[1]));
    uint64_t lost = end ? 0 : gdal_transform_points(t, points, count, 3, common->threads);
    if (end == 0 && more_count > 0)
        lost += gdal_transform_points(t, more, more_count, 2, common->threads);
    gdal_transform_close(t);
    if (lost == 0) return end;
    complain("%s: %" PRIu64 " of its points have no position in %s; 'ogr2ogr -clipsrc' cuts a "
             "file to a region",
             f->path, lost, crs_name(mesh->crs, names[0]));
    return END_INPUT;
}

static int constraints_move(const located_file *f, const located_file *mesh,
                            const common_settings *common, mw_constraint_file *c)
{
    return located_file_move(f, mesh, common, c->has_z, c->points, c->point_count, c->hole_seeds,
                             c->hole_seed_count);
}

/* Longitudes and latitudes by their names only, beside something whose system is known. */
static void suppose_lonlat(located_file *points, const char *other, bool quiet)
{
    if (!other) return;
    points->crs = CRS_LONLAT;
    if (!quiet && !crs_same(other, CRS_LONLAT))
        complain("%s: remark: its longitudes and latitudes are taken as WGS 84 (" CRS_LONLAT
                 "); --points-crs names "
                 "another system",
                 points->path);
}

static int vertex_crs_store(vertex_table *v, const char *crs)
{
    char *copy = crs ? strdup(crs) : NULL;
    if (crs && !copy) return fail_memory();
    free(v->file.crs);
    v->file.crs = copy;
    return 0;
}

int vertex_crs_join(const vertex_crs_settings *s, const common_settings *common,
                    const char *points_path, vertex_table *v, const char *constraints_path,
                    mw_constraint_file *c)
{
    bool quiet = common->quiet, told = s->mesh || s->points || s->constraints;
    /* Alone, what a file says is kept as it stands, also if nobody understands it. */
    if (!told && (!points_path || !constraints_path))
        return points_path ? 0 : vertex_crs_store(v, c->crs);
    located_file points = located_file_of(points_path, "points-crs", s->points, v->file.crs, quiet);
    located_file lines =
        located_file_of(constraints_path, "constraints-crs", s->constraints, c->crs, quiet);
    if (points.path && !points.crs && v->lonlat)
        suppose_lonlat(&points, s->mesh ? s->mesh : lines.crs, quiet);
    located_file mesh = {"the mesh", s->mesh, NULL};
    if (!mesh.crs && points.path && lines.path && !points.crs != !lines.crs) {
        warn_of_unknown_crs(points.crs ? &lines : &points, points.crs ? &points : &lines, quiet);
        return vertex_crs_store(v, points.crs);
    }
    if (!mesh.crs) mesh.crs = points.crs ? points.crs : lines.crs;
    int end = 0;
    if (points.path && points.crs)
        end = located_file_move(&points, &mesh, common, v->file.has_z, v->file.points,
                                v->file.point_count, NULL, 0);
    if (end == 0 && lines.path && lines.crs) end = constraints_move(&lines, &mesh, common, c);
    return end ? end : vertex_crs_store(v, mesh.crs);
}

int vertex_crs_move_constraints(const common_settings *common, const char *path,
                                mw_constraint_file *c, const char *mesh_path, const char *mesh_crs)
{
    located_file lines = located_file_of(path, "constraints-crs", NULL, c->crs, common->quiet);
    located_file mesh = located_file_of(mesh_path, "crs", NULL, mesh_crs, common->quiet);
    if (lines.crs && mesh.crs) return constraints_move(&lines, &mesh, common, c);
    char name[CRS_NAME];
    const located_file *known = lines.crs ? &lines : &mesh, *unknown = lines.crs ? &mesh : &lines;
    if (known->crs && !common->quiet)
        complain("%s: warning: its coordinate system is not known, and %s is in %s: points are "
                 "taken as they are",
                 unknown->path, known->path, crs_name(known->crs, name));
    return 0;
}
