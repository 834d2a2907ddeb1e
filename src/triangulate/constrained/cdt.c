/* cdt.c - constrained Delaunay triangulation of points, lines and polygons [Lee, Lin 1986; Chew
 * 1989].
 *
 * First the Delaunay triangulation of the points is made. Then the segments are forced in one by
 * one (segment_insertion.c), it is decided which triangles are kept (cdt_keep.c), and these become
 * a mesh (cdt_output.c). If segments cross and are to be split, points are put where they cross
 * (cdt_split.c), and everything is made anew, until nothing crosses. */
#include "triangulate/constrained/cdt.h"

#include "base/hilbert.h"
#include "base/options.h"
#include "triangulate/constrained/cdt_keep.h"
#include "triangulate/constrained/cdt_output.h"
#include "triangulate/constrained/cdt_spans.h"
#include "triangulate/constrained/cdt_split.h"
#include "triangulate/delaunay/delaunay.h"
#include "triangulate/constrained/brio.h"

#include <inttypes.h>
#include <stdlib.h>

/* --- what is given --- */

static mw_status cdt_check_segments(const mw_constraints *given, mw_error *error)
{
    for (size_t i = 0; i < 2 * given->segment_count; i++)
        if (given->segments[i] >= given->point_count)
            return mw__fail(error, MW_ERROR_ARGUMENT,
                            "segment %zu: %" PRIu32 " is not a point; there are %zu", i / 2,
                            given->segments[i], given->point_count);
    for (size_t i = 0; i < given->hole_seed_count; i++)
        if (!isfinite(given->hole_seeds[2 * i]) || !isfinite(given->hole_seeds[2 * i + 1]))
            return mw__fail(error, MW_ERROR_ARGUMENT, "the point of hole %zu is not finite", i);
    return MW_OK;
}

static mw_status cdt_check_arguments(const mw_constraints *given, mw_keep keep, mw_error *error)
{
    if (!given) return mw__fail(error, MW_ERROR_ARGUMENT, "constraints are NULL");
    if ((unsigned)keep > MW_KEEP_INSIDE)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the option 'keep' has an unknown value");
    if (given->stride == 1)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the stride must be at least 2 (x and y), not 1");
    if ((given->point_count && !given->points) || (given->segment_count && !given->segments) ||
        (given->hole_seed_count && !given->hole_seeds))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the points or the segments are NULL");
    if (given->point_count > MW_MAX_TRIANGLES / 2)
        return mw__fail(error, MW_ERROR_LIMIT, "too many points: %zu", given->point_count);
    if (given->segment_count >= MW_NONE)
        return mw__fail(error, MW_ERROR_LIMIT, "too many segments: %zu", given->segment_count);
    return cdt_check_segments(given, error);
}

void mw__cdt_release(mw_cdt *m)
{
    mw__segment_insertion_release(&m->net);
    free(m->point);
    free(m->twin);
    free(m->tri);
    free(m->parts.item);
    free(m->subsegments.item);
    free(m->crossing.item);
    free(m->owner);
    mw__subsegment_runs_release(&m->runs);
    free(m->kept);
}

/* --- forcing the stretches in --- */

/* A part came to a subsegment that is there already: it jumps to where it leaves its run, or to its
 * own other end. False when out of memory. */
static bool part_jump(mw_cdt *m, const mw_segment_part *part, uint32_t subsegment, uint32_t at,
                      uint32_t *leave)
{
    const bool forwards = at == part->from;
    const uint32_t to = forwards ? part->to : part->from;
    *leave = mw__subsegment_runs_leave(&m->runs, m->point, subsegment, at, to);
    return mw__subsegment_runs_note(&m->runs,
                                    &(mw_subsegment_span){subsegment, forwards ? at : *leave,
                                                          forwards ? *leave : at, part->segment});
}

/* Note a subsegment of a part, made at one of its ends or there already. False when out of
 * memory. */
static bool part_note(mw_cdt *m, const mw_segment_part *before, mw_segment_part *part,
                      const mw_subsegment *subsegment)
{
    if (subsegment->number == m->subsegments.count)
        return mw__subsegment_note(m, subsegment, part->segment) &&
               mw__subsegment_runs_add(&m->runs, m->point, subsegment->from, subsegment->to);
    const bool forwards = part->from != before->from;
    return part_jump(m, before, subsegment->number, forwards ? before->from : before->to,
                     forwards ? &part->from : &part->to);
}

/* Force in a part, or as much of it as lies before what it crosses. Returns false when out of
 * memory. */
static bool part_force(mw_cdt *m, mw_segment_part s)
{
    uint32_t last[2] = {MW_NONE, MW_NONE}; /* subsegments before its beginning and behind its end */
    while (s.from != s.to) {
        const mw_segment_part before = s;
        mw_subsegment subsegment;
        mw_subsegment_result result = mw__insert_subsegment(&m->net, &s.from, &s.to, &subsegment);
        if (result == MW_SUBSEGMENT_CROSSES) return mw__segment_parts_add(&m->crossing, s);
        if (result != MW_SUBSEGMENT_DONE) return false;
        const int end = s.from == before.from;
        if (!part_note(m, &before, &s, &subsegment)) return false;
        if (last[end] != MW_NONE)
            mw__subsegment_runs_join(&m->runs, m->point, last[end], subsegment.number);
        last[end] = subsegment.number;
    }
    if (last[0] != MW_NONE && last[1] != MW_NONE)
        mw__subsegment_runs_join(&m->runs, m->point, last[0], last[1]);
    return true;
}

/* The parts of segments in a biased randomized order (brio.h): some long ones are expected to come
 * early, and later parts need not be searched for behind them. In each round the order follows the
 * Hilbert curve of the triangles, so that neighbours are near each other in memory. NULL when out
 * of memory. */
static uint32_t *cdt_order_parts(const mw_cdt *m)
{
    uint32_t n = (uint32_t)m->parts.count, *order = mw__brio_order(n);
    mw_key *along = mw__alloc(n, sizeof *along), *scratch = mw__alloc(n, sizeof *scratch);
    bool done = order && along && scratch;
    if (done) {
        for (uint32_t i = 0; i < n; i++) along[i] = (mw_key){m->net.at[m->parts.item[i].from], i};
        mw__sort_keys(along, scratch, n);
        for (uint32_t i = 0; i < n; i++) order[i] = along[order[i]].item;
    }
    free(along);
    free(scratch);
    if (done) return order;
    free(order);
    return NULL;
}

/* Triangulate the points and force the parts in, as far as nothing crosses, or, if `all`, all that
 * do not cross. */
static mw_status cdt_make(mw_cdt *m, bool all, mw_delaunay_report *report, mw_error *error)
{
    uint32_t n = (uint32_t)m->point_count;
    if (m->parts.count >= MW_NONE)
        return mw__fail(error, MW_ERROR_LIMIT, "too many parts of segments that cross");
    m->twin = mw__alloc(n, sizeof *m->twin);
    if (!m->twin) return mw__fail_memory(error);
    mw_job_span outer = mw__job_part(m->job, 0.5);
    mw_status status =
        mw__delaunay_triangles(m->point, n, m->job, m->twin, report, &m->tri, &m->tri_count, error);
    mw__job_part_end(m->job, outer);
    if (status) return status;
    if (!mw__segment_insertion_create(&m->net, m->point, n, m->tri, m->tri_count))
        return mw__fail_memory(error);
    for (size_t i = 0; i < m->parts.count; i++) {
        m->parts.item[i].from = mw__vertex_of(m, m->parts.item[i].from);
        m->parts.item[i].to = mw__vertex_of(m, m->parts.item[i].to);
    }
    uint32_t *order = cdt_order_parts(m);
    bool done = order;
    mw__job_stage(m->job, "inserting segments", 0.5);
    for (size_t i = 0; i < m->parts.count && done && (all || !m->crossing.count); i++)
        done = part_force(m, m->parts.item[order[i]]) && mw__job_step(m->job, i, m->parts.count);
    m->crossed += m->net.crossed + m->net.wasted;
    free(order);
    done = done && mw__cdt_spans_settle(m);
    return done ? MW_OK : mw__fail_memory(error);
}

/* Forget what was made, but not the points and parts. */
static void cdt_unmake(mw_cdt *m)
{
    mw__segment_insertion_release(&m->net);
    free(m->twin);
    free(m->tri);
    m->twin = NULL;
    m->tri = NULL;
    m->subsegments.count = m->crossing.count = m->owner_count = 0;
    m->runs.count = m->runs.span_count = 0;
}

/* --- segments that cross --- */

typedef struct finder {
    const mw_cdt *m;
    uint32_t subsegment;
} finder;

static bool cdt_find_subsegment(void *context, mw_segment_meeting meeting, uint32_t number)
{
    finder *f = context;
    if (meeting != MW_MEETS_SUBSEGMENT) return true;
    f->subsegment = number;
    return false;
}

/* Name the first pair found that crosses. */
static mw_status cdt_fail_crossing(const mw_cdt *m, const char *why, mw_constrain_report *report,
                                   mw_error *error)
{
    const mw_segment_part *s = &m->crossing.item[0];
    finder f = {m, MW_NONE};
    mw__segment_insertion_trace(&m->net, s->from, s->to, cdt_find_subsegment, &f);
    const mw_segment_part *p = &m->subsegments.item[f.subsegment];
    report->crossing_segments[0] = s->segment < p->segment ? s->segment : p->segment;
    report->crossing_segments[1] = s->segment < p->segment ? p->segment : s->segment;
    const uint32_t *a = &m->given->segments[2 * (size_t)report->crossing_segments[0]];
    const uint32_t *b = &m->given->segments[2 * (size_t)report->crossing_segments[1]];
    mw_point crossing =
        mw__crossing_point(m->point[s->from], m->point[s->to], m->point[p->from], m->point[p->to]);
    return mw__fail(error, MW_ERROR_INPUT,
                    "segments %" PRIu32 " (from point %" PRIu32 " to %" PRIu32 ") and %" PRIu32
                    " (from point %" PRIu32 " to %" PRIu32 ") cross near %.9g %.9g%s",
                    report->crossing_segments[0], a[0], a[1], report->crossing_segments[1], b[0],
                    b[1], crossing.x, crossing.y, why);
}

static mw_status cdt_make_all(mw_cdt *m, bool split, mw_delaunay_report *delaunay,
                              mw_constrain_report *report, mw_error *error);

/* The ends of parts, in the order of their numbers: number[p] is the one of point p among them, or
 * MW_NONE. */
static uint32_t cdt_number_ends(const mw_cdt *m, uint32_t *number)
{
    uint32_t count = 0;
    for (size_t p = 0; p < m->point_count; p++) number[p] = MW_NONE;
    for (size_t i = 0; i < m->parts.count; i++)
        number[m->parts.item[i].from] = number[m->parts.item[i].to] = 0;
    for (size_t p = 0; p < m->point_count; p++)
        if (number[p] != MW_NONE) number[p] = count++;
    return count;
}

/* Only the parts and their ends, numbered as `number` says. */
static bool cdt_take_ends(const mw_cdt *m, const uint32_t *number, uint32_t count, mw_cdt *ends)
{
    ends->point = mw__alloc_lines(count, sizeof *ends->point);
    ends->parts.item = mw__alloc(m->parts.count, sizeof *ends->parts.item);
    if (!ends->point || !ends->parts.item) return false;
    ends->point_count = count;
    ends->parts.count = ends->parts.capacity = m->parts.count;
    for (size_t p = 0; p < m->point_count; p++)
        if (number[p] != MW_NONE) ends->point[number[p]] = m->point[p];
    for (size_t i = 0; i < m->parts.count; i++) {
        mw_segment_part s = m->parts.item[i];
        ends->parts.item[i] = (mw_segment_part){number[s.from], number[s.to], s.segment};
    }
    return true;
}

/* The other way: take the parts of `ends`, and the points made there beyond the first `count`. */
static bool cdt_take_back(mw_cdt *m, uint32_t *number, uint32_t count, mw_cdt *ends)
{
    size_t n = m->point_count, made = ends->point_count - count;
    mw_point *point = mw__alloc_lines(n + made, sizeof *point);
    if (!point) return false;
    for (size_t p = 0; p < n + made; p++)
        point[p] = p < n ? m->point[p] : ends->point[count + (p - n)];
    for (uint32_t p = 0; p < n; p++)
        if (number[p] != MW_NONE)
            /* no less than its own number, so read before it is overwritten */
            number[number[p]] = p;
    for (size_t i = 0; i < ends->parts.count; i++) {
        mw_segment_part *s = &ends->parts.item[i];
        s->from = s->from < count ? number[s->from] : (uint32_t)n + (s->from - count);
        s->to = s->to < count ? number[s->to] : (uint32_t)n + (s->to - count);
    }
    free(m->point);
    free(m->parts.item);
    m->point = point;
    m->point_count = n + made;
    m->parts = ends->parts;
    ends->parts = (mw_segment_parts){0};
    return true;
}

/* Whether parts cross does not depend on points that are no ends of parts. If there are many such
 * points, the parts are split without them, until nothing crosses. This calls cdt_make_all, which
 * called it; the recursion is not deep, as each time at most half the points remain. It hardly ever
 * happens twice: afterwards nearly all points are ends of parts. */
static mw_status cdt_split_apart(mw_cdt *m, mw_constrain_report *report, mw_error *error)
{
    uint32_t *number = mw__alloc(m->point_count, sizeof *number);
    if (!number) return mw__fail_memory(error);
    uint32_t count = cdt_number_ends(m, number);
    mw_cdt ends = {.given = m->given, .job = m->job};
    mw_status status = MW_OK;
    if (count <= m->point_count / 2) {
        status = cdt_take_ends(m, number, count, &ends)
                     ? cdt_make_all(&ends, true, NULL, report, error)
                     : mw__fail_memory(error);
        m->crossed += ends.crossed;
        if (status == MW_OK && !cdt_take_back(m, number, count, &ends))
            status = mw__fail_memory(error);
    }
    mw__cdt_release(&ends);
    free(number);
    return status;
}

/* Each round puts points where parts cross. Afterwards most parts cross nothing. But points are
 * rounded, so a part may then cross another one; and of many parts that cross one another, each
 * round can force in only some, and splits the others. */
static mw_status cdt_make_all(mw_cdt *m, bool split, mw_delaunay_report *delaunay,
                              mw_constrain_report *report, mw_error *error)
{
    enum { MOST_ROUNDS = 200 };
    double left = 0.5; /* of the job, for further rounds: of what is left, each takes half */
    mw_job_span outer = mw__job_part(m->job, left);
    mw_status status = cdt_make(m, split, delaunay, error);
    mw__job_part_end(m->job, outer);
    for (int round = 1; status == MW_OK && m->crossing.count && split && round < MOST_ROUNDS;
         round++) {
        status = mw__cdt_split_crossings(m, round, error);
        if (status == MW_OK) {
            cdt_unmake(m);
            outer = mw__job_part(m->job, left / 4);
            status = cdt_split_apart(m, report, error);
            mw__job_part_end(m->job, outer);
        }
        outer = mw__job_part(m->job, left / 4);
        if (status == MW_OK) status = cdt_make(m, true, NULL, error);
        mw__job_part_end(m->job, outer);
        left /= 2;
    }
    if (status == MW_OK && m->crossing.count)
        status = cdt_fail_crossing(
            m, split ? ", and so close to others that rounded points cannot keep them apart" : "",
            report, error);
    return status;
}

/* --- all together --- */

static mw_status cdt_take(mw_cdt *m, mw_error *error)
{
    const mw_constraints *given = m->given;
    size_t stride = given->stride ? given->stride : 2;
    m->point = mw__alloc_lines(given->point_count, sizeof *m->point);
    m->parts.item = mw__alloc(given->segment_count, sizeof *m->parts.item);
    if (!m->point || !m->parts.item) return mw__fail_memory(error);
    m->point_count = given->point_count;
    for (size_t i = 0; i < given->point_count; i++)
        m->point[i] = (mw_point){given->points[i * stride], given->points[i * stride + 1]};
    m->parts.count = m->parts.capacity = given->segment_count;
    for (size_t i = 0; i < given->segment_count; i++)
        m->parts.item[i] =
            (mw_segment_part){given->segments[2 * i], given->segments[2 * i + 1], (uint32_t)i};
    return MW_OK;
}

static mw_status cdt_build(mw_cdt *m, const mw_constrain_options *options, uint32_t *duplicate_of,
                           mw_constrain_report *report, mw_constrained_edges *edges, mw_mesh **out,
                           mw_error *error)
{
    mw_status status = cdt_take(m, error);
    mw_job_span outer = mw__job_part(m->job, 0.85);
    if (status == MW_OK) status = cdt_make_all(m, options->split, &report->delaunay, report, error);
    mw__job_part_end(m->job, outer);
    report->triangles_crossed = m->crossed;
    mw__job_stage(m->job, "removing what is outside", 0.05);
    if (status == MW_OK) status = mw__cdt_keep_triangles(m, options->keep, report, error);
    outer = mw__job_part(m->job, 0.1);
    if (status == MW_OK) status = mw__cdt_output(m, report, edges, out, error);
    mw__job_part_end(m->job, outer);
    if (duplicate_of && status == MW_OK)
        for (size_t i = 0; i < m->given->point_count; i++) duplicate_of[i] = m->twin[i];
    return status;
}

mw_status mw__cdt_make_partly(mw_cdt *m, mw_error *error)
{
    mw_status status = cdt_check_arguments(m->given, MW_KEEP_HULL, error);
    if (status == MW_OK) status = cdt_take(m, error);
    if (status == MW_OK) status = cdt_make(m, true, NULL, error);
    return status || mw__cdt_spans_list(m) ? status : mw__fail_memory(error);
}

mw_status mw_constrained_delaunay(const mw_constraints *constraints,
                                  const mw_constrain_options *options, uint32_t *duplicate_of,
                                  mw_constrain_report *report, mw_constrained_edges *edges,
                                  mw_mesh **out, mw_error *error)
{
    static const mw_constrain_options defaults;
    mw_constrain_report unread;
    if (!report) report = &unread;
    *report =
        (mw_constrain_report){.crossing_segments = {MW_NONE, MW_NONE}, .first_idle_hole = MW_NONE};
    if (edges) *edges = (mw_constrained_edges){0};
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
    *out = NULL;
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_constrain_options, options, error);
    if (!status) status = cdt_check_arguments(constraints, options->keep, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    mw_cdt m = {.given = constraints, .job = &job};
    status =
        mw__job_end(&job, cdt_build(&m, options, duplicate_of, report, edges, out, error), error);
    mw__cdt_release(&m);
    if (status && edges) mw_constrained_edges_release(edges);
    if (status) {
        mw_mesh_destroy(*out);
        *out = NULL;
    }
    return status;
}
