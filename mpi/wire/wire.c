/* wire.c - collective calls. Each is begun without waiting and then tested: while they wait, the
 * ranks of a machine with fewer processors leave them to one another. Calls of MPI that wait by
 * themselves may keep a processor busy, and an exchange of seven ranks on two processors then takes
 * 45 ms instead of 2. */
#include "mpi/wire/wire.h"

#include <limits.h>
#include <sched.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* --- memory and errors ------------------------------------------------------------------------ */

void *mwp__alloc(size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes)) return NULL;
    return malloc(bytes ? bytes : 1);
}

static void error_write(mwp_error *error, mw_status status, const char *format, va_list arguments)
{
    *error = (mwp_error){.status = status, .rank = -1, .triangle = -1, .vertex = -1};
    vsnprintf(error->message, sizeof error->message, format, arguments);
}

mw_status mwp__fail(mwp_error *error, mw_status status, const char *format, ...)
{
    va_list arguments;
    if (!error) return status;
    va_start(arguments, format);
    error_write(error, status, format, arguments);
    va_end(arguments);
    return status;
}

mw_status mwp__fail_memory(mwp_error *error)
{
    return mwp__fail(error, MW_ERROR_MEMORY, "out of memory");
}

mw_status mwp__fail_at(mwp_error *error, int64_t triangle, int64_t vertex, const char *format, ...)
{
    va_list arguments;
    if (!error) return MW_ERROR_INPUT;
    va_start(arguments, format);
    error_write(error, MW_ERROR_INPUT, format, arguments);
    va_end(arguments);
    error->triangle = triangle;
    error->vertex = vertex;
    return MW_ERROR_INPUT;
}

mw_status mwp__fail_as(mwp_error *error, const mw_error *from)
{
    return mwp__fail(error, from->status, "%s", from->message);
}

mw_status mwp__fail_mpi(mwp_error *error, int code)
{
    char text[MPI_MAX_ERROR_STRING];
    int length = 0;
    if (code == MPI_SUCCESS) return MW_OK;
    if (MPI_Error_string(code, text, &length) != MPI_SUCCESS) length = 0;
    return mwp__fail(error, MW_ERROR_SYSTEM, "MPI: %.*s", length, text);
}

/* --- waiting ---------------------------------------------------------------------------------- */

mw_status mwp__wire_test(MPI_Request *request, bool *over, mwp_error *error)
{
    int flag = 0;
    const int code = MPI_Test(request, &flag, MPI_STATUS_IGNORE);
    *over = flag;
    return mwp__fail_mpi(error, code);
}

void mwp__wire_rest(uint32_t rounds)
{
    enum { SPINS = 64, NANOSECONDS = 20000 };
    if (rounds < SPINS)
        sched_yield();
    else
        nanosleep(&(struct timespec){.tv_nsec = NANOSECONDS}, NULL);
}

mw_status mwp__wire_wait(int code, MPI_Request *request, mwp_error *error)
{
    bool over = false;
    mw_status status = mwp__fail_mpi(error, code);
    for (uint32_t rounds = 0; !status; rounds++) {
        status = mwp__wire_test(request, &over, error);
        if (status || over) break;
        mwp__wire_rest(rounds);
    }
    return status;
}

/* --- collective calls ------------------------------------------------------------------------- */

mw_status mwp__wire_open(mwp_wire *wire, MPI_Comm comm, mwp_error *error)
{
    MPI_Request request;
    MPI_Comm own;
    *wire = (mwp_wire){.comm = MPI_COMM_NULL};
    mw_status status = mwp__wire_wait(MPI_Comm_idup(comm, &own, &request), &request, error);
    if (status) return status;
    wire->comm = own;
    status = mwp__fail_mpi(error, MPI_Comm_set_errhandler(own, MPI_ERRORS_RETURN));
    if (!status) status = mwp__fail_mpi(error, MPI_Comm_rank(own, &wire->rank));
    return status ? status : mwp__fail_mpi(error, MPI_Comm_size(own, &wire->size));
}

void mwp__wire_close(mwp_wire *wire)
{
    if (wire->comm != MPI_COMM_NULL) MPI_Comm_free(&wire->comm);
}

mw_status mwp__wire_agree(const mwp_wire *wire, mw_status status, mwp_error *error)
{
    MPI_Request request;
    const int mine = status ? wire->rank : wire->size;
    int first = wire->size;
    mwp_error broken;
    mw_status told =
        mwp__wire_wait(MPI_Iallreduce(&mine, &first, 1, MPI_INT, MPI_MIN, wire->comm, &request),
                       &request, &broken);
    if (told) {
        *error = broken;
        return told;
    }
    if (first == wire->size) return MW_OK;
    if (first == wire->rank) error->rank = wire->rank;
    told = mwp__wire_wait(MPI_Ibcast(error, sizeof *error, MPI_BYTE, first, wire->comm, &request),
                          &request, &broken);
    if (told) *error = broken;
    return error->status;
}

mw_status mwp__wire_same(const mwp_wire *wire, mw_status status, int64_t number, const char *what,
                         mwp_error *error)
{
    MPI_Request request;
    const int64_t mine[2] = {number, -number};
    int64_t most[2] = {0, 0};
    status = mwp__wire_agree(wire, status, error);
    if (!status)
        status = mwp__wire_wait(
            MPI_Iallreduce(mine, most, 2, MPI_INT64_T, MPI_MAX, wire->comm, &request), &request,
            error);
    if (status || most[0] == -most[1]) return status;
    return mwp__wire_agree(
        wire, mwp__fail(error, MW_ERROR_ARGUMENT, "%s are not the same on all ranks", what), error);
}

mw_status mwp__wire_sum(const mwp_wire *wire, int64_t *number, mwp_error *error)
{
    MPI_Request request;
    const int64_t mine = *number;
    return mwp__wire_wait(
        MPI_Iallreduce(&mine, number, 1, MPI_INT64_T, MPI_SUM, wire->comm, &request), &request,
        error);
}

/* --- records ---------------------------------------------------------------------------------- */

static bool parcels_make_room(mwp_parcels *parcels, int ranks)
{
    parcels->total = 0;
    for (int r = 0; r < ranks; r++) parcels->total += parcels->count[r];
    if (parcels->records && parcels->total <= parcels->room / parcels->record) return true;
    free(parcels->records);
    parcels->records = mwp__alloc(parcels->total, parcels->record);
    parcels->room = parcels->records ? parcels->total * parcels->record : 0;
    return parcels->records;
}

bool mwp__parcels_create(mwp_parcels *parcels, const mwp_wire *wire, size_t record,
                         const uint32_t *count)
{
    const size_t ranks = (size_t)wire->size;
    size_t place = 0;
    parcels->record = record;
    if (!parcels->count) parcels->count = mwp__alloc(ranks, sizeof *count);
    if (!parcels->next) parcels->next = mwp__alloc(ranks, sizeof *parcels->next);
    if (!parcels->count || !parcels->next) return false;
    memcpy(parcels->count, count, ranks * sizeof *count);
    for (size_t r = 0; r < ranks; r++) {
        parcels->next[r] = place;
        place += count[r];
    }
    return parcels_make_room(parcels, wire->size);
}

void mwp__parcels_release(mwp_parcels *parcels)
{
    free(parcels->count);
    free(parcels->next);
    free(parcels->records);
    *parcels = (mwp_parcels){0};
}

/* Counts and places as MPI takes them: counts of all ranks, then places. */
static int *parcels_layout(const mwp_parcels *parcels, int ranks)
{
    int *layout = mwp__alloc(2 * (size_t)ranks, sizeof *layout), place = 0;
    for (int r = 0; layout && r < ranks; r++) {
        layout[r] = (int)parcels->count[r];
        layout[ranks + r] = place;
        place += layout[r];
    }
    return layout;
}

static mw_status parcels_check(const mwp_parcels *parcels, mwp_error *error)
{
    return parcels->total <= INT_MAX
               ? MW_OK
               : mwp__fail(error, MW_ERROR_LIMIT,
                           "a rank would exchange %zu records with others at a time; at most %d "
                           "are possible",
                           parcels->total, INT_MAX);
}

/* A record as a type of MPI, so that counts are those of records. */
static mw_status record_type(size_t record, MPI_Datatype *type, mwp_error *error)
{
    mw_status status = mwp__fail_mpi(error, MPI_Type_contiguous((int)record, MPI_BYTE, type));
    return status ? status : mwp__fail_mpi(error, MPI_Type_commit(type));
}

static mw_status parcels_send(const mwp_wire *wire, const mwp_parcels *out, mwp_parcels *in,
                              const int *from, const int *to, mwp_error *error)
{
    MPI_Datatype type;
    MPI_Request request;
    const int ranks = wire->size;
    mw_status status = record_type(out->record, &type, error);
    if (status) return status;
    status = mwp__wire_wait(MPI_Ialltoallv(out->records, from, from + ranks, type, in->records, to,
                                           to + ranks, type, wire->comm, &request),
                            &request, error);
    MPI_Type_free(&type);
    return status;
}

mw_status mwp__wire_exchange(const mwp_wire *wire, mw_status status, const mwp_parcels *out,
                             mwp_parcels *in, mwp_error *error)
{
    MPI_Request request;
    const size_t ranks = (size_t)wire->size;
    int *from = NULL, *to = NULL;
    *in = (mwp_parcels){.record = out->record};
    if (!status) in->count = mwp__alloc(ranks, sizeof *in->count);
    if (!status && !in->count) status = mwp__fail_memory(error);
    if (!status) status = parcels_check(out, error);
    status = mwp__wire_agree(wire, status, error);
    if (status) return status;
    status = mwp__wire_wait(MPI_Ialltoall(out->count, 1, MPI_UINT32_T, in->count, 1, MPI_UINT32_T,
                                          wire->comm, &request),
                            &request, error);
    if (status) return status;
    if (!parcels_make_room(in, wire->size)) status = mwp__fail_memory(error);
    if (!status) status = parcels_check(in, error);
    if (!status) {
        from = parcels_layout(out, wire->size);
        to = parcels_layout(in, wire->size);
        if (!from || !to) status = mwp__fail_memory(error);
    }
    status = mwp__wire_agree(wire, status, error);
    if (!status) status = parcels_send(wire, out, in, from, to, error);
    free(from);
    free(to);
    return status;
}

mw_status mwp__wire_gather(const mwp_wire *wire, mw_status status, const void *records,
                           size_t count, size_t record, mwp_parcels *in, mwp_error *error)
{
    MPI_Request request;
    MPI_Datatype type;
    const size_t ranks = (size_t)wire->size;
    const uint32_t mine = (uint32_t)count;
    *in = (mwp_parcels){.record = record};
    if (!status) in->count = mwp__alloc(ranks, sizeof *in->count);
    if (!status && !in->count) status = mwp__fail_memory(error);
    if (!status && count > INT_MAX)
        status = mwp__fail(error, MW_ERROR_LIMIT,
                           "there are %zu records for all ranks; at most %d are possible", count,
                           INT_MAX);
    status = mwp__wire_agree(wire, status, error);
    if (status) return status;
    status = mwp__wire_wait(
        MPI_Iallgather(&mine, 1, MPI_UINT32_T, in->count, 1, MPI_UINT32_T, wire->comm, &request),
        &request, error);
    if (status) return status;
    int *to = NULL;
    if (!parcels_make_room(in, wire->size)) status = mwp__fail_memory(error);
    if (!status) status = parcels_check(in, error);
    if (!status && !(to = parcels_layout(in, wire->size))) status = mwp__fail_memory(error);
    status = mwp__wire_agree(wire, status, error);
    if (!status) status = record_type(record, &type, error);
    if (!status) {
        status = mwp__wire_wait(MPI_Iallgatherv(records, (int)count, type, in->records, to,
                                                to + ranks, type, wire->comm, &request),
                                &request, error);
        MPI_Type_free(&type);
    }
    free(to);
    return status;
}
