/* min_weight.c - triangulation of least weight: the LMT skeleton [Dickerson, Keil, Montague 1997],
 * then the faces it leaves.
 *
 * Everything hangs on one triangulation T. It is the greedy triangulation, made locally minimal:
 * each edge that is the longer diagonal of a strictly convex quadrilateral is exchanged for the
 * other. The candidates are the edges with the diamond property and those of T. An edge of T is
 * never removed from them: its two triangles in T keep it, and their sides keep each other. So a
 * candidate that no other one crosses is in T. To find the skeleton, each candidate that is not in
 * T is followed through T from one end to the other, and the edges that it crosses are marked; the
 * edges of T without a mark are the skeleton.
 *
 * A face is then a set of triangles of T, joined across marked edges. If these edges join them to a
 * tree, the face is a polygon (its border may touch itself, as where an edge of the skeleton ends
 * inside), all candidates that cross it are known, with the corners where they begin and end, and
 * dynamic programming finds its least weight. If they make rings, there are vertices or parts of
 * the skeleton inside the face. It is cut open along as many edges of T as there are rings; then
 * dynamic programming finds the least weight of the triangulations with these edges, which is a
 * local optimum. Faces that are too large stay as they are in T. */
#include "mesh/connect.h"
#include "triangulate/kinds/kind_maker.h"
#include "triangulate/kinds/lmt.h"

#include <math.h>
#include <stdlib.h>

/* What may be spent, for some seconds each: on finding candidates, on reducing them and on their
 * walks; on faces. */
#define STEPS_AT_LEAST (UINT64_C(1) << 29)
#define STEPS_PER_POINT 5000
#define CANDIDATES_AT_LEAST (UINT64_C(1) << 21)
#define CANDIDATES_PER_POINT 100
#define FACE_STEPS (UINT64_C(1) << 32)
#define LIMIT_THAT_COUNTS (UINT32_C(1) << 20) /* the cube of more would not be a number of steps */

/* A candidate that is not in T: where it leaves the first triangle and comes to the last, as
 * triangle and corner. */
typedef struct weigher_crossing {
    uint32_t from, to;
    uint32_t next; /* of those with the same first triangle, or MW_NONE */
} weigher_crossing;

typedef struct weigher {
    mw_triangulation *t;
    mw_point *scaled;
    mw_scaled points;
    uint32_t *at;   /* per point: a triangle that has it, or MW_NONE                       */
    uint8_t *mark;  /* per triangle: edges to be looked at, later those that are crossed   */
    uint32_t *list; /* triangles: a stack, later those of a face                           */
    mw_edge_list edges;
    mw_lmt lmt;
    weigher_crossing *crossing;
    uint32_t *chain;  /* per triangle: the first of the crossings that leave it            */
    bool *seen;       /* per triangle: its face has been found                             */
    uint32_t *corner; /* at 3 * triangle + vertex: the number of the corner in its face    */
    uint32_t *vertex; /* per corner of a face: its vertex                                  */
    bool whole;       /* there is no skeleton: too much would have to be spent on it       */
    uint64_t face_steps;
} weigher;

static mw_triangle *weigher_triangle(const weigher *w, uint32_t link)
{
    return &w->t->tri[mw__link_triangle(link)];
}

static double weigher_vertex_side(const weigher *w, uint32_t a, uint32_t b, uint32_t c)
{
    return mw__orient2d(w->t->point[a], w->t->point[b], w->t->point[c]);
}

static bool weigher_edge_is_marked(const weigher *w, uint32_t t, uint32_t k)
{
    return w->mark[t] >> k & 1;
}

static bool half_has_mark(const weigher *w, uint32_t half)
{
    return weigher_edge_is_marked(w, mw__link_triangle(half), mw__link_edge(half));
}

static void half_set_mark(const weigher *w, uint32_t half)
{
    w->mark[mw__link_triangle(half)] |= (uint8_t)(1u << mw__link_edge(half));
}

/* --- locally minimal --- */

/* Exchange the edge `half` for the other diagonal. The new triangles have their edges where they
 * were, so that the four around are edges 1 and 2 of one and of the other. */
static void half_exchange(const weigher *w, uint32_t half)
{
    uint32_t twin = mw__half_link(w->t->tri, half), a = mw__half_start(w->t->tri, half),
             b = mw__half_start(w->t->tri, twin);
    uint32_t p = mw__half_start(w->t->tri, mw__half_prev(half)),
             q = mw__half_start(w->t->tri, mw__half_prev(twin));
    uint32_t around[4] = {mw__half_link(w->t->tri, mw__half_prev(half)),
                          mw__half_link(w->t->tri, mw__half_next(twin)),
                          mw__half_link(w->t->tri, mw__half_prev(twin)),
                          mw__half_link(w->t->tri, mw__half_next(half))}; /* pa, aq, qb, bp */
    uint32_t s = mw__link_triangle(half), t = mw__link_triangle(twin);
    w->t->tri[s] = (mw_triangle){{q, p, a, q}, {mw__link(t, 0), around[0], around[1]}, 0};
    w->t->tri[t] = (mw_triangle){{p, q, b, p}, {mw__link(s, 0), around[2], around[3]}, 0};
    for (uint32_t i = 0; i < 4; i++)
        if (around[i] != MW_NONE)
            weigher_triangle(w, around[i])->link[mw__link_edge(around[i])] =
                mw__link(i < 2 ? s : t, 1 + i % 2);
}

static bool half_is_too_long(const weigher *w, uint32_t half)
{
    uint32_t twin = mw__half_link(w->t->tri, half);
    if (twin == MW_NONE) return false;
    uint32_t a = mw__half_start(w->t->tri, half), b = mw__half_start(w->t->tri, twin);
    uint32_t p = mw__half_start(w->t->tri, mw__half_prev(half)),
             q = mw__half_start(w->t->tri, mw__half_prev(twin));
    return mw__surely_longer(mw__square(&w->points, a, b), mw__square(&w->points, p, q)) &&
           weigher_vertex_side(w, p, a, q) > 0 && weigher_vertex_side(w, q, b, p) > 0;
}

enum { ALL_EDGES = 7, OUTER_EDGES = 6, ON_STACK = 8 };

/* Each exchange makes the sum of lengths surely less, so this ends. It leaves no mark. Returns
 * false if the job is to stop. */
static bool weigher_shorten(weigher *w)
{
    uint32_t count = w->t->tri_count;
    uint64_t tried = 0;
    for (uint32_t t = 0; t < count; t++) {
        w->mark[t] = ALL_EDGES | ON_STACK;
        w->list[t] = t;
    }
    while (count > 0) {
        if (!mw__job_step(w->t->job, tried, tried + count)) return false;
        uint32_t t = w->list[count - 1], k = 0;
        while (k < 3 && !weigher_edge_is_marked(w, t, k)) k++;
        if (k == 3) {
            w->mark[t] = 0;
            count--;
            tried++;
            continue;
        }
        uint32_t half = mw__link(t, k), other = mw__link_triangle(mw__half_link(w->t->tri, half));
        w->mark[t] &= (uint8_t) ~(1u << k);
        if (!half_is_too_long(w, half)) continue;
        half_exchange(w, half);
        if (!(w->mark[other] & ON_STACK)) w->list[count++] = other;
        w->mark[t] |= OUTER_EDGES;
        w->mark[other] |= OUTER_EDGES | ON_STACK;
    }
    return true;
}

static void weigher_index_vertices(weigher *w)
{
    for (uint32_t v = 0; v < w->t->point_count; v++) w->at[v] = MW_NONE;
    for (uint32_t t = 0; t < w->t->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) w->at[w->t->tri[t].v[k]] = t;
}

/* --- candidates and their walks --- */

/* The half-edge from u in the triangle that the way to v leaves through; MW_NONE if it leaves along
 * an edge. */
static uint32_t weigher_way_out(const weigher *w, uint32_t u, uint32_t v, uint64_t *steps)
{
    uint32_t t = w->at[u], k = 0;
    while (w->t->tri[t].v[k] != u) k++;
    uint32_t first = mw__link(t, k), half = first;
    bool clockwise = false;
    do {
        ++*steps;
        if (weigher_vertex_side(w, u, mw__half_start(w->t->tri, mw__half_next(half)), v) > 0 &&
            weigher_vertex_side(w, u, mw__half_start(w->t->tri, mw__half_prev(half)), v) < 0)
            return half;
        uint32_t beyond = clockwise ? mw__half_link(w->t->tri, half)
                                    : mw__half_link(w->t->tri, mw__half_prev(half));
        if (beyond == MW_NONE && !clockwise) { /* the hull: turn the other way from the beginning */
            clockwise = true;
            half = first;
            beyond = mw__half_link(w->t->tri, first);
        }
        if (beyond == MW_NONE) return MW_NONE;
        half = clockwise ? mw__half_next(beyond) : beyond;
    } while (half != first);
    return MW_NONE;
}

/* Walk through T from u to v, no neighbour of it; false if there is a point on the way. */
static bool weigher_walk(const weigher *w, uint32_t u, uint32_t v, bool marking,
                         weigher_crossing *way, uint64_t *steps)
{
    uint32_t half = weigher_way_out(w, u, v, steps);
    if (half == MW_NONE) return false;
    way->from = half;
    for (half = mw__half_next(half);; ++*steps) {
        uint32_t twin = mw__half_link(w->t->tri, half),
                 apex = mw__half_start(w->t->tri, mw__half_prev(twin));
        if (marking) {
            half_set_mark(w, half);
            half_set_mark(w, twin);
        }
        if (apex == v) {
            way->to = mw__half_prev(twin);
            return true;
        }
        double turn = weigher_vertex_side(w, u, v, apex);
        if (turn == 0) return false;
        half = turn > 0 ? mw__half_next(twin) : mw__half_prev(twin);
    }
}

static int weigher_keys_compare(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static bool weigher_push_known(weigher *w)
{
    for (uint32_t t = 0; t < w->t->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) {
            const mw_triangle *tri = &w->t->tri[t];
            if (tri->link[k] != MW_NONE && mw__link_triangle(tri->link[k]) < t) continue;
            if (!mw__edge_push(&w->edges, mw__edge_key(tri->v[k], tri->v[k + 1]) | MW_EDGE_KNOWN))
                return false;
        }
    return true;
}

/* Keep, once each, the edges of T and those that were found from both ends and hold no point. */
static bool weigher_sift(weigher *w, mw_effort *effort)
{
    mw_edge_list *list = &w->edges;
    size_t kept = 0;
    qsort(list->key, list->count, sizeof *list->key, weigher_keys_compare);
    for (size_t i = 0, next; i < list->count; i = next) {
        uint64_t last = list->key[i], edge = last | MW_EDGE_KNOWN, steps = 0;
        for (next = i + 1; next < list->count && (list->key[next] | MW_EDGE_KNOWN) == edge; next++)
            last = list->key[next];
        weigher_crossing way;
        if (last == edge ||
            (next - i == 2 &&
             weigher_walk(w, mw__edge_low(edge), mw__edge_high(edge), false, &way, &steps)))
            list->key[kept++] = last;
        if (effort->steps <= steps) return false;
        effort->steps -= steps;
    }
    list->count = kept;
    return true;
}

static mw_lmt_result weigher_find_candidates(weigher *w, mw_effort effort)
{
    uint32_t count = 0, *used = mw__alloc(w->t->point_count, sizeof *used);
    if (!used) return MW_LMT_MEMORY;
    for (uint32_t v = 0; v < w->t->point_count; v++)
        if (w->at[v] != MW_NONE) used[count++] = v;
    mw__job_stage(w->t->job, "finding candidates", 0.3);
    mw_lmt_result result = mw__diamond(&w->points, used, count, &effort, &w->edges);
    mw__job_stage(w->t->job, "sifting candidates", 0.05);
    free(used);
    if (result == MW_LMT_DONE && !weigher_push_known(w)) result = MW_LMT_MEMORY;
    if (result == MW_LMT_DONE && !weigher_sift(w, &effort)) result = MW_LMT_SPENT;
    return result;
}

/* What remains of the candidates and is not in T crosses T. */
static mw_lmt_result weigher_mark_crossed(weigher *w, mw_effort effort)
{
    size_t count = 0;
    for (uint32_t e = 0; e < w->lmt.edge_count; e++) count += w->lmt.state[e] == MW_LMT_ALIVE;
    w->crossing = mw__alloc(count, sizeof *w->crossing);
    w->chain = mw__alloc(w->t->tri_count, sizeof *w->chain);
    if (!w->crossing || !w->chain) return MW_LMT_MEMORY;
    for (uint32_t t = 0; t < w->t->tri_count; t++) w->chain[t] = MW_NONE;
    count = 0;
    for (uint32_t e = 0; e < w->lmt.edge_count; e++) {
        if (w->lmt.state[e] != MW_LMT_ALIVE) continue;
        if (!mw__job_step(w->t->job, e, w->lmt.edge_count)) return MW_LMT_MEMORY;
        weigher_crossing *way = &w->crossing[count];
        uint64_t steps = 0;
        weigher_walk(w, w->lmt.from[2 * e], w->lmt.from[2 * e + 1], true, way, &steps);
        way->next = w->chain[mw__link_triangle(way->from)];
        w->chain[mw__link_triangle(way->from)] = (uint32_t)count++;
        if (effort.steps <= steps) return MW_LMT_SPENT;
        effort.steps -= steps;
    }
    return MW_LMT_DONE;
}

static mw_lmt_result weigher_make_skeleton(weigher *w, uint32_t limit)
{
    uint64_t n = w->t->point_count, most = limit < n ? limit : n;
    if (most > LIMIT_THAT_COUNTS) most = LIMIT_THAT_COUNTS;
    mw_effort effort = {STEPS_AT_LEAST + STEPS_PER_POINT * n,
                        CANDIDATES_AT_LEAST + CANDIDATES_PER_POINT * n, w->t->job};
    mw_effort extended = {effort.steps + most * most * most, effort.candidates + most * most,
                          w->t->job};
    mw_lmt_result result = weigher_find_candidates(w, extended);
    if (result == MW_LMT_DONE) {
        result = mw__lmt_create(&w->lmt, &w->points, &w->edges);
        free(w->edges.key);
        w->edges = (mw_edge_list){0};
    }
    if (result == MW_LMT_DONE) {
        mw__job_stage(w->t->job, "reducing candidates", 0.2);
        mw__lmt_reduce(&w->lmt, &effort);
        mw__job_stage(w->t->job, "following candidates", 0.05);
        result = weigher_mark_crossed(w, extended);
    }
    mw__lmt_release(&w->lmt);
    return result;
}

/* --- faces --- */

typedef struct skeleton_face {
    uint32_t triangles; /* at the beginning of w->list */
    uint32_t border;    /* edges of it, those met twice counted twice */
    bool is_cut;
} skeleton_face;

enum {
    TREE_SHIFT = 4
}; /* marked edges that join a triangle to one found before have a second mark, this much higher */

static skeleton_face weigher_find_face(weigher *w, uint32_t first)
{
    skeleton_face f = {0};
    uint32_t joints = 0; /* marked edges, counted from both sides */
    w->list[f.triangles++] = first;
    w->seen[first] = true;
    for (uint32_t i = 0; i < f.triangles; i++) {
        uint32_t t = w->list[i];
        for (uint32_t k = 0; k < 3; k++) {
            if (!weigher_edge_is_marked(w, t, k)) continue;
            uint32_t other = mw__link_triangle(w->t->tri[t].link[k]);
            joints++;
            if (w->seen[other]) continue;
            w->seen[other] = true;
            w->list[f.triangles++] = other;
            w->mark[t] |= (uint8_t)(1u << (k + TREE_SHIFT));
            w->mark[other] |= (uint8_t)(1u << (mw__link_edge(w->t->tri[t].link[k]) + TREE_SHIFT));
        }
    }
    f.border = 3 * f.triangles - joints;
    f.is_cut = joints != 2 * (f.triangles - 1);
    return f;
}

/* Cut each ring: the marked edges that are not in the tree become border. */
static void face_cut_open(const weigher *w, skeleton_face *f)
{
    for (uint32_t i = 0; i < f->triangles; i++) w->mark[w->list[i]] >>= TREE_SHIFT;
    f->border = f->triangles + 2;
}

/* Does a candidate cross none of the edges along which its face was cut? */
static bool crossing_stays_inside(const weigher *w, const weigher_crossing *way)
{
    uint32_t u = mw__half_start(w->t->tri, way->from), v = mw__half_start(w->t->tri, way->to);
    for (uint32_t half = mw__half_next(way->from); half_has_mark(w, half);) {
        uint32_t twin = mw__half_link(w->t->tri, half),
                 apex = mw__half_start(w->t->tri, mw__half_prev(twin));
        if (apex == v) return true;
        half = weigher_vertex_side(w, u, v, apex) > 0 ? mw__half_next(twin) : mw__half_prev(twin);
    }
    return false;
}

/* Number the corners along the border: at each vertex, turn through the face from edge to edge of
 * the border. */
static void face_number_corners(weigher *w, const skeleton_face *f)
{
    uint32_t half = MW_NONE, number = 0;
    for (uint32_t k = 0; k < 3; k++) /* the last triangle found is a leaf of the tree */
        if (!weigher_edge_is_marked(w, w->list[f->triangles - 1], k))
            half = mw__link(w->list[f->triangles - 1], k);
    for (uint32_t i = 0; i < f->border; i++) {
        number = number + 1 == f->border ? 0 : number + 1;
        w->vertex[number] = mw__half_start(w->t->tri, mw__half_next(half));
        for (half = mw__half_next(half);; half = mw__half_next(mw__half_link(w->t->tri, half))) {
            w->corner[3 * (size_t)mw__link_triangle(half) + mw__link_edge(half)] = number;
            if (!half_has_mark(w, half)) break;
        }
    }
}

static mw_lmt_diagonal weigher_make_chord(const weigher *w, uint32_t a, uint32_t b)
{
    double length = sqrt(mw__square(&w->points, w->vertex[a], w->vertex[b]));
    return a < b ? (mw_lmt_diagonal){a, b, length} : (mw_lmt_diagonal){b, a, length};
}

static uint32_t weigher_corner_at(const weigher *w, uint32_t half)
{
    return w->corner[3 * (size_t)mw__link_triangle(half) + mw__link_edge(half)];
}

static size_t face_count_chords(const weigher *w, const skeleton_face *f)
{
    size_t count = f->triangles - 1;
    for (uint32_t i = 0; i < f->triangles; i++)
        for (uint32_t c = w->chain[w->list[i]]; c != MW_NONE; c = w->crossing[c].next) count++;
    return count;
}

static size_t face_gather_chords(const weigher *w, const skeleton_face *f, mw_lmt_diagonal *chord)
{
    size_t count = 0;
    for (uint32_t i = 0; i < f->triangles; i++) {
        uint32_t t = w->list[i];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t half = mw__link(t, k);
            if (half_has_mark(w, half) && mw__link_triangle(mw__half_link(w->t->tri, half)) > t)
                chord[count++] = weigher_make_chord(w, weigher_corner_at(w, half),
                                                    weigher_corner_at(w, mw__half_next(half)));
        }
        for (uint32_t c = w->chain[t]; c != MW_NONE; c = w->crossing[c].next) {
            const weigher_crossing *way = &w->crossing[c];
            if (!f->is_cut || crossing_stays_inside(w, way))
                chord[count++] = weigher_make_chord(w, weigher_corner_at(w, way->from),
                                                    weigher_corner_at(w, way->to));
        }
    }
    return count;
}

/* May this polygon be filled, for what has been spent so far? */
static bool weigher_afford(weigher *w, uint32_t limit, const mw_lmt_face *p, bool *filling)
{
    uint64_t steps = 0;
    *filling = limit > 0 && p->corner_count <= limit;
    if (limit > 0) return true;
    if (!mw__lmt_face_steps(p, &steps)) return false;
    *filling = steps <= w->face_steps;
    if (*filling) w->face_steps -= steps;
    return true;
}

static bool face_write_triangles(weigher *w, const skeleton_face *f, const mw_lmt_face *p)
{
    uint32_t *corners = mw__alloc(f->triangles, 3 * sizeof *corners);
    bool done = corners && mw__lmt_face_fill(p, w->t->job, corners);
    for (uint32_t i = 0; done && i < f->triangles; i++) {
        mw_triangle *tri = &w->t->tri[w->list[i]];
        for (uint32_t k = 0; k < 4; k++) tri->v[k] = w->vertex[corners[3 * (size_t)i + k % 3]];
    }
    free(corners);
    return done;
}

/* A face of more than two triangles. *filled tells whether it has its least weight. */
static bool face_fill(weigher *w, skeleton_face *f, uint32_t limit, bool *filled)
{
    *filled = false;
    if (f->is_cut) face_cut_open(w, f);
    if (w->whole || (limit > 0 && f->border > limit)) return true;
    size_t most = face_count_chords(w, f);
    if (most > UINT32_MAX) return true;
    mw_lmt_diagonal *chord = mw__alloc(most, sizeof *chord);
    if (!chord) return false;
    face_number_corners(w, f);
    mw_lmt_face p = {f->border, chord, face_gather_chords(w, f, chord)};
    bool done = weigher_afford(w, limit, &p, filled);
    if (done && *filled) done = face_write_triangles(w, f, &p);
    if (f->is_cut) *filled = false;
    free(chord);
    return done;
}

static bool weigher_fill_faces(weigher *w, uint32_t limit, mw_kind_report *report)
{
    uint32_t met = 0;
    mw__job_stage(w->t->job, "filling faces", 0.1);
    for (uint32_t t = 0; t < w->t->tri_count; t++) {
        if (w->seen[t]) continue;
        skeleton_face f = weigher_find_face(w, t);
        if (f.triangles == 1) continue;
        report->faces++;
        if (f.border > report->largest_face) report->largest_face = f.border;
        bool filled = true; /* two triangles of T make a quadrilateral of least weight */
        mw_job_span outer = mw__job_steps_of(w->t->job, met, f.triangles, w->t->tri_count);
        bool done = f.triangles <= 2 || face_fill(w, &f, limit, &filled);
        mw__job_steps_end(w->t->job, outer);
        met += f.triangles;
        if (!done || !mw__job_step(w->t->job, met, w->t->tri_count)) return false;
        if (!filled) report->local_faces++;
    }
    return true;
}

/* The records have their vertices, but not their links. */
static bool weigher_shorten_again(weigher *w)
{
    for (uint32_t t = 0; t < w->t->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++) w->t->tri[t].link[k] = MW_NONE;
    mw_job_span outer = mw__job_part(w->t->job, 0.05);
    bool done = mw__connect(w->t->tri, w->t->tri_count, w->t->point_count, w->t->job, NULL);
    mw__job_part_end(w->t->job, outer);
    mw__job_stage(w->t->job, "exchanging long edges", 0.05);
    return done && weigher_shorten(w);
}

/* Without a skeleton all is one face. */
static void weigher_mark_all(weigher *w)
{
    w->whole = true;
    for (uint32_t t = 0; t < w->t->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (w->t->tri[t].link[k] != MW_NONE) half_set_mark(w, mw__link(t, k));
}

static bool weigher_make_faces(weigher *w, uint32_t limit, mw_kind_report *report)
{
    size_t n = w->t->tri_count;
    w->seen = mw__calloc(n, sizeof *w->seen);
    w->corner = mw__alloc(n, 3 * sizeof *w->corner);
    w->vertex = mw__alloc(n + 2, sizeof *w->vertex);
    if (!w->seen || !w->corner || !w->vertex) return false;
    w->face_steps = FACE_STEPS;
    if (!weigher_fill_faces(w, limit, report)) return false;
    report->optimal = report->local_faces == 0;
    return report->optimal || weigher_shorten_again(w);
}

static bool weigher_prepare(weigher *w)
{
    uint32_t n = w->t->point_count;
    double most = 0;
    int exponent;
    w->scaled = mw__alloc(n, sizeof *w->scaled);
    w->at = mw__alloc(n, sizeof *w->at);
    w->mark = mw__alloc(w->t->tri_count, sizeof *w->mark);
    w->list = mw__alloc(w->t->tri_count, sizeof *w->list);
    if (!w->scaled || !w->at || !w->mark || !w->list) return false;
    for (uint32_t v = 0; v < n; v++)
        most = fmax(most, fmax(fabs(w->t->point[v].x), fabs(w->t->point[v].y)));
    frexp(most, &exponent);
    for (uint32_t v = 0; v < n; v++) {
        w->scaled[v].x = ldexp(w->t->point[v].x, 500 - exponent);
        w->scaled[v].y = ldexp(w->t->point[v].y, 500 - exponent);
    }
    w->points = (mw_scaled){w->t->point, w->scaled, n};
    return true;
}

static void weigher_release(weigher *w)
{
    free(w->scaled);
    free(w->at);
    free(w->mark);
    free(w->list);
    free(w->edges.key);
    free(w->crossing);
    free(w->chain);
    free(w->seen);
    free(w->corner);
    free(w->vertex);
}

mw_status mw__make_min_weight(mw_triangulation *t, const mw_kind_options *options,
                              mw_kind_report *report, mw_error *error)
{
    weigher w = {.t = t};
    mw_job_span outer = mw__job_part(t->job, 0.15);
    mw_status status = mw__make_greedy(t, options, report, error);
    mw__job_part_end(t->job, outer);
    if (status) return status;
    mw_lmt_result result = weigher_prepare(&w) ? MW_LMT_DONE : MW_LMT_MEMORY;
    if (result == MW_LMT_DONE) {
        mw__job_stage(t->job, "exchanging long edges", 0.05);
        if (!weigher_shorten(&w)) result = MW_LMT_MEMORY;
        weigher_index_vertices(&w);
        if (result == MW_LMT_DONE) result = weigher_make_skeleton(&w, options->limit);
    }
    if (result == MW_LMT_SPENT) weigher_mark_all(&w);
    if (result != MW_LMT_MEMORY && !weigher_make_faces(&w, options->limit, report))
        result = MW_LMT_MEMORY;
    weigher_release(&w);
    return result == MW_LMT_MEMORY ? mw__fail_memory(error) : MW_OK;
}
