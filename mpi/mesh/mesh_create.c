/* mesh_create.c - a mesh in pieces, from the arrays of each rank. */
#include "mpi/mesh/mesh.h"

#include "mpi/mesh/directory.h"
#include "mpi/mesh/flats.h"
#include "mpi/mesh/stars.h"

#include <stdlib.h>

static void part_release(mwp_part *part)
{
    mw_locator_destroy(part->locator);
    mw_mesh_destroy(part->mesh);
    mwp__own_release(&part->own);
    free(part->joined);
    *part = (mwp_part){0};
}

static bool part_has_area(const mwp_part *part)
{
    for (uint32_t t = 0; t < part->own.triangle_count; t++)
        if (!mwp__own_is_flat(&part->own, t)) return true;
    return false;
}

/* The mesh and the locator of this rank's piece alone. */
static mw_status part_prepare(mwp_part *part, int rank, mwp_error *error)
{
    mw_error from;
    const mwp_names names = mwp__names_of_own(&part->own, rank);
    const mw_mesh_options mesh = {.threads = part->threads};
    const mw_locator_options locator = {.threads = part->threads};
    if (mw_mesh_create(&names.arrays, &mesh, &part->mesh, &from))
        return mwp__fail_arrays(error, &names, &from);
    if (part_has_area(part) && mw_locator_create(part->mesh, &locator, &part->locator, &from))
        return mwp__fail_arrays(error, &names, &from);
    return MW_OK;
}

/* Find out by the other ranks where the piece goes on. */
static mw_status part_join(mwp_part *part, mwp_mesh *m, mwp_error *error)
{
    mwp_directory directory;
    part->joined = mwp__alloc(part->own.triangle_count, sizeof *part->joined);
    mw_status status = mwp__directory_create(&directory, &m->wire, &part->own, error);
    m->vertices = directory.vertices;
    m->triangles = directory.triangles;
    if (!status) {
        status = part->joined ? MW_OK : mwp__fail_memory(error);
        status = mwp__wire_agree(&m->wire, status, error);
    }
    if (!status)
        status = mwp__stars_join(&part->own, &m->wire, directory.shared, part->joined, error);
    mwp__directory_release(&directory);
    return status;
}

/* All but the copy of the arrays, of which `status` tells. */
static mw_status mesh_prepare(mwp_mesh *m, mw_status status, mwp_error *error)
{
    mwp_part *part = &m->part;
    if (!status) status = mwp__own_check_points(&part->own, error);
    status = mwp__wire_agree(&m->wire, status, error);
    if (!status) status = part_join(part, m, error);
    if (!status) status = mwp__flats_add(&part->own, &m->wire, error);
    if (!status) status = mwp__wire_agree(&m->wire, part_prepare(part, m->wire.rank, error), error);
    if (!status)
        status = mwp__router_create(&m->router, &m->wire, part->locator ? part->mesh : NULL,
                                    part->own.triangle_count, error);
    return status ? status : mwp__rim_create(&m->rim, &m->wire, part, &m->router, error);
}

/* All but the wire, the tables and the fields. */
static void mesh_release(mwp_mesh *m)
{
    mwp__rim_release(&m->rim);
    mwp__router_release(&m->router);
    part_release(&m->part);
}

static mw_status options_check(const mwp_mesh_options *options, mwp_error *error)
{
    for (size_t i = 0; options && i < sizeof options->reserved / sizeof *options->reserved; i++)
        if (options->reserved[i])
            return mwp__fail(error, MW_ERROR_ARGUMENT,
                             "a reserved member of mwp_mesh_options is not zero");
    return MW_OK;
}

mw_status mwp_mesh_create(MPI_Comm comm, const mwp_piece *piece, const mwp_mesh_options *options,
                          mwp_mesh **out, mwp_error *error)
{
    mwp_error own_error;
    mwp_wire wire;
    if (!error) error = &own_error;
    mw_status status = mwp__wire_open(&wire, comm, error);
    mwp_mesh *m = calloc(1, sizeof *m);
    if (!status) {
        mw_status mine = m ? MW_OK : mwp__fail_memory(error);
        if (!mine && !out)
            mine = mwp__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mesh is NULL");
        if (!mine) mine = options_check(options, error);
        status = mwp__wire_agree(&wire, mine, error);
    }
    if (out) *out = NULL;
    if (status) {
        mwp__wire_close(&wire);
        free(m);
        return status;
    }
    m->wire = wire;
    m->part.threads = options && options->threads ? options->threads : 1;
    status = mwp__own_create(&m->part.own, piece, error);
    if (!status && !mwp__tables_create(&m->tables, &wire)) status = mwp__fail_memory(error);
    status = mesh_prepare(m, status, error);
    if (status)
        mwp_mesh_destroy(m);
    else
        *out = m;
    return status;
}

mw_status mwp_update(mwp_mesh *mesh, const double *points, size_t stride, mwp_error *error)
{
    mwp_error own_error;
    if (!error) error = &own_error;
    mwp_mesh moved = {.wire = mesh->wire, .part.threads = mesh->part.threads};
    mw_status status = mwp__own_move(&moved.part.own, &mesh->part.own, points, stride, error);
    status = mesh_prepare(&moved, status, error);
    if (status) {
        mesh_release(&moved);
        return status;
    }
    moved.tables = mesh->tables;
    moved.fields = mesh->fields;
    mesh_release(mesh);
    *mesh = moved;
    return MW_OK;
}

void mwp_mesh_piece(const mwp_mesh *mesh, mwp_piece *piece)
{
    const mwp_own *own = &mesh->part.own;
    *piece = (mwp_piece){.arrays = {.points = own->points,
                                    .point_count = own->vertex_count,
                                    .triangles = own->corner,
                                    .triangle_count = own->triangle_count},
                         .vertex_numbers = own->vertex,
                         .triangle_numbers = own->triangle};
}

void mwp_mesh_destroy(mwp_mesh *mesh)
{
    if (!mesh) return;
    mesh_release(mesh);
    mwp__tables_release(&mesh->tables);
    mwp__fields_release(&mesh->fields);
    mwp__wire_close(&mesh->wire);
    free(mesh);
}

void mwp_mesh_describe(const mwp_mesh *mesh, mwp_mesh_info *info)
{
    mw_locator_info locator = {0};
    const mwp_own *own = &mesh->part.own;
    if (mesh->part.locator) mw_locator_describe(mesh->part.locator, &locator);
    *info = (mwp_mesh_info){
        .vertices = mesh->vertices,
        .triangles = mesh->triangles,
        .piece_vertices = own->vertex_count,
        .piece_triangles = own->triangle_count,
        .holes = mesh->rim.holes,
        .rim_triangles = mesh->rim.all.triangle_count,
        .boxes = mesh->router.count,
        .bytes = sizeof *mesh + mwp__own_bytes(own) + mw_mesh_bytes(mesh->part.mesh) +
                 locator.bytes + mwp__router_bytes(&mesh->router) + mwp__rim_bytes(&mesh->rim),
    };
}
