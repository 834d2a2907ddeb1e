/* prepared_guide_check.c - guide, index of the border and values of a prepared file. Cells and
 * samples may name any tile: mw__tile_of_name turns every number into a tile that exists. */
#include "prepared/prepared_guide_check.h"

#include "base/hilbert.h"

#include <inttypes.h>

static mw_status part_fail(const mw_prepared *p, mw_prepared_kind kind, uint64_t record,
                           mw_error *error)
{
    return mw__prepared_fail(p, error, "part '%s': record %" PRIu64 " is wrong",
                             mw__prepared_part_name(kind), record);
}

/* Each bucket begins behind the first sample and before the last, and not before the previous
 * bucket. */
static mw_status check_curve(const mw_prepared *p, mw_error *error)
{
    const mw_curve *curve = &p->locator.guide.curve;
    const uint64_t count = mw__prepared_part_count(&p->header.facts, MW_PART_BUCKETS);
    for (uint64_t b = 0; b < count; b++)
        if (curve->from[b] < 1 || curve->from[b] >= curve->count ||
            (b > 0 && curve->from[b] < curve->from[b - 1]))
            return part_fail(p, MW_PART_BUCKETS, b, error);
    return MW_OK;
}

static bool chains_edge_is_sound(const mw_chains_edge *e, uint32_t tiles)
{
    return mw__is_finite(e->low) && mw__is_finite(e->high) && e->left <= tiles + 1 &&
           e->right <= tiles + 1;
}

/* Chains follow each other, and an edge can be read where each begins, also where it has none. */
static mw_status check_chains(const mw_prepared *p, mw_error *error)
{
    const mw_index *guide = &p->locator.guide;
    const mw_chains *chains =
        guide->start == MW_START_CHAINS ? &guide->chains : &p->locator.fallback.chains;
    const uint32_t edges = p->header.facts.chain_edges, tiles = chains->tiles;
    for (uint32_t i = 0; i < tiles + 2; i++)
        if (chains->from[i] > chains->from[i + 1] || chains->from[i] >= edges)
            return part_fail(p, MW_PART_CHAIN_STARTS, i, error);
    if (chains->from[tiles + 2] != edges)
        return part_fail(p, MW_PART_CHAIN_STARTS, tiles + 2, error);
    for (uint32_t i = 0; i < edges; i++)
        if (!chains_edge_is_sound(&chains->edge[i], tiles))
            return part_fail(p, MW_PART_CHAIN_EDGES, i, error);
    for (int i = 0; i < 2; i++)
        if (!chains_edge_is_sound(&chains->bottom[i], tiles) ||
            !chains_edge_is_sound(&chains->top[i], tiles))
            return mw__prepared_fail(p, error, "the ends of its chains are wrong");
    return MW_OK;
}

static bool boxes_are_equal(const mw_box *a, const mw_box *b)
{
    return a->low[0] == b->low[0] && a->low[1] == b->low[1] && a->high[0] == b->high[0] &&
           a->high[1] == b->high[1];
}

/* The boxes follow from the edges: are they these? */
static mw_status check_boxes(const mw_prepared *p, mw_error *error)
{
    const mw_border_tree *border = &p->locator.border_tree;
    mw_box_tree fresh;
    if (!mw__box_tree_create(&fresh, border->edge_count, mw__border_edge_box, border->edge))
        return mw__fail_memory(error);
    const uint64_t boxes = mw__prepared_part_count(&p->header.facts, MW_PART_BORDER_BOXES);
    uint64_t i = 0;
    while (i < boxes && boxes_are_equal(&fresh.box[i], &border->tree.box[i])) i++;
    mw__box_tree_release(&fresh);
    return i == boxes ? MW_OK : part_fail(p, MW_PART_BORDER_BOXES, i, error);
}

static bool border_edge_is_sound(const mw_prepared *p, const mw_border_edge *e)
{
    return e->triangle < p->mesh.tri_count && e->edge < 3 && mw__is_finite(e->a) &&
           mw__is_finite(e->b);
}

static mw_status check_border(const mw_prepared *p, mw_error *error)
{
    const mw_border_tree *border = &p->locator.border_tree;
    for (uint32_t i = 0; i < border->edge_count; i++)
        if (!border_edge_is_sound(p, &border->edge[i]))
            return part_fail(p, MW_PART_BORDER_EDGES, i, error);
    return p->locator.has_border ? check_boxes(p, error) : MW_OK;
}

static mw_status check_values(const mw_prepared *p, mw_error *error)
{
    const mw_mesh_file *v = &p->values;
    for (size_t t = 0; v->faces && t < v->triangle_count; t++)
        if (v->faces[t] >= v->face_count) return part_fail(p, MW_PART_FACES, t, error);
    for (size_t i = 0; i < v->edge_count; i++)
        if (v->edges[i].vertex[0] >= v->point_count || v->edges[i].vertex[1] >= v->point_count ||
            v->edges[i].mark >= v->mark_count)
            return part_fail(p, MW_PART_MARKED_EDGES, i, error);
    return MW_OK;
}

mw_status mw__prepared_check_guide(const mw_prepared *p, mw_error *error)
{
    mw_status status = MW_OK;
    if (p->locator.guide.start == MW_START_CURVE) status = check_curve(p, error);
    if (!status && p->header.facts.chain_edges > 0) status = check_chains(p, error);
    if (!status) status = check_border(p, error);
    return status ? status : check_values(p, error);
}
