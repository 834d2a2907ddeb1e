#include "cli/gdal/gdal_transform.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_crs.h"

#ifdef MW_GDAL

#include "src/base/threads.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { CHUNK = 1 << 13 };   /* points at a time */
enum { MEMBER_CHUNKS = 4 }; /* a copy of a transformation costs as much as some chunks */
enum { MOST_MEMBERS = 32 };

/* What one thread works with: nothing of PROJ is shared. */
typedef struct transform_member {
    OGRCoordinateTransformationH way;
} transform_member;

struct gdal_transform {
    const gdal_functions *gdal;
    transform_member *members[MOST_MEMBERS]; /* the first ones; kept for all calls */
    /* The present call. */
    double *points;
    size_t count, stride;
    atomic_size_t next; /* the point to go on with */
    atomic_uint_fast64_t lost;
};

/* The transformation; a rough one only where no other is known. */
static OGRCoordinateTransformationH transform_find_way(const gdal_functions *gdal,
                                                       OGRSpatialReferenceH from,
                                                       OGRSpatialReferenceH to, bool *rough)
{
    OGRCoordinateTransformationH found = NULL;
    for (int ballpark = 0; ballpark < 2 && !found; ballpark++) {
        OGRCoordinateTransformationOptionsH options = gdal->OCTNewCoordinateTransformationOptions();
        gdal->OCTCoordinateTransformationOptionsSetBallparkAllowed(options, ballpark);
        gdal->CPLErrorReset();
        found = gdal->OCTNewCoordinateTransformationEx(from, to, options);
        gdal->OCTDestroyCoordinateTransformationOptions(options);
        *rough = ballpark;
    }
    return found;
}

int gdal_transform_check(const char *what)
{
    if (gdal_library_load()) return 0;
    complain("%s: GDAL, which would transform the points, cannot be loaded (" MW_GDAL ")", what);
    return END_INPUT;
}

static int transform_fail(const gdal_transform_ends *ends, const char *why, const char *more)
{
    char names[2][CRS_NAME];
    complain("%s is in %s, %s in %s: %s%.600s", ends->of, crs_name(ends->from, names[0]), ends->in,
             crs_name(ends->to, names[1]), why, more);
    return END_INPUT;
}

int gdal_transform_open(gdal_transform **transform, const gdal_transform_ends *ends, bool *rough)
{
    gdal_transform *t = *transform = calloc(1, sizeof *t);
    transform_member *first = t ? calloc(1, sizeof *first) : NULL;
    if (!first) return fail_memory();
    t->members[0] = first;
    t->gdal = gdal_library_load();
    if (!t->gdal)
        return transform_fail(ends,
                              "GDAL, which would transform it, cannot be loaded (" MW_GDAL ")", "");
    OGRSpatialReferenceH from = crs_parse(t->gdal, ends->from, false),
                         to = crs_parse(t->gdal, ends->to, false);
    if (from && to) first->way = transform_find_way(t->gdal, from, to, rough);
    if (from) t->gdal->OSRRelease(from);
    if (to) t->gdal->OSRRelease(to);
    return first->way ? 0
                      : transform_fail(ends, "PROJ has no way from one to the other: ",
                                       t->gdal->CPLGetLastErrorMsg());
}

void gdal_transform_close(gdal_transform *t)
{
    if (!t) return;
    for (size_t i = 0; i < MOST_MEMBERS && t->members[i]; i++) {
        if (t->members[i]->way) t->gdal->OCTDestroyCoordinateTransformation(t->members[i]->way);
        free(t->members[i]);
    }
    free(t);
}

/* GDAL chooses one way for all points of a call, by their mean: each point has a call of its own,
 * so that its position depends on nothing else. */
static bool transform_point(const gdal_transform *t, transform_member *m, double p[2])
{
    int done = 0;
    bool finite = isfinite(p[0]) && isfinite(p[1]);
    if (finite) t->gdal->OCTTransformEx(m->way, 1, &p[0], &p[1], NULL, &done);
    bool good = done && isfinite(p[0]) && isfinite(p[1]);
    if (!good) p[0] = p[1] = NAN;
    return good || !finite;
}

static void transform_chunk(gdal_transform *t, transform_member *m, size_t first)
{
    size_t end = t->count - first < CHUNK ? t->count : first + CHUNK;
    uint64_t lost = 0;
    for (size_t i = first; i < end; i++) lost += !transform_point(t, m, t->points + i * t->stride);
    atomic_fetch_add(&t->lost, lost);
}

static void transform_chunks(void *work, uint32_t member)
{
    gdal_transform *t = work;
    for (size_t i; (i = atomic_fetch_add(&t->next, CHUNK)) < t->count;)
        transform_chunk(t, t->members[member], i);
}

/* Make members until there are so many. Returns how many there are, at least one. */
static uint32_t transform_gather(gdal_transform *t, uint32_t team)
{
    uint32_t count = 1;
    for (; count < team && count < MOST_MEMBERS; count++) {
        if (t->members[count]) continue;
        transform_member *m = calloc(1, sizeof *m);
        if (m) m->way = t->gdal->OCTClone(t->members[0]->way);
        if (!m || !m->way) {
            free(m);
            return count;
        }
        t->members[count] = m;
    }
    return count;
}

uint64_t gdal_transform_points(gdal_transform *t, double *points, size_t count, size_t stride,
                               uint32_t threads)
{
    t->points = points;
    t->count = count;
    t->stride = stride;
    atomic_store(&t->next, 0);
    atomic_store(&t->lost, 0);
    uint32_t team = transform_gather(t, mw__team(threads, 1 + count / (MEMBER_CHUNKS * CHUNK)));
    mw__team_run(team, transform_chunks, t);
    return atomic_load(&t->lost);
}

#else

int gdal_transform_check(const char *what)
{
    complain("%s: only a program built with GDAL transforms points", what);
    return END_INPUT;
}

int gdal_transform_open(gdal_transform **transform, const gdal_transform_ends *ends, bool *rough)
{
    char names[2][CRS_NAME];
    *transform = NULL;
    *rough = false;
    complain("%s is in %s, %s in %s: only a program built with GDAL can transform it", ends->of,
             crs_name(ends->from, names[0]), ends->in, crs_name(ends->to, names[1]));
    return END_INPUT;
}

void gdal_transform_close(gdal_transform *transform)
{
    (void)transform;
}

uint64_t gdal_transform_points(gdal_transform *transform, double *points, size_t count,
                               size_t stride, uint32_t threads)
{
    (void)transform;
    (void)points;
    (void)count;
    (void)stride;
    (void)threads;
    return count;
}

#endif
