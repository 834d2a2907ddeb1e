/* value_table.c - many values at each vertex, interpolated at located points.
 *
 * The corners of a triangle are looked up once for all values. Points lie anywhere in the mesh, so
 * looking them up mostly waits for memory. Therefore the triangles of several points are prefetched
 * together, then their vertices, then the values there, while the values of earlier points are
 * summed. */
#include "base/job.h"
#include "base/options.h"
#include "mesh/mesh.h"

#include <meshwalk/locate.h>

enum {
    GROUP = 16,  /* points that are looked up together  */
    BLOCK = 512, /* points whose corners are kept, where values lie field by field */
    LINE = 64,   /* bytes of a cache line */
    LINES = 6    /* lines to prefetch; the processor finds those after them by itself */
};

/* The vertices of a triangle, in the user's order. */
typedef struct table_corners {
    uint32_t v[3];
} table_corners;

typedef struct table_sum {
    const mw_mesh *mesh;
    mw_value_table table; /* stride and step resolved */
    const mw_location *locations;
    size_t n;
    void *result;
    bool fields; /* values lie field by field */
} table_sum;

/* --- corners ---------------------------------------------------------------------------------- */

static MW_INLINE const mw_triangle *corners_record(const mw_mesh *mesh, const mw_location *at)
{
    return &mesh->tri[mw__triangle_slot(mesh, at->triangle)];
}

/* Of at most GROUP points; unspecified where there is no triangle. */
static void corners_look_up(const mw_mesh *mesh, const mw_location *at, size_t n,
                            table_corners *corners)
{
    for (size_t i = 0; i < n && mesh->triangle_slot; i++)
        if (at[i].triangle != MW_NONE) __builtin_prefetch(&mesh->triangle_slot[at[i].triangle]);
    for (size_t i = 0; i < n; i++)
        if (at[i].triangle != MW_NONE) __builtin_prefetch(corners_record(mesh, &at[i]));
    for (size_t i = 0; i < n; i++) {
        if (at[i].triangle == MW_NONE) continue;
        const mw_triangle *t = corners_record(mesh, &at[i]);
        for (uint32_t k = 0; k < 3; k++) corners[i].v[mw__user_local_vertex(t->user, k)] = t->v[k];
        for (int k = 0; k < 3 && mesh->vertex_number; k++)
            __builtin_prefetch(&mesh->vertex_number[corners[i].v[k]]);
    }
    for (size_t i = 0; i < n && mesh->vertex_number; i++)
        for (int k = 0; k < 3 && at[i].triangle != MW_NONE; k++)
            corners[i].v[k] = mesh->vertex_number[corners[i].v[k]];
}

/* --- values ----------------------------------------------------------------------------------- */

/* `narrow` is a literal where this is stamped: tables of floats and of doubles are one code. */
static MW_INLINE double value_load(const void *values, size_t i, bool narrow)
{
    return narrow ? (double)((const float *)values)[i] : ((const double *)values)[i];
}

static MW_INLINE void value_store(void *values, size_t i, double value, bool narrow)
{
    if (narrow)
        ((float *)values)[i] = (float)value;
    else
        ((double *)values)[i] = value;
}

static MW_INLINE const void *value_at(const void *values, size_t i, bool narrow)
{
    return (const char *)values + i * (narrow ? sizeof(float) : sizeof(double));
}

static MW_INLINE bool location_is_inside(const mw_location *at)
{
    return at->weight[0] != 0 && at->weight[1] != 0 && at->weight[2] != 0;
}

/* Sums in the order of mw_interpolate: the bits are the same. */
static MW_INLINE void value_row_inside(const double w[3], const void *const corner[3], size_t count,
                                       bool narrow, void *restrict result)
{
    const void *restrict a = corner[0], *restrict b = corner[1], *restrict c = corner[2];
    for (size_t k = 0; k < count; k++) {
        double sum = 0 + w[0] * value_load(a, k, narrow);
        sum += w[1] * value_load(b, k, narrow);
        sum += w[2] * value_load(c, k, narrow);
        value_store(result, k, sum, narrow);
    }
}

/* A weight of 0 ignores even NaN. */
static MW_INLINE double value_on_edge(const double w[3], const void *const corner[3], size_t k,
                                      bool narrow)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        if (w[i] != 0) sum += w[i] * value_load(corner[i], k, narrow);
    return sum;
}

/* --- values of a vertex side by side ---------------------------------------------------------- */

static MW_INLINE void value_row(const table_sum *s, const mw_location *at,
                                const table_corners *corners, void *result, bool narrow)
{
    const size_t count = s->table.count;
    const void *corner[3];
    if (at->triangle == MW_NONE) {
        for (size_t k = 0; k < count; k++) value_store(result, k, NAN, narrow);
        return;
    }
    for (int i = 0; i < 3; i++)
        corner[i] = value_at(s->table.values, corners->v[i] * s->table.stride, narrow);
    if (location_is_inside(at))
        value_row_inside(at->weight, corner, count, narrow, result);
    else
        for (size_t k = 0; k < count; k++)
            value_store(result, k, value_on_edge(at->weight, corner, k, narrow), narrow);
}

/* Look up the corners of a group, and have the values there on their way. */
static MW_INLINE void rows_ask(const table_sum *s, size_t from, size_t to, table_corners *corners,
                               bool narrow)
{
    const size_t n = to - from < GROUP ? to - from : GROUP, row = s->table.count * (narrow ? 4 : 8),
                 bytes = row < LINES * LINE ? row : LINES * LINE;
    corners_look_up(s->mesh, &s->locations[from], n, corners);
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 3 && s->locations[from + i].triangle != MW_NONE; k++) {
            const char *values =
                value_at(s->table.values, corners[i].v[k] * s->table.stride, narrow);
            for (size_t at = 0; at < bytes; at += LINE) __builtin_prefetch(values + at);
            __builtin_prefetch(values + bytes - 1);
        }
}

static MW_INLINE void rows_sum(const table_sum *s, size_t from, size_t to, bool narrow)
{
    table_corners corners[2][GROUP];
    rows_ask(s, from, to, corners[0], narrow);
    for (size_t group = from, turn = 0; group < to; group += GROUP, turn ^= 1) {
        const size_t end = to - group < GROUP ? to : group + GROUP;
        if (end < to) rows_ask(s, end, to, corners[turn ^ 1], narrow);
        for (size_t i = group; i < end; i++)
            value_row(s, &s->locations[i], &corners[turn][i - group],
                      (void *)(uintptr_t)value_at(s->result, i * s->table.count, narrow), narrow);
    }
}

/* --- values field by field -------------------------------------------------------------------- */

/* One field at the points of a block. */
static MW_INLINE void field_sum(const table_sum *s, size_t from, size_t n,
                                const table_corners *corners, size_t k, bool narrow)
{
    const void *values = value_at(s->table.values, k * s->table.step, narrow);
    const size_t stride = s->table.stride;
    for (size_t i = 0; i < n; i++) {
        const mw_location *at = &s->locations[from + i];
        const size_t v[3] = {corners[i].v[0] * stride, corners[i].v[1] * stride,
                             corners[i].v[2] * stride};
        double sum = NAN;
        if (MW_LIKELY(location_is_inside(at) && at->triangle != MW_NONE)) {
            sum = 0 + at->weight[0] * value_load(values, v[0], narrow);
            sum += at->weight[1] * value_load(values, v[1], narrow);
            sum += at->weight[2] * value_load(values, v[2], narrow);
        } else if (at->triangle != MW_NONE) {
            const void *corner[3];
            for (int c = 0; c < 3; c++) corner[c] = value_at(values, v[c], narrow);
            sum = value_on_edge(at->weight, corner, 0, narrow);
        }
        value_store(s->result, k * s->n + from + i, sum, narrow);
    }
}

static MW_INLINE void fields_sum(const table_sum *s, size_t from, size_t to, bool narrow)
{
    table_corners corners[BLOCK];
    for (size_t block = from; block < to; block += BLOCK) {
        const size_t n = to - block < BLOCK ? to - block : BLOCK;
        for (size_t i = 0; i < n; i += GROUP)
            corners_look_up(s->mesh, &s->locations[block + i], n - i < GROUP ? n - i : GROUP,
                            &corners[i]);
        for (size_t k = 0; k < s->table.count; k++) field_sum(s, block, n, corners, k, narrow);
    }
}

/* --- all -------------------------------------------------------------------------------------- */

static void table_sum_range(void *work, uint64_t from, uint64_t to)
{
    const table_sum *s = work;
    const bool narrow = s->table.type == MW_FLOAT32;
    if (s->fields && narrow)
        fields_sum(s, from, to, true);
    else if (s->fields)
        fields_sum(s, from, to, false);
    else if (narrow)
        rows_sum(s, from, to, true);
    else
        rows_sum(s, from, to, false);
}

static mw_status table_check(const mw_value_table *table, mw_error *error)
{
    if (table->type != MW_FLOAT64 && table->type != MW_FLOAT32)
        return mw__fail(error, MW_ERROR_ARGUMENT, "unknown type of values: %d", (int)table->type);
    if (table->step <= 1 && table->stride && table->stride < table->count)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the stride %zu is less than the %zu values of a vertex", table->stride,
                        table->count);
    return MW_OK;
}

mw_status mw_interpolate_table(const mw_mesh *mesh, const mw_value_table *table,
                               const mw_location *locations, size_t n,
                               const mw_interpolate_options *options, void *result, mw_error *error)
{
    static const mw_interpolate_options defaults;
    if (!options) options = &defaults;
    if (!mesh || !table || (n && (!locations || !result)) || (table->count && !table->values))
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the mesh, the values, the locations or the result are NULL");
    mw_status status = MW_RESERVED_CHECK(mw_interpolate_options, options, error);
    if (!status) status = table_check(table, error);
    if (status || table->count == 0) return status;
    table_sum sum = {mesh, *table, locations, n, result, table->step > 1};
    if (!table->stride) sum.table.stride = sum.fields ? 1 : table->count;
    mw_job job = mw__job(options->threads, options->progress);
    mw__job_stage(&job, "interpolating", 1);
    mw__job_ranges(&job, n, table_sum_range, &sum);
    return mw__job_end(&job, MW_OK, error);
}
