/* surface_followers.c - probers and stars that follow the edits of a surface, in time proportional
 * to the triangles that an edit touched. */
#include "surface/edit/surface_followers.h"
#include "star/prepare/star_follow.h"
#include "star/prepare/star_track.h"
#include "surface/edit/surface_corners.h"

#include <stdlib.h>

/* --- who follows --- */

static bool editor_has_prober(const mw_surface_editor *e, const mw_prober *prober)
{
    for (size_t i = 0; i < e->prober_count; i++)
        if (e->prober[i] == prober) return true;
    return false;
}

static bool editor_has_star(const mw_surface_editor *e, const mw_star *star)
{
    for (size_t i = 0; i < e->star_count; i++)
        if (e->star[i] == star) return true;
    return false;
}

mw_status mw__followers_add_prober(mw_surface_editor *e, mw_prober *prober, mw_error *error)
{
    mw_job job = mw__job(1, NULL);
    if (prober->surface != e->surface)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the prober is one of another surface");
    if (!prober->has_bvh || editor_has_prober(e, prober)) return MW_OK;
    if (!mw__surface_grow(&e->prober, &e->prober_room, e->prober_count + 1, sizeof *e->prober))
        return mw__fail_memory(error);
    if (prober->edit_count != e->surface->edit_count && !mw__prober_rebuild(prober, &job))
        return mw__fail_memory(error);
    if (!mw__bvh_follow(&prober->bvh, e->surface)) return mw__fail_memory(error);
    e->prober[e->prober_count++] = prober;
    return MW_OK;
}

mw_status mw__followers_add_star(mw_surface_editor *e, mw_star *star, mw_error *error)
{
    if (star->surface != e->surface)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the star is one of another surface");
    if (star->borrowed)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "a borrowed star cannot follow edits: call mw_star_update() after them, "
                        "unless it is unchecked");
    if (editor_has_star(e, star)) return MW_OK;
    if (!mw__surface_grow(&e->star, &e->star_room, e->star_count + 1, sizeof *e->star) ||
        !mw__star_attach(star))
        return mw__fail_memory(error);
    e->star[e->star_count++] = star;
    return MW_OK;
}

void mw__followers_remove_prober(mw_surface_editor *e, const mw_prober *prober)
{
    for (size_t i = e->prober_count; i-- > 0;)
        if (e->prober[i] == prober) e->prober[i] = e->prober[--e->prober_count];
}

void mw__followers_remove_star(mw_surface_editor *e, mw_star *star)
{
    for (size_t i = e->star_count; i-- > 0;)
        if (e->star[i] == star) {
            mw__star_detach(star);
            e->star[i] = e->star[--e->star_count];
        }
}

void mw__followers_release(mw_surface_editor *e)
{
    for (size_t i = 0; i < e->star_count; i++) mw__star_detach(e->star[i]);
    free(e->prober);
    free(e->star);
}

size_t mw__followers_bytes(const mw_surface_editor *e)
{
    return e->prober_room * sizeof(mw_prober *) + e->star_room * sizeof(mw_star *);
}

/* --- memory --- */

/* Room for the boxes, which are made anew where the tree would become too deep. */
static bool boxes_reserve(const mw_surface_editor *e, mw_prober *prober, size_t made)
{
    mw_job job = mw__job(1, NULL);
    if (made == 0) return true;
    if (mw__bvh_is_deep(&prober->bvh) && prober->edit_count == e->surface->edit_count &&
        !mw__prober_rebuild(prober, &job))
        return false;
    return mw__bvh_reserve(&prober->bvh, e->surface->tri_count + made, made);
}

bool mw__followers_reserve(mw_surface_editor *e, size_t made, size_t vertices)
{
    const mw_surface *s = e->surface;
    for (size_t i = 0; i < e->prober_count; i++)
        if (!boxes_reserve(e, e->prober[i], made)) return false;
    for (size_t i = 0; i < e->star_count; i++)
        if (mw__star_follows(e->star[i], s->shape) &&
            !mw__star_track_reserve(e->star[i], s->tri_count + made, s->point_count + vertices))
            return false;
    return true;
}

/* --- boxes --- */

/* A triangle in the tree that shares an edge or a vertex with t; MW_NONE: none was found. */
static uint32_t triangle_beside(const mw_surface_editor *e, const mw_bvh *bvh, uint32_t t)
{
    enum { LOOKS = 4 };
    const uint32_t *place = bvh->place;
    const mw_triangle *tri = &e->surface->tri[t];
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = tri->link[k];
        if (link != MW_NONE && place[mw__link_triangle(link)] != MW_NONE)
            return mw__link_triangle(link);
    }
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t c = e->at[tri->v[k]].first;
        for (int i = 0; i < LOOKS && c != MW_NONE; i++, c = e->corner[c].next)
            if (place[c / 3] != MW_NONE) return c / 3;
    }
    return MW_NONE;
}

/* First what comes, then what goes: the tree is never empty. */
static void boxes_follow_triangles(const mw_surface_editor *e, mw_bvh *bvh)
{
    const mw_surface_step *step = mw__last_step(e);
    const mw_triangle_entry *first = e->triangle + step->first_triangle,
                            *end = e->triangle + e->triangle_count;
    for (const mw_triangle_entry *i = first; i < end; i++) {
        if (!mw__surface_has_triangle(e, i->triangle)) continue;
        if (!mw__entry_was(i))
            mw__bvh_put(bvh, e->surface, i->triangle, triangle_beside(e, bvh, i->triangle));
        else if (mw__entry_is_altered(e, i))
            mw__bvh_refit(bvh, e->surface, i->triangle);
    }
    for (uint32_t t = step->tri_count; t < e->surface->tri_count; t++)
        mw__bvh_put(bvh, e->surface, t, triangle_beside(e, bvh, t));
    for (const mw_triangle_entry *i = first; i < end; i++)
        if (mw__entry_was(i) && !mw__surface_has_triangle(e, i->triangle))
            mw__bvh_drop(bvh, i->triangle);
}

/* Call `change` for each triangle round a vertex that the step moved. */
static void triangles_moved(const mw_surface_editor *e, void *follower,
                            void (*change)(const mw_surface_editor *e, void *follower, uint32_t t))
{
    for (size_t i = mw__last_step(e)->first_vertex; i < e->vertex_count; i++) {
        if (e->vertex[i].event != MW_VERTEX_MOVED) continue;
        uint32_t c = e->at[e->vertex[i].vertex].first;
        for (; mw__is_corner(c); c = e->corner[c].next) change(e, follower, c / 3);
    }
}

static void box_refit(const mw_surface_editor *e, void *bvh, uint32_t t)
{
    mw__bvh_refit(bvh, e->surface, t);
}

static void prober_follow(const mw_surface_editor *e, mw_prober *prober)
{
    if (prober->edit_count + 1 != e->surface->edit_count) return;
    boxes_follow_triangles(e, &prober->bvh);
    triangles_moved(e, &prober->bvh, box_refit);
    prober->closed = e->borders == 0;
    prober->edit_count = e->surface->edit_count;
}

/* --- stars --- */

static void star_facet_renew(const mw_surface_editor *e, void *star, uint32_t t)
{
    (void)e;
    mw__star_track_renew(star, t);
}

static void star_facet_link(const mw_surface_editor *e, void *star, uint32_t t)
{
    (void)e;
    mw__star_track_link(star, t);
}

/* First what comes and changes, then its links, then what goes. */
static void facets_follow(const mw_surface_editor *e, mw_star *star)
{
    const mw_surface_step *step = mw__last_step(e);
    const mw_triangle_entry *first = e->triangle + step->first_triangle,
                            *end = e->triangle + e->triangle_count;
    for (const mw_triangle_entry *i = first; i < end; i++)
        if (mw__surface_has_triangle(e, i->triangle) &&
            (!mw__entry_was(i) || mw__entry_is_altered(e, i)))
            mw__star_track_renew(star, i->triangle);
    for (uint32_t t = step->tri_count; t < e->surface->tri_count; t++)
        mw__star_track_renew(star, t);
    triangles_moved(e, star, star_facet_renew);
    for (const mw_triangle_entry *i = first; i < end; i++)
        if (mw__surface_has_triangle(e, i->triangle)) mw__star_track_link(star, i->triangle);
    for (uint32_t t = step->tri_count; t < e->surface->tri_count; t++) mw__star_track_link(star, t);
    triangles_moved(e, star, star_facet_link);
    for (const mw_triangle_entry *i = first; i < end; i++)
        if (!mw__surface_has_triangle(e, i->triangle)) mw__star_track_drop(star, i->triangle);
}

/* If the lowest facet has left a vertex, find which is the lowest now. */
static void owner_find(const mw_surface_editor *e, mw_star *star, uint32_t v)
{
    if (star->owner[v] != MW_STAR_OWNER_LOST) return;
    uint32_t lowest = MW_NONE;
    for (uint32_t c = e->at[v].first; mw__is_corner(c); c = e->corner[c].next)
        if (c / 3 < lowest) lowest = c / 3;
    star->owner[v] = lowest;
}

static void owners_follow(const mw_surface_editor *e, mw_star *star)
{
    for (size_t i = mw__last_step(e)->first_triangle; i < e->triangle_count; i++) {
        const mw_triangle_entry *entry = &e->triangle[i];
        for (uint32_t k = 0; k < 3; k++) {
            owner_find(e, star, entry->before.v[k]);
            if (mw__surface_has_triangle(e, entry->triangle))
                owner_find(e, star, e->surface->tri[entry->triangle].v[k]);
        }
    }
}

static void star_follow_edit(const mw_surface_editor *e, mw_star *star)
{
    if (!mw__star_follows(star, e->surface->shape - 1)) return;
    facets_follow(e, star);
    owners_follow(e, star);
    mw__star_edit_end(star);
}

/* --- all --- */

void mw__followers_follow(mw_surface_editor *e)
{
    e->surface->edit_count++;
    e->surface->shape++;
    for (size_t i = 0; i < e->prober_count; i++) prober_follow(e, e->prober[i]);
    for (size_t i = 0; i < e->star_count; i++) star_follow_edit(e, e->star[i]);
}

void mw__followers_end_update(mw_surface_editor *e)
{
    const mw_surface *s = e->surface;
    for (size_t i = 0; i < e->prober_count; i++) {
        mw_prober *prober = e->prober[i];
        if (prober->version + 1 == s->version && prober->edit_count == s->edit_count)
            prober->version = s->version;
    }
    for (size_t i = 0; i < e->star_count; i++) {
        mw_star *star = e->star[i];
        if (star->version + 1 == s->version && mw__star_follows(star, s->shape))
            star->version = s->version;
    }
}

/* Make the boxes of the probers anew from number `i` on; if one fails, all are what they were. */
static bool probers_rebuild(mw_surface_editor *e, size_t i)
{
    mw_job job = mw__job(1, NULL);
    if (i == e->prober_count) return true;
    mw_prober former;
    if (!mw__prober_remake(e->prober[i], &job, &former)) return false;
    bool done = probers_rebuild(e, i + 1);
    mw_bvh gone = done ? former.bvh : e->prober[i]->bvh;
    if (!done) *e->prober[i] = former;
    mw__bvh_release(&gone);
    return done;
}

bool mw__followers_rebuild(mw_surface_editor *e)
{
    return probers_rebuild(e, 0);
}

void mw__followers_renumber(mw_surface_editor *e, const uint32_t *triangle, const uint32_t *vertex)
{
    mw_surface *s = e->surface;
    s->edit_count++;
    s->shape++;
    for (size_t i = 0; i < e->prober_count; i++) {
        e->prober[i]->edit_count = s->edit_count;
        e->prober[i]->version = s->version - 1; /* its boxes are those of this update */
    }
    for (size_t i = 0; i < e->star_count; i++) {
        if (!mw__star_follows(e->star[i], s->shape - 1)) continue;
        mw__star_track_renumber(e->star[i], triangle, vertex);
        mw__star_edit_end(e->star[i]);
    }
}
