/* live_layers.c - the layered hierarchy, which follows insertions, removals and moves [Devillers
 * 2002, "The Delaunay hierarchy"].
 *
 * Layers are built as above a mesh that does not change (start/layers.c); then each becomes a
 * dynamic tiling. On average a vertex has 1 / (1 - ratio) - 1 copies above the mesh; by default
 * there is one copy for 39 vertices. Only copies take time here, so an edit of the layers costs
 * little compared with the edit of the mesh. */
#include "edit/live_layers.h"

#include "base/random.h"
#include "dynamic/dynamic_tiling_memory.h"
#include "dynamic/journal.h"
#include "dynamic/move/move.h"
#include "dynamic/operations.h"
#include "start/start.h"

#include <stdlib.h>
#include <string.h>

static const mw_tiling *tiling_below(const mw_live_layers *live, uint32_t i)
{
    return i == 0 ? live->mesh->tiling : &live->layers->layer[i - 1].tiling;
}

/* --- building --------------------------------------------------------------------------------- */

static bool points_are_equal(mw_point a, mw_point b)
{
    return a.x == b.x && a.y == b.y;
}

/* Replace the names of tiles below, which layers at rest hold, by the slots of vertices; and set
 * the way up. */
static bool link_layers(mw_live_layers *live, uint32_t i)
{
    mw_layer *layer = &live->layers->layer[i];
    const mw_tiling *above = &layer->tiling, *beneath = tiling_below(live, i);
    live->up[i] = mw__alloc(beneath->point_count, sizeof *live->up[i]);
    if (!live->up[i]) return false;
    live->up_room[i] = beneath->point_count;
    live->below_room[i] = above->point_count;
    memset(live->up[i], 0xff, beneath->point_count * sizeof *live->up[i]); /* MW_NONE */
    for (uint32_t v = 0; v < above->point_count; v++) {
        const mw_triangle *tile = &beneath->tri[mw__tile_of_name(beneath, layer->below[v])];
        uint32_t k = 0;
        while (k < 2 && !points_are_equal(beneath->point[tile->v[k]], above->point[v])) k++;
        layer->below[v] = tile->v[k];
        live->up[i][tile->v[k]] = v;
    }
    return true;
}

/* Make a layer dynamic. */
static mw_status layer_make_dynamic(mw_live_layers *live, uint32_t i, mw_error *error)
{
    mw_tiling *tiling = &live->layers->layer[i].tiling;
    const mw_mesh numbers = {.point = tiling->point,
                             .tri = tiling->tri,
                             .point_count = tiling->point_count,
                             .tri_count = tiling->tri_count};
    free(tiling->area);
    tiling->area = NULL;
    mw_status status = mw__dynamic_create(&live->dynamic[i], tiling, &numbers, true, error);
    live->dynamic[i].delaunay = true;
    return status;
}

mw_status mw__live_layers_create(mw_live_layers *live, mw_layers *layers,
                                 const mw_dynamic_tiling *mesh, const mw_layers_options *options,
                                 mw_job *job, mw_error *error)
{
    *live = (mw_live_layers){.layers = layers,
                             .mesh = mesh,
                             .ratio = options->ratio > 0 ? options->ratio : MW_LAYER_RATIO,
                             .random = mw__random_seed(options->seed, UINT32_MAX)};
    mw_job_span outer = mw__job_part(job, 0.8);
    mw_status status = mw__layers_create(mesh->tiling, options, job, layers, error);
    mw__job_part_end(job, outer);
    mw__job_stage(job, "linking layers", 0.2);
    layers->live = true;
    for (uint32_t i = 0; i + 1 < layers->count && !status; i++)
        status = link_layers(live, i) ? layer_make_dynamic(live, i, error) : mw__fail_memory(error);
    return status;
}

void mw__live_layers_attach(mw_live_layers *live, mw_layers *layers)
{
    live->layers = layers;
    for (uint32_t i = 0; i + 1 < layers->count; i++)
        live->dynamic[i].tiling = &layers->layer[i].tiling;
}

/* Release layer i and those above it; the lowest above the mesh is layer 0. Returns false. */
static bool live_layers_cut(mw_live_layers *live, uint32_t i)
{
    for (uint32_t k = i; k + 1 < live->layers->count; k++) {
        mw__dynamic_release(&live->dynamic[k]);
        free(live->up[k]);
        live->up[k] = NULL;
        live->up_room[k] = 0;
    }
    mw__layers_cut(live->layers, i + 1);
    return false;
}

void mw__live_layers_drop(mw_live_layers *live)
{
    if (live->layers) live_layers_cut(live, 0);
}

void mw__live_layers_release(mw_live_layers *live)
{
    mw__live_layers_drop(live);
    live->layers = NULL;
}

size_t mw__live_layers_bytes(const mw_live_layers *live)
{
    size_t bytes = 0;
    for (uint32_t i = 0; live->layers && i + 1 < live->layers->count; i++) {
        uint32_t spare = live->below_room[i] - live->layers->layer[i].tiling.point_count;
        bytes += mw__dynamic_bytes(&live->dynamic[i]) + live->up_room[i] * sizeof *live->up[i] +
                 spare * sizeof *live->layers->layer[i].below;
    }
    return bytes;
}

static uint32_t vertices_in_layer(const mw_live_layers *live, uint32_t i)
{
    if (i == 0) return live->layers->vertices;
    return live->layers->layer[i - 1].tiling.point_count - live->layers->layer[i - 1].vacant;
}

bool mw__live_layers_even(const mw_live_layers *live)
{
    for (uint32_t i = 1; i < live->layers->count; i++) {
        double expected = fmax(3, live->ratio * vertices_in_layer(live, i - 1)),
               size = vertices_in_layer(live, i);
        if (size > 2 * expected || 2 * size < expected) return false;
    }
    return true;
}

/* --- following a vertex ----------------------------------------------------------------------- */

/* Room for entry i; new entries are MW_NONE. */
static bool entry_room(uint32_t **array, uint32_t *room, uint32_t i)
{
    if (i < *room) return true;
    size_t more = (size_t)i + i / 4 + 16;
    uint32_t *larger = mw__realloc(*array, more, sizeof *larger);
    if (!larger) return false;
    memset(larger + *room, 0xff, (more - *room) * sizeof *larger); /* MW_NONE */
    *array = larger;
    *room = (uint32_t)more;
    return true;
}

static uint32_t copy_above(const mw_live_layers *live, uint32_t i, uint32_t v)
{
    return v < live->up_room[i] ? live->up[i][v] : MW_NONE;
}

/* Carry out one edit of layer i as a step of its own. */
static bool layer_edit(mw_live_layers *live, uint32_t i, mw_edit_kind what, uint32_t *v, mw_point p,
                       uint32_t tile)
{
    mw_dynamic_tiling *dynamic = &live->dynamic[i];
    if (!mw__journal_begin(dynamic, &(mw_edit){.kind = what, .x = p.x, .y = p.y}, true))
        return false;
    mw_status status = what == MW_EDIT_INSERT   ? mw__dynamic_insert(dynamic, p, tile, v, NULL)
                       : what == MW_EDIT_REMOVE ? mw__dynamic_remove(dynamic, *v, NULL)
                                                : mw__dynamic_move(dynamic, *v, p, MW_NONE, NULL);
    if (status) {
        mw__journal_rollback(dynamic);
        return false;
    }
    mw__journal_commit(dynamic);
    mw__journal_forget(dynamic, 0);
    live->layers->layer[i].vacant = dynamic->free_count;
    return true;
}

/* Copy vertex *v of the layer beneath into layer i; the search begins at a tile. *v becomes the
 * copy. */
static bool layer_insert_copy(mw_live_layers *live, uint32_t i, uint32_t *v, mw_point p,
                              uint32_t tile)
{
    mw_layer *layer = &live->layers->layer[i];
    uint32_t copy = MW_NONE, numbers = live->dynamic[i].vertex_count;
    if (!entry_room(&live->up[i], &live->up_room[i], *v)) return false;
    if (!entry_room(&layer->below, &live->below_room[i], layer->tiling.point_count)) return false;
    if (!layer_edit(live, i, MW_EDIT_INSERT, &copy, p, tile) ||
        live->dynamic[i].vertex_count == numbers)
        return false;
    layer->below[copy] = *v;
    live->up[i][*v] = copy;
    *v = copy;
    return true;
}

/* In how many layers does a new vertex get a copy? */
static uint32_t random_height(mw_live_layers *live)
{
    uint32_t height = 0, most = live->layers->count - 1;
    while (height < most && (double)(mw__random(&live->random) >> 11) * 0x1p-53 < live->ratio)
        height++;
    return height;
}

bool mw__live_layers_insert(mw_live_layers *live, uint32_t v, mw_point p)
{
    const mw_layer_walk how = {MW_WALK_REMEMBERING, MW_WALK_REMEMBERING, true, false,
                               live->mesh->tiling};
    uint32_t tile[MW_MAX_LAYERS - 1], height = random_height(live);
    live->layers->vertices++;
    if (height == 0) return true;
    mw__layers_descend(live->layers, p, &how, &live->random, NULL, tile);
    for (uint32_t i = 0; i < height; i++)
        if (!layer_insert_copy(live, i, &v, p, tile[i])) return live_layers_cut(live, i);
    return true;
}

bool mw__live_layers_remove(mw_live_layers *live, uint32_t v)
{
    live->layers->vertices--;
    for (uint32_t i = 0; i + 1 < live->layers->count; i++) {
        uint32_t copy = copy_above(live, i, v);
        if (copy == MW_NONE) break;
        live->up[i][v] = MW_NONE;
        if (!layer_edit(live, i, MW_EDIT_REMOVE, &copy, (mw_point){0, 0}, 0))
            return live_layers_cut(live, i);
        v = copy;
    }
    return true;
}

bool mw__live_layers_move(mw_live_layers *live, uint32_t v, mw_point p)
{
    for (uint32_t i = 0; i + 1 < live->layers->count; i++) {
        v = copy_above(live, i, v);
        if (v == MW_NONE) break;
        if (!layer_edit(live, i, MW_EDIT_MOVE, &v, p, 0)) return live_layers_cut(live, i);
    }
    return true;
}
