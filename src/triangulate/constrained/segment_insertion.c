/* segment_insertion.c - segments forced into a triangulation.
 *
 *           q---s
 *         / |  / \
 *       a...|./...w--b
 *         \ | /  /
 *           p---'
 *
 * The triangles that the segment a->b crosses form a channel. It is emptied and filled again on
 * both sides of the new edge: ears are cut off the boundary, those with a short base first, then
 * put back in the opposite order, with flips that keep the Delaunay property [Lawson 1977]. The
 * subsegment ends at the first vertex w on the segment. The right boundary runs a, p, ..., w, the
 * left boundary w, s, q, ..., a: the channel lies to their left.
 *
 * Why one may cut off an ear p, q, r wherever the boundary turns left: every vertex of the boundary
 * sees a point of the segment across the channel, and these points follow each other as the
 * vertices do. The lines of sight from p and r, the boundary between them and the segment bound a
 * polygon with no other vertex of the boundary in it; q is a convex corner of it, and its other two
 * corners lie on the line a->b, which the triangle p, q, r does not reach (but in a or w). So the
 * ear is empty, and cutting it off keeps the lines of sight. A boundary that nowhere turns left is
 * the segment itself. Boundaries may run to a vertex and back along one edge; the turn there is 0.
 *
 * Which ear is cut first decides how many flips follow. Taken by the lengths of their bases, up to
 * a factor, they left less than two flips for each triangle of the channel in all meshes tried, and
 * mostly less than one, while a scan that cuts each ear as it finds it left flips as the square of
 * their number on some. That remains the worst case. Flips never cross the boundary: its edges were
 * Delaunay before, and now see no more vertices than then. */
#include "triangulate/constrained/segment_insertion.h"

#include <stdlib.h>
#include <string.h>

struct mw_channel_step {
    uint32_t from, to;
    uint32_t half;  /* the half-edge inside the channel: the old one, later the new one  */
    uint32_t outer; /* the half-edge beyond the boundary; MW_NONE on the hull                 */
    uint32_t subsegment;
    /* a triangle of the channel, whose number an ear with this step and the one after it may
     * take */
    uint32_t slot;
    /* the boundary runs along both sides of this edge: the other side */
    mw_channel_step *mate;
    /* in the ring: */
    /* the step of the boundary this is a copy of, NULL for the base of an ear */
    mw_channel_step *origin;
    /* its neighbours, or MW_NONE */
    uint32_t before, after;
    /* of ears, where it makes one with the step after it; else MW_NONE */
    uint32_t line;
    /* its neighbours in that line, or MW_NONE */
    uint32_t ahead, behind;
};

/* Ears wait in queues; those of a queue have bases of about the same length, and the queue with the
 * shortest bases comes first. The number of a queue is the exponent of the squared length and the
 * first bit of its fraction. */
enum { LINES = 64 * 64, LINE_SHIFT = 51 };

struct mw_ears {
    uint64_t some;        /* which words of `waiting` are not 0 */
    uint64_t waiting[64]; /* a bit per line                     */
    struct {
        uint32_t first, last; /* steps of the ring */
    } line[LINES];
};

enum { IN_CHANNEL = 1, AWAY }; /* marks in mw_triangle.user */

bool mw__segment_insertion_create(mw_segment_insertion *c, const mw_point *point,
                                  uint32_t point_count, mw_triangle *tri, uint32_t tri_count)
{
    *c = (mw_segment_insertion){.point = point,
                                .tri = tri,
                                .point_count = point_count,
                                .tri_count = tri_count,
                                .reach = SIZE_MAX};
    c->subsegment = mw__alloc(3 * (size_t)tri_count, sizeof *c->subsegment);
    c->at = mw__alloc(point_count, sizeof *c->at);
    c->ears = mw__calloc(1, sizeof *c->ears);
    if (!c->subsegment || !c->at || !c->ears) return false;
    for (uint32_t t = 0; t < tri_count; t++) {
        tri[t].user = 0;
        for (uint32_t k = 0; k < 3; k++) {
            c->subsegment[3 * (size_t)t + k] = MW_NONE;
            c->at[tri[t].v[k]] = t;
        }
    }
    return true;
}

void mw__segment_insertion_release(mw_segment_insertion *c)
{
    free(c->subsegment);
    free(c->at);
    free(c->right);
    free(c->left);
    free(c->ring);
    free(c->ears);
    free(c->channel);
    free(c->flip);
    *c = (mw_segment_insertion){0};
}

static uint32_t *half_subsegment(const mw_segment_insertion *c, uint32_t half)
{
    return &c->subsegment[3 * (size_t)mw__link_triangle(half) + mw__link_edge(half)];
}

static uint32_t *half_link_field(const mw_segment_insertion *c, uint32_t half)
{
    return &c->tri[mw__link_triangle(half)].link[mw__link_edge(half)];
}

static double segment_vertex_side(const mw_segment_insertion *c, uint32_t a, uint32_t b, uint32_t p)
{
    return mw__orient2d(c->point[a], c->point[b], c->point[p]);
}

/* --- where a segment leaves a vertex --- */

/* Turns round a vertex: counter-clockwise to the hull or once round, then clockwise from the
 * beginning. */
typedef struct vertex_rotor {
    /* half-edges that leave the vertex; the triangle of `half` is looked at */
    uint32_t half, first;
    bool clockwise;
    /* the side of the target as seen along the two edges of the triangle, and of the first one */
    double right, left, first_right;
} vertex_rotor;

/* On which side of v->p the target lies. Where p is the target no test is made: it would be decided
 * exactly, slowly. */
static double segment_target_side(const mw_segment_insertion *c, uint32_t v, uint32_t p,
                                  uint32_t target)
{
    return p == target ? 0 : segment_vertex_side(c, v, p, target);
}

static vertex_rotor segment_rotor(const mw_segment_insertion *c, uint32_t vertex, uint32_t target)
{
    uint32_t t = c->at[vertex], k = 0;
    while (c->tri[t].v[k] != vertex) k++;
    vertex_rotor r = {.half = mw__link(t, k), .first = mw__link(t, k)};
    r.right = r.first_right = segment_target_side(c, vertex, c->tri[t].v[k + 1], target);
    r.left = segment_target_side(c, vertex, c->tri[t].v[mw__prev(k)], target);
    return r;
}

static void segment_rotor_turn(const mw_segment_insertion *c, vertex_rotor *r, uint32_t vertex,
                               uint32_t target)
{
    if (!r->clockwise) {
        uint32_t half = *half_link_field(c, mw__half_prev(r->half));
        if (half != MW_NONE) {
            r->half = half;
            r->right = r->left;
            r->left =
                segment_target_side(c, vertex, mw__half_start(c->tri, mw__half_prev(half)), target);
            return;
        }
        r->clockwise = true;
        r->half = r->first;
        r->right = r->first_right;
    }
    r->half = mw__half_next(*half_link_field(c, r->half));
    r->left = r->right;
    r->right = segment_target_side(c, vertex, mw__half_end(c->tri, r->half), target);
}

/* Does the segment to the target leave the vertex through the triangle of the rotor? If so, *half
 * is the edge that it runs along, as the half-edge that leaves the vertex (or, for the last edge at
 * the hull, the one that comes back), or else the opposite edge, which it crosses. */
static bool rotor_leaves_here(const vertex_rotor *r, uint32_t *half, bool *along)
{
    *along = r->right == 0 || r->left == 0;
    *half = r->right == 0  ? r->half
            : r->left == 0 ? mw__half_prev(r->half)
                           : mw__half_next(r->half);
    return (r->right >= 0 && r->left < 0) || (r->right > 0 && r->left == 0);
}

/* --- the channel --- */

static bool channel_reserve(mw_segment_insertion *c, size_t count)
{
    if (count <= c->step_capacity) return true;
    size_t capacity = count + count / 2 + 64;
    mw_channel_step *right = mw__realloc(c->right, capacity, sizeof *right);
    if (right) c->right = right;
    mw_channel_step *left = mw__realloc(c->left, capacity, sizeof *left);
    if (left) c->left = left;
    mw_channel_step *ring = mw__realloc(c->ring, capacity, sizeof *ring);
    if (ring) c->ring = ring;
    uint32_t *channel = mw__realloc(c->channel, capacity, sizeof *channel);
    if (channel) c->channel = channel;
    if (!right || !left || !ring || !channel) return false;
    c->step_capacity = capacity;
    return true;
}

/* The right boundary in order from a to w; the left boundary in the opposite order, from a to w,
 * too. */
typedef struct segment_channel {
    uint32_t a, w;
    size_t right_count, left_count, triangle_count;
} segment_channel;

static void channel_add_boundary(const mw_segment_insertion *c, mw_channel_step *boundary,
                                 size_t *count, uint32_t half)
{
    boundary[(*count)++] = (mw_channel_step){.from = mw__half_start(c->tri, half),
                                             .to = mw__half_end(c->tri, half),
                                             .half = half,
                                             .outer = *half_link_field(c, half),
                                             .subsegment = *half_subsegment(c, half),
                                             .slot = mw__link_triangle(half)};
}

/* Follow the segment from a through edge `half` to the first vertex on it. Changes no triangle. */
static mw_subsegment_result channel_open(mw_segment_insertion *c, uint32_t a, uint32_t b,
                                         uint32_t half, segment_channel *ch, uint32_t *crossed)
{
    *ch = (segment_channel){.a = a};
    if (!channel_reserve(c, 2)) return MW_SUBSEGMENT_MEMORY;
    channel_add_boundary(c, c->right, &ch->right_count, mw__half_prev(half));
    channel_add_boundary(c, c->left, &ch->left_count, mw__half_next(half));
    c->channel[ch->triangle_count++] = mw__link_triangle(half);
    for (;;) {
        *crossed = *half_subsegment(c, half);
        if (*crossed != MW_NONE) return MW_SUBSEGMENT_CROSSES;
        if (ch->triangle_count >= c->reach) return MW_SUBSEGMENT_FAR;
        if (!channel_reserve(c, ch->triangle_count + 2)) return MW_SUBSEGMENT_MEMORY;
        half = *half_link_field(c, half); /* its end is on the right now, its start on the left */
        c->channel[ch->triangle_count++] = mw__link_triangle(half);
        uint32_t w = mw__half_start(c->tri, mw__half_prev(half));
        double s = w == b ? 0 : segment_vertex_side(c, a, b, w);
        if (s <= 0) channel_add_boundary(c, c->right, &ch->right_count, mw__half_next(half));
        if (s >= 0) channel_add_boundary(c, c->left, &ch->left_count, mw__half_prev(half));
        if (s == 0) {
            ch->w = w;
            return MW_SUBSEGMENT_DONE;
        }
        half = s > 0 ? mw__half_next(half) : mw__half_prev(half);
    }
}

/* Steps of the boundary whose outer half-edge lies in the channel too: find it. Overwrites the
 * vertices of the triangles. */
static void channel_find_mates(mw_segment_insertion *c, const segment_channel *ch)
{
    mw_channel_step *boundaries[2] = {c->right, c->left};
    size_t counts[2] = {ch->right_count, ch->left_count};
    for (size_t i = 0; i < ch->triangle_count; i++) c->tri[c->channel[i]].user = IN_CHANNEL;
    for (int r = 0; r < 2; r++)
        for (uint32_t i = 0; i < counts[r]; i++)
            c->tri[mw__link_triangle(boundaries[r][i].half)]
                .v[mw__link_edge(boundaries[r][i].half)] = i;
    for (int r = 0; r < 2; r++)
        for (size_t i = 0; i < counts[r]; i++) {
            uint32_t outer = boundaries[r][i].outer;
            if (outer == MW_NONE || c->tri[mw__link_triangle(outer)].user != IN_CHANNEL) continue;
            /* no edge lies on both sides of the segment */
            boundaries[r][i].mate = &boundaries[r][mw__half_start(c->tri, outer)];
            boundaries[r][i].half = MW_NONE;
        }
    for (size_t i = 0; i < ch->triangle_count; i++) c->tri[c->channel[i]].user = 0;
}

/* --- filling the channel --- */

/* Link half-edge `half` of a new triangle to what lies beyond step s of the boundary. */
static void step_join(mw_segment_insertion *c, uint32_t half, const mw_channel_step *s)
{
    *half_subsegment(c, half) = s->subsegment;
    uint32_t outer = s->outer;
    if (s->mate) {
        s->origin->half = half;
        outer = s->mate->half; /* MW_NONE where the mate is not placed yet: it will link both */
    }
    *half_link_field(c, half) = outer;
    if (outer != MW_NONE) *half_link_field(c, outer) = half;
}

/* Make triangle t the ear of steps s0 and s1 of the boundary; its base becomes a step instead of
 * them. */
static mw_channel_step ear_cut(mw_segment_insertion *c, uint32_t t, const mw_channel_step *s0,
                               const mw_channel_step *s1)
{
    mw_triangle *tri = &c->tri[t];
    tri->v[0] = tri->v[3] = s0->from;
    tri->v[1] = s0->to;
    tri->v[2] = s1->to;
    for (int k = 0; k < 3; k++) c->at[tri->v[k]] = t;
    step_join(c, mw__link(t, 0), s0);
    step_join(c, mw__link(t, 1), s1);
    *half_subsegment(c, mw__link(t, 2)) = MW_NONE;
    return (mw_channel_step){.from = s0->from,
                             .to = s1->to,
                             .outer = mw__link(t, 2),
                             .subsegment = MW_NONE,
                             .slot = s1->slot};
}

static uint32_t ear_line(double base)
{
    uint64_t bits;
    memcpy(&bits, &base, sizeof bits); /* not negative, so the sign is 0 */
    return (uint32_t)(bits >> LINE_SHIFT);
}

static void ear_add(mw_segment_insertion *c, uint32_t i, double base)
{
    mw_ears *e = c->ears;
    uint32_t line = ear_line(base);
    bool empty = !(e->waiting[line / 64] >> line % 64 & 1);
    c->ring[i].line = line;
    c->ring[i].ahead = empty ? MW_NONE : e->line[line].last;
    c->ring[i].behind = MW_NONE;
    if (empty)
        e->line[line].first = i;
    else
        c->ring[e->line[line].last].behind = i;
    e->line[line].last = i;
    e->waiting[line / 64] |= UINT64_C(1) << line % 64;
    e->some |= UINT64_C(1) << line / 64;
}

static void ear_drop(mw_segment_insertion *c, uint32_t i)
{
    mw_ears *e = c->ears;
    const mw_channel_step *step = &c->ring[i];
    uint32_t line = step->line, ahead = step->ahead, behind = step->behind;
    if (line == MW_NONE) return;
    c->ring[i].line = MW_NONE;
    if (ahead == MW_NONE)
        e->line[line].first = behind;
    else
        c->ring[ahead].behind = behind;
    if (behind == MW_NONE)
        e->line[line].last = ahead;
    else
        c->ring[behind].ahead = ahead;
    if (ahead != MW_NONE || behind != MW_NONE) return;
    e->waiting[line / 64] &= ~(UINT64_C(1) << line % 64);
    if (!e->waiting[line / 64]) e->some &= ~(UINT64_C(1) << line / 64);
}

/* The first ear of the first line, MW_NONE if there is none. */
static uint32_t ear_first(const mw_segment_insertion *c)
{
    const mw_ears *e = c->ears;
    if (!e->some) return MW_NONE;
    unsigned word = (unsigned)__builtin_ctzll(e->some);
    return e->line[64 * word + (unsigned)__builtin_ctzll(e->waiting[word])].first;
}

/* Take note of whether the boundary turns left behind step i: then that step and the one after it
 * make an ear. */
static void ear_note(mw_segment_insertion *c, uint32_t i)
{
    mw_channel_step *step = &c->ring[i];
    ear_drop(c, i);
    if (step->after == MW_NONE) return;
    uint32_t to = c->ring[step->after].to;
    if (segment_vertex_side(c, step->from, step->to, to) <= 0) return;
    double dx = c->point[to].x - c->point[step->from].x,
           dy = c->point[to].y - c->point[step->from].y;
    ear_add(c, i, dx * dx + dy * dy);
}

/* Lay out a boundary of n steps, taken in order or backwards, for cutting. */
static void ring_lay_out(mw_segment_insertion *c, mw_channel_step *boundary, uint32_t n,
                         bool backwards)
{
    for (uint32_t i = 0; i < n; i++) {
        mw_channel_step *step = &boundary[backwards ? n - 1 - i : i];
        c->ring[i] = *step;
        c->ring[i].origin = step;
        c->ring[i].before = i > 0 ? i - 1 : MW_NONE;
        c->ring[i].after = i + 1 < n ? i + 1 : MW_NONE;
        c->ring[i].line = MW_NONE;
    }
    for (uint32_t i = 0; i < n; i++) ear_note(c, i);
}

/* Fill the side of the channel along a boundary; the ears are listed from c->channel[*next] on.
 * Returns the half-edge along the segment.
 *
 * An ear takes the number of the triangle that its first step was an edge of, so what is near in
 * the plane stays near in memory. That number is then free, and none is taken twice: only the
 * triangles at either end of the channel were at two steps, and the last step's number is never
 * taken; that is the triangle at w on the right boundary, the one at a on the left boundary, which
 * runs the other way. */
static uint32_t side_fill(mw_segment_insertion *c, mw_channel_step *boundary, size_t n,
                          bool backwards, size_t *next)
{
    ring_lay_out(c, boundary, (uint32_t)n, backwards);
    for (uint32_t i; (i = ear_first(c)) != MW_NONE;) {
        mw_channel_step *s0 = &c->ring[i], *s1 = &c->ring[s0->after];
        ear_drop(c, i);
        ear_drop(c, s0->after);
        uint32_t t = s0->slot;
        c->channel[(*next)++] = t;
        mw_channel_step base = ear_cut(c, t, s0, s1);
        base.line = MW_NONE;
        base.before = s0->before;
        base.after = s1->after;
        *s0 = base;
        if (base.after != MW_NONE) c->ring[base.after].before = i;
        ear_note(c, i);
        if (base.before != MW_NONE) ear_note(c, base.before);
    }
    return c->ring[0].outer;
}

/* --- the Delaunay property --- */

static bool channel_push_half(mw_segment_insertion *c, size_t *count, uint32_t half)
{
    if (*count == c->flip_capacity) {
        size_t capacity = 2 * c->flip_capacity + 64;
        uint32_t *flip = mw__realloc(c->flip, capacity, sizeof *flip);
        if (!flip) return false;
        c->flip = flip;
        c->flip_capacity = capacity;
    }
    c->flip[(*count)++] = half;
    return true;
}

static bool half_is_illegal(const mw_segment_insertion *c, uint32_t half)
{
    uint32_t twin = *half_link_field(c, half);
    if (twin == MW_NONE || *half_subsegment(c, half) != MW_NONE ||
        c->tri[mw__link_triangle(twin)].user == AWAY)
        return false;
    const mw_triangle *t = &c->tri[mw__link_triangle(half)];
    uint32_t apex = mw__half_start(c->tri, mw__half_prev(twin));
    return mw__incircle(c->point[t->v[0]], c->point[t->v[1]], c->point[t->v[2]], c->point[apex]) >
           0;
}

static void channel_set_triangle(mw_segment_insertion *c, uint32_t t, uint32_t v0, uint32_t v1,
                                 uint32_t v2)
{
    mw_triangle *tri = &c->tri[t];
    tri->v[0] = tri->v[3] = v0;
    tri->v[1] = v1;
    tri->v[2] = v2;
    for (int k = 0; k < 3; k++) c->at[tri->v[k]] = t;
}

/*        r                r
 *      / t \            / | \
 *     p --- q    -->   p t|n q    Replace edge p->q, which is `half`, by s->r.
 *      \ n /            \ | /
 *        s                s       */
static void channel_flip(mw_segment_insertion *c, uint32_t half)
{
    uint32_t twin = *half_link_field(c, half), t = mw__link_triangle(half),
             n = mw__link_triangle(twin);
    uint32_t p = mw__half_start(c->tri, half), q = mw__half_end(c->tri, half);
    uint32_t r = mw__half_start(c->tri, mw__half_prev(half)),
             s = mw__half_start(c->tri, mw__half_prev(twin));
    uint32_t sides[4] = {mw__half_next(twin), mw__half_prev(half), mw__half_prev(twin),
                         mw__half_next(half)}; /* ps, rp, sq, qr */
    mw_channel_step step[4];
    for (int i = 0; i < 4; i++)
        step[i] = (mw_channel_step){.outer = *half_link_field(c, sides[i]),
                                    .subsegment = *half_subsegment(c, sides[i])};
    channel_set_triangle(c, t, p, s, r);
    channel_set_triangle(c, n, s, q, r);
    step_join(c, mw__link(t, 0), &step[0]);
    step_join(c, mw__link(t, 2), &step[1]);
    step_join(c, mw__link(n, 0), &step[2]);
    step_join(c, mw__link(n, 1), &step[3]);
    *half_link_field(c, mw__link(t, 1)) = mw__link(n, 2);
    *half_link_field(c, mw__link(n, 2)) = mw__link(t, 1);
    *half_subsegment(c, mw__link(t, 1)) = *half_subsegment(c, mw__link(n, 2)) = MW_NONE;
}

/* Put the ear t, whose base is its edge 2, back on what lies beyond the base: flip the edges that
 * face its tip, until all are legal. Ends: each flip adds an edge at the tip. */
static bool channel_put_back(mw_segment_insertion *c, uint32_t t)
{
    size_t count = 0;
    if (!channel_push_half(c, &count, mw__link(t, 2))) return false;
    while (count > 0) {
        uint32_t half = c->flip[--count], twin = *half_link_field(c, half);
        if (!half_is_illegal(c, half)) continue;
        channel_flip(c, half);
        if (!channel_push_half(c, &count, mw__link(mw__link_triangle(half), 0)) ||
            !channel_push_half(c, &count, mw__link(mw__link_triangle(twin), 0)))
            return false;
    }
    return true;
}

/* Make the filled channel Delaunay: put the ears back one by one, the last that was cut off
 * first. */
static bool channel_legalize(mw_segment_insertion *c, size_t triangle_count)
{
    for (size_t i = 0; i < triangle_count; i++) c->tri[c->channel[i]].user = AWAY;
    for (size_t i = triangle_count; i-- > 0;) {
        c->tri[c->channel[i]].user = 0;
        if (!channel_put_back(c, c->channel[i])) return false;
    }
    return true;
}

/* --- subsegments --- */

uint32_t mw__segment_insertion_mark(mw_segment_insertion *c, uint32_t half)
{
    if (*half_subsegment(c, half) == MW_NONE) {
        *half_subsegment(c, half) = c->subsegment_count++;
        if (*half_link_field(c, half) != MW_NONE)
            *half_subsegment(c, *half_link_field(c, half)) = *half_subsegment(c, half);
    }
    return *half_subsegment(c, half);
}

/* A segment that crosses no edge but `half` becomes an edge by a flip; the sides of the two
 * triangles were Delaunay, and now see fewer vertices. Returns whether it is so. */
static bool channel_cut_one(mw_segment_insertion *c, uint32_t a, uint32_t b, uint32_t half,
                            uint32_t *w, uint32_t *number)
{
    if (*half_subsegment(c, half) != MW_NONE) return false;
    *w = mw__half_start(c->tri, mw__half_prev(*half_link_field(c, half)));
    if (*w != b && segment_vertex_side(c, a, b, *w) != 0) return false;
    channel_flip(c, half);
    *number = mw__segment_insertion_mark(c, mw__link(mw__link_triangle(half), 1));
    c->crossed += 2;
    return true;
}

/* Make an edge from a towards b, through edge `half`. */
static mw_subsegment_result channel_cut(mw_segment_insertion *c, uint32_t a, uint32_t b,
                                        uint32_t half, uint32_t *w, uint32_t *number)
{
    if (channel_cut_one(c, a, b, half, w, number)) return MW_SUBSEGMENT_DONE;
    segment_channel ch;
    mw_subsegment_result result = channel_open(c, a, b, half, &ch, number);
    if (result != MW_SUBSEGMENT_DONE) {
        c->wasted += ch.triangle_count;
        return result;
    }
    c->crossed += ch.triangle_count;
    channel_find_mates(c, &ch);
    size_t next = 0;
    uint32_t right = side_fill(c, c->right, ch.right_count, false, &next);
    uint32_t left = side_fill(c, c->left, ch.left_count, true, &next);
    *half_link_field(c, right) = left;
    *half_link_field(c, left) = right;
    *number = mw__segment_insertion_mark(c, left);
    *w = ch.w;
    return channel_legalize(c, ch.triangle_count) ? MW_SUBSEGMENT_DONE : MW_SUBSEGMENT_MEMORY;
}

mw_subsegment_result mw__insert_subsegment(mw_segment_insertion *c, uint32_t *from, uint32_t *to,
                                           mw_subsegment *subsegment)
{
    /* Turn round both ends at once: at a vertex of high degree this takes as long as its segments'
     * other ends allow. */
    vertex_rotor rotors[2] = {segment_rotor(c, *from, *to), segment_rotor(c, *to, *from)};
    uint32_t *ends[2] = {from, to}, half;
    unsigned i = 0;
    bool along;
    while (!rotor_leaves_here(&rotors[i], &half, &along)) {
        segment_rotor_turn(c, &rotors[i], *ends[i], *ends[1 - i]);
        i = 1 - i;
    }
    uint32_t w;
    mw_subsegment_result result = MW_SUBSEGMENT_DONE;
    if (along) {
        w = mw__half_start(c->tri, half) == *ends[i] ? mw__half_end(c->tri, half)
                                                     : mw__half_start(c->tri, half);
        subsegment->number = mw__segment_insertion_mark(c, half);
    } else {
        result = channel_cut(c, *ends[i], *ends[1 - i], half, &w, &subsegment->number);
        if (result != MW_SUBSEGMENT_DONE) return result;
    }
    subsegment->from = i == 0 ? *from : w;
    subsegment->to = i == 0 ? w : *to;
    *ends[i] = w;
    return result;
}

/* From `from`, through edge `half`, to the first vertex on the segment; MW_NONE if `meet` will not
 * go on. */
static uint32_t segment_follow(const mw_segment_insertion *c, uint32_t from, uint32_t to,
                               uint32_t half, mw_segment_visitor *meet, void *context)
{
    if (!meet(context, MW_MEETS_TRIANGLE, mw__link_triangle(half))) return MW_NONE;
    for (;;) {
        uint32_t subsegment = *half_subsegment(c, half);
        if (subsegment != MW_NONE && !meet(context, MW_MEETS_SUBSEGMENT, subsegment))
            return MW_NONE;
        half = *half_link_field(c, half);
        if (!meet(context, MW_MEETS_TRIANGLE, mw__link_triangle(half))) return MW_NONE;
        uint32_t w = mw__half_start(c->tri, mw__half_prev(half));
        double s = w == to ? 0 : segment_vertex_side(c, from, to, w);
        if (s == 0) return w;
        half = s > 0 ? mw__half_next(half) : mw__half_prev(half);
    }
}

bool mw__segment_insertion_trace(const mw_segment_insertion *c, uint32_t from, uint32_t to,
                                 mw_segment_visitor *meet, void *context)
{
    while (from != to) {
        uint32_t half;
        bool along;
        vertex_rotor r = segment_rotor(c, from, to);
        while (!rotor_leaves_here(&r, &half, &along)) segment_rotor_turn(c, &r, from, to);
        if (along && !meet(context, MW_MEETS_EDGE, half)) return false;
        if (along)
            from = mw__half_start(c->tri, half) == from ? mw__half_end(c->tri, half)
                                                        : mw__half_start(c->tri, half);
        else
            from = segment_follow(c, from, to, half, meet, context);
        if (from == MW_NONE || (from != to && !meet(context, MW_MEETS_VERTEX, from))) return false;
    }
    return true;
}
