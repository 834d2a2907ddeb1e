/* overlap_tile.c - the values at the corners of a tile. */
#include "overlap/overlap_tile.h"

#include "segment/segment_parameter.h"

/* Areas and volumes do not overflow if coordinates are below this. */
#define OVERLAP_FARTHEST 0x1p300

/* The user's triangle as stored, with slots of vertices. A tile may have its corners in another
 * order; if the triangle is cut into tiles, a tile may have other corners. */
static const mw_triangle *tile_record(const mw_locator *locator, const mw_triangle *tile)
{
    const mw_mesh *mesh = locator->mesh;
    if (locator->tiling.borrowed || locator->tiling.tile_of) return tile;
    return &mesh->tri[mw__triangle_slot(mesh, tile->user & MW_USER_MASK)];
}

/* The value at a point on the edges of a triangle, between its corners. */
static double tile_value_between(mw_point q, const mw_point p[3], const double value[3])
{
    double sum = 0, whole = 0;
    for (uint32_t k = 0; k < 3; k++) {
        double area = mw__segment_area(p[mw__next(k)], p[mw__prev(k)], q);
        sum += area * value[k];
        whole += area;
    }
    return sum / whole;
}

/* Corner k of a tile; value[] are those of the corners of its triangle. */
static void tile_take_corner(mw_overlap_tile *tile, uint32_t k, const mw_locator *locator,
                             const mw_triangle *record, const mw_point p[3], const double value[3])
{
    for (uint32_t i = 0; i < 3; i++)
        if (mw__points_equal(p[i], tile->p[k])) {
            tile->vertex[k] = mw__vertex_number(locator->mesh, record->v[i]);
            tile->value[k] = value[i];
            return;
        }
    tile->value[k] = tile_value_between(tile->p[k], p, value);
}

mw_overlap_tile mw__overlap_tile(const mw_locator *locator, uint32_t t, const double *values)
{
    const mw_tiling *tiling = &locator->tiling;
    const mw_triangle *tile = &tiling->tri[t];
    mw_overlap_tile out = {.there = !(tile->user & MW_GHOST)};
    for (uint32_t k = 0; k < 3; k++) out.p[k] = tiling->point[tile->v[k]];
    if (!out.there) return out;
    const mw_triangle *record = tile_record(locator, tile);
    const mw_point *point = record == tile ? tiling->point : locator->mesh->point;
    mw_point p[3];
    double value[3] = {0};
    for (uint32_t k = 0; k < 3; k++) {
        p[k] = point[record->v[k]];
        if (values) value[k] = values[mw__vertex_number(locator->mesh, record->v[k])];
        out.there = out.there && isfinite(value[k]);
        out.vertex[k] = mw__vertex_number(locator->mesh, tile->v[k]);
    }
    for (uint32_t k = 0; k < 3; k++) tile_take_corner(&out, k, locator, record, p, value);
    if (out.there) out.area = mw__segment_area(out.p[0], out.p[1], out.p[2]) / 2;
    return out;
}

mw_status mw__overlap_check_locator(const mw_locator *locator, mw_error *error)
{
    if (!locator->tiling.embedding)
        return mw__fail(error, MW_ERROR_ARGUMENT, "overlaps need a mesh that is an embedding");
    if (locator->tiling.border_loops)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "overlaps need a locator that fills pockets and holes (MW_FILL_YES)");
    for (int k = 0; k < 2; k++)
        if (!(fmax(fabs(locator->low[k]), fabs(locator->high[k])) < OVERLAP_FARTHEST))
            return mw__fail(error, MW_ERROR_LIMIT,
                            "coordinates of 2^300 and more have areas beyond the doubles");
    return MW_OK;
}
