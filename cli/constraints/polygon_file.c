#include "cli/constraints/polygon_file.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/constraints/constraint_file.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* --- a .poly: the border of its domain -------------------------------------------------------- */

static mw_status domain_make(const mw_constraint_file *c, const common_settings *common,
                             mw_mesh **mesh, mw_error *error)
{
    mw_constraints given = {.points = c->points,
                            .point_count = c->point_count,
                            .stride = 3,
                            .segments = c->segments,
                            .segment_count = c->segment_count,
                            .hole_seeds = c->hole_seeds,
                            .hole_seed_count = c->hole_seed_count};
    mw_constrain_options options = {
        .keep = MW_KEEP_INSIDE, .threads = common->threads, .progress = progress_of_call()};
    return mw_constrained_delaunay(&given, &options, NULL, NULL, NULL, mesh, error);
}

/* Write the border edges of a mesh as segments of polygon 0. Without `segments` they are counted.
 */
static size_t domain_border(const mw_mesh *mesh, uint32_t *segments)
{
    size_t count = 0;
    uint32_t v[3];
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++)
        for (unsigned k = 0; k < 3; k++) {
            if (mw_mesh_neighbour(mesh, t, k, NULL) != MW_NONE) continue;
            mw_mesh_triangle(mesh, t, v);
            if (segments) segments[2 * count] = v[k], segments[2 * count + 1] = v[(k + 1) % 3];
            count++;
        }
    return count;
}

static int domain_take(mw_constraint_file *c, const char *path, const common_settings *common)
{
    mw_error error;
    mw_mesh *mesh;
    if (domain_make(c, common, &mesh, &error) != MW_OK) return fail_mesh(path, &error);
    size_t count = domain_border(mesh, NULL);
    uint32_t *segments = malloc(2 * count * sizeof *segments);
    uint32_t *polygon = calloc(count, sizeof *polygon), *record = calloc(count, sizeof *record);
    bool done = segments && polygon && record;
    if (done) {
        domain_border(mesh, segments);
        free(c->segments);
        free(c->polygon);
        free(c->record);
        c->segments = segments;
        c->polygon = polygon;
        c->record = record;
        c->segment_count = count;
        c->polygon_count = 1;
    } else {
        free(segments);
        free(polygon);
        free(record);
    }
    mw_mesh_destroy(mesh);
    return done ? 0 : fail_memory();
}

/* --- rings ------------------------------------------------------------------------------------ */

/* Leave out the segments of lines. Returns how many. */
static size_t rings_drop_lines(mw_constraint_file *c)
{
    size_t kept = 0, all = c->segment_count;
    for (size_t i = 0; i < all; i++) {
        if (c->polygon[i] == MW_NONE) continue;
        memcpy(c->segments + 2 * kept, c->segments + 2 * i, 2 * sizeof *c->segments);
        c->polygon[kept] = c->polygon[i];
        c->record[kept++] = c->record[i];
    }
    c->segment_count = kept;
    return all - kept;
}

/* Leave out the points that no ring has. */
static int rings_drop_points(mw_constraint_file *c)
{
    uint32_t *number = malloc((c->point_count + 1) * sizeof *number), kept = 0;
    if (!number) return fail_memory();
    for (size_t i = 0; i < c->point_count; i++) number[i] = MW_NONE;
    for (size_t i = 0; i < 2 * c->segment_count; i++) number[c->segments[i]] = 0;
    for (size_t i = 0; i < c->point_count; i++) {
        if (number[i] == MW_NONE) continue;
        memmove(c->points + 3 * (size_t)kept, c->points + 3 * i, 3 * sizeof *c->points);
        number[i] = kept++;
    }
    for (size_t i = 0; i < 2 * c->segment_count; i++) c->segments[i] = number[c->segments[i]];
    c->point_count = kept;
    free(number);
    return 0;
}

static int rings_take(mw_constraint_file *c, const char *path, const common_settings *common)
{
    int end = constraint_file_is_poly(c) ? domain_take(c, path, common) : 0;
    if (end) return end;
    size_t lines = rings_drop_lines(c);
    if (lines > 0 && !common->quiet)
        complain("%s: warning: %zu segments of lines are skipped, since they bound nothing", path,
                 lines);
    if (c->segment_count > 0) return rings_drop_points(c);
    complain("%s: there are no polygons in it", path);
    return END_INPUT;
}

/* --- all together ----------------------------------------------------------------------------- */

static void polygon_file_warn(const polygon_file *f, const mw_constraint_file *c, const char *path)
{
    enum { NAMED = 10 };
    size_t count = mw_polygons_crossing(f->polygons, NULL, 0), named = 0, more = 0;
    uint32_t *crossing = malloc((count + 1) * sizeof *crossing), last = MW_NONE;
    if (crossing) mw_polygons_crossing(f->polygons, crossing, count);
    for (size_t i = 0; crossing && i < count; i++) {
        uint32_t feature = f->feature[crossing[i]];
        if (feature != last && named++ < NAMED)
            complain("%s: warning: the border of %s %" PRIu32
                     " crosses itself or runs along itself; a point is inside if the border goes "
                     "round it an odd number of times",
                     path, c->record_name, feature);
        else if (feature != last)
            more++;
        last = feature;
    }
    if (more > 0) complain("%s: warning: the borders of %zu others do so, too", path, more);
    free(crossing);
}

static int polygon_file_prepare(polygon_file *f, const mw_constraint_file *c, const char *path,
                                const common_settings *common)
{
    mw_error error;
    mw_constraints rings = {.points = c->points,
                            .point_count = c->point_count,
                            .stride = 3,
                            .segments = c->segments,
                            .segment_count = c->segment_count,
                            .polygon = c->polygon};
    mw_polygons_options options = {.threads = common->threads, .progress = progress_of_call()};
    f->feature = malloc((c->polygon_count + 1) * sizeof *f->feature);
    if (!f->feature) return fail_memory();
    for (size_t i = 0; i < c->segment_count; i++) f->feature[c->polygon[i]] = c->record[i];
    progress_phase("preparing", path);
    if (mw_polygons_create(&rings, &options, &f->polygons, &error) != MW_OK)
        return fail_mesh(path, &error);
    if (!common->quiet) polygon_file_warn(f, c, path);
    return 0;
}

int polygon_file_read(polygon_file *f, const polygon_file_settings *settings,
                      const common_settings *common)
{
    mw_constraint_file c;
    *f = (polygon_file){.values = {.list = settings->attribute}};
    constraint_file_options options = {.quiet = common->quiet,
                                       .gdal = {.layer = settings->layer,
                                                .polygons = true,
                                                .values = settings->attribute ? &f->values : NULL}};
    int end = constraint_file_read(settings->path, options, &c);
    if (end) return end;
    end = rings_take(&c, settings->path, common);
    if (end == 0) end = polygon_file_prepare(f, &c, settings->path, common);
    f->crs = c.crs;
    c.crs = NULL;
    mw_constraint_file_release(&c);
    return end;
}

void polygon_file_release(polygon_file *f)
{
    mw_polygons_destroy(f->polygons);
    free(f->feature);
    feature_values_release(&f->values);
    free(f->crs);
    *f = (polygon_file){0};
}

/* --- queries ---------------------------------------------------------------------------------- */

static size_t hits_join(const polygon_file *f, const mw_polygon_hit *found, size_t count,
                        feature_hit *hits)
{
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        feature_hit hit = {f->feature[found[i].polygon], found[i].border};
        if (made > 0 && hits[made - 1].feature == hit.feature)
            hits[made - 1].border = hits[made - 1].border && hit.border;
        else
            hits[made++] = hit;
    }
    return made;
}

size_t polygon_file_at(const polygon_file *f, const double point[2], const mw_location *at,
                       feature_hit room[FEATURE_ROOM], feature_hit **hits)
{
    mw_polygon_hit few[FEATURE_ROOM], *found = few;
    size_t count = mw_polygons_at(f->polygons, point, at, few, FEATURE_ROOM);
    *hits = room;
    if (count <= FEATURE_ROOM) return hits_join(f, few, count, room);
    found = malloc(count * sizeof *found);
    *hits = malloc(count * sizeof **hits);
    size_t made = SIZE_MAX;
    if (found && *hits) {
        mw_polygons_at(f->polygons, point, at, found, count);
        made = hits_join(f, found, count, *hits);
    }
    free(found);
    return made;
}

void polygon_file_report(const polygon_file *f, report *r)
{
    mw_polygons_info info;
    mw_polygons_describe(f->polygons, &info);
    report_count(r, "polygons", info.polygons);
    report_count(r, "polygon_bytes", info.bytes);
    report_count(r, "crossing_segments", info.crossing_segments);
}
