/* scene.c - the page is cut to the walk and the ends of its line. Of a large mesh only what lies
 * near the walk is painted. In space, triangles that face away are left out, except for those of
 * the walk. */
#include "cli/draw/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST_TRIANGLES 40000 /* that are painted, without the walk's */
#define CELLS SCENE_CELLS

/* --- what is shown ---------------------------------------------------------------------------- */

static const page_box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

bool page_point_is_finite(const page_point *at)
{
    return isfinite(at->x) && isfinite(at->y);
}

static void box_grow(page_box *b, const page_point *at)
{
    if (!page_point_is_finite(at)) return;
    b->low[0] = fmin(b->low[0], at->x);
    b->low[1] = fmin(b->low[1], at->y);
    b->high[0] = fmax(b->high[0], at->x);
    b->high[1] = fmax(b->high[1], at->y);
}

const page_point *scene_corner(const scene *s, uint32_t triangle, size_t k)
{
    return &s->at[s->d->triangles[3 * (size_t)triangle + k]];
}

page_box scene_box(const scene *s, uint32_t triangle)
{
    page_box b = nothing;
    for (size_t k = 0; k < 3; k++) box_grow(&b, scene_corner(s, triangle, k));
    return b;
}

double page_box_side(const page_box *b)
{
    return fmax(b->high[0] - b->low[0], b->high[1] - b->low[1]);
}

static page_box box_widen(page_box b, double margin)
{
    for (int k = 0; k < 2; k++) {
        b.low[k] -= margin;
        b.high[k] += margin;
    }
    return b;
}

static page_box box_join(page_box a, page_box b)
{
    for (int k = 0; k < 2; k++) {
        a.low[k] = fmin(a.low[k], b.low[k]);
        a.high[k] = fmax(a.high[k], b.high[k]);
    }
    return a;
}

static page_box box_meet(page_box a, page_box b)
{
    for (int k = 0; k < 2; k++) {
        a.low[k] = fmax(a.low[k], b.low[k]);
        a.high[k] = fmin(a.high[k], b.high[k]);
    }
    return a;
}

/* An end of the line should be seen, unless it lies far away: from a mesh in the plane, or from
 * the walk of a probe. */
static void scene_grow_to_end(scene *s, const double *point)
{
    page_point at = projection_at(&s->projection, point);
    page_box near = s->d->view == VIEW_PLANE ? box_widen(s->all, 2)
                                             : box_widen(s->shown, page_box_side(&s->shown));
    if (at.x >= near.low[0] && at.x <= near.high[0] && at.y >= near.low[1] && at.y <= near.high[1])
        box_grow(&s->shown, &at);
}

/* The walk and the ends of its line, with a margin, and the segments; the whole mesh where that is
 * not much more. */
static void scene_choose_box(scene *s)
{
    const drawing *d = s->d;
    double sides = 0;
    s->all = s->shown = nothing;
    for (size_t i = 0; i < 3 * d->triangle_count; i++) box_grow(&s->all, &s->at[d->triangles[i]]);
    for (size_t i = 0; i < 2 * d->segment_count; i++) {
        const page_point at = projection_at(&s->projection, d->segments + 3 * i);
        box_grow(&s->all, &at);
        box_grow(&s->shown, &at);
    }
    for (size_t i = 0; i < d->path_count; i++) {
        page_box b = scene_box(s, d->path[i]);
        sides += page_box_side(&b);
        for (size_t k = 0; k < 3; k++) box_grow(&s->shown, scene_corner(s, d->path[i], k));
    }
    for (size_t i = 0; i < d->line_count; i += d->line_count - 1)
        scene_grow_to_end(s, d->line + 3 * i);
    double side = page_box_side(&s->shown),
           mean = d->path_count ? sides / (double)d->path_count : 0;
    page_box near = box_widen(s->shown, fmax(0.12 * side, 1.5 * mean)),
             most = box_join(s->shown, s->all);
    bool whole = !d->path_count || page_box_side(&near) > 0.6 * page_box_side(&s->all);
    s->shown = whole ? most : box_meet(near, most);
    s->shown = box_widen(s->shown, 0.02 * page_box_side(&s->shown));
    if (!(page_box_side(&s->shown) > 0)) s->shown = (page_box){{-1, -1}, {1, 1}};
}

/* --- what is painted -------------------------------------------------------------------------- */

static bool scene_shows_box(const scene *s, const page_box *b)
{
    return b->low[0] <= s->shown.high[0] && b->high[0] >= s->shown.low[0] &&
           b->low[1] <= s->shown.high[1] && b->high[1] >= s->shown.low[1];
}

bool scene_is_finite(const scene *s, uint32_t triangle)
{
    return page_point_is_finite(scene_corner(s, triangle, 0)) &&
           page_point_is_finite(scene_corner(s, triangle, 1)) &&
           page_point_is_finite(scene_corner(s, triangle, 2));
}

static double scene_depth_of(const scene *s, uint32_t triangle)
{
    return (scene_corner(s, triangle, 0)->z + scene_corner(s, triangle, 1)->z +
            scene_corner(s, triangle, 2)->z) /
           3;
}

/* Order of painting: in the plane the walk lies on the mesh; in space nearer triangles hide farther
 * ones. Depths are at most 2. */
static void scene_add_triangle(scene *s, uint32_t triangle)
{
    page_box b = scene_box(s, triangle);
    bool walk = s->visit[triangle] != UINT32_MAX;
    if (!scene_is_finite(s, triangle) || !scene_shows_box(s, &b)) return;
    bool back = projection_turns_back(&s->projection, triangle);
    if (back && !walk) return;
    double key = s->d->view == VIEW_PLANE ? (walk ? s->visit[triangle] : -1.0)
                                          : scene_depth_of(s, triangle) - (back ? 10 : 0);
    s->painted[s->count++] = (painted_triangle){key, triangle, back};
}

static int painted_compare(const void *a, const void *b)
{
    const painted_triangle *p = a, *q = b;
    if (p->key != q->key) return p->key < q->key ? -1 : 1;
    return p->triangle < q->triangle ? -1 : 1;
}

/* How many cells of the page a triangle is away from the walk. */
typedef struct nearness {
    uint16_t cells[CELLS + 2][CELLS + 2]; /* with a margin that is far away */
} nearness;

#define FAR 0x7fff

static int nearness_cell(double x, double low, double high)
{
    double c = 1 + floor((x - low) / (high - low) * CELLS);
    return c < 1 ? 1 : c > CELLS ? CELLS : (int)c;
}

static void nearness_mark_walk(const scene *s, nearness *near)
{
    const page_box *v = &s->shown;
    for (size_t i = 0; i < s->d->path_count; i++) {
        if (!scene_is_finite(s, s->d->path[i])) continue;
        page_box b = scene_box(s, s->d->path[i]);
        int right = nearness_cell(b.high[0], v->low[0], v->high[0]),
            top = nearness_cell(b.high[1], v->low[1], v->high[1]);
        for (int y = nearness_cell(b.low[1], v->low[1], v->high[1]); y <= top; y++)
            for (int x = nearness_cell(b.low[0], v->low[0], v->high[0]); x <= right; x++)
                near->cells[y][x] = 0;
    }
}

static uint16_t nearness_closer(uint16_t here, uint16_t there)
{
    return there + 1 < here ? (uint16_t)(there + 1) : here;
}

/* Distances in king's moves, computed in two sweeps. */
static void nearness_sweep(nearness *near)
{
    for (int y = 1; y <= CELLS; y++)
        for (int x = 1; x <= CELLS; x++) {
            uint16_t *c = &near->cells[y][x];
            for (int k = -1; k <= 1; k++) *c = nearness_closer(*c, near->cells[y - 1][x + k]);
            *c = nearness_closer(*c, near->cells[y][x - 1]);
        }
    for (int y = CELLS; y >= 1; y--)
        for (int x = CELLS; x >= 1; x--) {
            uint16_t *c = &near->cells[y][x];
            for (int k = -1; k <= 1; k++) *c = nearness_closer(*c, near->cells[y + 1][x + k]);
            *c = nearness_closer(*c, near->cells[y][x + 1]);
        }
}

static uint32_t nearness_steps_away(const scene *s, const nearness *near, uint32_t triangle)
{
    const page_box *v = &s->shown;
    page_box b = scene_box(s, triangle);
    return near->cells[nearness_cell((b.low[1] + b.high[1]) / 2, v->low[1], v->high[1])]
                      [nearness_cell((b.low[0] + b.high[0]) / 2, v->low[0], v->high[0])];
}

/* A triangle is left out: the cells of its box are veiled. */
static void scene_veil_triangle(scene *s, uint32_t triangle)
{
    const page_box *v = &s->shown;
    page_box b = scene_box(s, triangle);
    int right = nearness_cell(b.high[0], v->low[0], v->high[0]),
        top = nearness_cell(b.high[1], v->low[1], v->high[1]);
    for (int y = nearness_cell(b.low[1], v->low[1], v->high[1]); y <= top; y++)
        for (int x = nearness_cell(b.low[0], v->low[0], v->high[0]); x <= right; x++)
            s->veil[(y - 1) * CELLS + x - 1] = true;
}

/* Keep the triangles nearest to the walk, up to the number to be painted. False: out of memory. */
static bool scene_keep_near(scene *s)
{
    size_t counts[CELLS + 1] = {0}, sum = 0, kept = 0;
    size_t bound = s->d->most_triangles ? s->d->most_triangles : MOST_TRIANGLES;
    uint32_t most = 0;
    if (s->count <= bound + s->d->path_count) return true;
    nearness *near = malloc(sizeof *near);
    s->veil = calloc((size_t)CELLS * CELLS, sizeof *s->veil);
    if (!near || !s->veil) {
        free(near);
        return false;
    }
    for (int y = 0; y < CELLS + 2; y++)
        for (int x = 0; x < CELLS + 2; x++) near->cells[y][x] = FAR;
    nearness_mark_walk(s, near);
    nearness_sweep(near);
    for (size_t i = 0; i < s->count; i++) {
        uint32_t away = nearness_steps_away(s, near, s->painted[i].triangle);
        if (away <= CELLS) counts[away]++;
    }
    while (most < CELLS && sum + counts[most] <= bound) sum += counts[most++];
    for (size_t i = 0; i < s->count; i++) {
        uint32_t t = s->painted[i].triangle;
        if (s->visit[t] != UINT32_MAX || nearness_steps_away(s, near, t) < most)
            s->painted[kept++] = s->painted[i];
        else
            scene_veil_triangle(s, t);
    }
    s->count = kept;
    free(near);
    return true;
}

static bool scene_choose_triangles(scene *s)
{
    for (size_t t = 0; t < s->d->triangle_count; t++) scene_add_triangle(s, (uint32_t)t);
    if (!scene_keep_near(s)) return false;
    qsort(s->painted, s->count, sizeof *s->painted, painted_compare);
    return true;
}

/* --- the whole -------------------------------------------------------------------------------- */

static bool scene_make_room(scene *s)
{
    const drawing *d = s->d;
    s->at = malloc((d->point_count + 1) * sizeof *s->at);
    s->visit = malloc((d->triangle_count + 1) * sizeof *s->visit);
    s->part = malloc((d->path_count + 1) * sizeof *s->part);
    s->painted = malloc((d->triangle_count + 1) * sizeof *s->painted);
    return s->at && s->visit && s->part && s->painted;
}

static void scene_number_visits(scene *s)
{
    const drawing *d = s->d;
    memset(s->visit, 0xff, d->triangle_count * sizeof *s->visit);
    for (size_t i = 0; i < d->path_count; i++)
        if (s->visit[d->path[i]] == UINT32_MAX) s->visit[d->path[i]] = (uint32_t)i;
    for (size_t begin = 0, end; begin < d->path_count; begin = end) {
        for (end = begin; end < d->path_count && d->iteration[end] == d->iteration[begin];) end++;
        for (size_t i = begin; i < end; i++)
            s->part[i] = (double)(i - begin + 1) / (double)(end - begin);
    }
}

bool scene_make(scene *s, const drawing *d)
{
    *s = (scene){
        .d = d, .projection = projection_make(d), .seen = d->path_count, .caption = d->caption};
    if (!scene_make_room(s)) return false;
    for (size_t v = 0; v < s->d->point_count; v++)
        s->at[v] = projection_at(&s->projection, s->d->points + 3 * v);
    scene_number_visits(s);
    scene_choose_box(s);
    return scene_choose_triangles(s);
}

void scene_release(scene *s)
{
    free(s->at);
    free(s->visit);
    free(s->part);
    free(s->painted);
    free(s->veil);
}
