/* wire.h - what ranks say to one another: collective calls that leave the processor to others while
 * they wait, and errors that all ranks learn of. Private.
 *
 * Every function here is collective, unless it says otherwise. They return the same status on all
 * ranks, except where MPI itself fails. */
#ifndef MWP_WIRE_WIRE_H
#define MWP_WIRE_WIRE_H

#include <meshwalk-mpi/meshwalk-mpi.h>

#include <stdbool.h>
#include <string.h>

typedef struct mwp_wire {
    MPI_Comm comm; /* of its own */
    int rank, size;
} mwp_wire;

/* --- not collective --------------------------------------------------------------------------- */

/* Arrays as mw__alloc of the library: NULL on failure or overflow; 0 gives a valid pointer. */
void *mwp__alloc(size_t count, size_t size);

/* memcpy, where nothing may be copied from or to NULL. */
static inline void mwp__copy(void *to, const void *from, size_t bytes)
{
    if (bytes > 0) memcpy(to, from, bytes);
}

/* Fill in an error (NULL allowed) and return its status. */
mw_status mwp__fail(mwp_error *error, mw_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
mw_status mwp__fail_memory(mwp_error *error);
/* As mwp__fail with MW_ERROR_INPUT, naming a triangle and a vertex (-1: none). */
mw_status mwp__fail_at(mwp_error *error, int64_t triangle, int64_t vertex, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* The error of the library's. */
mw_status mwp__fail_as(mwp_error *error, const mw_error *from);
/* MW_OK for MPI_SUCCESS, else MW_ERROR_SYSTEM with the words of MPI. */
mw_status mwp__fail_mpi(mwp_error *error, int code);

/* Is the request over? Fails only if MPI does. */
mw_status mwp__wire_test(MPI_Request *request, bool *over, mwp_error *error);
/* Leave the processor to others, for longer after many rounds of a wait. */
void mwp__wire_rest(uint32_t rounds);
/* Wait for the end of a request that a call of MPI made, which returned `code`. */
mw_status mwp__wire_wait(int code, MPI_Request *request, mwp_error *error);

/* --- collective ------------------------------------------------------------------------------- */

mw_status mwp__wire_open(mwp_wire *wire, MPI_Comm comm, mwp_error *error);
void mwp__wire_close(mwp_wire *wire);

/* If the status of any rank is not MW_OK, all ranks get the status and the error of the first such
 * rank. `error` is not NULL. */
mw_status mwp__wire_agree(const mwp_wire *wire, mw_status status, mwp_error *error);

/* The same, and refuse a number that is not equal on all ranks. `what` is it? */
mw_status mwp__wire_same(const mwp_wire *wire, mw_status status, int64_t number, const char *what,
                         mwp_error *error);

/* Replace a number by its sum over all ranks. */
mw_status mwp__wire_sum(const mwp_wire *wire, int64_t *number, mwp_error *error);

/* Records for every rank, those for one rank after another, and as they arrive from every rank. */
typedef struct mwp_parcels {
    size_t record;   /* bytes of a record */
    uint32_t *count; /* records of each rank */
    size_t *next;    /* while they are made: where the next record of each rank goes */
    size_t total;
    size_t room; /* bytes of `records` */
    void *records;
} mwp_parcels;

/* Make room for records, `count[r]` for rank r, which is copied. `parcels` is all zero, or has been
 * created before: then its memory is used again. */
bool mwp__parcels_create(mwp_parcels *parcels, const mwp_wire *wire, size_t record,
                         const uint32_t *count);
void mwp__parcels_release(mwp_parcels *parcels);

/* The place of one more record for a rank, to be filled in. */
static inline void *mwp__parcels_add(mwp_parcels *parcels, int rank)
{
    return (char *)parcels->records + parcels->record * parcels->next[rank]++;
}

/* Send records, and receive those that are meant for this rank. `status` tells whether this rank
 * has come so far; if not, no rank receives anything. Release `in` in either case. */
mw_status mwp__wire_exchange(const mwp_wire *wire, mw_status status, const mwp_parcels *out,
                             mwp_parcels *in, mwp_error *error);

/* Each rank gets the records of all ranks. */
mw_status mwp__wire_gather(const mwp_wire *wire, mw_status status, const void *records,
                           size_t count, size_t record, mwp_parcels *in, mwp_error *error);

#endif
