/* tile_links.c - delete tiles and vertices, and add ghosts. */
#include "dynamic/tile_links.h"

#include <stdlib.h>

void mw__add_ghosts(mw_dynamic_tiling *dynamic, uint32_t like, uint32_t n, uint32_t *tiles)
{
    mw_tiling *tiling = dynamic->tiling;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t t = tiles[i] = tiling->tri_count++;
        dynamic->mark[t] &= MW_JOURNALED; /* see mw__add_tiles */
        tiling->tri[t].user = like;
    }
    tiling->ghost_count += n;
}

void mw__free_number(mw_dynamic_tiling *dynamic, uint32_t t, uint32_t heir)
{
    if (mw__is_users_tile(dynamic, t))
        dynamic->tiling->tile_of[dynamic->tiling->tri[t].user & MW_USER_MASK] = MW_GONE | heir;
}

static int compare_descending(const void *a, const void *b)
{
    uint32_t s = *(const uint32_t *)a, t = *(const uint32_t *)b;
    return (s < t) - (s > t);
}

/* Usually there are two. */
static void sort_descending(uint32_t *tiles, size_t count)
{
    if (count > 2) {
        qsort(tiles, count, sizeof *tiles, compare_descending);
    } else if (count == 2 && tiles[0] < tiles[1]) {
        uint32_t lower = tiles[0];
        tiles[0] = tiles[1];
        tiles[1] = lower;
    }
}

bool mw__drop_tiles(mw_dynamic_tiling *dynamic, uint32_t *tiles, size_t count)
{
    mw_tiling *tiling = dynamic->tiling;
    sort_descending(tiles, count); /* so the last tile is never one to be deleted later */
    for (size_t i = 0; i < count; i++) {
        uint32_t t = tiles[i], last = tiling->tri_count - 1;
        if (!mw__is_users_tile(dynamic, t)) tiling->ghost_count--;
        if (t != last) {
            if (!mw__journal_tile(dynamic, last)) return false;
            tiling->tri[t] = tiling->tri[last];
            mw__set_fixed(dynamic, t, dynamic->mark[last] & MW_FIXED_EDGES);
            for (uint32_t k = 0; k < 3; k++) {
                uint32_t v = tiling->tri[t].v[k];
                if (tiling->tile_at[v] == last) tiling->tile_at[v] = t;
                mw__attach(dynamic, mw__link(t, k), tiling->tri[t].link[k]);
            }
            if (mw__is_users_tile(dynamic, t))
                tiling->tile_of[tiling->tri[t].user & MW_USER_MASK] = t;
            if (dynamic->last == last) dynamic->last = t;
        }
        tiling->tri_count--;
    }
    return true;
}

bool mw__free_vertex(mw_dynamic_tiling *dynamic, uint32_t v)
{
    if (!mw__free_slot_room(dynamic)) return false;
    dynamic->free_slot[dynamic->free_count++] = v;
    dynamic->vertex_slot[dynamic->vertex_number[v]] = MW_NONE;
    dynamic->tiling->tile_at[v] = MW_NONE;
    return true;
}
