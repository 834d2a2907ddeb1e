/* upkeep.c - keeps the guide and the indices useful, edit by edit. */
#include "edit/upkeep.h"

#include "base/clock.h"
#include "dynamic/journal.h"
#include "locate/batch_profile.h"

/* --- building --------------------------------------------------------------------------------- */

static uint32_t vertices_in_use(const mw_dynamic_tiling *dynamic)
{
    return dynamic->tiling->point_count - dynamic->free_count;
}

static bool index_is_built(const mw_upkeep *u, mw_start_kind start)
{
    return u->staleness[start].built;
}

/* Start counting edits again after a rebuild. The guide does not follow edits: insertions lengthen
 * the walks from it (to twice as many tiles when there are three times as many vertices), and other
 * edits make its names outdated. With these limits rebuilding the guide takes a seventh of the time
 * of insertions in spatial order, and a twentieth of that of insertions anywhere in a large mesh.
 */
static void staleness_reset(mw_upkeep *u, mw_start_kind start)
{
    enum { FEW = 64, EDITS_PER_VERTEX = 4, INSERTIONS_PER_VERTEX = 2, OUTSIDERS = 4 };
    const bool guide = start == MW_START_AUTO;
    uint64_t n = vertices_in_use(u->dynamic);
    if (!index_is_built(u, start) && start != MW_START_CURVE) u->kept[u->kept_count++] = start;
    u->staleness[start] = (mw_staleness){
        .built = true,
        .most_edits = FEW + (guide ? INSERTIONS_PER_VERTEX : EDITS_PER_VERTEX) * n,
        .weight = guide ? INSERTIONS_PER_VERTEX : 1,
        .most_outsiders = FEW + n / OUTSIDERS,
        .fewest = (n + 1) / 2,
        .most = guide ? (1 + INSERTIONS_PER_VERTEX) * n : 2 * n,
    };
}

/* Build an index. Layers are the only ones that the editor builds itself. */
static mw_status upkeep_build_index(mw_upkeep *u, mw_index *fresh, mw_live_layers *live,
                                    const mw_index_options *options, mw_job *job, mw_error *error)
{
    const mw_locator *locator = u->locator;
    if (fresh->start != MW_START_LAYERS)
        return mw__index_build(fresh, &locator->tiling, locator->low, locator->high, options, job,
                               error);
    const mw_layers_options own = {.layers = options->layers,
                                   .ratio = options->ratio,
                                   .descent = options->descent,
                                   .seed = options->seed};
    return mw__live_layers_create(live, &fresh->layers, u->dynamic, &own, job, error);
}

static void upkeep_index_release(mw_index *index, mw_live_layers *live)
{
    if (index->start == MW_START_LAYERS)
        mw__live_layers_release(live);
    else
        mw__index_release(index);
}

mw_status mw__upkeep_build(mw_upkeep *u, mw_start_kind start, const mw_index_options *options,
                           mw_job *job, mw_error *error)
{
    static const mw_index_options defaults;
    if (!mw_start_has_index(start))
        return mw__fail(error, MW_ERROR_ARGUMENT, "this start has no index");
    if (!options) options = &defaults;
    mw_index fresh = {.start = start};
    mw_live_layers live = {0};
    double begin = mw__seconds();
    mw_status status = upkeep_build_index(u, &fresh, &live, options, job, error);
    if (!status && mw__job_stopped(job)) status = mw__fail_memory(error);
    if (status) {
        upkeep_index_release(&fresh, &live);
        return status;
    }
    fresh.seconds = mw__seconds() - begin;
    upkeep_index_release(&u->index[start], &u->live);
    u->index[start] = fresh;
    u->options[start] = *options;
    u->options[start].progress = NULL; /* of this call only */
    if (start == MW_START_LAYERS) {
        u->live = live;
        mw__live_layers_attach(&u->live, &u->index[start].layers);
    }
    staleness_reset(u, start);
    return MW_OK;
}

/* Build the guide, and find what else follows from measuring the tiling. False when out of memory;
 * the old guide stays then. */
static bool build_guide(mw_upkeep *u, mw_job *job)
{
    mw_index fresh;
    const mw_caches caches = mw__caches();
    mw__locator_measure(u->locator, job);
    if (mw__job_stopped(job)) return false;
    u->large = mw__cache_level_of_mesh(u->locator, &caches) == MW_CACHE_NONE;
    staleness_reset(u, MW_START_AUTO);
    bool done = mw__locator_guide(u->locator, job, &fresh);
    if (done) {
        mw__index_release(&u->locator->guide);
        u->locator->guide = fresh;
    } else {
        mw__index_release(&fresh);
    }
    return done;
}

/* Find the hubs, as if none were known. */
static void upkeep_find_hubs(mw_upkeep *u)
{
    mw__live_hubs_release(&u->hubs);
    mw__live_hubs_survey(&u->hubs, u->dynamic->tiling, 0);
    mw__live_hubs_attach(&u->hubs, u->dynamic->tiling);
}

mw_status mw__upkeep_create(mw_upkeep *u, mw_locator *locator, const mw_dynamic_tiling *dynamic,
                            mw_job *job, mw_error *error)
{
    *u = (mw_upkeep){.locator = locator, .dynamic = dynamic};
    if (!build_guide(u, job)) return mw__fail_memory(error);
    upkeep_find_hubs(u);
    return MW_OK;
}

void mw__upkeep_release(mw_upkeep *u)
{
    for (int start = 0; start < MW_START_COUNT; start++)
        upkeep_index_release(&u->index[start], &u->live);
    if (u->locator) mw__index_release(&u->locator->guide);
    mw__live_hubs_release(&u->hubs);
    *u = (mw_upkeep){0};
}

size_t mw__upkeep_bytes(const mw_upkeep *u)
{
    size_t bytes = mw__index_bytes(&u->locator->guide) + mw__live_layers_bytes(&u->live) +
                   mw__live_hubs_bytes(&u->hubs);
    for (int start = 0; start < MW_START_COUNT; start++) bytes += mw__index_bytes(&u->index[start]);
    return bytes;
}

/* --- refreshing ------------------------------------------------------------------------------- */

static bool staleness_is_due(const mw_staleness *s, uint32_t vertices)
{
    return s->edits > s->most_edits || s->outsiders > s->most_outsiders || vertices > s->most ||
           vertices < s->fewest;
}

/* Rebuild an index, or the guide, if there is one. When out of memory the old one stays until it is
 * due again. */
static void upkeep_refresh(mw_upkeep *u, mw_start_kind start)
{
    if (!index_is_built(u, start)) return;
    const mw_index_options options = u->options[start];
    staleness_reset(u, start);
    bool done = start == MW_START_AUTO
                    ? build_guide(u, MW_ALONE)
                    : mw__upkeep_build(u, start, &options, MW_ALONE, NULL) == MW_OK;
    u->refreshes += done;
}

/* --- grids ------------------------------------------------------------------------------------ */

static void grid_put(mw_index *index, const mw_cell_entry *e)
{
    if (index->start == MW_START_GRID) mw__lattice_put(&index->grid.lattice, index->grid.tile, e);
    if (index->start == MW_START_TWO_LEVEL_GRID) mw__two_level_grid_put(&index->two_level_grid, e);
}

static void grids_put(mw_upkeep *u, const mw_cell_entry *e)
{
    grid_put(&u->index[MW_START_GRID], e);
    grid_put(&u->index[MW_START_TWO_LEVEL_GRID], e);
}

bool mw__upkeep_needs_report(const mw_upkeep *u, size_t insertions)
{
    enum { MANY = 8 }; /* times so many: more than tiles, and the hubs are found anew */
    if (u->kept_count > 1) return true; /* the guide needs no report */
    return u->hubs.count > 0 && insertions < u->dynamic->tiling->tri_count / MANY;
}

static void note_tile(mw_upkeep *u, uint32_t t)
{
    const mw_tiling *tiling = u->dynamic->tiling;
    grids_put(u,
              &(mw_cell_entry){.p = mw__tile_middle(tiling, t), .name = mw__tile_name(tiling, t)});
}

/* Put the tiles that an edit changed, as they are now, into the grids. The guide keeps the names it
 * was built from: finding the cells of six tiles would take a fifth of the time of an insertion. */
static void note_tiles(mw_upkeep *u, const mw_journal_edit *step, const mw_journal_entry *first,
                       size_t count)
{
    const mw_tiling *tiling = u->dynamic->tiling;
    if (!index_is_built(u, MW_START_GRID) && !index_is_built(u, MW_START_TWO_LEVEL_GRID)) return;
    for (size_t i = 0; i < count; i++)
        if (first[i].slot < tiling->tri_count) note_tile(u, first[i].slot);
    for (uint32_t t = step->tiles; t < tiling->tri_count; t++) note_tile(u, t);
}

static bool index_covers(const mw_index *index, mw_point p)
{
    if (index->start == MW_START_GRID) return mw__lattice_covers(&index->grid.lattice, p);
    return index->start != MW_START_TWO_LEVEL_GRID ||
           mw__two_level_grid_covers(&index->two_level_grid, p);
}

static const mw_index *kept_index(const mw_upkeep *u, mw_start_kind start)
{
    return start == MW_START_AUTO ? &u->locator->guide : &u->index[start];
}

static bool vertex_is_used(const mw_dynamic_tiling *dynamic, uint32_t v)
{
    return v < dynamic->tiling->point_count && dynamic->tiling->tile_at[v] != MW_NONE;
}

/* The extent of the locator contains all points where vertices are or were. An index keeps the
 * extent that it was built for. */
static MW_INLINE void extent_include(mw_upkeep *u, mw_point p)
{
    double *low = u->locator->low, *high = u->locator->high;
    if (p.x < low[0]) low[0] = p.x;
    if (p.y < low[1]) low[1] = p.y;
    if (p.x > high[0]) high[0] = p.x;
    if (p.y > high[1]) high[1] = p.y;
}

static void note_vertices(mw_upkeep *u, const uint32_t *vertices, uint32_t n)
{
    const mw_point *p = u->dynamic->tiling->point;
    for (uint32_t i = 0; i < n; i++) {
        if (!vertex_is_used(u->dynamic, vertices[i])) continue;
        for (uint32_t k = 0; k < u->kept_count; k++)
            u->staleness[u->kept[k]].outsiders +=
                !index_covers(kept_index(u, u->kept[k]), p[vertices[i]]);
        extent_include(u, p[vertices[i]]);
    }
}

/* A tile that exists now, beside one that existed before an edit was undone. */
static uint32_t tile_beside(const mw_tiling *tiling, const mw_triangle *gone)
{
    for (uint32_t k = 0; k < 3; k++)
        if (gone->link[k] != MW_NONE && mw__link_triangle(gone->link[k]) < tiling->tri_count)
            return mw__link_triangle(gone->link[k]);
    return 0;
}

/* Redirect the numbers that an undone edit had given out to triangles beside those that had them.
 * These numbers will be given out again, to triangles anywhere, so the cells must not keep them. */
static void redirect_names(mw_upkeep *u, const mw_journal_edit *step, const mw_journal_entry *first,
                           size_t count)
{
    mw_tiling *tiling = u->dynamic->tiling;
    for (size_t i = 0; i < count; i++) {
        const mw_triangle *gone = &first[i].tile;
        uint32_t number = gone->user & MW_USER_MASK;
        if (gone->v[0] == MW_NONE || gone->user & MW_GHOST || number < tiling->number_count)
            continue;
        uint32_t heir = mw__tile_name(tiling, tile_beside(tiling, gone));
        tiling->tile_of[number] = MW_GONE | heir;
        mw_point p[3];
        for (int k = 0; k < 3; k++) {
            bool moved = gone->v[k] == step->vertex && step->edit.kind == MW_EDIT_MOVE;
            p[k] = moved ? (mw_point){step->edit.x, step->edit.y} : tiling->point[gone->v[k]];
        }
        const mw_cell_entry e = {.p = mw__middle(p[0], p[1], p[2]), .name = heir, .anyway = true};
        grid_put(&u->locator->guide, &e);
        grids_put(u, &e);
    }
}

/* --- layers ----------------------------------------------------------------------------------- */

/* Let the layers follow what an edit did to vertex v. */
static bool layers_follow(mw_upkeep *u, const mw_journal_edit *step, uint32_t v)
{
    const mw_dynamic_tiling *dynamic = u->dynamic;
    bool there = vertex_is_used(dynamic, v);
    switch (step->edit.kind) {
    case MW_EDIT_INSERT:
    case MW_EDIT_REMOVE:
        return there ? mw__live_layers_insert(&u->live, v, dynamic->tiling->point[v])
                     : mw__live_layers_remove(&u->live, v);
    case MW_EDIT_MOVE: return mw__live_layers_move(&u->live, v, dynamic->tiling->point[v]);
    default: return true;
    }
}

/* --- hubs ------------------------------------------------------------------------------------- */

/* Let the hubs follow the last step, and look for others where it was. */
static void follow_hubs(mw_upkeep *u, const mw_journal_edit *step, size_t entries)
{
    const mw_dynamic_tiling *dynamic = u->dynamic;
    if (u->hubs.count > 0 && step->edits > 1 && entries == 0) { /* it was not recorded */
        upkeep_find_hubs(u);
        return;
    }
    if (u->hubs.count > 0) mw__live_hubs_follow(&u->hubs, dynamic);
    if (step->edits > 1 || entries >= MW_HUB_STRIDE)
        mw__live_hubs_survey_step(&u->hubs, dynamic);
    else if (u->locator->epoch % MW_HUB_EDITS == 0)
        mw__live_hubs_look_round(&u->hubs, dynamic->tiling, dynamic->last);
    mw__live_hubs_attach(&u->hubs, dynamic->tiling);
}

void mw__upkeep_resume(const mw_upkeep *u)
{
    mw__live_hubs_attach(&u->hubs, u->dynamic->tiling);
}

/* --- after an edit ---------------------------------------------------------------------------- */

/* Follow the vertices that an edit inserted, moved or removed. An insertion at an existing vertex
 * changed nothing. */
static void follow_vertices(mw_upkeep *u, const mw_journal_edit *step)
{
    bool made = step->edit.kind == MW_EDIT_INSERT;
    const uint32_t *vertices = made ? u->dynamic->vertex_slot + step->vertices : &step->vertex;
    const uint32_t n = made ? step->made : step->vertex != MW_NONE;
    note_vertices(u, vertices, n);
    if (!u->live.layers) return;
    bool even = true; /* rebuilt layers contain all of them already */
    for (uint32_t i = 0; i < n && even; i++)
        even = layers_follow(u, step, vertices[i]) && mw__live_layers_even(&u->live);
    if (!even) upkeep_refresh(u, MW_START_LAYERS);
}

/* Raise the epoch, so cursors look again; and account for new names. */
static void upkeep_begin(mw_upkeep *u)
{
    mw_tiling *tiling = u->dynamic->tiling;
    u->locator->epoch++;
    if (tiling->name_count < tiling->number_count) tiling->name_count = tiling->number_count;
}

static MW_INLINE void count_edits(mw_upkeep *u, mw_start_kind start, uint64_t edits)
{
    mw_staleness *staleness = &u->staleness[start];
    staleness->edits += edits;
    if (MW_UNLIKELY(staleness_is_due(staleness, vertices_in_use(u->dynamic))))
        upkeep_refresh(u, start);
}

void mw__upkeep_edit(mw_upkeep *u, bool undone)
{
    const mw_dynamic_tiling *dynamic = u->dynamic;
    const mw_journal_edit *step = &dynamic->step[dynamic->step_count - 1];
    const mw_journal_entry *first;
    size_t count = mw__journal_entries(dynamic, &first);
    if (step->edit.kind == MW_EDIT_VALUE) {
        mw__upkeep_resume(u);
        return;
    }
    upkeep_begin(u);
    follow_hubs(u, step, count);
    if (undone) redirect_names(u, step, first, count);
    note_tiles(u, step, first, count);
    follow_vertices(u, step);
    for (uint32_t i = 0; i < u->kept_count; i++) {
        const bool puts_in = (step->edit.kind == MW_EDIT_INSERT) != undone;
        const uint32_t weight = puts_in ? 1 : u->staleness[u->kept[i]].weight;
        count_edits(u, u->kept[i], weight * step->edits);
    }
}

void mw__upkeep_insertion(mw_upkeep *u, uint32_t v)
{
    upkeep_begin(u);
    if (v != MW_NONE) { /* only the guide exists */
        const mw_point p = u->dynamic->tiling->point[v];
        u->staleness[MW_START_AUTO].outsiders += !index_covers(&u->locator->guide, p);
        extent_include(u, p);
    }
    if (MW_UNLIKELY(u->locator->epoch % MW_HUB_EDITS == 0 || u->dynamic->star >= MW_HUB_STRIDE)) {
        mw__live_hubs_look_round(&u->hubs, u->dynamic->tiling, u->dynamic->last);
        mw__upkeep_resume(u);
    }
    count_edits(u, MW_START_AUTO, 1);
}

void mw__upkeep_grow(mw_upkeep *u)
{
    if (vertices_in_use(u->dynamic) > u->staleness[MW_START_AUTO].most)
        upkeep_refresh(u, MW_START_AUTO);
}

void mw__upkeep_rolled_back(mw_upkeep *u)
{
    upkeep_refresh(u, MW_START_AUTO);
}

void mw__upkeep_compact(mw_upkeep *u)
{
    u->locator->epoch = ((u->locator->epoch >> 32) + 1) << 32;
    u->dynamic->tiling->name_count = u->dynamic->tiling->number_count;
    mw__live_layers_drop(&u->live); /* they hold slots of vertices, which have changed */
    for (uint32_t i = 0; i < u->kept_count; i++) upkeep_refresh(u, u->kept[i]);
    upkeep_refresh(u, MW_START_CURVE);
    upkeep_find_hubs(u);
}
