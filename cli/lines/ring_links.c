#include "cli/lines/ring_links.h"
#include "cli/lines/part_sets.h"

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>
#include <string.h>

#define RING_NONE SIZE_MAX

bool ring_segments_add(ring_segments *s, const double from[2], const double to[2], uint32_t part)
{
    if (from[0] == to[0] && from[1] == to[1]) return true;
    if (s->count == s->room) {
        size_t room = 2 * s->room + 1024;
        ring_segment *all = realloc(s->all, room * sizeof *all);
        if (!all) return false;
        s->all = all;
        s->room = room;
    }
    /* Adding 0 turns -0 into 0, so that equal points have equal bits. */
    s->all[s->count++] =
        (ring_segment){{from[0] + 0.0, from[1] + 0.0}, {to[0] + 0.0, to[1] + 0.0}, part};
    return true;
}

void ring_set_release(ring_set *set)
{
    free(set->points);
    free(set->rings);
    *set = (ring_set){0};
}

/* What is made of the segments; each has two ends, 2 * segment where it begins, and one more. */
typedef struct link_work {
    const ring_segment *segments;
    size_t count;
    size_t *point;  /* of each end: points are named by an end that lies there */
    size_t *begin;  /* [point]: of its ends in `ends`; one more for the last */
    size_t *ends;   /* sorted by their points */
    size_t *next;   /* [segment] on the ring */
    size_t *stack;  /* points of the ring that is followed, by segments that begin there */
    size_t *height; /* [point]: where it is on the stack; RING_NONE: it is not */
    uint8_t *gone;  /* [segment]: cancelled, or in a ring */
    uint32_t *parents;
    size_t points;
} link_work;

static const double *end_at(const link_work *w, size_t end)
{
    const ring_segment *s = &w->segments[end / 2];
    return end % 2 ? s->to : s->from;
}

/* --- points ----------------------------------------------------------------------------------- */

static uint64_t end_hash(const double p[2])
{
    uint64_t x, y;
    memcpy(&x, &p[0], sizeof x);
    memcpy(&y, &p[1], sizeof y);
    x = (x ^ (y << 29 | y >> 35)) * 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 32) * 0xd6e8feb86659fd93u;
    return x ^ x >> 32;
}

/* Give equal ends the same point, by a table of their hashes. */
static bool link_name_points(link_work *w)
{
    size_t size = 16;
    while (size < 4 * w->count) size *= 2;
    size_t *table = malloc(size * sizeof *table);
    if (!table) return false;
    for (size_t i = 0; i < size; i++) table[i] = RING_NONE;
    for (size_t end = 0; end < 2 * w->count; end++) {
        const double *p = end_at(w, end);
        size_t slot = end_hash(p) & (size - 1);
        while (table[slot] != RING_NONE && memcmp(end_at(w, table[slot]), p, 2 * sizeof *p) != 0)
            slot = (slot + 1) & (size - 1);
        if (table[slot] == RING_NONE) {
            table[slot] = end;
            w->point[end] = w->points++;
        } else {
            w->point[end] = w->point[table[slot]];
        }
    }
    free(table);
    return true;
}

static void link_sort_ends(link_work *w)
{
    size_t *at = w->begin;
    memset(at, 0, (w->points + 2) * sizeof *at);
    for (size_t end = 0; end < 2 * w->count; end++) at[w->point[end] + 2]++;
    for (size_t i = 2; i < w->points + 2; i++) at[i] += at[i - 1];
    for (size_t end = 0; end < 2 * w->count; end++) w->ends[at[w->point[end] + 1]++] = end;
}

/* --- where several segments meet -------------------------------------------------------------- */

/* An end of a segment, as seen from the point where it lies. */
typedef struct ring_spoke {
    const double *centre, *tip; /* tip: the other end of the segment */
    size_t end;
} ring_spoke;

/* Counter-clockwise from the east. */
static int spoke_compare(const void *a, const void *b)
{
    const ring_spoke *s = a, *t = b;
    const double *c = s->centre;
    bool s_low = s->tip[1] < c[1] || (s->tip[1] == c[1] && s->tip[0] < c[0]),
         t_low = t->tip[1] < c[1] || (t->tip[1] == c[1] && t->tip[0] < c[0]);
    if (s_low != t_low) return s_low ? 1 : -1;
    double turn = mw_orient2d(c, s->tip, t->tip);
    if (turn != 0) return turn > 0 ? -1 : 1;
    int order = memcmp(s->tip, t->tip, 2 * sizeof *s->tip); /* equal tips stand together */
    if (order) return order;
    if (s->end % 2 != t->end % 2) return s->end % 2 ? 1 : -1;
    return (s->end > t->end) - (s->end < t->end);
}

/* Cancel pairs of spokes with equal tips, one out and one in; keep the rest. */
static size_t spokes_cancel(link_work *w, ring_spoke *spokes, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0, next; i < count; i = next) {
        size_t out = 0;
        for (next = i; next < count && memcmp(spokes[next].tip, spokes[i].tip, 16) == 0; next++)
            out += spokes[next].end % 2 == 0;
        size_t in = next - i - out, pairs = out < in ? out : in;
        for (size_t k = 0; k < pairs; k++) {
            size_t a = spokes[i + k].end / 2, b = spokes[i + out + k].end / 2;
            w->gone[a] = w->gone[b] = 1;
            part_join(w->parents, w->segments[a].part, w->segments[b].part);
        }
        for (size_t k = i + pairs; k < i + out; k++) spokes[kept++] = spokes[k];
        for (size_t k = i + out + pairs; k < next; k++) spokes[kept++] = spokes[k];
    }
    return kept;
}

/* Link each incoming segment to the next outgoing one clockwise: the region lies between them. */
static void spokes_link(link_work *w, const ring_spoke *spokes, size_t count, size_t *open)
{
    size_t waiting = 0;
    for (size_t i = 0; i < 2 * count; i++) {
        size_t end = spokes[i % count].end, segment = end / 2;
        if (end % 2 == 0 && i < count)
            open[waiting++] = segment;
        else if (end % 2 == 1 && w->next[segment] == RING_NONE && waiting > 0)
            w->next[segment] = open[--waiting];
    }
}

/* Nearly every point: one segment ends, the next begins. */
static bool spokes_follow(link_work *w, const ring_spoke *spokes)
{
    const double *a = spokes[0].tip, *b = spokes[1].tip;
    if (a[0] == b[0] && a[1] == b[1]) return false;
    unsigned in = spokes[0].end % 2 == 0;
    w->next[spokes[in].end / 2] = spokes[1 - in].end / 2;
    return true;
}

static bool link_points(link_work *w)
{
    size_t most = 0;
    for (size_t p = 0; p < w->points; p++)
        if (w->begin[p + 1] - w->begin[p] > most) most = w->begin[p + 1] - w->begin[p];
    ring_spoke *spokes = malloc((most + 1) * sizeof *spokes);
    size_t *open = malloc((most + 1) * sizeof *open);
    for (size_t i = 0; i < w->count; i++) w->next[i] = RING_NONE;
    for (size_t p = 0; spokes && open && p < w->points; p++) {
        size_t count = 0;
        for (size_t i = w->begin[p]; i < w->begin[p + 1]; i++) {
            size_t end = w->ends[i];
            spokes[count++] = (ring_spoke){end_at(w, end), end_at(w, end ^ 1), end};
        }
        if (count == 2 && spokes_follow(w, spokes)) continue;
        qsort(spokes, count, sizeof *spokes, spoke_compare);
        count = spokes_cancel(w, spokes, count);
        spokes_link(w, spokes, count, open);
    }
    bool done = spokes && open;
    free(spokes);
    free(open);
    return done;
}

/* --- rings ------------------------------------------------------------------------------------ */

/* Twice the area, from the first point on. */
static double ring_measure(const double *p, size_t count)
{
    double sum = 0;
    for (size_t i = 1; i + 1 < count; i++)
        sum += (p[2 * i] - p[0]) * (p[2 * i + 3] - p[1]) -
               (p[2 * i + 2] - p[0]) * (p[2 * i + 1] - p[1]);
    return sum;
}

static void ring_find_box(const double *p, size_t count, double box[4])
{
    for (int k = 0; k < 4; k++) box[k] = p[k % 2];
    for (size_t i = 1; i < count; i++)
        for (int k = 0; k < 2; k++) {
            if (p[2 * i + (size_t)k] < box[k]) box[k] = p[2 * i + (size_t)k];
            if (p[2 * i + (size_t)k] > box[k + 2]) box[k + 2] = p[2 * i + (size_t)k];
        }
}

/* Is a ring counter-clockwise? Its lowest point is a corner that tells. */
static bool ring_is_outer(const double *p, size_t count, double area)
{
    size_t low = 0;
    for (size_t i = 1; i < count; i++)
        if (p[2 * i + 1] < p[2 * low + 1] ||
            (p[2 * i + 1] == p[2 * low + 1] && p[2 * i] < p[2 * low]))
            low = i;
    double turn =
        mw_orient2d(p + 2 * ((low + count - 1) % count), p + 2 * low, p + 2 * ((low + 1) % count));
    return turn != 0 ? turn > 0 : area > 0;
}

/* Take the points from `bottom` to the top off the stack: they are a ring. */
static void stack_cut(link_work *w, ring_set *set, size_t bottom, size_t top)
{
    linked_ring *last = set->count > 0 ? &set->rings[set->count - 1] : NULL,
                *r = &set->rings[set->count];
    *r = (linked_ring){.first = last ? last->first + last->count : 0, .count = top - bottom};
    double *p = set->points + 2 * r->first;
    r->part = part_root(w->parents, w->segments[w->stack[bottom]].part);
    for (size_t i = bottom; i < top; i++) {
        size_t segment = w->stack[i];
        memcpy(p + 2 * (i - bottom), w->segments[segment].from, 2 * sizeof *p);
        w->height[w->point[2 * segment]] = RING_NONE;
    }
    ring_find_box(p, r->count, r->box);
    r->area = ring_measure(p, r->count) / 2;
    r->outer = r->count > 2 && ring_is_outer(p, r->count, r->area);
    set->count += r->count > 2;
}

static void ring_follow(link_work *w, size_t segment, ring_set *set)
{
    size_t top = 0;
    for (; segment != RING_NONE && !w->gone[segment]; segment = w->next[segment]) {
        size_t *height = &w->height[w->point[2 * segment]];
        if (*height != RING_NONE) {
            size_t bottom = *height;
            stack_cut(w, set, bottom, top);
            top = bottom;
        }
        *height = top;
        w->stack[top++] = segment;
        w->gone[segment] = 1;
    }
    if (top > 0) stack_cut(w, set, 0, top);
}

static bool link_allocate(link_work *w, ring_set *set)
{
    size_t n = w->count + 1;
    w->point = malloc(2 * n * sizeof *w->point);
    w->begin = malloc((2 * n + 2) * sizeof *w->begin);
    w->ends = malloc(2 * n * sizeof *w->ends);
    w->next = malloc(n * sizeof *w->next);
    w->stack = malloc(n * sizeof *w->stack);
    w->height = malloc(2 * n * sizeof *w->height);
    w->gone = calloc(n, 1);
    set->points = malloc(2 * n * sizeof *set->points);
    set->rings = malloc(n * sizeof *set->rings);
    return w->point && w->begin && w->ends && w->next && w->stack && w->height && w->gone &&
           set->points && set->rings;
}

bool ring_links_make(const ring_segments *segments, uint32_t *parents, ring_set *set)
{
    link_work w = {.segments = segments->all, .count = segments->count, .parents = parents};
    *set = (ring_set){0};
    bool done = link_allocate(&w, set) && link_name_points(&w);
    if (done) link_sort_ends(&w);
    done = done && link_points(&w);
    for (size_t i = 0; done && i < w.points; i++) w.height[i] = RING_NONE;
    for (size_t i = 0; done && i < w.count; i++)
        if (!w.gone[i]) ring_follow(&w, i, set);
    free(w.point);
    free(w.begin);
    free(w.ends);
    free(w.next);
    free(w.stack);
    free(w.height);
    free(w.gone);
    return done;
}

int ring_holds(const ring_set *set, const linked_ring *r, const double p[2])
{
    const double *points = set->points + 2 * r->first;
    bool inside = false;
    if (p[0] < r->box[0] || p[1] < r->box[1] || p[0] > r->box[2] || p[1] > r->box[3]) return -1;
    for (size_t i = 0, j = r->count - 1; i < r->count; j = i++) {
        const double *a = points + 2 * j, *b = points + 2 * i;
        bool rises = a[1] <= b[1];
        if (p[1] < (rises ? a : b)[1] || p[1] > (rises ? b : a)[1]) continue;
        double turn = mw_orient2d(a, b, p);
        if (turn == 0 && (p[0] - a[0]) * (p[0] - b[0]) <= 0) return 0;
        if ((a[1] > p[1]) != (b[1] > p[1]) && (turn > 0) == rises) inside = !inside;
    }
    return inside ? 1 : -1;
}
