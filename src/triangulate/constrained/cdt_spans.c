/* cdt_spans.c - what segments own that jumped along a run of subsegments. */
#include "triangulate/constrained/cdt_spans.h"

#include <stdlib.h>

/* A subsegment in the order of the runs, and along each of them. */
typedef struct run_place {
    mw_point low; /* its lower end, by x, then y */
    uint32_t run, subsegment;
} run_place;

typedef struct run_order {
    run_place *place;
    size_t count;
} run_order;

static int run_place_compare(const void *a, const void *b)
{
    const run_place *p = a, *q = b;
    if (p->run != q->run) return p->run < q->run ? -1 : 1;
    return mw__point_is_before(p->low, q->low) ? -1 : mw__point_is_before(q->low, p->low);
}

static bool run_order_create(run_order *order, mw_cdt *m)
{
    *order = (run_order){.count = m->subsegments.count};
    order->place = mw__alloc(order->count, sizeof *order->place);
    if (!order->place) return false;
    for (uint32_t i = 0; i < order->count; i++) {
        const mw_segment_part *s = &m->subsegments.item[i];
        const mw_point from = m->point[s->from], to = m->point[s->to];
        order->place[i] = (run_place){mw__point_is_before(from, to) ? from : to,
                                      mw__subsegment_run(&m->runs, i), i};
    }
    qsort(order->place, order->count, sizeof *order->place, run_place_compare);
    return true;
}

/* The first place of a run whose subsegment begins at p or above it. */
static size_t run_order_find(const run_order *order, uint32_t run, mw_point p)
{
    const run_place wanted = {p, run, 0};
    size_t low = 0, high = order->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (run_place_compare(&order->place[middle], &wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The places of a span: from *first on, up to *end. Returns whether it goes upwards. */
static bool run_order_span(const run_order *order, mw_cdt *m, const mw_subsegment_span *span,
                           size_t *first, size_t *end)
{
    const uint32_t run = mw__subsegment_run(&m->runs, span->subsegment);
    const mw_point from = m->point[span->from], to = m->point[span->to];
    const bool upwards = mw__point_is_before(from, to);
    *first = run_order_find(order, run, upwards ? from : to);
    *end = run_order_find(order, run, upwards ? to : from);
    return upwards;
}

/* --- the lowest owners ------------------------------------------------------------------------ */

static int span_compare(const void *a, const void *b)
{
    const mw_subsegment_span *p = a, *q = b;
    return (p->segment > q->segment) - (p->segment < q->segment);
}

/* The first place from `place` on without an owner: next[] leads over those with one. */
static size_t place_without_owner(size_t *next, size_t place)
{
    while (next[place] != place) place = next[place] = next[next[place]];
    return place;
}

static void subsegment_lower_owner(mw_cdt *m, uint32_t subsegment, uint32_t segment, bool upwards)
{
    mw_segment_part *s = &m->subsegments.item[subsegment];
    if (segment >= s->segment) return;
    s->segment = segment;
    if (mw__point_is_before(m->point[s->from], m->point[s->to]) != upwards)
        mw__swap(&s->from, &s->to);
}

bool mw__cdt_spans_settle(mw_cdt *m)
{
    if (m->runs.span_count == 0) return true;
    run_order order;
    size_t *next = mw__alloc(m->subsegments.count + 1, sizeof *next);
    const bool done = run_order_create(&order, m) && next;
    for (size_t i = 0; i <= m->subsegments.count && done; i++) next[i] = i;
    if (done) qsort(m->runs.span, m->runs.span_count, sizeof *m->runs.span, span_compare);
    for (size_t i = 0; i < m->runs.span_count && done; i++) {
        size_t first, end;
        const bool upwards = run_order_span(&order, m, &m->runs.span[i], &first, &end);
        for (size_t at; (at = place_without_owner(next, first)) < end; next[at] = at + 1)
            subsegment_lower_owner(m, order.place[at].subsegment, m->runs.span[i].segment, upwards);
    }
    free(next);
    free(order.place);
    return done;
}

/* --- all owners ------------------------------------------------------------------------------- */

bool mw__cdt_spans_list(mw_cdt *m)
{
    if (m->runs.span_count == 0) return true;
    run_order order;
    bool done = run_order_create(&order, m);
    for (size_t i = 0; i < m->runs.span_count && done; i++) {
        const mw_subsegment_span *span = &m->runs.span[i];
        size_t at, end;
        (void)run_order_span(&order, m, span, &at, &end);
        for (; at < end && done; at++)
            done = mw__subsegment_owner_add(
                m, (mw_subsegment_owner){order.place[at].subsegment, span->segment});
    }
    if (done) m->runs.span_count = 0;
    free(order.place);
    return done;
}
