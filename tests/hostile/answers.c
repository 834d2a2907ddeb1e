/* answers.c - what every walk says of a hostile mesh, held against exact rationals. */
#include "hostile/hostile.h"
#include "oracle/location_oracle.h"
#include "support/start_list.h"

#include <stdio.h>
#include <stdlib.h>

enum { OF_EACH_KIND = 3 }; /* queries of each of eight kinds */

static void expect_answer(const location_answer *want, const mw_location *got, const double *q,
                          const char *how)
{
    bool outside = want->triangle == MW_NONE && want->where != MW_BAD;
    bool right = got->triangle == want->triangle && got->local == want->local &&
                 (got->where == want->where || (outside && got->where == MW_IN_HOLE));
    if (right) return;
    hostile_failed("%s: (%.17g, %.17g) is in triangle %u (%s, %u), not %u (%s, %u)", how, q[0],
                   q[1], want->triangle, mw_where_name((mw_where)want->where), want->local,
                   got->triangle, mw_where_name((mw_where)got->where), got->local);
}

static mw_query_options any_options(mw_walk_kind walk, mw_index *const *index, uint64_t *random)
{
    mw_start_kind start = (mw_start_kind)mw__random_below(random, MW_START_COUNT);
    return (mw_query_options){.walk = walk,
                              .start = start,
                              .arithmetic = (mw_arithmetic)mw__random_below(random, 2),
                              .seed = mw__random(random),
                              .threads = 1 + mw__random_below(random, 3),
                              .lanes = mw__random_below(random, MW_MAX_LANES + 1),
                              .counters = (int)mw__random_below(random, 2),
                              .index = index[start]};
}

static void check_walk(const mw_locator *locator, const mw_query_options *options, const double *q,
                       size_t n, const location_answer *want)
{
    mw_location *at = malloc(n * sizeof *at);
    mw_cursor cursor;
    mw_error error;
    char how[96];
    snprintf(how, sizeof how, "%s from %s", mw_walk_name(options->walk),
             mw_start_name(options->start));
    expect_ok(mw_locate_batch(locator, q, n, 2, options, at, NULL, &error), "a batch", &error);
    for (size_t i = 0; i < n; i++) expect_answer(&want[i], &at[i], q + 2 * i, how);
    expect_ok(mw_cursor_init(locator, options, &cursor, &error), "a cursor", &error);
    for (size_t i = 0; i < n; i++) {
        mw_location one = mw_locate(locator, &cursor, q[2 * i], q[2 * i + 1]);
        expect_answer(&want[i], &one, q + 2 * i, how);
    }
    free(at);
}

static void check_open(const mw_mesh *mesh, const double *q, size_t n, const location_answer *want)
{
    mw_locator *locator =
        mesh_locator(mesh, (mw_locator_options){.fill = MW_FILL_NO, .threads = 1});
    mw_query_options options = {.start = MW_START_RANDOM, .threads = 1};
    check_walk(locator, &options, q, n, want);
    mw_locator_destroy(locator);
}

void hostile_check_answers(const arrays *a, uint64_t *random)
{
    size_t n;
    double *q = arrays_queries(a, OF_EACH_KIND, &n, random);
    location_answer *want = malloc(n * sizeof *want);
    for (size_t i = 0; i < n; i++)
        want[i] = location_oracle_locate(a->points, a->triangles, a->triangle_count, q + 2 * i);
    mw_mesh *mesh =
        arrays_mesh(a, (mw_mesh_options){.layout = (mw_mesh_layout)mw__random_below(random, 3),
                                         .threads = 1 + mw__random_below(random, 3)});
    mw_locator *locator =
        mesh_locator(mesh, (mw_locator_options){.fill = MW_FILL_YES,
                                                .areas = (int)mw__random_below(random, 2),
                                                .threads = 1 + mw__random_below(random, 3)});
    mw_index *index[MW_START_COUNT];
    starts_open(locator, index);
    for (int walk = MW_WALK_AUTO; walk < MW_WALK_COUNT; walk++) {
        mw_query_options options = any_options((mw_walk_kind)walk, index, random);
        check_walk(locator, &options, q, n, want);
    }
    check_open(mesh, q, n, want);
    starts_close(index);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    free(want);
    free(q);
}
