/* sight.c - what is seen from a viewpoint. The terrain is linear in each triangle. So a line of
 * sight is above it everywhere if it is above it at its ends and at every edge and vertex that it
 * passes (segment.h lists them). */
#include "locate/locator.h"
#include "sight/sight_line.h"

#include <meshwalk/segment.h>
#include <meshwalk/sight.h>

/* The triangle of a point; MW_NONE if there is none or one of its corners has no height. */
static uint32_t sight_ground(const mw_locator *locator, const double *heights, mw_cursor *cursor,
                             mw_point p, double *ground)
{
    mw_location at = mw_locate(locator, cursor, p.x, p.y);
    if (at.triangle == MW_NONE) return MW_NONE;
    mw_interpolate(locator->mesh, heights, &at, 1, ground);
    return isfinite(*ground) ? at.triangle : MW_NONE;
}

/* Is an end at or above the ground, if there is ground? Sets its level. `grounded`: the triangle
 * there, or MW_NONE. */
static bool sight_find_level(const mw_sight_line *line, const mw_sight_end *end, uint32_t grounded,
                             double ground, mw_sight_level *level)
{
    mw_point at = {end->x, end->y};
    bool absolute = end->absolute || grounded == MW_NONE;
    *level = mw__sight_level(line->mesh, line->heights, at, absolute ? MW_NONE : grounded, ground,
                             end->height);
    if (grounded == MW_NONE) return true;
    if (!absolute) return end->height >= 0;
    mw_sight_level above =
        mw__sight_level(line->mesh, line->heights, at, grounded, ground, -end->height);
    return mw__sight_level_sign(line, &above) <= 0;
}

mw_status mw_viewpoint_init(const mw_locator *locator, const double *heights,
                            const mw_sight_end *from, mw_viewpoint *view, mw_error *error)
{
    mw_segment segment;
    mw_sight_level level;
    double ground = 0;
    if (!locator || !heights || !from || !view)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the locator, the heights, the point or the result is NULL");
    const double at[2] = {from->x, from->y};
    *view = (mw_viewpoint){.locator = locator, .heights = heights, .at = {at[0], at[1]}};
    mw_status status = mw_cursor_init(locator, NULL, &view->here, error);
    if (status == MW_OK) status = mw_segment_begin(locator, &view->here, at, at, &segment, error);
    if (status != MW_OK) return status;
    if (!isfinite(from->height))
        return mw__fail(error, MW_ERROR_INPUT, "the height of a viewpoint is not finite");
    mw_sight_line line = {.mesh = locator->mesh, .heights = heights};
    uint32_t grounded =
        sight_ground(locator, heights, &view->here, (mw_point){at[0], at[1]}, &ground);
    if (grounded == MW_NONE && !from->absolute)
        return mw__fail(error, MW_ERROR_INPUT,
                        "the viewpoint is above no ground: no triangle with heights contains it");
    if (!sight_find_level(&line, from, grounded, ground, &level))
        return mw__fail(error, MW_ERROR_INPUT,
                        "the viewpoint lies below the ground, whose height there is %.17g", ground);
    view->there = view->here;
    view->offset = level.offset;
    view->height = level.height;
    view->unsure = level.unsure;
    view->triangle = level.triangle;
    return MW_OK;
}

/* --- the line --------------------------------------------------------------------------------- */

/* An edge or a vertex of the mesh, twice. */
typedef struct sight_place {
    uint32_t v, w;
} sight_place;

static sight_place place_of(const uint32_t v[3], uint8_t at)
{
    if (at >= MW_AT_VERTEX) return (sight_place){v[at - MW_AT_VERTEX], v[at - MW_AT_VERTEX]};
    uint32_t p = v[at], q = v[(at + 1) % 3];
    return p < q ? (sight_place){p, q} : (sight_place){q, p};
}

static bool triangle_has_ground(const mw_sight_line *line, uint32_t triangle)
{
    uint32_t v[3];
    mw_mesh_triangle(line->mesh, triangle, v);
    return !isnan(line->heights[v[0]]) && !isnan(line->heights[v[1]]) &&
           !isnan(line->heights[v[2]]);
}

/* If the piece runs along an edge, the triangle on either side may be used. */
static bool piece_has_ground(const mw_sight_line *line, const mw_segment_piece *piece)
{
    if (triangle_has_ground(line, piece->triangle)) return true;
    if (piece->along == 255) return false;
    uint32_t other = mw_mesh_neighbour(line->mesh, piece->triangle, piece->along, NULL);
    return other != MW_NONE && triangle_has_ground(line, other);
}

/* Is the terrain above the line where a piece begins or ends? *last is the place of the previous
 * call. */
static bool piece_hides(const mw_sight_line *line, const mw_segment_piece *piece, int end,
                        sight_place *last)
{
    uint32_t v[3];
    uint8_t at = end ? piece->to_at : piece->from_at;
    if (at == MW_AT_INSIDE) return false;
    mw_mesh_triangle(line->mesh, piece->triangle, v);
    if (!piece_has_ground(line, piece)) return false;
    sight_place place = place_of(v, at);
    if (place.v == last->v && place.w == last->w) return false;
    *last = place;
    return (place.v == place.w ? mw__sight_vertex_sign(line, place.v)
                               : mw__sight_edge_sign(line, place.v, place.w)) > 0;
}

static mw_sight sight_follow(mw_viewpoint *view, const mw_sight_line *line)
{
    mw_segment segment;
    mw_segment_piece piece;
    sight_place last = {MW_NONE, MW_NONE};
    const double b[2] = {line->b.at.x, line->b.at.y};
    if (mw_segment_begin(view->locator, &view->here, view->at, b, &segment, NULL) != MW_OK)
        return (mw_sight){.at = 1, .triangle = MW_NONE, .state = MW_SIGHT_UNKNOWN};
    while (mw_segment_next(&segment, &piece))
        for (int end = 0; end < 2; end++)
            if (piece_hides(line, &piece, end, &last))
                return (mw_sight){.at = end ? piece.to : piece.from,
                                  .triangle = piece.triangle,
                                  .state = MW_SIGHT_HIDDEN};
    return (mw_sight){.at = 1, .triangle = MW_NONE, .state = MW_SIGHT_VISIBLE};
}

mw_sight mw_sight_to(mw_viewpoint *view, const mw_sight_end *to)
{
    mw_sight unknown = {.at = 1, .triangle = MW_NONE, .state = MW_SIGHT_UNKNOWN};
    mw_point a = {view->at[0], view->at[1]}, b = {to->x, to->y};
    double ground = 0;
    mw_sight_line line = {.mesh = view->locator->mesh,
                          .heights = view->heights,
                          .a = {a, view->height, view->unsure, view->offset, view->triangle}};
    if (!isfinite(to->x) || !isfinite(to->y) || !isfinite(to->height)) return unknown;
    uint32_t grounded = sight_ground(view->locator, view->heights, &view->there, b, &ground);
    if (grounded == MW_NONE && !to->absolute) return unknown;
    if (!sight_find_level(&line, to, grounded, ground, &line.b))
        return (mw_sight){.at = 1, .triangle = grounded, .state = MW_SIGHT_HIDDEN};
    if (a.x == b.x && a.y == b.y)
        return (mw_sight){.at = 1, .triangle = MW_NONE, .state = MW_SIGHT_VISIBLE};
    return sight_follow(view, &line);
}
