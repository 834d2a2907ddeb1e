/* star_index.c - builds and describes the index of a start. */
#include "star/star_index.h"
#include "base/options.h"

#include "base/clock.h"

#include <stdlib.h>

#define FACETS_A_CELL 16 /* the default */

static uint32_t star_index_choose_cells(const mw_star *star)
{
    return star->tri_count / FACETS_A_CELL + 1;
}

static uint32_t star_index_choose_levels(const mw_star *star)
{
    uint32_t levels = 0;
    while (levels < MW_STAR_MAX_LEVELS &&
           mw__star_octahedron_cells(levels) < star_index_choose_cells(star))
        levels++;
    return levels;
}

static bool star_index_build(mw_star_index *index, const mw_star *star,
                             const mw_star_index_options *options, mw_job *job)
{
    mw__job_stage(job, "filling cells", 1);
    if (index->start == MW_STAR_START_OCTAHEDRON) {
        uint32_t levels = options->levels ? options->levels - 1 : star_index_choose_levels(star);
        while (mw__cells_bound(mw__star_octahedron_cells(levels), star->tri_count) <
               mw__star_octahedron_cells(levels))
            levels--;
        return mw__star_octahedron_create(&index->octahedron, star, levels, job);
    }
    uint32_t cells = options->cells ? mw__cells_bound(options->cells, star->tri_count)
                                    : star_index_choose_cells(star);
    return mw__star_grid_create(&index->grid, star, cells, index->start == MW_STAR_START_GRID, job);
}

static mw_status star_index_check(const mw_star *star, mw_star_start_kind start,
                                  const mw_star_index_options *options, mw_error *error)
{
    if (!star) return mw__fail(error, MW_ERROR_ARGUMENT, "the star is NULL");
    if (!mw_star_start_has_index(start))
        return mw__fail(error, MW_ERROR_ARGUMENT, "this start has no index");
    if (star->borrowed) return mw__fail(error, MW_ERROR_ARGUMENT, "a borrowed star has no index");
    if (options->cells > MW_STAR_MAX_CELLS)
        return mw__fail(error, MW_ERROR_ARGUMENT, "a grid has at most 2^30 cells");
    if (options->levels > MW_STAR_MAX_LEVELS + 1)
        return mw__fail(error, MW_ERROR_ARGUMENT, "an octahedron has at most %d levels",
                        MW_STAR_MAX_LEVELS);
    if (!star->ready || star->version != star->surface->version)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the star is not up to date with its surface");
    return MW_RESERVED_CHECK(mw_star_index_options, options, error);
}

mw_status mw_star_index_create(const mw_star *star, mw_star_start_kind start,
                               const mw_star_index_options *options, mw_star_index **out,
                               mw_error *error)
{
    static const mw_star_index_options defaults;
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new index is NULL");
    *out = NULL;
    if (!options) options = &defaults;
    mw_status status = star_index_check(star, start, options, error);
    if (status) return status;
    mw_star_index *index = mw__calloc(1, sizeof *index);
    if (!index) return mw__fail_memory(error);
    index->start = start;
    double begin = mw__seconds();
    mw_job job = mw__job(1, options->progress);
    status = star_index_build(index, star, options, &job) ? MW_OK : mw__fail_memory(error);
    status = mw__job_end(&job, status, error);
    index->seconds = mw__seconds() - begin;
    if (status)
        mw_star_index_destroy(index);
    else
        *out = index;
    return status;
}

void mw_star_index_destroy(mw_star_index *index)
{
    if (!index) return;
    if (index->start == MW_STAR_START_OCTAHEDRON)
        mw__star_octahedron_release(&index->octahedron);
    else
        mw__star_grid_release(&index->grid);
    free(index);
}

mw_star_start_kind mw__star_index_start(const mw_star_index *index)
{
    return index->start;
}

void mw_star_index_describe(const mw_star_index *index, mw_star_index_info *info)
{
    *info = (mw_star_index_info){
        .start = index->start, .bytes = sizeof *index, .seconds = index->seconds};
    if (index->start == MW_STAR_START_OCTAHEDRON) {
        info->levels = index->octahedron.levels;
        info->cells = mw__star_octahedron_cells(info->levels);
    } else {
        info->cells = index->grid.first[index->grid.rows];
        info->bytes += (index->grid.rows + 1) * sizeof *index->grid.first;
    }
    info->bytes += info->cells * sizeof(uint32_t);
}
