/* insert_points.c - many points at once: one step, whose journal has each tile once, or which needs none. */
#include "edit/editor.h"
#include "edit/fabric_memory.h"
#include "walk/prefetch.h"
#include "edit/hole.h"
#include "edit/journal.h"

#include "mesh/point_order.h"
#include "walk/prefetch.h"
#include "walk/remembering_fast.h"

#include <stdlib.h>

/* Points, and the order in which they go in: NULL is that in which they are given. */
typedef struct batch {
    const mw_point *point;
    size_t n;
    uint32_t *order;
} batch;

static size_t item(const batch *b, size_t i)
{
    return b->order ? b->order[i] : i;
}

/* --- in which order ----------------------------------------------------------------------------------------------------- */

/* Do the points come along a curve? One that fills their extent makes steps of its diameter over sqrt(n), on average, points in random order
 * half the diameter. */
static bool come_along(const mw_point *p, size_t n)
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

/* *order: n numbers, owned by the caller in any case, or NULL for the order in which they come; false when out of memory. */
static bool choose_order(const mw_point *p, size_t n, uint32_t threads, uint32_t **order)
{
    *order = NULL;
    if (come_along(p, n)) return true;
    *order = mw__alloc(n, sizeof **order);
    return *order && mw__points_order(p, (uint32_t)n, threads, *order);
}

/* --- looking ahead ------------------------------------------------------------------------------------------------------- */

/* While a point goes in, those after it are on their way: each begins at the tile that the guide names, and goes a tile nearer now and then. Where to
 * cannot be guessed, and is known late: a walk of one's own would wait each time, while here another point goes in. What each will meet is asked of
 * memory as it comes nearer. They walk in plain doubles, since any tile will do to begin at; and points that go in do not move tiles, so
 * that all of them stay tiles. */
enum {
    AHEAD = 16,  /* points of which a place in memory is asked for */
    NAMED = 12,  /* those that get their first tile                */
    CORNERS = 8, /* its corners and neighbours are asked for       */
    NEARER = 6,  /* they go a tile nearer, from here on            */
    EVERY = 2,   /* once for so many points                        */
    BEYOND = 2   /* what lies beyond the neighbours is asked for   */
};

typedef struct traveller {
    mw_point q;
    uint32_t tile; /* where to begin */
} traveller;

typedef struct outlook {
    const batch *points;
    const mw_editor *editor;
    bool used;
    traveller on_way[AHEAD]; /* point i is on_way[i % AHEAD] */
} outlook;

static MW_INLINE void name_first(outlook *o, size_t i)
{
    const mw_tiling *tiling = &o->editor->locator.tiling;
    traveller *one = &o->on_way[i % AHEAD];
    one->q = o->points->point[item(o->points, i)];
    one->tile = mw__index_tile_ahead(tiling, &o->editor->locator.guide, one->q);
    __builtin_prefetch(&tiling->tri[one->tile]);
}

static MW_INLINE void fetch_corners(const mw_tiling *tiling, const traveller *one)
{
    const mw_triangle *tile = &tiling->tri[one->tile];
    for (int k = 0; k < 3; k++) {
        __builtin_prefetch(&tiling->point[tile->v[k]]);
        mw__prefetch_tile(tiling, tile->link[k]);
    }
}

/* One step of the remembering walk, and what comes next of memory. */
static MW_INLINE void go_nearer(const mw_tiling *tiling, traveller *one)
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

static MW_INLINE void fetch_beyond(const mw_tiling *tiling, const traveller *one)
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

/* In a small mesh all is near, and to ask for more costs more than it gains. */
static MW_INLINE void fetch_far(const outlook *o, size_t i)
{
    const mw_tiling *tiling = &o->editor->locator.tiling;
    mw__prefetch_tiles_round(tiling, o->on_way[(i + NAMED) % AHEAD].tile);
    mw__prefetch_points_round(tiling, tiling->tri[o->on_way[(i + CORNERS) % AHEAD].tile].v[0]);
    fetch_beyond(tiling, &o->on_way[(i + BEYOND) % AHEAD]);
}

/* Where points are so many that each lies in a tile of the one before, or beside it, there is nothing to look for. */
static void begin_outlook(outlook *o, const mw_editor *editor, const batch *b)
{
    bool used = b->n < editor->fabric.vertex_count;
    *o = (outlook){.points = b, .editor = editor, .used = used};
    for (size_t i = 0; used && i < NAMED && i < b->n; i++) name_first(o, i);
}

/* Before point i goes in: a tile to begin at. At the end places of points that are in already are looked at in place of others, as any is a tile's. */
static MW_INLINE uint32_t look_ahead(outlook *o, size_t i)
{
    const mw_tiling *tiling = &o->editor->locator.tiling;
    const size_t n = o->points->n;
    if (!o->used) return o->editor->fabric.last;
    if (i + AHEAD < n) __builtin_prefetch(&o->points->point[item(o->points, i + AHEAD)]);
    if (i + NAMED < n) name_first(o, i + NAMED);
    fetch_corners(tiling, &o->on_way[(i + CORNERS) % AHEAD]);
    for (size_t k = NEARER; k > BEYOND; k -= EVERY) go_nearer(tiling, &o->on_way[(i + k) % AHEAD]);
    if (o->editor->upkeep.large) fetch_far(o, i);
    return o->on_way[i % AHEAD].tile;
}

/* --- one step ----------------------------------------------------------------------------------------------------------- */

static mw_edit insertion(mw_point p)
{
    return (mw_edit){.kind = MW_EDIT_INSERT, .x = p.x, .y = p.y, .value = NAN};
}

static mw_status insert_all(mw_editor *editor, const batch *b, uint32_t *vertices, mw_change *own, mw_error *error)
{
    const mw_fabric *f = &editor->fabric;
    const uint32_t before = f->vertex_count;
    mw_error why;
    outlook o;
    begin_outlook(&o, editor, b);
    for (size_t i = 0; i < b->n; i++) {
        const size_t at = item(b, i);
        const mw_edit edit = insertion(b->point[at]);
        uint32_t vertex;
        mw_status status = mw__editor_insert(editor, &edit, look_ahead(&o, i), &vertex, &why);
        if (status == MW_ERROR_MEMORY) return mw__fail_memory(error);
        if (status) return mw__fail(error, status, "point %zu: %s", at, why.message);
        if (vertices) vertices[at] = vertex;
        mw__upkeep_grow(&editor->upkeep);
    }
    own->vertices_made = f->vertex_count - before;
    if (own->vertices_made > 0) own->vertex = before;
    return MW_OK;
}

static bool are_finite(const batch *b)
{
    for (size_t i = 0; i < b->n; i++)
        if (!isfinite(b->point[i].x) || !isfinite(b->point[i].y)) return false;
    return true;
}

/* Room for so many insertions, wherever they are and whatever they meet. False where there is not as much memory, or as many numbers, or where they
 * may be refused for another reason: in a mesh that does not fill its hull. */
static bool reserve_insertions(mw_fabric *f, size_t n)
{
    mw_tiling *tiling = f->tiling;
    const size_t tiles = 2 * (tiling->point_count + n); /* there are fewer in any triangulation of so many points */
    if (!f->convex || tiles > MW_MAX_TRIANGLES || n >= MW_GONE - f->vertex_count) return false;
    return mw__more_tiles(f, tiles - tiling->tri_count, true) && mw__vertex_room(f, n) && mw__hole_room(f, tiles);
}

/* Begin the step. Where nobody asks, and there is room for all that may be met, nothing can fail, and nothing has to be recorded. Room that is not
 * used takes addresses only, but time: more than a few records would. */
enum { FEW = 100 };
static bool begin(mw_editor *editor, const batch *b, const mw_change *change)
{
    enum { TILES_PER_POINT = 4 }; /* that are changed */
    mw_fabric *f = &editor->fabric;
    const mw_edit first = insertion(b->point[item(b, 0)]);
    bool sure = b->n >= FEW && !mw__editor_asks(editor, change) && are_finite(b) && mw__field_room(editor, b->n) &&
                reserve_insertions(f, b->n);
    if (!mw__log_room(editor, b->n) || (!sure && !mw__journal_room(f, TILES_PER_POINT * b->n))) return false;
    return mw__fabric_begin(f, &first, !sure);
}

static mw_status run(mw_editor *editor, const batch *b, uint32_t *vertices, mw_change *change, mw_error *error)
{
    mw_fabric *f = &editor->fabric;
    mw_change own = {.vertex = MW_NONE};
    const uint64_t refreshes = editor->upkeep.refreshes;
    if (!begin(editor, b, change)) return mw__fail_memory(error);
    f->step[f->step_count - 1].edits = b->n;
    mw_status status = insert_all(editor, b, vertices, &own, error);
    status = mw__editor_conclude(editor, status, &own, change, error);
    if (b->n >= FEW) mw__rim_release(f); /* no edit will need as much */
    if (status && editor->upkeep.refreshes > refreshes) mw__upkeep_rolled_back(&editor->upkeep);
    for (size_t i = 0; i < b->n && !status && editor->keeps_log; i++)
        editor->log[editor->log_count++] = insertion(b->point[item(b, i)]);
    return status;
}

/* --- the public function --------------------------------------------------------------------------------------------------- */

static mw_point *copy_points(const double *points, size_t n, size_t stride)
{
    mw_point *copy = mw__alloc(n, sizeof *copy);
    for (size_t i = 0; i < n && copy; i++) copy[i] = (mw_point){points[i * stride], points[i * stride + 1]};
    return copy;
}

mw_status mw_edit_insert_points(mw_editor *editor, const double *points, size_t n, size_t stride, uint32_t *vertices,
                                mw_change *change, mw_error *error)
{
    if (!editor || (!points && n > 0)) return mw__fail(error, MW_ERROR_ARGUMENT, "an edit needs an editor and points");
    if (stride == 1) return mw__fail(error, MW_ERROR_ARGUMENT, "points are two doubles apart, or more");
    if (n >= MW_NONE) return mw__fail(error, MW_ERROR_LIMIT, "too many points");
    if (change) *change = (mw_change){.vertex = MW_NONE};
    if (n == 0) return MW_OK;
    mw_point *own = copy_points(points, n, stride ? stride : 2);
    batch b = {own, n, NULL};
    mw_status status = own && choose_order(own, n, editor->threads, &b.order) ? run(editor, &b, vertices, change, error)
                                                                              : mw__fail_memory(error);
    free(b.order);
    free(own);
    return status;
}
