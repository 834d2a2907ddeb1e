/* test_refusals.c - what is wrong with pieces is told by number and rank, on all ranks the same. */
#include "mpi_cases.h"
#include "mpi_checks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* All ranks have the error of rank 0, and it has all these words. */
static void check_error(mw_status status, const mwp_error *error, mw_status want, const char *words)
{
    mwp_error first = *error;
    MPI_Bcast(&first, sizeof first, MPI_BYTE, 0, MPI_COMM_WORLD);
    mpi_check(status == want && error->status == want, "%s instead of: %s",
              status ? error->message : "no error", words);
    mpi_check(memcmp(&first, error, sizeof first) == 0, "%s, but on rank 0: %s", error->message,
              first.message);
    mpi_check(strstr(error->message, words), "%s, without: %s", error->message, words);
}

static void refuse_piece(const mwp_piece *given, mw_status want, const char *words)
{
    mwp_error error;
    mwp_mesh *mesh;
    mw_status status = mwp_mesh_create(MPI_COMM_WORLD, given, NULL, &mesh, &error);
    check_error(status, &error, want, words);
    mpi_check(!mesh, "a mesh in spite of: %s", error.message);
}

static void refuse(const piece *p, mw_status want, const char *words)
{
    const mwp_piece given = {arrays_view(&p->part), p->vertex, p->triangle};
    refuse_piece(&given, want, words);
}

/* A grid whose rows of triangles go round the ranks. */
static arrays grid(int **rank_of)
{
    uint64_t random = 1;
    arrays a = arrays_grid(4, 0, &random);
    *rank_of = malloc(a.triangle_count * sizeof **rank_of);
    for (uint32_t t = 0; t < a.triangle_count; t++) (*rank_of)[t] = (int)t % mpi_ranks();
    return a;
}

/* --- on one rank ------------------------------------------------------------------------------ */

static void change_vertex(piece *p)
{
    p->part.triangles[0] = p->part.point_count;
}
static void change_number(piece *p)
{
    p->triangle[1] = -3;
}
static void change_point(piece *p)
{
    p->part.points[2 * (size_t)p->part.triangles[3]] = NAN;
}
static void change_name(piece *p)
{
    p->vertex[0] = p->vertex[1];
}
static void change_twice(piece *p)
{
    p->triangle[0] = p->triangle[1];
}

static void test_one_rank(void)
{
    static const struct {
        void (*change)(piece *);
        mw_status want;
        const char *words;
    } cases[] = {{change_vertex, MW_ERROR_INPUT, " has a vertex that its piece lacks: corner 0"},
                 {change_number, MW_ERROR_ARGUMENT, "triangle 1 of the piece has the number -3"},
                 {change_point, MW_ERROR_INPUT, " has a coordinate that is not finite"},
                 {change_name, MW_ERROR_INPUT, "the piece has vertex "},
                 {change_twice, MW_ERROR_INPUT, "the piece has triangle "}};
    const int last = mpi_ranks() - 1;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int *rank_of;
        arrays a = grid(&rank_of);
        piece p = piece_make(&a, rank_of, mpi_rank(), i);
        if (mpi_rank() == last) cases[i].change(&p);
        refuse(&p, cases[i].want, cases[i].words);
        piece_free(&p);
        arrays_free(&a);
        free(rank_of);
    }
    const mwp_piece none = {0};
    refuse_piece(mpi_rank() == last ? NULL : &none, MW_ERROR_ARGUMENT, "the piece is NULL");
    refuse_piece(&none, MW_ERROR_INPUT, "no triangle with an area");
}

/* --- between ranks ---------------------------------------------------------------------------- */

static void test_twice(void)
{
    int *rank_of;
    char words[120];
    arrays a = grid(&rank_of);
    const int last = mpi_ranks() - 1;
    snprintf(words, sizeof words, "triangle %lld is in those of ranks 0 and %d",
             (long long)mpi_number(0), last);
    if (mpi_rank() == last) rank_of[0] = last;
    piece p = piece_make(&a, rank_of, mpi_rank(), 3);
    refuse(&p, MW_ERROR_INPUT, words);
    piece_free(&p);
    arrays_free(&a);
    free(rank_of);
}

static void test_coordinates(void)
{
    int *rank_of;
    char words[200];
    arrays a = grid(&rank_of);
    const int last = mpi_ranks() - 1;
    const uint32_t v = a.triangles[3 * (size_t)(uint32_t)last]; /* of the last rank, and others */
    const double x = a.points[2 * (size_t)v];
    snprintf(words, sizeof words, "%.17g, %.17g on rank %d", x + 0.25, a.points[2 * (size_t)v + 1],
             last);
    if (mpi_rank() == last) a.points[2 * (size_t)v] += 0.25;
    piece p = piece_make(&a, rank_of, mpi_rank(), 3);
    refuse(&p, MW_ERROR_INPUT, words);
    piece_free(&p);
    arrays_free(&a);
    free(rank_of);
}

/* Add a copy of some triangles, with vertices of its own, moved. */
static void add_copy(arrays *a, uint32_t first, uint32_t count, double dx)
{
    for (uint32_t t = first; t < first + count; t++) {
        uint32_t v[3];
        for (size_t k = 0; k < 3; k++) {
            const double *p = &a->points[2 * (size_t)a->triangles[3 * (size_t)t + k]];
            v[k] = arrays_point(a, p[0] + dx, p[1] + dx);
        }
        arrays_triangle(a, v[0], v[1], v[2]);
    }
}

/* The second part of the triangles is the last rank's. */
static void refuse_parts(arrays *a, uint32_t second, const char *words)
{
    int *rank_of = malloc(a->triangle_count * sizeof *rank_of);
    for (uint32_t t = 0; t < a->triangle_count; t++)
        rank_of[t] = t < second ? (int)t % (mpi_ranks() - 1) : mpi_ranks() - 1;
    piece p = piece_make(a, rank_of, mpi_rank(), 5);
    refuse(&p, MW_ERROR_INPUT, words);
    piece_free(&p);
    free(rank_of);
}

static void test_overlaps(void)
{
    for (int moved = 0; moved < 2; moved++) {
        uint64_t random = 1;
        arrays g = arrays_grid(6, 0, &random), a = arrays_make(100, 100);
        for (uint32_t v = 0; v < g.point_count; v++)
            arrays_point(&a, g.points[2 * (size_t)v], g.points[2 * (size_t)v + 1]);
        for (uint32_t t = 0; t < g.triangle_count; t++)
            arrays_triangle(&a, g.triangles[3 * (size_t)t], g.triangles[3 * (size_t)t + 1],
                            g.triangles[3 * (size_t)t + 2]);
        add_copy(&a, 28, 1, moved * 0.125); /* in the middle, over whole triangles */
        refuse_parts(&a, g.triangle_count, "of rank ");
        arrays_free(&g);
        arrays_free(&a);
    }
}

static void test_edges(void)
{
    /* two triangles on the same side of their common edge; then three at an edge */
    for (int three = 0; three < 2; three++) {
        arrays a = arrays_make(5, 3);
        arrays_point(&a, 0, 0);
        arrays_point(&a, 4, 0);
        arrays_point(&a, 1, 3);
        arrays_point(&a, 3, three ? -3 : 3);
        arrays_point(&a, 2, -4);
        arrays_triangle(&a, 0, 1, 2);
        if (three) arrays_triangle(&a, 1, 0, 4);
        arrays_triangle(&a, 0, 1, 3);
        refuse_parts(&a, a.triangle_count - 1,
                     three ? "edge of three or more triangles: triangle " : "folded along an edge");
        arrays_free(&a);
    }
}

/* Two turns of triangles round a vertex. */
static void test_winding(void)
{
    enum { RING = 16 };
    arrays a = arrays_make(RING + 1, RING);
    const uint32_t centre = arrays_point(&a, 0, 0);
    for (int i = 0; i < RING; i++) {
        const double angle = i * 0.78539816339744828, radius = 10 + i;
        arrays_point(&a, radius * cos(angle), radius * sin(angle));
    }
    for (uint32_t i = 0; i < RING; i++) arrays_triangle(&a, centre, 1 + i, 1 + (i + 1) % RING);
    refuse_parts(&a, RING / 2, "more than one turn round a vertex: triangle ");
    arrays_free(&a);
}

/* --- queries ---------------------------------------------------------------------------------- */

static void test_queries(void)
{
    int *rank_of;
    mwp_error error;
    mwp_mesh *mesh;
    arrays a = grid(&rank_of);
    piece p = piece_make(&a, rank_of, mpi_rank(), 3);
    const mwp_piece given = {arrays_view(&p.part), p.vertex, p.triangle};
    mpi_check(mwp_mesh_create(MPI_COMM_WORLD, &given, NULL, &mesh, &error) == MW_OK, "%s",
              error.message);
    const double point[2] = {1.5, 1.25};
    mwp_location at;
    const double *missing = mpi_rank() == mpi_ranks() - 1 ? NULL : point;
    mw_status status = mwp_locate_batch(mesh, missing, 1, 2, NULL, &at, &error);
    check_error(status, &error, MW_ERROR_ARGUMENT, "the points or the locations are NULL");
    const mwp_locate_options wrong = {.tolerance = mpi_rank() == 0 ? -1 : 0};
    status = mwp_locate_batch(mesh, point, 1, 2, &wrong, &at, &error);
    check_error(status, &error, MW_ERROR_ARGUMENT, "the tolerance -1 is negative");
    status = mwp_locate_batch(mesh, point, 1, 1, NULL, &at, &error);
    check_error(status, &error, MW_ERROR_ARGUMENT,
                "the stride must be at least 2 (x and y), not 1");
    mpi_check(mwp_locate_batch(mesh, point, 1, 2, NULL, &at, NULL) == MW_OK &&
                  at.where == MW_INSIDE,
              "after failures");
    mwp_mesh_destroy(mesh);
    piece_free(&p);
    arrays_free(&a);
    free(rank_of);
}

int main(int count, char **arguments)
{
    MPI_Init(&count, &arguments);
    test_one_rank();
    test_queries();
    if (mpi_ranks() > 1) {
        test_twice();
        test_coordinates();
        test_overlaps();
        test_edges();
        test_winding();
    }
    MPI_Finalize();
    return 0;
}
