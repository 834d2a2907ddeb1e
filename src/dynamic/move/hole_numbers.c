/* hole_numbers.c - which hole each ghost lies in, after a move that may have led parts of the mesh
 * from one hole into another.
 *
 * This can only happen at a vertex where several groups of triangles meet, with different holes, or
 * a hole and the outside, in the gaps between them. The border edges are the same before and after,
 * and by Euler's formula so is the number of holes; but a part of the border may then bound another
 * hole. A region is all ghosts that can be reached from one another without crossing the border. A
 * region at the hull is no hole. Each hole keeps its number where most of its border edges are;
 * regions without a number then take those left. O(n log n) for the n ghosts in the regions that
 * the edit changed. */
#include "dynamic/move/hole_numbers.h"

#include "dynamic/journal.h"
#include "dynamic/tile_links.h"

#include <stdlib.h>

#define MW_REACHED 32u /* mark of a tile: a region has it */

/* A border edge by its vertices, seen from beyond the mesh, and the hole it bounded before the
 * edit. */
typedef struct border_witness {
    uint64_t ends;
    uint32_t hole;
} border_witness;

typedef struct ghost_region {
    size_t first, count; /* its tiles in the list */
    bool open;           /* at the hull           */
    uint32_t hole;       /* as chosen             */
    uint64_t lowest;     /* of its border edges, by the numbers of their vertices */
} ghost_region;

/* So many border edges of a region bounded that hole. */
typedef struct hole_vote {
    uint32_t hole, region;
    size_t edges;
} hole_vote;

typedef struct hole_numbering {
    mw_dynamic_tiling *dynamic;
    border_witness *witness;
    size_t witnesses;
    uint32_t *tile;
    size_t tiles;
    ghost_region *region;
    size_t regions;
    hole_vote *vote;
    size_t votes;
} hole_numbering;

/* --- before the edit -------------------------------------------------------------------------- */

static int witnesses_compare(const void *left, const void *right)
{
    const border_witness *a = left, *b = right;
    return (a->ends > b->ends) - (a->ends < b->ends);
}

static uint64_t border_ends_of(const mw_triangle *tile, uint32_t k)
{
    return (uint64_t)tile->v[k] << 32 | tile->v[k + 1];
}

static bool witnesses_call(hole_numbering *n)
{
    const mw_journal_entry *first;
    const size_t count = mw__journal_entries(n->dynamic, &first);
    n->witness = mw__alloc(3 * count, sizeof *n->witness);
    if (!n->witness) return false;
    for (size_t i = 0; i < count; i++) {
        const mw_triangle *tile = &first[i].tile;
        if (tile->v[0] == MW_NONE || !(tile->user & MW_GHOST)) continue;
        for (uint32_t k = 0; k < 3; k++)
            if (first[i].mark >> k & 1)
                n->witness[n->witnesses++] =
                    (border_witness){border_ends_of(tile, k), tile->user & MW_USER_MASK};
    }
    qsort(n->witness, n->witnesses, sizeof *n->witness, witnesses_compare);
    return true;
}

static bool tile_is_changed(const mw_dynamic_tiling *dynamic, uint32_t t)
{
    return t >= dynamic->step[dynamic->step_count - 1].tiles || dynamic->mark[t] & MW_JOURNALED;
}

/* The hole that border edge k of ghost t bounded before the edit. A ghost that the edit has not
 * changed still has it; an edge without a witness had no ghost. */
static uint32_t border_hole_before(const hole_numbering *n, uint32_t t, uint32_t k)
{
    const mw_triangle *tile = &n->dynamic->tiling->tri[t];
    const border_witness key = {.ends = border_ends_of(tile, k)};
    const border_witness *found =
        bsearch(&key, n->witness, n->witnesses, sizeof key, witnesses_compare);
    if (found) return found->hole;
    return tile_is_changed(n->dynamic, t) ? MW_POCKET : tile->user & MW_USER_MASK;
}

/* --- regions ---------------------------------------------------------------------------------- */

static void region_reach(hole_numbering *n, uint32_t t)
{
    if (mw__is_users_tile(n->dynamic, t) || n->dynamic->mark[t] & MW_REACHED) return;
    n->dynamic->mark[t] |= MW_REACHED;
    n->tile[n->tiles++] = t;
}

/* Look across edge k of ghost t, which is in the region. */
static void region_look_across(hole_numbering *n, ghost_region *r, uint32_t t, uint32_t k)
{
    const mw_dynamic_tiling *dynamic = n->dynamic;
    const mw_triangle *tile = &dynamic->tiling->tri[t];
    if (dynamic->mark[t] >> k & 1) {
        const uint64_t edge = (uint64_t)dynamic->vertex_number[tile->v[k]] << 32 |
                              dynamic->vertex_number[tile->v[k + 1]];
        if (edge < r->lowest) r->lowest = edge;
    } else if (tile->link[k] == MW_NONE) {
        r->open = true;
    } else {
        region_reach(n, mw__link_triangle(tile->link[k]));
    }
}

/* The region of ghost t, unless it is known. */
static void ghost_region_flood(hole_numbering *n, uint32_t t)
{
    const size_t first = n->tiles;
    region_reach(n, t);
    if (n->tiles == first) return;
    ghost_region *r = &n->region[n->regions++];
    *r = (ghost_region){.first = first, .hole = MW_POCKET, .lowest = UINT64_MAX};
    for (size_t i = first; i < n->tiles; i++)
        for (uint32_t k = 0; k < 3; k++) region_look_across(n, r, n->tile[i], k);
    r->count = n->tiles - first;
}

static bool regions_find(hole_numbering *n)
{
    const mw_dynamic_tiling *dynamic = n->dynamic;
    const mw_journal_entry *first;
    const size_t count = mw__journal_entries(dynamic, &first);
    n->tile = mw__alloc(dynamic->tiling->ghost_count, sizeof *n->tile);
    n->region = mw__alloc(mw__journal_extent(dynamic), sizeof *n->region);
    if (!n->tile || !n->region) return false;
    for (size_t i = 0; i < count; i++)
        if (first[i].slot < dynamic->tiling->tri_count) ghost_region_flood(n, first[i].slot);
    for (uint32_t t = dynamic->step[dynamic->step_count - 1].tiles; t < dynamic->tiling->tri_count;
         t++)
        ghost_region_flood(n, t);
    for (size_t i = 0; i < n->tiles; i++) dynamic->mark[n->tile[i]] &= (uint8_t)~MW_REACHED;
    return true;
}

/* --- numbers ---------------------------------------------------------------------------------- */

static int votes_compare(const void *left, const void *right)
{
    const hole_vote *a = left, *b = right;
    if (a->hole != b->hole) return a->hole < b->hole ? -1 : 1;
    return (a->region > b->region) - (a->region < b->region);
}

/* One for each region and hole, by hole. */
static bool votes_count(hole_numbering *n)
{
    size_t cast = 0;
    n->vote = mw__alloc(3 * n->tiles, sizeof *n->vote);
    if (!n->vote) return false;
    for (uint32_t r = 0; r < n->regions; r++)
        for (size_t i = 0; i < n->region[r].count && !n->region[r].open; i++) {
            const uint32_t t = n->tile[n->region[r].first + i];
            for (uint32_t k = 0; k < 3; k++)
                if (n->dynamic->mark[t] >> k & 1)
                    n->vote[cast++] = (hole_vote){border_hole_before(n, t, k), r, 1};
        }
    qsort(n->vote, cast, sizeof *n->vote, votes_compare);
    for (size_t i = 0; i < cast; i++) {
        hole_vote *last = n->votes > 0 ? &n->vote[n->votes - 1] : NULL;
        if (last && votes_compare(last, &n->vote[i]) == 0)
            last->edges++;
        else
            n->vote[n->votes++] = n->vote[i];
    }
    return true;
}

static bool region_wants_number(const ghost_region *r)
{
    return !r->open && r->hole == MW_POCKET;
}

/* Of regions without a number, is r to be asked before s? Compares their borders, since the slots
 * of tiles depend on earlier edits. */
static bool region_goes_before(const hole_numbering *n, uint32_t r, uint32_t s)
{
    return s == MW_NONE || n->region[r].lowest < n->region[s].lowest;
}

/* The votes for one hole: the region that has most of its border, of those that have none yet. */
static uint32_t hole_choose_region(const hole_numbering *n, const hole_vote *votes, size_t count)
{
    uint32_t best = MW_NONE;
    size_t most = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t r = votes[i].region;
        if (!region_wants_number(&n->region[r]) || votes[i].edges < most) continue;
        if (votes[i].edges == most && !region_goes_before(n, r, best)) continue;
        best = r;
        most = votes[i].edges;
    }
    return best;
}

/* A region that none of its holes chose. */
static uint32_t regions_next(const hole_numbering *n)
{
    uint32_t best = MW_NONE;
    for (uint32_t r = 0; r < n->regions; r++)
        if (region_wants_number(&n->region[r]) && region_goes_before(n, r, best)) best = r;
    return best;
}

static size_t votes_for_hole(const hole_numbering *n, size_t first)
{
    size_t count = 1;
    while (first + count < n->votes && n->vote[first + count].hole == n->vote[first].hole) count++;
    return count;
}

/* Each hole chooses first; then those that found no region take the ones left. */
static void holes_choose(hole_numbering *n)
{
    size_t left = 0; /* holes without a region, kept at the front of the votes */
    for (size_t i = 0, count; i < n->votes; i += count) {
        count = votes_for_hole(n, i);
        const uint32_t hole = n->vote[i].hole, r = hole_choose_region(n, &n->vote[i], count);
        if (hole == MW_POCKET) continue;
        if (r != MW_NONE)
            n->region[r].hole = hole;
        else
            n->vote[left++].hole = hole;
    }
    for (size_t i = 0; i < left; i++) {
        const uint32_t r = regions_next(n);
        if (r != MW_NONE) n->region[r].hole = n->vote[i].hole;
    }
}

static bool regions_write_numbers(const hole_numbering *n)
{
    mw_triangle *tri = n->dynamic->tiling->tri;
    for (const ghost_region *r = n->region; r < n->region + n->regions; r++)
        for (size_t i = 0; i < r->count; i++) {
            const uint32_t t = n->tile[r->first + i];
            if ((tri[t].user & MW_USER_MASK) == r->hole) continue;
            if (!mw__journal_tile(n->dynamic, t)) return false;
            tri[t].user = MW_GHOST | r->hole;
        }
    return true;
}

bool mw__hole_numbers_update(mw_dynamic_tiling *dynamic)
{
    hole_numbering n = {.dynamic = dynamic};
    bool done = witnesses_call(&n) && regions_find(&n) && votes_count(&n);
    if (done) holes_choose(&n);
    done = done && regions_write_numbers(&n);
    free(n.witness);
    free(n.tile);
    free(n.region);
    free(n.vote);
    return done;
}
