/* live_hubs.c - finding hubs, and keeping the heaps of their triangles. */
#include "edit/live_hubs.h"

#include "dynamic/journal.h"

#include <stdlib.h>

/* --- going round a vertex --------------------------------------------------------------------- */

/* Count the tiles round vertex v of tile `first`, at most `most`, and list the numbers of the
 * triangles among them in `number`, unless it is NULL; *listed: how many. */
static uint32_t hub_go_round(const mw_tiling *tiling, uint32_t first, uint32_t v, uint32_t most,
                             uint32_t *number, uint32_t *listed)
{
    uint32_t t = first, tiles = 0;
    *listed = 0;
    for (int clockwise = 0; clockwise < 2 && tiles < most; clockwise++) {
        uint32_t link;
        do {
            const mw_triangle *tile = &tiling->tri[t];
            const uint32_t k = mw__corner_of(tile, v);
            if (number && !(tile->user & MW_GHOST)) number[(*listed)++] = tile->user & MW_USER_MASK;
            link = tile->link[clockwise ? k : mw__prev(k)];
            t = mw__link_triangle(link);
        } while (++tiles < most && link != MW_NONE && t != first);
        if (link != MW_NONE) break;
        /* at the hull: the other way, from the tile after the first */
        link = tiling->tri[first].link[mw__corner_of(&tiling->tri[first], v)];
        if (clockwise || link == MW_NONE) break;
        t = mw__link_triangle(link);
    }
    return tiles;
}

/* --- the heap --------------------------------------------------------------------------------- */

static void heap_sink(mw_hub *hub, uint32_t at)
{
    const uint32_t value = hub->number[at];
    for (;;) {
        uint32_t child = 2 * at + 1;
        if (child >= hub->count) break;
        if (child + 1 < hub->count && hub->number[child + 1] < hub->number[child]) child++;
        if (hub->number[child] >= value) break;
        hub->number[at] = hub->number[child];
        at = child;
    }
    hub->number[at] = value;
}

static void heap_drop_first(mw_hub *hub)
{
    hub->number[0] = hub->number[--hub->count];
    if (hub->count > 1) heap_sink(hub, 0);
}

/* Forget a hub. Its entry stays in the table, because later entries may have been placed after it.
 */
static void hub_lose(mw_hub *hub)
{
    free(hub->number);
    *hub = (mw_hub){.vertex = hub->vertex, .lost = true};
}

/* Make the heap of a vertex. False when out of memory. */
static bool hub_fill(mw_hub *hub, const mw_tiling *tiling)
{
    uint32_t listed, t = tiling->tile_at[hub->vertex];
    const uint32_t tiles =
        t == MW_NONE ? 0 : hub_go_round(tiling, t, hub->vertex, MW_NONE, NULL, &listed);
    free(hub->number);
    *hub = (mw_hub){.vertex = hub->vertex, .room = 2 * tiles + MW_HUB_DEGREE};
    hub->number = mw__alloc(hub->room, sizeof *hub->number);
    if (!hub->number) return false;
    if (tiles > 0) (void)hub_go_round(tiling, t, hub->vertex, MW_NONE, hub->number, &hub->count);
    hub->fresh = hub->count;
    for (uint32_t at = hub->count / 2; at-- > 0;) heap_sink(hub, at);
    return true;
}

/* Add a number. A full heap is made anew, which has it, too. */
static void hub_add(mw_hub *hub, const mw_tiling *tiling, uint32_t number)
{
    if (hub->lost) return;
    if (hub->count == hub->room) {
        if (!hub_fill(hub, tiling)) hub_lose(hub);
        return;
    }
    uint32_t at = hub->count++;
    for (; at > 0 && hub->number[(at - 1) / 2] > number; at = (at - 1) / 2)
        hub->number[at] = hub->number[(at - 1) / 2];
    hub->number[at] = number;
}

static bool number_is_at(const mw_tiling *tiling, uint32_t number, uint32_t v)
{
    if (number >= tiling->number_count || tiling->tile_of[number] & MW_GONE) return false;
    const mw_triangle *tile = &tiling->tri[tiling->tile_of[number]];
    return tile->v[0] == v || tile->v[1] == v || tile->v[2] == v;
}

static void hub_settle(mw_hub *hub, const mw_tiling *tiling)
{
    while (hub->count > 0 && !number_is_at(tiling, hub->number[0], hub->vertex))
        heap_drop_first(hub);
}

/* --- the table -------------------------------------------------------------------------------- */

static bool vertex_is_hub(const mw_tiling *tiling, uint32_t t, uint32_t v)
{
    uint32_t listed;
    return hub_go_round(tiling, t, v, MW_HUB_DEGREE, NULL, &listed) == MW_HUB_DEGREE;
}

/* Make room for one more. Vertices that are no longer hubs are dropped. */
static bool hub_table_room(mw_hub_table *table, const mw_tiling *tiling)
{
    if (table->hub && 2 * (table->count + 1) <= table->mask) return true;
    const uint32_t places = table->hub ? 2 * (table->mask + 1) : 16;
    mw_hub_table more = {.hub = mw__alloc(places, sizeof *more.hub), .mask = places - 1};
    if (!more.hub) return false;
    for (uint32_t i = 0; i < places; i++) more.hub[i] = (mw_hub){.vertex = MW_NONE};
    for (uint32_t i = 0; table->hub && i <= table->mask; i++) {
        mw_hub *hub = &table->hub[i];
        if (hub->vertex == MW_NONE) continue;
        const uint32_t t =
            hub->vertex < tiling->point_count ? tiling->tile_at[hub->vertex] : MW_NONE;
        if (hub->lost || t == MW_NONE || !vertex_is_hub(tiling, t, hub->vertex)) {
            free(hub->number);
            continue;
        }
        *mw__hub_place(&more, hub->vertex) = *hub;
        more.count++;
    }
    free(table->hub);
    *table = more;
    return true;
}

static void hub_table_add(mw_hub_table *table, const mw_tiling *tiling, uint32_t v)
{
    mw_hub fresh = {.vertex = v};
    if (!hub_table_room(table, tiling)) return;
    if (!hub_fill(&fresh, tiling)) return;
    *mw__hub_place(table, v) = fresh;
    table->count++;
}

/* Add vertex v of tile t, if it is a hub that is not known. */
static void hub_table_look(mw_hub_table *table, const mw_tiling *tiling, uint32_t t, uint32_t v)
{
    if (!mw__hub_find(table, v) && vertex_is_hub(tiling, t, v)) hub_table_add(table, tiling, v);
}

static void hub_table_look_at_tile(mw_hub_table *table, const mw_tiling *tiling, uint32_t t)
{
    for (int k = 0; k < 3; k++) hub_table_look(table, tiling, t, tiling->tri[t].v[k]);
}

void mw__live_hubs_look_round(mw_hub_table *hubs, const mw_tiling *tiling, uint32_t t)
{
    hub_table_look_at_tile(hubs, tiling, t);
    for (int k = 0; k < 3; k++) {
        const uint32_t link = tiling->tri[t].link[k], other = mw__link_triangle(link);
        if (link != MW_NONE)
            hub_table_look(hubs, tiling, other,
                           tiling->tri[other].v[mw__prev(mw__link_edge(link))]);
    }
}

void mw__live_hubs_survey(mw_hub_table *hubs, const mw_tiling *tiling, uint32_t first)
{
    for (uint64_t t = first; t < tiling->tri_count; t += MW_HUB_STRIDE)
        hub_table_look_at_tile(hubs, tiling, (uint32_t)t);
}

void mw__live_hubs_survey_step(mw_hub_table *hubs, const mw_dynamic_tiling *dynamic)
{
    const mw_journal_entry *first;
    const size_t count = mw__journal_entries(dynamic, &first);
    for (size_t i = 0; i < count; i += MW_HUB_STRIDE)
        if (first[i].slot < dynamic->tiling->tri_count)
            hub_table_look_at_tile(hubs, dynamic->tiling, first[i].slot);
    mw__live_hubs_survey(hubs, dynamic->tiling, dynamic->step[dynamic->step_count - 1].tiles);
}

void mw__live_hubs_release(mw_hub_table *hubs)
{
    for (uint32_t i = 0; hubs->hub && i <= hubs->mask; i++) free(hubs->hub[i].number);
    free(hubs->hub);
    *hubs = (mw_hub_table){0};
}

size_t mw__live_hubs_bytes(const mw_hub_table *hubs)
{
    if (!hubs->hub) return 0;
    size_t bytes = ((size_t)hubs->mask + 1) * sizeof *hubs->hub;
    for (uint32_t i = 0; i <= hubs->mask; i++)
        bytes += hubs->hub[i].room * sizeof *hubs->hub[i].number;
    return bytes;
}

void mw__live_hubs_attach(const mw_hub_table *hubs, mw_tiling *tiling)
{
    tiling->hubs = hubs->count > 0 ? hubs : NULL;
}

/* --- following an edit ------------------------------------------------------------------------ */

static void add_tile(const mw_hub_table *hubs, const mw_tiling *tiling, uint32_t t)
{
    const mw_triangle *tile = &tiling->tri[t];
    for (int k = 0; k < 3 && !(tile->user & MW_GHOST); k++) {
        mw_hub *hub = mw__hub_find(hubs, tile->v[k]);
        if (hub) hub_add(hub, tiling, tile->user & MW_USER_MASK);
    }
}

static void settle_round(const mw_hub_table *hubs, const mw_tiling *tiling, const mw_triangle *tile)
{
    for (int k = 0; k < 3 && tile->v[0] != MW_NONE; k++) {
        mw_hub *hub = mw__hub_find(hubs, tile->v[k]);
        if (hub) hub_settle(hub, tiling);
    }
}

void mw__live_hubs_follow(mw_hub_table *hubs, const mw_dynamic_tiling *dynamic)
{
    const mw_tiling *tiling = dynamic->tiling;
    const mw_journal_entry *first;
    const size_t count = mw__journal_entries(dynamic, &first);
    for (size_t i = 0; i < count; i++)
        if (first[i].slot < tiling->tri_count) add_tile(hubs, tiling, first[i].slot);
    for (uint32_t t = dynamic->step[dynamic->step_count - 1].tiles; t < tiling->tri_count; t++)
        add_tile(hubs, tiling, t);
    for (size_t i = 0; i < count; i++) settle_round(hubs, tiling, &first[i].tile);
}
