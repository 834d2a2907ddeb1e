/* insert_points.c - many points at once, in one step. The step records each tile once, or none at
 * all. */
#include "edit/editor.h"
#include "dynamic/dynamic_tiling_memory.h"
#include "walk/prefetch.h"
#include "dynamic/cavity.h"
#include "dynamic/journal.h"

#include "mesh/point_order.h"
#include "walk/prefetch.h"
#include "walk/remembering_fast.h"

#include <stdlib.h>

/* Points, and the order of their insertion. NULL: in the order given. */
typedef struct point_batch {
    const mw_point *point;
    size_t n;
    uint32_t *order;
} point_batch;

static size_t point_batch_index(const point_batch *b, size_t i)
{
    return b->order ? b->order[i] : i;
}

/* --- the order -------------------------------------------------------------------------------- */

/* Do the points follow a space-filling curve? Then the average step is their diameter divided by
 * sqrt(n). Points in random order make steps of half the diameter. */
static bool points_follow_curve(const mw_point *p, size_t n)
{
    enum { LONGER = 4 };
    double low[2] = {p[0].x, p[0].y}, high[2] = {p[0].x, p[0].y}, way = 0;
    for (size_t i = 1; i < n; i++) {
        way += fabs(p[i].x - p[i - 1].x) + fabs(p[i].y - p[i - 1].y);
        if (p[i].x < low[0]) low[0] = p[i].x;
        if (p[i].y < low[1]) low[1] = p[i].y;
        if (p[i].x > high[0]) high[0] = p[i].x;
        if (p[i].y > high[1]) high[1] = p[i].y;
    }
    return way <= LONGER * sqrt((double)n) * (high[0] - low[0] + high[1] - low[1]);
}

/* *order: n numbers, owned by the caller in any case; NULL: the order given. False when out of
 * memory. */
static bool points_choose_order(const mw_point *p, size_t n, mw_job *job, uint32_t **order)
{
    *order = NULL;
    if (points_follow_curve(p, n)) return true;
    *order = mw__alloc(n, sizeof **order);
    return *order && mw__points_order(p, (uint32_t)n, job, *order);
}

/* --- looking ahead ---------------------------------------------------------------------------- */

/* While one point is inserted, the search for the next ones proceeds. Each begins at the tile that
 * the guide names, and moves one tile nearer from time to time. The next tile cannot be predicted,
 * and is known late: a separate walk would wait for memory at each tile, while here another point
 * is inserted in the meantime. The data that a point will need is prefetched as its turn comes
 * nearer. These walks use plain doubles, since any tile will do to begin at. Insertions do not move
 * tiles to other slots, so the tiles remain valid. An upcoming point passes these stages, so many
 * insertions before its own: */
enum {
    AHEAD = 16,  /* the point is prefetched                    */
    NAMED = 12,  /* the guide names its first tile             */
    CORNERS = 8, /* corners and neighbours are prefetched      */
    NEARER = 6,  /* from here on it moves one tile nearer,     */
    EVERY = 2,   /* once in so many insertions                 */
    BEYOND = 2   /* what lies beyond the neighbours is prefetched */
};

typedef struct upcoming_point {
    mw_point q;
    uint32_t tile; /* where the search begins */
} upcoming_point;

typedef struct lookahead {
    const point_batch *points;
    const mw_editor *editor;
    bool used;
    upcoming_point upcoming[AHEAD]; /* point i is upcoming[i % AHEAD] */
} lookahead;

static MW_INLINE void lookahead_name_first(lookahead *look, size_t i)
{
    const mw_tiling *tiling = &look->editor->locator.tiling;
    upcoming_point *one = &look->upcoming[i % AHEAD];
    one->q = look->points->point[point_batch_index(look->points, i)];
    one->tile = mw__index_tile_ahead(tiling, &look->editor->locator.guide, one->q);
    __builtin_prefetch(&tiling->tri[one->tile]);
}

static MW_INLINE void prefetch_corners(const mw_tiling *tiling, const upcoming_point *one)
{
    const mw_triangle *tile = &tiling->tri[one->tile];
    for (int k = 0; k < 3; k++) {
        __builtin_prefetch(&tiling->point[tile->v[k]]);
        mw__prefetch_tile(tiling, tile->link[k]);
    }
}

/* Take one step of the remembering walk, and prefetch for the next one. */
static MW_INLINE void lookahead_step_nearer(const mw_tiling *tiling, upcoming_point *one)
{
    const uint32_t link = mw__link_nearer(tiling, one->q, one->tile);
    if (MW_UNLIKELY(link == MW_NONE)) return;
    const uint32_t e = mw__link_edge(link);
    one->tile = mw__link_triangle(link);
    const mw_triangle *tile = &tiling->tri[one->tile];
    __builtin_prefetch(&tiling->point[tile->v[mw__prev(e)]]);
    mw__prefetch_tile(tiling, tile->link[mw__next(e)]);
    mw__prefetch_tile(tiling, tile->link[mw__prev(e)]);
}

static MW_INLINE void prefetch_beyond(const mw_tiling *tiling, const upcoming_point *one)
{
    const mw_triangle *tile = &tiling->tri[one->tile];
    for (int k = 0; k < 3; k++) {
        __builtin_prefetch(&tiling->tile_at[tile->v[k]], 1);
        if (MW_UNLIKELY(tile->link[k] == MW_NONE)) continue;
        const mw_triangle *other = &tiling->tri[mw__link_triangle(tile->link[k])];
        uint32_t e = mw__link_edge(tile->link[k]);
        __builtin_prefetch(&tiling->point[other->v[mw__prev(e)]]);
        __builtin_prefetch(&tiling->tile_at[other->v[mw__prev(e)]], 1);
        mw__prefetch_tile(tiling, other->link[mw__next(e)]);
        mw__prefetch_tile(tiling, other->link[mw__prev(e)]);
    }
}

/* Not for small meshes: they are in the caches, and prefetching costs more than it gains. */
static MW_INLINE void prefetch_far(const lookahead *look, size_t i)
{
    const mw_tiling *tiling = &look->editor->locator.tiling;
    mw__prefetch_tiles_round(tiling, look->upcoming[(i + NAMED) % AHEAD].tile);
    mw__prefetch_points_round(tiling, tiling->tri[look->upcoming[(i + CORNERS) % AHEAD].tile].v[0]);
    prefetch_beyond(tiling, &look->upcoming[(i + BEYOND) % AHEAD]);
}

/* If there are at least as many points as vertices, each point lies in or near the tile of the
 * previous one: no lookahead is needed. */
static void lookahead_begin(lookahead *look, const mw_editor *editor, const point_batch *b)
{
    bool used = b->n < editor->dynamic.vertex_count;
    *look = (lookahead){.points = b, .editor = editor, .used = used};
    for (size_t i = 0; used && i < NAMED && i < b->n; i++) lookahead_name_first(look, i);
}

/* Call before point i is inserted: returns the tile where its search begins. Near the end, entries
 * of points already inserted are processed again; this is harmless, as their tiles still exist. */
static MW_INLINE uint32_t lookahead_next_tile(lookahead *look, size_t i)
{
    const mw_tiling *tiling = &look->editor->locator.tiling;
    const size_t n = look->points->n;
    if (!look->used) return look->editor->dynamic.last;
    if (i + AHEAD < n)
        __builtin_prefetch(&look->points->point[point_batch_index(look->points, i + AHEAD)]);
    if (i + NAMED < n) lookahead_name_first(look, i + NAMED);
    prefetch_corners(tiling, &look->upcoming[(i + CORNERS) % AHEAD]);
    for (size_t k = NEARER; k > BEYOND; k -= EVERY)
        lookahead_step_nearer(tiling, &look->upcoming[(i + k) % AHEAD]);
    if (look->editor->upkeep.large) prefetch_far(look, i);
    return look->upcoming[i % AHEAD].tile;
}

/* --- one step --------------------------------------------------------------------------------- */

static mw_edit insertion_edit(mw_point p)
{
    return (mw_edit){.kind = MW_EDIT_INSERT, .x = p.x, .y = p.y, .value = NAN};
}

static mw_status points_insert_all(mw_editor *editor, const point_batch *b, mw_job *job,
                                   uint32_t *vertices, mw_change *own, mw_error *error)
{
    enum { SOME = 64 }; /* insertions between two steps of the job */
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    const uint32_t before = dynamic->vertex_count;
    mw_error why;
    lookahead look;
    lookahead_begin(&look, editor, b);
    for (size_t i = 0; i < b->n; i++) {
        if (i % SOME == 0 && !mw__job_step(job, i, b->n)) return mw__fail_memory(error);
        const size_t at = point_batch_index(b, i);
        const mw_edit edit = insertion_edit(b->point[at]);
        uint32_t vertex;
        mw_status status =
            mw__editor_insert(editor, &edit, lookahead_next_tile(&look, i), &vertex, &why);
        if (status == MW_ERROR_MEMORY) return mw__fail_memory(error);
        if (status) return mw__fail(error, status, "point %zu: %s", at, why.message);
        if (vertices) vertices[at] = vertex;
        mw__upkeep_grow(&editor->upkeep);
    }
    own->vertices_made = dynamic->vertex_count - before;
    if (own->vertices_made > 0) own->vertex = before;
    return MW_OK;
}

static bool points_are_finite(const point_batch *b)
{
    for (size_t i = 0; i < b->n; i++)
        if (!isfinite(b->point[i].x) || !isfinite(b->point[i].y)) return false;
    return true;
}

/* Reserve room for n insertions, wherever they are. False if there is not enough memory, or not
 * enough numbers; also if a point may be refused for another reason, as in a mesh that does not
 * fill its hull. */
static bool reserve_insertions(mw_dynamic_tiling *dynamic, size_t n)
{
    mw_tiling *tiling = dynamic->tiling;
    /* a triangulation of so many points has fewer tiles */
    const size_t tiles = 2 * (tiling->point_count + n);
    if (!dynamic->convex || tiles > MW_MAX_TRIANGLES || n >= MW_GONE - dynamic->vertex_count)
        return false;
    return mw__tile_room_grow(dynamic, tiles - tiling->tri_count, true) &&
           mw__vertex_room(dynamic, n) && mw__cavity_room(dynamic, tiles);
}

/* Begin the step. If nobody needs to know what changed, nobody can cancel, and there is room for
 * everything, nothing can fail, and nothing has to be recorded. Room that stays unused costs no
 * memory, but reserving it takes time: for a few points, more than recording them. */
enum { FEW = 100 };
static bool points_begin_step(mw_editor *editor, const point_batch *b, const mw_change *change)
{
    enum { TILES_PER_POINT = 4 }; /* changed by an insertion */
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    const mw_edit first = insertion_edit(b->point[point_batch_index(b, 0)]);
    bool sure = b->n >= FEW && !editor->progress &&
                !mw__editor_needs_report(editor, change, b->n) && points_are_finite(b) &&
                mw__field_room(editor, b->n) && reserve_insertions(dynamic, b->n);
    if (!mw__log_room(editor, b->n) ||
        (!sure && !mw__journal_room(dynamic, TILES_PER_POINT * b->n)))
        return false;
    return mw__journal_begin(dynamic, &first, !sure);
}

static mw_status points_insert(mw_editor *editor, const point_batch *b, mw_job *job,
                               uint32_t *vertices, mw_change *change, mw_error *error)
{
    mw_dynamic_tiling *dynamic = &editor->dynamic;
    mw_change own = {.vertex = MW_NONE};
    const uint64_t refreshes = editor->upkeep.refreshes;
    if (!points_begin_step(editor, b, change)) return mw__fail_memory(error);
    dynamic->step[dynamic->step_count - 1].edits = b->n;
    mw_status status = points_insert_all(editor, b, job, vertices, &own, error);
    status = mw__editor_conclude(editor, status, &own, change, error);
    if (b->n >= FEW) mw__boundary_release(dynamic); /* no edit will need as much */
    if (status && editor->upkeep.refreshes > refreshes) mw__upkeep_rolled_back(&editor->upkeep);
    for (size_t i = 0; i < b->n && !status && editor->keeps_log; i++)
        editor->log[editor->log_count++] = insertion_edit(b->point[point_batch_index(b, i)]);
    return status;
}

/* --- the public function ---------------------------------------------------------------------- */

static mw_point *copy_points(const double *points, size_t n, size_t stride)
{
    mw_point *copy = mw__alloc(n, sizeof *copy);
    for (size_t i = 0; i < n && copy; i++)
        copy[i] = (mw_point){points[i * stride], points[i * stride + 1]};
    return copy;
}

mw_status mw_edit_insert_points(mw_editor *editor, const double *points, size_t n, size_t stride,
                                uint32_t *vertices, mw_change *change, mw_error *error)
{
    if (!editor || (!points && n > 0))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the editor or the points are NULL");
    if (stride == 1)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the stride must be at least 2 (x and y), not 1");
    if (n >= MW_NONE) return mw__fail(error, MW_ERROR_LIMIT, "too many points");
    if (change) *change = (mw_change){.vertex = MW_NONE};
    if (n == 0) return MW_OK;
    mw_point *own = copy_points(points, n, stride ? stride : 2);
    point_batch b = {own, n, NULL};
    mw_job job = mw__job(editor->threads, editor->progress);
    mw_job_span outer = mw__job_part(&job, 0.1);
    bool ordered = own && points_choose_order(own, n, &job, &b.order);
    mw__job_part_end(&job, outer);
    mw__job_stage(&job, "inserting points", 0.9);
    mw_status status =
        ordered ? points_insert(editor, &b, &job, vertices, change, error) : mw__fail_memory(error);
    status = mw__job_end(&job, status, error);
    free(b.order);
    free(own);
    return status;
}
