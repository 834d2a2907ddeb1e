/* nearest.c - the point of a surface nearest to a point: branch and bound on the boxes.
 *
 * Distances are rounded, and still the answer does not depend on the boxes. The distance of a triangle is that from q to
 * a point p of it, as rounded; p may be off, but is kept within the triangle's own box. So a box at a rounded distance
 * from q holds no triangle at a smaller one, but for the few roundings that the margins here cover. */
#include "surface/prober.h"

/* --- the nearest point of a triangle ------------------------------------------------------------------------------ */

/* The corners and q, scaled so that squares of their differences neither overflow nor, where it matters, underflow. */
typedef struct frame {
    double a[3][3], q[3];
} frame;

/* A point of the triangle, by weights, and how far it is from q. */
typedef struct candidate {
    double weight[3], point[3], distance;
} candidate;

static double dot(const double u[3], const double v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

static void subtract(double r[3], const double u[3], const double v[3])
{
    for (int k = 0; k < 3; k++) r[k] = u[k] - v[k];
}

/* 0 to 1; NaN, of 0 / 0 in a triangle without extent, becomes 0. */
static double clamp(double x)
{
    return x > 0 ? x < 1 ? x : 1 : 0;
}

/* sqrt(x x + y y + z z), off by less than 2^-50 of itself. */
static double length(double x, double y, double z)
{
    double square = x * x + y * y + z * z;
    return square > 0x1p-900 && square < 0x1p1000 ? sqrt(square) : hypot(hypot(x, y), z);
}

/* The point with these weights, kept within the triangle's box, if it is nearer than *best. */
static void try_weights(candidate *best, const mw_corners corner, const double q[3], double u, double v, double w)
{
    candidate c = {.weight = {u, v, w}};
    for (int k = 0; k < 3; k++) {
        double x = corner[0][k], y = corner[1][k], z = corner[2][k], at = u * x + v * y + w * z;
        double low = x < y ? x : y, high = x < y ? y : x;
        low = z < low ? z : low;
        high = z > high ? z : high;
        c.point[k] = at < low ? low : at > high ? high : at;
    }
    c.distance = length(c.point[0] - q[0], c.point[1] - q[1], c.point[2] - q[2]);
    if (c.distance < best->distance) *best = c;
}

static void try_edge(candidate *best, const mw_corners corner, const frame *f, const double q[3], int edge)
{
    int next = (edge + 1) % 3;
    double along[3], to[3], weight[3] = {0, 0, 0};
    subtract(along, f->a[next], f->a[edge]);
    subtract(to, f->q, f->a[edge]);
    weight[next] = clamp(dot(to, along) / dot(along, along));
    weight[edge] = 1 - weight[next];
    try_weights(best, corner, q, weight[0], weight[1], weight[2]);
}

/* Take off v its part along u; how many times u that is. */
static double take_off(double v[3], const double u[3], double square_of_u)
{
    double times = dot(v, u) / square_of_u;
    for (int k = 0; k < 3; k++) v[k] -= times * u[k];
    return times;
}

/* The foot of the perpendicular, where it lies inside. The axes are the longest edge, and what is perpendicular to it of another
 * one; that is found in two rounds, for in a thin triangle next to nothing is left of the other edge, and that would be
 * perpendicular in its first digits only. So the foot is off by a few roundings of coordinates, however thin. */
static void try_face(candidate *best, const mw_corners corner, const frame *f, const double q[3])
{
    double edge[3][3], square[3], up[3], to[3], weight[3];
    for (int k = 0; k < 3; k++) {
        subtract(edge[k], f->a[(k + 1) % 3], f->a[k]);
        square[k] = dot(edge[k], edge[k]);
    }
    int i = square[0] >= square[1] ? square[0] >= square[2] ? 0 : 2 : square[1] >= square[2] ? 1 : 2;
    subtract(up, f->a[(i + 2) % 3], f->a[i]);
    subtract(to, f->q, f->a[i]);
    double slope = take_off(up, edge[i], square[i]);
    slope += take_off(up, edge[i], square[i]);
    double along = take_off(to, edge[i], square[i]), height = dot(to, up) / dot(up, up);
    along -= slope * height;
    if (!(height > 0 && along > 0 && height + along < 1)) return;
    weight[i] = 1 - along - height;
    weight[(i + 1) % 3] = along;
    weight[(i + 2) % 3] = height;
    try_weights(best, corner, q, weight[0], weight[1], weight[2]);
}

static frame make_frame(const mw_corners corner, const double q[3])
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        largest = fmax(largest, fabs(q[k]));
        for (int i = 0; i < 3; i++) largest = fmax(largest, fabs(corner[i][k]));
    }
    bool extreme = largest > 0x1p400 || (largest < 0x1p-300 && largest > 0);
    int exponent = extreme ? ilogb(largest) : 0;
    double scale = ldexp(1, exponent > -1000 ? -exponent : 1000);
    frame f;
    for (int k = 0; k < 3; k++) {
        f.q[k] = q[k] * scale;
        for (int i = 0; i < 3; i++) f.a[i][k] = corner[i][k] * scale;
    }
    return f;
}

/* The nearest of the foot of the perpendicular, if inside, and of the nearest points of the edges. */
static candidate nearest_of_triangle(const mw_corners corner, const double q[3])
{
    frame f = make_frame(corner, q);
    candidate best = {{1, 0, 0}, {corner[0][0], corner[0][1], corner[0][2]}, INFINITY};
    for (int edge = 0; edge < 3; edge++) try_edge(&best, corner, &f, q, edge);
    try_face(&best, corner, &f, q);
    return best;
}

/* --- the search --------------------------------------------------------------------------------------------------- */

/* Bounds are in the frame of the boxes, and rounded as for lines (certain.c). Distances are off by 2^-50 of themselves. */
#define REACH_ERROR (1 + 0x1p-40)

typedef struct search {
    const mw_prober *prober;
    const double *point;
    double q[3], width, reach; /* in the frame */
    double max_distance;
    uint32_t best;
    candidate nearest;
} search;

static void set_reach(search *s, double distance)
{
    double scale = s->prober->boxes.scale;
    s->reach = (distance + MW_SURFACE_TINY_LENGTH) * scale * REACH_ERROR + MW_SURFACE_LEAST_WIDTH;
}

/* How far q is from the box of a triangle: less than from the triangle, but for REACH_ERROR. */
static double distance_to_corners_box(const mw_corners corner, const double q[3])
{
    double away[3];
    for (int k = 0; k < 3; k++) {
        double x = corner[0][k], y = corner[1][k], z = corner[2][k];
        double low = x < y ? x : y, high = x < y ? y : x;
        low = z < low ? z : low;
        high = z > high ? z : high;
        away[k] = q[k] < low ? low - q[k] : q[k] > high ? q[k] - high : 0;
    }
    return length(away[0], away[1], away[2]);
}

/* Less than the distance of q to all that is in a box. */
static double distance_to_box(const search *s, const mw_surface_box *box)
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double below = (double)box->low[k] - s->q[k], above = s->q[k] - (double)box->high[k];
        double away = (below > above ? below : above) - s->width;
        if (away > 0) square += away * away;
    }
    return sqrt(square);
}

static void look_at_triangle(search *s, uint32_t t)
{
    const mw_surface *surface = s->prober->surface;
    if (!mw__corners_finite(surface, t)) return;
    const mw_corners corner = {mw__surface_corner(surface, t, 0), mw__surface_corner(surface, t, 1),
                               mw__surface_corner(surface, t, 2)};
    if (distance_to_corners_box(corner, s->point) > s->nearest.distance * REACH_ERROR) return;
    candidate c = nearest_of_triangle(corner, s->point);
    if (c.distance > s->max_distance || c.distance > s->nearest.distance) return;
    if (c.distance == s->nearest.distance && t >= s->best) return;
    if (mw__collinear3(corner[0], corner[1], corner[2])) return;
    s->best = t;
    s->nearest = c;
    set_reach(s, c.distance);
}

static void look_into(search *s, mw_surface_box_stack *stack, mw_surface_box_visit visit)
{
    const mw_surface_boxes *boxes = &s->prober->boxes;
    uint32_t first, end = mw__surface_boxes_below(boxes, visit.level, visit.box, &first), floor = stack->count;
    if (visit.level == 0) {
        for (uint32_t i = first; i < end; i++) look_at_triangle(s, mw__surface_boxes_triangle(boxes, i));
        return;
    }
    mw_surface_box_visit below = {0, visit.level - 1, 0};
    for (below.box = first; below.box < end; below.box++) {
        below.near = distance_to_box(s, mw__surface_box(boxes, below.level, below.box));
        if (below.near <= s->reach) mw__surface_box_push(stack, floor, below);
    }
}

static void search_boxes(search *s)
{
    const mw_prober *prober = s->prober;
    s->width = mw__surface_boxes_aim(&prober->boxes, s->point, prober->slack, s->q);
    set_reach(s, s->max_distance);
    mw_surface_box_stack stack = {.count = 1, .visit[0] = {0, prober->boxes.level_count - 1, 0}};
    while (stack.count) {
        mw_surface_box_visit visit = stack.visit[--stack.count];
        if (visit.near <= s->reach) look_into(s, &stack, visit);
    }
}

mw_status mw_nearest_on_surface(const mw_prober *prober, const double point[3], double max_distance,
                                mw_surface_hit *hit, mw_error *error)
{
    if (!prober || !point || !hit) return mw__fail(error, MW_ERROR_ARGUMENT, "no prober, no point or no place for it");
    *hit = (mw_surface_hit){MW_NONE, NAN, {NAN, NAN, NAN}, {NAN, NAN, NAN}};
    if (!prober->has_boxes)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the nearest point needs a prober with options.boxes");
    if (!(max_distance >= 0)) return mw__fail(error, MW_ERROR_ARGUMENT, "the distance is not a length");
    if (!mw__is_finite3(point)) return MW_OK;
    search s = {.prober = prober,
                .point = point,
                .max_distance = max_distance,
                .best = MW_NONE,
                .nearest = {.distance = INFINITY}};
    mw__surface_enter(prober->surface);
    bool current = prober->version == prober->surface->version;
    if (current) search_boxes(&s);
    mw__surface_leave(prober->surface);
    if (!current) return mw__fail(error, MW_ERROR_ARGUMENT, "the boxes are not up to date: mw_prober_update");
    if (s.best == MW_NONE) return MW_OK;
    *hit = (mw_surface_hit){.triangle = s.best, .distance = s.nearest.distance};
    for (int k = 0; k < 3; k++) {
        hit->point[k] = s.nearest.point[k];
        hit->weight[k] = s.nearest.weight[k];
    }
    return MW_OK;
}
