/* polygons_create.c - polygons become ready for queries: their rings are forced into a
 * triangulation; those that cross others are followed through it; then each triangle gets its set.
 */
#include "base/options.h"
#include "polygons/polygons_label.h"
#include "triangulate/constrained/cdt.h"
#include "triangulate/constrained/cdt_output.h"
#include "triangulate/constrained/polygon_ranks.h"

#include <stdlib.h>
#include <string.h>

void mw_polygons_destroy(mw_polygons *p)
{
    if (!p) return;
    mw_mesh_destroy(p->mesh);
    free(p->polygon);
    free(p->crossing);
    free(p->set);
    mw__polygon_sets_release(&p->sets);
    free(p->subsegment);
    mw__rank_lists_release(&p->owners);
    mw__rank_lists_release(&p->corners);
    mw__rank_lists_release(&p->chords);
    free(p->chord);
    free(p);
}

typedef struct polygon_maker {
    mw_polygons *p;
    mw_cdt *m;
    mw_polygon_ranks ranks;
    mw_rank_entries entries;
    mw_rank_entries corners;
    mw_rank_entries passing;     /* vertices inside segments, with the segments */
    const mw_segment_part *part; /* that is followed          */
    uint32_t chord;              /* its number as a chord     */
} polygon_maker;

/* A segment has a vertex on it. */
static bool maker_meet_vertex(polygon_maker *k, uint32_t vertex, uint32_t segment)
{
    const uint32_t *ends = k->m->given->segments + 2 * (size_t)segment;
    bool end = vertex == mw__vertex_of(k->m, ends[0]) || vertex == mw__vertex_of(k->m, ends[1]);
    return mw__rank_entries_add(&k->corners, vertex, k->ranks.rank[segment]) &&
           (end || mw__rank_entries_add(&k->passing, vertex, segment));
}

/* --- segments that could not be forced in --- */

/* The parts, by polygon; those of none are left out. NULL when out of memory. */
static mw_key *crossing_by_rank(const polygon_maker *k, size_t *count)
{
    const mw_segment_parts *crossing = &k->m->crossing;
    mw_key *key = mw__alloc(crossing->count, sizeof *key),
           *scratch = mw__alloc(crossing->count, sizeof *scratch);
    *count = 0;
    if (key && scratch) {
        for (size_t i = 0; i < crossing->count; i++) {
            uint32_t rank = k->ranks.rank[crossing->item[i].segment];
            if (rank != MW_NONE) key[(*count)++] = (mw_key){rank, (uint32_t)i};
        }
        mw__sort_keys(key, scratch, *count);
    } else {
        free(key);
        key = NULL;
    }
    free(scratch);
    return key;
}

/* Where a part runs along an edge, that becomes a subsegment of it. */
static bool maker_meet_edge(void *context, mw_segment_meeting meeting, uint32_t number)
{
    polygon_maker *k = context;
    if (meeting != MW_MEETS_EDGE) return true;
    mw_subsegment made = {.from = mw__half_start(k->m->tri, number),
                          .to = mw__half_end(k->m->tri, number)};
    made.number = mw__segment_insertion_mark(&k->m->net, number);
    return mw__subsegment_note(k->m, &made, k->part->segment);
}

/* Triangles that a part passes through, vertices on it, and polygons that it crosses. */
static bool maker_meet(void *context, mw_segment_meeting meeting, uint32_t number)
{
    polygon_maker *k = context;
    uint32_t rank = k->p->chord[k->chord].rank;
    const mw_rank_lists *owners = &k->p->owners;
    if (meeting == MW_MEETS_TRIANGLE) return mw__rank_entries_add(&k->entries, number, k->chord);
    if (meeting == MW_MEETS_VERTEX) return maker_meet_vertex(k, number, k->part->segment);
    if (meeting == MW_MEETS_SUBSEGMENT && owners->first)
        for (uint32_t i = owners->first[number]; i < owners->first[number + 1]; i++)
            if (owners->item[i] == rank) k->p->crossing[rank] = 1;
    return true;
}

static bool maker_trace(polygon_maker *k, const mw_key *key, size_t count, mw_segment_visitor *meet)
{
    for (size_t i = 0; i < count; i++) {
        k->part = &k->m->crossing.item[key[i].item];
        k->chord = (uint32_t)i;
        if (!mw__segment_insertion_trace(&k->m->net, k->part->from, k->part->to, meet, k))
            return false;
        if (!mw__job_step(k->m->job, i, count)) return false;
    }
    return true;
}

static bool maker_take_chords(polygon_maker *k, const mw_key *key, size_t count)
{
    k->p->chord = mw__alloc(count, sizeof *k->p->chord);
    k->p->chord_count = count;
    for (size_t i = 0; k->p->chord && i < count; i++) {
        const mw_segment_part *part = &k->m->crossing.item[key[i].item];
        k->p->chord[i] =
            (mw_polygon_chord){k->m->point[part->from], k->m->point[part->to], key[i].key};
        if (!maker_meet_vertex(k, part->from, part->segment)) return false;
        if (!maker_meet_vertex(k, part->to, part->segment)) return false;
    }
    return k->p->chord;
}

/* --- who owns the edges and the vertices --- */

static bool maker_own_edges(polygon_maker *k)
{
    const mw_cdt *m = k->m;
    for (size_t i = 0; i < m->owner_count; i++) {
        uint32_t rank = k->ranks.rank[m->owner[i].segment];
        const mw_segment_part *s = &m->subsegments.item[m->owner[i].subsegment];
        if (rank == MW_NONE) continue;
        if (!mw__rank_entries_add(&k->entries, m->owner[i].subsegment, rank)) return false;
        if (!maker_meet_vertex(k, s->from, m->owner[i].segment)) return false;
        if (!maker_meet_vertex(k, s->to, m->owner[i].segment)) return false;
    }
    k->p->subsegment_count = (uint32_t)m->subsegments.count;
    bool done = mw__rank_lists_create(&k->p->owners, &k->entries, k->p->subsegment_count, false);
    k->entries.count = 0;
    return done;
}

/* --- polygons that cross themselves --- */

/* Polygons that a list has twice cross themselves there. */
static void maker_note_twice(polygon_maker *k, const mw_rank_lists *lists, uint32_t rows)
{
    for (uint32_t row = 0; lists->first && row < rows; row++)
        for (uint32_t i = lists->first[row]; i + 1 < lists->first[row + 1]; i++)
            if (lists->item[i] == lists->item[i + 1]) k->p->crossing[lists->item[i]] = 1;
}

/* Two segments of one polygon that pass through a vertex cross or touch there. */
static bool maker_note_passing(polygon_maker *k)
{
    const uint32_t rows = (uint32_t)k->m->point_count;
    mw_rank_lists lists;
    bool done = mw__rank_lists_create(&lists, &k->passing, rows, true);
    k->passing.count = 0;
    for (uint32_t row = 0; done && lists.first && row < rows; row++)
        for (uint32_t i = lists.first[row]; done && i < lists.first[row + 1]; i++)
            done = mw__rank_entries_add(&k->passing, row, k->ranks.rank[lists.item[i]]);
    mw__rank_lists_release(&lists);
    if (!done) return false;
    done = mw__rank_lists_create(&lists, &k->passing, rows, false);
    if (done) maker_note_twice(k, &lists, rows);
    mw__rank_lists_release(&lists);
    return done;
}

/* Both pass through one triangle. Do they cross, or lie on one line? */
static bool chords_cross(const mw_polygon_chord *c, const mw_polygon_chord *d)
{
    double a = mw__chord_side(c, d->a), b = mw__chord_side(c, d->b);
    if (a == 0 && b == 0) return true;
    if (!((a > 0 && b < 0) || (a < 0 && b > 0))) return false;
    a = mw__chord_side(d, c->a), b = mw__chord_side(d, c->b);
    return (a > 0 && b < 0) || (a < 0 && b > 0);
}

/* Two chords of one polygon that cross each other do so in some triangle, or on an edge, where they
 * are chords of both triangles. */
static void maker_note_crossings(polygon_maker *k, uint32_t triangles)
{
    const mw_rank_lists *lists = &k->p->chords;
    const mw_polygon_chord *chord = k->p->chord;
    for (uint32_t t = 0; lists->first && t < triangles; t++)
        for (uint32_t i = lists->first[t]; i < lists->first[t + 1]; i++) {
            const mw_polygon_chord *c = &chord[lists->item[i]];
            uint8_t *crossing = &k->p->crossing[c->rank];
            for (uint32_t j = i + 1; !*crossing && j < lists->first[t + 1]; j++) {
                const mw_polygon_chord *d = &chord[lists->item[j]];
                if (d->rank != c->rank) break;
                *crossing = chords_cross(c, d);
            }
        }
}

/* --- all together --- */

static bool maker_follow(polygon_maker *k)
{
    size_t count;
    mw_key *key = crossing_by_rank(k, &count);
    bool done = key;
    mw__job_stage(k->m->job, "following segments that cross", 0.1);
    if (done)
        done = maker_trace(k, key, count, maker_meet_edge) && maker_take_chords(k, key, count);
    mw__job_stage(k->m->job, "following segments that cross", 0.1);
    if (done) done = maker_own_edges(k) && maker_trace(k, key, count, maker_meet);
    free(key);
    return done && mw__rank_lists_create(&k->p->chords, &k->entries, k->m->tri_count, false) &&
           mw__rank_lists_create(&k->p->corners, &k->corners, (uint32_t)k->m->point_count, true);
}

static bool maker_label(polygon_maker *k)
{
    k->p->crossing = mw__calloc(k->ranks.count, sizeof *k->p->crossing);
    if (!k->p->crossing || !maker_follow(k) || !maker_note_passing(k)) return false;
    maker_note_twice(k, &k->p->owners, k->p->subsegment_count);
    maker_note_crossings(k, k->m->tri_count);
    mw__job_stage(k->m->job, "labelling triangles", 0.2);
    k->p->subsegment = k->m->net.subsegment; /* lent */
    bool done = mw__polygons_label(k->p, k->m->tri, k->m->tri_count, k->m->point, k->m->job);
    k->p->subsegment = NULL;
    return done;
}

static mw_status maker_make_mesh(polygon_maker *k, mw_error *error)
{
    mw_constrain_report report = {0};
    k->m->kept = mw__alloc(k->m->tri_count, sizeof *k->m->kept);
    if (!k->m->kept) return mw__fail_memory(error);
    memset(k->m->kept, 1, k->m->tri_count);
    mw_status status = mw__cdt_output(k->m, &report, NULL, &k->p->mesh, error);
    k->p->subsegment = k->m->net.subsegment;
    k->m->net.subsegment = NULL;
    return status;
}

static mw_status maker_run(polygon_maker *k, mw_error *error)
{
    mw_job_span outer = mw__job_part(k->m->job, 0.5);
    mw_status status = mw__cdt_make_partly(k->m, error);
    mw__job_part_end(k->m->job, outer);
    if (status == MW_OK) status = mw__polygon_ranks_create(&k->ranks, k->m, error);
    if (status) return status;
    if (k->ranks.count == 0) return mw__fail(error, MW_ERROR_INPUT, "there are no polygons");
    if (!maker_label(k)) return mw__fail_memory(error);
    outer = mw__job_part(k->m->job, 0.1);
    status = maker_make_mesh(k, error);
    mw__job_part_end(k->m->job, outer);
    k->p->polygon = k->ranks.polygon;
    k->p->polygon_count = k->ranks.count;
    k->ranks.polygon = NULL;
    return status;
}

static mw_status polygons_check(const mw_constraints *rings, const mw_polygons_options *options,
                                mw_error *error)
{
    if (!rings) return mw__fail(error, MW_ERROR_ARGUMENT, "the rings are NULL");
    if (rings->segment_count && !rings->polygon)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the polygon of each segment is missing (NULL)");
    if (rings->hole_seed_count)
        return mw__fail(error, MW_ERROR_ARGUMENT, "holes of polygons are rings, not seed points");
    return MW_RESERVED_CHECK(mw_polygons_options, options, error);
}

mw_status mw_polygons_create(const mw_constraints *rings, const mw_polygons_options *options,
                             mw_polygons **out, mw_error *error)
{
    static const mw_polygons_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new polygons is NULL");
    *out = NULL;
    if (!options) options = &defaults;
    mw_status status = polygons_check(rings, options, error);
    if (status) return status;
    mw_polygons *p = mw__calloc(1, sizeof *p);
    if (!p) return mw__fail_memory(error);
    mw_job job = mw__job(options->threads, options->progress);
    mw_cdt m = {.given = rings, .job = &job};
    polygon_maker k = {.p = p, .m = &m};
    status = mw__job_end(&job, maker_run(&k, error), error);
    mw__rank_entries_release(&k.entries);
    mw__rank_entries_release(&k.corners);
    mw__rank_entries_release(&k.passing);
    mw__polygon_ranks_release(&k.ranks);
    mw__cdt_release(&m);
    if (status)
        mw_polygons_destroy(p);
    else
        *out = p;
    return status;
}
