/* upkeep.c - keeping guide and indices near, edit by edit. */
#include "edit/upkeep.h"

#include "base/clock.h"
#include "edit/rim.h"

/* --- building ---------------------------------------------------------------------------------------------------------- */

static uint32_t live_vertices(const mw_fabric *f)
{
    return f->tiling->point_count - f->free_count;
}

static void begin_anew(mw_upkeep *u, mw_start_kind start)
{
    u->since[start] = (mw_since){.vertices = live_vertices(u->fabric)};
}

/* Only layers are more than a room below builds. */
static mw_status build(mw_upkeep *u, mw_index *fresh, mw_live_layers *live, const mw_index_options *options,
                       mw_error *error)
{
    if (fresh->start != MW_START_LAYERS) return mw__index_build(fresh, u->locator, options, error);
    const mw_layers_options own = {
        .layers = options->layers, .ratio = options->ratio, .descent = options->descent, .seed = options->seed};
    return mw__live_layers_create(live, &fresh->layers, u->fabric, &own, error);
}

static void release(mw_index *index, mw_live_layers *live)
{
    if (index->start == MW_START_LAYERS)
        mw__live_layers_release(live);
    else
        mw__index_release(index);
}

mw_status mw__upkeep_build(mw_upkeep *u, mw_start_kind start, const mw_index_options *options, mw_error *error)
{
    static const mw_index_options defaults;
    if (!mw_start_has_index(start)) return mw__fail(error, MW_ERROR_ARGUMENT, "this start has no index");
    if (!options) options = &defaults;
    mw_index fresh = {.start = start};
    mw_live_layers live = {0};
    double begin = mw__seconds();
    mw_status status = build(u, &fresh, &live, options, error);
    if (status) {
        release(&fresh, &live);
        return status;
    }
    fresh.seconds = mw__seconds() - begin;
    release(&u->index[start], &u->live);
    u->index[start] = fresh;
    u->options[start] = *options;
    if (start == MW_START_LAYERS) {
        u->live = live;
        mw__live_layers_attach(&u->live, &u->index[start].layers);
    }
    begin_anew(u, start);
    return MW_OK;
}

/* The guide, and what else follows from a look at the tiling. Returns false when out of memory; the old guide stays then. */
static bool build_guide(mw_upkeep *u)
{
    mw_index fresh;
    mw__locator_survey(u->locator);
    begin_anew(u, MW_START_AUTO);
    bool done = mw__locator_guide(u->locator, &fresh);
    if (done) {
        mw__index_release(&u->locator->guide);
        u->locator->guide = fresh;
    } else {
        mw__index_release(&fresh);
    }
    return done;
}

mw_status mw__upkeep_create(mw_upkeep *u, mw_locator *locator, const mw_fabric *fabric, mw_error *error)
{
    *u = (mw_upkeep){.locator = locator, .fabric = fabric};
    return build_guide(u) ? MW_OK : mw__fail_memory(error);
}

void mw__upkeep_release(mw_upkeep *u)
{
    for (int start = 0; start < MW_START_COUNT; start++) release(&u->index[start], &u->live);
    if (u->locator) mw__index_release(&u->locator->guide);
    *u = (mw_upkeep){0};
}

size_t mw__upkeep_bytes(const mw_upkeep *u)
{
    size_t bytes = mw__index_bytes(&u->locator->guide) + mw__live_layers_bytes(&u->live);
    for (int start = 0; start < MW_START_COUNT; start++) bytes += mw__index_bytes(&u->index[start]);
    return bytes;
}

/* --- refreshing -------------------------------------------------------------------------------------------------------- */

static bool is_due(const mw_since *s, uint32_t vertices)
{
    enum { FEW = 64, EDITS_PER_VERTEX = 4, OUTSIDERS = 4 };
    if (vertices > 2 * (uint64_t)s->vertices || 2 * (uint64_t)vertices < s->vertices) return true;
    return s->edits > FEW + EDITS_PER_VERTEX * (uint64_t)s->vertices || s->outsiders > FEW + s->vertices / OUTSIDERS;
}

/* What follows edits: the guide, and indices. */
static const mw_start_kind kept[] = {MW_START_AUTO, MW_START_GRID, MW_START_TWO_LEVEL_GRID, MW_START_LAYERS};
enum { KEPT = sizeof kept / sizeof *kept };

static bool is_built(const mw_upkeep *u, mw_start_kind start)
{
    return start == MW_START_AUTO || u->index[start].start == start;
}

/* Build anew what is built. Without memory the old one stays, and it is tried again when it is due again. */
static void refresh(mw_upkeep *u, mw_start_kind start)
{
    if (!is_built(u, start)) return;
    const mw_index_options options = u->options[start];
    begin_anew(u, start);
    bool done = start == MW_START_AUTO ? build_guide(u) : mw__upkeep_build(u, start, &options, NULL) == MW_OK;
    u->refreshes += done;
}

/* --- grids ------------------------------------------------------------------------------------------------------------- */

/* The cell of p leads to the triangle `name` from here on. Returns whether p is in a cell of the index, and not beyond its rim. */
static bool put(mw_index *index, mw_point p, uint32_t name)
{
    if (index->start == MW_START_GRID) return mw__grid_put(&index->grid, p, name);
    return index->start != MW_START_TWO_LEVEL_GRID || mw__two_level_grid_put(&index->two_level_grid, p, name);
}

/* Where a vertex has come to: its cells lead to a triangle of it. The locator's extent is that of all places where vertices are or were; an
 * index knows but what it was built for. */
static void note_place(mw_upkeep *u, mw_point p, uint32_t name)
{
    double *low = u->locator->low, *high = u->locator->high;
    u->since[MW_START_AUTO].outsiders += !put(&u->locator->guide, p, name);
    u->since[MW_START_GRID].outsiders += !put(&u->index[MW_START_GRID], p, name);
    u->since[MW_START_TWO_LEVEL_GRID].outsiders += !put(&u->index[MW_START_TWO_LEVEL_GRID], p, name);
    low[0] = fmin(low[0], p.x);
    low[1] = fmin(low[1], p.y);
    high[0] = fmax(high[0], p.x);
    high[1] = fmax(high[1], p.y);
}

/* Where a vertex has gone from. The guide is told only if it must be: names of what is gone lead near enough, and to write to its cell would be
 * a good part of what it costs to remove a vertex. */
static void note_leaving(mw_upkeep *u, mw_point p, uint32_t name, bool guide_too)
{
    if (guide_too) put(&u->locator->guide, p, name);
    put(&u->index[MW_START_GRID], p, name);
    put(&u->index[MW_START_TWO_LEVEL_GRID], p, name);
}

/* A tile that there is now, beside one that there was before an edit was undone. */
static uint32_t tile_beside(const mw_tiling *tiling, const mw_triangle *gone)
{
    for (uint32_t k = 0; k < 3; k++)
        if (gone->link[k] != MW_NONE && mw__link_triangle(gone->link[k]) < tiling->tri_count)
            return mw__link_triangle(gone->link[k]);
    return 0;
}

/* Numbers that were given out by an edit that was undone lead to triangles beside those that had them. */
static void redirect_names(mw_tiling *tiling, const mw_before *first, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const mw_triangle *gone = &first[i].tile;
        uint32_t number = gone->user & MW_USER_MASK;
        if (gone->v[0] == MW_NONE || gone->user & MW_GHOST || number < tiling->number_count) continue;
        tiling->tile_of[number] = MW_GONE | mw__tile_name(tiling, tile_beside(tiling, gone));
    }
}

/* --- layers ------------------------------------------------------------------------------------------------------------ */

static bool is_there(const mw_fabric *f, uint32_t v)
{
    return v < f->tiling->point_count && f->tiling->owner[v] != MW_NONE;
}

/* What became of the vertex of an edit: the grids are told. What an edit that was undone put into cells goes, as its numbers will be given out
 * again, for triangles anywhere. */
static void note_vertex(mw_upkeep *u, const mw_step *step, bool undone)
{
    const mw_fabric *f = u->fabric;
    const mw_tiling *tiling = f->tiling;
    mw_point after = {step->edit.x, step->edit.y};
    uint32_t v = step->vertex, here = mw__tile_name(tiling, f->last < tiling->tri_count ? f->last : 0);
    if (undone && step->edit.kind != MW_EDIT_REMOVE) note_leaving(u, after, here, true);
    if (is_there(f, v))
        note_place(u, tiling->point[v], tiling->owner[v]);
    else if (step->edit.kind == MW_EDIT_REMOVE)
        note_leaving(u, step->point, here, false);
}

/* What became of the vertex of an edit: the layers follow it. */
static bool follow(mw_upkeep *u, const mw_step *step, bool undone)
{
    const mw_fabric *f = u->fabric;
    uint32_t v = step->vertex;
    bool there = is_there(f, v);
    switch (step->edit.kind) {
    case MW_EDIT_INSERT:
        if (undone) return there || mw__live_layers_remove(&u->live, v);
        if (f->vertex_count == step->vertices) return true; /* there was one already */
        return mw__live_layers_insert(&u->live, v, f->tiling->point[v]);
    case MW_EDIT_REMOVE:
        return there ? mw__live_layers_insert(&u->live, v, f->tiling->point[v]) : mw__live_layers_remove(&u->live, v);
    case MW_EDIT_MOVE: return mw__live_layers_move(&u->live, v, f->tiling->point[v]);
    default: return true;
    }
}

/* --- after an edit ----------------------------------------------------------------------------------------------------- */

void mw__upkeep_edit(mw_upkeep *u, bool undone)
{
    const mw_fabric *f = u->fabric;
    mw_tiling *tiling = f->tiling;
    const mw_step *step = &f->step[f->step_count - 1];
    const mw_before *first;
    size_t count = mw__fabric_journal(f, &first);
    if (step->edit.kind == MW_EDIT_VALUE) return;
    u->locator->epoch++;
    if (tiling->name_count < tiling->number_count) tiling->name_count = tiling->number_count;
    if (undone) redirect_names(tiling, first, count);
    uint32_t v = step->vertex;
    if (v != MW_NONE) note_vertex(u, step, undone);
    if (v != MW_NONE && u->live.layers && !(follow(u, step, undone) && mw__live_layers_even(&u->live)))
        refresh(u, MW_START_LAYERS);
    for (int i = 0; i < KEPT; i++) {
        u->since[kept[i]].edits++;
        if (is_due(&u->since[kept[i]], live_vertices(f))) refresh(u, kept[i]);
    }
}

void mw__upkeep_compact(mw_upkeep *u)
{
    u->locator->epoch = ((u->locator->epoch >> 32) + 1) << 32;
    u->fabric->tiling->name_count = u->fabric->tiling->number_count;
    mw__live_layers_drop(&u->live); /* they know vertices by places that are others now */
    for (int i = 0; i < KEPT; i++) refresh(u, kept[i]);
    refresh(u, MW_START_CURVE);
}
