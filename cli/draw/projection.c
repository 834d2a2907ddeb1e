/* projection.c - chooses the position of the eye: in front of the walk, along the mean normal of
 * its triangles. */
#include "cli/draw/projection.h"

#include <math.h>
#include <string.h>

/* --- vectors ---------------------------------------------------------------------------------- */

static double vector_inner(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void vector_outer(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++)
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* False for one without length. */
static bool direction_normalise(double a[3])
{
    double length = sqrt(vector_inner(a, a));
    if (!(length > 1e-150) || !isfinite(length)) return false;
    for (int k = 0; k < 3; k++) a[k] /= length;
    return true;
}

/* --- the view --------------------------------------------------------------------------------- */

static void projection_measure(projection *p)
{
    const drawing *d = p->d;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * d->triangle_count; i++)
        for (size_t k = 0; k < 3; k++) {
            double x = d->points[3 * (size_t)d->triangles[i] + k];
            if (!isfinite(x)) continue;
            low[k] = fmin(low[k], x);
            high[k] = fmax(high[k], x);
        }
    p->size = 0;
    for (int k = 0; k < 3; k++) {
        p->middle[k] = low[k] <= high[k] ? low[k] / 2 + high[k] / 2 : 0;
        if (d->view != VIEW_PLANE || k < 2) p->size = fmax(p->size, high[k] / 2 - low[k] / 2);
    }
    if (!(p->size > 0)) p->size = 1;
}

/* A point in the cube. */
static void projection_project(const projection *p, const double *point, double cube[3])
{
    for (int k = 0; k < 3; k++) cube[k] = (point[k] - p->middle[k]) / p->size;
}

static void triangle_corners_in_cube(const projection *p, uint32_t triangle, double corner[3][3])
{
    const uint32_t *v = p->d->triangles + 3 * (size_t)triangle;
    for (size_t k = 0; k < 3; k++)
        projection_project(p, p->d->points + 3 * (size_t)v[k], corner[k]);
}

/* Of length 1, on the front; zero where there is no area. */
static void projected_normal(const projection *p, uint32_t triangle, double n[3])
{
    double corner[3][3], a[3], b[3], c[3];
    triangle_corners_in_cube(p, triangle, corner);
    for (int k = 0; k < 3; k++) {
        a[k] = corner[1][k] - corner[0][k];
        b[k] = corner[2][k] - corner[0][k];
    }
    vector_outer(a, b, n);
    if (!direction_normalise(n)) memset(n, 0, 3 * sizeof *n);
    if (p->d->view != VIEW_STAR) return;
    projection_project(p, p->d->centre, c);
    for (int k = 0; k < 3; k++) a[k] = corner[0][k] - c[k];
    if (vector_inner(a, n) < 0)
        for (int k = 0; k < 3; k++) n[k] = -n[k];
}

/* From the centre to the middle of a facet, of length 1. */
static void triangle_direction(const projection *p, uint32_t triangle, double n[3])
{
    double corner[3][3], c[3];
    triangle_corners_in_cube(p, triangle, corner);
    projection_project(p, p->d->centre, c);
    for (int k = 0; k < 3; k++) n[k] = (corner[0][k] + corner[1][k] + corner[2][k]) / 3 - c[k];
    if (!direction_normalise(n)) memset(n, 0, 3 * sizeof *n);
}

static void visit_look(const projection *p, size_t visit, double n[3])
{
    if (p->d->view == VIEW_STAR)
        triangle_direction(p, p->d->path[visit], n);
    else
        projected_normal(p, p->d->path[visit], n);
}

/* If a walk goes all round a surface, the normals of its triangles cancel out: then the normal of
 * the last one is used. */
static void projection_mean_look(const projection *p, double eye[3])
{
    double n[3], sum[3] = {0, 0, 0};
    size_t count = p->d->path_count;
    for (size_t i = 0; i < count; i++) {
        visit_look(p, i, n);
        for (int k = 0; k < 3; k++) sum[k] += n[k];
    }
    memcpy(eye, sum, sizeof sum);
    if (count && vector_inner(sum, sum) < 0.09 * (double)count * (double)count)
        visit_look(p, count - 1, eye);
    if (!direction_normalise(eye)) memcpy(eye, (const double[]){0, 0, 1}, sizeof sum);
}

/* The upward direction on the page: north on a globe, else y, which is up in most models. */
static void projection_choose_up(const projection *p, const double eye[3], double up[3])
{
    double unit[3] = {0, 0, 0};
    int first = p->d->view == VIEW_STAR ? 2 : 1, axis = fabs(eye[first]) < 0.9 ? first : 3 - first;
    unit[axis] = 1;
    for (int k = 0; k < 3; k++) up[k] = unit[k] - eye[k] * eye[axis];
    direction_normalise(up);
}

/* A probe's line should be visible as a line: if the eye looks along it, move the eye aside. */
static void projection_step_aside(const projection *p, double eye[3])
{
    double from[3], to[3], line[3], up[3], side[3];
    projection_project(p, p->d->line, from);
    projection_project(p, p->d->line + 3 * (p->d->line_count - 1), to);
    for (int k = 0; k < 3; k++) line[k] = to[k] - from[k];
    if (!direction_normalise(line) || fabs(vector_inner(line, eye)) < 0.85) return;
    projection_choose_up(p, eye, up);
    vector_outer(up, eye, side);
    for (int k = 0; k < 3; k++) eye[k] += 0.55 * side[k] + 0.25 * up[k];
    direction_normalise(eye);
}

static void projection_choose_view(projection *p)
{
    double eye[3] = {0, 0, 1}, up[3] = {0, 1, 0}, right[3];
    if (p->d->view != VIEW_PLANE) {
        projection_mean_look(p, eye);
        if (p->d->view == VIEW_SURFACE) projection_step_aside(p, eye);
        projection_choose_up(p, eye, up);
    }
    vector_outer(up, eye, right);
    memcpy(p->axis[0], right, sizeof right);
    memcpy(p->axis[1], up, sizeof up);
    memcpy(p->axis[2], eye, sizeof eye);
}

projection projection_make(const drawing *d)
{
    projection p = {.d = d};
    projection_measure(&p);
    projection_choose_view(&p);
    return p;
}

/* --- what the eye sees ------------------------------------------------------------------------ */

page_point projection_at(const projection *p, const double *point)
{
    double cube[3];
    projection_project(p, point, cube);
    if (p->d->view == VIEW_PLANE) return (page_point){cube[0], cube[1], 0};
    return (page_point){vector_inner(p->axis[0], cube), vector_inner(p->axis[1], cube),
                        vector_inner(p->axis[2], cube)};
}

bool projection_turns_back(const projection *p, uint32_t triangle)
{
    double n[3];
    if (p->d->view == VIEW_PLANE) return false;
    projected_normal(p, triangle, n);
    return vector_inner(n, p->axis[2]) < 0;
}

bool projection_shows(const projection *p, const double *point)
{
    double c[3], at[3];
    if (p->d->view != VIEW_STAR) return true;
    projection_project(p, p->d->centre, c);
    projection_project(p, point, at);
    for (int k = 0; k < 3; k++) at[k] -= c[k];
    return vector_inner(at, p->axis[2]) >= 0;
}
