/* triangle_cut.c - no part of a cut triangle may have three vertices on one side of it.
 *
 *            b            Two sides with vertices, ab and bc: a strip of triangles leads from ca
 *           / \           to b. Each has vertices of both sides, and none is b but in the last,
 *         p1---q1         so none is flat. Three sides: the line from c to a vertex of ab cuts the
 *         / \ / \         triangle into two, each with vertices on two sides at most. */
#include "mend/triangle_cut.h"
#include "mend/mend_geometry.h"

/* A side of a triangle: its first corner, and the vertices inside it. */
typedef struct cut_side {
    uint32_t corner;
    const mw_cut_vertex *inner;
    size_t count;
} cut_side;

typedef struct cutter {
    const mw_mend_work *work;
    mw_mend_triangle *part; /* the next one */
    uint32_t from;
} cutter;

static void cutter_add(cutter *c, uint32_t u, uint32_t v, uint32_t w)
{
    *c->part++ = (mw_mend_triangle){{u, v, w}, c->from};
}

/* Vertex i of a side, counted from its first corner, or from the last one. */
static uint32_t side_forward(const cut_side *side, size_t i)
{
    return i == 0 ? side->corner : side->inner[i - 1].vertex;
}
static uint32_t side_backward(const cut_side *side, uint32_t last, size_t i)
{
    return i == 0 ? last : side->inner[side->count - i].vertex;
}

/* The sides are ab, bc and ca, of which ca has no vertices inside. */
static void cutter_strip(cutter *c, const cut_side *ab, const cut_side *bc, uint32_t last)
{
    size_t i = 0, j = 0;
    while (i < ab->count || j < bc->count) {
        uint32_t p = side_forward(ab, i), q = side_backward(bc, last, j);
        uint32_t p_next = i < ab->count ? side_forward(ab, i + 1) : MW_NONE;
        uint32_t q_next = j < bc->count ? side_backward(bc, last, j + 1) : MW_NONE;
        bool on_ab = q_next == MW_NONE ||
                     (p_next != MW_NONE && mw__mend_square_distance(c->work, p_next, q) <=
                                               mw__mend_square_distance(c->work, p, q_next));
        if (on_ab) {
            cutter_add(c, p, p_next, q);
            i++;
        } else {
            cutter_add(c, p, q_next, q);
            j++;
        }
    }
    cutter_add(c, side_forward(ab, i), bc->corner, side_backward(bc, last, j));
}

/* Cut where one of the three sides has no vertices inside: turn until it is the last. */
static void cutter_cut_two_sides(cutter *c, const cut_side side[3])
{
    int k = 0;
    while (side[(k + 2) % 3].count > 0) k++;
    cutter_strip(c, &side[k], &side[(k + 1) % 3], side[(k + 2) % 3].corner);
}

void mw__triangle_cut(const mw_mend_work *w, const mw_mend_triangle *triangle,
                      const mw_cut_vertex *vertex, size_t count, mw_mend_triangle *part)
{
    cutter c = {w, part, triangle->from};
    cut_side side[3];
    for (uint32_t k = 0, at = 0; k < 3; k++) {
        side[k] = (cut_side){triangle->v[k], vertex + at, 0};
        while (at < count && vertex[at].half % 4 == k) at++;
        side[k].count = (size_t)(vertex + at - side[k].inner);
    }
    if (side[0].count == 0 || side[1].count == 0 || side[2].count == 0) {
        cutter_cut_two_sides(&c, side);
        return;
    }
    size_t middle = side[0].count / 2;
    uint32_t m = side[0].inner[middle].vertex, c2 = side[2].corner;
    const cut_side none_at_m = {m, vertex, 0}, none_at_c2 = {c2, vertex, 0};
    const cut_side begin = {side[0].corner, side[0].inner, middle};
    const cut_side end = {m, side[0].inner + middle + 1, side[0].count - middle - 1};
    cutter_cut_two_sides(&c, (const cut_side[3]){begin, none_at_m, side[2]});
    cutter_cut_two_sides(&c, (const cut_side[3]){end, side[1], none_at_c2});
}
