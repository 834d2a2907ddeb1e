/* records.c - triangles that travel, and meshes made of them. */
#include "mpi/mesh/records.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

mwp_record mwp__record_of(const mwp_own *own, uint32_t triangle, int rank)
{
    mwp_record r = {.triangle = own->triangle[triangle],
                    .rank = rank,
                    .place = triangle,
                    .given = own->given[triangle]};
    for (uint32_t k = 0; k < 3; k++) {
        r.vertex[k] = mwp__own_number(own, triangle, k);
        memcpy(&r.point[2 * k], mwp__own_point(own, triangle, k), 2 * sizeof *r.point);
    }
    return r;
}

/* --- a mesh of records ------------------------------------------------------------------------ */

static int compare_records(const void *left, const void *right)
{
    const mwp_record *a = left, *b = right;
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static int compare_numbers(const void *left, const void *right)
{
    const int64_t a = *(const int64_t *)left, b = *(const int64_t *)right;
    return a < b ? -1 : a > b;
}

static uint32_t records_drop_copies(mwp_record *record, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || record[i].triangle != record[kept - 1].triangle)
            record[kept++] = record[i];
    return (uint32_t)kept;
}

static uint32_t numbers_drop_copies(int64_t *number, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || number[i] != number[kept - 1]) number[kept++] = number[i];
    return (uint32_t)kept;
}

static uint32_t union_vertex(const mwp_union *all, int64_t number)
{
    const int64_t *found =
        bsearch(&number, all->vertex, all->vertex_count, sizeof *found, compare_numbers);
    return (uint32_t)(found - all->vertex);
}

static bool union_number_vertices(mwp_union *all)
{
    const size_t n = all->triangle_count;
    all->vertex = mwp__alloc(3 * n, sizeof *all->vertex);
    all->corner = mwp__alloc(3 * n, sizeof *all->corner);
    if (!all->vertex || !all->corner) return false;
    for (size_t t = 0; t < n; t++)
        memcpy(&all->vertex[3 * t], all->record[t].vertex, sizeof all->record[t].vertex);
    qsort(all->vertex, 3 * n, sizeof *all->vertex, compare_numbers);
    all->vertex_count = numbers_drop_copies(all->vertex, 3 * n);
    all->points = mwp__alloc(all->vertex_count, 2 * sizeof *all->points);
    for (size_t i = 0; all->points && i < 3 * n; i++) {
        const mwp_record *r = &all->record[i / 3];
        all->corner[i] = union_vertex(all, r->vertex[i % 3]);
        memcpy(&all->points[2 * (size_t)all->corner[i]], &r->point[2 * (i % 3)],
               2 * sizeof *r->point);
    }
    return all->points;
}

mw_status mwp__union_create(mwp_union *all, mwp_record *records, size_t count, mwp_error *error)
{
    *all = (mwp_union){.record = records};
    qsort(records, count, sizeof *records, compare_records);
    all->triangle_count = records_drop_copies(records, count);
    return union_number_vertices(all) ? MW_OK : mwp__fail_memory(error);
}

void mwp__union_release(mwp_union *all)
{
    free(all->record);
    free(all->points);
    free(all->corner);
    free(all->vertex);
    *all = (mwp_union){0};
}

/* --- names ------------------------------------------------------------------------------------ */

mwp_names mwp__names_of_union(const mwp_union *all)
{
    return (mwp_names){.arrays = {.points = all->points,
                                  .point_count = all->vertex_count,
                                  .triangles = all->corner,
                                  .triangle_count = all->triangle_count},
                       .vertex = all->vertex,
                       .record = all->record};
}

mwp_names mwp__names_of_own(const mwp_own *own, int rank)
{
    return (mwp_names){.arrays = {.points = own->points,
                                  .point_count = own->vertices,
                                  .triangles = own->corner,
                                  .triangle_count = own->triangles},
                       .vertex = own->vertex,
                       .triangle = own->triangle,
                       .rank = rank};
}

static int64_t name_of_triangle(const mwp_names *n, uint32_t t)
{
    return t == MW_NONE ? -1 : n->record ? n->record[t].triangle : n->triangle[t];
}

static int name_of_rank(const mwp_names *n, uint32_t t)
{
    return n->record ? n->record[t].rank : n->rank;
}

mw_status mwp__fail_defect(mwp_error *error, const mwp_names *names, const mw_defect *d)
{
    char other[80] = "", vertex[40] = "";
    const int64_t t = name_of_triangle(names, d->triangle),
                  v = d->vertex == MW_NONE ? -1 : names->vertex[d->vertex];
    if (v >= 0) snprintf(vertex, sizeof vertex, ", vertex %" PRId64, v);
    if (d->other != MW_NONE)
        snprintf(other, sizeof other, ", and triangle %" PRId64 " of rank %d",
                 name_of_triangle(names, d->other), name_of_rank(names, d->other));
    return mwp__fail_at(error, t, v, "%s: triangle %" PRId64 " of rank %d%s%s",
                        mw_defect_text(d->kind), t, name_of_rank(names, d->triangle), other,
                        vertex);
}

mw_status mwp__fail_arrays(mwp_error *error, const mwp_names *names, const mw_error *from)
{
    mw_check check;
    if (from->status != MW_ERROR_INPUT ||
        mw_check_arrays(&names->arrays, &(mw_check_options){.threads = 1}, &check, NULL))
        return mwp__fail_as(error, from);
    mw_status status =
        check.valid ? mwp__fail_as(error, from) : mwp__fail_defect(error, names, &check.defects[0]);
    mw_check_release(&check);
    return status;
}
