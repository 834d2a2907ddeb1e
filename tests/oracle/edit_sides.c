/* edit_sides.c - the edges of a twin, and its border. */
#include "oracle/edit_sides.h"

#include <stdlib.h>
#include <string.h>

int twin_compare_sides(const void *left, const void *right)
{
    const twin_side *a = left, *b = right;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return a->to < b->to ? -1 : a->to > b->to;
}

twin_side twin_side_of(const twin *t, uint32_t triangle, int turn, int k)
{
    const uint32_t *v = twin_corners(t, triangle);
    twin_side s = {v[k], v[(k + 1) % 3], v[(k + 2) % 3], triangle};
    return turn > 0 ? s : (twin_side){s.to, s.from, s.apex, triangle};
}

twin_side *twin_sides(const twin *t, size_t *count)
{
    twin_side *sides = require_room(3 * (size_t)t->triangles, sizeof *sides);
    *count = 0;
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        if (!twin_has_triangle(t, k)) continue;
        int turn = twin_turn(t, k);
        REQUIRE(turn != 0);
        REQUIRE(*count < 3 * (size_t)t->triangles);
        for (int e = 0; e < 3; e++) sides[(*count)++] = twin_side_of(t, k, turn, e);
    }
    REQUIRE(*count == 3 * (size_t)t->triangles);
    qsort(sides, *count, sizeof *sides, twin_compare_sides);
    for (size_t i = 1; i < *count; i++) REQUIRE(twin_compare_sides(&sides[i - 1], &sides[i]) < 0);
    return sides;
}

const twin_side *twin_find_side(const twin_side *sides, size_t count, uint32_t from, uint32_t to)
{
    twin_side key = {.from = from, .to = to};
    return bsearch(&key, sides, count, sizeof *sides, twin_compare_sides);
}

bool twin_find_edge(const twin *t, uint32_t a, uint32_t b, twin_side *found)
{
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        if (!twin_has_triangle(t, k)) continue;
        const uint32_t *v = twin_corners(t, k);
        bool near = (v[0] == a || v[1] == a || v[2] == a) && (v[0] == b || v[1] == b || v[2] == b);
        for (int c = 0; c < 3 && near; c++) {
            *found = twin_side_of(t, k, twin_turn(t, k), c);
            if (found->from == a && found->to == b) return true;
        }
    }
    return false;
}

int twin_count_sides(const twin *t, uint32_t a, uint32_t b)
{
    twin_side s;
    return (int)twin_find_edge(t, a, b, &s) + (int)twin_find_edge(t, b, a, &s);
}

/* --- the border ------------------------------------------------------------------------------- */

twin_border_vertex *twin_border_vertices(const twin *t, const twin_side *sides, size_t count)
{
    twin_border_vertex *b = require_room(t->vertex_range, sizeof *b);
    for (size_t i = 0; i < count; i++) {
        if (twin_find_side(sides, count, sides[i].to, sides[i].from)) continue;
        b[sides[i].from].out++;
        b[sides[i].from].after = sides[i].to;
        b[sides[i].to].in++;
        b[sides[i].to].before = sides[i].from;
    }
    return b;
}

static bool is_straight(const twin *t, const twin_border_vertex *b, uint32_t v)
{
    return b[v].in == 1 && b[v].out == 1 &&
           plane_is_on_segment(twin_point(t, b[v].before), twin_point(t, b[v].after),
                               twin_point(t, v));
}

static int by_numbers(const void *left, const void *right)
{
    const double *a = left, *b = right;
    for (int i = 0; i < 4; i++)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

static double *straight_border(const twin *t, const twin_side *sides, size_t count, size_t *parts)
{
    twin_border_vertex *b = twin_border_vertices(t, sides, count);
    double *border = require_room(4 * count, sizeof *border);
    *parts = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t from = sides[i].from, to = sides[i].to;
        if (twin_find_side(sides, count, to, from) || is_straight(t, b, from)) continue;
        while (is_straight(t, b, to)) to = b[to].after;
        double *part = border + 4 * (*parts)++;
        memcpy(part, twin_point(t, from), 2 * sizeof *part);
        memcpy(part + 2, twin_point(t, to), 2 * sizeof *part);
    }
    free(b);
    qsort(border, *parts, 4 * sizeof *border, by_numbers);
    return border;
}

void twin_keep_border(twin *t)
{
    size_t count;
    twin_side *sides = twin_sides(t, &count);
    free(t->border);
    t->border = straight_border(t, sides, count, &t->border_count);
    free(sides);
}

static void check_border_fixed(const twin *t, const twin_side *sides, size_t count)
{
    size_t parts;
    double *border = straight_border(t, sides, count, &parts);
    REQUIRE(parts == t->border_count);
    for (size_t i = 0; i < parts; i++) REQUIRE(by_numbers(border + 4 * i, t->border + 4 * i) == 0);
    free(border);
}

/* The border is one convex polygon: a loop that never turns right, and turns once. With that and
 * triangles that all turn the same way, with no two on one side of an edge, each point in the
 * polygon is covered once. */
static void check_border_convex(const twin *t, const twin_side *sides, size_t count)
{
    twin_border_vertex *b = twin_border_vertices(t, sides, count);
    uint32_t first = MW_NONE, edges = 0, length = 0, halves = 0;
    for (uint32_t v = 0; v < t->vertex_range; v++) {
        REQUIRE(b[v].in == b[v].out && b[v].in <= 1);
        if (b[v].out) first = v;
        edges += b[v].out;
    }
    REQUIRE(first != MW_NONE);
    uint32_t v = first;
    do {
        const double *p = twin_point(t, b[v].before), *q = twin_point(t, v),
                     *r = twin_point(t, b[v].after);
        REQUIRE(plane_orient(p, q, r) >= 0);
        halves += (q[1] > p[1] || (q[1] == p[1] && q[0] > p[0])) !=
                  (r[1] > q[1] || (r[1] == q[1] && r[0] > q[0]));
        v = b[v].after;
        length++;
    } while (v != first && length <= edges);
    REQUIRE(length == edges && halves == 2);
    uint32_t used = 0;
    for (v = 0; v < t->vertex_range; v++) used += t->state[v] == TWIN_USED;
    REQUIRE(t->triangles == 2 * used - 2 - edges); /* Euler */
    free(b);
}

void twin_check_border(const twin *t, const twin_side *sides, size_t count)
{
    if (t->convex)
        check_border_convex(t, sides, count);
    else
        check_border_fixed(t, sides, count);
}
