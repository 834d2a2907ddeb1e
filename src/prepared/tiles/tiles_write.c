/* tiles_write.c - writes a mesh as a folder of prepared files: tiles, an overview of what is at the
 * border, and an index. The folder is made under another name, which it changes when it is
 * complete. */
#include "base/options.h"
#include "base/posix.h"
#include "base/random.h"
#include "io/text/system_error.h"
#include "prepared/prepared.h"
#include "prepared/tiles/tile_file.h"
#include "prepared/tiles/tile_index.h"
#include "prepared/tiles/tile_triangles.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_ROOM = 32, NAME_ATTEMPTS = 100 };
static const char index_name[] = "tiles.json", overview_name[] = "overview.mwm";

/* --- the folder ------------------------------------------------------------------------------- */

typedef struct tile_folder {
    char *name; /* in the end */
    char *made; /* until then */
    char *file; /* room for the name of a file in it */
    bool there; /* it has been made */
} tile_folder;

static const char *folder_file(const tile_folder *f, const char *name)
{
    sprintf(f->file, "%s/%s", f->made, name);
    return f->file;
}

static const char *folder_tile(const tile_folder *f, uint32_t tile)
{
    sprintf(f->file, "%s/tile-%05u.mwm", f->made, (unsigned)tile);
    return f->file;
}

/* The length of the directory part of a path, with its last '/'. */
static size_t directory_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* Make a directory of a new name beside that of the folder. */
static mw_status folder_make(tile_folder *f, mw_error *error)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    uint64_t state = (uintptr_t)f + (uint64_t)now.tv_nsec + ((uint64_t)getpid() << 32);
    for (int i = 0; i < NAME_ATTEMPTS && !f->there; i++) {
        sprintf(f->made, "%.*s.tiles-%08x", (int)directory_part(f->name), f->name,
                (unsigned)mw__random(&state));
        f->there = mkdir(f->made, 0777) == 0;
        if (!f->there && errno != EEXIST) break;
    }
    return f->there ? MW_OK : mw__fail_system(f->name, errno, error);
}

static mw_status folder_open(tile_folder *f, const char *path, mw_error *error)
{
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') length--;
    *f = (tile_folder){.name = mw__calloc(length + 1, 1),
                       .made = mw__alloc(length + NAME_ROOM, 1),
                       .file = mw__alloc(length + 2 * NAME_ROOM, 1)};
    if (!f->name || !f->made || !f->file) return mw__fail_memory(error);
    memcpy(f->name, path, length);
    if (length == 0) return mw__fail(error, MW_ERROR_ARGUMENT, "the folder has no name");
    if (access(f->name, F_OK) == 0)
        return mw__fail(error, MW_ERROR_SYSTEM, "%s: exists already; remove it first", f->name);
    return folder_make(f, error);
}

/* Remove the folder with its files, unless it has got its name. */
static void folder_release(tile_folder *f, uint32_t tiles)
{
    if (f->there) {
        unlink(folder_file(f, index_name));
        unlink(folder_file(f, overview_name));
        for (uint32_t tile = 0; tile < tiles; tile++) unlink(folder_tile(f, tile));
        rmdir(f->made);
    }
    free(f->name);
    free(f->made);
    free(f->file);
}

static mw_status folder_name(tile_folder *f, mw_error *error)
{
    if (rename(f->made, f->name) != 0) return mw__fail_system(f->name, errno, error);
    f->there = false;
    return MW_OK;
}

/* --- what is in it ---------------------------------------------------------------------------- */

static mw_status tiles_write_files(mw_tile_source *s, mw_tile_triangles *all, const tile_folder *f,
                                   uint64_t *checksum, mw_tile_holes *holes, mw_error *error)
{
    if (!mw__tile_triangles_of_overview(all)) return mw__fail_memory(error);
    mw_status status = mw__tile_file_write(s, all->chosen, all->chosen_count,
                                           folder_file(f, overview_name), checksum, holes, error);
    for (uint32_t tile = 0; tile < all->cuts.tiles && !status; tile++) {
        s->file = tile + 1;
        if (!mw__job_step(s->job, s->file, s->files)) return MW_ERROR_MEMORY; /* it is to stop */
        mw__tile_triangles_of_tile(all, tile);
        status = mw__tile_file_write(s, all->chosen, all->chosen_count, folder_tile(f, tile),
                                     checksum + tile + 1, NULL, error);
    }
    return status;
}

static mw_status tiles_fill_folder(mw_tile_source *s, mw_tile_triangles *all, const tile_folder *f,
                                   mw_error *error)
{
    mw_tile_holes holes = {0};
    uint64_t *checksum = mw__calloc(s->files, sizeof *checksum);
    mw_status status =
        checksum ? tiles_write_files(s, all, f, checksum, &holes, error) : mw__fail_memory(error);
    const mw_tile_index index = {.vertices = mw_mesh_vertex_count(s->mesh),
                                 .triangles = mw_mesh_triangle_count(s->mesh),
                                 .holes = holes.number,
                                 .hole_count = holes.count,
                                 .checksums = checksum,
                                 .cuts = &all->cuts};
    if (!status) status = mw__tile_index_write(&index, folder_file(f, index_name), error);
    mw__tile_holes_release(&holes);
    free(checksum);
    return status;
}

static mw_status tiles_write(mw_tile_source *s, const char *path, uint32_t tiles, mw_error *error)
{
    tile_folder f = {0};
    mw_tile_triangles all;
    const size_t vertices = mw_mesh_vertex_count(s->mesh);
    mw__job_stage(s->job, "tiles", 1);
    s->files = (uint64_t)tiles + 1;
    s->place = mw__alloc(vertices, sizeof *s->place);
    mw_status status = mw__tile_triangles_create(&all, s->mesh, tiles, error);
    if (!status && !s->place) status = mw__fail_memory(error);
    if (!status) status = folder_open(&f, path, error);
    if (!status) {
        memset(s->place, 0xff, vertices * sizeof *s->place);
        status = tiles_fill_folder(s, &all, &f, error);
    }
    if (!status) status = folder_name(&f, error);
    folder_release(&f, tiles);
    mw__tile_triangles_release(&all);
    free(s->place);
    return status;
}

/* --- what is asked for ------------------------------------------------------------------------ */

static mw_status tile_names_check(char *const *names, size_t count, mw_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(names[i], MW_TILE_TRIANGLES) == 0 || strcmp(names[i], MW_TILE_VERTICES) == 0)
            return mw__fail(error, MW_ERROR_INPUT, "a field has the name '%s', which tiles need",
                            names[i]);
    return MW_OK;
}

static mw_status tile_values_check(const mw_mesh *mesh, const mw_mesh_file *v, mw_error *error)
{
    if (v->point_count != mw_mesh_vertex_count(mesh) ||
        v->triangle_count != mw_mesh_triangle_count(mesh))
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the values have %zu vertices and %zu triangles, the mesh has others",
                        v->point_count, v->triangle_count);
    mw_status status = tile_names_check(v->field_names, v->field_count, error);
    if (status) return status;
    return tile_names_check(v->triangle_field_names, v->triangle_field_count, error);
}

/* The fields of the mesh as values. */
static bool values_of_mesh(mw_mesh_file *values, const mw_mesh *mesh)
{
    values->point_count = mesh->point_count;
    values->triangle_count = mesh->tri_count;
    values->field_names = mw__calloc(mesh->field_count, sizeof *values->field_names);
    values->fields = mw__calloc(mesh->field_count, sizeof *values->fields);
    if (!values->field_names || !values->fields) return false;
    for (; values->field_count < mesh->field_count; values->field_count++) {
        values->field_names[values->field_count] = mesh->field[values->field_count].name;
        values->fields[values->field_count] = mesh->field[values->field_count].values;
    }
    return true;
}

static mw_status tiles_write_values(const mw_locator *locator, const char *path,
                                    const mw_tile_options *options, mw_job *job, mw_error *error)
{
    mw_mesh_file own = {0};
    mw_tile_source source = {
        .locator = locator, .mesh = locator->mesh, .values = options->values, .job = job};
    const uint32_t tiles = options->tiles ? options->tiles : 1;
    mw_status status = MW_OK;
    if (!source.values) {
        status = values_of_mesh(&own, locator->mesh) ? MW_OK : mw__fail_memory(error);
        source.values = &own;
    }
    if (!status) status = tile_values_check(locator->mesh, source.values, error);
    if (!status) status = tiles_write(&source, path, tiles, error);
    free(own.field_names);
    free(own.fields);
    return status;
}

mw_status mw_write_tiles(const mw_locator *locator, const char *folder,
                         const mw_tile_options *options, mw_error *error)
{
    static const mw_tile_options defaults;
    if (!locator || !folder)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_write_tiles: the locator or the folder is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_tile_options, options, error);
    if (!status) status = mw__prepared_check_locator(locator, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    return mw__job_end(&job, tiles_write_values(locator, folder, options, &job, error), error);
}
