/* upkeep.c - keeping guide and indices near, edit by edit. */
#include "edit/upkeep.h"

#include "base/clock.h"
#include "edit/journal.h"
#include "locate/batch_profile.h"

/* --- building ---------------------------------------------------------------------------------------------------------- */

static uint32_t live_vertices(const mw_fabric *f)
{
    return f->tiling->point_count - f->free_count;
}

static bool is_built(const mw_upkeep *u, mw_start_kind start)
{
    return u->since[start].built;
}

/* The guide does not follow edits. Insertions lengthen the walks from it, to twice as many tiles where there are three times as many vertices; other edits
 * wear its names out, too. Built anew after two insertions for each vertex, or one other edit, it takes a seventh as long as these, if they come in an order of
 * space; a twentieth of insertions anywhere in a large mesh. */
static void begin_anew(mw_upkeep *u, mw_start_kind start)
{
    enum { FEW = 64, EDITS_PER_VERTEX = 4, INSERTIONS_PER_VERTEX = 2, OUTSIDERS = 4 };
    const bool guide = start == MW_START_AUTO;
    uint64_t n = live_vertices(u->fabric);
    if (!is_built(u, start) && start != MW_START_CURVE) u->kept[u->kept_count++] = start;
    u->since[start] = (mw_since){
        .built = true,
        .most_edits = FEW + (guide ? INSERTIONS_PER_VERTEX : EDITS_PER_VERTEX) * n,
        .weight = guide ? INSERTIONS_PER_VERTEX : 1,
        .most_outsiders = FEW + n / OUTSIDERS,
        .fewest = (n + 1) / 2,
        .most = guide ? (1 + INSERTIONS_PER_VERTEX) * n : 2 * n,
    };
}

/* Only layers are more than a room below builds. */
static mw_status build(mw_upkeep *u, mw_index *fresh, mw_live_layers *live, const mw_index_options *options,
                       mw_error *error)
{
    const mw_locator *locator = u->locator;
    if (fresh->start != MW_START_LAYERS)
        return mw__index_build(fresh, &locator->tiling, locator->low, locator->high, options, error);
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
    const mw_caches caches = mw__caches();
    mw__locator_measure(u->locator);
    u->large = mw__cache_level_of_mesh(u->locator, &caches) == MW_CACHE_NONE;
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
    return s->edits > s->most_edits || s->outsiders > s->most_outsiders || vertices > s->most || vertices < s->fewest;
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

static void put(mw_index *index, const mw_cell_entry *e)
{
    if (index->start == MW_START_GRID) mw__lattice_put(&index->grid.lattice, index->grid.tile, e);
    if (index->start == MW_START_TWO_LEVEL_GRID) mw__two_level_grid_put(&index->two_level_grid, e);
}

static void put_in_indices(mw_upkeep *u, const mw_cell_entry *e)
{
    put(&u->index[MW_START_GRID], e);
    put(&u->index[MW_START_TWO_LEVEL_GRID], e);
}

bool mw__upkeep_asks(const mw_upkeep *u)
{
    return u->kept_count > 1; /* there is more than the guide */
}

static void note_tile(mw_upkeep *u, uint32_t t)
{
    const mw_tiling *tiling = u->fabric->tiling;
    put_in_indices(u, &(mw_cell_entry){.p = mw__tile_middle(tiling, t), .name = mw__tile_name(tiling, t)});
}

/* The tiles that an edit changed, as they are now: for the indices that were asked for. The guide has to do with the names it was built of,
 * since to find the cells of six tiles would cost a fifth of an insertion. */
static void note_tiles(mw_upkeep *u, const mw_step *step, const mw_before *first, size_t count)
{
    const mw_tiling *tiling = u->fabric->tiling;
    if (!is_built(u, MW_START_GRID) && !is_built(u, MW_START_TWO_LEVEL_GRID)) return;
    for (size_t i = 0; i < count; i++)
        if (first[i].place < tiling->tri_count) note_tile(u, first[i].place);
    for (uint32_t t = step->tiles; t < tiling->tri_count; t++) note_tile(u, t);
}

static bool covers(const mw_index *index, mw_point p)
{
    if (index->start == MW_START_GRID) return mw__lattice_covers(&index->grid.lattice, p);
    return index->start != MW_START_TWO_LEVEL_GRID || mw__two_level_grid_covers(&index->two_level_grid, p);
}

static const mw_index *index_of(const mw_upkeep *u, mw_start_kind start)
{
    return start == MW_START_AUTO ? &u->locator->guide : &u->index[start];
}

static bool is_there(const mw_fabric *f, uint32_t v)
{
    return v < f->tiling->point_count && f->tiling->tile_at[v] != MW_NONE;
}

/* The locator's extent is that of all places where vertices are or were; an index knows but what it was built for. */
static MW_INLINE void note_place(mw_upkeep *u, mw_point p)
{
    double *low = u->locator->low, *high = u->locator->high;
    if (p.x < low[0]) low[0] = p.x;
    if (p.y < low[1]) low[1] = p.y;
    if (p.x > high[0]) high[0] = p.x;
    if (p.y > high[1]) high[1] = p.y;
}

static void note_places(mw_upkeep *u, const uint32_t *vertices, uint32_t n)
{
    const mw_point *p = u->fabric->tiling->point;
    for (uint32_t i = 0; i < n; i++) {
        if (!is_there(u->fabric, vertices[i])) continue;
        for (uint32_t k = 0; k < u->kept_count; k++)
            u->since[u->kept[k]].outsiders += !covers(index_of(u, u->kept[k]), p[vertices[i]]);
        note_place(u, p[vertices[i]]);
    }
}

/* A tile that there is now, beside one that there was before an edit was undone. */
static uint32_t tile_beside(const mw_tiling *tiling, const mw_triangle *gone)
{
    for (uint32_t k = 0; k < 3; k++)
        if (gone->link[k] != MW_NONE && mw__link_triangle(gone->link[k]) < tiling->tri_count)
            return mw__link_triangle(gone->link[k]);
    return 0;
}

/* Numbers that were given out by an edit that was undone lead to triangles beside those that had them; and as they will be given out again, for
 * triangles anywhere, cells do not keep them. */
static void redirect_names(mw_upkeep *u, const mw_step *step, const mw_before *first, size_t count)
{
    mw_tiling *tiling = u->fabric->tiling;
    for (size_t i = 0; i < count; i++) {
        const mw_triangle *gone = &first[i].tile;
        uint32_t number = gone->user & MW_USER_MASK;
        if (gone->v[0] == MW_NONE || gone->user & MW_GHOST || number < tiling->number_count) continue;
        uint32_t heir = mw__tile_name(tiling, tile_beside(tiling, gone));
        tiling->tile_of[number] = MW_GONE | heir;
        mw_point p[3];
        for (int k = 0; k < 3; k++) {
            bool moved = gone->v[k] == step->vertex && step->edit.kind == MW_EDIT_MOVE;
            p[k] = moved ? (mw_point){step->edit.x, step->edit.y} : tiling->point[gone->v[k]];
        }
        const mw_cell_entry e = {.p = mw__middle(p[0], p[1], p[2]), .name = heir, .anyway = true};
        put(&u->locator->guide, &e);
        put_in_indices(u, &e);
    }
}

/* --- layers ------------------------------------------------------------------------------------------------------------ */

/* What an edit did to a vertex: the layers follow it. */
static bool follow(mw_upkeep *u, const mw_step *step, uint32_t v)
{
    const mw_fabric *f = u->fabric;
    bool there = is_there(f, v);
    switch (step->edit.kind) {
    case MW_EDIT_INSERT:
    case MW_EDIT_REMOVE:
        return there ? mw__live_layers_insert(&u->live, v, f->tiling->point[v]) : mw__live_layers_remove(&u->live, v);
    case MW_EDIT_MOVE: return mw__live_layers_move(&u->live, v, f->tiling->point[v]);
    default: return true;
    }
}

/* --- after an edit ----------------------------------------------------------------------------------------------------- */

/* The vertices that an edit made, or the one that it moved or took out: an insertion where there was one did nothing. */
static void follow_vertices(mw_upkeep *u, const mw_step *step)
{
    bool made = step->edit.kind == MW_EDIT_INSERT;
    const uint32_t *vertices = made ? u->fabric->vertex_slot + step->vertices : &step->vertex;
    const uint32_t n = made ? step->made : step->vertex != MW_NONE;
    note_places(u, vertices, n);
    if (!u->live.layers) return;
    bool even = true; /* what is built anew knows all vertices already */
    for (uint32_t i = 0; i < n && even; i++) even = follow(u, step, vertices[i]) && mw__live_layers_even(&u->live);
    if (!even) refresh(u, MW_START_LAYERS);
}

/* Something changed: cursors look anew, and there may be new names. */
static void begin(mw_upkeep *u)
{
    mw_tiling *tiling = u->fabric->tiling;
    u->locator->epoch++;
    if (tiling->name_count < tiling->number_count) tiling->name_count = tiling->number_count;
}

static MW_INLINE void count_edits(mw_upkeep *u, mw_start_kind start, uint64_t edits)
{
    mw_since *since = &u->since[start];
    since->edits += edits;
    if (MW_UNLIKELY(is_due(since, live_vertices(u->fabric)))) refresh(u, start);
}

void mw__upkeep_edit(mw_upkeep *u, bool undone)
{
    const mw_fabric *f = u->fabric;
    const mw_step *step = &f->step[f->step_count - 1];
    const mw_before *first;
    size_t count = mw__fabric_journal(f, &first);
    if (step->edit.kind == MW_EDIT_VALUE) return;
    begin(u);
    if (undone) redirect_names(u, step, first, count);
    note_tiles(u, step, first, count);
    follow_vertices(u, step);
    for (uint32_t i = 0; i < u->kept_count; i++) {
        const bool puts_in = (step->edit.kind == MW_EDIT_INSERT) != undone;
        const uint32_t weight = puts_in ? 1 : u->since[u->kept[i]].weight;
        count_edits(u, u->kept[i], weight * step->edits);
    }
}

void mw__upkeep_insertion(mw_upkeep *u, uint32_t v)
{
    begin(u);
    if (v != MW_NONE) { /* as nobody asks there is the guide only */
        const mw_point p = u->fabric->tiling->point[v];
        u->since[MW_START_AUTO].outsiders += !covers(&u->locator->guide, p);
        note_place(u, p);
    }
    count_edits(u, MW_START_AUTO, 1);
}

void mw__upkeep_grow(mw_upkeep *u)
{
    if (live_vertices(u->fabric) > u->since[MW_START_AUTO].most) refresh(u, MW_START_AUTO);
}

void mw__upkeep_rolled_back(mw_upkeep *u)
{
    refresh(u, MW_START_AUTO);
}

void mw__upkeep_compact(mw_upkeep *u)
{
    u->locator->epoch = ((u->locator->epoch >> 32) + 1) << 32;
    u->fabric->tiling->name_count = u->fabric->tiling->number_count;
    mw__live_layers_drop(&u->live); /* they know vertices by places that are others now */
    for (uint32_t i = 0; i < u->kept_count; i++) refresh(u, u->kept[i]);
    refresh(u, MW_START_CURVE);
}
