#include "bench/space/space_model.h"
#include "bench/data/dataset_random.h"
#include "bench/data/polyhedra.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- models ----------------------------------------------------------------------------------- */

static void model_bound(space_model *m)
{
    for (int k = 0; k < 3; k++) {
        m->low[k] = INFINITY;
        m->high[k] = -INFINITY;
    }
    for (size_t i = 0; i < 3 * m->point_count; i++) {
        if (!isfinite(m->points[i])) continue;
        m->low[i % 3] = fmin(m->low[i % 3], m->points[i]);
        m->high[i % 3] = fmax(m->high[i % 3], m->points[i]);
    }
}

static int model_copy(space_model *m, const double *points, size_t point_count,
                      const uint32_t *triangles, size_t triangle_count)
{
    size_t point_bytes = 3 * point_count * sizeof *points,
           triangle_bytes = 3 * triangle_count * sizeof *triangles;
    m->points = malloc(point_bytes + 1);
    m->rest = malloc(point_bytes + 1);
    m->triangles = malloc(triangle_bytes + 1);
    if (!m->points || !m->rest || !m->triangles) return fail_memory();
    memcpy(m->points, points, point_bytes);
    memcpy(m->rest, points, point_bytes);
    memcpy(m->triangles, triangles, triangle_bytes);
    m->point_count = point_count;
    m->triangle_count = triangle_count;
    model_bound(m);
    return 0;
}

/* A closed surface has twice as many triangles as vertices, nearly. */
int space_model_make(space_model *m, int kind, size_t triangles, uint64_t seed)
{
    polyhedron made;
    mw_error error;
    size_t vertices = triangles / 2 + 2 < 10 ? 10 : triangles / 2 + 2;
    *m = (space_model){.name = polyhedron_name(kind), .is_star = kind != POLYHEDRON_KNOT};
    mw_status status = polyhedron_make(&made, (polyhedron_kind)kind, vertices, seed, &error);
    if (status != MW_OK) return fail_query(&error);
    int end = model_copy(m, made.points, made.point_count, made.triangles, made.triangle_count);
    polyhedron_release(&made);
    return end;
}

int space_model_read(space_model *m, const char *path)
{
    mw_mesh_file file;
    const char *slash = strrchr(path, '/');
    *m = (space_model){.name = slash ? slash + 1 : path};
    int end = files_read_mesh(path, &file);
    if (end) return end;
    if (file.triangle_count == 0) {
        complain("%s: the mesh has no triangle", path);
        end = END_INPUT;
    }
    if (end == 0)
        end = model_copy(m, file.points, file.point_count, file.triangles, file.triangle_count);
    mw_mesh_file_release(&file);
    return end;
}

void space_model_release(space_model *m)
{
    free(m->points);
    free(m->rest);
    free(m->triangles);
    *m = (space_model){0};
}

mw_arrays space_model_arrays(const space_model *m)
{
    return (mw_arrays){.points = m->points,
                       .point_count = m->point_count,
                       .point_stride = 3,
                       .triangles = m->triangles,
                       .triangle_count = m->triangle_count};
}

/* The middle of the box, and half of its diagonal. */
static double model_middle(const space_model *m, double middle[3])
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double half = m->high[k] / 2 - m->low[k] / 2;
        middle[k] = m->is_star ? 0 : m->low[k] + half;
        square += half * half;
    }
    return sqrt(square);
}

/* --- rays ------------------------------------------------------------------------------------- */

const char *space_rays_name(int kind)
{
    static const char *const names[SPACE_RAYS_KINDS] = {"centre", "random", "stream", "sweep"};
    return kind >= 0 && kind < SPACE_RAYS_KINDS ? names[kind] : NULL;
}

/* Ends of rays are multiples of this part of the size of the model: their differences are then
 * exact, as long as the model is not farther from the origin than 2^22 times its size. */
#define GRID 0x1p-24

/* The ray from one point through another. */
static void ray_set(double *ray, const double from[3], const double through[3], double size)
{
    double unit = ldexp(GRID, ilogb(size));
    for (int k = 0; k < 3; k++) {
        ray[k] = nearbyint(from[k] / unit) * unit;
        ray[3 + k] = nearbyint(through[k] / unit) * unit - ray[k];
    }
}

static void ray_draw_centre(double *ray, double size, uint64_t *random)
{
    static const double origin[3];
    double along[3];
    polyhedron_direction(along, random);
    for (int k = 0; k < 3; k++) along[k] *= size;
    ray_set(ray, origin, along, size);
}

static void ray_draw_random(double *ray, const space_model *m, uint64_t *random)
{
    double middle[3], from[3], through[3], half = model_middle(m, middle);
    polyhedron_direction(from, random);
    for (int k = 0; k < 3; k++) {
        from[k] = middle[k] + 1.5 * half * from[k];
        through[k] = m->low[k] + dataset_unit(random) * (m->high[k] - m->low[k]);
    }
    ray_set(ray, from, through, half);
}

/* Ray i of a picture of `side` columns: lines are drawn to and fro. */
static void ray_draw_stream(double *ray, const space_model *m, size_t i, size_t side)
{
    static const double eye[3] = {0.48, 0.6, 0.64}, right[3] = {0.8, -0.64, 0},
                        up[3] = {0.4096, 0.512, -0.7872};
    size_t row = i / side, column = row % 2 ? side - 1 - i % side : i % side;
    double middle[3], from[3], through[3], half = model_middle(m, middle);
    double x = half * (2 * ((double)column + 0.5) / (double)side - 1),
           y = half * (2 * ((double)row + 0.5) / (double)side - 1);
    for (int k = 0; k < 3; k++) {
        from[k] = middle[k] + 3 * half * eye[k];
        through[k] = middle[k] + x * right[k] + y * up[k];
    }
    ray_set(ray, from, through, half);
}

/* Ray i of circles round the z axis, from above down, to and fro: each covers as much of the
 * sphere. There are half as many circles as rays in one. */
static void ray_draw_sweep(double *ray, size_t i, size_t n, double size)
{
    static const double origin[3];
    size_t columns = (size_t)ceil(sqrt(2 * (double)n)), rows = (n + columns - 1) / columns,
           row = i / columns, column = row % 2 ? columns - 1 - i % columns : i % columns;
    double z = 1 - 2 * ((double)row + 0.5) / (double)rows, radius = sqrt(1 - z * z),
           turn = 2 * acos(-1) * ((double)column + 0.5) / (double)columns;
    double through[3] = {size * radius * cos(turn), size * radius * sin(turn), size * z};
    ray_set(ray, origin, through, size);
}

bool space_rays_draw(space_rays *r, const space_model *m, space_rays_kind kind, size_t n,
                     uint64_t seed)
{
    double middle[3], half = model_middle(m, middle);
    uint64_t random = ~seed;
    size_t side = (size_t)ceil(sqrt((double)n));
    r->count = n;
    r->ray = malloc(6 * n * sizeof *r->ray + 1);
    if (!r->ray) return false;
    for (size_t i = 0; i < n; i++) {
        double *ray = r->ray + 6 * i;
        if (kind == SPACE_CENTRE)
            ray_draw_centre(ray, half, &random);
        else if (kind == SPACE_RANDOM)
            ray_draw_random(ray, m, &random);
        else if (kind == SPACE_SWEEP)
            ray_draw_sweep(ray, i, n, half);
        else
            ray_draw_stream(ray, m, i, side);
    }
    return true;
}

void space_rays_release(space_rays *r)
{
    free(r->ray);
    *r = (space_rays){0};
}

/* --- moves ------------------------------------------------------------------------------------ */

const char *space_move_name(int move)
{
    static const char *const names[SPACE_MOVES] = {"move-all", "move-tenth", "move-one"};
    return move >= 0 && move < SPACE_MOVES ? names[move] : NULL;
}

/* How much of its distance from the middle a vertex moves: a wave along x and y. */
static double vertex_share(const double *p, const double middle[3], double half)
{
    return 0.01 * sin(9 * (p[0] - middle[0]) / half + 5 * (p[1] - middle[1]) / half);
}

void space_model_move(space_model *m, space_move move, bool away, double *farthest)
{
    double middle[3], half = model_middle(m, middle);
    size_t end = move == SPACE_ALL     ? m->point_count
                 : move == SPACE_TENTH ? (m->point_count + 9) / 10
                                       : 1;
    *farthest = 0;
    for (size_t i = 0; i < end; i++) {
        double square = 0, share = away ? vertex_share(m->rest + 3 * i, middle, half) : 0;
        for (size_t k = 0; k < 3; k++) {
            double rest = m->rest[3 * i + k], now = rest + share * (rest - middle[k]),
                   moved = now - m->points[3 * i + k];
            m->points[3 * i + k] = now;
            square += moved * moved;
        }
        *farthest = fmax(*farthest, sqrt(square) * (1 + 0x1p-40));
    }
}
