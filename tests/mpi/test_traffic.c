/* test_traffic.c - what goes over the wire: bytes for each query each way, and how much a rank
 * takes at a time. MPI_Ialltoallv is that of this file, which counts and hands on. */
#include "mpi_both.h"

enum { QUERIES = 4000, QUESTION = 16, ANSWER = 48 };

/* Of what this rank exchanges with others: bytes by the size of records, and the most questions in
 * one call that it gets. */
static struct {
    int64_t sent[64];
    int64_t most_questions;
} traffic;

int MPI_Ialltoallv(const void *out, const int out_count[], const int out_place[],
                   MPI_Datatype out_type, void *in, const int in_count[], const int in_place[],
                   MPI_Datatype in_type, MPI_Comm comm, MPI_Request *request)
{
    int size, ranks, rank;
    int64_t taken = 0;
    MPI_Type_size(out_type, &size);
    MPI_Comm_size(comm, &ranks);
    MPI_Comm_rank(comm, &rank);
    for (int r = 0; r < ranks; r++) {
        if (r == rank) continue;
        traffic.sent[size < 64 ? size : 63] += (int64_t)out_count[r] * size;
        taken += in_count[r];
    }
    if (size == QUESTION && taken > traffic.most_questions) traffic.most_questions = taken;
    return PMPI_Ialltoallv(out, out_count, out_place, out_type, in, in_count, in_place, in_type,
                           comm, request);
}

/* A square in stripes. */
static both stripes(void)
{
    both b;
    uint64_t random = 3;
    mpi_check(both_make(&b, arrays_grid(60, 0.3, &random), "square", 0, 3), "refused");
    memset(&traffic, 0, sizeof traffic);
    return b;
}

/* Points in the square, and around it; `width`: of the part where they are. */
static double *points_make(size_t n, double width)
{
    uint64_t random = (uint64_t)mpi_rank() + 5;
    double *points = malloc(2 * n * sizeof *points);
    for (size_t i = 0; i < n; i++) {
        points[2 * i] = random_unit(&random) * width;
        points[2 * i + 1] = random_unit(&random) * 62 - 1;
    }
    return points;
}

static void locate(const both *b, const double *points, size_t n, uint32_t budget)
{
    mwp_error error;
    mwp_location *at = calloc(n, sizeof *at);
    const mwp_locate_options options = {.budget = budget};
    mpi_check(mwp_locate_batch(b->pieces, points, n, 2, &options, at, &error) == MW_OK, "%s",
              error.message);
    for (size_t i = 0; i < n; i += 7) {
        mw_cursor cursor = {0};
        const mw_location want = mw_locate(b->locator, &cursor, points[2 * i], points[2 * i + 1]);
        mpi_check(at[i].where == want.where &&
                      at[i].triangle == (want.triangle == MW_NONE ? -1 : mpi_number(want.triangle)),
                  "point %zu", i);
    }
    free(at);
}

/* At most 60 bytes a query each way, wherever the points lie. */
static void test_bytes(void)
{
    both b = stripes();
    int64_t mine[2], all[2];
    double *points = points_make(QUERIES, 60);
    locate(&b, points, QUERIES, 0);
    mine[0] = traffic.sent[QUESTION];
    mine[1] = traffic.sent[ANSWER];
    MPI_Allreduce(mine, all, 2, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    const double n = (double)QUERIES * mpi_ranks();
    mpi_check((double)all[0] <= 60 * n && (double)all[1] <= 60 * n, "%g and %g bytes a query",
              (double)all[0] / n, (double)all[1] / n);
    mpi_check(mpi_ranks() == 1 || (all[0] > 0 && all[1] > 0), "nothing was counted");
    if (mpi_rank() == 0)
        printf("%d ranks: %.1f bytes a query there, %.1f back\n", mpi_ranks(), (double)all[0] / n,
               (double)all[1] / n);
    free(points);
    both_release(&b);
}

/* Points strictly inside the pieces of their ranks are not sent. */
static void test_own(void)
{
    both b = stripes();
    size_t n = 0;
    double *points = points_make(b.own.part.triangle_count + 1, 60);
    for (uint32_t t = 0; t < b.own.part.triangle_count; t++, n++)
        for (size_t k = 0; k < 2; k++) {
            const uint32_t *v = b.own.part.triangles + 3 * (size_t)t;
            const double *p = b.own.part.points + k;
            points[2 * n + k] = (p[2 * v[0]] + p[2 * v[1]] + p[2 * v[2]]) / 3;
        }
    locate(&b, points, n, 0);
    mpi_check(traffic.sent[QUESTION] == 0, "%lld bytes", (long long)traffic.sent[QUESTION]);
    free(points);
    both_release(&b);
}

/* All ask for the piece of rank 0, which takes no more than its budget at a time. */
static void test_budget(void)
{
    enum { BUDGET = 500 };
    both b = stripes();
    double *points = points_make(QUERIES, 60.0 / mpi_ranks() - 1);
    locate(&b, points, QUERIES, BUDGET);
    mpi_check(traffic.most_questions <= BUDGET, "%lld questions at a time",
              (long long)traffic.most_questions);
    mpi_check(mpi_ranks() == 1 || mpi_rank() > 0 || traffic.most_questions > BUDGET / 2,
              "%lld questions at a time", (long long)traffic.most_questions);
    free(points);
    both_release(&b);
}

int main(int count, char **arguments)
{
    MPI_Init(&count, &arguments);
    test_bytes();
    test_own();
    test_budget();
    MPI_Finalize();
    return 0;
}
