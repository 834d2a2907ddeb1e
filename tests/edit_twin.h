/* edit_twin.h - edits of an editor and of its twin (edit_oracle.h): what each has to do is foretold by brute force, what it did is
 * taken over from its report, and where it is refused nothing may have changed. */
#ifndef MW_TEST_EDIT_TWIN_H
#define MW_TEST_EDIT_TWIN_H

#include "edit_oracle.h"

typedef enum outcome { DONE, REFUSED, EITHER } outcome; /* EITHER: the header leaves it open */

/* --- the triangles round a vertex ----------------------------------------------------------------------------------------- */

typedef struct star {
    side *side; /* opposite to the vertex, counter-clockwise; in order of the triangles' numbers */
    uint32_t count;
    uint32_t *border, border_count; /* neighbours along border edges                              */
    uint32_t *fixed, fixed_count;   /* neighbours along edges that are not to be flipped away     */
} star;

static inline star star_of(const twin *t, uint32_t v)
{
    star s = {0};
    for (uint32_t k = 0; k < t->triangle_range; k++)
        for (int c = 0; c < 3; c++) s.count += is_there(t, k) && corners_of(t, k)[c] == v;
    s.side = room(s.count, sizeof *s.side);
    s.border = room(2 * (size_t)s.count, sizeof *s.border);
    s.fixed = room(2 * (size_t)s.count + t->fixed_count, sizeof *s.fixed);
    s.count = 0;
    for (uint32_t k = 0; k < t->triangle_range; k++)
        for (int c = 0; c < 3; c++)
            if (is_there(t, k) && corners_of(t, k)[(c + 2) % 3] == v)
                s.side[s.count++] = side_of(t, k, turn_of(t, k), c);
    uint8_t *ends = room(t->vertex_range, 1); /* 1: a side begins there, 2: one ends there */
    for (uint32_t i = 0; i < s.count; i++) {
        ends[s.side[i].from] |= 1;
        ends[s.side[i].to] |= 2;
    }
    for (uint32_t i = 0; i < s.count; i++) {
        if (ends[s.side[i].from] == 1) s.border[s.border_count++] = s.side[i].from;
        if (ends[s.side[i].to] == 2) s.border[s.border_count++] = s.side[i].to;
    }
    free(ends);
    for (size_t i = 0; i < t->fixed_count; i++)
        for (int k = 0; k < 2; k++)
            if (t->fixed[2 * i + (size_t)k] == v) s.fixed[s.fixed_count++] = t->fixed[2 * i + 1 - (size_t)k];
    for (uint32_t i = 0; i < s.border_count && !t->convex; i++) s.fixed[s.fixed_count++] = s.border[i];
    return s;
}

static inline void star_free(star *s)
{
    free(s->side);
    free(s->border);
    free(s->fixed);
}

/* --- what has to happen ----------------------------------------------------------------------------------------------------- */

/* Do the vertices but v span an area? */
static inline bool is_something_left(const twin *t, uint32_t v)
{
    uint32_t a = MW_NONE, b = MW_NONE;
    for (uint32_t w = 0; w < t->vertex_range; w++) {
        if (w == v || t->state[w] != IS_USED) continue;
        if (a == MW_NONE)
            a = w;
        else if (b == MW_NONE)
            b = w;
        else if (exact_orient(at(t, a), at(t, b), at(t, w)) != 0)
            return true;
    }
    return false;
}

static inline outcome foretell_remove(const twin *t, uint32_t v)
{
    if (!is_used(t, v)) return REFUSED;
    star s = star_of(t, v);
    bool can =
        s.fixed_count == 0 || (s.fixed_count == 2 && is_on_segment(at(t, s.fixed[0]), at(t, s.fixed[1]), at(t, v)));
    if (s.border_count > 0 && !is_something_left(t, v)) can = false;
    star_free(&s);
    return can ? DONE : REFUSED;
}

static inline outcome foretell_insert(const twin *t, const double *q)
{
    oracle_answer where = twin_locate(t, q);
    return where.where == MW_BAD || (where.triangle == MW_NONE && !t->convex) ? REFUSED : DONE;
}

/* Do the triangles round v keep their turn, with v at q? */
static inline bool is_star_at(const twin *t, const star *s, const double *q)
{
    for (uint32_t i = 0; i < s->count; i++)
        if (exact_orient(at(t, s->side[i].from), at(t, s->side[i].to), q) <= 0) return false;
    return true;
}

static inline outcome foretell_move(const twin *t, uint32_t v, const double *q)
{
    if (!is_used(t, v) || !isfinite(q[0]) || !isfinite(q[1])) return REFUSED;
    if (q[0] == at(t, v)[0] && q[1] == at(t, v)[1]) return DONE;
    oracle_answer where = twin_locate(t, q);
    if (where.where == MW_ON_VERTEX) return REFUSED;
    star s = star_of(t, v);
    bool stays = is_star_at(t, &s, q), border = s.border_count > 0, fixed = s.fixed_count > 0;
    star_free(&s);
    if (!border && stays) return DONE;
    if (border && (fixed || !is_something_left(t, v))) return stays ? EITHER : REFUSED;
    if (fixed) return REFUSED;
    return where.triangle == MW_NONE && !t->convex ? REFUSED : DONE;
}

/* The triangle with a on its left... with v[k], v[k + 1] being a, b; false if there is none. */
static inline bool find_edge(const twin *t, uint32_t a, uint32_t b, side *found)
{
    for (uint32_t k = 0; k < t->triangle_range; k++) {
        if (!is_there(t, k)) continue;
        const uint32_t *v = corners_of(t, k);
        bool near = (v[0] == a || v[1] == a || v[2] == a) && (v[0] == b || v[1] == b || v[2] == b);
        for (int c = 0; c < 3 && near; c++) {
            *found = side_of(t, k, turn_of(t, k), c);
            if (found->from == a && found->to == b) return true;
        }
    }
    return false;
}

static inline outcome foretell_flip(const twin *t, uint32_t a, uint32_t b)
{
    side s, r;
    if (a == b || !is_used(t, a) || !is_used(t, b)) return REFUSED;
    if (!find_edge(t, a, b, &s) || !find_edge(t, b, a, &r) || is_fixed(t, a, b)) return REFUSED;
    return is_crossing(at(t, a), at(t, b), at(t, s.apex), at(t, r.apex)) ? DONE : REFUSED;
}

/* The vertices on the way from a to b, in order, both ends counted. */
static inline uint32_t *way_of(const twin *t, uint32_t a, uint32_t b, size_t *count)
{
    uint32_t *way = room((size_t)t->vertex_range + 2, sizeof *way);
    *count = 0;
    way[(*count)++] = a;
    for (uint32_t v = 0; v < t->vertex_range; v++)
        if (v != a && v != b && is_used(t, v) && is_on_segment(at(t, a), at(t, b), at(t, v))) way[(*count)++] = v;
    for (size_t i = 2; i < *count; i++)
        for (size_t j = i; j > 1 && is_between(at(t, a), at(t, way[j]), at(t, way[j - 1])); j--) {
            uint32_t swap = way[j];
            way[j] = way[j - 1];
            way[j - 1] = swap;
        }
    way[(*count)++] = b;
    return way;
}

/* Both directions of an edge: 0: it is none; 1: border; 2: it has two triangles. */
static inline int count_sides(const twin *t, uint32_t a, uint32_t b)
{
    side s;
    return (int)find_edge(t, a, b, &s) + (int)find_edge(t, b, a, &s);
}

/* Is one way from vertex to vertex, with none between, free for a constraint? Of meshes that do not fill their hull the coordinates
 * have to be such that the middle of two of them is exact. */
static inline bool is_way_free(const twin *t, uint32_t a, uint32_t b)
{
    oracle_answer middle;
    for (size_t i = 0; i < t->fixed_count; i++)
        if (is_crossing(at(t, a), at(t, b), at(t, t->fixed[2 * i]), at(t, t->fixed[2 * i + 1]))) return false;
    if (t->convex || count_sides(t, a, b)) return true;
    for (uint32_t k = 0; k < t->triangle_range; k++)
        for (int c = 0; c < 3; c++) {
            if (!is_there(t, k)) continue;
            uint32_t v = corners_of(t, k)[c], w = corners_of(t, k)[(c + 1) % 3];
            if (is_crossing(at(t, a), at(t, b), at(t, v), at(t, w)) && count_sides(t, v, w) == 1) return false;
        }
    const double q[2] = {at(t, a)[0] / 2 + at(t, b)[0] / 2, at(t, a)[1] / 2 + at(t, b)[1] / 2};
    middle = twin_locate(t, q);
    return middle.triangle != MW_NONE;
}

static inline outcome foretell_constrain(const twin *t, uint32_t a, uint32_t b, bool release)
{
    if (!is_used(t, a) || !is_used(t, b) || a == b) return REFUSED;
    size_t count;
    uint32_t *way = way_of(t, a, b, &count);
    bool can = true;
    for (size_t i = 1; i < count; i++)
        can = can && (release ? is_fixed(t, way[i - 1], way[i]) : is_way_free(t, way[i - 1], way[i]));
    free(way);
    return can ? DONE : REFUSED;
}

static inline outcome foretell(const twin *t, const mw_edit *e)
{
    const double q[2] = {e->x, e->y};
    switch (e->kind) {
    case MW_EDIT_INSERT: return foretell_insert(t, q);
    case MW_EDIT_REMOVE: return foretell_remove(t, e->vertex);
    case MW_EDIT_MOVE: return foretell_move(t, e->vertex, q);
    case MW_EDIT_FLIP: return foretell_flip(t, e->vertex, e->other);
    case MW_EDIT_CONSTRAIN: return foretell_constrain(t, e->vertex, e->other, false);
    case MW_EDIT_RELEASE: return foretell_constrain(t, e->vertex, e->other, true);
    case MW_EDIT_VALUE: return e->vertex < t->vertex_range && t->state[e->vertex] != IS_GONE ? DONE : REFUSED;
    default: return REFUSED;
    }
}

/* --- what the report says ------------------------------------------------------------------------------------------------------ */

static inline void grow(twin *t, uint32_t vertex_range, uint32_t triangle_range)
{
    if (vertex_range > t->vertex_range) {
        t->point = more_room(t->point, 2 * (size_t)vertex_range, sizeof *t->point);
        t->state = more_room(t->state, vertex_range, 1);
        for (int f = 0; f < TWIN_FIELDS; f++) t->value[f] = more_room(t->value[f], vertex_range, sizeof(double));
        memset(t->state + t->vertex_range, IS_GONE, vertex_range - t->vertex_range);
    }
    if (triangle_range > t->triangle_range) {
        t->triangle = more_room(t->triangle, 3 * (size_t)triangle_range, sizeof *t->triangle);
        memset(t->triangle + 3 * (size_t)t->triangle_range, 255,
               3 * sizeof *t->triangle * (triangle_range - t->triangle_range));
    }
}

/* Take over one triangle. */
static inline void absorb_triangle(twin *t, const mw_changed_triangle *c, bool made, bool freed)
{
    uint32_t *mine = t->triangle + 3 * (size_t)c->triangle, now[3] = {MW_NONE, MW_NONE, MW_NONE};
    if (made)
        REQUIRE(mine[0] == MW_NONE && c->before[0] == MW_NONE && c->before[1] == MW_NONE && c->before[2] == MW_NONE);
    else
        REQUIRE(mine[0] != MW_NONE && memcmp(mine, c->before, sizeof now) == 0);
    REQUIRE(mw_editor_triangle(t->editor, c->triangle, now) == !freed);
    REQUIRE(memcmp(mine, now, sizeof now) != 0);
    memcpy(mine, now, sizeof now);
}

/* Bring the twin up to date. `undone`: what was freed comes back by its number, else new triangles have new ones. */
static inline void absorb(twin *t, const mw_change *change, bool undone)
{
    mw_editor_info info;
    mw_editor_describe(t->editor, &info);
    const uint32_t triangle_range = t->triangle_range, vertex_range = t->vertex_range;
    size_t count = change->made + change->reused + change->freed;
    grow(t, info.vertex_range, info.triangle_range);
    uint32_t before = 0;
    for (size_t i = 0; i < count; i++) {
        const mw_changed_triangle *c = &change->triangle[i];
        bool made = i < change->made, freed = i >= change->made + change->reused;
        if (i > 0 && i != change->made && i != change->made + change->reused) REQUIRE(c->triangle > before);
        REQUIRE(c->triangle < (freed || !made ? triangle_range : info.triangle_range));
        if (made && !undone) REQUIRE(c->triangle >= triangle_range);
        absorb_triangle(t, c, made, freed);
        before = c->triangle;
    }
    REQUIRE(!(change->vertices_made && change->vertices_freed));
    if (change->vertices_made) {
        REQUIRE(change->vertex < info.vertex_range && t->state[change->vertex] == IS_GONE);
        if (!undone) REQUIRE(change->vertex == vertex_range);
        t->state[change->vertex] = IS_USED;
    }
    if (change->vertices_freed) {
        REQUIRE(is_used(t, change->vertex));
        t->state[change->vertex] = IS_GONE;
    }
    if (undone) {
        REQUIRE(info.vertex_range <= vertex_range && info.triangle_range <= triangle_range);
        for (uint32_t k = info.triangle_range; k < triangle_range; k++) REQUIRE(!is_there(t, k));
        for (uint32_t v = info.vertex_range; v < vertex_range; v++) REQUIRE(t->state[v] == IS_GONE);
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

/* Coordinates and values of a vertex as the editor has them now. */
static inline void read_vertex(twin *t, uint32_t v)
{
    REQUIRE(mw_editor_vertex(t->editor, v, t->point + 2 * (size_t)v) == 1);
    for (uint32_t f = 0; f < t->fields; f++) t->value[f][v] = mw_editor_value(t->editor, f, v);
}

static inline bool is_still(const mw_change *change)
{
    return change->made + change->reused + change->freed == 0 && !change->vertices_made && !change->vertices_freed &&
           change->flips == 0;
}

/* --- each kind: what the twin was before says what must have come of it --------------------------------------------------------- */

/* Values at a new vertex lie between those of the triangle that it was put into. */
static inline void check_interpolated(const twin *t, const twin *before, const mw_edit *e, uint32_t v,
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
            double corner = before->value[f][corners_of(before, triangle)[c]];
            low = fmin(low, corner);
            high = fmax(high, corner);
            unknown |= isnan(corner);
        }
        double slack = 1e-9 * (fabs(low) + fabs(high));
        if (triangle != MW_NONE && !unknown) REQUIRE(value >= low - slack && value <= high + slack);
    }
}

/* Hull edges that q lies strictly beyond. */
static inline size_t visible_edges(const twin *t, const double *q)
{
    size_t count, visible = 0;
    side *sides = all_sides(t, &count);
    for (size_t i = 0; i < count; i++)
        visible += !find_side(sides, count, sides[i].to, sides[i].from) &&
                   exact_orient(at(t, sides[i].from), at(t, sides[i].to), q) < 0;
    free(sides);
    return visible;
}

/* A constraint with q inside it is two now. */
static inline void split_fixed(twin *t, uint32_t v)
{
    for (size_t i = t->fixed_count; i-- > 0;) {
        uint32_t a = t->fixed[2 * i], b = t->fixed[2 * i + 1];
        if (a == v || b == v || !is_on_segment(at(t, a), at(t, b), at(t, v))) continue;
        unfix(t, a, b);
        fix(t, a, v);
        fix(t, v, b);
    }
}

static inline void after_insert(twin *t, const twin *before, const mw_edit *e, const mw_change *change)
{
    const double q[2] = {e->x, e->y};
    oracle_answer where = twin_locate(before, q);
    if (where.where == MW_ON_VERTEX) {
        REQUIRE(is_still(change) && change->vertex == corners_of(before, where.triangle)[where.local]);
        return;
    }
    REQUIRE(change->vertices_made && change->freed == 0);
    read_vertex(t, change->vertex);
    REQUIRE(at(t, change->vertex)[0] == q[0] && at(t, change->vertex)[1] == q[1]);
    check_interpolated(t, before, e, change->vertex, where.triangle);
    if (where.triangle == MW_NONE) {
        REQUIRE(change->made == visible_edges(before, q));
    } else if (where.where == MW_INSIDE) {
        REQUIRE(change->made == 2 && change->reused >= 1);
    } else {
        const uint32_t *v = corners_of(before, where.triangle);
        size_t sides = (size_t)count_sides(before, v[where.local], v[(where.local + 1) % 3]);
        REQUIRE(change->made == sides && change->reused >= sides);
    }
    split_fixed(t, change->vertex);
}

/* How many triangles of the star, or of its part on the same side of the constraint through the vertex, have a higher number. */
static inline uint32_t rank_in_star(const twin *t, const star *s, uint32_t i)
{
    uint32_t higher = 0;
    for (uint32_t j = i + 1; j < s->count; j++) {
        int sides = 1;
        if (s->fixed_count == 2) {
            const double *a = at(t, s->fixed[0]), *b = at(t, s->fixed[1]);
            int one = exact_orient(a, b, at(t, s->side[i].from)) + exact_orient(a, b, at(t, s->side[i].to));
            sides = one * (exact_orient(a, b, at(t, s->side[j].from)) + exact_orient(a, b, at(t, s->side[j].to)));
        }
        higher += sides > 0;
    }
    return higher;
}

static inline void after_remove(twin *t, const twin *before, const mw_edit *e, const mw_change *change)
{
    star s = star_of(before, e->vertex);
    REQUIRE(change->vertex == e->vertex && change->vertices_freed && change->made == 0);
    if (s.border_count == 0) REQUIRE(change->freed == 2);
    if (s.border_count > 0 && !t->convex) REQUIRE(change->freed == 1);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < s.count; i++) {
        bool there = is_there(t, s.side[i].triangle);
        REQUIRE(there == (rank_in_star(before, &s, i) >= (s.fixed_count == 2 ? 1 : change->freed)));
        kept += there;
    }
    if (!change->flips) REQUIRE(change->reused == kept);
    if (s.fixed_count == 2) {
        for (int k = 0; k < 2; k++)
            if (is_fixed(t, e->vertex, s.fixed[k])) unfix(t, e->vertex, s.fixed[k]);
        if (is_fixed(before, e->vertex, s.fixed[0])) fix(t, s.fixed[0], s.fixed[1]);
    }
    star_free(&s);
}

static inline void after_move(twin *t, const twin *before, const mw_edit *e, const mw_change *change)
{
    const double q[2] = {e->x, e->y};
    uint32_t v = e->vertex;
    REQUIRE(change->vertex == v && !change->vertices_made && !change->vertices_freed);
    memcpy(t->point + 2 * (size_t)v, q, sizeof q);
    split_fixed(t, v);
    star s = star_of(before, v);
    if (s.border_count == 0 && is_star_at(before, &s, q)) {
        REQUIRE(change->made == 0 && change->freed == 0);
        if (!change->flips) REQUIRE(change->reused == 0);
    }
    if (s.border_count > 0 && !t->convex) {
        size_t count, was;
        side *now = all_sides(t, &count), *then = all_sides(before, &was);
        for (size_t i = 0; i < count; i++)
            if (!find_side(now, count, now[i].to, now[i].from))
                REQUIRE(find_side(then, was, now[i].from, now[i].to) && !find_side(then, was, now[i].to, now[i].from));
        free(now);
        free(then);
        keep_border(t);
        t->border_moved = true;
    }
    star_free(&s);
}

static inline void after_flip(twin *t, const twin *before, const mw_edit *e, const mw_change *change)
{
    side s, r, other;
    bool found = find_edge(before, e->vertex, e->other, &s) && find_edge(before, e->other, e->vertex, &r);
    REQUIRE(found && change->made == 0 && change->freed == 0 && change->reused == 2);
    REQUIRE(find_edge(t, s.apex, r.apex, &other) && find_edge(t, r.apex, s.apex, &other));
    if (exact_incircle(at(t, s.from), at(t, s.to), at(t, s.apex), at(t, r.apex)) != 0) t->delaunay = false;
}

static inline void after_constrain(twin *t, const mw_edit *e, const mw_change *change)
{
    size_t count;
    uint32_t *way = way_of(t, e->vertex, e->other, &count);
    REQUIRE(change->constrained_edges == count - 1 && change->made == 0 && change->freed == 0);
    for (size_t i = 1; i < count; i++) {
        if (e->kind == MW_EDIT_RELEASE)
            unfix(t, way[i - 1], way[i]);
        else if (t->convex || count_sides(t, way[i - 1], way[i]) == 2)
            fix(t, way[i - 1], way[i]);
    }
    free(way);
}

static inline void take_over(twin *t, const mw_edit *e, const mw_change *change)
{
    twin before = twin_copy(t);
    absorb(t, change, false);
    switch (e->kind) {
    case MW_EDIT_INSERT: after_insert(t, &before, e, change); break;
    case MW_EDIT_REMOVE: after_remove(t, &before, e, change); break;
    case MW_EDIT_MOVE: after_move(t, &before, e, change); break;
    case MW_EDIT_FLIP: after_flip(t, &before, e, change); break;
    case MW_EDIT_VALUE:
        REQUIRE(is_still(change));
        t->value[e->field][e->vertex] = e->value;
        break;
    default: after_constrain(t, e, change); break;
    }
    for (size_t i = 0; i < change->made; i++) REQUIRE(turn_of(t, change->triangle[i].triangle) > 0);
    if (!before.delaunay && e->kind == MW_EDIT_INSERT) REQUIRE(change->flips == 0);
    twin_close(&before);
}

/* --- an edit ------------------------------------------------------------------------------------------------------------------- */

/* By the function of its kind, or by the one for all. */
static inline mw_status call_edit(mw_editor *editor, const mw_edit *e, bool direct, mw_change *change, mw_error *error)
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

/* Refused: the place is named, where there is one, and the text says something. */
static inline void check_refusal(const twin *t, const mw_edit *e, const mw_error *error)
{
    const double q[2] = {e->x, e->y};
    bool away = e->kind == MW_EDIT_INSERT || (e->kind == MW_EDIT_MOVE && twin_locate(t, q).triangle == MW_NONE);
    REQUIRE(error->status == MW_ERROR_INPUT && strlen(error->message) > 8);
    if (!away) REQUIRE(error->vertex >= 0 || error->triangle >= 0);
}

static inline mw_status twin_apply(twin *t, const mw_edit *edit, bool direct)
{
    mw_change change;
    mw_error error = {0};
    mw_edit e = *edit;
    if (direct && e.kind == MW_EDIT_INSERT) e.value = NAN;
    case_edit = e;
    memset(&change, 77, sizeof change);
    outcome expected = foretell(t, &e);
    mw_status status = call_edit(t->editor, &e, direct, &change, &error);
    REQUIRE(status == MW_OK || status == MW_ERROR_INPUT);
    if (expected != EITHER) REQUIRE((status == MW_OK) == (expected == DONE));
    if (status == MW_OK) {
        take_over(t, &e, &change);
    } else {
        check_refusal(t, &e, &error);
        check_same(t);
    }
    return status;
}

/* An edit was taken back, as `change` tells: the twin is what it was before, which is `then`. */
static inline void twin_undone(twin *t, const twin *then, const mw_change *change)
{
    absorb(t, change, true);
    REQUIRE(t->vertex_range == then->vertex_range && t->triangle_range == then->triangle_range);
    REQUIRE(memcmp(t->triangle, then->triangle, 3 * sizeof *t->triangle * t->triangle_range) == 0);
    REQUIRE(memcmp(t->state, then->state, t->vertex_range) == 0);
    twin c = twin_copy(then);
    c.shared = t->shared;
    t->shared = true; /* the editor goes on */
    twin_close(t);
    *t = c;
    check_same(t);
}

static inline void twin_undo(twin *t, const twin *then)
{
    mw_change change;
    mw_error error = {0};
    memset(&change, 77, sizeof change);
    expect_ok(mw_edit_undo(t->editor, &change, &error), "undo", &error);
    twin_undone(t, then, &change);
}

/* Compact: the twin by its new numbers. */
static inline void twin_compact(twin *t)
{
    uint32_t *triangles = room(t->triangle_range, sizeof *triangles),
             *vertices = room(t->vertex_range, sizeof *vertices);
    triangles[t->triangle_range] = vertices[t->vertex_range] = 4711;
    mw_mesh *mesh;
    mw_error error = {0};
    expect_ok(mw_editor_mesh(t->editor, NULL, NULL, &mesh, &error), "mesh", &error);
    expect_ok(mw_editor_compact(t->editor, triangles, vertices, &error), "compact", &error);
    check_mesh_given(t, mesh, triangles, vertices);
    for (uint32_t v = 0; v < t->vertex_range; v++)
        if (vertices[v] != MW_NONE) t->state[vertices[v]] = t->state[v];
    for (size_t i = 0; i < t->fixed_count; i++) {
        uint32_t a = vertices[t->fixed[2 * i]], b = vertices[t->fixed[2 * i + 1]];
        t->fixed[2 * i] = a < b ? a : b;
        t->fixed[2 * i + 1] = a < b ? b : a;
    }
    t->vertex_range = t->vertices;
    t->triangle_range = t->triangles;
    for (uint32_t v = 0; v < t->vertices; v++) {
        mw_mesh_vertex(mesh, v, t->point + 2 * (size_t)v);
        for (uint32_t f = 0; f < t->fields; f++) t->value[f][v] = mw_mesh_field(mesh, twin_field[f])[v];
    }
    for (uint32_t k = 0; k < t->triangles; k++) mw_mesh_triangle(mesh, k, t->triangle + 3 * (size_t)k);
    mw_mesh_destroy(mesh);
    free(triangles);
    free(vertices);
    check_same(t);
    size_t count = 4711;
    mw_editor_log(t->editor, &count);
    REQUIRE(count == 0 && mw_edit_undo(t->editor, NULL, &error) == MW_ERROR_INPUT);
}

/* The log, applied to the same mesh, gives the same editor. */
static inline void check_replay(const twin *t, const mw_editor_options *options)
{
    size_t count;
    const mw_edit *log = mw_editor_log(t->editor, &count);
    mw_error error = {0};
    twin again = twin_copy(t);
    expect_ok(mw_editor_create(t->first, options, &again.editor, &error), "editor", &error);
    for (size_t i = 0; i < count; i++) expect_ok(mw_edit_apply(again.editor, &log[i], NULL, &error), "replay", &error);
    check_same(&again);
    mw_editor_destroy(again.editor);
    twin_close(&again);
}

#endif
