/* piece.c - copies and checks the arrays of a piece. */
#include "mpi/mesh/piece.h"

#include <meshwalk/predicates.h>

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- the caller's arrays ---------------------------------------------------------------------- */

/* Vertex k of triangle t as the caller has it; -1 for any number that is none. */
static int64_t piece_corner(const mw_arrays *a, size_t t, size_t k)
{
    const size_t i = 3 * t + k;
    int64_t v = a->integer_type == MW_UINT32  ? ((const uint32_t *)a->triangles)[i]
                : a->integer_type == MW_INT32 ? ((const int32_t *)a->triangles)[i]
                                              : ((const int64_t *)a->triangles)[i];
    return v < 0 || (uint64_t)v >= a->point_count ? -1 : v;
}

static mw_status piece_check_arguments(const mwp_piece *piece, mwp_error *error)
{
    if (!piece) return mwp__fail(error, MW_ERROR_ARGUMENT, "the piece is NULL");
    const mw_arrays *a = &piece->arrays;
    if (a->point_count && (!a->points || !piece->vertex_numbers))
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the points or their numbers are NULL");
    if (a->triangle_count && (!a->triangles || !piece->triangle_numbers))
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the triangles or their numbers are NULL");
    if (a->point_stride == 1)
        return mwp__fail(error, MW_ERROR_ARGUMENT,
                         "the stride must be at least 2 (x and y), not 1");
    if ((unsigned)a->integer_type > MW_INT64)
        return mwp__fail(error, MW_ERROR_ARGUMENT, "unknown type of vertex numbers");
    if (a->triangle_count > MW_MAX_TRIANGLES || a->point_count > MW_MAX_VERTICES)
        return mwp__fail(error, MW_ERROR_LIMIT,
                         "a piece has %zu triangles and %zu vertices; at most %" PRIu32
                         " and %" PRIu32 " are possible",
                         a->triangle_count, a->point_count, MW_MAX_TRIANGLES,
                         (uint32_t)MW_MAX_VERTICES);
    return MW_OK;
}

static mw_status piece_check_numbers(const int64_t *number, size_t count, const char *what,
                                     mwp_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (number[i] < 0)
            return mwp__fail(error, MW_ERROR_ARGUMENT,
                             "%s %zu of the piece has the number %" PRId64
                             "; numbers are at least 0",
                             what, i, number[i]);
    return MW_OK;
}

/* --- the copy --------------------------------------------------------------------------------- */

typedef struct numbered {
    int64_t number;
    uint32_t place;
} numbered;

static int compare_numbered(const void *left, const void *right)
{
    const numbered *a = left, *b = right;
    if (a->number != b->number) return a->number < b->number ? -1 : 1;
    return a->place < b->place ? -1 : a->place > b->place;
}

static bool numbers_ascend(const int64_t *number, size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (number[i - 1] >= number[i]) return false;
    return true;
}

/* The places of numbers in ascending order; NULL when out of memory. */
static numbered *numbers_sort(const int64_t *number, size_t count)
{
    numbered *sorted = mwp__alloc(count, sizeof *sorted);
    if (!sorted) return NULL;
    for (size_t i = 0; i < count; i++) sorted[i] = (numbered){number[i], (uint32_t)i};
    if (!numbers_ascend(number, count)) qsort(sorted, count, sizeof *sorted, compare_numbered);
    return sorted;
}

static mw_status own_copy_triangles(mwp_own *own, const mwp_piece *piece, mwp_error *error)
{
    numbered *sorted = numbers_sort(piece->triangle_numbers, own->triangle_count);
    mw_status status = sorted ? MW_OK : mwp__fail_memory(error);
    for (uint32_t i = 0; i < own->triangle_count && !status; i++) {
        const int64_t number = sorted[i].number;
        own->triangle[i] = number;
        own->given[i] = sorted[i].place;
        own->place[sorted[i].place] = i;
        if (i > 0 && number == sorted[i - 1].number)
            status =
                mwp__fail_at(error, number, -1, "the piece has triangle %" PRId64 " twice", number);
        for (uint32_t k = 0; k < 3 && !status; k++) {
            const int64_t v = piece_corner(&piece->arrays, sorted[i].place, k);
            if (v < 0)
                status = mwp__fail_at(error, number, -1,
                                      "triangle %" PRId64
                                      " has a vertex that its piece lacks: corner %" PRIu32
                                      " is none of its %" PRIu32 " vertices",
                                      number, k, own->vertex_count);
            own->corner[3 * (size_t)i + k] = (uint32_t)v;
        }
    }
    free(sorted);
    return status;
}

static mw_status own_check_vertices(const mwp_own *own, mwp_error *error)
{
    numbered *sorted = numbers_sort(own->vertex, own->vertex_count);
    mw_status status = sorted ? MW_OK : mwp__fail_memory(error);
    for (uint32_t i = 1; i < own->vertex_count && !status; i++)
        if (sorted[i].number == sorted[i - 1].number)
            status = mwp__fail_at(error, -1, sorted[i].number,
                                  "the piece has vertex %" PRId64 " twice", sorted[i].number);
    free(sorted);
    return status;
}

static void own_copy_points(mwp_own *own, const double *points, size_t stride)
{
    if (stride == 0) stride = 2;
    for (size_t v = 0; v < own->vertex_count; v++)
        memcpy(&own->points[2 * v], &points[v * stride], 2 * sizeof *points);
}

static bool own_make_room(mwp_own *own, size_t vertices, size_t triangles)
{
    *own = (mwp_own){.vertex_count = (uint32_t)vertices,
                     .triangle_count = (uint32_t)triangles,
                     .vertices = (uint32_t)vertices,
                     .triangles = (uint32_t)triangles};
    own->points = mwp__alloc(vertices, 2 * sizeof *own->points);
    own->vertex = mwp__alloc(vertices, sizeof *own->vertex);
    own->corner = mwp__alloc(triangles, 3 * sizeof *own->corner);
    own->triangle = mwp__alloc(triangles, sizeof *own->triangle);
    own->given = mwp__alloc(triangles, sizeof *own->given);
    own->place = mwp__alloc(triangles, sizeof *own->place);
    return own->points && own->vertex && own->corner && own->triangle && own->given && own->place;
}

mw_status mwp__own_create(mwp_own *own, const mwp_piece *piece, mwp_error *error)
{
    *own = (mwp_own){0};
    mw_status status = piece_check_arguments(piece, error);
    if (status) return status;
    const mw_arrays *a = &piece->arrays;
    status = piece_check_numbers(piece->vertex_numbers, a->point_count, "vertex", error);
    if (!status)
        status = piece_check_numbers(piece->triangle_numbers, a->triangle_count, "triangle", error);
    if (status) return status;
    if (!own_make_room(own, a->point_count, a->triangle_count)) return mwp__fail_memory(error);
    own_copy_points(own, a->points, a->point_stride);
    mwp__copy(own->vertex, piece->vertex_numbers, a->point_count * sizeof *own->vertex);
    status = own_check_vertices(own, error);
    return status ? status : own_copy_triangles(own, piece, error);
}

mw_status mwp__own_check_points(const mwp_own *own, mwp_error *error)
{
    for (uint32_t t = 0; t < own->triangle_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            const double *p = mwp__own_point(own, t, k);
            if (isfinite(p[0]) && isfinite(p[1])) continue;
            const int64_t v = mwp__own_number(own, t, k);
            return mwp__fail_at(error, own->triangle[t], v,
                                "vertex %" PRId64 " of triangle %" PRId64
                                " has a coordinate that is not finite",
                                v, own->triangle[t]);
        }
    return MW_OK;
}

mw_status mwp__own_move(mwp_own *own, const mwp_own *from, const double *points, size_t stride,
                        mwp_error *error)
{
    const size_t vertices = from->vertex_count, triangles = from->triangle_count;
    *own = (mwp_own){0};
    if (vertices && !points) return mwp__fail(error, MW_ERROR_ARGUMENT, "the points are NULL");
    if (stride == 1)
        return mwp__fail(error, MW_ERROR_ARGUMENT,
                         "the stride must be at least 2 (x and y), not 1");
    if (!own_make_room(own, vertices, triangles)) return mwp__fail_memory(error);
    own_copy_points(own, points, stride);
    memcpy(own->vertex, from->vertex, vertices * sizeof *own->vertex);
    memcpy(own->corner, from->corner, triangles * 3 * sizeof *own->corner);
    memcpy(own->triangle, from->triangle, triangles * sizeof *own->triangle);
    memcpy(own->given, from->given, triangles * sizeof *own->given);
    memcpy(own->place, from->place, triangles * sizeof *own->place);
    return MW_OK;
}

void mwp__own_release(mwp_own *own)
{
    free(own->points);
    free(own->vertex);
    free(own->corner);
    free(own->triangle);
    free(own->given);
    free(own->place);
    *own = (mwp_own){0};
}

size_t mwp__own_bytes(const mwp_own *own)
{
    return own->vertices * (2 * sizeof *own->points + sizeof *own->vertex) +
           own->triangles * (3 * sizeof *own->corner + sizeof *own->triangle) +
           own->triangle_count * (sizeof *own->given + sizeof *own->place);
}

/* Make one array larger; false when out of memory. */
static bool array_grow(void **array, size_t count, size_t size)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes)) return false;
    void *grown = realloc(*array, bytes ? bytes : 1);
    if (grown) *array = grown;
    return grown;
}

bool mwp__own_grow(mwp_own *own, size_t vertices, size_t triangles)
{
    vertices += own->vertices;
    triangles += own->triangles;
    void *points = own->points, *vertex = own->vertex, *corner = own->corner,
         *triangle = own->triangle;
    const bool done = array_grow(&points, vertices, 2 * sizeof *own->points) &&
                      array_grow(&vertex, vertices, sizeof *own->vertex) &&
                      array_grow(&corner, triangles, 3 * sizeof *own->corner) &&
                      array_grow(&triangle, triangles, sizeof *own->triangle);
    own->points = points;
    own->vertex = vertex;
    own->corner = corner;
    own->triangle = triangle;
    return done;
}

bool mwp__own_is_flat(const mwp_own *own, uint32_t triangle)
{
    return mw_orient2d(mwp__own_point(own, triangle, 0), mwp__own_point(own, triangle, 1),
                       mwp__own_point(own, triangle, 2)) == 0;
}
