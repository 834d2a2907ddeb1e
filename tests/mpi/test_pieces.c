/* test_pieces.c - answers of a mesh in pieces are those of the library for the whole mesh, bit for
 * bit: for many meshes, cuts and numbers of ranks. */
#include "mpi_both.h"
#include "support/environment.h"

#include <meshwalk/predicates.h>
#include <unistd.h>

enum { SEED = 20261128 };

static void check_location(const both *b, const double *p, const mw_location *want,
                           const mwp_location *at)
{
#define WHERE                                                                                      \
    "%s, %s, rank %d of %d: point %.17g %.17g: %s in %u, hole %u; in pieces %s in %lld, hole %u",  \
        b->mesh_name, b->cut_name, mpi_rank(), mpi_ranks(), p[0], p[1],                            \
        mw_where_name((mw_where)want->where), want->triangle, want->hole,                          \
        mw_where_name((mw_where)at->where), (long long)at->triangle, at->hole
    const bool there = want->triangle != MW_NONE;
    mpi_check(at->where == want->where, WHERE);
    mpi_check(at->triangle == (there ? mpi_number(want->triangle) : -1), WHERE);
    mpi_check(at->hole == want->hole && at->local == want->local, WHERE);
    mpi_check(there ? memcmp(at->weight, want->weight, sizeof at->weight) == 0
                    : isnan(at->weight[0]) && isnan(at->weight[1]) && isnan(at->weight[2]),
              WHERE);
    mpi_check(at->rank == (there ? b->rank_of[want->triangle] : -1), WHERE);
    if (there && at->rank == mpi_rank())
        mpi_check(b->own.triangle[at->index] == at->triangle, WHERE);
    if (!there) mpi_check(at->index == MW_NONE, WHERE);
}

static void check_border(const both *b, const double *p, const mw_location *want)
{
    mw_nearest_border_point near;
    mwp_nearest_border_point at;
    mwp_error error;
    const bool away =
        want->where == MW_OUTSIDE || want->where == MW_IN_HOLE || want->where == MW_NEAR;
    mw_status status = mwp_nearest_border(b->pieces, p[0], p[1], &at, &error);
    mpi_check((status == MW_OK) == away, "%s, %s: %.17g %.17g", b->mesh_name, b->cut_name, p[0],
              p[1]);
    if (!away) return;
    mpi_check(mw_nearest_border(b->locator, p[0], p[1], &near, NULL) == MW_OK, "the border");
    mpi_check(at.triangle == mpi_number(near.triangle) && at.edge == near.edge &&
                  memcmp(&at.distance, &near.distance, sizeof at.distance) == 0 &&
                  memcmp(at.point, near.point, sizeof at.point) == 0 &&
                  memcmp(at.weight, near.weight, sizeof at.weight) == 0 &&
                  at.rank == b->rank_of[near.triangle],
              "%s, %s: %.17g %.17g: border edge %u of %u, in pieces %u of %lld", b->mesh_name,
              b->cut_name, p[0], p[1], near.edge, near.triangle, at.edge, (long long)at.triangle);
}

/* Locate points that lie 3 doubles apart; this rank has those from `from` to `to`. */
static void check_batch(const both *b, const double *points, size_t from, size_t to,
                        const mwp_locate_options *options, bool step_by_step)
{
    const double *own = points + 3 * from;
    const size_t n = to - from;
    mwp_error error;
    mw_location *want = calloc(n + 1, sizeof *want);
    mwp_location *at = calloc(n + 1, sizeof *at);
    const mw_query_options query = {.tolerance = options ? options->tolerance : 0, .threads = 1};
    mw_status status = mw_locate_batch(b->locator, own, n, 3, &query, want, NULL, NULL);
    mpi_check(status == MW_OK, "the whole mesh");
    mwp_locating *locating = mwp_locate_begin(b->pieces, own, n, 3, options, at);
    while (step_by_step && !mwp_locate_test(locating)) usleep(50);
    status = mwp_locate_end(locating, &error);
    mpi_check(status == MW_OK, "%s, %s: %s", b->mesh_name, b->cut_name, error.message);
    for (size_t i = 0; i < n; i++) {
        check_location(b, own + 3 * i, &want[i], &at[i]);
        if (i % 7 == 0) check_border(b, own + 3 * i, &want[i]);
    }
    free(at);
    free(want);
}

/* Points x, y, and a third number that is passed over. */
static double *spaced(const double *points, size_t n)
{
    double *out = malloc((3 * n + 1) * sizeof *out);
    for (size_t i = 0; i < n; i++) {
        out[3 * i] = points[2 * i];
        out[3 * i + 1] = points[2 * i + 1];
        out[3 * i + 2] = NAN;
    }
    return out;
}

static void check_queries(const both *b, uint64_t seed)
{
    size_t n;
    uint64_t random = seed;
    double *points = arrays_queries(&b->a, 60, &n, &random), *wide = spaced(points, n);
    const size_t rank = (size_t)mpi_rank(), ranks = (size_t)mpi_ranks();
    if (n > 3) wide[3] = NAN;
    if (n > 3) wide[7] = INFINITY;
    check_batch(b, wide, n * rank / ranks, n * (rank + 1) / ranks, NULL, false);
    /* all ranks ask the same; one rank asks everything, the others nothing */
    check_batch(b, wide, 0, n, &(mwp_locate_options){.tolerance = 1.5, .budget = 100}, true);
    check_batch(b, wide, 0, rank == 0 ? n : 0, NULL, false);
    /* the others get one question at a time */
    check_batch(b, wide, 0, rank == 0 && n > 5 ? 5 : 0,
                &(mwp_locate_options){.budget = 1, .threads = 2}, false);
    free(wide);
    free(points);
}

/* --- what is told about pieces: counted by looking at all pairs of triangles --- */

static uint32_t vertex_of(const arrays *a, uint32_t t, uint32_t k)
{
    return a->triangles[3 * (size_t)t + k % 3];
}

static const double *corner_of(const arrays *a, uint32_t t, uint32_t k)
{
    return a->points + 2 * (size_t)vertex_of(a, t, k);
}

static bool is_flat(const arrays *a, uint32_t t)
{
    return mw_orient2d(corner_of(a, t, 0), corner_of(a, t, 1), corner_of(a, t, 2)) == 0;
}

/* Is there nothing, or a triangle without area, beyond an edge of a triangle with an area? */
static bool is_outline(const arrays *a, uint32_t t, uint32_t k)
{
    const uint32_t from = vertex_of(a, t, k), to = vertex_of(a, t, k + 1);
    for (uint32_t u = 0; u < a->triangle_count; u++)
        for (uint32_t i = 0; i < 3 && u != t && !is_flat(a, u); i++) {
            const uint32_t begin = vertex_of(a, u, i), end = vertex_of(a, u, i + 1);
            if ((begin == from && end == to) || (begin == to && end == from)) return false;
        }
    return true;
}

static bool triangle_contains(const arrays *a, uint32_t t, const double *p)
{
    int sides = 0; /* bits: some area is above 0, below 0 */
    if (is_flat(a, t)) return false;
    for (uint32_t k = 0; k < 3; k++) {
        const double area = mw_orient2d(corner_of(a, t, k), corner_of(a, t, k + 1), p);
        sides |= area > 0 ? 1 : area < 0 ? 2 : 0;
    }
    return sides != 3;
}

/* The triangles without area, and those that contain a corner of one, or an end of the outline. */
static uint32_t rim_count(const arrays *a)
{
    bool *in = calloc(a->triangle_count + 1, sizeof *in);
    uint32_t count = 0;
    for (uint32_t t = 0; t < a->triangle_count; t++) {
        const bool flat = is_flat(a, t);
        in[t] = in[t] || flat;
        for (uint32_t k = 0; k < 3; k++) {
            if (!flat && !is_outline(a, t, k) && !is_outline(a, t, k + 2)) continue;
            for (uint32_t u = 0; u < a->triangle_count; u++)
                in[u] = in[u] || triangle_contains(a, u, corner_of(a, t, k));
        }
    }
    for (uint32_t t = 0; t < a->triangle_count; t++) count += in[t];
    free(in);
    return count;
}

/* Vertices that some triangle has. */
static uint32_t vertex_count(const arrays *a)
{
    bool *used = calloc(a->point_count + 1, sizeof *used);
    uint32_t count = 0;
    for (size_t i = 0; i < 3 * (size_t)a->triangle_count; i++) used[a->triangles[i]] = true;
    for (uint32_t v = 0; v < a->point_count; v++) count += used[v];
    free(used);
    return count;
}

static void check_info(const both *b)
{
    mw_locator_info whole;
    mwp_mesh_info info;
    mw_locator_describe(b->locator, &whole);
    mwp_mesh_describe(b->pieces, &info);
    mpi_check(info.triangles == b->a.triangle_count && info.holes == whole.holes &&
                  info.piece_triangles == b->own.part.triangle_count && info.bytes > 0,
              "%s, %s: %lld triangles of %u, %u holes of %u", b->mesh_name, b->cut_name,
              (long long)info.triangles, b->a.triangle_count, info.holes, whole.holes);
    mpi_check(info.vertices == vertex_count(&b->a) &&
                  info.piece_vertices == b->own.part.point_count,
              "%s, %s: %lld vertices, not %u; of the piece %u, not %u", b->mesh_name, b->cut_name,
              (long long)info.vertices, vertex_count(&b->a), info.piece_vertices,
              b->own.part.point_count);
    mpi_check(info.boxes > 0 && info.boxes <= 64 * (uint32_t)mpi_ranks(), "%u boxes", info.boxes);
    if (mpi_rank() > 0) return; /* the others have the same rim */
    const uint32_t rim = rim_count(&b->a);
    mpi_check(info.rim_triangles == rim, "%s, %s: the rim has %u triangles, not %u", b->mesh_name,
              b->cut_name, info.rim_triangles, rim);
}

/* --- the meshes that the cases have ----------------------------------------------------------- */

static void check_meshes(uint64_t seed)
{
    both b;
    const char *name;
    const bool all = environment_is_long() || mpi_ranks() == 2;
    for (int mesh = 0; mesh < MPI_MESHES; mesh++)
        for (int cut = 0; cut < MPI_CUTS; cut++) {
            if (!all && (mesh + cut + mpi_ranks()) % 4) continue; /* each pair for some ranks */
            arrays a = mpi_mesh(mesh, seed, &name);
            mpi_check(both_make(&b, a, name, cut, seed), "%s is refused", name);
            check_info(&b);
            check_queries(&b, seed + (uint64_t)(mesh * MPI_CUTS + cut));
            both_release(&b);
        }
}

/* --- small meshes, most of them with a defect or two ------------------------------------------ */

/* Change something. Nobody looks whether the mesh stays an embedding. */
static void damage(arrays *a, uint64_t *random)
{
    const uint32_t v = mw__random_below(random, a->point_count),
                   t = mw__random_below(random, a->triangle_count), k = mw__random_below(random, 3);
    double *p = &a->points[2 * (size_t)v];
    switch (mw__random_below(random, 5)) {
    case 0: p[mw__random_below(random, 2)] += 4 * (double)mw__random_below(random, 3) - 4; break;
    case 1: a->triangles[3 * (size_t)t + k] = v; break;
    case 2: mpi_tear(a, 0.1, random); break;
    case 3: arrays_punch(a, 0.2, random); break;
    default: a->points[2 * (size_t)v + k % 2] += 1; break;
    }
}

static void check_damaged(uint64_t seed)
{
    uint64_t random = seed;
    int sound = 0, rounds = environment_is_long() ? 2000 : 40;
    for (int i = 0; i < rounds; i++) {
        both b;
        arrays a = arrays_grid(3, 0, &random);
        arrays_transform(&a, 4, 0, 0);
        if (i % 3 == 0) arrays_punch(&a, 0.3, &random);
        if (i % 4 == 0) mpi_break_edges(&a, 4, &random);
        arrays_scramble(&a, i % 2, &random);
        for (uint32_t n = mw__random_below(&random, 5); n > 0; n--) damage(&a, &random);
        if (both_make(&b, a, "damaged", i % MPI_CUTS, seed + (uint64_t)i)) {
            sound++;
            check_queries(&b, seed + (uint64_t)i);
        }
        both_release(&b);
    }
    mpi_check(sound > rounds / 10 && sound < rounds * 9 / 10, "%d of %d are sound", sound, rounds);
}

int main(int count, char **arguments)
{
    MPI_Init(&count, &arguments);
    const uint64_t seed = environment_seed(SEED);
    check_meshes(seed);
    check_damaged(seed);
    MPI_Finalize();
    return 0;
}
