/* call_files.c - long calls: files, read and written. */
#include "support/calls/call_runs.h"

#include <meshwalk/io.h>
#include <meshwalk/operator.h>
#include <meshwalk/prepared.h>
#include <meshwalk/weights.h>
#include <stdio.h>
#include <unistd.h>

mw_status run_read(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    mw_mesh_file file;
    mw_file_options options = {.progress = how->progress};
    mw_status status = mw_read_mesh(in->path, &options, &file, error);
    call_expect(!status || (!file.points && !file.triangles), "there is something from the file");
    if (!status) call_sum(sum, (uint64_t)file.point_count << 32 | file.triangle_count);
    mw_mesh_file_release(&file);
    return status;
}

mw_status run_read_lines(const call_inputs *in, const call_setting *how, uint64_t *sum,
                         mw_error *error)
{
    mw_constraint_file file;
    mw_file_options options = {.progress = how->progress};
    mw_status status = mw_read_constraints(in->lines, &options, &file, error);
    call_expect(!status || (!file.points && !file.segments), "there is something from the file");
    if (!status) call_sum(sum, (uint64_t)file.point_count << 32 | file.segment_count);
    mw_constraint_file_release(&file);
    return status;
}

static mw_status write_run(const call_inputs *in, const char *ending, const call_setting *how,
                           mw_error *error)
{
    char path[80];
    mw_mesh_file file;
    mw_file_options options = {.progress = how->progress};
    expect_ok(mw_read_mesh(in->path, NULL, &file, error), "a file", error);
    snprintf(path, sizeof path, "%s%s", in->path, ending);
    mw_status status = mw_write_mesh(path, &file, NULL, &options, error);
    call_expect(!status == (access(path, F_OK) == 0), "there is a file");
    mw_mesh_file_release(&file);
    unlink(path);
    return status;
}

mw_status run_write(const call_inputs *in, const call_setting *how, uint64_t *sum, mw_error *error)
{
    (void)sum;
    return write_run(in, ".ply", how, error);
}

mw_status run_write_pair(const call_inputs *in, const call_setting *how, uint64_t *sum,
                         mw_error *error)
{
    char path[80];
    (void)sum;
    mw_status status = write_run(in, ".node", how, error);
    snprintf(path, sizeof path, "%s.ele", in->path);
    call_expect(!status == (access(path, F_OK) == 0), "there is a second file");
    unlink(path);
    return status;
}

mw_status run_write_weights(const call_inputs *in, const call_setting *how, uint64_t *sum,
                            mw_error *error)
{
    char path[80];
    mw_status status;
    mw_operator *weights = call_operator_of(in, &(call_setting){.threads = 1}, &status, error);
    mw_file_options options = {.progress = how->progress};
    (void)sum;
    snprintf(path, sizeof path, "%s.npz", in->path);
    status = mw_write_weights(path, weights, NULL, &options, error);
    call_expect(!status == (access(path, F_OK) == 0), "there is a file of weights");
    unlink(path);
    mw_operator_destroy(weights);
    return status;
}

mw_status run_write_tiles(const call_inputs *in, const call_setting *how, uint64_t *sum,
                          mw_error *error)
{
    static const char *const names[] = {"overview.mwm", "tile-00000.mwm", "tile-00001.mwm",
                                        "tiles.json"};
    char folder[80], path[120];
    mw_tile_options options = {.tiles = 2, .threads = how->threads, .progress = how->progress};
    (void)sum;
    snprintf(folder, sizeof folder, "%s.tiles", in->path);
    mw_status status = mw_write_tiles(in->locator, folder, &options, error);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        call_expect(!status == (unlink(path) == 0), "there is a file of a tile");
    }
    call_expect(!status == (rmdir(folder) == 0), "there is a folder");
    return status;
}
