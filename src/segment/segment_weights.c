/* segment_weights.c - the ends of a piece as weights of its triangle's vertices. */
#include "locate/location.h"
#include "segment/segment_parameter.h"

#include <meshwalk/segment.h>

/* Both ends of the edge are on the line: a, b, or a vertex inside the edge of a triangle that is
 * cut into tiles. */
static double weights_at_parameter(const double a[2], const double b[2], double t, const double *p,
                                   const double *q)
{
    int k = fabs(q[0] / 2 - p[0] / 2) >= fabs(q[1] / 2 - p[1] / 2) ? 0 : 1;
    double at = a[k] * (1 - t) + b[k] * t, share = (at / 2 - p[k] / 2) / (q[k] / 2 - p[k] / 2);
    return fmin(fmax(share, 0), 1);
}

/* How far a vertex is off the line of the segment, over 2^*exponent. */
static double weights_distance(mw_point a, mw_point b, mw_point v, int *exponent)
{
    return fabs(mw__orient2d_fraction(a, b, v, exponent));
}

/* Weights of two vertices of an edge, by how far they are off the line: nothing cancels. False if
 * one of them is on the line. */
static bool weights_on_edge(mw_point a, mw_point b, mw_point p, mw_point q, double *of_p,
                            double *of_q)
{
    double far_p = fabs(mw__segment_area(a, b, p)), far_q = fabs(mw__segment_area(a, b, q));
    if (far_p == 0 || far_q == 0) return false;
    if (MW_UNLIKELY(!(fmin(far_p, far_q) > MW_AREA_LEAST && far_p + far_q < MW_AREA_MOST))) {
        int scale_p, scale_q;
        far_p = weights_distance(a, b, p, &scale_p);
        far_q = weights_distance(a, b, q, &scale_q);
        int most = scale_p > scale_q ? scale_p : scale_q;
        far_p = ldexp(far_p, scale_p - most);
        far_q = ldexp(far_q, scale_q - most);
    }
    *of_p = far_q / (far_p + far_q);
    *of_q = far_p / (far_p + far_q);
    return true;
}

/* On the edge from vertex p to q. False at a or b. */
static bool weights_between(const double *a, const double *b, double t, const double *p,
                            const double *q, double *of_p, double *of_q)
{
    if (weights_on_edge((mw_point){a[0], a[1]}, (mw_point){b[0], b[1]}, (mw_point){p[0], p[1]},
                        (mw_point){q[0], q[1]}, of_p, of_q))
        return true;
    if (t == 0 || t == 1) return false;
    *of_q = weights_at_parameter(a, b, t, p, q);
    *of_p = 1 - *of_q;
    return true;
}

/* The point of an edge by its weights: the same from both sides, and not rounded off an edge along
 * an axis. */
static void weights_place(const double *p, const double *q, double of_p, double of_q, double at[2])
{
    bool forward = p[0] != q[0] ? p[0] < q[0] : p[1] < q[1];
    const double *low = forward ? p : q, *high = forward ? q : p;
    for (int i = 0; i < 2; i++) {
        double across = high[i] - low[i];
        at[i] = isfinite(across) ? low[i] + across * (forward ? of_q : of_p)
                                 : of_p * p[i] + of_q * q[i];
    }
}

void mw_segment_weights(const mw_mesh *mesh, const double a[2], const double b[2],
                        const mw_segment_piece *piece, int end, double weight[3], double point[2])
{
    uint8_t at = end ? piece->to_at : piece->from_at;
    const double *place = end ? b : a;
    double corner[3][2], on_edge[2];
    uint32_t v[3], q = at < MW_AT_VERTEX ? (at + 1u) % 3 : 0;
    mw_mesh_triangle(mesh, piece->triangle, v);
    for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], corner[k]);
    weight[0] = weight[1] = weight[2] = 0;
    if (at >= MW_AT_VERTEX && at < MW_AT_INSIDE) {
        weight[at - MW_AT_VERTEX] = 1;
        place = corner[at - MW_AT_VERTEX];
    } else if (at < MW_AT_VERTEX && weights_between(a, b, end ? piece->to : piece->from, corner[at],
                                                    corner[q], &weight[at], &weight[q])) {
        weights_place(corner[at], corner[q], weight[at], weight[q], on_edge);
        place = on_edge;
    } else {
        mw_location location =
            mw__location_in_triangle(mesh, piece->triangle, (mw_point){place[0], place[1]});
        memcpy(weight, location.weight, sizeof location.weight);
    }
    if (point) memcpy(point, place, 2 * sizeof *point);
}
