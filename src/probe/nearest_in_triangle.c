/* nearest_in_triangle.c - the point of a triangle nearest to a point.
 *
 * All computation uses the differences between q and the corners, not coordinates. So the distance
 * loses no digits if the triangle is far from the origin, or much larger than its distance. A
 * difference of two coordinates is exact, and a product of two differences nearly so (an `offset`).
 * Only the rest after cancellation is rounded. */
#include "probe/nearest_in_triangle.h"

/* --- vectors --- */

/* head + tail, where head is the rounded sum. A difference of two points has no error; a product
 * with one has an error of 2^-100. */
typedef struct offset {
    double head[3], tail[3];
} offset;

static double vector_dot(const double u[3], const double v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/* Returns a + b, rounded. *tail becomes the rounding error [Knuth]. */
static double offset_two_sum(double a, double b, double *tail)
{
    double sum = a + b, of_b = sum - a;
    *tail = (a - (sum - of_b)) + (b - of_b);
    return sum;
}

static double offset_two_product(double a, double b, double *tail)
{
    double product = a * b;
    *tail = fma(a, b, -product);
    return product;
}

/* (to - from) * scale; the scale is a power of two. */
static offset offset_between(const double from[3], const double to[3], double scale)
{
    offset v;
    for (int k = 0; k < 3; k++) {
        v.head[k] = offset_two_sum(to[k], -from[k], &v.tail[k]) * scale;
        v.tail[k] *= scale;
    }
    return v;
}

/* u x v, off by less than 2^-100 |u| |v|, however much cancels. v x u is exactly the opposite, so
 * that both triangles at an edge find the same distance to it. */
static offset offset_cross(const offset *u, const offset *v)
{
    offset r;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        double plus_tail, minus_tail, tail;
        double plus = offset_two_product(u->head[i], v->head[j], &plus_tail);
        double minus = offset_two_product(u->head[j], v->head[i], &minus_tail);
        double sum = offset_two_sum(plus, -minus, &tail);
        tail += plus_tail - minus_tail;
        tail += (u->head[i] * v->tail[j] - u->tail[j] * v->head[i]) +
                (u->tail[i] * v->head[j] - u->head[j] * v->tail[i]);
        r.head[k] = offset_two_sum(sum, tail, &r.tail[k]);
    }
    return r;
}

/* u . v, off by less than 2^-100 |u| |v| and 2^-52 of itself. */
static double offset_dot(const offset *u, const offset *v)
{
    double sum = 0, tails = 0;
    for (int k = 0; k < 3; k++) {
        double of_product, of_sum,
            product = offset_two_product(u->head[k], v->head[k], &of_product);
        sum = offset_two_sum(sum, product, &of_sum);
        tails += of_sum + of_product + (u->head[k] * v->tail[k] + u->tail[k] * v->head[k]);
    }
    return sum + tails;
}

/* sqrt(x x + y y + z z), off by less than 2^-50 of itself. */
static double vector_length(double x, double y, double z)
{
    double square = x * x + y * y + z * z;
    return square > 0x1p-900 && square < 0x1p1000 ? sqrt(square) : hypot(hypot(x, y), z);
}

/* --- the nearest point of a triangle --- */

/* A triangle as seen from q, in a unit of about its size: the distance of its farthest corner. An
 * edge shorter than SHORT_EDGE counts as its ends, and a triangle with less height than
 * LEAST_HEIGHT of its longest edge as its edges. This costs less than 2^-50 of the size. For all
 * others the 2^-100 of products does not matter. */
typedef struct triangle_view {
    /* Lengths are scaled by both, powers of two; `before` keeps them in range. */
    double before, after;
    double q[3];               /* scaled by `before` */
    offset corner[3], edge[3]; /* corners from q; edge k starts at corner k */
    double square[3];          /* squared lengths of the edges */
} triangle_view;

#define SHORT_EDGE 0x1p-50
#define LEAST_HEIGHT 0x1p-51
/* Of the longest edge: the square of its square, and of an area, does not underflow. */
#define LEAST_SQUARE 0x1p-450

/* A point of the triangle: its weights, and its position from q in the unit of the view. */
typedef struct nearest_candidate {
    double weight[3], away[3];
} nearest_candidate;

static double larger_value(double x, double y)
{
    return x > y ? x : y;
}

static double largest_coordinate(const mw_corners corner, const double q[3])
{
    double largest = 0;
    for (int k = 0; k < 3; k++) {
        largest = larger_value(largest, fabs(q[k]));
        for (int i = 0; i < 3; i++) largest = larger_value(largest, fabs(corner[i][k]));
    }
    return largest;
}

static void triangle_view_from(triangle_view *v, const double q[3], const mw_corners corner)
{
    double at[3][3], size = 0;
    v->before = largest_coordinate(corner, q) < 0x1p920 ? 0x1p100 : 0x1p-4;
    for (int k = 0; k < 3; k++) {
        v->q[k] = q[k] * v->before;
        for (int i = 0; i < 3; i++) {
            at[i][k] = corner[i][k] * v->before;
            size = larger_value(size, fabs(at[i][k] - v->q[k]));
        }
    }
    v->after = size > 0 ? ldexp(1, -ilogb(size)) : 1;
    for (int i = 0; i < 3; i++) {
        v->corner[i] = offset_between(v->q, at[i], v->after);
        v->edge[i] = offset_between(at[i], at[(i + 1) % 3], v->after);
        v->square[i] = vector_dot(v->edge[i].head, v->edge[i].head);
    }
}

static nearest_candidate nearest_on_corner(const triangle_view *v, int i)
{
    const double *p = v->corner[i].head;
    nearest_candidate c = {.away = {p[0], p[1], p[2]}};
    c.weight[i] = 1;
    return c;
}

/* The position of the foot of the perpendicular on an edge from p, 0 to 1. An end if it lies
 * beyond, or the edge is short. */
static double foot_along_edge(const triangle_view *v, int i)
{
    double square = v->square[i], along = -vector_dot(v->corner[i].head, v->edge[i].head) / square;
    if (square > SHORT_EDGE * SHORT_EDGE) return along > 0 ? along < 1 ? along : 1 : 0;
    return along < 0.5 ? 0 : 1;
}

/* The foot: p without its part along e is e x (p x r) / |e|^2, where r is the other end. */
static nearest_candidate nearest_on_edge(const triangle_view *v, int i, double along)
{
    int j = (i + 1) % 3;
    if (along == 0 || along == 1) return nearest_on_corner(v, along == 0 ? i : j);
    const double *e = v->edge[i].head;
    offset m = offset_cross(&v->corner[i], &v->corner[j]);
    nearest_candidate c = {.weight = {0}};
    c.weight[i] = 1 - along;
    c.weight[j] = along;
    for (int k = 0; k < 3; k++) {
        int x = (k + 1) % 3, y = (k + 2) % 3;
        c.away[k] = (e[x] * m.head[y] - e[y] * m.head[x]) / v->square[i];
    }
    return c;
}

/* Rounded points decide which edge is nearest. An edge that is wrongly chosen is farther by a few
 * roundings of the size. */
static nearest_candidate nearest_on_edges(const triangle_view *v)
{
    double least = INFINITY, along = 0;
    int nearest = 0;
    for (int i = 0; i < 3; i++) {
        const double *p = v->corner[i].head, *e = v->edge[i].head;
        double t = foot_along_edge(v, i),
               away[3] = {p[0] + t * e[0], p[1] + t * e[1], p[2] + t * e[2]};
        double square = vector_dot(away, away);
        if (square >= least) continue;
        least = square;
        nearest = i;
        along = t;
    }
    return nearest_on_edge(v, nearest, along);
}

/* The foot of the perpendicular on the plane, if it lies inside the triangle. It is found along the
 * longest edge e, and along `up` = n x e, which is perpendicular to e and |e|^2 times as long as
 * the height. In a thin triangle only n tells the direction of `up`, and n is as good as the
 * coordinates allow. So the foot is off by a few roundings of the size, however thin the triangle
 * is. */
static bool nearest_on_face(const triangle_view *v, nearest_candidate *c)
{
    const double *square = v->square;
    int i = square[0] >= square[1]   ? square[0] >= square[2] ? 0 : 2
            : square[1] >= square[2] ? 1
                                     : 2;
    int j = (i + 1) % 3, apex = (i + 2) % 3;
    const double *e = v->edge[i].head, *back = v->edge[apex].head;
    offset normal = offset_cross(&v->edge[apex], &v->edge[i]);
    const double *n = normal.head, *p = v->corner[i].head;
    double square_n = vector_dot(n, n), least = LEAST_HEIGHT * square[i];
    if (!(square[i] > LEAST_SQUARE && square_n > least * least)) return false;
    double up[3] = {n[1] * e[2] - n[2] * e[1], n[2] * e[0] - n[0] * e[2],
                    n[0] * e[1] - n[1] * e[0]};
    double height = -vector_dot(p, up) / square_n, slope = -vector_dot(back, e) / square[i];
    double along = -vector_dot(p, e) / square[i] - slope * height;
    if (!(height > 0 && along > 0 && height + along < 1)) return false;
    double times = offset_dot(&normal, &v->corner[i]) / square_n;
    *c = (nearest_candidate){.away = {n[0] * times, n[1] * times, n[2] * times}};
    c->weight[i] = 1 - along - height;
    c->weight[j] = along;
    c->weight[apex] = height;
    return true;
}

static void corners_box(const mw_corners corner, int k, double *low, double *high)
{
    double x = corner[0][k], y = corner[1][k], z = corner[2][k];
    *low = x < y ? x : y;
    *high = x < y ? y : x;
    *low = z < *low ? z : *low;
    *high = z > *high ? z : *high;
}

double mw__distance_to_corners_box(const mw_corners corner, const double q[3])
{
    double away[3], low, high;
    for (int k = 0; k < 3; k++) {
        corners_box(corner, k, &low, &high);
        away[k] = q[k] < low ? low - q[k] : q[k] > high ? q[k] - high : 0;
    }
    return vector_length(away[0], away[1], away[2]);
}

/* The point of a candidate: a corner exactly; else q and the vector from q, clamped to the box of
 * the triangle. */
static void candidate_point(double point[3], const nearest_candidate *c, const triangle_view *v,
                            const mw_corners corner)
{
    for (int k = 0; k < 3; k++) {
        double low, high, at = (v->q[k] + c->away[k] / v->after) / v->before;
        corners_box(corner, k, &low, &high);
        point[k] = at < low ? low : at > high ? high : at;
        for (int i = 0; i < 3; i++)
            if (c->weight[i] == 1) point[k] = corner[i][k];
    }
}

mw_nearest_surface_point mw__nearest_in_triangle(const mw_corners corner, const double q[3],
                                                 double least)
{
    triangle_view v;
    triangle_view_from(&v, q, corner);
    nearest_candidate c;
    if (!nearest_on_face(&v, &c)) c = nearest_on_edges(&v);
    double distance = vector_length(c.away[0], c.away[1], c.away[2]) / v.after / v.before;
    mw_nearest_surface_point hit = {.distance = larger_value(distance, least),
                                    .weight = {c.weight[0], c.weight[1], c.weight[2]}};
    candidate_point(hit.point, &c, &v, corner);
    return hit;
}

double mw__distance_to_triangle(const mw_surface *surface, uint32_t t, const double q[3])
{
    const mw_corners corner = {mw__surface_corner(surface, t, 0), mw__surface_corner(surface, t, 1),
                               mw__surface_corner(surface, t, 2)};
    return mw__nearest_in_triangle(corner, q, mw__distance_to_corners_box(corner, q)).distance;
}

/* --- a triangle that is farther --- */

/* About the point nearest to the origin of the triangle with corners a, b, c, by the region of the
 * triangle that it lies in [Ericson 2005, sec. 5.1]. Rounded, and wrong where the triangle is
 * thin. */
static void nearest_roughly(const double a[3], const double b[3], const double c[3],
                            double nearest[3])
{
    double ab[3], ac[3], s = 0, t = 0;
    for (int k = 0; k < 3; k++) {
        ab[k] = b[k] - a[k];
        ac[k] = c[k] - a[k];
    }
    double b_a = -vector_dot(ab, a), c_a = -vector_dot(ac, a), b_b = -vector_dot(ab, b),
           c_b = -vector_dot(ac, b), b_c = -vector_dot(ab, c), c_c = -vector_dot(ac, c);
    double of_a = b_b * c_c - b_c * c_b, of_b = b_c * c_a - b_a * c_c, of_c = b_a * c_b - b_b * c_a;
    if (b_a <= 0 && c_a <= 0) {
        s = t = 0;
    } else if (b_b >= 0 && c_b <= b_b) {
        s = 1;
    } else if (c_c >= 0 && b_c <= c_c) {
        t = 1;
    } else if (of_c <= 0 && b_a >= 0 && b_b <= 0) {
        s = b_a / (b_a - b_b);
    } else if (of_b <= 0 && c_a >= 0 && c_c <= 0) {
        t = c_a / (c_a - c_c);
    } else if (of_a <= 0 && c_b >= b_b && b_c >= c_c) {
        t = (c_b - b_b) / ((c_b - b_b) + (b_c - c_c));
        s = 1 - t;
    } else {
        double all = of_a + of_b + of_c;
        s = of_b / all;
        t = of_c / all;
    }
    for (int k = 0; k < 3; k++) nearest[k] = a[k] + s * ab[k] + t * ac[k];
}

/* Squares and lengths between these do not leave the range of doubles here. */
#define LEAST_ROUGH 0x1p-300
#define MOST_ROUGH 0x1p300

/* For any vector u the triangle is at least as far as the least of its corners along u, and for u
 * to its nearest point it is no farther: so u need not be right, only the products with it, whose
 * errors are less than 2^-50 of |u| times the farthest corner. The distance is off by less than
 * 2^-48 of that. */
bool mw__triangle_is_farther(const mw_corners corner, const double q[3], double than)
{
    double at[3][3], u[3], far = 0;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) at[i][k] = corner[i][k] - q[k];
        far = larger_value(far, fabs(at[i][0]) + fabs(at[i][1]) + fabs(at[i][2]));
    }
    nearest_roughly(at[0], at[1], at[2], u);
    double least = vector_dot(u, at[0]), square = vector_dot(u, u);
    for (int i = 1; i < 3; i++) {
        double along = vector_dot(u, at[i]);
        least = along < least ? along : least;
    }
    if (!(square > LEAST_ROUGH && square < MOST_ROUGH && far < MOST_ROUGH)) return false;
    return least > sqrt(square) * (than + 0x1p-44 * far);
}
