/**
 * @file meshwalk-mpi.h
 * Point location in a mesh that lies in pieces on the ranks of an MPI communicator.
 *
 * Each rank brings a piece: triangles and their vertices, with their numbers in the whole mesh.
 * Any rank may ask queries; the piece that contains a point answers. The answers are those that
 * mw_locator_create() and mw_locate_batch() give for the whole mesh on one machine, bit for bit,
 * for any number of ranks and any way to cut the mesh: a point on a cut belongs to the triangle
 * with the lowest number of all ranks; cuts are no border and make no holes; holes have the same
 * numbers.
 *
 * Collective: functions are collective unless they say otherwise: all ranks of the communicator
 * call them in the same order. A failure on one rank fails the call on all ranks, with the same
 * error; no rank waits for ever.
 *
 * Threads: one thread of a rank at a time may use a mesh. MPI_THREAD_FUNNELED is enough.
 *
 * MPI: version 3.1 or later. While a rank waits for others, it gives its processor to them.
 */
#ifndef MESHWALK_MPI_H
#define MESHWALK_MPI_H

#include <meshwalk/io.h>
#include <meshwalk/locate.h>
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What went wrong, and where: the same on all ranks. Numbers are -1 where they do not apply. */
typedef struct mwp_error {
    mw_status status;
    int rank;         /**< the rank that found it */
    int64_t triangle; /**< the number of a triangle in the whole mesh */
    int64_t vertex;   /**< the number of a vertex in the whole mesh */
    char message[512];
} mwp_error;

/** A piece of a mesh: triangles, and the vertices that they have, as the caller's arrays. */
typedef struct mwp_piece {
    /** Vertices and triangles of the piece. Triangles name vertices by their place in the piece,
     * from 0. Both may be empty. */
    mw_arrays arrays;
    /** The number in the whole mesh of each vertex: at least 0. A vertex that several pieces have
     * has the same number and the same coordinates in all of them. */
    const int64_t *vertex_numbers;
    /** The number in the whole mesh of each triangle: at least 0, in any order. No two pieces have
     * one triangle. */
    const int64_t *triangle_numbers;
} mwp_piece;

/** A mesh in pieces, ready for queries. Opaque. */
typedef struct mwp_mesh mwp_mesh;

/** Options of a mesh in pieces. Zero-initialised options select the defaults. */
typedef struct mwp_mesh_options {
    uint32_t threads;     /**< threads of each rank while it prepares the mesh; 0: one */
    uint32_t reserved[7]; /**< must be zero */
} mwp_mesh_options;

/**
 * Prepare a mesh in pieces for queries.
 *
 * The pieces together must be an embedding, as mw_check_arrays() decides for a mesh on one machine;
 * this is decided exactly, across ranks too.
 *
 * @param comm     the communicator; it is duplicated, so messages never mix with the caller's
 * @param piece    the piece of this rank; copied
 * @param options  NULL selects the defaults
 * @param out      receives the mesh, owned by the caller (mwp_mesh_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure, which names rank, triangle or vertex
 * @return MW_OK; MW_ERROR_INPUT for pieces that have one triangle twice or overlap, for a vertex
 *         with different coordinates on two ranks, for a triangle that names a vertex that its
 *         piece lacks, and for every defect that mw_locator_create() refuses; MW_ERROR_ARGUMENT for
 *         NULL and negative numbers; MW_ERROR_LIMIT, MW_ERROR_MEMORY; MW_ERROR_SYSTEM if MPI fails.
 *
 * For n triangles and v vertices of a piece: O(n log n); messages of 24 bytes a vertex and 8 bytes
 * a triangle; about 100 bytes for each triangle at a vertex that several ranks share. Each rank
 * keeps the rim of the whole mesh: the triangles at its border and its holes, and triangles without
 * area, in 250 to 350 bytes each.
 */
MW_API mw_status mwp_mesh_create(MPI_Comm comm, const mwp_piece *piece,
                                 const mwp_mesh_options *options, mwp_mesh **out, mwp_error *error);

/**
 * Distribute a mesh that rank 0 has. All ranks get equally many triangles, a run along a Hilbert
 * curve, with the heights and fields of their vertices. Numbers are those of the file. During the
 * call rank 0 needs about 200 bytes a triangle.
 *
 * @param comm     the communicator; it is duplicated
 * @param file     on rank 0 the mesh, which is only read; ignored on the other ranks
 * @param options  NULL selects the defaults
 * @param out      receives the mesh, owned by the caller (mwp_mesh_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return as mwp_mesh_create().
 */
MW_API mw_status mwp_mesh_scatter(MPI_Comm comm, const mw_mesh_file *file,
                                  const mwp_mesh_options *options, mwp_mesh **out,
                                  mwp_error *error);

/**
 * Prepare a mesh in pieces from a file, which rank 0 reads: mw_read_mesh(), then
 * mwp_mesh_scatter().
 *
 * @param comm     the communicator; it is duplicated
 * @param path     the file, on rank 0: any that mw_read_mesh() reads
 * @param options  NULL selects the defaults
 * @param out      receives the mesh, owned by the caller (mwp_mesh_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return as mw_read_mesh() and mwp_mesh_create().
 */
MW_API mw_status mwp_mesh_read(MPI_Comm comm, const char *path, const mwp_mesh_options *options,
                               mwp_mesh **out, mwp_error *error);

/**
 * Move the vertices. Triangles and numbers stay; all checks of mwp_mesh_create() are done again.
 *
 * @param mesh    the mesh; if the call fails, it is as before
 * @param points  x, y of vertex i of this rank's piece at points[i * stride] and the double after
 *                it, in the order of the vertices of the piece
 * @param stride  doubles from one vertex to the next; 0 means 2
 * @param error   NULL, or receives the message of a failure
 * @return as mwp_mesh_create(), and at the same cost.
 */
MW_API mw_status mwp_update(mwp_mesh *mesh, const double *points, size_t stride, mwp_error *error);

/** View the piece of this rank: triangles in the order of their numbers, vertices as they were
 * given. The arrays belong to the mesh and are valid until mwp_update() or mwp_mesh_destroy(). Not
 * collective. O(1). */
MW_API void mwp_mesh_piece(const mwp_mesh *mesh, mwp_piece *piece);

/** Number of fields of a mesh from a file; heights are the field "z". Not collective. O(1). */
MW_API size_t mwp_mesh_field_count(const mwp_mesh *mesh);
/** The name of a field by its index, owned by the mesh, at most 127 bytes; NULL beyond the last.
 * Not collective. */
MW_API const char *mwp_mesh_field_name(const mwp_mesh *mesh, size_t index);
/**
 * Find the values of a field at the vertices of this rank's piece, for mwp_interpolate().
 *
 * @param mesh   the mesh
 * @param name   name of the field, not NULL
 * @param table  receives the values, which belong to the mesh
 * @return 1; 0 if no field has that name.
 *
 * Not collective. O(fields).
 */
MW_API int mwp_mesh_field(const mwp_mesh *mesh, const char *name, mw_value_table *table);

/** Destroy a mesh in pieces. NULL is allowed, if it is NULL on all ranks. */
MW_API void mwp_mesh_destroy(mwp_mesh *mesh);

/** The sizes of a mesh in pieces. */
typedef struct mwp_mesh_info {
    int64_t vertices, triangles; /**< of the whole mesh; vertices of several pieces count once */
    uint32_t piece_vertices, piece_triangles; /**< of this rank's piece */
    uint32_t holes;                           /**< of the whole mesh */
    uint32_t rim_triangles;                   /**< of the whole mesh, kept on each rank */
    uint32_t boxes;                           /**< of all ranks, by which queries are routed */
    size_t bytes;                             /**< memory of this rank */
} mwp_mesh_info;

/** Fill `info` with the sizes of a mesh. Not collective. O(1). */
MW_API void mwp_mesh_describe(const mwp_mesh *mesh, mwp_mesh_info *info);

/** Where a point lies in a mesh in pieces. */
typedef struct mwp_location {
    double weight[3]; /**< as mw_location.weight */
    int64_t triangle; /**< its number in the whole mesh, or -1 */
    uint32_t hole;    /**< as mw_location.hole */
    int32_t rank;     /**< the rank that has the triangle, or -1 */
    uint32_t index;   /**< the triangle's place in the piece of that rank, or MW_NONE */
    uint8_t where;    /**< mw_where */
    uint8_t local;    /**< as mw_location.local */
    uint16_t reserved;
} mwp_location;

/** How to locate. Zero-initialised options select the defaults. */
typedef struct mwp_locate_options {
    /** Points outside the mesh, at most this far from it in mesh units, become MW_NEAR. At least
     * 0; the same on all ranks. */
    double tolerance;
    /** The most queries that a rank accepts from other ranks at a time; 0: 2^18. Each takes 64
     * bytes of memory, so this bounds the memory of a call. At least one query of each rank is
     * accepted. */
    uint32_t budget;
    uint32_t threads; /**< threads of each rank; 0: one */
    uint32_t reserved[4];
} mwp_locate_options;

/**
 * Locate points: on each rank any number of them, anywhere, also none.
 *
 * A point strictly inside the piece of its own rank costs no message. Any other point is sent to
 * the ranks in whose boxes it lies, with 16 bytes; a rank that contains it answers with 48 bytes.
 *
 * @param mesh       the mesh
 * @param points     x, y of point i at points[i * stride] and the double after it
 * @param n          number of points of this rank
 * @param stride     doubles from one point to the next; 0 means 2
 * @param options    NULL selects the defaults
 * @param locations  receives n results in the order of the points; unspecified on failure
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a stride of 1, or options out of range;
 *         MW_ERROR_MEMORY; MW_ERROR_SYSTEM if MPI fails.
 */
MW_API mw_status mwp_locate_batch(mwp_mesh *mesh, const double *points, size_t n, size_t stride,
                                  const mwp_locate_options *options, mwp_location *locations,
                                  mwp_error *error);

/** Points that are being located. Opaque. */
typedef struct mwp_locating mwp_locating;

/**
 * Begin to locate points, and return without waiting for other ranks. mwp_locate_test() continues
 * the work, mwp_locate_end() completes it. `points` and `locations` must stay valid until then.
 * Before mwp_locate_end() no other collective call on the mesh may be made, nor a second batch
 * begun.
 *
 * @param mesh       the mesh
 * @param points     x, y of point i at points[i * stride] and the double after it
 * @param n          number of points of this rank
 * @param stride     doubles from one point to the next; 0 means 2
 * @param options    NULL selects the defaults
 * @param locations  receives n results at the end
 * @return the work in progress; never NULL. mwp_locate_end() reports failures and releases it.
 */
MW_API mwp_locating *mwp_locate_begin(mwp_mesh *mesh, const double *points, size_t n, size_t stride,
                                      const mwp_locate_options *options, mwp_location *locations);

/**
 * Continue to locate points as far as possible without waiting for other ranks.
 *
 * @param locating  what mwp_locate_begin() returned
 * @return 1 if mwp_locate_end() will not wait, else 0.
 *
 * Not collective: each rank may call it any number of times.
 */
MW_API int mwp_locate_test(mwp_locating *locating);

/**
 * Wait until all points are located.
 *
 * @param locating  what mwp_locate_begin() returned; released
 * @param error     NULL, or receives the message of a failure
 * @return as mwp_locate_batch().
 */
MW_API mw_status mwp_locate_end(mwp_locating *locating, mwp_error *error);

/**
 * Interpolate values that are stored with the pieces, at locations on any rank.
 *
 * @param mesh       the mesh
 * @param table      values at the vertices of this rank's piece, side by side for each vertex
 *                   (`step` 0 or 1); type and count are the same on all ranks
 * @param locations  n locations, of mwp_locate_batch() or mwp_migrate()
 * @param n          number of locations of this rank
 * @param result     receives values of the table's type, packed: value k of location i at
 *                   result[i * count + k]; NaN for a location without a triangle
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, tables that differ, or locations of another mesh;
 *         MW_ERROR_MEMORY, MW_ERROR_SYSTEM.
 *
 * The results are those of mw_interpolate_table() for the whole mesh, bit for bit. For a location
 * in another rank's triangle 32 bytes are sent to that rank; its values and 8 bytes come back.
 */
MW_API mw_status mwp_interpolate(mwp_mesh *mesh, const mw_value_table *table,
                                 const mwp_location *locations, size_t n, void *result,
                                 mwp_error *error);

/**
 * Copy the weights of locations as compressed sparse rows (CSR), as mw_operator_copy() does for the
 * whole mesh. Each rank gets the rows of its locations.
 *
 * @param mesh       the mesh
 * @param locations  n locations, of mwp_locate_batch() or mwp_migrate()
 * @param n          number of locations of this rank
 * @param first      receives n + 1 numbers: the entries of row i are first[i] to first[i + 1] - 1
 * @param column     receives the number of a vertex in the whole mesh for each entry; room for 3 n
 * @param weight     receives the weight of each entry, never 0; room for 3 n
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL or locations of another mesh; MW_ERROR_MEMORY,
 *         MW_ERROR_SYSTEM.
 */
MW_API mw_status mwp_operator(mwp_mesh *mesh, const mwp_location *locations, size_t n,
                              uint64_t *first, int64_t *column, double *weight, mwp_error *error);

/** Particles that have arrived. Release with mwp_particles_release(). */
typedef struct mwp_particles {
    mwp_location *locations; /**< one for each particle */
    void *payload;           /**< the payload of each particle, packed */
    size_t count;
} mwp_particles;

/**
 * Move particles, with their payloads, to the ranks that have their triangles. Particles without a
 * triangle stay. No particle is lost or duplicated.
 *
 * @param mesh       the mesh
 * @param locations  n locations, of mwp_locate_batch() or mwp_migrate()
 * @param payload    `bytes` for each particle, packed; NULL if `bytes` is 0
 * @param bytes      size of a particle's payload, at most 2^20, the same on all ranks. Coordinates
 *                   do not move by themselves: put them into the payload
 * @param n          number of particles of this rank
 * @param out        receives the particles that are on this rank now, in the order of their former
 *                   ranks, then of their places there; empty on failure
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, payloads of different size, or ranks that do not
 *         exist; MW_ERROR_MEMORY, MW_ERROR_SYSTEM.
 *
 * A particle that moves costs 64 bytes and its payload. Messages go in rounds, in which a rank
 * accepts at most 65,536 particles.
 */
MW_API mw_status mwp_migrate(mwp_mesh *mesh, const mwp_location *locations, const void *payload,
                             size_t bytes, size_t n, mwp_particles *out, mwp_error *error);

/** Release particles. Not collective. A zero-initialised structure is allowed. */
MW_API void mwp_particles_release(mwp_particles *particles);

/** The border edge nearest to a point outside. */
typedef struct mwp_nearest_border_point {
    int64_t triangle; /**< its number in the whole mesh */
    int32_t rank;     /**< the rank that has it */
    uint32_t index;   /**< its place in the piece of that rank */
    uint32_t edge;    /**< local edge */
    uint32_t reserved;
    double distance; /**< as mw_nearest_border_point.distance */
    double point[2]; /**< the nearest point of the edge, rounded */
    double weight[3];
} mwp_nearest_border_point;

/**
 * Find the border edge of the whole mesh that is nearest to a point in no triangle. The answer is
 * that of mw_nearest_border() for the whole mesh, bit for bit.
 *
 * @param mesh     the mesh
 * @param x, y     a point outside, or in a hole
 * @param nearest  receives the answer
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT if the point is not finite or lies in the mesh.
 *
 * Not collective: each rank has the rim of the whole mesh.
 */
MW_API mw_status mwp_nearest_border(const mwp_mesh *mesh, double x, double y,
                                    mwp_nearest_border_point *nearest, mwp_error *error);

#ifdef __cplusplus
}
#endif
#endif
