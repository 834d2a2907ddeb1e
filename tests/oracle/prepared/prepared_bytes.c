#include "oracle/prepared/prepared_bytes.h"

#include "base/checksum.h"
#include "support/start_list.h"

#include <string.h>

void prepared_bytes_repair(unsigned char *bytes, size_t size)
{
    mw_prepared_header header;
    if (size < sizeof header) return;
    memcpy(&header, bytes, sizeof header);
    for (int kind = 0; kind < MW_PART_COUNT; kind++) {
        mw_prepared_part *part = &header.part[kind];
        if (part->offset > size || part->bytes > size - part->offset) continue;
        if (part->bytes)
            part->checksum = mw__checksum_of(bytes + part->offset, (size_t)part->bytes);
    }
    header.checksum = mw__prepared_header_checksum(&header);
    memcpy(bytes, &header, sizeof header);
}

/* The lowest-numbered triangle that has q, MW_NONE: none. */
static uint32_t lowest_with_point(const mw_mesh *mesh, mw_point q)
{
    for (uint32_t t = 0; t < mesh->tri_count; t++) {
        uint32_t v[3];
        double p[3][2];
        const double at[2] = {q.x, q.y};
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], p[k]);
        const double area = mw_orient2d(p[0], p[1], p[2]);
        int sides = 0;
        for (int k = 0; k < 3; k++) {
            const double side = mw_orient2d(p[k], p[(k + 1) % 3], at);
            sides += area > 0 ? side >= 0 : side <= 0;
        }
        if (area != 0 && sides == 3) return t;
    }
    return MW_NONE;
}

enum { MOST_QUERIES = 32 };

/* Points, and the triangle of each. */
typedef struct prepared_queries {
    mw_point q[MOST_QUERIES];
    uint32_t right[MOST_QUERIES], n;
} prepared_queries;

static void queries_add(prepared_queries *queries, const mw_mesh *mesh, mw_point q)
{
    queries->right[queries->n] = lowest_with_point(mesh, q);
    queries->q[queries->n++] = q;
}

/* Some points at vertices, in the middle of triangles, and outside. */
static prepared_queries queries_make(const mw_mesh *mesh)
{
    enum { EACH = 10 };
    prepared_queries queries = {.n = 0};
    for (uint32_t v = 0; v < mesh->point_count; v += mesh->point_count / EACH + 1)
        if (mw__is_finite(mesh->point[v])) queries_add(&queries, mesh, mesh->point[v]);
    for (uint32_t t = 0; t < mesh->tri_count; t += mesh->tri_count / EACH + 1) {
        const uint32_t *v = mesh->tri[t].v;
        queries_add(&queries, mesh,
                    mw__middle(mesh->point[v[0]], mesh->point[v[1]], mesh->point[v[2]]));
    }
    queries_add(&queries, mesh, (mw_point){-1e5, 3});
    return queries;
}

static bool query_by(const mw_prepared *p, const mw_query_options *options,
                     const prepared_queries *queries)
{
    const bool cut = p->locator.tiling.cut;
    mw_cursor cursor;
    mw_location many[MOST_QUERIES];
    if (mw_cursor_init(&p->locator, options, &cursor, NULL) != MW_OK ||
        mw_locate_batch(&p->locator, &queries->q->x, queries->n, 0, options, many, NULL, NULL) !=
            MW_OK)
        return false;
    for (uint32_t i = 0; i < queries->n; i++) {
        const mw_point q = queries->q[i];
        const mw_location one = mw_locate(&p->locator, &cursor, q.x, q.y);
        if (!cut && (one.triangle != queries->right[i] || many[i].triangle != queries->right[i]))
            return false;
    }
    return true;
}

/* Everything else that is read of a file: none of it may be outside. */
static bool rest_is_there(const mw_prepared *p)
{
    const mw_mesh_file *v = &p->values;
    double sum = 0;
    size_t length = 0;
    for (size_t i = 0; i < v->field_count; i++) {
        length += strlen(v->field_names[i]);
        for (size_t k = 0; k < v->point_count; k++) sum += v->fields[i][k];
    }
    for (size_t i = 0; i < v->triangle_field_count; i++) {
        length += strlen(v->triangle_field_names[i]);
        for (size_t k = 0; k < v->triangle_count; k++) sum += v->triangle_fields[i][k];
    }
    for (size_t i = 0; i < v->mark_count; i++) length += strlen(v->mark_names[i]);
    mw_mesh_info info;
    return (sum <= 0 || sum > 0 || sum != sum) && length < p->header.bytes &&
           mw_mesh_describe(&p->mesh, NULL, &info, NULL) == MW_OK;
}

bool prepared_bytes_query(const mw_prepared *p)
{
    const prepared_queries queries = queries_make(&p->mesh);
    mw_index *index[MW_START_COUNT];
    bool right = rest_is_there(p);
    for (int walk = 0; walk < MW_WALK_COUNT && right; walk++)
        right =
            walk == MW_WALK_BORDER ||
            query_by(p, &(mw_query_options){.walk = (mw_walk_kind)walk, .threads = 1}, &queries);
    starts_open(&p->locator, index);
    for (int start = 0; start < MW_START_COUNT && right; start++)
        right = query_by(
            p,
            &(mw_query_options){.start = (mw_start_kind)start, .index = index[start], .threads = 1},
            &queries);
    starts_close(index);
    mw_nearest_border_point hit;
    for (uint32_t i = 0; i < queries.n && right && p->locator.has_border; i++)
        right = mw_nearest_border(&p->locator, queries.q[i].x, queries.q[i].y, &hit, NULL) !=
                MW_ERROR_ARGUMENT;
    return right;
}
