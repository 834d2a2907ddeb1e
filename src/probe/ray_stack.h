/* ray_stack.h - a ray visits a node of the BVH: which children it meets, and in which order they
 * wait. Private.
 *
 * The processor has to predict one branch only: whether there is a node among the children. A
 * network sorts all eight numbers, and those that count come first. A wrong prediction costs as
 * much time as the network. */
#ifndef MW_SRC_PROBE_RAY_STACK_H
#define MW_SRC_PROBE_RAY_STACK_H

#include "probe/bvh/bvh_beam.h"

/* The nodes that wait, siblings by distance, the nearest on top. The search goes depth first, which
 * bounds the stack: of each level, at most the children of one node wait. A key is the distance of
 * a node as the bits of a float, which are in the order of the floats as none is negative; the
 * lowest bits hold the number of the child. So keys are not above the distance. */
#define MW_RAY_STACK_ROOM ((MW_BVH_LEVELS + 1) * MW_BVH_WIDTH)
#define MW_RAY_KEY_CHILD (MW_BVH_WIDTH - 1)

typedef struct mw_ray_stack {
    uint32_t count;
    uint32_t key[MW_RAY_STACK_ROOM], node[MW_RAY_STACK_ROOM];
} mw_ray_stack;

/* The next node that waits and is no farther than `reach`, or MW_NONE. */
static MW_INLINE uint32_t mw__ray_stack_pop(mw_ray_stack *stack, float reach)
{
    uint32_t bits, i = stack->count, node = MW_NONE;
    memcpy(&bits, &reach, sizeof bits);
    while (i > 0) {
        i--;
        if (stack->key[i] > (bits | MW_RAY_KEY_CHILD)) continue;
        node = stack->node[i];
        break;
    }
    stack->count = i;
    return node;
}

/* Test the children of a node against the beam: near[] as of mw_beam_meets. Those that are nodes
 * and are met are put on the stack. Returns the others that are met, as bits. */
typedef uint32_t mw_ray_visit(const mw_bvh_beam *beam, const mw_bvh_node *node,
                              float near[MW_BVH_WIDTH], mw_ray_stack *stack);

static MW_INLINE uint32_t mw__ray_visit_portable(const mw_bvh_beam *beam, const mw_bvh_node *node,
                                                 float near[MW_BVH_WIDTH], mw_ray_stack *stack)
{
    uint32_t triangles, met = mw__beam_meets_portable(beam, node, near, &triangles),
                        floor = stack->count;
    for (uint32_t left = met & ~triangles; left; left &= left - 1) {
        uint32_t child = (uint32_t)__builtin_ctz(left), key, i = stack->count++;
        memcpy(&key, &near[child], sizeof key);
        key = (key & ~MW_RAY_KEY_CHILD) | child;
        for (; i > floor && stack->key[i - 1] < key; i--) {
            stack->key[i] = stack->key[i - 1];
            stack->node[i] = stack->node[i - 1];
        }
        stack->key[i] = key;
        stack->node[i] = node->child[child];
    }
    return met & triangles;
}

#ifdef __x86_64__

/* One step of the network: each number and its partner, which is `other`; the greater one goes to
 * the lane whose bit in `low` is 0. */
#define MW_RAY_SORT_STEP(v, other, low)                                                            \
    _mm256_blend_epi32(_mm256_max_epi32(v, other), _mm256_min_epi32(v, other), low)

__attribute__((target("avx2"))) static inline __m256i mw__ray_sort_avx2(__m256i v)
{
    v = MW_RAY_SORT_STEP(v, _mm256_shuffle_epi32(v, 0xB1), 0xAA);
    v = MW_RAY_SORT_STEP(v, _mm256_shuffle_epi32(v, 0x1B), 0xCC);
    v = MW_RAY_SORT_STEP(v, _mm256_shuffle_epi32(v, 0xB1), 0xAA);
    __m256i turned = _mm256_shuffle_epi32(_mm256_permute4x64_epi64(v, 0x4E), 0x1B);
    v = MW_RAY_SORT_STEP(v, turned, 0xF0);
    v = MW_RAY_SORT_STEP(v, _mm256_shuffle_epi32(v, 0x4E), 0xCC);
    return MW_RAY_SORT_STEP(v, _mm256_shuffle_epi32(v, 0xB1), 0xAA);
}

/* Put the children that are nodes and are met on the stack. Returns them as bits. */
__attribute__((target("avx2"))) static inline uint32_t
mw__ray_push_avx2(const mw_bvh_node *node, __m256 met, __m256 near, mw_ray_stack *stack)
{
    __m256i child = _mm256_load_si256((const __m256i *)(const void *)node->child);
    __m256i nodes = _mm256_andnot_si256(_mm256_srai_epi32(child, 31), _mm256_castps_si256(met));
    uint32_t inner = (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(nodes));
    if (!inner) return 0;
    __m256i key =
        _mm256_andnot_si256(_mm256_set1_epi32(MW_RAY_KEY_CHILD), _mm256_castps_si256(near));
    key = _mm256_or_si256(key, _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    key = mw__ray_sort_avx2(_mm256_blendv_epi8(_mm256_set1_epi32(-1), key, nodes));
    child = _mm256_permutevar8x32_epi32(child, key);
    _mm256_storeu_si256((__m256i *)(void *)&stack->key[stack->count], key);
    _mm256_storeu_si256((__m256i *)(void *)&stack->node[stack->count], child);
    stack->count += (uint32_t)__builtin_popcount(inner);
    return inner;
}

__attribute__((target("avx2"))) static inline uint32_t mw__ray_visit_avx2(const mw_bvh_beam *beam,
                                                                          const mw_bvh_node *node,
                                                                          float near[MW_BVH_WIDTH],
                                                                          mw_ray_stack *stack)
{
    __m256 distance, met = MW_LIKELY(beam->ahead) ? mw__beam_meets_ahead(beam, node, &distance)
                                                  : mw__beam_meets_avx2(beam, node, &distance);
    _mm256_storeu_ps(near, distance);
    uint32_t inner = mw__ray_push_avx2(node, met, distance, stack);
    return (uint32_t)_mm256_movemask_ps(met) & ~inner;
}

#endif

#endif
