/* talk.c - rounds of questions and answers. */
#include "mpi/wire/talk.h"

#include <stdlib.h>
#include <string.h>

/* --- tables ----------------------------------------------------------------------------------- */

bool mwp__tables_create(mwp_tables *t, const mwp_wire *wire)
{
    const size_t n = (size_t)wire->size;
    *t = (mwp_tables){.offer = mwp__alloc(n, sizeof *t->offer),
                      .offered = mwp__alloc(n, sizeof *t->offered),
                      .grant = mwp__alloc(n, sizeof *t->grant),
                      .granted = mwp__alloc(n, sizeof *t->granted),
                      .count = mwp__alloc(n, sizeof *t->count),
                      .counted = mwp__alloc(n, sizeof *t->counted),
                      .layout = mwp__alloc(4 * n, sizeof *t->layout),
                      .next = mwp__alloc(n, sizeof *t->next)};
    return t->offer && t->offered && t->grant && t->granted && t->count && t->counted &&
           t->layout && t->next;
}

void mwp__tables_release(mwp_tables *t)
{
    free(t->offer);
    free(t->offered);
    free(t->grant);
    free(t->granted);
    free(t->count);
    free(t->counted);
    free(t->layout);
    free(t->next);
    *t = (mwp_tables){0};
}

/* --- failures --------------------------------------------------------------------------------- */

/* Note a failure of this rank; the first one counts. */
static void talk_fail(mwp_talk *t, mw_status status, const mwp_error *error)
{
    if (t->status) return;
    t->status = status;
    t->error = *error;
}

static void talk_fail_memory(mwp_talk *t)
{
    mwp_error error;
    talk_fail(t, mwp__fail_memory(&error), &error);
}

/* MPI failed: nothing more can be said to others. */
static void talk_break(mwp_talk *t, int code)
{
    mwp_error error;
    if (code == MPI_SUCCESS) return;
    t->broken = true;
    t->stage = MWP_TALK_OVER;
    talk_fail(t, mwp__fail_mpi(&error, code), &error);
}

static uint32_t counts_sum(const uint32_t *count, int ranks)
{
    uint32_t sum = 0;
    for (int r = 0; r < ranks; r++) sum += count[r];
    return sum;
}

/* --- a block ---------------------------------------------------------------------------------- */

/* Questions of the block that were not asked yet. */
static size_t block_left(const mwp_talk *t)
{
    size_t left = t->block.total;
    for (int r = 0; r < t->wire->size; r++) left -= t->tables->next[r];
    return left;
}

static void block_load(mwp_talk *t)
{
    mwp_error error;
    memset(t->tables->next, 0, (size_t)t->wire->size * sizeof *t->tables->next);
    t->more = false;
    t->idle = !t->about->meanwhile;
    mw_status status = t->about->load(t->self, &t->block, &t->more, &error);
    if (status) talk_fail(t, status, &error);
}

/* Settle blocks that have all their answers, and load the next one that has questions. */
static void block_advance(mwp_talk *t)
{
    mwp_error error;
    while (!t->status && block_left(t) == 0) {
        mw_status status = t->about->settle(t->self, &error);
        if (status) talk_fail(t, status, &error);
        if (status || !t->more) break;
        block_load(t);
    }
}

/* --- the stages of a round -------------------------------------------------------------------- */

static void offers_begin(mwp_talk *t)
{
    const mwp_tables *b = t->tables;
    const bool active = !t->status && block_left(t) > 0;
    for (int r = 0; r < t->wire->size; r++)
        b->offer[r] =
            (mwp_offer){.questions = active ? (uint32_t)(t->block.count[r] - b->next[r]) : 0,
                        .active = active,
                        .failed = t->status != MW_OK};
    t->stage = MWP_TALK_OFFERS;
    talk_break(t, MPI_Ialltoall(b->offer, sizeof *b->offer, MPI_BYTE, b->offered,
                                sizeof *b->offered, MPI_BYTE, t->wire->comm, &t->request));
}

/* As many questions of each rank as fit in the budget, in equal shares where they do not; at least
 * one of each. */
static void grants_share(mwp_talk *t)
{
    const mwp_tables *b = t->tables;
    const int ranks = t->wire->size;
    uint64_t left = t->budget;
    uint32_t asking = 0;
    for (int r = 0; r < ranks; r++) {
        b->grant[r] = 0;
        asking += b->offered[r].questions > 0;
    }
    while (asking > 0) {
        const uint64_t share = left / asking > 0 ? left / asking : 1;
        asking = 0;
        for (int r = 0; r < ranks; r++) {
            const uint32_t wanted = b->offered[r].questions - b->grant[r];
            const uint32_t more = wanted < share ? wanted : (uint32_t)share;
            if (more == 0 || (left == 0 && b->grant[r] > 0)) continue;
            b->grant[r] += more;
            left -= more < left ? more : left;
            asking += b->grant[r] < b->offered[r].questions;
        }
        if (left == 0) break;
    }
}

/* Room for granted questions and the answers to them. Without it nothing is granted. */
static void grants_make_room(mwp_talk *t)
{
    const size_t n = counts_sum(t->tables->grant, t->wire->size);
    if (n > t->asked_room) {
        free(t->asked);
        free(t->to_send);
        t->asked_room = n;
        t->asked = mwp__alloc(n, t->about->question);
        t->to_send = mwp__alloc(n, t->about->answer_size);
        if (t->asked && t->to_send) return;
        t->asked_room = 0;
        memset(t->tables->grant, 0, (size_t)t->wire->size * sizeof *t->tables->grant);
        talk_fail_memory(t);
    }
}

static void offers_end(mwp_talk *t)
{
    const mwp_tables *b = t->tables;
    bool active = false, failed = false;
    for (int r = 0; r < t->wire->size; r++) {
        active = active || b->offered[r].active;
        failed = failed || b->offered[r].failed;
    }
    if (failed || !active) {
        t->stage = MWP_TALK_OVER;
        if (failed && !t->status) t->status = MW_CANCELLED; /* another rank tells why */
        return;
    }
    grants_share(t);
    grants_make_room(t);
    t->stage = MWP_TALK_GRANTS;
    talk_break(t, MPI_Ialltoall(b->grant, 1, MPI_UINT32_T, b->granted, 1, MPI_UINT32_T,
                                t->wire->comm, &t->request));
}

/* Counts and places for MPI: of what goes, then of what comes. What goes stands packed. */
static void layout_write(const mwp_talk *t, const uint32_t *goes, const uint32_t *comes)
{
    const int ranks = t->wire->size;
    int *layout = t->tables->layout, from = 0, to = 0;
    for (int r = 0; r < ranks; r++) {
        layout[r] = (int)goes[r];
        layout[ranks + r] = from;
        layout[2 * ranks + r] = (int)comes[r];
        layout[3 * ranks + r] = to;
        from += layout[r];
        to += layout[2 * ranks + r];
    }
}

/* The next questions go from where they stand in the block. */
static void layout_place_questions(const mwp_talk *t)
{
    size_t first = 0; /* of the block, for rank r */
    for (int r = 0; r < t->wire->size && t->block.count; r++) {
        t->tables->layout[t->wire->size + r] = (int)(first + t->tables->next[r]);
        first += t->block.count[r];
    }
}

static int records_begin(mwp_talk *t, const void *goes, void *comes, MPI_Datatype type)
{
    const int ranks = t->wire->size, *layout = t->tables->layout;
    return MPI_Ialltoallv(goes, layout, layout + ranks, type, comes, layout + 2 * (size_t)ranks,
                          layout + 3 * (size_t)ranks, type, t->wire->comm, &t->request);
}

/* Send the questions that were granted. The room for their answers was made with the block. */
static void grants_end(mwp_talk *t)
{
    const mwp_tables *b = t->tables;
    layout_write(t, b->granted, b->grant);
    layout_place_questions(t);
    t->stage = MWP_TALK_QUESTIONS;
    talk_break(t, records_begin(t, t->block.records, t->asked, t->question));
}

/* Answers are numbered by all questions; sent, by those of their rank. */
static void answers_number(mwp_talk *t, size_t count)
{
    const mwp_tables *b = t->tables;
    char *answer = t->to_send;
    uint32_t begin = 0, end = b->grant[0];
    int r = 0;
    memset(b->count, 0, (size_t)t->wire->size * sizeof *b->count);
    for (size_t i = 0; i < count; i++, answer += t->about->answer_size) {
        uint32_t number;
        memcpy(&number, answer, sizeof number);
        while (number >= end) {
            begin = end;
            end += b->grant[++r];
        }
        number -= begin;
        memcpy(answer, &number, sizeof number);
        b->count[r]++;
    }
}

static void questions_end(mwp_talk *t)
{
    mwp_error error;
    const mwp_tables *b = t->tables;
    size_t count = 0;
    const uint32_t n = counts_sum(b->grant, t->wire->size);
    mw_status status =
        n ? t->about->answer(t->self, t->asked, n, t->to_send, &count, &error) : MW_OK;
    if (status) {
        talk_fail(t, status, &error);
        count = 0;
    }
    answers_number(t, count);
    t->stage = MWP_TALK_COUNTS;
    talk_break(t, MPI_Ialltoall(b->count, 1, MPI_UINT32_T, b->counted, 1, MPI_UINT32_T,
                                t->wire->comm, &t->request));
}

static void counts_end(mwp_talk *t)
{
    layout_write(t, t->tables->count, t->tables->counted);
    t->stage = MWP_TALK_ANSWERS;
    talk_break(t, records_begin(t, t->to_send, t->to_take, t->answer));
}

static void answers_end(mwp_talk *t)
{
    const mwp_tables *b = t->tables;
    const char *answer = t->to_take;
    size_t first = 0; /* the place of the first question for rank r */
    for (int r = 0; r < t->wire->size; r++) {
        if (b->counted[r] > 0) {
            t->about->take(t->self, r, first + b->next[r], answer, b->counted[r]);
            answer += b->counted[r] * t->about->answer_size;
        }
        b->next[r] += b->granted[r];
        if (t->block.count) first += t->block.count[r];
    }
}

/* --- the talk --------------------------------------------------------------------------------- */

/* Room for the answers to the questions of a round. */
static void talk_make_room(mwp_talk *t)
{
    const size_t n = t->block.total;
    if (t->status || n <= t->take_room) return;
    free(t->to_take);
    t->take_room = n;
    t->to_take = mwp__alloc(n, t->about->answer_size);
    if (!t->to_take) talk_fail_memory(t);
}

static void round_begin(mwp_talk *t)
{
    block_advance(t);
    talk_make_room(t);
    offers_begin(t);
}

static void talk_make_types(mwp_talk *t)
{
    t->question = t->answer = MPI_DATATYPE_NULL;
    int code = MPI_Type_contiguous((int)t->about->question, MPI_BYTE, &t->question);
    if (code == MPI_SUCCESS) code = MPI_Type_commit(&t->question);
    if (code == MPI_SUCCESS)
        code = MPI_Type_contiguous((int)t->about->answer_size, MPI_BYTE, &t->answer);
    if (code == MPI_SUCCESS) code = MPI_Type_commit(&t->answer);
    talk_break(t, code);
}

void mwp__talk_begin(mwp_talk *talk, const mwp_wire *wire, const mwp_tables *tables,
                     const mwp_talk_about *about, void *self, uint32_t budget, mw_status status,
                     const mwp_error *error)
{
    *talk =
        (mwp_talk){.wire = wire, .tables = tables, .about = about, .self = self, .budget = budget};
    if (status) talk_fail(talk, status, error);
    memset(tables->next, 0, (size_t)wire->size * sizeof *tables->next);
    talk_make_types(talk);
    if (talk->broken) return;
    if (!talk->status) block_load(talk);
    round_begin(talk);
}

/* What follows the message that has just come. */
static void talk_follow(mwp_talk *t)
{
    switch (t->stage) {
    case MWP_TALK_OFFERS: offers_end(t); break;
    case MWP_TALK_GRANTS: grants_end(t); break;
    case MWP_TALK_QUESTIONS: questions_end(t); break;
    case MWP_TALK_COUNTS: counts_end(t); break;
    case MWP_TALK_ANSWERS:
        answers_end(t);
        round_begin(t);
        break;
    case MWP_TALK_OVER: break;
    }
}

bool mwp__talk_go(mwp_talk *talk)
{
    while (talk->stage != MWP_TALK_OVER) {
        int over = 0;
        talk_break(talk, MPI_Test(&talk->request, &over, MPI_STATUS_IGNORE));
        if (!over && !talk->broken) return false;
        if (!talk->broken) talk_follow(talk);
    }
    return true;
}

/* Work while a message is under way. Returns false if there is none. */
static bool talk_work(mwp_talk *t)
{
    mwp_error error;
    bool more = false;
    if (t->idle || t->status) return false;
    mw_status status = t->about->meanwhile(t->self, &more, &error);
    if (status) talk_fail(t, status, &error);
    t->idle = !more;
    return true;
}

mw_status mwp__talk_end(mwp_talk *talk, mwp_error *error)
{
    for (uint32_t rounds = 0; !mwp__talk_go(talk);)
        if (!talk_work(talk)) mwp__wire_rest(rounds++);
    mwp__parcels_release(&talk->block);
    free(talk->asked);
    free(talk->to_send);
    free(talk->to_take);
    if (talk->question != MPI_DATATYPE_NULL) MPI_Type_free(&talk->question);
    if (talk->answer != MPI_DATATYPE_NULL) MPI_Type_free(&talk->answer);
    *error = talk->error;
    if (talk->broken || !talk->status) return talk->status;
    return mwp__wire_agree(talk->wire, talk->status == MW_CANCELLED ? MW_OK : talk->status, error);
}
