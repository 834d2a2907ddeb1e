#include "triangulate/constrained/polygon_ranks.h"

#include "base/hilbert.h"

#include <inttypes.h>
#include <stdlib.h>

/* The segments that belong to polygons, by polygon. Returns NULL when out of memory. */
static mw_key *polygon_segments_sort(const mw_constraints *given, size_t *count)
{
    size_t n = given->segment_count;
    mw_key *key = mw__alloc(n, sizeof *key), *scratch = mw__alloc(n, sizeof *scratch);
    *count = 0;
    if (key && scratch) {
        for (size_t i = 0; i < n; i++)
            if (given->polygon[i] != MW_NONE)
                key[(*count)++] = (mw_key){given->polygon[i], (uint32_t)i};
        mw__sort_keys(key, scratch, *count);
    } else {
        free(key);
        key = NULL;
    }
    free(scratch);
    return key;
}

/* Inside and outside make sense where at each vertex an even number of a polygon's segments end. */
static mw_status polygons_check_closed(const mw_cdt *m, const mw_key *key, size_t count,
                                       mw_error *error)
{
    uint8_t *odd = mw__calloc(m->given->point_count, sizeof *odd);
    mw_status status = odd ? MW_OK : mw__fail_memory(error);
    for (size_t from = 0, to; from < count && status == MW_OK; from = to) {
        for (to = from; to < count && key[to].key == key[from].key; to++)
            for (size_t k = 0; k < 2; k++)
                odd[mw__vertex_of(m, m->given->segments[2 * (size_t)key[to].item + k])] ^= 1;
        for (size_t i = 2 * from; i < 2 * to && status == MW_OK; i++) {
            uint32_t v = mw__vertex_of(m, m->given->segments[2 * (size_t)key[i / 2].item + i % 2]);
            if (odd[v])
                status =
                    mw__fail_at(error, -1, v,
                                "polygon %" PRIu32 " is not closed: a ring ends at point %" PRIu32,
                                key[from].key, v);
        }
    }
    free(odd);
    return status;
}

static bool ranks_number(mw_polygon_ranks *r, size_t segments, const mw_key *key, size_t count)
{
    r->rank = mw__alloc(segments, sizeof *r->rank);
    for (size_t i = 0; i < count; i++) r->count += i == 0 || key[i].key != key[i - 1].key;
    r->polygon = mw__alloc(r->count, sizeof *r->polygon);
    if (!r->rank || !r->polygon) return false;
    for (size_t i = 0; i < segments; i++) r->rank[i] = MW_NONE;
    uint32_t rank = 0;
    for (size_t i = 0; i < count; i++) {
        rank += i > 0 && key[i].key != key[i - 1].key;
        r->rank[key[i].item] = rank;
        r->polygon[rank] = key[i].key;
    }
    return true;
}

mw_status mw__polygon_ranks_create(mw_polygon_ranks *r, const mw_cdt *m, mw_error *error)
{
    size_t count;
    *r = (mw_polygon_ranks){0};
    mw_key *key = polygon_segments_sort(m->given, &count);
    mw_status status = key ? polygons_check_closed(m, key, count, error) : mw__fail_memory(error);
    if (status == MW_OK && !ranks_number(r, m->given->segment_count, key, count))
        status = mw__fail_memory(error);
    free(key);
    return status;
}

void mw__polygon_ranks_release(mw_polygon_ranks *r)
{
    free(r->rank);
    free(r->polygon);
    *r = (mw_polygon_ranks){0};
}
