/* segment.c - the walk along one segment, as users have it: parts become pieces of the user's
 * triangles. */
#include "segment/segment.h"

#include "locate/location.h"
#include "segment/segment_start.h"

mw_status mw__segment_check_locator(const mw_locator *locator, mw_error *error)
{
    if (!locator) return mw__fail(error, MW_ERROR_ARGUMENT, "the locator is NULL");
    if (!locator->tiling.embedding)
        return mw__fail(error, MW_ERROR_ARGUMENT, "segments need a mesh that is an embedding");
    if (locator->tiling.border_loops)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "segments need a locator that fills pockets and holes (MW_FILL_YES)");
    return MW_OK;
}

/* --- triangles that are cut into tiles --- */

/* The edge of the user's triangle on which the edge of its tile lies. */
static uint8_t piece_cut_edge(const mw_point corner[3], mw_point p, mw_point q)
{
    for (uint32_t k = 0; k < 3; k++)
        if (mw__orient2d(corner[k], corner[mw__next(k)], p) == 0 &&
            mw__orient2d(corner[k], corner[mw__next(k)], q) == 0)
            return (uint8_t)k;
    return 255;
}

/* Where a place of a tile is in the user's triangle, as stored; 255: neither edge nor vertex. */
static uint8_t piece_cut_place(const mw_segment *s, const mw_segment_stretch *part, uint8_t at)
{
    const mw_tiling *tiling = &s->locator->tiling;
    const mw_mesh *mesh = s->locator->mesh;
    const mw_triangle *tile = &tiling->tri[part->tile],
                      *t = &mesh->tri[mw__triangle_slot(mesh, tile->user & MW_USER_MASK)];
    mw_point corner[3] = {mesh->point[t->v[0]], mesh->point[t->v[1]], mesh->point[t->v[2]]};
    if (at < MW_AT_VERTEX)
        return piece_cut_edge(corner, tiling->point[tile->v[at]], tiling->point[tile->v[at + 1]]);
    mw_point v = tiling->point[tile->v[at - MW_AT_VERTEX]];
    for (uint32_t k = 0; k < 3; k++)
        if (mw__points_equal(corner[k], v)) return (uint8_t)(MW_AT_VERTEX + k);
    return piece_cut_edge(corner, v, v);
}

/* The piece of one part. An edge between two tiles of the triangle is inside. */
static mw_segment_piece piece_of_part(const mw_segment *s, const mw_segment_stretch *part)
{
    uint32_t user = s->locator->tiling.tri[part->tile].user;
    uint8_t place[3] = {part->from_at, part->to_at, part->along};
    for (int i = 0; i < 3; i++) {
        if (s->locator->tiling.cut && place[i] < MW_AT_INSIDE) {
            place[i] = piece_cut_place(s, part, place[i]);
            if (place[i] == 255 && i < 2) place[i] = MW_AT_INSIDE;
        }
        place[i] = mw__segment_user_place(user, place[i]);
    }
    return (mw_segment_piece){part->from, part->to, user & MW_USER_MASK, place[0], place[1],
                              place[2],   s->gap};
}

/* Does the part go on in the triangle of the piece that is held? Both run along an edge, or
 * neither does. */
static bool piece_grows(mw_segment *s, const mw_segment_piece *next)
{
    if (!s->held || next->triangle != s->piece.triangle) return false;
    s->piece.to = next->to;
    s->piece.to_at = next->to_at;
    return true;
}

/* The next piece where triangles may be cut into tiles, or the segment is a point. */
static bool segment_next_joined(mw_segment *s, mw_segment_piece *piece)
{
    mw_segment_stretch part;
    while (mw__segment_step(s, &part)) {
        bool ghost = s->locator->tiling.tri[part.tile].user & MW_GHOST, full = s->held;
        mw_segment_piece next = {.triangle = MW_NONE};
        if (!ghost) next = piece_of_part(s, &part);
        s->gap = ghost;
        if (piece_grows(s, &next)) continue;
        if (full) *piece = s->piece;
        s->held = !ghost;
        s->piece = next;
        if (full) return true;
    }
    if (!s->held) return false;
    *piece = s->piece;
    s->held = 0;
    return true;
}

bool mw__segment_next_surely(mw_segment *s, mw_segment_piece *piece)
{
    if (MW_UNLIKELY(s->locator->tiling.cut || s->held)) return segment_next_joined(s, piece);
    mw_segment_stretch part;
    while (mw__segment_step(s, &part)) {
        bool ghost = s->locator->tiling.tri[part.tile].user & MW_GHOST;
        if (!ghost) *piece = piece_of_part(s, &part);
        s->gap = ghost;
        if (!ghost) return true;
    }
    return false;
}

/* --- walks --- */

static uint8_t place_of_location(const mw_location *at)
{
    return (uint8_t)(at->where == MW_ON_EDGE     ? MW_AT_EDGE + at->local
                     : at->where == MW_ON_VERTEX ? MW_AT_VERTEX + at->local
                                                 : MW_AT_INSIDE);
}

/* A segment that is a point. */
static void segment_set_point(mw_segment *s, const mw_location *at)
{
    uint8_t place = place_of_location(at);
    s->held = at->where <= MW_ON_VERTEX;
    s->piece = (mw_segment_piece){0, 0, at->triangle, place, place, 255, 0};
}

void mw__segment_set(mw_segment *s, const mw_locator *locator, mw_cursor *cursor, const double a[2],
                     const double b[2])
{
    *s = (mw_segment){.locator = locator, .a = {a[0], a[1]}, .b = {b[0], b[1]}};
    s->tile = cursor->last;
    if (a[0] != b[0] || a[1] != b[1]) {
        mw__segment_start(s, cursor->last);
        return;
    }
    mw_location at = mw_locate(locator, cursor, a[0], a[1]);
    segment_set_point(s, &at);
}

static bool segment_is_finite(const double a[2], const double b[2])
{
    return isfinite(a[0]) && isfinite(a[1]) && isfinite(b[0]) && isfinite(b[1]);
}

mw_status mw_segment_begin(const mw_locator *locator, mw_cursor *cursor, const double a[2],
                           const double b[2], mw_segment *segment, mw_error *error)
{
    mw_status status = mw__segment_check_locator(locator, error);
    if (status) return status;
    if (!cursor || !a || !b || !segment)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the cursor or a point is NULL");
    if (!segment_is_finite(a, b))
        return mw__fail(error, MW_ERROR_INPUT, "a coordinate of the segment is not finite");
    mw_locate(locator, cursor, a[0], a[1]);
    mw__segment_set(segment, locator, cursor, a, b);
    return MW_OK;
}

mw_status mw_segment_continue(mw_segment *segment, const double b[2], mw_error *error)
{
    if (!segment || !segment->locator || !b)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the segment or the point is NULL");
    if (!segment_is_finite(b, b))
        return mw__fail(error, MW_ERROR_INPUT, "a coordinate of the segment is not finite");
    mw_segment before = *segment;
    mw_cursor cursor;
    mw_status status = mw_cursor_init(before.locator, NULL, &cursor, error);
    if (status) return status;
    cursor.last = before.tile;
    mw__segment_set(segment, before.locator, &cursor, before.b, b);
    return MW_OK;
}

int mw_segment_next(mw_segment *segment, mw_segment_piece *piece)
{
    size_t count = 0;
    if (mw__segment_may_run(segment))
        while (count == 0 && mw__segment_run(segment, true, piece, &count)) continue;
    return count > 0 || mw__segment_next_surely(segment, piece);
}
