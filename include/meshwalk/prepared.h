/**
 * @file prepared.h
 * A mesh and its locator in a file that is mapped into memory. It is ready for queries at once, and
 * all processes of a machine share one copy.
 *
 * mw_write_prepared() writes the file (.mwm), mw_mesh_map() maps it. Answers are those of the
 * locator that was written, bit for bit. docs/prepared.md describes the format.
 *
 * A map reads parts of the file when a query needs them, so a mapped file must not be changed in
 * place. To replace it, call mw_write_prepared() again with its name: the new file takes the name
 * in one step, and old maps keep the old file.
 */
#ifndef MESHWALK_PREPARED_H
#define MESHWALK_PREPARED_H

#include <meshwalk/io.h>
#include <meshwalk/locate.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The version of the format that mw_write_prepared() writes. mw_mesh_map() reads all versions from
 * 1 to this one. */
#define MW_PREPARED_VERSION 1

/** Options of a prepared file. Zero-initialised options select the defaults. */
typedef struct mw_prepare_options {
    /** Values to keep beside the mesh, for instance those of the file that it was read from:
     * heights (as the field "z"), fields, triangle fields, faces, marked edges, coordinate system.
     * Its vertices and triangles are those of the mesh; their coordinates and numbers are not read.
     * NULL: the fields of the mesh. */
    const mw_mesh_file *values;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_prepare_options;

/**
 * Write a mesh and its locator as a prepared file.
 *
 * The index of the border is written if the locator has one (mw_locator_options.border); stored
 * areas and the indices of starts are not.
 *
 * @param locator  a locator of an embedding, whose pockets and holes are filled, not edited
 * @param path     the file; "-": standard output
 * @param options  NULL selects the defaults
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, another kind of locator, or values of another mesh;
 *         MW_ERROR_SYSTEM if the file cannot be written; MW_ERROR_MEMORY; MW_CANCELLED. On failure
 *         no file is left.
 *
 * Thread-safe. O(n).
 */
MW_API mw_status mw_write_prepared(const mw_locator *locator, const char *path,
                                   const mw_prepare_options *options, mw_error *error);

/** Options of a mesh in tiles. Zero-initialised options select the defaults. */
typedef struct mw_tile_options {
    uint32_t tiles;   /**< how many; 0: one. At most as many as triangles with an area */
    uint32_t threads; /**< number of threads; 0: one per processor */
    /** Values to keep beside the mesh, as mw_prepare_options.values; faces and marked edges are not
     * kept. NULL: the fields of the mesh. */
    const mw_mesh_file *values;
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    uint32_t reserved[4];        /**< must be zero */
} mw_tile_options;

/**
 * Write a mesh as a folder of prepared files: tiles that are mapped one by one, for machines with
 * less memory than the mesh takes. meshwalk.Tiles of the Python module reads the folder.
 *
 * Each triangle with an area is in one tile; all tiles have about equally many. Flat triangles are
 * in every tile that touches them. Another file, the overview, has the triangles with a vertex on
 * the border; it answers for points in no tile. tiles.json is the index. docs/prepared.md describes
 * the files. They are the same on all machines and for any number of threads.
 *
 * @param locator  a locator of an embedding, whose pockets and holes are filled, not edited
 * @param folder   the folder to be made; it gets its name when it is complete
 * @param options  NULL selects the defaults
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, another kind of locator, or values of another mesh;
 *         MW_ERROR_INPUT if there are fewer triangles with an area than tiles, or if a field is
 *         called "meshwalk:triangle" or "meshwalk:vertex"; MW_ERROR_SYSTEM if the folder is there
 *         already or cannot be written; MW_ERROR_MEMORY; MW_CANCELLED. On failure no folder is
 *         left.
 *
 * Thread-safe. O(n log tiles) for n triangles, and 80 bytes a triangle.
 */
MW_API mw_status mw_write_tiles(const mw_locator *locator, const char *folder,
                                const mw_tile_options *options, mw_error *error);

/** A mesh and its locator in a mapped file. Opaque. */
typedef struct mw_prepared mw_prepared;

/** Options of a map. Zero-initialised options select the defaults. */
typedef struct mw_map_options {
    /** 1: check the header only, so that nothing else is read before a query needs it. Use this for
     * files of your own: queries in a damaged file may crash. 0: check all checksums, and that the
     * contents are a mesh in which every query ends. */
    int trust;
    uint32_t threads;            /**< number of threads of the check; 0: one per processor */
    const mw_progress *progress; /**< progress and cancelling, see base.h; NULL: none */
    /** 1: queries never allocate memory: as mw_locator_options.no_late_chains. Late chains are not
     * in the file, but on the heap of each process. */
    uint32_t no_late_chains;
    uint32_t reserved[3]; /**< must be zero */
} mw_map_options;

/**
 * Map a prepared file.
 *
 * @param path     the file, not packed; not "-"
 * @param options  NULL selects the defaults
 * @param out      receives the map, owned by the caller (mw_prepared_close()); NULL on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_SYSTEM if the file cannot be opened or mapped; MW_ERROR_INPUT if it is no
 *         prepared file, of another version or byte order, incomplete or damaged;
 *         MW_ERROR_ARGUMENT for NULL; MW_ERROR_MEMORY, MW_CANCELLED.
 *
 * Thread-safe. O(n) for n triangles; with `trust` O(1), and memory for the names of fields only.
 */
MW_API mw_status mw_mesh_map(const char *path, const mw_map_options *options, mw_prepared **out,
                             mw_error *error);
/** Unmap a file. Its mesh and its locator must not be used afterwards. NULL is allowed. */
MW_API void mw_prepared_close(mw_prepared *prepared);

/** The mesh of a map, owned by the map; do not destroy it. Setting its fields with
 * mw_mesh_set_field() does not change the file. Thread-safe. O(1). */
MW_API mw_mesh *mw_prepared_mesh(mw_prepared *prepared);

/** The locator of a map, owned by the map; do not destroy it. Any number of threads may query it.
 * Thread-safe. O(1). */
MW_API const mw_locator *mw_prepared_locator(const mw_prepared *prepared);

/** The values that a map keeps beside the mesh: fields (heights as "z"), triangle fields, faces,
 * marked edges, coordinate system. `points` and `triangles` are NULL, since the mesh has them.
 * Owned by the map; do not change or release them. Thread-safe. O(1). */
MW_API const mw_mesh_file *mw_prepared_values(const mw_prepared *prepared);

/** What a map knows of its file. */
typedef struct mw_prepared_info {
    uint64_t bytes; /**< size of the file */
    /** Checksum of the header. The header has the checksums of all parts, so this number
     * identifies the contents. */
    uint64_t checksum;
    double low[2], high[2]; /**< extent of the vertices of triangles with an area */
    uint32_t version;       /**< of the format */
    int border;             /**< 1: with the index of the border */
    int trusted;            /**< 1: mapped with mw_map_options.trust */
    uint32_t reserved;
} mw_prepared_info;

/** Fill `info` with the sizes and the version of a map. Thread-safe. O(1). */
MW_API void mw_prepared_describe(const mw_prepared *prepared, mw_prepared_info *info);

/**
 * Decide whether a file begins like a prepared file, damaged or not.
 *
 * @param path  the file
 * @return 1; 0 also if the file cannot be opened, and for "-".
 *
 * Thread-safe. O(1).
 */
MW_API int mw_prepared_known(const char *path);

#ifdef __cplusplus
}
#endif
#endif
