/* locate.c - where points lie. A block of queries is located in the rank's own piece first; those
 * that are not strictly inside one of its triangles are asked of the ranks in whose boxes they lie.
 * The lowest triangle of all answers wins. What no rank has found, the rim decides. */
#include "mpi/mesh/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 1 << 18 }; /* queries in a block, and the budget by default */

typedef struct question {
    double point[2];
} question;

typedef struct answer {
    uint32_t number; /* of the question; the talk wants it first */
    uint32_t given;
    double weight[3];
    int64_t triangle;
    uint8_t where, local;
    uint16_t reserved[3];
} answer;

static const double *query_point(const mwp_locating *l, size_t i)
{
    return &l->points[i * l->stride];
}

static mwp_location location_nowhere(mw_where where)
{
    return (mwp_location){.weight = {NAN, NAN, NAN},
                          .triangle = -1,
                          .hole = MW_NONE,
                          .rank = -1,
                          .index = MW_NONE,
                          .where = (uint8_t)where,
                          .local = 255};
}

/* --- the rank's own piece --------------------------------------------------------------------- */

/* Locate points in the piece; `found` receives n locations. */
static mw_status part_locate(const mwp_part *part, const void *points, size_t n, uint32_t threads,
                             mw_location *found, mwp_error *error)
{
    mw_error from;
    const mw_query_options options = {.threads = threads};
    return mw_locate_batch(part->locator, points, n, 2, &options, found, NULL, &from)
               ? mwp__fail_as(error, &from)
               : MW_OK;
}

/* Of a point in a triangle of the piece. */
static mwp_location location_of_part(const mwp_mesh *m, const mw_location *at)
{
    mwp_location l = {.triangle = m->part.own.triangle[at->triangle],
                      .hole = MW_NONE,
                      .rank = m->wire.rank,
                      .index = m->part.own.given[at->triangle],
                      .where = at->where,
                      .local = at->local};
    memcpy(l.weight, at->weight, sizeof l.weight);
    return l;
}

/* --- the questions of a block ----------------------------------------------------------------- */

/* The block's queries, as they are sorted: which of them may be in this rank's piece only, and
 * which are asked of which other rank. Made for the largest block, and used for all. */
struct mwp_block {
    int *ranks;      /* of one query */
    int *rank;       /* per query: the only rank in whose boxes it is, or NOBODY, or SEVERAL */
    bool *known;     /* per query: it has its answer, or one that a lower triangle may replace */
    uint32_t *count; /* questions for each rank */
    /* Queries, from the beginning of the block: in the boxes of this rank only; of one other rank
     * only; of several. `shared` are those of `several` that are in this rank's boxes, too. */
    uint32_t *own, *other, *several, *shared;
    size_t own_count, other_count, several_count, shared_count;
    size_t own_done; /* of `own`: located so far */
    size_t room;     /* of the next two */
    question *points;
    mw_location *found;
};

enum { NOBODY = MWP_CELL_EMPTY, SEVERAL = MWP_CELL_SEVERAL };

static void block_release(mwp_block *w)
{
    if (!w) return;
    free(w->ranks);
    free(w->rank);
    free(w->known);
    free(w->count);
    free(w->own);
    free(w->other);
    free(w->several);
    free(w->shared);
    free(w->points);
    free(w->found);
    free(w);
}

/* For blocks of up to n queries, which are located `room` at a time. NULL when out of memory. */
static mwp_block *block_create(const mwp_mesh *m, size_t n, size_t room)
{
    mwp_block *w = mwp__alloc(1, sizeof *w);
    if (!w) return NULL;
    *w = (mwp_block){.ranks = mwp__alloc((size_t)m->wire.size, sizeof *w->ranks),
                     .rank = mwp__alloc(n, sizeof *w->rank),
                     .known = mwp__alloc(n, sizeof *w->known),
                     .count = mwp__alloc((size_t)m->wire.size, sizeof *w->count),
                     .own = mwp__alloc(n, sizeof *w->own),
                     .other = mwp__alloc(n, sizeof *w->other),
                     .several = mwp__alloc(n, sizeof *w->several),
                     .shared = mwp__alloc(n, sizeof *w->shared),
                     .room = room,
                     .points = mwp__alloc(room, sizeof *w->points),
                     .found = mwp__alloc(room, sizeof *w->found)};
    if (w->ranks && w->rank && w->known && w->count && w->own && w->other && w->several &&
        w->shared && w->points && w->found)
        return w;
    block_release(w);
    return NULL;
}

/* In whose boxes a query is that the grid does not tell: the only rank, or NOBODY, or SEVERAL. */
static int query_look(const mwp_locating *l, size_t i, mwp_block *w)
{
    const double *p = query_point(l, i);
    const uint32_t place = (uint32_t)(i - l->begin);
    bool here = false;
    if (!isfinite(p[0]) || !isfinite(p[1])) {
        l->locations[i] = location_nowhere(MW_BAD);
        w->known[place] = true;
        return NOBODY;
    }
    const int count = mwp__router_find(&l->mesh->router, p, w->ranks);
    if (count < 2) return count == 0 ? NOBODY : w->ranks[0];
    for (int k = 0; k < count; k++) here = here || w->ranks[k] == l->mesh->wire.rank;
    w->several[w->several_count++] = place;
    if (here) w->shared[w->shared_count++] = place;
    return SEVERAL;
}

/* Note in whose boxes each query is. Half of them may be another rank's, in any order, so which is
 * not branched on: each is written to both lists, and stays in one. */
static void block_look(const mwp_locating *l, mwp_block *w)
{
    const int me = l->mesh->wire.rank;
    size_t own = 0, other = 0;
    w->own_done = w->several_count = w->shared_count = 0;
    for (size_t i = l->begin; i < l->end; i++) {
        const uint32_t place = (uint32_t)(i - l->begin);
        int rank = mwp__router_cell(&l->mesh->router, query_point(l, i));
        if (rank == SEVERAL) rank = query_look(l, i, w);
        w->rank[place] = rank;
        w->own[own] = w->other[other] = place;
        own += rank == me;
        other += rank >= 0 && rank != me;
    }
    w->own_count = own;
    w->other_count = other;
}

/* The other ranks that may have the triangle of a query in the boxes of several, in w->ranks; none
 * if its answer is known. Returns how many. */
static int query_ranks(const mwp_locating *l, uint32_t place, const mwp_block *w)
{
    const size_t i = l->begin + place;
    int kept = 0;
    if (w->known[place] && l->locations[i].where == MW_INSIDE) return 0;
    const int count = mwp__router_find(&l->mesh->router, query_point(l, i), w->ranks);
    for (int k = 0; k < count; k++)
        if (w->ranks[k] != l->mesh->wire.rank) w->ranks[kept++] = w->ranks[k];
    return kept;
}

/* Locate queries of the block in the piece, at most as many as there is room for. */
static mw_status block_locate(const mwp_locating *l, const uint32_t *queries, size_t n,
                              mwp_error *error)
{
    const mwp_block *w = l->block;
    for (size_t k = 0; k < n; k++)
        memcpy(w->points[k].point, query_point(l, l->begin + queries[k]), sizeof *w->points);
    mw_status status =
        part_locate(&l->mesh->part, w->points, n, l->options.threads, w->found, error);
    for (size_t k = 0; k < n && !status; k++) {
        w->known[queries[k]] = w->found[k].triangle != MW_NONE;
        if (w->known[queries[k]])
            l->locations[l->begin + queries[k]] = location_of_part(l->mesh, &w->found[k]);
    }
    return status;
}

/* Some more of the queries that only this rank can answer. *more: there are further ones. */
static mw_status locate_meanwhile(void *self, bool *more, mwp_error *error)
{
    const mwp_locating *l = self;
    mwp_block *w = l->block;
    const size_t left = w->own_count - w->own_done, n = left < w->room ? left : w->room;
    const uint32_t *queries = w->own + w->own_done;
    w->own_done += n;
    *more = w->own_done < w->own_count;
    return n ? block_locate(l, queries, n, error) : MW_OK;
}

static mw_status block_sort(const mwp_locating *l, mwp_error *error)
{
    mwp_block *w = l->block;
    mw_status status = MW_OK;
    memset(w->known, 0, (l->end - l->begin) * sizeof *w->known);
    block_look(l, w);
    for (size_t k = 0; k < w->shared_count && !status; k += w->room) {
        const size_t left = w->shared_count - k;
        status = block_locate(l, w->shared + k, left < w->room ? left : w->room, error);
    }
    return status;
}

static bool asked_make_room(mwp_locating *l, size_t n)
{
    if (l->asked && n <= l->asked_room) return true;
    free(l->asked);
    l->asked = mwp__alloc(n, sizeof *l->asked);
    l->asked_room = l->asked ? n : 0;
    return l->asked;
}

static void question_add(mwp_locating *l, mwp_parcels *questions, int rank, uint32_t place)
{
    const double *p = query_point(l, l->begin + place);
    l->asked[questions->next[rank]] = place;
    *(question *)mwp__parcels_add(questions, rank) = (question){{p[0], p[1]}};
}

static mw_status block_pack(mwp_locating *l, mwp_parcels *questions, mwp_error *error)
{
    const mwp_block *w = l->block;
    memset(w->count, 0, (size_t)l->mesh->wire.size * sizeof *w->count);
    for (size_t i = 0; i < w->other_count; i++) w->count[w->rank[w->other[i]]]++;
    for (size_t i = 0; i < w->several_count; i++)
        for (int k = query_ranks(l, w->several[i], w) - 1; k >= 0; k--) w->count[w->ranks[k]]++;
    if (!mwp__parcels_create(questions, &l->mesh->wire, sizeof(question), w->count) ||
        !asked_make_room(l, questions->total))
        return mwp__fail_memory(error);
    for (size_t i = 0; i < w->other_count; i++)
        question_add(l, questions, w->rank[w->other[i]], w->other[i]);
    for (size_t i = 0; i < w->several_count; i++)
        for (int k = query_ranks(l, w->several[i], w) - 1; k >= 0; k--)
            question_add(l, questions, w->ranks[k], w->several[i]);
    return MW_OK;
}

/* How many queries are located at a time: so few that they stay in the cache; but threads, which
 * are made for each time, want many. */
static size_t locating_room(uint32_t threads, size_t most)
{
    enum { FEW = 1 << 13 };
    return threads == 1 && most > FEW ? FEW : most;
}

static mw_status locate_load(void *self, mwp_parcels *questions, bool *more, mwp_error *error)
{
    mwp_locating *l = self;
    l->begin = l->next;
    l->end = l->n - l->begin > BLOCK ? l->begin + BLOCK : l->n;
    l->next = l->end;
    *more = l->next < l->n;
    if (!l->block) { /* the first is the largest */
        const size_t most = l->end - l->begin;
        l->block = block_create(l->mesh, most, locating_room(l->options.threads, most));
    }
    if (!l->block) return mwp__fail_memory(error);
    mw_status status = block_sort(l, error);
    return status ? status : block_pack(l, questions, error);
}

/* --- answers ---------------------------------------------------------------------------------- */

/* Answers to the questions that have been located, the first of which has the number `first`.
 * Returns how many. */
static size_t answers_write(const mwp_own *own, const mw_location *found, size_t n, size_t first,
                            answer *out)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        const mw_location *at = &found[i];
        if (at->triangle == MW_NONE) continue;
        answer *a = &out[count++];
        *a = (answer){.number = (uint32_t)(first + i),
                      .given = own->given[at->triangle],
                      .triangle = own->triangle[at->triangle],
                      .where = at->where,
                      .local = at->local};
        memcpy(a->weight, at->weight, sizeof a->weight);
    }
    return count;
}

static mw_status locate_answer(void *self, const void *questions, size_t n, void *answers,
                               size_t *count, mwp_error *error)
{
    const mwp_locating *l = self;
    const mwp_part *part = &l->mesh->part;
    const question *asked = questions;
    answer *out = answers;
    const size_t room = locating_room(l->options.threads, n);
    mw_location *found = mwp__alloc(room, sizeof *found);
    mw_status status = found ? MW_OK : mwp__fail_memory(error);
    *count = 0;
    for (size_t i = 0; i < n && !status; i += room) {
        const size_t some = n - i < room ? n - i : room;
        status = part_locate(part, asked + i, some, l->options.threads, found, error);
        if (!status) *count += answers_write(&part->own, found, some, i, out + *count);
    }
    free(found);
    return status;
}

static void locate_take(void *self, int rank, size_t first, const void *answers, size_t n)
{
    const mwp_locating *l = self;
    const answer *a = answers;
    for (size_t i = 0; i < n; i++, a++) {
        const uint32_t place = l->asked[first + a->number];
        mwp_location *at = &l->locations[l->begin + place];
        if (l->block->known[place] && at->triangle <= a->triangle) continue;
        l->block->known[place] = true;
        *at = (mwp_location){.triangle = a->triangle,
                             .hole = MW_NONE,
                             .rank = rank,
                             .index = a->given,
                             .where = a->where,
                             .local = a->local};
        memcpy(at->weight, a->weight, sizeof at->weight);
    }
}

/* --- points in no triangle -------------------------------------------------------------------- */

static mwp_location location_of_rim(const mwp_rim *rim, const mw_location *at)
{
    mwp_location l = location_nowhere((mw_where)at->where);
    memcpy(l.weight, at->weight, sizeof l.weight);
    l.local = at->local;
    if (at->hole != MW_NONE) l.hole = rim->hole[at->hole];
    if (at->triangle == MW_NONE) return l;
    const mwp_record *r = &rim->all.record[at->triangle];
    l.triangle = r->triangle;
    l.rank = r->rank;
    l.index = r->given;
    return l;
}

static mw_status locate_settle(void *self, mwp_error *error)
{
    const mwp_locating *l = self;
    mw_status status = MW_OK;
    for (bool more = true; more && !status;) status = locate_meanwhile(self, &more, error);
    if (status) return status;
    const mwp_rim *rim = &l->mesh->rim;
    mw_error from;
    mw_cursor cursor;
    const mw_query_options options = {.tolerance = l->options.tolerance};
    if (mw_cursor_init(rim->locator, &options, &cursor, &from)) return mwp__fail_as(error, &from);
    for (size_t i = l->begin; i < l->end; i++) {
        if (l->block->known[i - l->begin]) continue;
        const double *p = query_point(l, i);
        const mw_location found = mw_locate(rim->locator, &cursor, p[0], p[1]);
        l->locations[i] = location_of_rim(rim, &found);
    }
    return MW_OK;
}

/* --- the public calls ------------------------------------------------------------------------- */

static mw_status locating_check(const mwp_locating *l, mwp_error *error)
{
    const mwp_locate_options *o = &l->options;
    if (l->n && (!l->points || !l->locations))
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the points or the locations are NULL");
    if (l->stride == 1)
        return mwp__fail(error, MW_ERROR_ARGUMENT,
                         "the stride must be at least 2 (x and y), not 1");
    if (!(o->tolerance >= 0 && o->tolerance < INFINITY))
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the tolerance %g is negative or not finite",
                         o->tolerance);
    if (o->budget > INT32_MAX / 2)
        return mwp__fail(error, MW_ERROR_ARGUMENT,
                         "a budget of %u queries is too large; at most 2^30 - 1 are possible",
                         o->budget);
    for (size_t i = 0; i < sizeof o->reserved / sizeof *o->reserved; i++)
        if (o->reserved[i])
            return mwp__fail(error, MW_ERROR_ARGUMENT,
                             "a reserved member of mwp_locate_options is not zero");
    return MW_OK;
}

mwp_locating *mwp_locate_begin(mwp_mesh *mesh, const double *points, size_t n, size_t stride,
                               const mwp_locate_options *options, mwp_location *locations)
{
    static const mwp_talk_about about = {sizeof(question), sizeof(answer), locate_load,
                                         locate_answer,    locate_take,    locate_settle,
                                         locate_meanwhile};
    mwp_locating *l = &mesh->locating;
    *l = (mwp_locating){.mesh = mesh,
                        .points = points,
                        .n = n,
                        .stride = stride ? stride : 2,
                        .options = options ? *options : (mwp_locate_options){0},
                        .locations = locations};
    if (l->options.threads == 0) l->options.threads = 1;
    const uint32_t budget = l->options.budget ? l->options.budget : BLOCK;
    mwp_error error;
    mw_status status = locating_check(l, &error);
    mwp__talk_begin(&l->talk, &mesh->wire, &mesh->tables, &about, l, budget, status, &error);
    return l;
}

int mwp_locate_test(mwp_locating *locating)
{
    return mwp__talk_go(&locating->talk);
}

mw_status mwp_locate_end(mwp_locating *locating, mwp_error *error)
{
    mwp_error own_error;
    mw_status status = mwp__talk_end(&locating->talk, error ? error : &own_error);
    free(locating->asked);
    locating->asked = NULL;
    block_release(locating->block);
    locating->block = NULL;
    return status;
}

mw_status mwp_locate_batch(mwp_mesh *mesh, const double *points, size_t n, size_t stride,
                           const mwp_locate_options *options, mwp_location *locations,
                           mwp_error *error)
{
    return mwp_locate_end(mwp_locate_begin(mesh, points, n, stride, options, locations), error);
}

mw_status mwp_nearest_border(const mwp_mesh *mesh, double x, double y,
                             mwp_nearest_border_point *nearest, mwp_error *error)
{
    const mwp_rim *rim = &mesh->rim;
    mw_error from;
    mw_cursor cursor = {0};
    mw_nearest_border_point at;
    const mw_location where = mw_locate(rim->locator, &cursor, x, y);
    if (where.where == MW_BAD)
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the point is not finite");
    if (where.triangle != MW_NONE || (where.hole != MW_NONE && rim->hole[where.hole] == MW_NONE))
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the point lies in the mesh");
    if (mw_nearest_border(rim->locator, x, y, &at, &from)) return mwp__fail_as(error, &from);
    const mwp_record *r = &rim->all.record[at.triangle];
    *nearest = (mwp_nearest_border_point){.triangle = r->triangle,
                                          .rank = r->rank,
                                          .index = r->given,
                                          .edge = at.edge,
                                          .distance = at.distance};
    memcpy(nearest->point, at.point, sizeof at.point);
    memcpy(nearest->weight, at.weight, sizeof at.weight);
    return MW_OK;
}
