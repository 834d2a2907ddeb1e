/* owners.c - asks the owners of triangles, block by block. What this rank has itself is answered
 * without a message. */
#include "mpi/query/owners.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 1 << 16 };

typedef struct question {
    double weight[3];
    uint32_t index; /* the triangle's place in the caller's arrays */
    uint32_t reserved;
} question;

typedef struct owners {
    mwp_mesh *mesh;
    const mwp_location *at;
    size_t n, next;
    size_t bytes;
    mwp_owner_answer *answer;
    void *self;
    char *results;
    size_t *asked; /* per question of the block: its location */
} owners;

/* The locations in this piece that questions are about. */
static mw_status questions_read(const owners *o, const question *q, size_t n, mw_location *at,
                                mwp_error *error)
{
    const mwp_own *own = &o->mesh->part.own;
    for (size_t i = 0; i < n; i++) {
        if (q[i].index >= own->triangle_count)
            return mwp__fail(error, MW_ERROR_ARGUMENT,
                             "a location names triangle %u of a piece that has %u", q[i].index,
                             own->triangle_count);
        at[i] = (mw_location){.triangle = own->place[q[i].index], .hole = MW_NONE, .local = 255};
        memcpy(at[i].weight, q[i].weight, sizeof at[i].weight);
    }
    return MW_OK;
}

/* Answer questions, one packed answer after another. */
static mw_status questions_answer(const owners *o, const question *q, size_t n, void *answers,
                                  mwp_error *error)
{
    mw_location *at = mwp__alloc(n, sizeof *at);
    mw_status status = at ? questions_read(o, q, n, at, error) : mwp__fail_memory(error);
    if (!status) status = o->answer(o->self, o->mesh, at, n, answers, error);
    free(at);
    return status;
}

static question question_of(const mwp_location *at)
{
    question q = {.index = at->index};
    memcpy(q.weight, at->weight, sizeof q.weight);
    return q;
}

/* --- a block ---------------------------------------------------------------------------------- */

static mw_status block_answer_here(const owners *o, size_t begin, size_t end, mwp_error *error)
{
    const size_t room = end - begin;
    size_t n = 0;
    question *q = mwp__alloc(room, sizeof *q);
    char *answers = mwp__alloc(room, o->bytes);
    mw_status status = q && answers ? MW_OK : mwp__fail_memory(error);
    for (size_t i = begin; i < end && !status; i++)
        if (o->at[i].rank == o->mesh->wire.rank) q[n++] = question_of(&o->at[i]);
    if (!status && n) status = questions_answer(o, q, n, answers, error);
    n = 0;
    for (size_t i = begin; i < end && !status; i++)
        if (o->at[i].rank == o->mesh->wire.rank)
            memcpy(o->results + i * o->bytes, answers + n++ * o->bytes, o->bytes);
    free(answers);
    free(q);
    return status;
}

static bool location_is_asked(const owners *o, size_t i)
{
    return o->at[i].rank >= 0 && o->at[i].rank != o->mesh->wire.rank;
}

static mw_status owners_load(void *self, mwp_parcels *questions, bool *more, mwp_error *error)
{
    owners *o = self;
    const size_t begin = o->next, end = o->n - begin > BLOCK ? begin + BLOCK : o->n;
    o->next = end;
    *more = end < o->n;
    free(o->asked);
    o->asked = NULL;
    mw_status status = block_answer_here(o, begin, end, error);
    if (status) return status;
    uint32_t *count = calloc((size_t)o->mesh->wire.size, sizeof *count);
    for (size_t i = begin; count && i < end; i++)
        if (location_is_asked(o, i)) count[o->at[i].rank]++;
    if (!count || !mwp__parcels_create(questions, &o->mesh->wire, sizeof(question), count) ||
        !(o->asked = mwp__alloc(questions->total, sizeof *o->asked)))
        status = mwp__fail_memory(error);
    for (size_t i = begin; i < end && !status; i++) {
        if (!location_is_asked(o, i)) continue;
        o->asked[questions->next[o->at[i].rank]] = i;
        *(question *)mwp__parcels_add(questions, o->at[i].rank) = question_of(&o->at[i]);
    }
    free(count);
    return status;
}

/* Each answer begins with 8 bytes for the number of its question. */
enum { NUMBER = 8 };

static mw_status owners_answer(void *self, const void *questions, size_t n, void *answers,
                               size_t *count, mwp_error *error)
{
    const owners *o = self;
    char *packed = mwp__alloc(n, o->bytes), *to = answers;
    mw_status status =
        packed ? questions_answer(o, questions, n, packed, error) : mwp__fail_memory(error);
    *count = status ? 0 : n;
    for (size_t i = 0; i < *count; i++, to += NUMBER + o->bytes) {
        const uint32_t head[2] = {(uint32_t)i, 0};
        memcpy(to, head, sizeof head);
        memcpy(to + NUMBER, packed + i * o->bytes, o->bytes);
    }
    free(packed);
    return status;
}

static void owners_take(void *self, int rank, size_t first, const void *answers, size_t n)
{
    const owners *o = self;
    const char *from = answers;
    (void)rank;
    for (size_t i = 0; i < n; i++, from += NUMBER + o->bytes) {
        uint32_t number;
        memcpy(&number, from, sizeof number);
        memcpy(o->results + o->asked[first + number] * o->bytes, from + NUMBER, o->bytes);
    }
}

static mw_status owners_settle(void *self, mwp_error *error)
{
    (void)self;
    (void)error;
    return MW_OK;
}

static mw_status locations_check(const mwp_mesh *mesh, const mwp_location *at, size_t n,
                                 mwp_error *error)
{
    if (n && !at) return mwp__fail(error, MW_ERROR_ARGUMENT, "the locations are NULL");
    for (size_t i = 0; i < n; i++)
        if (at[i].rank < -1 || at[i].rank >= mesh->wire.size)
            return mwp__fail(error, MW_ERROR_ARGUMENT,
                             "location %zu names rank %d; there are %d ranks", i, at[i].rank,
                             mesh->wire.size);
    return MW_OK;
}

mw_status mwp__ask_owners(mwp_mesh *mesh, mw_status status, const mwp_location *at, size_t n,
                          size_t bytes, mwp_owner_answer *answer, void *self, void *results,
                          mwp_error *error)
{
    const mwp_talk_about about = {sizeof(question), NUMBER + bytes, owners_load, owners_answer,
                                  owners_take,      owners_settle,  NULL};
    owners o = {.mesh = mesh,
                .at = at,
                .n = n,
                .bytes = bytes,
                .answer = answer,
                .self = self,
                .results = results};
    mwp_talk talk;
    if (!status) status = locations_check(mesh, at, n, error);
    mwp__talk_begin(&talk, &mesh->wire, &mesh->tables, &about, &o, BLOCK, status, error);
    status = mwp__talk_end(&talk, error);
    free(o.asked);
    return status;
}
