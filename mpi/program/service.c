/* service.c - orders from rank 0, and how each is carried out on all ranks. */
#include "mpi/program/service.h"
#include "mpi/program/sampled_values.h"

#include <stdlib.h>
#include <string.h>

typedef enum order_kind { ORDER_SCATTER, ORDER_LOCATE, ORDER_END } order_kind;

typedef struct order {
    int32_t kind, end;
    service_options options;
} order;

/* Collective: rank 0 tells the others. */
static mw_status order_share(const service *s, order *o, mwp_error *error)
{
    MPI_Request request;
    return mwp__wire_wait(MPI_Ibcast(o, sizeof *o, MPI_BYTE, 0, s->wire.comm, &request), &request,
                          error);
}

/* --- carried out on all ranks ----------------------------------------------------------------- */

static mw_status all_scatter(service *s, const mw_mesh_file *file, uint32_t threads,
                             mwp_error *error)
{
    const mwp_mesh_options options = {.threads = threads};
    return mwp_mesh_scatter(s->wire.comm, file, &options, &s->mesh, error);
}

/* The weights of vertices at the locations. */
static mw_status share_corners(const service *s, size_t n, service_answer *answers,
                               const mwp_location *at, mwp_error *error)
{
    uint64_t *first = mwp__alloc(n + 1, sizeof *first);
    int64_t *column = mwp__alloc(n, 3 * sizeof *column);
    double *weight = mwp__alloc(n, 3 * sizeof *weight);
    mw_status status = first && column && weight ? MW_OK : mwp__fail_memory(error);
    status = mwp__wire_agree(&s->wire, status, error);
    if (!status) status = mwp_operator(s->mesh, at, n, first, column, weight, error);
    for (size_t i = 0; i < n && !status; i++)
        for (uint64_t e = first[i], k = 0; k < 3; e++, k++) {
            answers[i].corner[k] = e < first[i + 1] ? column[e] : -1;
            answers[i].weight[k] = e < first[i + 1] ? weight[e] : 0;
        }
    free(first);
    free(column);
    free(weight);
    return status;
}

/* Locate the points of this rank. */
static mw_status share_locate(const service *s, const mwp_parcels *points,
                              const service_options *options, service_answer *answers,
                              mwp_error *error)
{
    const size_t n = points->total;
    const mwp_locate_options how = {.tolerance = options->tolerance, .threads = options->threads};
    mwp_location *at = mwp__alloc(n, sizeof *at);
    mw_status status = mwp__wire_agree(&s->wire, at ? MW_OK : mwp__fail_memory(error), error);
    if (!status) status = mwp_locate_batch(s->mesh, points->records, n, 2, &how, at, error);
    for (size_t i = 0; i < n && !status; i++)
        answers[i] = (service_answer){.at = at[i], .from = at[i].triangle};
    if (!status && options->more == SERVICE_CORNERS)
        status = share_corners(s, n, answers, at, error);
    else if (!status && (options->more == SERVICE_VALUES || options->outside))
        status = sampled_values(s, points->records, n, options, at, answers, error);
    free(at);
    return status;
}

/* Points for all ranks in equal shares, on rank 0; none on the others. */
static bool points_pack(const service *s, const double *points, size_t stride, size_t n,
                        mwp_parcels *out)
{
    const size_t ranks = (size_t)s->wire.size;
    uint32_t *count = calloc(ranks, sizeof *count);
    for (size_t r = 0; count && r < ranks; r++)
        count[r] = (uint32_t)(n * (r + 1) / ranks - n * r / ranks);
    const bool done = count && mwp__parcels_create(out, &s->wire, 2 * sizeof *points, count);
    double *to = out->records;
    for (size_t i = 0; done && i < n; i++)
        memcpy(to + 2 * i, points + i * stride, 2 * sizeof *points);
    free(count);
    return done;
}

/* The answers of this rank go to rank 0. */
static bool answers_pack(const service *s, size_t n, mwp_parcels *out)
{
    uint32_t *count = calloc((size_t)s->wire.size, sizeof *count);
    if (count) count[0] = (uint32_t)n;
    const bool done = count && mwp__parcels_create(out, &s->wire, sizeof(service_answer), count);
    free(count);
    return done;
}

static mw_status all_locate(service *s, const double *points, size_t stride, size_t n,
                            const service_options *options, service_answer *answers,
                            mwp_error *error)
{
    mwp_parcels out = {.record = 2 * sizeof *points}, share = {0}, back = {0}, told = {0};
    mw_status status = points_pack(s, points, stride, n, &out) ? MW_OK : mwp__fail_memory(error);
    status = mwp__wire_exchange(&s->wire, status, &out, &share, error);
    if (!status) {
        status = answers_pack(s, share.total, &back) ? MW_OK : mwp__fail_memory(error);
        status = mwp__wire_agree(&s->wire, status, error);
    }
    if (!status) status = share_locate(s, &share, options, back.records, error);
    if (!status) status = mwp__wire_exchange(&s->wire, MW_OK, &back, &told, error);
    if (!status && s->wire.rank == 0) mwp__copy(answers, told.records, n * sizeof *answers);
    mwp__parcels_release(&out);
    mwp__parcels_release(&share);
    mwp__parcels_release(&back);
    mwp__parcels_release(&told);
    return status;
}

/* --- the ends --------------------------------------------------------------------------------- */

mw_status service_open(service *s, mwp_error *error)
{
    *s = (service){0};
    return mwp__wire_open(&s->wire, MPI_COMM_WORLD, error);
}

void service_close(service *s)
{
    mwp_mesh_destroy(s->mesh);
    mwp__wire_close(&s->wire);
}

int service_run(service *s)
{
    order o = {0};
    mwp_error error;
    /* A failure is known to rank 0, too, which then orders the end. */
    while (o.kind != ORDER_END) {
        if (order_share(s, &o, &error)) return 1;
        if (o.kind == ORDER_SCATTER) all_scatter(s, NULL, o.options.threads, &error);
        if (o.kind == ORDER_LOCATE) all_locate(s, NULL, 2, 0, &o.options, NULL, &error);
    }
    return o.end;
}

mw_status service_scatter(service *s, const mw_mesh_file *file, uint32_t threads, mwp_error *error)
{
    order o = {.kind = ORDER_SCATTER, .options.threads = threads};
    mw_status status = order_share(s, &o, error);
    return status ? status : all_scatter(s, file, threads, error);
}

mw_status service_locate(service *s, const double *points, size_t stride, size_t n,
                         const service_options *options, service_answer *answers, mwp_error *error)
{
    order o = {.kind = ORDER_LOCATE, .options = *options};
    mw_status status = order_share(s, &o, error);
    return status ? status : all_locate(s, points, stride, n, options, answers, error);
}

void service_end(service *s, int end)
{
    mwp_error error;
    order o = {.kind = ORDER_END, .end = end};
    (void)order_share(s, &o, &error); /* if MPI fails, mpiexec ends the others */
}
