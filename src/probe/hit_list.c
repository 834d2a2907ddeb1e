/* hit_list.c - all triangles that a ray meets, in their order along the line.
 *
 * The list is a heap whose top is the last triangle. If the list is full, a triangle that comes
 * before the top takes its place. At the end the heap is sorted. Until then a touch holds only its
 * triangle and side. */
#include "probe/ray.h"

static mw_ray_side touch_side(const mw_touch *touch)
{
    return touch->back ? MW_RAY_BACK : MW_RAY_FRONT;
}

/* Does touch a come after touch b? */
static bool touch_is_after(const mw_ray_search *s, const mw_touch *a, const mw_touch *b)
{
    return mw__ray_order(s->prober->surface, s->ray, a->triangle, touch_side(a), b->triangle,
                         touch_side(b)) > 0;
}

static void heap_sift(const mw_ray_search *s, mw_touch *heap, size_t n, size_t i)
{
    mw_touch touch = heap[i];
    for (size_t child; (child = 2 * i + 1) < n; i = child) {
        if (child + 1 < n && touch_is_after(s, &heap[child + 1], &heap[child])) child++;
        if (!touch_is_after(s, &heap[child], &touch)) break;
        heap[i] = heap[child];
    }
    heap[i] = touch;
}

static bool hit_list_grow(mw_hit_list *list)
{
    size_t capacity = 2 * list->capacity + 8;
    mw_touch *touches = mw__realloc(list->touches, capacity, sizeof *touches);
    list->no_memory = !touches;
    if (!touches) return false;
    list->touches = touches;
    list->capacity = capacity;
    return true;
}

bool mw__hit_list_found(mw_ray_search *s, uint32_t triangle, mw_ray_side side)
{
    mw_hit_list *list = s->self;
    if (list->grows && list->count == list->capacity && !hit_list_grow(list)) return false;
    mw_touch touch = {.triangle = triangle, .back = side == MW_RAY_BACK}, *heap = list->touches;
    size_t i = list->count++;
    if (i < list->capacity) {
        for (; i > 0 && touch_is_after(s, &touch, &heap[(i - 1) / 2]); i = (i - 1) / 2)
            heap[i] = heap[(i - 1) / 2];
        heap[i] = touch;
    } else if (list->capacity && touch_is_after(s, &heap[0], &touch)) {
        heap[0] = touch;
        heap_sift(s, heap, list->capacity, 0);
    }
    return true;
}

static size_t hit_list_held(const mw_hit_list *list)
{
    return list->count < list->capacity ? list->count : list->capacity;
}

void mw__hit_list_sort(const mw_ray_search *s)
{
    mw_hit_list *list = s->self;
    mw_touch *heap = list->touches;
    for (size_t n = hit_list_held(list); n-- > 1;) {
        mw_touch last = heap[0];
        heap[0] = heap[n];
        heap[n] = last;
        heap_sift(s, heap, n, 0);
    }
}

void mw__hit_list_keep_places(const mw_ray_search *s)
{
    mw_hit_list *list = s->self;
    mw_touch *touch = list->touches;
    size_t kept = 0;
    for (size_t i = 0; i < list->count; i++)
        if (kept == 0 || mw__ray_place_order(s->prober->surface, s->ray, touch[kept - 1].triangle,
                                             touch_side(&touch[kept - 1]), touch[i].triangle,
                                             touch_side(&touch[i])) != 0)
            touch[kept++] = touch[i];
    list->count = kept;
}

void mw__hit_list_complete(const mw_ray_search *s)
{
    mw_hit_list *list = s->self;
    mw_touch *touch = list->touches;
    for (size_t i = 0, held = hit_list_held(list); i < held; i++)
        touch[i] =
            mw__ray_touch(s->prober->surface, s->ray, touch[i].triangle, touch_side(&touch[i]));
}
