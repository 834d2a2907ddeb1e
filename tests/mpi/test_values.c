/* test_values.c - what is asked about locations: values, weights as a matrix, particles that move,
 * vertices that move, a mesh from a file. */
#include "mpi_both.h"
#include "support/environment.h"

#include <meshwalk/io.h>
#include <meshwalk/operator.h>
#include <unistd.h>

enum { SEED = 20261129, VALUES = 2 };

/* Queries of this rank, located in both. */
typedef struct located {
    double *points;
    size_t n, first; /* `first`: the number of its first query among those of all ranks */
    mw_location *whole;
    mwp_location *at;
} located;

static located located_make(const both *b, uint64_t seed)
{
    located l = {0};
    size_t all;
    mwp_error error;
    uint64_t random = seed;
    const size_t rank = (size_t)mpi_rank(), ranks = (size_t)mpi_ranks();
    double *points = arrays_queries(&b->a, 40, &all, &random);
    l.first = all * rank / ranks;
    l.n = all * (rank + 1) / ranks - l.first;
    l.points = malloc((2 * l.n + 1) * sizeof *l.points);
    memcpy(l.points, points + 2 * l.first, 2 * l.n * sizeof *l.points);
    free(points);
    l.whole = calloc(l.n + 1, sizeof *l.whole);
    l.at = calloc(l.n + 1, sizeof *l.at);
    const mw_query_options whole = {.tolerance = 1, .threads = 1};
    const mwp_locate_options options = {.tolerance = 1};
    mpi_check(mw_locate_batch(b->locator, l.points, l.n, 2, &whole, l.whole, NULL, NULL) == MW_OK,
              "the whole mesh");
    mpi_check(mwp_locate_batch(b->pieces, l.points, l.n, 2, &options, l.at, &error) == MW_OK, "%s",
              error.message);
    for (size_t i = 0; i < l.n; i++) {
        const int64_t want = l.whole[i].triangle == MW_NONE ? -1 : mpi_number(l.whole[i].triangle);
        mpi_check(l.at[i].triangle == want && l.at[i].where == l.whole[i].where,
                  "query %zu: triangle %lld, not %lld", i, (long long)l.at[i].triangle,
                  (long long)want);
    }
    return l;
}

static void located_release(located *l)
{
    free(l->points);
    free(l->whole);
    free(l->at);
}

/* --- values ----------------------------------------------------------------------------------- */

static double value_of(int64_t vertex, int k)
{
    uint64_t random = (uint64_t)vertex * 7 + (uint64_t)k;
    return random_unit(&random) * 1000 - 300;
}

static void check_values(const both *b, const located *l)
{
    mwp_error error;
    const uint32_t all = b->a.point_count, own = b->own.part.point_count;
    double *whole = malloc((all + 1) * VALUES * sizeof *whole),
           *piece_values = malloc((own + 1) * (VALUES + 1) * sizeof *piece_values);
    double *want = calloc(l->n + 1, VALUES * sizeof *want),
           *got = calloc(l->n + 1, VALUES * sizeof *got);
    for (uint32_t v = 0; v < all; v++)
        for (int k = 0; k < VALUES; k++)
            whole[VALUES * v + (uint32_t)k] = value_of(mpi_number(v), k);
    for (uint32_t v = 0; v < own; v++)
        for (int k = 0; k < VALUES; k++)
            piece_values[(VALUES + 1) * v + (uint32_t)k] = value_of(b->own.vertex[v], k);
    const mw_value_table table = {.values = whole, .count = VALUES},
                         in_piece = {.values = piece_values, .count = VALUES, .stride = VALUES + 1};
    mw_interpolate_table(b->mesh, &table, l->whole, l->n, NULL, want, NULL);
    mw_status status = mwp_interpolate(b->pieces, &in_piece, l->at, l->n, got, &error);
    mpi_check(status == MW_OK, "%s", error.message);
    for (size_t i = 0; i < VALUES * l->n; i++)
        mpi_check(isnan(want[i]) ? isnan(got[i]) : memcmp(&want[i], &got[i], sizeof *got) == 0,
                  "%s, %s: value %zu is %.17g, not %.17g", b->mesh_name, b->cut_name, i, got[i],
                  want[i]);
    /* ranks that do not fit: all learn of it */
    const mw_value_table other = {.values = piece_values, .count = mpi_rank() == 0 ? 1 : 2};
    status = mwp_interpolate(b->pieces, &other, l->at, l->n, got, &error);
    mpi_check((status == MW_ERROR_ARGUMENT) == (mpi_ranks() > 1), "different rows");
    free(whole);
    free(piece_values);
    free(want);
    free(got);
}

static void check_operator(const both *b, const located *l)
{
    mwp_error error;
    mw_operator *whole;
    uint64_t *want_first = calloc(l->n + 1, sizeof *want_first),
             *first = calloc(l->n + 1, sizeof *first);
    uint32_t *want_column = calloc(3 * l->n + 1, sizeof *want_column);
    int64_t *column = calloc(3 * l->n + 1, sizeof *column);
    double *want_weight = calloc(3 * l->n + 1, sizeof *want_weight),
           *weight = calloc(3 * l->n + 1, sizeof *weight);
    mpi_check(mw_operator_create(b->mesh, l->whole, l->n, NULL, &whole, NULL) == MW_OK, "whole");
    mw_operator_copy(whole, want_first, want_column, want_weight);
    mpi_check(mwp_operator(b->pieces, l->at, l->n, first, column, weight, &error) == MW_OK, "%s",
              error.message);
    mpi_check(memcmp(first, want_first, (l->n + 1) * sizeof *first) == 0, "%s, %s: the rows",
              b->mesh_name, b->cut_name);
    for (uint64_t e = 0; e < first[l->n]; e++)
        mpi_check(column[e] == mpi_number(want_column[e]) &&
                      memcmp(&weight[e], &want_weight[e], sizeof *weight) == 0,
                  "%s, %s: entry %llu", b->mesh_name, b->cut_name, (unsigned long long)e);
    mw_operator_destroy(whole);
    free(want_first);
    free(first);
    free(want_column);
    free(column);
    free(want_weight);
    free(weight);
}

/* --- particles -------------------------------------------------------------------------------- */

typedef struct cargo {
    uint64_t name;
    uint8_t more[5];
} cargo;

static void check_migration(const both *b, const located *l)
{
    mwp_error error;
    mwp_particles moved;
    int64_t sums[2] = {0, 0}, all[2];
    cargo *load = calloc(l->n + 1, sizeof *load);
    for (size_t i = 0; i < l->n; i++) load[i] = (cargo){l->first + i, {1, 2, 3, 4, 5}};
    mw_status status = mwp_migrate(b->pieces, l->at, load, sizeof *load, l->n, &moved, &error);
    mpi_check(status == MW_OK, "%s", error.message);
    uint64_t before = 0;
    for (size_t i = 0; i < moved.count; i++) {
        const cargo *c = (const cargo *)moved.payload + i;
        const int rank = moved.locations[i].rank;
        const bool mine = c->name >= l->first && c->name < l->first + l->n;
        mpi_check(rank == mpi_rank() || (rank < 0 && mine), "a particle of rank %d", rank);
        mpi_check(i == 0 || c->name > before, "the order of particles");
        mpi_check(c->more[4] == 5, "the payload");
        before = c->name;
        sums[1] += (int64_t)(c->name * c->name % 1009);
    }
    sums[0] = (int64_t)moved.count - (int64_t)l->n;
    for (size_t i = 0; i < l->n; i++) sums[1] -= (int64_t)(load[i].name * load[i].name % 1009);
    MPI_Allreduce(sums, all, 2, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    mpi_check(all[0] == 0 && all[1] == 0, "particles were lost, or came twice");
    mwp_particles_release(&moved);
    free(load);
}

/* --- vertices that move ----------------------------------------------------------------------- */

/* Move all vertices of both; false: both refuse. */
static bool both_move(both *b, const double *points)
{
    mwp_error error;
    arrays moved = {(double *)(uintptr_t)points, b->a.triangles, b->a.point_count,
                    b->a.triangle_count};
    const mw_arrays view = arrays_view(&moved);
    mw_mesh *mesh;
    mw_locator *locator = NULL;
    mpi_check(mw_mesh_create(&view, NULL, &mesh, NULL) == MW_OK, "moved");
    const mw_locator_options options = {.border = 1, .threads = 1};
    const bool sound = mw_locator_create(mesh, &options, &locator, NULL) == MW_OK;
    double *own = malloc((3 * b->own.part.point_count + 1) * sizeof *own);
    for (uint32_t v = 0; v < b->own.part.point_count; v++)
        memcpy(own + 3 * (size_t)v, points + 2 * (size_t)mpi_place(b->own.vertex[v]),
               2 * sizeof *own);
    mw_status status = mwp_update(b->pieces, own, 3, &error);
    mpi_check((status == MW_OK) == sound, "%s, %s: moved: %s", b->mesh_name, b->cut_name,
              status ? error.message : "sound");
    free(own);
    if (sound) {
        mw_locator_destroy(b->locator);
        mw_mesh_destroy(b->mesh);
        b->locator = locator;
        b->mesh = mesh;
    } else {
        mw_mesh_destroy(mesh);
    }
    return sound;
}

static void check_update(both *b, uint64_t seed)
{
    const uint32_t n = b->a.point_count;
    double *points = malloc((2 * n + 1) * sizeof *points);
    for (uint32_t i = 0; i < 2 * n; i++) points[i] = b->a.points[i] * 0.5 + 1;
    mpi_check(both_move(b, points), "all vertices moved alike");
    located l = located_make(b, seed);
    located_release(&l);
    if (b->a.triangle_count > 1) {
        points[2 * (size_t)b->a.triangles[0]] += 1000; /* over its neighbours */
        both_move(b, points);
        l = located_make(b, seed + 1); /* a refused update changes nothing */
        located_release(&l);
    }
    free(points);
}

/* --- a file ----------------------------------------------------------------------------------- */

static void check_file(uint64_t seed)
{
    const char *name;
    char path[] = "/tmp/meshwalk-mpi-XXXXXX";
    arrays a = mpi_mesh(1, seed, &name);
    if (mpi_rank() == 0) {
        const int fd = mkstemp(path);
        FILE *out = fdopen(fd, "w");
        mpi_check(out, "no temporary file");
        fprintf(out, "OFF\n%u %u 0\n", a.point_count, a.triangle_count);
        for (uint32_t v = 0; v < a.point_count; v++)
            fprintf(out, "%.17g %.17g %.17g\n", a.points[2 * (size_t)v],
                    a.points[2 * (size_t)v + 1], value_of(v, 0));
        for (uint32_t t = 0; t < a.triangle_count; t++)
            fprintf(out, "3 %u %u %u\n", a.triangles[3 * (size_t)t], a.triangles[3 * (size_t)t + 1],
                    a.triangles[3 * (size_t)t + 2]);
        fclose(out);
    }
    mwp_mesh *mesh;
    mwp_error error;
    mw_status status = mwp_mesh_read(MPI_COMM_WORLD, path, NULL, &mesh, &error);
    mpi_check(status == MW_OK, "%s", error.message);
    if (mpi_rank() == 0) unlink(path);
    mw_mesh *whole = arrays_mesh(&a, (mw_mesh_options){.threads = 1});
    mw_locator *locator = mesh_locator(whole, (mw_locator_options){.threads = 1});
    double *z = malloc(a.point_count * sizeof *z);
    for (uint32_t v = 0; v < a.point_count; v++) z[v] = value_of(v, 0);
    size_t n;
    uint64_t random = seed;
    double *points = arrays_queries(&a, 30, &n, &random);
    mw_location *want = calloc(n, sizeof *want);
    mwp_location *at = calloc(n, sizeof *at);
    double *value = calloc(n, sizeof *value), *want_value = calloc(n, sizeof *value);
    mw_value_table table;
    mpi_check(mwp_mesh_field(mesh, "z", &table) && !mwp_mesh_field(mesh, "y", &table) &&
                  mwp_mesh_field_count(mesh) == 1,
              "the fields");
    mpi_check(mwp_mesh_field(mesh, mwp_mesh_field_name(mesh, 0), &table), "a field by its name");
    mw_locate_batch(locator, points, n, 2, NULL, want, NULL, NULL);
    mw_interpolate(whole, z, want, n, want_value);
    mpi_check(mwp_locate_batch(mesh, points, n, 2, NULL, at, &error) == MW_OK &&
                  mwp_interpolate(mesh, &table, at, n, value, &error) == MW_OK,
              "%s", error.message);
    for (size_t i = 0; i < n; i++)
        mpi_check(at[i].where == want[i].where && at[i].hole == want[i].hole &&
                      at[i].triangle ==
                          (want[i].triangle == MW_NONE ? -1 : (int64_t)want[i].triangle) &&
                      (isnan(want_value[i]) ? isnan(value[i]) : value[i] == want_value[i]),
                  "query %zu of the file: %lld", i, (long long)at[i].triangle);
    mwp_piece mine;
    mwp_mesh_piece(mesh, &mine);
    for (size_t t = 0; t < mine.arrays.triangle_count; t++)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t v = ((const uint32_t *)mine.arrays.triangles)[3 * t + k];
            mpi_check(mine.vertex_numbers[v] ==
                          a.triangles[3 * (size_t)mine.triangle_numbers[t] + k],
                      "the piece");
        }
    mpi_check(mwp_update(mesh, mine.arrays.points, 0, &error) == MW_OK &&
                  mwp_mesh_field(mesh, "z", &table) && mwp_mesh_field_count(mesh) == 1,
              "the fields of a mesh that has moved");
    mwp_mesh_destroy(mesh);
    status = mwp_mesh_read(MPI_COMM_WORLD, "/nowhere/mesh.off", NULL, &mesh, &error);
    mpi_check(status == MW_ERROR_SYSTEM && error.rank == 0 && !mesh, "%s", error.message);
    mw_locator_destroy(locator);
    mw_mesh_destroy(whole);
    arrays_free(&a);
    free(z);
    free(points);
    free(want);
    free(at);
    free(value);
    free(want_value);
}

int main(int count, char **arguments)
{
    MPI_Init(&count, &arguments);
    const uint64_t seed = environment_seed(SEED);
    for (int mesh = 0; mesh < MPI_MESHES; mesh++) {
        const char *name;
        both b;
        arrays a = mpi_mesh(mesh, seed, &name);
        const int cut = (mesh + mpi_ranks()) % MPI_CUTS;
        mpi_check(both_make(&b, a, name, cut, seed), "%s is refused", name);
        located l = located_make(&b, seed + (uint64_t)mesh);
        check_values(&b, &l);
        check_operator(&b, &l);
        check_migration(&b, &l);
        located_release(&l);
        check_update(&b, seed);
        both_release(&b);
    }
    check_file(seed);
    MPI_Finalize();
    return 0;
}
