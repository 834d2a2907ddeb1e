/* bvh_follow.c - lets a bounding volume hierarchy follow single triangles: as in an R-tree [Guttman
 * 1984], a node that overflows is divided in two, and so perhaps its parent, up to the root. So the
 * tree becomes deeper at its root only, by a level for a number of insertions that grows
 * exponentially: each new level needs at least three times as many as the one before it, the first
 * one seven. Boxes are exact: a change goes up as long as it makes a difference.
 *
 * How many nodes can k insertions need? A division needs a node with eight children, and leaves
 * two with six at most. So on each level there are at most as many divisions as were nodes, and a
 * third of those on the level below: fewer than 1.5 times all nodes, and k / 2. And there are at
 * most as many as levels for each insertion. */
#include "probe/bvh/bvh.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* --- the tree --- */

static MW_INLINE uint32_t tree_place(uint32_t node, uint32_t child)
{
    return node * MW_BVH_WIDTH + child;
}

static mw_bvh_box place_box(const mw_bvh *b, uint32_t place)
{
    const mw_bvh_node *node = &b->node[place / MW_BVH_WIDTH];
    mw_bvh_box box;
    for (int k = 0; k < 3; k++) {
        box.low[k] = node->low[k][place % MW_BVH_WIDTH];
        box.high[k] = node->high[k][place % MW_BVH_WIDTH];
    }
    return box;
}

static void place_set_box(mw_bvh *b, uint32_t place, mw_bvh_box box)
{
    mw_bvh_node *node = &b->node[place / MW_BVH_WIDTH];
    for (int k = 0; k < 3; k++) {
        node->low[k][place % MW_BVH_WIDTH] = box.low[k];
        node->high[k][place % MW_BVH_WIDTH] = box.high[k];
    }
}

/* A child of the node becomes another: its triangles do not count as equal any more, and nor do
 * those of the nodes above it. Where a node does not, those above it do not already. */
static void node_differs(mw_bvh *b, uint32_t node)
{
    while (b->same && b->same[node] != MW_NONE) {
        b->same[node] = MW_NONE;
        if (b->parent[node] == MW_NONE) return;
        node = b->parent[node] / MW_BVH_WIDTH;
    }
}

static void place_clear(mw_bvh *b, uint32_t place)
{
    node_differs(b, place / MW_BVH_WIDTH);
    b->node[place / MW_BVH_WIDTH].child[place % MW_BVH_WIDTH] = MW_NONE;
    place_set_box(b, place,
                  (mw_bvh_box){{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}});
}

/* A child with all that its parent keeps of it. */
typedef struct bvh_child {
    mw_bvh_box box;
    uint32_t child, vertex[3];
} bvh_child;

static bvh_child place_child(const mw_bvh *b, uint32_t place)
{
    const mw_bvh_node *node = &b->node[place / MW_BVH_WIDTH];
    uint32_t i = place % MW_BVH_WIDTH;
    bvh_child c = {.box = place_box(b, place), .child = node->child[i]};
    memcpy(c.vertex, node->vertex[i], sizeof c.vertex);
    return c;
}

static void place_set_child(mw_bvh *b, uint32_t place, const bvh_child *c)
{
    mw_bvh_node *node = &b->node[place / MW_BVH_WIDTH];
    uint32_t i = place % MW_BVH_WIDTH;
    node_differs(b, place / MW_BVH_WIDTH);
    node->child[i] = c->child;
    memcpy(node->vertex[i], c->vertex, sizeof c->vertex);
    place_set_box(b, place, c->box);
    if (c->child & MW_BVH_TRIANGLE)
        b->place[c->child & ~MW_BVH_TRIANGLE] = place;
    else
        b->parent[c->child] = place;
}

/* The box at a place has changed: fit those above it. */
static void boxes_fit_above(mw_bvh *b, uint32_t place)
{
    for (;;) {
        uint32_t node = place / MW_BVH_WIDTH;
        place = b->parent[node];
        if (place == MW_NONE) return;
        mw_bvh_box box = mw__bvh_box_of_node(&b->node[node]), was = place_box(b, place);
        if (memcmp(&box, &was, sizeof box) == 0) return;
        place_set_box(b, place, box);
    }
}

static uint32_t node_take(mw_bvh *b)
{
    uint32_t i = b->free_node;
    if (i != MW_NONE)
        b->free_node = b->parent[i];
    else
        i = b->node_count++;
    if (b->same) b->same[i] = MW_NONE;
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) {
        place_clear(b, tree_place(i, k));
        memset(b->node[i].vertex[k], 0, sizeof b->node[i].vertex[k]);
    }
    b->parent[i] = MW_NONE;
    return i;
}

static void node_free(mw_bvh *b, uint32_t i)
{
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) place_clear(b, tree_place(i, k));
    b->parent[i] = b->free_node;
    b->free_node = i;
}

/* --- dividing a node --- */

enum { CHILDREN = MW_BVH_WIDTH + 1, FEWEST = 3 };

/* Sides beyond this count as this: areas are finite. */
#define FARTHEST 0x1p40f

static float side_limit(float x)
{
    return x > FARTHEST ? FARTHEST : x < -FARTHEST ? -FARTHEST : x;
}

/* Half the surface area of a box; 0 for an empty one. */
static float box_area(const mw_bvh_box *box)
{
    float d[3];
    for (int k = 0; k < 3; k++) {
        d[k] = side_limit(box->high[k]) - side_limit(box->low[k]);
        if (d[k] < 0) return 0;
    }
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

static void child_box_join(mw_bvh_box *box, const mw_bvh_box *more)
{
    for (int k = 0; k < 3; k++) {
        if (more->low[k] < box->low[k]) box->low[k] = more->low[k];
        if (more->high[k] > box->high[k]) box->high[k] = more->high[k];
    }
}

static void children_sort(bvh_child c[CHILDREN], int axis)
{
    for (int i = 1; i < CHILDREN; i++) {
        bvh_child moving = c[i];
        float at = side_limit(moving.box.low[axis]) + side_limit(moving.box.high[axis]);
        int j = i;
        for (;
             j > 0 && side_limit(c[j - 1].box.low[axis]) + side_limit(c[j - 1].box.high[axis]) > at;
             j--)
            c[j] = c[j - 1];
        c[j] = moving;
    }
}

/* The best number of children on the left, in the present order; *least is the sum of both areas,
 * each times its children, of the best division so far. 0: none is better. */
static int children_divide(const bvh_child c[CHILDREN], float *least)
{
    float right[CHILDREN];
    mw_bvh_box box = c[CHILDREN - 1].box;
    int best = 0;
    for (int i = CHILDREN - 1; i > 0; i--) {
        child_box_join(&box, &c[i].box);
        right[i] = box_area(&box) * (float)(CHILDREN - i);
    }
    box = c[0].box;
    for (int i = 1; i <= CHILDREN - FEWEST; i++) {
        float cost = box_area(&box) * (float)i + right[i];
        if (i >= FEWEST && cost < *least) {
            *least = cost;
            best = i;
        }
        child_box_join(&box, &c[i].box);
    }
    return best;
}

/* Order the children so that the first ones make one node, the others another. Returns how many
 * are first. */
static int children_part(bvh_child c[CHILDREN])
{
    bvh_child order[CHILDREN];
    float least = INFINITY;
    int first = FEWEST;
    memcpy(order, c, sizeof order);
    for (int axis = 0; axis < 3; axis++) {
        children_sort(order, axis);
        int n = children_divide(order, &least);
        if (n == 0) continue;
        first = n;
        memcpy(c, order, sizeof order);
    }
    return first;
}

/* --- insertion --- */

/* Move what is in the root to a new node, its only child. */
static void root_push_down(mw_bvh *b)
{
    uint32_t node = node_take(b);
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) {
        bvh_child c = place_child(b, tree_place(0, k));
        if (c.child != MW_NONE) place_set_child(b, tree_place(node, k), &c);
        place_clear(b, tree_place(0, k));
    }
    place_set_child(b, tree_place(0, 0),
                    &(bvh_child){.box = mw__bvh_box_of_node(&b->node[node]), .child = node});
    b->level_count++;
}

static uint32_t node_empty_child(const mw_bvh_node *node)
{
    uint32_t k = 0;
    while (k < MW_BVH_WIDTH && node->child[k] != MW_NONE) k++;
    return k;
}

/* Divide a full node and one more child: a part of them stays. Returns the other part, a new
 * node. */
static bvh_child node_part(mw_bvh *b, uint32_t i, const bvh_child *more)
{
    bvh_child c[CHILDREN];
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) c[k] = place_child(b, tree_place(i, k));
    c[CHILDREN - 1] = *more;
    uint32_t first = (uint32_t)children_part(c), other = node_take(b);
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) place_clear(b, tree_place(i, k));
    for (uint32_t k = 0; k < CHILDREN; k++)
        place_set_child(b, k < first ? tree_place(i, k) : tree_place(other, k - first), &c[k]);
    return (bvh_child){.box = mw__bvh_box_of_node(&b->node[other]), .child = other};
}

static void node_add(mw_bvh *b, uint32_t node, bvh_child child)
{
    for (;;) {
        uint32_t k = node_empty_child(&b->node[node]);
        if (k < MW_BVH_WIDTH) {
            place_set_child(b, tree_place(node, k), &child);
            boxes_fit_above(b, tree_place(node, k));
            return;
        }
        if (node == 0) {
            root_push_down(b);
            node = b->node[0].child[0];
        }
        child = node_part(b, node, &child);
        uint32_t above = b->parent[node];
        place_set_box(b, above, mw__bvh_box_of_node(&b->node[node]));
        boxes_fit_above(b, above);
        node = above / MW_BVH_WIDTH;
    }
}

/* The node without nodes below it whose boxes grow least. */
static uint32_t node_for(const mw_bvh *b, const mw_bvh_box *box)
{
    uint32_t node = 0, next = 0;
    while (next != MW_NONE) {
        float least = INFINITY;
        node = next;
        next = MW_NONE;
        for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) {
            if (b->node[node].child[k] & MW_BVH_TRIANGLE) continue;
            mw_bvh_box was = place_box(b, tree_place(node, k)), joined = was;
            child_box_join(&joined, box);
            float growth = box_area(&joined) - box_area(&was);
            if (next != MW_NONE && !(growth < least)) continue;
            least = growth;
            next = b->node[node].child[k];
        }
    }
    return node;
}

static bvh_child child_of_triangle(mw_bvh *b, const mw_surface *surface, uint32_t triangle)
{
    bvh_child c = {.box = mw__bvh_box_of(b, surface, triangle),
                   .child = triangle | MW_BVH_TRIANGLE};
    memcpy(c.vertex, surface->tri[triangle].v, sizeof c.vertex);
    if (c.box.low[0] > c.box.high[0]) b->finite = false;
    return c;
}

void mw__bvh_put(mw_bvh *bvh, const mw_surface *surface, uint32_t triangle, uint32_t beside)
{
    bvh_child child = child_of_triangle(bvh, surface, triangle);
    node_add(bvh, beside == MW_NONE ? node_for(bvh, &child.box) : bvh->place[beside] / MW_BVH_WIDTH,
             child);
}

/* --- other changes --- */

void mw__bvh_refit(mw_bvh *bvh, const mw_surface *surface, uint32_t triangle)
{
    bvh_child child = child_of_triangle(bvh, surface, triangle);
    place_set_child(bvh, bvh->place[triangle], &child);
    boxes_fit_above(bvh, bvh->place[triangle]);
}

static uint32_t node_children(const mw_bvh_node *node, uint32_t *last)
{
    uint32_t n = 0;
    for (uint32_t k = 0; k < MW_BVH_WIDTH; k++)
        if (node->child[k] != MW_NONE) {
            n++;
            *last = k;
        }
    return n;
}

/* A node with one child is replaced by that child. All nodes but the root have two. */
void mw__bvh_drop(mw_bvh *bvh, uint32_t triangle)
{
    uint32_t place = bvh->place[triangle], node = place / MW_BVH_WIDTH, last = 0;
    bvh->place[triangle] = MW_NONE;
    place_clear(bvh, place);
    if (node != 0 && node_children(&bvh->node[node], &last) == 1) {
        bvh_child only = place_child(bvh, tree_place(node, last));
        place = bvh->parent[node];
        node_free(bvh, node);
        place_set_child(bvh, place, &only);
    }
    boxes_fit_above(bvh, place);
}

/* --- memory --- */

static bool bvh_places_grow(mw_bvh *b, size_t count)
{
    if (count <= b->place_room) return true;
    size_t room = b->place_room + b->place_room / 2;
    if (room < count) room = count;
    if (room > MW_MAX_TRIANGLES) room = MW_MAX_TRIANGLES;
    uint32_t *place = mw__realloc(b->place, room, sizeof *place);
    if (!place) return false;
    for (size_t t = b->place_room; t < room; t++) place[t] = MW_NONE;
    b->place = place;
    b->place_room = (uint32_t)room;
    return true;
}

static bool bvh_nodes_grow(mw_bvh *b, size_t count)
{
    if (count <= b->node_room) return true;
    size_t room = b->node_room + (size_t)b->node_room / 2;
    if (room < count) room = count;
    if (room > UINT32_MAX / MW_BVH_WIDTH) return false;
    uint32_t *parent = mw__realloc(b->parent, room, sizeof *parent);
    if (!parent) return false;
    b->parent = parent;
    uint32_t *same = b->same ? mw__realloc(b->same, room, sizeof *same) : NULL;
    if (b->same && !same) return false;
    b->same = same;
    mw_bvh_node *node = mw__alloc_lines(room, sizeof *node); /* realloc keeps no cache lines */
    if (!node) return false;
    memcpy(node, b->node, b->node_count * sizeof *node);
    free(b->node);
    b->node = node;
    b->node_room = (uint32_t)room;
    return true;
}

bool mw__bvh_reserve(mw_bvh *bvh, size_t tri_count, size_t insertions)
{
    size_t levels = (size_t)bvh->level_count + 2, most = bvh->node_count, divisions;
    divisions = most + most / 2 + insertions / 2 + levels;
    if (insertions < divisions / levels) divisions = insertions * levels;
    return bvh_places_grow(bvh, tri_count) && bvh_nodes_grow(bvh, most + divisions);
}

bool mw__bvh_follow(mw_bvh *bvh, const mw_surface *surface)
{
    if (bvh->parent) return bvh_places_grow(bvh, surface->tri_count);
    uint32_t *parent = mw__alloc(bvh->node_count, sizeof *parent);
    if (!parent || !bvh_places_grow(bvh, surface->tri_count)) {
        free(parent);
        return false;
    }
    bvh->parent = parent;
    bvh->node_room = bvh->node_count;
    bvh->free_node = MW_NONE;
    parent[0] = MW_NONE;
    for (uint32_t i = 0; i < bvh->node_count; i++)
        for (uint32_t k = 0; k < MW_BVH_WIDTH; k++) {
            uint32_t child = bvh->node[i].child[k];
            if (child == MW_NONE) continue;
            if (child & MW_BVH_TRIANGLE)
                bvh->place[child & ~MW_BVH_TRIANGLE] = tree_place(i, k);
            else
                parent[child] = tree_place(i, k);
        }
    return true;
}
