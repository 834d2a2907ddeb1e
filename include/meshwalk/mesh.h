/**
 * @file mesh.h
 * A planar triangle mesh, from the caller's arrays.
 *
 * A mesh keeps the caller's numbers: vertex i is the i-th point given, triangle t the t-th
 * triangle. In triangle t local vertices 0, 1, 2 are as given, and local edge k joins local vertex
 * k to local vertex (k + 1) mod 3.
 *
 * Threads: any number of threads may read one mesh.
 */
#ifndef MESHWALK_MESH_H
#define MESHWALK_MESH_H

#include <meshwalk/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A planar triangle mesh. Opaque. */
typedef struct mw_mesh mw_mesh;

/** The type of vertex numbers in an array. */
typedef enum mw_integer_type { MW_UINT32 = 0, MW_INT32, MW_INT64 } mw_integer_type;

/** The caller's arrays. A call reads them and keeps no reference to them, unless it says so. */
typedef struct mw_arrays {
    /** x, y of vertex i at points[i * point_stride] and the double after it. */
    const double *points;
    size_t point_count;  /**< number of vertices */
    size_t point_stride; /**< in doubles; 0 means 2 (packed x, y); 3 skips the z of x, y, z */
    /** 3 vertex numbers per triangle, from 0, packed, of type integer_type. */
    const void *triangles;
    size_t triangle_count;        /**< number of triangles */
    mw_integer_type integer_type; /**< 0: MW_UINT32 */
} mw_arrays;

/**
 * The kinds of defects of a mesh.
 *
 * Kinds up to MW_DEFECT_NON_MANIFOLD_EDGE make arrays unusable: mw_mesh_create() refuses them. A
 * mesh with defects of the kinds up to MW_DEFECT_OVERLAP is not an embedding; the promises of point
 * location hold for embeddings only. MW_DEFECT_FLAT is a remark: triangles without area are
 * accepted and contain no point.
 */
typedef enum mw_defect_kind {
    MW_DEFECT_MISSING_VERTEX = 0, /**< `triangle` names a vertex that does not exist */
    MW_DEFECT_NOT_FINITE,         /**< `vertex` of `triangle` has a NaN or infinite coordinate */
    MW_DEFECT_REPEATED_VERTEX,    /**< `triangle` has `vertex` twice */
    /** `edge` of `triangle` belongs to three or more triangles; `other` is one of them. */
    MW_DEFECT_NON_MANIFOLD_EDGE,
    MW_DEFECT_FOLDED, /**< `triangle` and `other` lie on the same side of their common `edge` */
    /** The triangles round inner `vertex` turn by more than 2 pi; `triangle` is one of them. */
    MW_DEFECT_WINDING,
    MW_DEFECT_CROSSING, /**< border `edge` of `triangle` crosses border `other_edge` of `other` */
    /** `vertex` lies inside border `edge` of `triangle`, without a flat triangle there. */
    MW_DEFECT_VERTEX_IN_EDGE,
    /** The mesh covers the inside of `triangle`, next to its border `edge`, more than once.
     * `other`, if any, is a triangle on the same side of border `other_edge` along it. */
    MW_DEFECT_OVERLAP,
    MW_DEFECT_FLAT, /**< `triangle` has no area */
    /* Only for surfaces (surface.h) and star-shaped polyhedra (star.h): */
    MW_DEFECT_CLASHING, /**< `triangle` and `other` have opposite orientation along `edge` */
    /** `edge` of `triangle` has no other triangle: the polyhedron is open. */
    MW_DEFECT_OPEN_EDGE,
    MW_DEFECT_THROUGH_CENTRE, /**< the plane of `triangle` passes through the centre */
    /** `triangle` turns its back to the centre, seen from its neighbour `other` at `edge`, if any.
     */
    MW_DEFECT_BACK_FACING,
    MW_DEFECT_COVERED, /**< a ray from the centre meets both `triangle` and `other` */
    MW_DEFECT_COUNT
} mw_defect_kind;

/** One defect and where it is. Members that do not apply are MW_NONE; edges 255. */
typedef struct mw_defect {
    mw_defect_kind kind;
    uint32_t triangle, other;
    uint32_t vertex;
    uint8_t edge, other_edge;
} mw_defect;

/** All defects found, ordered by kind, then by triangle. Release with mw_check_release(). */
typedef struct mw_check {
    mw_defect *defects;
    size_t defect_count;
    int valid; /**< 1: no defect except flat triangles, so the mesh is an embedding */
} mw_check;

/** A short English text for a kind of defect; never NULL, owned by the library. Thread-safe. */
MW_API const char *mw_defect_text(mw_defect_kind kind);

/**
 * Describe one defect in words: "triangle 17: ...".
 *
 * @param defect  the defect
 * @param text    receives the description, always terminated
 * @param size    room in `text`, in bytes; a longer description is cut off
 *
 * Thread-safe. O(1).
 */
MW_API void mw_defect_describe(const mw_defect *defect, char *text, size_t size);

/** Options of a check. Zero-initialised options select the defaults. */
typedef struct mw_check_options {
    /** Number of threads; 0: one per processor; results do not depend on it. */
    uint32_t threads;
    uint32_t reserved[3];        /**< must be zero */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
} mw_check_options;

/**
 * Find every defect of a planar mesh, and decide whether it is an embedding.
 *
 * If two border edges cross, or run along each other on the same side, at least one of them is
 * listed, with one edge that it crosses. So the length of the list is linear in the mesh. If
 * thousands of long edges cross, some are not listed. Where borders cross, some defects can be
 * found only after the crossing is mended. Equal arrays give equal lists.
 *
 * @param arrays   the mesh
 * @param options  NULL selects the defaults
 * @param check    receives the defects; release with mw_check_release()
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK, also if defects were found; MW_ERROR_ARGUMENT for NULL, a stride of 1 or an
 *         unknown integer type; MW_ERROR_LIMIT for more than MW_MAX_TRIANGLES or MW_MAX_VERTICES;
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(n) for local defects; O(b log^2 b) expected for b border edges, whether they
 * cross or not (docs/proofs/tilings.md).
 */
MW_API mw_status mw_check_arrays(const mw_arrays *arrays, const mw_check_options *options,
                                 mw_check *check, mw_error *error);
/** Release the defects of a check. A zero-initialised check is allowed. */
MW_API void mw_check_release(mw_check *check);

/**
 * How a mesh is laid out in memory.
 *
 * Numbers do not depend on it. For a mesh that is not an embedding other defects may be named, and
 * sums of areas may differ in their last bits. Tolerant meshes are laid out as given.
 */
typedef enum mw_mesh_layout {
    MW_LAYOUT_AUTO = 0, /**< decide by the order of the arrays */
    MW_LAYOUT_HILBERT,  /**< along a Hilbert curve */
    MW_LAYOUT_AS_GIVEN  /**< in the order of the arrays */
} mw_mesh_layout;

/** Options of a mesh. Zero-initialised options select the defaults. */
typedef struct mw_mesh_options {
    /** 1: accept triangles with repeated or non-finite vertices and edges of three triangles. Such
     * a triangle is kept but contains no point; the third triangle of an edge is not linked. */
    int tolerant;
    mw_mesh_layout layout;
    /** Number of threads; 0: one per processor; the mesh does not depend on it. */
    uint32_t threads;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[3];        /**< must be zero */
} mw_mesh_options;

/**
 * Create a mesh from arrays: copy the coordinates and find the neighbours.
 *
 * Triangles of mixed orientation are accepted. If neighbours lie far apart in the arrays, the mesh
 * is laid out along a Hilbert curve in memory, for 4 bytes more per triangle and 8 more per vertex.
 *
 * @param arrays   the arrays
 * @param options  NULL selects the defaults
 * @param out      receives the mesh, owned by the caller (mw_mesh_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT if the arrays are unusable (the error names the first defect);
 *         MW_ERROR_ARGUMENT for NULL, a stride of 1, an unknown integer type or layout;
 *         MW_ERROR_LIMIT for more than MW_MAX_TRIANGLES or MW_MAX_VERTICES; MW_ERROR_MEMORY,
 *         MW_CANCELLED.
 *
 * Thread-safe. O(n) for n triangles.
 */
MW_API mw_status mw_mesh_create(const mw_arrays *arrays, const mw_mesh_options *options,
                                mw_mesh **out, mw_error *error);
/** Destroy a mesh. Its locators must be destroyed before. NULL is allowed. */
MW_API void mw_mesh_destroy(mw_mesh *mesh);

/** Number of vertices, unused ones included. Thread-safe. O(1). */
MW_API uint32_t mw_mesh_vertex_count(const mw_mesh *mesh);

/** Number of triangles. Thread-safe. O(1). */
MW_API uint32_t mw_mesh_triangle_count(const mw_mesh *mesh);

/**
 * Copy x, y of a vertex.
 *
 * @param mesh    the mesh
 * @param vertex  less than the number of vertices, not checked
 * @param point   receives x, y
 *
 * Thread-safe. O(1).
 */
MW_API void mw_mesh_vertex(const mw_mesh *mesh, uint32_t vertex, double point[2]);

/**
 * Copy the vertices of a triangle, in the order given.
 *
 * @param mesh      the mesh
 * @param triangle  less than the number of triangles, not checked
 * @param vertices  receives three vertices
 *
 * Thread-safe. O(1).
 */
MW_API void mw_mesh_triangle(const mw_mesh *mesh, uint32_t triangle, uint32_t vertices[3]);

/**
 * Copy triangles in the order in which the mesh stores them. Neighbours mostly lie near each other
 * in this order, so a pass over all triangles takes a fraction of the time of a pass by number. The
 * place of a triangle or vertex is its position in this order, from 0.
 *
 * @param mesh     the mesh
 * @param first    the place of the first triangle
 * @param count    how many; first + count is at most the number of triangles, not checked
 * @param corners  receives 3 * count places of vertices: those of each triangle, as given
 * @param numbers  NULL, or receives the number of each triangle
 *
 * Thread-safe. O(count).
 */
MW_API void mw_mesh_stored_triangles(const mw_mesh *mesh, uint32_t first, uint32_t count,
                                     uint32_t *corners, uint32_t *numbers);

/**
 * Copy vertices in the order in which the mesh stores them: see mw_mesh_stored_triangles().
 *
 * @param mesh     the mesh
 * @param first    the place of the first vertex
 * @param count    how many; first + count is at most the number of vertices, not checked
 * @param points   receives x, y of each vertex
 * @param numbers  NULL, or receives the number of each vertex
 *
 * Thread-safe. O(count).
 */
MW_API void mw_mesh_stored_vertices(const mw_mesh *mesh, uint32_t first, uint32_t count,
                                    double *points, uint32_t *numbers);

/**
 * Find the triangle on the other side of a local edge.
 *
 * @param mesh        the mesh
 * @param triangle    less than the number of triangles, not checked
 * @param local_edge  0, 1 or 2, not checked
 * @param edge        NULL, or receives the local edge in the neighbour
 * @return the neighbour; MW_NONE on a border.
 *
 * Thread-safe. O(1).
 */
MW_API uint32_t mw_mesh_neighbour(const mw_mesh *mesh, uint32_t triangle, unsigned local_edge,
                                  unsigned *edge);

/** Memory used by a mesh with its fields, in bytes. Thread-safe. O(1). */
MW_API size_t mw_mesh_bytes(const mw_mesh *mesh);

/**
 * Set a field: a value per vertex, such as heights.
 *
 * @param mesh    the mesh
 * @param name    the name; a field of that name is replaced
 * @param values  one double per vertex; copied
 * @param stride  doubles from one value to the next; 0 means 1
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK, MW_ERROR_ARGUMENT, MW_ERROR_MEMORY.
 *
 * Not thread-safe: no other thread may use the mesh. O(n).
 */
MW_API mw_status mw_mesh_set_field(mw_mesh *mesh, const char *name, const double *values,
                                   size_t stride, mw_error *error);

/**
 * Find the values of a field.
 *
 * @param mesh  the mesh
 * @param name  the name, not NULL
 * @return one double per vertex, owned by the mesh, valid until the field is set again; NULL if no
 *         field has that name.
 *
 * Thread-safe. O(fields).
 */
MW_API const double *mw_mesh_field(const mw_mesh *mesh, const char *name);

/** Number of fields. Thread-safe. O(1). */
MW_API size_t mw_mesh_field_count(const mw_mesh *mesh);

/** The name of field `index`, from 0, owned by the mesh; NULL beyond the last. Thread-safe. O(1).
 * */
MW_API const char *mw_mesh_field_name(const mw_mesh *mesh, size_t index);

/** Counts and properties of a mesh. Holes, convexity and the embedding are decided exactly. */
typedef struct mw_mesh_info {
    uint32_t vertices, triangles; /**< as given */
    uint32_t unused_vertices;     /**< vertices of no triangle */
    uint32_t flat_triangles;      /**< triangles without area */
    uint32_t clockwise_triangles; /**< the others are counter-clockwise or flat */
    uint32_t clashing_edges;      /**< inner edges whose two triangles have opposite orientation */
    uint32_t border_edges;        /**< edges of one triangle */
    uint32_t border_loops;        /**< closed chains of border edges */
    uint32_t components;          /**< connected components: parts that share no vertex */
    uint32_t holes;               /**< bounded regions that the mesh surrounds; 0 if no embedding */
    int oriented;                 /**< 1: no clashing edges */
    int embedding;                /**< 1: mw_check_arrays() finds no defect */
    int convex;                   /**< 1: an embedding that fills its convex hull */
    int delaunay;                 /**< 1: an embedding whose inner edges are all Delaunay */
    double low[2], high[2];       /**< extent of the used vertices; NaN without triangles */
    double area;                  /**< sum of the triangles' areas, rounded */
} mw_mesh_info;

/**
 * Describe a mesh.
 *
 * @param mesh     the mesh
 * @param options  threads and progress; NULL selects the defaults
 * @param info     receives the description; unspecified on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK, also for a mesh that is not an embedding; MW_ERROR_ARGUMENT, MW_ERROR_LIMIT,
 *         MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. Cost as mw_check_arrays().
 */
MW_API mw_status mw_mesh_describe(const mw_mesh *mesh, const mw_check_options *options,
                                  mw_mesh_info *info, mw_error *error);

/**
 * Order triangles and vertices along a Hilbert curve. Arrays in this order have neighbours near
 * each other in memory.
 *
 * @param mesh       the mesh
 * @param triangles  NULL, or an array with room for all triangles: receives the triangle that
 *                   comes i-th
 * @param vertices   NULL, or an array with room for all vertices: receives the vertex that comes
 *                   i-th; unused vertices come last
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK, MW_ERROR_MEMORY.
 *
 * Thread-safe. O(n).
 */
MW_API mw_status mw_mesh_hilbert_order(const mw_mesh *mesh, uint32_t *triangles, uint32_t *vertices,
                                       mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
