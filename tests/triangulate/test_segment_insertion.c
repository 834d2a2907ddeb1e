/* Segments forced into triangulations: the pieces, the triangles, and the Delaunay property, on
 * points of small grids. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdbool.h>
#include <stdlib.h>

#include "base/random.h"
#include "triangulate/constrained/segment_insertion.h"
#include "triangulate/delaunay/delaunay.h"

enum { MAX_POINTS = 60, MAX_PIECES = 3 * MAX_POINTS };

typedef struct segment_scene {
    mw_point point[MAX_POINTS];
    uint32_t n;
    mw_triangle *tri;
    uint32_t tri_count;
    mw_segment_insertion net;
    mw_subsegment piece[MAX_PIECES]; /* by number */
    uint64_t random;
} segment_scene;

static double turn(const segment_scene *s, uint32_t a, uint32_t b, uint32_t c)
{
    return mw__orient2d(s->point[a], s->point[b], s->point[c]);
}

/* Different points of a grid; false if they lie on one line. */
static bool make_points(segment_scene *s)
{
    uint32_t grid = 3 + mw__random_below(&s->random, 8),
             wanted = 3 + mw__random_below(&s->random, MAX_POINTS - 3);
    s->n = 0;
    for (uint32_t i = 0; i < wanted; i++) {
        mw_point p = {mw__random_below(&s->random, grid), mw__random_below(&s->random, grid)};
        bool seen = false;
        for (uint32_t j = 0; j < s->n; j++) seen |= s->point[j].x == p.x && s->point[j].y == p.y;
        if (!seen) s->point[s->n++] = p;
    }
    for (uint32_t i = 2; i < s->n; i++)
        if (turn(s, 0, 1, i) != 0) return true;
    return false;
}

/* Triangles counter-clockwise and linked, pieces the same from both sides; locally Delaunay but at
 * pieces. */
static void assert_sound(const segment_scene *s)
{
    for (uint32_t t = 0; t < s->tri_count; t++) {
        const mw_triangle *tri = &s->tri[t];
        assert_true(turn(s, tri->v[0], tri->v[1], tri->v[2]) > 0);
        assert_int_equal(tri->v[3], tri->v[0]);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t link = tri->link[k], other = mw__link_triangle(link), e = mw__link_edge(link);
            uint32_t piece = s->net.subsegment[3 * t + k];
            if (piece != MW_NONE) {
                const mw_subsegment *p = &s->piece[piece];
                assert_true((p->from == tri->v[k] && p->to == tri->v[k + 1]) ||
                            (p->to == tri->v[k] && p->from == tri->v[k + 1]));
            }
            if (link == MW_NONE) continue;
            assert_int_equal(s->tri[other].link[e], mw__link(t, k));
            assert_int_equal(s->tri[other].v[e], tri->v[k + 1]);
            assert_int_equal(s->tri[other].v[e + 1], tri->v[k]);
            assert_int_equal(s->net.subsegment[3 * other + e], piece);
            mw_point apex = s->point[s->tri[other].v[mw__prev(e)]];
            if (piece == MW_NONE)
                assert_true(mw__incircle(s->point[tri->v[0]], s->point[tri->v[1]],
                                         s->point[tri->v[2]], apex) <= 0);
        }
    }
    for (uint32_t v = 0; v < s->n; v++) {
        const uint32_t *at = s->tri[s->net.at[v]].v;
        assert_true(at[0] == v || at[1] == v || at[2] == v);
    }
}

static bool crosses(const segment_scene *s, uint32_t a, uint32_t b, const mw_subsegment *p)
{
    return turn(s, a, b, p->from) * turn(s, a, b, p->to) < 0 &&
           turn(s, p->from, p->to, a) * turn(s, p->from, p->to, b) < 0;
}

/* Force a segment in; returns whether it met no other one. */
static bool force(segment_scene *s, uint32_t a, uint32_t b, uint32_t *made)
{
    uint32_t from = a, to = b, before = s->net.subsegment_count, last_from = a, last_to = b;
    bool expected = true;
    for (uint32_t i = 0; i < before; i++) expected &= !crosses(s, a, b, &s->piece[i]);
    while (from != to) {
        mw_subsegment piece;
        mw_subsegment_result result = mw__insert_subsegment(&s->net, &from, &to, &piece);
        if (result == MW_SUBSEGMENT_CROSSES) {
            assert_false(expected);
            assert_true(piece.number < before && crosses(s, a, b, &s->piece[piece.number]));
            return false;
        }
        assert_int_equal(result, MW_SUBSEGMENT_DONE);
        /* the piece is at one end, the segment is shorter by it, and no vertex lies inside */
        assert_true((piece.from == last_from && piece.to == from && to == last_to) ||
                    (piece.to == last_to && piece.from == to && from == last_from) ||
                    (piece.from == last_from && piece.to == last_to));
        assert_true(turn(s, a, b, piece.from) == 0 && turn(s, a, b, piece.to) == 0);
        if (piece.number >= before) {
            s->piece[piece.number] = piece;
            (*made)++;
        }
        last_from = from;
        last_to = to;
    }
    assert_true(expected);
    return true;
}

static void run_scene(segment_scene *s, uint32_t *whole, uint32_t *stopped)
{
    if (!make_points(s)) return;
    assert_int_equal(
        mw__delaunay_triangles(s->point, s->n, MW_ALONE, NULL, NULL, &s->tri, &s->tri_count, NULL),
        MW_OK);
    assert_true(mw__segment_insertion_create(&s->net, s->point, s->n, s->tri, s->tri_count));
    assert_sound(s);
    uint32_t made = 0;
    for (uint32_t i = mw__random_below(&s->random, 30); i > 0; i--) {
        uint32_t a = mw__random_below(&s->random, s->n), b = mw__random_below(&s->random, s->n);
        if (a == b) continue;
        if (force(s, a, b, &made))
            (*whole)++;
        else
            (*stopped)++;
        assert_int_equal(made, s->net.subsegment_count);
        assert_sound(s);
    }
    mw__segment_insertion_release(&s->net);
    free(s->tri);
}

static void test_scenes(void **state)
{
    (void)state;
    uint32_t whole = 0, stopped = 0;
    for (uint64_t seed = 1; seed <= 6000; seed++) {
        segment_scene s = {.random = mw__random_seed(seed, 7)};
        print_message(seed == 1 ? "seeds 1 to 6000\n" : "");
        run_scene(&s, &whole, &stopped);
    }
    assert_true(whole > 20000 && stopped > 10000);
}

/* A long segment between two dense rows of points: a channel of as many triangles. */
static void test_long_channel(void **state)
{
    (void)state;
    enum { N = 20000 };
    mw_point *point = malloc((2 * N + 2) * sizeof *point);
    uint64_t random = 5;
    for (uint32_t i = 0; i < N; i++) {
        point[2 * i] = (mw_point){i, 1 + mw__random_below(&random, 1000) * 1e-3};
        point[2 * i + 1] = (mw_point){i + 0.5, -1 - mw__random_below(&random, 1000) * 1e-3};
    }
    point[2 * N] = (mw_point){-1, 0};
    point[2 * N + 1] = (mw_point){N + 1, 1e-9};
    mw_triangle *tri;
    uint32_t tri_count, from = 2 * N, to = 2 * N + 1;
    mw_segment_insertion net;
    mw_subsegment piece;
    assert_int_equal(
        mw__delaunay_triangles(point, 2 * N + 2, MW_ALONE, NULL, NULL, &tri, &tri_count, NULL),
        MW_OK);
    assert_true(mw__segment_insertion_create(&net, point, 2 * N + 2, tri, tri_count));
    assert_int_equal(mw__insert_subsegment(&net, &from, &to, &piece), MW_SUBSEGMENT_DONE);
    assert_true(from == to && piece.from == 2 * N && piece.to == 2 * N + 1 &&
                net.subsegment_count == 1);
    uint32_t crossing = 0, sides = 0;
    for (uint32_t t = 0; t < tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            mw_point a = point[tri[t].v[k]], b = point[tri[t].v[k + 1]];
            crossing += a.y * b.y < 0 && tri[t].v[k] < 2 * N && tri[t].v[k + 1] < 2 * N;
            sides += net.subsegment[3 * t + k] == 0;
        }
    assert_true(crossing == 0 && sides == 2);
    mw__segment_insertion_release(&net);
    free(tri);
    free(point);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scenes),
        cmocka_unit_test(test_long_channel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
