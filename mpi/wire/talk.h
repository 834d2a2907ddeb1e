/* talk.h - questions to other ranks and their answers, in rounds, without waiting. Private.
 *
 * A rank has its questions in blocks. In each round every rank tells every other how many questions
 * of its present block it has left for it; each grants as many as it takes at a time, its budget;
 * then the questions travel, are answered, and the answers travel back. So no rank ever has to hold
 * more than its budget of questions of others. A rank without questions takes part all the same. A
 * failure on one rank becomes known to all at the beginning of the next round, and ends the talk.
 */
#ifndef MWP_WIRE_TALK_H
#define MWP_WIRE_TALK_H

#include "mpi/wire/wire.h"

/* What the talk is about. `self` is the user's. Functions that return a status describe the failure
 * in `error`, which is never NULL.
 *   load    Make the questions of the next block, of `question` bytes each, as parcels, which are
 *           those of the block before; the talk releases them. *more: there is a block after this
 *           one.
 *   answer  Answer n questions of other ranks: write at most one answer for each, in order, each of
 *           which begins with the uint32_t number of its question, from 0. Returns how many there
 *           are through *count.
 *   take    n answers of a rank to questions of the present block. Each begins with the uint32_t
 *           number of its question, from the place `first` in the parcels on.
 *   settle  The block has all its answers.
 *   meanwhile  Do some work while messages are under way, or NULL. *more: there is more to do in
 *           this block. */
typedef struct mwp_talk_about {
    size_t question, answer_size;
    mw_status (*load)(void *self, mwp_parcels *questions, bool *more, mwp_error *error);
    mw_status (*answer)(void *self, const void *questions, size_t n, void *answers, size_t *count,
                        mwp_error *error);
    void (*take)(void *self, int rank, size_t first, const void *answers, size_t n);
    mw_status (*settle)(void *self, mwp_error *error);
    mw_status (*meanwhile)(void *self, bool *more, mwp_error *error);
} mwp_talk_about;

typedef enum mwp_talk_stage {
    MWP_TALK_OFFERS,
    MWP_TALK_GRANTS,
    MWP_TALK_QUESTIONS,
    MWP_TALK_COUNTS,
    MWP_TALK_ANSWERS,
    MWP_TALK_OVER
} mwp_talk_stage;

/* What a rank tells another at the beginning of a round. */
typedef struct mwp_offer {
    uint32_t questions;
    uint16_t active; /* it has questions for anyone, or more blocks */
    uint16_t failed;
} mwp_offer;

/* Numbers for and of each rank, made once for all talks. */
typedef struct mwp_tables {
    mwp_offer *offer, *offered;
    uint32_t *grant, *granted, *count, *counted;
    int *layout;  /* four of all ranks: counts and places, of what goes and what comes */
    size_t *next; /* per rank: its next question in the parcels */
} mwp_tables;

typedef struct mwp_talk {
    const mwp_wire *wire;
    const mwp_tables *tables;
    const mwp_talk_about *about;
    void *self;
    uint32_t budget;
    mwp_talk_stage stage;
    MPI_Request request;
    MPI_Datatype question, answer;   /* MPI_DATATYPE_NULL until they are made */
    mwp_parcels block;               /* the present block */
    bool more;                       /* there are further blocks */
    bool idle;                       /* nothing is left to do in this block while waiting */
    bool broken;                     /* MPI failed */
    void *asked, *to_send, *to_take; /* questions of others, answers to them, answers to ours */
    size_t asked_room, take_room;
    mw_status status; /* of this rank */
    mwp_error error;
} mwp_talk;

bool mwp__tables_create(mwp_tables *tables, const mwp_wire *wire);
void mwp__tables_release(mwp_tables *tables);

/* Begin. Not collective, but all ranks begin the same talks in the same order, one at a time.
 * `status` tells whether this rank has come so far; if not, `error` tells why. */
void mwp__talk_begin(mwp_talk *talk, const mwp_wire *wire, const mwp_tables *tables,
                     const mwp_talk_about *about, void *self, uint32_t budget, mw_status status,
                     const mwp_error *error);
/* Go on as far as possible without waiting. Is it over? */
bool mwp__talk_go(mwp_talk *talk);
/* Wait for the end; the same status and error on all ranks. */
mw_status mwp__talk_end(mwp_talk *talk, mwp_error *error);

#endif
