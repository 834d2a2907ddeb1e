/* editor_state.c - queries about the current mesh, by number. */
#include "edit/editor.h"

#include "dynamic/dynamic_tiling_memory.h"
#include "dynamic/journal.h"
#include "dynamic/vertex_star.h"

static size_t undo_bytes(const mw_editor *editor)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    return dynamic->journal_room * sizeof *dynamic->journal +
           dynamic->step_room * sizeof *dynamic->step + editor->log_room * sizeof *editor->log;
}

void mw_editor_describe(const mw_editor *editor, mw_editor_info *info)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    const mw_tiling *tiling = dynamic->tiling;
    size_t index_bytes = mw__upkeep_bytes(&editor->upkeep),
           fields = editor->view.field_count * editor->field_room;
    *info = (mw_editor_info){
        .vertices = tiling->point_count - dynamic->free_count,
        .triangles = tiling->tri_count - tiling->ghost_count,
        .vertex_range = dynamic->vertex_count,
        .triangle_range = tiling->number_count,
        .constrained_edges = dynamic->fixed_count,
        .delaunay = dynamic->delaunay,
        .convex = dynamic->convex,
        .undoable = editor->undoable,
        .bytes = sizeof *editor + mw__dynamic_bytes(dynamic) + mw__tiling_bytes(tiling) +
                 index_bytes + fields * sizeof(double) + editor->log_room * sizeof *editor->log +
                 editor->changed_room * sizeof *editor->changed,
        .undo_bytes = undo_bytes(editor),
        .index_bytes = index_bytes,
        .edits = editor->edits,
        .refreshes = editor->upkeep.refreshes,
    };
}

/* The tile of a triangle; NULL if no triangle has that number. */
static const mw_triangle *triangle_tile(const mw_tiling *tiling, uint32_t triangle)
{
    if (triangle >= tiling->number_count || tiling->tile_of[triangle] & MW_GONE) return NULL;
    return &tiling->tri[tiling->tile_of[triangle]];
}

int mw_editor_triangle(const mw_editor *editor, uint32_t triangle, uint32_t vertices[3])
{
    const mw_triangle *tile = triangle_tile(editor->dynamic.tiling, triangle);
    if (!tile) return 0;
    mw__dynamic_tile_vertices(&editor->dynamic, tile, vertices);
    return 1;
}

int mw_editor_vertex(const mw_editor *editor, uint32_t vertex, double point[2])
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    if (vertex >= dynamic->vertex_count || dynamic->vertex_slot[vertex] == MW_NONE) return 0;
    mw_point p = dynamic->tiling->point[dynamic->vertex_slot[vertex]];
    point[0] = p.x;
    point[1] = p.y;
    return 1;
}

uint32_t mw_editor_triangle_of(const mw_editor *editor, uint32_t vertex)
{
    uint32_t v = mw__used_vertex_slot(&editor->dynamic, vertex);
    const mw_tiling *tiling = editor->dynamic.tiling;
    return v == MW_NONE ? MW_NONE : mw__lowest_at_vertex(tiling, tiling->tile_at[v], v);
}

/* An edge between ghosts is not an edge of the mesh. */
static bool edge_is_of_mesh(const mw_dynamic_tiling *dynamic, uint32_t half)
{
    uint32_t other = mw__beyond(dynamic, half);
    return mw__is_users_tile(dynamic, mw__link_triangle(half)) ||
           (other != MW_NONE && mw__is_users_tile(dynamic, mw__link_triangle(other)));
}

size_t mw_editor_adjacent_vertices(const mw_editor *editor, uint32_t vertex, uint32_t *neighbours,
                                   size_t capacity)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    uint32_t v = mw__used_vertex_slot(dynamic, vertex);
    if (v == MW_NONE) return 0;
    size_t n = 0;
    bool open;
    uint32_t begin = mw__vertex_star_first(dynamic, v, &open), at = begin;
    if (!open) /* begin after the ghosts, if there are any */
        while (mw__is_users_tile(dynamic, mw__link_triangle(at))) {
            at = mw__half_next(mw__beyond(dynamic, at));
            if (at == begin) break;
        }
    if (!mw__is_users_tile(dynamic, mw__link_triangle(at)))
        at = mw__beyond(dynamic, mw__half_prev(at));
    begin = at;
    do {
        uint32_t last = mw__half_prev(at);
        if (edge_is_of_mesh(dynamic, at) && n++ < capacity)
            neighbours[n - 1] = dynamic->vertex_number[mw__corner(dynamic, mw__half_next(at))];
        at = mw__beyond(dynamic, last);
        if (at == MW_NONE && edge_is_of_mesh(dynamic, last) && n++ < capacity)
            neighbours[n - 1] = dynamic->vertex_number[mw__corner(dynamic, last)];
    } while (at != MW_NONE && at != begin);
    return n;
}

mw_edge_kind mw_editor_edge(const mw_editor *editor, uint32_t from, uint32_t to)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    uint32_t v = mw__used_vertex_slot(dynamic, from), w = mw__used_vertex_slot(dynamic, to);
    uint32_t half =
        v == MW_NONE || w == MW_NONE || v == w ? MW_NONE : mw__dynamic_edge(dynamic, v, w);
    if (half == MW_NONE || !edge_is_of_mesh(dynamic, half)) return MW_EDGE_NONE;
    uint32_t other = mw__beyond(dynamic, half);
    bool border = other == MW_NONE || mw__is_users_tile(dynamic, mw__link_triangle(half)) !=
                                          mw__is_users_tile(dynamic, mw__link_triangle(other));
    if (border && !(dynamic->convex && mw__is_fixed(dynamic, half))) return MW_EDGE_BORDER;
    return mw__is_fixed(dynamic, half) ? MW_EDGE_CONSTRAINED : MW_EDGE_UNCONSTRAINED;
}

uint32_t mw_editor_field_by_name(const mw_editor *editor, const char *name)
{
    const double *values = mw_mesh_field(&editor->view, name);
    for (uint32_t i = 0; values && i < editor->view.field_count; i++)
        if (editor->view.field[i].values == values) return i;
    return MW_NONE;
}

double mw_editor_value(const mw_editor *editor, uint32_t field, uint32_t vertex)
{
    const mw_dynamic_tiling *dynamic = &editor->dynamic;
    bool there = field < editor->view.field_count && vertex < dynamic->vertex_count &&
                 dynamic->vertex_slot[vertex] != MW_NONE;
    return there ? editor->view.field[field].values[vertex] : NAN;
}

void mw_editor_interpolate(const mw_editor *editor, uint32_t field, const mw_location *locations,
                           size_t n, double *result)
{
    for (size_t i = 0; i < n; i++) {
        result[i] = NAN; /* also if the triangle has been deleted since */
        if (field >= editor->view.field_count ||
            !triangle_tile(editor->dynamic.tiling, locations[i].triangle))
            continue;
        mw_interpolate(&editor->view, editor->view.field[field].values, &locations[i], 1,
                       &result[i]);
    }
}

const mw_locator *mw_editor_locator(const mw_editor *editor)
{
    return &editor->locator;
}

mw_status mw_editor_index(mw_editor *editor, mw_start_kind start, const mw_index_options *options,
                          const mw_index **index, mw_error *error)
{
    if (!editor || !index)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the editor or the pointer to the new index is NULL");
    *index = NULL;
    mw_job job = mw__job(editor->threads, options ? options->progress : NULL);
    mw_status status = mw__upkeep_build(&editor->upkeep, start, options, &job, error);
    status = mw__job_end(&job, status, error);
    if (!status) *index = &editor->upkeep.index[start];
    return status;
}
