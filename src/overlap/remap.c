/* remap.c - conservative weights: the common parts of cells, as entries of a sparse matrix. */
#include "overlap/measure.h"
#include "overlap/overlap_tile.h"
#include "overlap/overlap_walk.h"
#include "overlap/pixel_rows.h"

#include "base/job.h"
#include "base/options.h"

#include <meshwalk/remap.h>
#include <stdlib.h>
#include <string.h>

enum { REMAP_CHUNK = 512 }; /* tiles */

/* Times round the sphere, either way, by which longitudes of two meshes may differ. */
enum { REMAP_TURNS = 3 };

/* The contribution of cell or vertex i of the source to a cell: the area, or the integral of a hat
 * function. */
typedef struct remap_entry {
    uint32_t row, column;
    double area;
} remap_entry;

typedef struct remap_chunk {
    remap_entry *entry;
    size_t count, room;
} remap_chunk;

typedef struct remap_work {
    const mw_remap_mesh *source, *mesh; /* mesh: the target; NULL: pixels */
    const mw_remap_pixels *pixels;
    const mw_remap_options *options;
    mw_overlap_walk *walk;             /* [member] */
    remap_chunk *chunk;                /* [chunk] */
    double shift[2 * REMAP_TURNS + 1]; /* what longitudes of the source get, to be the target's */
    uint32_t shift_count;
    uint32_t rows, columns;
    atomic_bool no_memory;
} remap_work;

static uint32_t remap_cell(const mw_remap_mesh *mesh, uint32_t t)
{
    uint32_t triangle = mesh->locator->tiling.tri[t].user & MW_USER_MASK;
    return mesh->face ? mesh->face[triangle] : triangle;
}

/* --- entries --- */

static void remap_add(remap_work *w, remap_chunk *chunk, uint32_t row, uint32_t column, double area)
{
    if (area <= 0) return;
    if (chunk->count == chunk->room) {
        size_t room = 2 * chunk->room + 1024;
        remap_entry *entry = mw__realloc(chunk->entry, room, sizeof *entry);
        if (!entry) {
            atomic_store_explicit(&w->no_memory, true, memory_order_relaxed);
            return;
        }
        chunk->entry = entry;
        chunk->room = room;
    }
    chunk->entry[chunk->count++] = (remap_entry){row, column, area};
}

/* The common part of tile t of the source and a cell of the target. */
static void remap_add_part(remap_work *w, remap_chunk *chunk, const mw_clip *clip, uint32_t t,
                           const mw_overlap_tile *p, const mw_point frame[3], uint32_t row)
{
    mw_clip_integral sum = mw__clip_integral(clip);
    double area = mw__measure_clip(clip, p->p, frame, sum.area, w->options->degrees);
    if (!w->options->vertices) {
        remap_add(w, chunk, row, remap_cell(w->source, t), area);
        return;
    }
    double scale = sum.area > 0 ? area / sum.area : 0;
    for (int k = 0; k < 3; k++) remap_add(w, chunk, row, p->vertex[k], sum.p[k] * scale);
}

static void remap_add_tiles(remap_work *w, remap_chunk *chunk, mw_overlap_walk *walk, uint32_t t,
                            const mw_overlap_tile *p)
{
    const mw_tiling *tiling = &w->mesh->locator->tiling;
    uint32_t tile;
    mw_clip clip;
    mw_point q[3];
    mw__overlap_walk_begin(walk, p->p);
    while (mw__overlap_walk_next(walk, &tile, &clip)) {
        if (tiling->tri[tile].user & MW_GHOST) continue;
        for (int k = 0; k < 3; k++) q[k] = tiling->point[tiling->tri[tile].v[k]];
        remap_add_part(w, chunk, &clip, t, p, q, remap_cell(w->mesh, tile));
    }
}

static void remap_add_pixels(remap_work *w, remap_chunk *chunk, uint32_t t,
                             const mw_overlap_tile *p)
{
    mw_clip clip;
    mw_point q[4];
    mw_pixel_range rows = mw__pixel_rows(w->pixels, p->p);
    for (uint32_t r = rows.first; r < rows.end && !w->no_memory; r++) {
        mw_pixel_range columns = mw__pixel_columns(w->pixels, p->p, r);
        for (uint32_t c = columns.first; c < columns.end; c++) {
            mw__pixel_corners(w->pixels, r, c, q);
            if (mw__clip(p->p, q, 4, &clip))
                remap_add_part(w, chunk, &clip, t, p, (mw_point[]){q[0], q[1], q[3]},
                               r * w->pixels->columns + c);
        }
    }
}

/* The tile, moved along its parallel. False if rounding leaves no area of it. */
static bool remap_shift(mw_overlap_tile *p, double shift)
{
    if (shift == 0) return true;
    for (int k = 0; k < 3; k++) p->p[k].x += shift;
    return mw__orient2d(p->p[0], p->p[1], p->p[2]) > 0;
}

static void remap_add_chunk(void *work, uint64_t number, uint32_t member)
{
    remap_work *w = work;
    remap_chunk *chunk = &w->chunk[number];
    mw_overlap_walk *walk = w->mesh ? &w->walk[member] : NULL;
    const mw_locator *source = w->source->locator;
    const uint64_t n = source->tiling.tri_count, first = number * REMAP_CHUNK;
    if (walk) mw__overlap_walk_forget(walk);
    for (uint64_t t = first; t < first + REMAP_CHUNK && t < n && !w->no_memory; t++) {
        mw_overlap_tile p = mw__overlap_tile(source, (uint32_t)t, NULL);
        for (uint32_t i = 0; i < w->shift_count && p.there; i++) {
            mw_overlap_tile at = p;
            if (!remap_shift(&at, w->shift[i])) continue;
            if (walk)
                remap_add_tiles(w, chunk, walk, (uint32_t)t, &at);
            else
                remap_add_pixels(w, chunk, (uint32_t)t, &at);
        }
    }
    if (walk && walk->no_memory) atomic_store_explicit(&w->no_memory, true, memory_order_relaxed);
}

/* --- areas --- */

static void remap_sum_mesh(const mw_remap_mesh *mesh, bool vertices, bool degrees, double *area)
{
    const mw_tiling *tiling = &mesh->locator->tiling;
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        mw_overlap_tile p = mw__overlap_tile(mesh->locator, t, NULL);
        if (!p.there) continue;
        double whole = mw__measure_triangle(p.p, degrees);
        for (int k = 0; k < 3 && vertices; k++) area[p.vertex[k]] += whole / 3;
        if (!vertices) area[remap_cell(mesh, t)] += whole;
    }
}

static void remap_sum_pixels(const mw_remap_pixels *pixels, bool degrees, double *area)
{
    mw_point q[4];
    for (uint32_t r = 0; r < pixels->rows; r++)
        for (uint32_t c = 0; c < pixels->columns; c++) {
            mw__pixel_corners(pixels, r, c, q);
            *area++ = mw__measure_box(q[0].x, q[0].y, q[2].x, q[2].y, degrees);
        }
}

/* Turn sums of entries into fractions of areas. */
static void remap_divide(double *fraction, const double *area, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) fraction[i] = area[i] > 0 ? fmin(fraction[i] / area[i], 1) : 0;
}

/* Sort entries by row or by column; entries with equal keys keep their order. */
static bool remap_sort(const remap_entry *from, remap_entry *to, size_t n, bool by_row,
                       uint32_t keys)
{
    size_t *first = mw__calloc((uint64_t)keys + 1, sizeof *first);
    if (!first) return false;
    for (size_t i = 0; i < n; i++) first[(by_row ? from[i].row : from[i].column) + 1]++;
    for (uint32_t k = 0; k < keys; k++) first[k + 1] += first[k];
    for (size_t i = 0; i < n; i++) to[first[by_row ? from[i].row : from[i].column]++] = from[i];
    free(first);
    return true;
}

/* One entry for each pair of cells: several triangles of a face give one each. */
static size_t remap_merge(remap_entry *entry, size_t n)
{
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        remap_entry *last = kept ? &entry[kept - 1] : NULL;
        if (last && last->row == entry[i].row && last->column == entry[i].column)
            last->area += entry[i].area;
        else
            entry[kept++] = entry[i];
    }
    return kept;
}

/* Sort all entries by row, then by column, and merge equal pairs. False when out of memory. */
static bool remap_join(remap_work *w, uint64_t chunks, remap_entry **entry, size_t *n)
{
    size_t count = 0, at = 0;
    for (uint64_t c = 0; c < chunks; c++) count += w->chunk[c].count;
    remap_entry *all = mw__alloc(count, sizeof *all), *other;
    for (uint64_t c = 0; c < chunks && all; at += w->chunk[c++].count) {
        if (w->chunk[c].count) memcpy(all + at, w->chunk[c].entry, w->chunk[c].count * sizeof *all);
        free(w->chunk[c].entry);
        w->chunk[c].entry = NULL;
    }
    other = mw__alloc(count, sizeof *other);
    bool made = all && other && remap_sort(all, other, count, false, w->columns) &&
                remap_sort(other, all, count, true, w->rows);
    free(other);
    *entry = all;
    *n = made ? remap_merge(all, count) : 0;
    return made;
}

static mw_status remap_pack(remap_work *w, const remap_entry *entry, size_t count, mw_remap *out,
                            mw_error *error)
{
    uint32_t *row = mw__alloc(count, sizeof *row), *column = mw__alloc(count, sizeof *column);
    double *weight = mw__alloc(count, sizeof *weight);
    bool made = row && column && weight;
    const double *divisor = w->options->covered ? out->target_fraction : out->target_area;
    for (size_t i = 0; i < count && made; i++) {
        row[i] = entry[i].row;
        column[i] = entry[i].column;
        weight[i] = entry[i].area / divisor[entry[i].row];
    }
    mw_operator_entries entries = {.row = row,
                                   .column = column,
                                   .weight = weight,
                                   .count = count,
                                   .rows = w->rows,
                                   .columns = w->columns};
    mw_operator_options options = {.threads = w->options->threads};
    mw_status status =
        made ? mw_operator_create_from_entries(&entries, &options, &out->weights, error)
             : mw__fail_memory(error);
    free(row);
    free(column);
    free(weight);
    return status;
}

static mw_status remap_collect(remap_work *w, uint64_t chunks, mw_remap *out, mw_job *job,
                               mw_error *error)
{
    remap_entry *entry;
    size_t count;
    bool made = remap_join(w, chunks, &entry, &count) && mw__job_step(job, 1, 2);
    for (size_t i = 0; i < count && made; i++) {
        out->target_fraction[entry[i].row] += entry[i].area;
        out->source_fraction[entry[i].column] += entry[i].area;
        out->common_sum += entry[i].area;
    }
    mw_status status = made ? remap_pack(w, entry, count, out, error) : mw__fail_memory(error);
    free(entry);
    return status;
}

static mw_status remap_finish(remap_work *w, uint64_t chunks, mw_remap *out, mw_job *job,
                              mw_error *error)
{
    bool degrees = w->options->degrees;
    out->source_area = mw__calloc(w->columns, sizeof(double));
    out->source_fraction = mw__calloc(w->columns, sizeof(double));
    out->target_area = mw__calloc(w->rows, sizeof(double));
    out->target_fraction = mw__calloc(w->rows, sizeof(double));
    if (!out->source_area || !out->source_fraction || !out->target_area || !out->target_fraction)
        return mw__fail_memory(error);
    mw__job_stage(job, "adding areas", 0.1);
    remap_sum_mesh(w->source, w->options->vertices, degrees, out->source_area);
    for (uint32_t i = 0; i < w->columns; i++) out->source_sum += out->source_area[i];
    if (w->mesh)
        remap_sum_mesh(w->mesh, false, degrees, out->target_area);
    else
        remap_sum_pixels(w->pixels, degrees, out->target_area);
    mw__job_stage(job, "collecting weights", 0.2);
    mw_status status = remap_collect(w, chunks, out, job, error);
    if (status) return status;
    remap_divide(out->source_fraction, out->source_area, w->columns);
    remap_divide(out->target_fraction, out->target_area, w->rows);
    return MW_OK;
}

static mw_status remap_run(remap_work *w, mw_remap *out, mw_job *job, mw_error *error)
{
    const uint64_t tiles = w->source->locator->tiling.tri_count,
                   chunks = (tiles + REMAP_CHUNK - 1) / REMAP_CHUNK;
    uint32_t team = mw__job_team(job, chunks);
    bool made = true;
    w->chunk = mw__calloc(chunks, sizeof *w->chunk);
    w->walk = mw__calloc(team, sizeof *w->walk);
    for (uint32_t i = 0; i < team && w->walk && w->mesh && made; i++)
        made = mw__overlap_walk_create(&w->walk[i], w->mesh->locator);
    mw__job_stage(job, "overlapping", 0.7);
    made = made && w->chunk && w->walk && mw__job_chunks(job, team, chunks, remap_add_chunk, w) &&
           !w->no_memory;
    for (uint32_t i = 0; i < team && w->walk; i++) mw__overlap_walk_release(&w->walk[i]);
    mw_status status = made ? remap_finish(w, chunks, out, job, error) : mw__fail_memory(error);
    for (uint64_t c = 0; c < chunks && w->chunk; c++) free(w->chunk[c].entry);
    free(w->walk);
    free(w->chunk);
    return status;
}

/* --- longitudes --- */

/* By how many turns longitudes of the source become those of the target: 10 is 370, and -350. */
static void remap_find_shifts(remap_work *w, double west, double east)
{
    const mw_locator *source = w->source->locator;
    w->shift_count = 0;
    for (int turn = -REMAP_TURNS; w->options->degrees && turn <= REMAP_TURNS; turn++)
        if (source->low[0] + 360 * turn < east && source->high[0] + 360 * turn > west)
            w->shift[w->shift_count++] = 360 * turn;
    if (w->shift_count == 0) w->shift[w->shift_count++] = 0;
}

static mw_status remap_check_round(double west, double east, double rounding, mw_error *error)
{
    if (fabs(west) > 720 || fabs(east) > 720)
        return mw__fail(error, MW_ERROR_INPUT,
                        "longitudes from %g to %g are out of range, which is -720 to 720 degrees",
                        west, east);
    if (east - west <= 360 + rounding) return MW_OK;
    return mw__fail(error, MW_ERROR_INPUT,
                    "longitudes from %g to %g go round the sphere more than once", west, east);
}

/* A triangle across the meridian of 180 degrees, with longitudes on both sides of it. */
static mw_status remap_check_seam(const mw_mesh *mesh, mw_error *error)
{
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        const uint32_t *v = mesh->tri[t].v;
        double a = mesh->point[v[0]].x, b = mesh->point[v[1]].x, c = mesh->point[v[2]].x;
        double width = fmax(fmax(a, b), c) - fmin(fmin(a, b), c);
        if (width > 180)
            return mw__fail(error, MW_ERROR_INPUT,
                            "triangle %u has longitudes that differ by %g degrees: if it crosses "
                            "the meridian of 180 degrees, count them from 0 to 360",
                            mw__triangle_number(mesh, t), width);
    }
    return MW_OK;
}

/* --- what is refused --- */

static mw_status remap_check_mesh(const mw_remap_mesh *mesh, bool degrees, mw_error *error)
{
    if (!mesh || !mesh->locator)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the locator of a mesh is NULL");
    const mw_locator *l = mesh->locator;
    mw_status status = mw__overlap_check_locator(l, error);
    if (status) return status;
    if (degrees && (l->low[1] < -90 || l->high[1] > 90))
        return mw__fail(error, MW_ERROR_INPUT,
                        "latitudes from %g to %g are out of range, which is -90 to 90 degrees",
                        l->low[1], l->high[1]);
    if (degrees) status = remap_check_round(l->low[0], l->high[0], 0x1p-30, error);
    if (degrees && !status) status = remap_check_seam(l->mesh, error);
    if (status) return status;
    if (mesh->face_count >= MW_NONE)
        return mw__fail(error, MW_ERROR_LIMIT, "%zu faces are too many", mesh->face_count);
    for (uint32_t t = 0; t < l->tiling.tri_count && mesh->face; t++)
        if (!(l->tiling.tri[t].user & MW_GHOST) && remap_cell(mesh, t) >= mesh->face_count)
            return mw__fail(error, MW_ERROR_ARGUMENT, "there is no face %u of %zu",
                            remap_cell(mesh, t), mesh->face_count);
    return MW_OK;
}

/* The corners of a pixel must be different doubles, and with degrees its latitudes must be valid.
 */
static mw_status remap_check_pixels(const mw_remap_pixels *p, bool degrees, mw_error *error)
{
    if (!p || !(p->width > 0) || !(p->height > 0) || !isfinite(p->west) || !isfinite(p->north) ||
        p->columns == 0 || p->rows == 0)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the place, the size or the number of the pixels is missing or not finite");
    double east = p->west + p->columns * p->width, south = p->north - p->rows * p->height;
    if ((uint64_t)p->columns * p->rows >= MW_NONE)
        return mw__fail(error, MW_ERROR_LIMIT, "%u times %u pixels are too many", p->columns,
                        p->rows);
    if (!(fmax(fabs(p->west), fabs(east)) * 0x1p-44 < p->width) ||
        !(fmax(fabs(p->north), fabs(south)) * 0x1p-44 < p->height))
        return mw__fail(error, MW_ERROR_LIMIT, "pixels too small for their coordinates");
    if (degrees && (p->north > 90 + p->height * 0x1p-20 || south < -90 - p->height * 0x1p-20))
        return mw__fail(error, MW_ERROR_INPUT,
                        "latitudes from %g to %g are out of range, which is -90 to 90 degrees",
                        south, p->north);
    return degrees ? remap_check_round(p->west, east, p->width * 0x1p-10, error) : MW_OK;
}

static uint32_t remap_cells(const mw_remap_mesh *mesh)
{
    return mesh->face ? (uint32_t)mesh->face_count : mw_mesh_triangle_count(mesh->locator->mesh);
}

static mw_status remap_produce(remap_work *w, mw_remap *out, mw_error *error)
{
    mw_job job = mw__job(w->options->threads, w->options->progress);
    w->columns = w->options->vertices ? mw_mesh_vertex_count(w->source->locator->mesh)
                                      : remap_cells(w->source);
    w->rows = w->mesh ? remap_cells(w->mesh) : w->pixels->columns * w->pixels->rows;
    mw_status status = mw__job_end(&job, remap_run(w, out, &job, error), error);
    if (status) mw_remap_release(out);
    return status;
}

static mw_status remap_begin(remap_work *w, mw_remap *out, mw_error *error)
{
    static const mw_remap_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the result is NULL");
    *out = (mw_remap){0};
    if (!w->options) w->options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_remap_options, w->options, error);
    return status ? status : remap_check_mesh(w->source, w->options->degrees, error);
}

mw_status mw_remap_to_mesh(const mw_remap_mesh *source, const mw_remap_mesh *target,
                           const mw_remap_options *options, mw_remap *remap, mw_error *error)
{
    remap_work work = {.source = source, .mesh = target, .options = options};
    mw_status status = remap_begin(&work, remap, error);
    if (!status) status = remap_check_mesh(target, work.options->degrees, error);
    if (status) return status;
    remap_find_shifts(&work, target->locator->low[0], target->locator->high[0]);
    return remap_produce(&work, remap, error);
}

mw_status mw_remap_to_pixels(const mw_remap_mesh *source, const mw_remap_pixels *target,
                             const mw_remap_options *options, mw_remap *remap, mw_error *error)
{
    remap_work work = {.source = source, .pixels = target, .options = options};
    mw_status status = remap_begin(&work, remap, error);
    if (!status) status = remap_check_pixels(target, work.options->degrees, error);
    if (status) return status;
    remap_find_shifts(&work, target->west, target->west + target->columns * target->width);
    return remap_produce(&work, remap, error);
}

void mw_remap_release(mw_remap *remap)
{
    if (!remap) return;
    mw_operator_destroy(remap->weights);
    free(remap->source_area);
    free(remap->source_fraction);
    free(remap->target_area);
    free(remap->target_fraction);
    *remap = (mw_remap){0};
}
