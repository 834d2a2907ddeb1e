/* edit_locate.c - queries of an editor against brute force over its twin. */
#include "oracle/edit_locate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "support/meshes.h"

bool twin_triangle_holds(const twin *t, uint32_t k, const double *q, location_answer *answer)
{
    const uint32_t *v = twin_corners(t, k);
    const double *p[3] = {twin_point(t, v[0]), twin_point(t, v[1]), twin_point(t, v[2])};
    for (int c = 0; c < 2; c++) {
        if (q[c] < p[0][c] && q[c] < p[1][c] && q[c] < p[2][c]) return false;
        if (q[c] > p[0][c] && q[c] > p[1][c] && q[c] > p[2][c]) return false;
    }
    int turn = plane_orient(p[0], p[1], p[2]), zeros = 0, edge = 0, off = 0;
    for (int e = 0; e < 3; e++) {
        int s = plane_orient(p[e], p[(e + 1) % 3], q) * turn;
        if (s < 0) return false;
        if (s == 0) {
            zeros++;
            edge = e;
        } else {
            off = e;
        }
    }
    *answer = (location_answer){k,
                                (uint8_t)(zeros == 0   ? MW_INSIDE
                                          : zeros == 1 ? MW_ON_EDGE
                                                       : MW_ON_VERTEX),
                                (uint8_t)(zeros == 0   ? 255
                                          : zeros == 1 ? edge
                                                       : (off + 2) % 3)};
    return true;
}

location_answer twin_locate(const twin *t, const double *q)
{
    location_answer answer = {MW_NONE, MW_OUTSIDE, 255};
    if (!isfinite(q[0]) || !isfinite(q[1])) return (location_answer){MW_NONE, MW_BAD, 255};
    for (uint32_t k = 0; k < t->triangle_range; k++)
        if (twin_has_triangle(t, k) && twin_triangle_holds(t, k, q, &answer)) break;
    return answer;
}

/* Is that the answer, where the lowest triangle that holds q is known? */
static void check_location(const twin *t, const mw_location *l, const double *q,
                           location_answer expected)
{
    REQUIRE(l->triangle == expected.triangle);
    if (expected.triangle == MW_NONE) {
        REQUIRE(l->local == 255);
        if (expected.where == MW_BAD) REQUIRE(l->where == MW_BAD && l->hole == MW_NONE);
        if (expected.where == MW_BAD || t->border_moved) return;
        mw_cursor cursor;
        REQUIRE(mw_cursor_init(t->first_locator, NULL, &cursor, NULL) == MW_OK);
        mw_location first = mw_locate(t->first_locator, &cursor, q[0], q[1]);
        if (t->convex) first.where = MW_OUTSIDE;
        REQUIRE(l->where == first.where);
        if (!t->convex)
            REQUIRE(t->compacted ? (l->hole == MW_NONE) == (first.hole == MW_NONE)
                                 : l->hole == first.hole);
        return;
    }
    REQUIRE(l->where == expected.where && l->local == expected.local && l->hole == MW_NONE);
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        REQUIRE(l->weight[k] >= 0 && l->weight[k] <= 1 + 1e-9);
        sum += l->weight[k];
        if (l->where == MW_ON_VERTEX) REQUIRE(l->weight[k] == (k == l->local));
        if (l->where == MW_ON_EDGE && k == (l->local + 2) % 3) REQUIRE(l->weight[k] == 0);
    }
    REQUIRE(fabs(sum - 1) < 1e-9);
    double got, value = 0;
    for (uint32_t f = 0; f < t->fields; f++, value = 0) {
        for (int k = 0; k < 3; k++)
            if (l->weight[k] != 0)
                value += l->weight[k] * t->value[f][twin_corners(t, l->triangle)[k]];
        mw_editor_interpolate(t->editor, f, l, 1, &got);
        REQUIRE(fabs(got - value) <= 1e-9 * fabs(value) || (isnan(got) && isnan(value)));
    }
}

static void open_cursor(twin_cursors *cursors, const twin *t, int walk)
{
    mw_query_options options = {.walk = (mw_walk_kind)walk, .seed = mw__random(&cursors->random)};
    do options.start = (mw_start_kind)mw__random_below(&cursors->random, MW_START_COUNT);
    while (mw_start_has_index(options.start) && !cursors->index[options.start]);
    options.index = cursors->index[options.start];
    options.arithmetic = (mw_arithmetic)mw__random_below(&cursors->random, 2);
    options.counters = (int)mw__random_below(&cursors->random, 2);
    mw_error error = {0};
    expect_ok(
        mw_cursor_init(mw_editor_locator(t->editor), &options, &cursors->cursor[walk], &error),
        "cursor", &error);
}

void twin_cursors_open(twin_cursors *cursors, const twin *t, bool indexed, uint64_t seed)
{
    mw_error error = {0};
    *cursors = (twin_cursors){.random = seed};
    for (int start = 0; start < MW_START_COUNT && indexed; start++)
        if (mw_start_has_index((mw_start_kind)start))
            expect_ok(mw_editor_index(t->editor, (mw_start_kind)start, NULL, &cursors->index[start],
                                      &error),
                      "index", &error);
    for (int walk = 0; walk < MW_WALK_COUNT; walk++) open_cursor(cursors, t, walk);
}

void twin_cursors_check(twin_cursors *cursors, const twin *t, const double *q,
                        location_answer expected)
{
    int walk = (int)mw__random_below(&cursors->random, MW_WALK_COUNT);
    if (mw__random_below(&cursors->random, 16) == 0) open_cursor(cursors, t, walk);
    mw_location location =
        mw_locate(mw_editor_locator(t->editor), &cursors->cursor[walk], q[0], q[1]);
    check_location(t, &location, q, expected);
}

/* The same answers by a batch, and the last triangle of a way. */
static void check_batch(twin_cursors *cursors, const twin *t, const double *q, size_t n,
                        const location_answer *expected)
{
    mw_location *locations = require_room(n, sizeof *locations);
    mw_query_options options = {
        .walk = (mw_walk_kind)mw__random_below(&cursors->random, MW_WALK_COUNT)};
    mw_error error = {0};
    expect_ok(
        mw_locate_batch(mw_editor_locator(t->editor), q, n, 2, &options, locations, NULL, &error),
        "batch", &error);
    for (size_t i = 0; i < n; i++) check_location(t, &locations[i], q + 2 * i, expected[i]);
    uint32_t way[64];
    mw_location last;
    size_t length = mw_walk_path(mw_editor_locator(t->editor), &cursors->cursor[options.walk], q[0],
                                 q[1], way, 64, &last);
    check_location(t, &last, q, expected[0]);
    for (size_t i = 0; i < length && i < 64; i++) REQUIRE(twin_has_triangle(t, way[i]));
    free(locations);
}

void twin_check_queries(const twin *t, twin_cursors *cursors)
{
    const double away[][2] = {{-1e3, -1e3}, {1e3, 0.5}, {0.5, 1e3}, {NAN, 0}, {0, INFINITY}};
    size_t most = (size_t)t->vertices + 6 * (size_t)t->triangles + 5, n = 0;
    double *q = require_room(2 * most, sizeof *q);
    for (uint32_t v = 0; v < t->vertex_range; v++)
        if (t->state[v] != TWIN_GONE) memcpy(q + 2 * n++, twin_point(t, v), 2 * sizeof *q);
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        if (!twin_has_triangle(t, k)) continue;
        const double *p[3];
        for (int c = 0; c < 3; c++) p[c] = twin_point(t, twin_corners(t, k)[c]);
        for (int c = 0; c < 3; c++) {
            const double *u = p[c], *v = p[(c + 1) % 3], *w = p[(c + 2) % 3];
            for (int i = 0; i < 2; i++) {
                q[2 * n + (size_t)i] = u[i] / 2 + v[i] / 2;
                if (c == 0) q[2 * n + 2 + (size_t)i] = u[i] / 3 + v[i] / 3 + w[i] / 3;
            }
            n += c == 0 ? 2 : 1;
        }
    }
    for (int i = 0; i < 5; i++) memcpy(q + 2 * n++, away[i], sizeof away[i]);
    REQUIRE(n <= most);
    location_answer *expected = require_room(n, sizeof *expected);
    for (size_t i = 0; i < n; i++) {
        expected[i] = twin_locate(t, q + 2 * i);
        twin_cursors_check(cursors, t, q + 2 * i, expected[i]);
    }
    check_batch(cursors, t, q, n, expected);
    free(expected);
    free(q);
}
