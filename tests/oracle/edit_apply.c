/* edit_apply.c - what an edit did, and what must have come of it. */
#include "oracle/edit_apply.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "support/meshes.h"

/* --- what the report says --------------------------------------------------------------------- */

void twin_grow(twin *t, uint32_t vertex_range, uint32_t triangle_range)
{
    if (vertex_range > t->vertex_range) {
        t->point = require_more_room(t->point, 2 * (size_t)vertex_range, sizeof *t->point);
        t->state = require_more_room(t->state, vertex_range, 1);
        for (int f = 0; f < TWIN_FIELDS; f++)
            t->value[f] = require_more_room(t->value[f], vertex_range, sizeof(double));
        memset(t->state + t->vertex_range, TWIN_GONE, vertex_range - t->vertex_range);
    }
    if (triangle_range > t->triangle_range) {
        t->triangle =
            require_more_room(t->triangle, 3 * (size_t)triangle_range, sizeof *t->triangle);
        memset(t->triangle + 3 * (size_t)t->triangle_range, 255,
               3 * sizeof *t->triangle * (triangle_range - t->triangle_range));
    }
}

/* Take over one triangle. */
static void absorb_triangle(twin *t, const mw_changed_triangle *c, bool made, bool freed)
{
    uint32_t *mine = t->triangle + 3 * (size_t)c->triangle, now[3] = {MW_NONE, MW_NONE, MW_NONE};
    if (made)
        REQUIRE(mine[0] == MW_NONE && c->before[0] == MW_NONE && c->before[1] == MW_NONE &&
                c->before[2] == MW_NONE);
    else
        REQUIRE(mine[0] != MW_NONE && memcmp(mine, c->before, sizeof now) == 0);
    REQUIRE(mw_editor_triangle(t->editor, c->triangle, now) == !freed);
    REQUIRE(memcmp(mine, now, sizeof now) != 0);
    memcpy(mine, now, sizeof now);
}

void twin_absorb(twin *t, const mw_change *change, bool undone)
{
    mw_editor_info info;
    mw_editor_describe(t->editor, &info);
    const uint32_t triangle_range = t->triangle_range, vertex_range = t->vertex_range;
    size_t count = change->made + change->reused + change->freed;
    twin_grow(t, info.vertex_range, info.triangle_range);
    uint32_t before = 0;
    for (size_t i = 0; i < count; i++) {
        const mw_changed_triangle *c = &change->triangle[i];
        bool made = i < change->made, freed = i >= change->made + change->reused;
        if (i > 0 && i != change->made && i != change->made + change->reused)
            REQUIRE(c->triangle > before);
        REQUIRE(c->triangle < (freed || !made ? triangle_range : info.triangle_range));
        if (made && !undone) REQUIRE(c->triangle >= triangle_range);
        absorb_triangle(t, c, made, freed);
        before = c->triangle;
    }
    REQUIRE(!(change->vertices_made && change->vertices_freed));
    if (change->vertices_made) {
        REQUIRE(change->vertex < info.vertex_range && t->state[change->vertex] == TWIN_GONE);
        if (!undone) REQUIRE(change->vertex == vertex_range);
        t->state[change->vertex] = TWIN_USED;
    }
    if (change->vertices_freed) {
        REQUIRE(twin_uses_vertex(t, change->vertex));
        t->state[change->vertex] = TWIN_GONE;
    }
    if (undone) {
        REQUIRE(info.vertex_range <= vertex_range && info.triangle_range <= triangle_range);
        for (uint32_t k = info.triangle_range; k < triangle_range; k++)
            REQUIRE(!twin_has_triangle(t, k));
        for (uint32_t v = info.vertex_range; v < vertex_range; v++)
            REQUIRE(t->state[v] == TWIN_GONE);
    } else {
        REQUIRE(info.vertex_range == vertex_range + (change->vertices_made != 0));
        REQUIRE(info.triangle_range >= triangle_range + change->made);
    }
    t->vertex_range = info.vertex_range;
    t->triangle_range = info.triangle_range;
    t->triangles = (uint32_t)(t->triangles + change->made - change->freed);
    t->vertices += (change->vertices_made != 0) - (uint32_t)(change->vertices_freed != 0);
    for (int i = 0; i < 6; i++) REQUIRE(change->reserved[i] == 0);
}

void twin_read_vertex(twin *t, uint32_t v)
{
    REQUIRE(mw_editor_vertex(t->editor, v, t->point + 2 * (size_t)v) == 1);
    for (uint32_t f = 0; f < t->fields; f++) t->value[f][v] = mw_editor_value(t->editor, f, v);
}

bool change_is_empty(const mw_change *change)
{
    return change->made + change->reused + change->freed == 0 && !change->vertices_made &&
           !change->vertices_freed && change->flips == 0;
}

/* --- each kind: what the twin was before says what must have come of it ----------------------- */

/* Values at a new vertex lie between those of the triangle that it was put into. */
static void check_interpolated(const twin *t, const twin *before, const mw_edit *e, uint32_t v,
                               uint32_t triangle)
{
    for (uint32_t f = 0; f < t->fields; f++) {
        double value = t->value[f][v], low = INFINITY, high = -INFINITY;
        bool unknown = false;
        if (f == e->field && !isnan(e->value)) {
            REQUIRE(value == e->value);
            continue;
        }
        for (int c = 0; c < 3 && triangle != MW_NONE; c++) {
            double corner = before->value[f][twin_corners(before, triangle)[c]];
            low = fmin(low, corner);
            high = fmax(high, corner);
            unknown |= isnan(corner);
        }
        double slack = 1e-9 * (fabs(low) + fabs(high));
        if (triangle != MW_NONE && !unknown) REQUIRE(value >= low - slack && value <= high + slack);
    }
}

/* Hull edges that q lies strictly beyond. */
static size_t visible_edges(const twin *t, const double *q)
{
    size_t count, visible = 0;
    twin_side *sides = twin_sides(t, &count);
    for (size_t i = 0; i < count; i++)
        visible += !twin_find_side(sides, count, sides[i].to, sides[i].from) &&
                   plane_orient(twin_point(t, sides[i].from), twin_point(t, sides[i].to), q) < 0;
    free(sides);
    return visible;
}

void twin_split_fixed(twin *t, uint32_t v)
{
    for (size_t i = t->fixed_count; i-- > 0;) {
        uint32_t a = t->fixed[2 * i], b = t->fixed[2 * i + 1];
        if (a == v || b == v ||
            !plane_is_on_segment(twin_point(t, a), twin_point(t, b), twin_point(t, v)))
            continue;
        twin_unfix(t, a, b);
        twin_fix(t, a, v);
        twin_fix(t, v, b);
    }
}

static void after_insert(twin *t, const twin *before, const mw_edit *e, const mw_change *change)
{
    const double q[2] = {e->x, e->y};
    location_answer where = twin_locate(before, q);
    if (where.where == MW_ON_VERTEX) {
        REQUIRE(change_is_empty(change) &&
                change->vertex == twin_corners(before, where.triangle)[where.local]);
        return;
    }
    REQUIRE(change->vertices_made && change->freed == 0);
    twin_read_vertex(t, change->vertex);
    REQUIRE(twin_point(t, change->vertex)[0] == q[0] && twin_point(t, change->vertex)[1] == q[1]);
    check_interpolated(t, before, e, change->vertex, where.triangle);
    if (where.triangle == MW_NONE) {
        REQUIRE(change->made == visible_edges(before, q));
    } else if (where.where == MW_INSIDE) {
        REQUIRE(change->made == 2 && change->reused >= 1);
    } else {
        const uint32_t *v = twin_corners(before, where.triangle);
        size_t sides = (size_t)twin_count_sides(before, v[where.local], v[(where.local + 1) % 3]);
        REQUIRE(change->made == sides && change->reused >= sides);
    }
    twin_split_fixed(t, change->vertex);
}

/* How many triangles of the star, or of its part on the same side of the constraint through the
 * vertex, have a higher number. */
static uint32_t rank_in_star(const twin *t, const twin_star *s, uint32_t i)
{
    uint32_t higher = 0;
    for (uint32_t j = i + 1; j < s->count; j++) {
        int sides = 1;
        if (s->fixed_count == 2) {
            const double *a = twin_point(t, s->fixed[0]), *b = twin_point(t, s->fixed[1]);
            int one = plane_orient(a, b, twin_point(t, s->side[i].from)) +
                      plane_orient(a, b, twin_point(t, s->side[i].to));
            sides = one * (plane_orient(a, b, twin_point(t, s->side[j].from)) +
                           plane_orient(a, b, twin_point(t, s->side[j].to)));
        }
        higher += sides > 0;
    }
    return higher;
}

static void after_remove(twin *t, const twin *before, const mw_edit *e, const mw_change *change)
{
    twin_star s = twin_star_of(before, e->vertex);
    REQUIRE(change->vertex == e->vertex && change->vertices_freed && change->made == 0);
    if (s.border_count == 0) REQUIRE(change->freed == 2);
    if (s.border_count > 0 && !t->convex) REQUIRE(change->freed == 1);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < s.count; i++) {
        bool there = twin_has_triangle(t, s.side[i].triangle);
        REQUIRE(there == (rank_in_star(before, &s, i) >= (s.fixed_count == 2 ? 1 : change->freed)));
        kept += there;
    }
    if (!change->flips) REQUIRE(change->reused == kept);
    if (s.fixed_count == 2) {
        for (int k = 0; k < 2; k++)
            if (twin_is_fixed(t, e->vertex, s.fixed[k])) twin_unfix(t, e->vertex, s.fixed[k]);
        if (twin_is_fixed(before, e->vertex, s.fixed[0])) twin_fix(t, s.fixed[0], s.fixed[1]);
    }
    twin_star_free(&s);
}

static void after_move(twin *t, const twin *before, const mw_edit *e, const mw_change *change)
{
    const double q[2] = {e->x, e->y};
    uint32_t v = e->vertex;
    REQUIRE(change->vertex == v && !change->vertices_made && !change->vertices_freed);
    memcpy(t->point + 2 * (size_t)v, q, sizeof q);
    twin_split_fixed(t, v);
    twin_star s = twin_star_of(before, v);
    if (s.border_count == 0 && twin_star_fits(before, &s, q)) {
        REQUIRE(change->made == 0 && change->freed == 0);
        if (!change->flips) REQUIRE(change->reused == 0);
    }
    if (s.border_count > 0 && !t->convex) {
        size_t count, was;
        twin_side *now = twin_sides(t, &count), *then = twin_sides(before, &was);
        for (size_t i = 0; i < count; i++)
            if (!twin_find_side(now, count, now[i].to, now[i].from))
                REQUIRE(twin_find_side(then, was, now[i].from, now[i].to) &&
                        !twin_find_side(then, was, now[i].to, now[i].from));
        free(now);
        free(then);
        twin_keep_border(t);
        t->border_moved = true;
    }
    twin_star_free(&s);
}

static void after_flip(twin *t, const twin *before, const mw_edit *e, const mw_change *change)
{
    twin_side s, r, other;
    bool found = twin_find_edge(before, e->vertex, e->other, &s) &&
                 twin_find_edge(before, e->other, e->vertex, &r);
    REQUIRE(found && change->made == 0 && change->freed == 0 && change->reused == 2);
    REQUIRE(twin_find_edge(t, s.apex, r.apex, &other) && twin_find_edge(t, r.apex, s.apex, &other));
    if (plane_incircle(twin_point(t, s.from), twin_point(t, s.to), twin_point(t, s.apex),
                       twin_point(t, r.apex)) != 0)
        t->delaunay = false;
}

static void after_constrain(twin *t, const mw_edit *e, const mw_change *change)
{
    size_t count;
    uint32_t *way = twin_vertices_between(t, e->vertex, e->other, &count);
    REQUIRE(change->constrained_edges == count - 1 && change->made == 0 && change->freed == 0);
    for (size_t i = 1; i < count; i++) {
        if (e->kind == MW_EDIT_RELEASE)
            twin_unfix(t, way[i - 1], way[i]);
        else if (t->convex || twin_count_sides(t, way[i - 1], way[i]) == 2)
            twin_fix(t, way[i - 1], way[i]);
    }
    free(way);
}

void twin_take_over(twin *t, const mw_edit *e, const mw_change *change)
{
    twin before = twin_copy(t);
    twin_absorb(t, change, false);
    switch (e->kind) {
    case MW_EDIT_INSERT: after_insert(t, &before, e, change); break;
    case MW_EDIT_REMOVE: after_remove(t, &before, e, change); break;
    case MW_EDIT_MOVE: after_move(t, &before, e, change); break;
    case MW_EDIT_FLIP: after_flip(t, &before, e, change); break;
    case MW_EDIT_VALUE:
        REQUIRE(change_is_empty(change));
        t->value[e->field][e->vertex] = e->value;
        break;
    default: after_constrain(t, e, change); break;
    }
    for (size_t i = 0; i < change->made; i++)
        REQUIRE(twin_turn(t, change->triangle[i].triangle) > 0);
    if (!before.delaunay && e->kind == MW_EDIT_INSERT) REQUIRE(change->flips == 0);
    twin_close(&before);
}

/* --- an edit ---------------------------------------------------------------------------------- */

/* By the function of its kind, or by the one for all. */
static mw_status call_edit(mw_editor *editor, const mw_edit *e, bool direct, mw_change *change,
                           mw_error *error)
{
    if (!direct) return mw_edit_apply(editor, e, change, error);
    switch (e->kind) {
    case MW_EDIT_INSERT: return mw_edit_insert(editor, e->x, e->y, change, error);
    case MW_EDIT_REMOVE: return mw_edit_remove(editor, e->vertex, change, error);
    case MW_EDIT_MOVE: return mw_edit_move(editor, e->vertex, e->x, e->y, change, error);
    case MW_EDIT_FLIP: return mw_edit_flip(editor, e->vertex, e->other, change, error);
    case MW_EDIT_CONSTRAIN: return mw_edit_constrain(editor, e->vertex, e->other, change, error);
    case MW_EDIT_RELEASE: return mw_edit_release(editor, e->vertex, e->other, change, error);
    default: return mw_edit_apply(editor, e, change, error);
    }
}

/* Refused: the vertex or triangle is named, if there is one, and the text says something. */
static void check_refusal(const twin *t, const mw_edit *e, const mw_error *error)
{
    const double q[2] = {e->x, e->y};
    bool away = e->kind == MW_EDIT_INSERT ||
                (e->kind == MW_EDIT_MOVE && twin_locate(t, q).triangle == MW_NONE);
    REQUIRE(error->status == MW_ERROR_INPUT && strlen(error->message) > 8);
    if (!away) REQUIRE(error->vertex >= 0 || error->triangle >= 0);
}

mw_status twin_apply(twin *t, const mw_edit *edit, bool direct)
{
    mw_change change;
    mw_error error = {0};
    mw_edit e = *edit;
    if (direct && e.kind == MW_EDIT_INSERT) e.value = NAN;
    edit_case.edit = e;
    memset(&change, 77, sizeof change);
    twin_outcome expected = twin_predict(t, &e);
    mw_status status = call_edit(t->editor, &e, direct, &change, &error);
    REQUIRE(status == MW_OK || status == MW_ERROR_INPUT);
    REQUIRE((status == MW_OK) == (expected == TWIN_DONE));
    if (status == MW_OK) {
        twin_take_over(t, &e, &change);
    } else {
        check_refusal(t, &e, &error);
        twin_check_same(t);
    }
    return status;
}

void twin_undone(twin *t, const twin *then, const mw_change *change)
{
    twin_absorb(t, change, true);
    REQUIRE(t->vertex_range == then->vertex_range && t->triangle_range == then->triangle_range);
    REQUIRE(memcmp(t->triangle, then->triangle, 3 * sizeof *t->triangle * t->triangle_range) == 0);
    REQUIRE(memcmp(t->state, then->state, t->vertex_range) == 0);
    twin c = twin_copy(then);
    c.shared = t->shared;
    t->shared = true; /* the editor goes on */
    twin_close(t);
    *t = c;
    twin_check_same(t);
}

void twin_undo(twin *t, const twin *then)
{
    mw_change change;
    mw_error error = {0};
    memset(&change, 77, sizeof change);
    expect_ok(mw_edit_undo(t->editor, &change, &error), "undo", &error);
    twin_undone(t, then, &change);
}

void twin_compact(twin *t)
{
    uint32_t *triangles = require_room(t->triangle_range, sizeof *triangles),
             *vertices = require_room(t->vertex_range, sizeof *vertices);
    triangles[t->triangle_range] = vertices[t->vertex_range] = 4711;
    mw_mesh *mesh;
    mw_error error = {0};
    expect_ok(mw_editor_mesh(t->editor, NULL, NULL, &mesh, &error), "mesh", &error);
    expect_ok(mw_editor_compact(t->editor, triangles, vertices, &error), "compact", &error);
    twin_check_mesh(t, mesh, triangles, vertices);
    for (uint32_t v = 0; v < t->vertex_range; v++)
        if (vertices[v] != MW_NONE) t->state[vertices[v]] = t->state[v];
    for (size_t i = 0; i < t->fixed_count; i++) {
        uint32_t a = vertices[t->fixed[2 * i]], b = vertices[t->fixed[2 * i + 1]];
        t->fixed[2 * i] = a < b ? a : b;
        t->fixed[2 * i + 1] = a < b ? b : a;
    }
    t->compacted = true;
    t->vertex_range = t->vertices;
    t->triangle_range = t->triangles;
    for (uint32_t v = 0; v < t->vertices; v++) {
        mw_mesh_vertex(mesh, v, t->point + 2 * (size_t)v);
        for (uint32_t f = 0; f < t->fields; f++)
            t->value[f][v] = mw_mesh_field(mesh, twin_field[f])[v];
    }
    for (uint32_t k = 0; k < t->triangles; k++)
        mw_mesh_triangle(mesh, k, t->triangle + 3 * (size_t)k);
    mw_mesh_destroy(mesh);
    free(triangles);
    free(vertices);
    twin_check_same(t);
    size_t count = 4711;
    mw_editor_log(t->editor, &count);
    REQUIRE(count == 0 && mw_edit_undo(t->editor, NULL, &error) == MW_ERROR_INPUT);
}
