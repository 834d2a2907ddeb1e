/* call_locators.c - long calls: locators, indices, batches, borrowed arrays and editors. */
#include "support/calls/call_runs.h"

#include <meshwalk/segment.h>
#include <stdlib.h>

/* --- locators --------------------------------------------------------------------------------- */

static mw_status locator_run(const mw_mesh *mesh, mw_locator_options options,
                             const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_locator *locator;
    mw_locator_info info;
    options.threads = how->threads;
    options.progress = how->progress;
    mw_status status = mw_locator_create(mesh, &options, &locator, error);
    call_expect(!status == (locator != NULL), "there is a locator");
    if (status) return status;
    mw_locator_describe(locator, &info);
    call_sum(sum, (uint64_t)info.ghost_triangles << 32 | info.holes);
    mw_locator_destroy(locator);
    return MW_OK;
}

mw_status run_locator(const call_inputs *in, const call_setting *how, uint64_t *sum,
                      mw_error *error)
{
    return locator_run(in->mesh, (mw_locator_options){.border = 1, .areas = 1}, how, sum, error);
}

mw_status run_locator_crowded(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    return locator_run(in->crowded, (mw_locator_options){0}, how, sum, error);
}

mw_status run_locator_filled(const call_inputs *in, const call_setting *how, uint64_t *sum,
                             mw_error *error)
{
    return locator_run(in->holed, (mw_locator_options){.fill = MW_FILL_YES}, how, sum, error);
}

mw_status run_locator_open(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    return locator_run(in->holed, (mw_locator_options){.fill = MW_FILL_NO}, how, sum, error);
}

static mw_status index_run(const call_inputs *in, mw_start_kind start, const call_setting *how,
                           uint64_t *sum, mw_error *error)
{
    mw_index *index;
    mw_index_info info;
    mw_index_options options = {.progress = how->progress};
    mw_status status = mw_index_create(in->locator, start, &options, &index, error);
    call_expect(!status == (index != NULL), "there is an index");
    if (status) return status;
    mw_index_describe(index, &info);
    call_sum(sum, (uint64_t)info.cells << 32 | info.layers);
    mw_index_destroy(index);
    return MW_OK;
}

mw_status run_index_grid(const call_inputs *in, const call_setting *how, uint64_t *sum,
                         mw_error *error)
{
    return index_run(in, MW_START_GRID, how, sum, error);
}

mw_status run_index_two_level(const call_inputs *in, const call_setting *how, uint64_t *sum,
                              mw_error *error)
{
    return index_run(in, MW_START_TWO_LEVEL_GRID, how, sum, error);
}

mw_status run_index_curve(const call_inputs *in, const call_setting *how, uint64_t *sum,
                          mw_error *error)
{
    return index_run(in, MW_START_CURVE, how, sum, error);
}

mw_status run_index_layers(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    return index_run(in, MW_START_LAYERS, how, sum, error);
}

mw_status run_index_buckets(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    return index_run(in, MW_START_BUCKETS, how, sum, error);
}

mw_status run_index_triangle_buckets(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                     mw_error *error)
{
    return index_run(in, MW_START_TRIANGLE_BUCKETS, how, sum, error);
}

mw_status run_index_kd_tree(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    return index_run(in, MW_START_KD_TREE, how, sum, error);
}

mw_status run_index_chains(const call_inputs *in, const call_setting *how, uint64_t *sum,
                           mw_error *error)
{
    return index_run(in, MW_START_CHAINS, how, sum, error);
}

mw_status run_batch(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_location *at = malloc(in->point_count * sizeof *at);
    mw_query_options options = {
        .start = MW_START_SORTED, .threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_locate_batch(in->locator, in->points, in->point_count, 2, &options, at, NULL, error);
    if (!status) call_sum_locations(sum, at, in->point_count);
    free(at);
    return status;
}

/* From point to point. */
mw_status run_segments(const call_inputs *in, const call_setting *how, uint64_t *sum,
                       mw_error *error)
{
    mw_segment_pieces pieces;
    mw_segment_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status =
        mw_segment_batch(in->locator, in->points, in->point_count - 1, 2, &options, &pieces, error);
    call_expect(!status == (pieces.offset != NULL), "there are pieces");
    for (size_t i = 0; i < pieces.piece_count; i++) call_sum(sum, pieces.piece[i].triangle);
    mw_segment_pieces_release(&pieces);
    return status;
}

/* --- borrowed arrays -------------------------------------------------------------------------- */

static mw_status borrow_run(const call_inputs *in, mw_borrow_options options, mw_borrowed **mesh,
                            mw_error *error)
{
    mw_borrowed_arrays foreign = {.mesh = arrays_view(&in->whole), .neighbours = in->neighbours};
    mw_status status = mw_mesh_borrow(&foreign, &options, mesh, error);
    call_expect(!status == (*mesh != NULL), "there is a borrowed mesh");
    return status;
}

mw_status run_borrow(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_borrowed *mesh;
    mw_borrowed_info info;
    mw_borrow_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = borrow_run(in, options, &mesh, error);
    if (status) return status;
    mw_borrowed_describe(mesh, &info);
    call_sum(sum, (uint64_t)info.convex << 32 | info.clockwise_triangles);
    mw_borrowed_release(mesh);
    return MW_OK;
}

mw_status run_borrowed_batch(const call_inputs *in, const call_setting *how, uint64_t *sum,
                             mw_error *error)
{
    mw_borrowed *mesh;
    mw_status status =
        borrow_run(in, (mw_borrow_options){.unchecked = 1, .convex = 1}, &mesh, error);
    if (status) return status;
    mw_location *at = malloc(in->point_count * sizeof *at);
    mw_borrowed_query_options options = {.threads = how->threads, .progress = how->progress};
    status =
        mw_borrowed_locate_batch(mesh, in->points, in->point_count, 2, &options, at, NULL, error);
    if (!status) call_sum_locations(sum, at, in->point_count);
    free(at);
    mw_borrowed_release(mesh);
    return status;
}

/* --- editors ---------------------------------------------------------------------------------- */

mw_status run_editor(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_editor *editor;
    mw_editor_info info;
    mw_editor_options options = {.threads = how->threads, .progress = how->progress};
    mw_status status = mw_editor_create(in->mesh, &options, &editor, error);
    call_expect(!status == (editor != NULL), "there is an editor");
    if (status) return status;
    mw_editor_describe(editor, &info);
    call_sum(sum, info.triangles);
    mw_editor_destroy(editor);
    return MW_OK;
}

/* The editor's own calls are watched only if it was made with `progress`; so all of them are one
 * call here. What an editor holds must be the same before and after one that fails. */
static uint64_t editor_sum(const mw_editor *editor)
{
    uint64_t sum = 0;
    mw_editor_info info;
    mw_editor_describe(editor, &info);
    call_sum(&sum, (uint64_t)info.triangles << 32 | info.vertices);
    call_sum(&sum, info.edits);
    return sum;
}

static mw_status editor_edit(mw_editor *editor, const call_inputs *in, uint64_t *sum,
                             mw_error *error)
{
    enum { MOST = 200 };
    double more[2 * MOST];
    uint32_t n = in->point_count - 1 < MOST ? in->point_count - 1 : MOST;
    mw_mesh *mesh = NULL;
    mw_index_options layers = {0};
    const mw_index *index;
    uint64_t before = editor_sum(editor);
    for (uint32_t i = 0; i < 2 * n; i++) more[i] = 0.5 * (in->points[i] + in->points[i + 2]);
    mw_status status = mw_edit_insert_points(editor, more, n, 2, NULL, NULL, error);
    call_expect(!status || before == editor_sum(editor), "the editor has changed");
    if (!status) status = mw_editor_index(editor, MW_START_LAYERS, &layers, &index, error);
    if (!status) before = editor_sum(editor), status = mw_editor_compact(editor, NULL, NULL, error);
    call_expect(!status || before == editor_sum(editor), "the editor has changed");
    if (!status) {
        status = mw_editor_mesh(editor, NULL, NULL, &mesh, error);
        call_mesh_made(status, mesh, sum);
    }
    return status;
}

mw_status run_edits(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_editor *editor;
    mw_editor_options options = {.threads = how->threads, .progress = how->progress, .undo = 2};
    mw_status status = mw_editor_create(in->mesh, &options, &editor, error);
    if (!status) status = editor_edit(editor, in, sum, error);
    mw_editor_destroy(editor);
    return status;
}
