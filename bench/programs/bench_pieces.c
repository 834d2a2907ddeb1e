/* bench_pieces - how long libmeshwalk-mpi takes to locate points, for `mpiexec -n RANKS`. A grid
 * with moved vertices is cut along a Hilbert curve; all ranks together have QUERIES points.
 *
 *   mpiexec -n 2 bench_pieces [QUERIES [VERTICES [ROUNDS]]]
 *
 * Points lie anywhere in the mesh, then in each rank's own piece. Of ROUNDS rounds it prints the
 * least time of the slowest rank, and the processor time of all ranks in that round. */
#include <meshwalk-mpi/meshwalk-mpi.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void stop(const char *what)
{
    fprintf(stderr, "bench_pieces: %s\n", what);
    MPI_Abort(MPI_COMM_WORLD, 1);
}

static double random_unit(uint64_t *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-53;
}

/* --- the mesh --------------------------------------------------------------------------------- */

/* A square of side * side cells of two triangles, whose inner vertices are moved a little. */
static void grid_make(mw_mesh_file *file, size_t side)
{
    uint64_t random = 1;
    const size_t row = side + 1;
    *file = (mw_mesh_file){.point_count = row * row, .triangle_count = 2 * side * side};
    file->points = malloc(3 * file->point_count * sizeof *file->points);
    file->triangles = malloc(3 * file->triangle_count * sizeof *file->triangles);
    if (!file->points || !file->triangles) stop("out of memory");
    for (size_t v = 0; v < row * row; v++) {
        const size_t at[2] = {v % row, v / row};
        for (size_t k = 0; k < 2; k++) {
            const double off = 0.4 * random_unit(&random) - 0.2;
            const bool inner = at[k] > 0 && at[k] < side;
            file->points[3 * v + k] = ((double)at[k] + (inner ? off : 0)) / (double)side;
        }
        file->points[3 * v + 2] = 0;
    }
    for (size_t cell = 0; cell < side * side; cell++) {
        const uint32_t v = (uint32_t)(cell / side * row + cell % side), up = v + (uint32_t)row;
        const uint32_t corner[6] = {v, v + 1, up + 1, v, up + 1, up};
        memcpy(file->triangles + 6 * cell, corner, sizeof corner);
    }
}

static mwp_mesh *mesh_make(int rank, size_t vertices)
{
    mwp_mesh *mesh;
    mwp_error error;
    mw_mesh_file file = {0};
    if (rank == 0) grid_make(&file, (size_t)sqrt((double)vertices) - 1);
    if (mwp_mesh_scatter(MPI_COMM_WORLD, &file, NULL, &mesh, &error)) stop(error.message);
    free(file.points);
    free(file.triangles);
    return mesh;
}

/* --- points ----------------------------------------------------------------------------------- */

static void points_anywhere(double *points, size_t n, int rank)
{
    uint64_t random = (uint64_t)rank + 7;
    for (size_t i = 0; i < 2 * n; i++) points[i] = random_unit(&random);
}

/* Inside triangles of the piece, drawn at random. */
static void points_own(double *points, size_t n, int rank, const mwp_mesh *mesh)
{
    mwp_piece piece;
    uint64_t random = (uint64_t)rank + 7;
    mwp_mesh_piece(mesh, &piece);
    const mw_arrays *a = &piece.arrays;
    for (size_t i = 0; i < n; i++) {
        const size_t t = (size_t)(random_unit(&random) * (double)a->triangle_count);
        const uint32_t *corner = (const uint32_t *)a->triangles + 3 * t;
        for (size_t k = 0; k < 2; k++)
            points[2 * i + k] =
                (a->points[2 * (size_t)corner[0] + k] + a->points[2 * (size_t)corner[1] + k] +
                 a->points[2 * (size_t)corner[2] + k]) /
                3;
    }
}

/* --- rounds ----------------------------------------------------------------------------------- */

static double rank_processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void rounds_run(mwp_mesh *mesh, const double *points, size_t n, int rounds, mwp_location *at,
                       const char *what)
{
    int rank, ranks;
    double best = INFINITY, processor = 0;
    mwp_error error;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    for (int round = 0; round < rounds; round++) {
        MPI_Barrier(MPI_COMM_WORLD);
        double wall = -MPI_Wtime(), used = -rank_processor_seconds(), slowest, all;
        if (mwp_locate_batch(mesh, points, n, 2, NULL, at, &error)) stop(error.message);
        wall += MPI_Wtime();
        used += rank_processor_seconds();
        MPI_Allreduce(&wall, &slowest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        MPI_Allreduce(&used, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        if (slowest >= best) continue;
        best = slowest;
        processor = all;
    }
    for (size_t i = 0; i < n; i++)
        if (at[i].triangle < 0) stop("a point of the mesh has no triangle");
    if (rank == 0)
        printf("%s: %d ranks, %.3f s, processors %.3f s\n", what, ranks, best, processor);
}

static size_t argument(int count, char **arguments, int i, double otherwise)
{
    return (size_t)(i < count ? strtod(arguments[i], NULL) : otherwise);
}

int main(int count, char **arguments)
{
    int rank, ranks;
    MPI_Init(&count, &arguments);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const size_t n = argument(count, arguments, 1, 1e7) / (size_t)ranks;
    const int rounds = (int)argument(count, arguments, 3, 5);
    mwp_mesh *mesh = mesh_make(rank, argument(count, arguments, 2, 1e6));
    double *points = malloc(2 * n * sizeof *points);
    mwp_location *at = calloc(n, sizeof *at);
    if (!points || !at) stop("out of memory");
    points_anywhere(points, n, rank);
    rounds_run(mesh, points, n, rounds, at, "anywhere");
    points_own(points, n, rank, mesh);
    rounds_run(mesh, points, n, rounds, at, "own pieces");
    free(points);
    free(at);
    mwp_mesh_destroy(mesh);
    MPI_Finalize();
    return 0;
}
