/* ray_bundle.c - the search of a bundle of rays, with AVX2. */
#include "probe/ray_bundle.h"

#ifdef __x86_64__

#define HALVES (MW_BUNDLE_RAYS / 8)

enum {
    /* Nodes that a bundle visits, and exact looks of its rays; a bundle that needs more is too wide
     * for these triangles. */
    MOST_NODES = 96,
    MOST_LOOKS = 8 * MW_BUNDLE_RAYS
};
/* Directions differ by less than this part of their length, starts by so much in the frame. */
#define WIDTH 0.125
/* And where the rays come to triangles, these are at least so large beside the bundle; smaller ones
 * are met by few of its rays each, and every ray does better alone. */
#define LEAST_TRIANGLE 0.17f

typedef struct ray_bundle {
    const mw_prober *prober;
    const mw_probe_options *options;
    const double *queries;
    size_t stride;
    mw_ray_query *ray;
    mw_ray_search *search;
    /* The hull: as the beam of a ray, but on each axis there are two values of 1 / m. */
    mw_bvh_beam hull;
    float less[3][2], greater[3][2];
    double scale;                 /* of m */
    float q_width[3], m_width[3]; /* how far apart the rays are */
    /* Of all rays, axis by axis, what their beams have. Set at the first triangle. */
    bool begun;
    float add_enter[3][MW_BUNDLE_RAYS], add_leave[3][MW_BUNDLE_RAYS];
    float less_of[3][MW_BUNDLE_RAYS], greater_of[3][MW_BUNDLE_RAYS];
    float from[MW_BUNDLE_RAYS], to[MW_BUNDLE_RAYS];
    float times[MW_BUNDLE_RAYS]; /* t of the hull for t of a ray: 1, or 2 where m is shorter */
    uint32_t nodes, looks;
    mw_ray_stack stack;
} ray_bundle;

/* --- the hull --- */

/* The least and greatest coordinates of where the rays begin, q, and of their directions, m. */
typedef struct bundle_extent {
    __m256d q_low, q_high, m_low, m_high;
} bundle_extent;

#define LOAD_POINT(p) _mm256_setr_pd((p)[0], (p)[1], (p)[2], 0)

/* Returns false if a number is not finite. */
__attribute__((target("avx2"))) static bool bundle_measure(const ray_bundle *b, bundle_extent *e)
{
    const double *query = b->queries;
    __m256d q = LOAD_POINT(query), m = LOAD_POINT(query + 3), sum = _mm256_setzero_pd();
    *e = (bundle_extent){q, q, m, m};
    for (size_t i = 0; i < MW_BUNDLE_RAYS; i++, query += b->stride) {
        q = LOAD_POINT(query);
        m = LOAD_POINT(query + 3);
        sum = _mm256_add_pd(sum, _mm256_add_pd(_mm256_sub_pd(q, q), _mm256_sub_pd(m, m)));
        e->q_low = _mm256_min_pd(q, e->q_low);
        e->q_high = _mm256_max_pd(q, e->q_high);
        e->m_low = _mm256_min_pd(m, e->m_low);
        e->m_high = _mm256_max_pd(m, e->m_high);
    }
    return _mm256_movemask_pd(_mm256_cmp_pd(sum, _mm256_setzero_pd(), _CMP_EQ_OQ)) == 15;
}

/* Axis k of the hull: as mw__beam_set_axis for the rays at either end. */
static void bundle_set_axis(ray_bundle *b, int k, const double q[2], const double m[2],
                            double width)
{
    mw_bvh_beam first, last;
    mw__beam_set_axis(&first, k, q[0], m[0], width);
    mw__beam_set_axis(&last, k, q[1], m[1], width);
    bool up = m[0] > 0; /* then the hull enters at low sides, less the greatest q + w */
    b->hull.enter[k] = first.enter[k];
    b->hull.leave[k] = first.leave[k];
    b->hull.add_enter[k] = up ? last.add_enter[k] : first.add_enter[k];
    b->hull.add_leave[k] = up ? first.add_leave[k] : last.add_leave[k];
    b->less[k][0] = first.less[k];
    b->less[k][1] = last.less[k];
    b->greater[k][0] = first.greater[k];
    b->greater[k][1] = last.greater[k];
}

/* The power of two by which a beam scales the longest vector from `low` to `high`. */
static double bundle_scale(const double low[3], const double high[3])
{
    double most[3], scaled[3];
    for (int k = 0; k < 3; k++) most[k] = fmax(fabs(low[k]), fabs(high[k]));
    mw__beam_scale(most, scaled);
    return mw__bvh_largest(scaled) / mw__bvh_largest(most);
}

/* Set the hull. Returns false if the rays are not close together, or their beams would not go
 * ahead as they are. */
static bool bundle_aim(ray_bundle *b, const bundle_extent *e)
{
    const mw_bvh *bvh = &b->prober->bvh;
    double low[4], high[4], m_low[4], m_high[4], q[2][3], square = 0, most = 0;
    memcpy(low, &e->q_low, sizeof low);
    memcpy(high, &e->q_high, sizeof high);
    memcpy(m_low, &e->m_low, sizeof m_low);
    memcpy(m_high, &e->m_high, sizeof m_high);
    double scale = b->scale = bundle_scale(m_low, m_high);
    double width = mw__bvh_aim(bvh, low, b->prober->slack, q[0]),
           other = mw__bvh_aim(bvh, high, b->prober->slack, q[1]);
    if (!(scale > 0) || !(scale < INFINITY)) return false;
    for (int k = 0; k < 3; k++) {
        double m[2] = {m_low[k] * scale, m_high[k] * scale}, start[2] = {q[0][k], q[1][k]};
        bool one_sign = m[0] >= MW_BEAM_SMALL_COMPONENT || m[1] <= -MW_BEAM_SMALL_COMPONENT;
        if (!one_sign || m[1] - m[0] > WIDTH || start[1] - start[0] > WIDTH) return false;
        bundle_set_axis(b, k, start, m, width > other ? width : other);
        b->q_width[k] = (float)(start[1] - start[0]);
        b->m_width[k] = (float)(m[1] - m[0]);
        double least = fmin(fabs(m[0]), fabs(m[1]));
        square += least * least;
        most = fmax(most, fmax(fabs(start[0]), fabs(start[1])));
    }
    b->hull.at = 0;
    b->hull.at_low = mw__float_down(0);
    b->hull.at_high = mw__float_up(0);
    b->hull.per_length = bvh->scale / sqrt(square);
    double reach = b->options->max_distance > 0 ? b->options->max_distance : INFINITY;
    mw__beam_limit(&b->hull, reach, true, 0);
    return most <= MW_BEAM_NEAR;
}

/* mw__beam_meets_ahead of the hull. */
__attribute__((target("avx2"))) static inline __m256
bundle_meets(const ray_bundle *b, const mw_bvh_node *node, __m256 *near)
{
    const mw_bvh_beam *hull = &b->hull;
    __m256 low = _mm256_set1_ps(hull->from), high = _mm256_set1_ps(hull->to);
    for (int k = 0; k < 3; k++) {
        __m256 enter = _mm256_load_ps(mw__beam_sides(node, hull->enter[k])),
               leave = _mm256_load_ps(mw__beam_sides(node, hull->leave[k]));
        enter = _mm256_sub_ps(enter, _mm256_set1_ps(hull->add_enter[k]));
        leave = _mm256_sub_ps(leave, _mm256_set1_ps(hull->add_leave[k]));
        __m256 from = _mm256_min_ps(_mm256_mul_ps(enter, _mm256_set1_ps(b->less[k][0])),
                                    _mm256_mul_ps(enter, _mm256_set1_ps(b->less[k][1]))),
               to = _mm256_max_ps(_mm256_mul_ps(leave, _mm256_set1_ps(b->greater[k][0])),
                                  _mm256_mul_ps(leave, _mm256_set1_ps(b->greater[k][1])));
        low = _mm256_max_ps(from, low);
        high = _mm256_min_ps(to, high);
    }
    *near = _mm256_max_ps(low, _mm256_setzero_ps());
    return _mm256_cmp_ps(low, high, _CMP_LE_OQ);
}

/* --- the rays --- */

/* Powers of two change no digit. */
static float bundle_times(const ray_bundle *b, const mw_line *line)
{
    double scaled[3], largest = mw__bvh_largest(line->m);
    mw__beam_scale(line->m, scaled);
    return (float)(mw__bvh_largest(scaled) / (largest * b->scale));
}

static void bundle_begin_rays(ray_bundle *b)
{
    for (uint32_t i = 0; i < MW_BUNDLE_RAYS; i++) {
        const double *query = b->queries + i * b->stride;
        const mw_bvh_beam *beam = &b->search[i].beam;
        mw__probe_ray(b->options, query, query + 3, &b->ray[i]);
        mw__ray_search_begin(&b->search[i], b->prober, &b->ray[i], mw__ray_found_nearest, NULL);
        float times = bundle_times(b, &b->ray[i].line);
        for (int k = 0; k < 3; k++) {
            b->add_enter[k][i] = beam->add_enter[k];
            b->add_leave[k][i] = beam->add_leave[k];
            b->less_of[k][i] = beam->less[k] * times;
            b->greater_of[k][i] = beam->greater[k] * times;
        }
        b->from[i] = beam->from * times;
        b->to[i] = beam->to * times;
        b->times[i] = times;
    }
    b->begun = true;
}

/* The rays that meet the box of child i, as bits: as mw__beam_meets_ahead of each. */
__attribute__((target("avx2"))) static inline uint32_t
bundle_rays_at(const ray_bundle *b, const mw_bvh_node *node, uint32_t i)
{
    uint32_t met = 0;
    for (int half = 0; half < HALVES; half++) {
        __m256 low = _mm256_loadu_ps(b->from + 8 * half), high = _mm256_loadu_ps(b->to + 8 * half);
        for (int k = 0; k < 3; k++) {
            __m256 enter = _mm256_set1_ps(mw__beam_sides(node, b->hull.enter[k])[i]),
                   leave = _mm256_set1_ps(mw__beam_sides(node, b->hull.leave[k])[i]);
            enter = _mm256_sub_ps(enter, _mm256_loadu_ps(b->add_enter[k] + 8 * half));
            leave = _mm256_sub_ps(leave, _mm256_loadu_ps(b->add_leave[k] + 8 * half));
            low =
                _mm256_max_ps(_mm256_mul_ps(enter, _mm256_loadu_ps(b->less_of[k] + 8 * half)), low);
            high = _mm256_min_ps(_mm256_mul_ps(leave, _mm256_loadu_ps(b->greater_of[k] + 8 * half)),
                                 high);
        }
        met |= (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(low, high, _CMP_LE_OQ)) << 8 * half;
    }
    return met;
}

/* Are the rays close together beside child i of the node, a triangle that they come to at t? */
static bool bundle_is_narrow(const ray_bundle *b, const mw_bvh_node *node, uint32_t i, float t)
{
    float across = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        float apart = b->q_width[k] + t * b->m_width[k], side = node->high[k][i] - node->low[k][i];
        across = apart > across ? apart : across;
        size = side > size ? side : size;
    }
    return size >= LEAST_TRIANGLE * across;
}

/* No ray goes farther than the hull. */
__attribute__((target("avx2"))) static inline void bundle_narrow(ray_bundle *b)
{
    float to[8];
    __m256 most = _mm256_loadu_ps(b->to);
    for (int half = 1; half < HALVES; half++)
        most = _mm256_max_ps(most, _mm256_loadu_ps(b->to + 8 * half));
    _mm256_storeu_ps(to, most);
    b->hull.to = to[0];
    for (int i = 1; i < 8; i++) b->hull.to = to[i] > b->hull.to ? to[i] : b->hull.to;
}

/* Look at the triangles of a node that the hull meets. Returns false if that is of no use. */
__attribute__((target("avx2"))) static inline bool
bundle_look(ray_bundle *b, const mw_bvh_node *node, uint32_t triangles, __m256 near)
{
    bool narrower = false;
    if (!b->begun) {
        uint32_t first = (uint32_t)__builtin_ctz(triangles);
        float from[MW_BVH_WIDTH];
        _mm256_storeu_ps(from, near);
        if (!bundle_is_narrow(b, node, first, from[first])) return false;
        bundle_begin_rays(b);
    }
    for (uint32_t left = triangles; left; left &= left - 1) {
        uint32_t i = (uint32_t)__builtin_ctz(left), child = node->child[i];
        if (child == MW_NONE) continue;
        for (uint32_t rays = bundle_rays_at(b, node, i); rays; rays &= rays - 1) {
            uint32_t r = (uint32_t)__builtin_ctz(rays);
            mw_ray_search *s = &b->search[r];
            mw__ray_search_look(s, child & ~MW_BVH_TRIANGLE, node->vertex[i]);
            float to = s->beam.to * b->times[r];
            narrower = narrower || to < b->to[r];
            b->to[r] = to;
            b->looks++;
        }
    }
    if (narrower) bundle_narrow(b);
    return true;
}

/* --- the search --- */

__attribute__((target("avx2"))) static bool bundle_search(ray_bundle *b)
{
    uint32_t at = 0;
    for (; at != MW_NONE; at = mw__ray_stack_pop(&b->stack, b->hull.to)) {
        const mw_bvh_node *node = &b->prober->bvh.node[at];
        __m256 near, met = bundle_meets(b, node, &near);
        uint32_t inner = mw__ray_push_avx2(node, met, near, &b->stack),
                 triangles = (uint32_t)_mm256_movemask_ps(met) & ~inner;
        if (b->stack.count > 1) {
            const char *next =
                (const char *)&b->prober->bvh.node[b->stack.node[b->stack.count - 2]];
            for (size_t line = 0; line < 256; line += 64) __builtin_prefetch(next + line);
        }
        if (triangles && !bundle_look(b, node, triangles, near)) return false;
        b->nodes++;
        if (b->nodes > MOST_NODES || b->looks > MOST_LOOKS) return false;
    }
    return true;
}

__attribute__((target("avx2"))) static bool bundle_run(ray_bundle *b)
{
    bundle_extent extent;
    if (!bundle_measure(b, &extent) || !bundle_aim(b, &extent) || !bundle_search(b)) return false;
    for (uint32_t i = 0; !b->begun && i < MW_BUNDLE_RAYS; i++) mw__ray_search_none(&b->search[i]);
    b->search[0].boxes += MW_BVH_WIDTH * b->nodes;
    return true;
}

#endif

/* Most rays of other batches differ already from the next one. */
static bool bundle_begins(const double *first, const double *second)
{
    double size = 0, most = 0;
    for (int k = 3; k < 6; k++) {
        size = fmax(size, fabs(first[k]));
        most = fmax(most, fabs(second[k] - first[k]));
    }
    return most <= size * 0.125;
}

bool mw__ray_bundle_run(const mw_prober *prober, const mw_probe_options *options,
                        const double *queries, size_t stride, mw_ray_query ray[MW_BUNDLE_RAYS],
                        mw_ray_search search[MW_BUNDLE_RAYS])
{
    if (options->extent != MW_PROBE_RAY || !mw__prober_has_vectors(prober)) return false;
    if (prober->bvh.same) return false; /* a ray alone knows what to make of equal triangles */
    if (!bundle_begins(queries, queries + stride)) return false;
#ifdef __x86_64__
    ray_bundle b;
    b.prober = prober;
    b.options = options;
    b.queries = queries;
    b.stride = stride;
    b.ray = ray;
    b.search = search;
    b.begun = false;
    b.nodes = b.looks = b.stack.count = 0;
    return bundle_run(&b);
#else
    (void)ray;
    (void)search;
    return false;
#endif
}
