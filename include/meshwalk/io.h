/**
 * @file io.h
 * Reading and writing meshes, points, constraints and edits.
 *
 * Formats are recognised by content where possible, else by name. Every reader accepts gzip.
 * Readers trust no count in a header and use memory in proportion to what a file really holds.
 * Errors read "FILE:LINE: what is wrong" and set mw_error.line; for binary files "FILE: at byte N:
 * ...". Numbers are read and written the same way in every locale, and round-trip. A written file
 * appears under its final name only when it is complete. "-" is standard input or output.
 *
 * Thread-safe on different objects.
 */
#ifndef MESHWALK_IO_H
#define MESHWALK_IO_H

#include <meshwalk/edit.h>
#include <meshwalk/mesh.h>
#include <meshwalk/surface_edit.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A side of a triangle that a file marks. */
typedef struct mw_marked_edge {
    uint32_t vertex[2];
    uint32_t mark; /**< number of its name in mw_mesh_file.mark_names */
} mw_marked_edge;

/**
 * The version of libnetcdf, which reads and writes netCDF files. It is loaded at the first use.
 *
 * libnetcdf serves one thread at a time: calls of this library that read or write netCDF wait for
 * one another, whatever the files. A program that calls libnetcdf itself must not do so while
 * another thread is in such a call.
 *
 * HDF5, the library below netCDF-4, can crash on a damaged file. So a netCDF-4 file is first opened
 * in a child made by fork(), and refused if the child crashes or does not end. The process receives
 * SIGCHLD, possibly several.
 *
 * @param text  receives the version, ended by NUL; empty if libnetcdf is not found; NULL is allowed
 * @param size  bytes of `text`
 * @return the length of the whole version; 0 if libnetcdf is not found: then netCDF files are
 *         refused
 *
 * Thread-safe.
 */
MW_API size_t mw_netcdf_version(char *text, size_t size);

/** A mesh as read. The structure owns its arrays; release with mw_mesh_file_release().
 *
 * Faces with more than three corners are cut into triangles. A quadrilateral is cut along its
 * shorter diagonal; if both are equal, along the one with the lowest vertex number. A convex face
 * with more corners becomes a fan from its lowest-numbered vertex, or from another one if corners
 * on a straight line would make triangles flat. A face that is not convex is an error. Convexity is
 * decided in the plane x, y. A face that is not convex there, such as a wall, is projected to the
 * coordinate plane where its area is largest. Exception: a quadrilateral whose corners have
 * different z need not be convex. It is cut where it folds less. */
typedef struct mw_mesh_file {
    double *points;      /**< 3 per vertex: x, y, z; z is 0 if the file has none */
    uint32_t *triangles; /**< 3 vertices per triangle */
    size_t point_count, triangle_count;
    int has_z;
    char **field_names; /**< other values per vertex: attributes of .node, properties of PLY */
    double **fields;    /**< field_count arrays of point_count values */
    size_t field_count;
    size_t welded; /**< STL: how many vertices were merged because their coordinates are equal */
    /** The coordinate system of x and y, as WKT or "EPSG:n"; NULL: unknown. PLY has it in a line
     * "comment crs ...", netCDF in a grid mapping, other files in a .prj file beside them. */
    char *crs;
    /** Per triangle the face of the file that it is a part of, from 0 in the order of the file;
     * NULL: each face is a triangle, and triangle i is face i. */
    uint32_t *faces;
    size_t face_count;
    int first_number; /**< what the file counts its vertices and faces from: 0 or 1 */
    /** Not 0: the file holds this many times, and the fields are the values at the first. */
    size_t step_count;
    /** values per triangle, copied from its face: "physical" of Gmsh */
    char **triangle_field_names;
    double **triangle_fields; /**< triangle_field_count arrays of triangle_count values */
    size_t triangle_field_count;
    /** Edges that the file marks as parts of a boundary, in its order, and the names of the marks:
     * "open 1", "land 1 type 20" in fort.14 and .gr3, names of markers and physical groups. */
    mw_marked_edge *edges;
    size_t edge_count;
    char **mark_names;
    size_t mark_count;
    /** The first face that has a vertex twice, as a sentence with file and line, byte or variable:
     * "run.nc: variable nv: face 7 has vertex 3 twice"; NULL: there is none. Such faces are read,
     * so that they can be listed and mended, but are no part of an embedding. */
    char *repeat;
    size_t repeat_triangle; /**< the triangle of that face */
} mw_mesh_file;

/** Options of reading or writing a whole file. Zero-initialised options select the defaults. */
typedef struct mw_file_options {
    /** Progress and cancelling, see base.h; NULL: none. The fraction of a pipe is a guess. */
    const mw_progress *progress;
    /** Reading netCDF: the layout that the file has, such as "fvcom", with ":0" or ":1" behind it
     * for the number of the first vertex; NULL: recognised. */
    const char *layout;
    uint32_t reserved[6]; /**< must be zero */
} mw_file_options;

/**
 * Read a mesh.
 *
 * Coordinates may be NaN or infinite; vertex numbers all exist. Formats:
 * - OFF: with normals, colours or texture coordinates, which are ignored
 * - OBJ: v and f; everything else is ignored
 * - PLY: text, little- and big-endian; other numbers of the vertices become fields; also triangle
 *   strips
 * - STL: text and binary; corners with equal coordinates become one vertex (-0.0 equals 0.0)
 * - netCDF, classic and netCDF-4, by libnetcdf (mw_netcdf_version()): UGRID 1.0; FVCOM, SCHISM,
 *   ADCIRC, ANUGA, FESOM2, TUFLOW-FV; ICON: the cells; MPAS: the triangles between the centres of
 *   the cells, so that values of cells are those of vertices. Variables of numbers over the
 *   vertices become fields: unpacked, NaN where missing. Longitudes and latitudes are degrees. The
 *   coordinate system is that of the CF grid mapping, or EPSG:4326 of longitudes and latitudes
 * - .node and .ele of Triangle: `path` names either, or both without ending; numbered from 0 or 1.
 *   Attributes become fields "attribute1", ..., unless a comment "# attributes: NAME, NAME" at the
 *   top names them; one named z is the height
 * - fort.14 of ADCIRC (.14, .grd) and .gr3, .ll of SCHISM: the depth, positive downwards, becomes
 *   the field "depth"; open and land boundaries, and both sides of barriers, mark edges; .ll is in
 *   longitudes and latitudes
 * - 2DM of SMS: triangles and quadrilaterals, counted in the order of their numbers; the material
 *   becomes the triangle field "material"
 * - Selafin of TELEMAC (.slf): either byte order, single and double precision; the variables at the
 *   first time become fields
 * - MSH of Gmsh: 2.2 and 4.1 as text and binary, 4.0 as text; physical groups of faces become the
 *   triangle field "physical", those of lines mark edges; $NodeData and $ElementData of the first
 *   time become fields and triangle fields
 * - VTK: legacy unstructured grids and polydata, text and binary; VTU: text, base64 and raw, with
 *   zlib or without. Values of points become fields, those of cells triangle fields
 * - SU2 in the plane; markers mark edges
 * - NPZ of NumPy: arrays "points" and "triangles"; others of the length of one of these are values
 * - MWM, prepared meshes (prepared.h): checked as by mw_mesh_map(), also packed or from a pipe
 *
 * Cells that are volumes, lines or vertices are skipped; cells of higher order are refused.
 *
 * @param path     the file; "-": standard input
 * @param options  NULL selects the defaults
 * @param file     receives the mesh; empty on failure; release with mw_mesh_file_release()
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_SYSTEM if the file cannot be opened or read; MW_ERROR_INPUT if it is
 *         malformed, truncated or of an unknown format; MW_ERROR_LIMIT, MW_ERROR_MEMORY,
 *         MW_CANCELLED.
 *
 * Thread-safe. O(size of the file), unpacked.
 */
MW_API mw_status mw_read_mesh(const char *path, const mw_file_options *options, mw_mesh_file *file,
                              mw_error *error);

/** Release a mesh that was read. NULL and an empty file are allowed. */
MW_API void mw_mesh_file_release(mw_mesh_file *file);

/**
 * View the mesh of a file as arrays, for mw_mesh_create() and mw_check_arrays().
 *
 * @param file  the mesh as read
 * @return the arrays, owned by the file. Points have a stride of 3.
 *
 * Thread-safe. O(1).
 */
MW_API mw_arrays mw_mesh_file_arrays(const mw_mesh_file *file);

/** A ring that was skipped because it has fewer than three different points. */
typedef struct mw_skipped_ring {
    uint32_t record;  /**< the feature, from 0 */
    uint32_t polygon; /**< the polygon of that feature, from 0 */
    /** The ring of that polygon; 0 is the outer one, whose polygon is skipped whole. */
    uint32_t ring;
} mw_skipped_ring;

/** Constraints as read, for mw_constrained_delaunay(). The structure owns its arrays; release with
 * mw_constraint_file_release(). */
typedef struct mw_constraint_file {
    /** 3 per point: x, y, z; z is NaN if the file has none for it. Points of rings and lines are
     * listed once, in the order of the file; a ring's closing point is not repeated. */
    double *points;
    size_t point_count;
    int has_z;          /**< 1: some point has a z */
    uint32_t *segments; /**< 2 points per segment */
    uint32_t *polygon;  /**< per segment its polygon; MW_NONE for lines */
    uint32_t *record;   /**< per segment its record of the file: a line or a feature */
    size_t segment_count;
    size_t polygon_count;
    double *hole_seeds; /**< x, y of a point in each hole */
    size_t hole_seed_count;
    const char *record_name; /**< what `record` counts: "line", from 1, or "feature", from 0 */
    char **field_names;      /**< other values per point: attributes of .poly */
    double **fields;
    size_t field_count;
    mw_skipped_ring *skipped; /**< what is left out; the caller decides whether that is an error */
    size_t skipped_count;
    /** The coordinate system, as WKT or "EPSG:n"; NULL: unknown. GeoJSON has longitudes and
     * latitudes (EPSG:4326) unless it says otherwise or its numbers cannot be such; .poly has a
     * .prj file beside it. */
    char *crs;
    /** Features of the file, also those without points or segments; 0 if it has lines. */
    size_t record_count;
} mw_constraint_file;

/**
 * Read constraints. Formats, recognised by content:
 * - .poly of Triangle: segments, and points of holes; its points stand inside it or in a .node file
 *   of the same name, numbered from 0 or 1. It has no polygons, so polygon[i] is MW_NONE
 * - GeoJSON: Point, MultiPoint, LineString, MultiLineString, Polygon, MultiPolygon,
 *   GeometryCollection, Feature and FeatureCollection; each polygon of a MultiPolygon counts. Open
 *   rings are closed; null and empty geometries are ignored; rings of fewer than three different
 *   points are skipped and listed. Refused if the library was built without Jansson
 *
 * @param path     the file; "-": standard input
 * @param options  NULL selects the defaults
 * @param file     receives the constraints; empty on failure; release with
 *                 mw_constraint_file_release()
 * @param error    NULL, or receives the message of a failure
 * @return as mw_read_mesh().
 *
 * Thread-safe. O(size of the file), unpacked.
 */
MW_API mw_status mw_read_constraints(const char *path, const mw_file_options *options,
                                     mw_constraint_file *file, mw_error *error);
/** Release constraints that were read. NULL and an empty file are allowed. */
MW_API void mw_constraint_file_release(mw_constraint_file *file);

/**
 * Decide whether mw_read_constraints() recognises the format of a file, correct or not.
 *
 * @param path  the file. From standard input ("-") bytes are read that later calls do not see
 * @return 1; 0 also if the file cannot be opened.
 *
 * Thread-safe. Reads the beginning of the file.
 */
MW_API int mw_constraints_known(const char *path);

/**
 * Write a mesh.
 *
 * Formats:
 * - "off": Geomview; without fields
 * - "ply": binary, little-endian; "ply-ascii": the same as text (.ply means "ply")
 * - "node": Triangle, two files .node and .ele, whichever is named; z becomes the first attribute
 * - "obj", "stl": STL as text with all digits; without fields
 * - "netcdf": UGRID 1.0 in netCDF-4, with fields, heights and the coordinate system; only into a
 *   file
 * - "vtk": legacy VTK as text, an unstructured grid for ParaView; fields as point data, triangle
 *   fields as cell data
 * - "csv": a table for other programs, one row per corner of a triangle, with the columns
 *   triangle,corner,vertex,x,y,z and the fields; not read as a mesh
 * - "vtu": VTK in XML, with appended doubles; fields as point data, triangle fields as cell data
 * - "fort.14", "gr3": ADCIRC, SCHISM. The depth is the field "depth"; without it the negative
 *   height, or 0. Marked edges become boundaries: open ones if the mark begins with "open", else
 *   land boundaries of the type that follows "type" in the mark, or 0. Barriers are left out
 *   because their vertices have further values
 * - "2dm": SMS. The height is z; without z the negative field "depth". The material is the triangle
 *   field "material", else "physical", else 1
 * - "msh": Gmsh 2.2 as text. Physical groups as above where these are whole numbers, else 0;
 *   marked edges are lines in groups; fields are $NodeData
 *
 * Faces that were cut into triangles (`faces`) are written as they were: quadrilaterals in gr3, 2dm
 * and msh, all polygons in vtu.
 *
 * PLY and netCDF keep the coordinate system; other formats do not. netCDF, vtk and vtu keep values
 * per triangle; 2dm and msh keep some of them. fort.14, gr3 and msh keep marked edges. Vertices,
 * triangles, z and fields keep their order and every bit, except the sign of a NaN and the vertices
 * of STL and csv, which have corners only. Names of fields become single words, except in vtu and
 * msh.
 *
 * Both files of "node" are complete before they get their names, first .ele, then .node. A program
 * that is stopped between these two steps leaves a new .ele without a .node, or with an old one.
 *
 * @param path     the file; "-": standard output
 * @param file     the mesh
 * @param format   a format, or NULL: by the ending of `path`
 * @param options  NULL selects the defaults
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for an unknown format or a path that ends in .gz;
 *         MW_ERROR_INPUT if a triangle names a vertex that does not exist; MW_ERROR_SYSTEM if the
 *         file cannot be written; MW_CANCELLED. On failure no file is left. Exception: .ele is left
 *         if only .node cannot get its name.
 *
 * Thread-safe. O(size of the file).
 */
MW_API mw_status mw_write_mesh(const char *path, const mw_mesh_file *file, const char *format,
                               const mw_file_options *options, mw_error *error);
/** The name of format i of mw_write_mesh(), i from 0; NULL beyond the last. Thread-safe. O(1). */
MW_API const char *mw_mesh_format_name(size_t i);
/**
 * Tell which format mw_write_mesh() chooses by the ending of a name.
 *
 * @param path  name of the file, which need not exist
 * @return name of the format, a constant; NULL if no format has this ending.
 *
 * Thread-safe. O(1).
 */
MW_API const char *mw_mesh_format_of_path(const char *path);

/** The name of layout i of meshes in netCDF files, such as "fvcom", i from 0; NULL beyond the last.
 * Thread-safe. O(1). */
MW_API const char *mw_layout_name(size_t i);

/** Options of a point reader. Zero-initialised options read everything. */
typedef struct mw_point_reader_options {
    /** The columns to read: names or numbers from 1, such as "x,y" or "lon,lat,z"; NULL: see
     * mw_point_reader_open(). */
    const char *columns;
    uint8_t classes[256]; /**< LAS: 1: read points of this class; all zero: read all */
    uint32_t table;       /**< 1: keep the text of every row; see mw_point_reader_table() */
    /** 1, without `columns`: cells of further columns may be texts; see mw_point_reader_texts(). */
    uint32_t texts;
    uint32_t reserved[2]; /**< must be zero */
} mw_point_reader_options;

/**
 * Read the coordinate system that a .prj file beside a file names. The readers of meshes, points
 * and constraints do this themselves.
 *
 * The .prj file has the name of the file without .gz, with its ending replaced by .prj.
 *
 * @param path   name of the file, which need not exist; "-" has no .prj file
 * @param crs    receives one line of text, WKT or "EPSG:n", released by the caller with free();
 *               NULL if there is no such file or it names no system
 * @param error  NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL; MW_ERROR_MEMORY.
 *
 * Thread-safe. O(size of the .prj file).
 */
MW_API mw_status mw_read_prj(const char *path, char **crs, mw_error *error);

/** Names that files give to the coordinates of a point, as "lon", "lat" and "z". */
typedef struct mw_axis_names {
    const char *axis[3];
    int lonlat; /**< 1: the first two are longitude and latitude */
    uint32_t reserved;
} mw_axis_names;

/**
 * Tell a set of names by which columns of coordinates are recognised.
 *
 * @param i  number of the set, from 0
 * @return the set, a constant; NULL beyond the last.
 *
 * Thread-safe. O(1).
 */
MW_API const mw_axis_names *mw_axis_names_at(size_t i);

/**
 * Decide whether a column's name means a coordinate. Case, blanks, '_', '-', '.' and a unit in
 * brackets at the end are ignored: "Point X (m)" means "point_x".
 *
 * @param column  name of the column
 * @param name    a name of a set of mw_axis_names_at()
 * @return 1 or 0.
 *
 * Thread-safe. O(1).
 */
MW_API int mw_axis_name_matches(const char *column, const char *name);

/** A stream of points, read block by block in constant memory. Opaque. */
typedef struct mw_point_reader mw_point_reader;

/**
 * Open a stream of points: text, or LAS 1.0 to 1.4. LAZ is refused with a hint.
 *
 * Text. The first row decides what separates columns: semicolons, tabs, commas or blanks, in this
 * order of preference. The first row is a header if none of its cells is a number, or if two of
 * them name coordinates (mw_axis_names_at()). Empty lines and lines that begin with # are skipped
 * (but see mw_point_reader_table()). All rows have the same number of columns. A cell that begins
 * with a double quote ends with one and may hold separators, line ends, and "" for a quote. "inf"
 * is a number. NaN, NA, N/A and NULL in any case, "-" and an empty cell are missing values, read as
 * NaN. Decimal commas are accepted if semicolons or tabs separate columns, unless the file also has
 * decimal points. Triangle's .node is read too, without its numbers and markers.
 *
 * Columns. Selected columns come in the order of the selection. Without a selection: all columns
 * that hold numbers in the first row; if a header names x and y as mw_axis_names_at() does, these
 * and z come first. LAS has x, y, z, intensity, return, returns, classification, scan_angle,
 * user_data, point_source, time, red, green, blue (time and colours are NaN if the point format
 * has none); without a selection x, y, z.
 *
 * @param path     the file; "-": standard input
 * @param options  NULL selects the defaults
 * @param out      receives the reader, owned by the caller (mw_point_reader_close()); NULL on
 *                 failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK, also for a file without rows, a stream of no points; MW_ERROR_SYSTEM;
 *         MW_ERROR_INPUT, also for a column that the file does not have; MW_ERROR_MEMORY;
 *         MW_ERROR_ARGUMENT for a selection of fewer than two columns or of one column twice.
 *
 * Thread-safe. Reads the beginning of the file.
 */
MW_API mw_status mw_point_reader_open(const char *path, const mw_point_reader_options *options,
                                      mw_point_reader **out, mw_error *error);

/**
 * Tell how many values each point has.
 *
 * @param reader  the reader
 * @return the number of columns of the file, or of selected columns: at least 2. 0 for a reader
 *         with `table` and without `columns` before mw_point_reader_select().
 *
 * One thread at a time may use a reader. O(1).
 */
MW_API size_t mw_point_reader_width(const mw_point_reader *reader);

/**
 * Tell the name of a column.
 *
 * @param reader  the reader
 * @param column  number of the value within a point, from 0
 * @return the name from the header, else "x", "y", "z", "c4", ...; owned by the reader. NULL beyond
 *         the last.
 *
 * One thread at a time may use a reader. O(1).
 */
MW_API const char *mw_point_reader_column(const mw_point_reader *reader, size_t column);

/**
 * Read the next points.
 *
 * @param reader    the reader
 * @param values    receives mw_point_reader_width() doubles per point
 * @param capacity  room in `values`, in points
 * @param count     receives the number of points; less than `capacity` only at the end, where it
 *                  becomes 0. A reader with `table` also ends a block early if its text is long
 * @param error     NULL, or receives the message of a failure, with file and line
 * @return MW_OK; MW_ERROR_INPUT, MW_ERROR_SYSTEM, MW_ERROR_MEMORY. On failure *count points before
 *         the faulty one are valid, and the reader can only be closed.
 *
 * One thread at a time may use a reader. O(size of what is read).
 */
MW_API mw_status mw_point_reader_read(mw_point_reader *reader, double *values, size_t capacity,
                                      size_t *count, mw_error *error);

/**
 * Tell the coordinate system of the points: from the records of LAS (WKT, or the EPSG code of its
 * GeoTIFF keys), else from a .prj file beside the points.
 *
 * @param reader  not NULL
 * @return WKT or "EPSG:n", owned by the reader; NULL if the system is not known.
 *
 * One thread at a time may use a reader. O(1).
 */
MW_API const char *mw_point_reader_crs(const mw_point_reader *reader);
/**
 * Tell how much of the file has been read, to show progress.
 *
 * @param reader  the reader
 * @return from 0 to 1; -1 if the size is unknown, as of a pipe.
 *
 * One thread at a time may use a reader. O(1).
 */
MW_API double mw_point_reader_fraction(const mw_point_reader *reader);

/** Close a reader. NULL is allowed. */
MW_API void mw_point_reader_close(mw_point_reader *reader);

/** All columns of a file, also those that are not read as numbers. Texts belong to the reader. */
typedef struct mw_point_table {
    /** Names of the columns, "" for a column without a name; NULL: the file has no header. */
    const char *const *names;
    const char *header; /**< the header as it stands in the file; NULL: there is none */
    size_t column_count;
    /** Separator in the texts of rows: ',', ';' or a tab. Blanks in the file become commas. */
    char separator;
    char decimal; /**< '.'; ',' once a number with a decimal comma was read */
    uint32_t reserved[4];
} mw_point_table;

/**
 * Describe the table that a reader reads.
 *
 * A line that begins with # is a row, not a comment, if three things hold: it has as many columns
 * as the header, its first column is not read as a number, and columns are not separated by blanks.
 * Then #12 is an id. LAS is a table of all values of its points, separated by commas.
 *
 * @param reader  the reader
 * @param table   receives the description; its texts are valid until mw_point_reader_close()
 * @param error   NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL.
 *
 * One thread at a time may use a reader. O(1).
 */
MW_API mw_status mw_point_reader_table(const mw_point_reader *reader, mw_point_table *table,
                                       mw_error *error);

/**
 * Choose the columns to read as numbers. Replaces an earlier choice. A reader opened with `table`
 * and without `columns` reads no column before this call.
 *
 * @param reader   a reader with mw_point_reader_options.table
 * @param columns  numbers of columns, from 0, each once
 * @param count    how many, at least 2
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a column that does not exist or is named twice, a
 *         reader without `table`, or a call after the first mw_point_reader_read();
 *         MW_ERROR_MEMORY.
 *
 * One thread at a time may use a reader. O(columns).
 */
MW_API mw_status mw_point_reader_select(mw_point_reader *reader, const size_t *columns,
                                        size_t count, mw_error *error);

/**
 * Tell from which column of the file a value comes.
 *
 * @param reader  the reader
 * @param column  number of the value within a point, from 0
 * @return the number of the column in mw_point_table, from 0; SIZE_MAX if points have no such
 *         value.
 *
 * One thread at a time may use a reader. O(1).
 */
MW_API size_t mw_point_reader_column_number(const mw_point_reader *reader, size_t column);

/**
 * Count the cells of a column that held a text instead of a number, so far.
 *
 * With mw_point_reader_options.texts such a cell in a column other than x, y and z is a missing
 * value, NaN; elsewhere it is an error, and reading ends.
 *
 * @param reader  the reader
 * @param column  number of the value within a point, from 0
 * @param line    NULL, or receives the line of the first of these cells, from 1; unchanged if there
 *                is none
 * @return how many; 0 also if points have no such value.
 *
 * One thread at a time may use a reader. O(1).
 */
MW_API uint64_t mw_point_reader_texts(const mw_point_reader *reader, size_t column, int64_t *line);

/**
 * Give the text of a row as it stands in the file, without its line end.
 *
 * @param reader  a reader with mw_point_reader_options.table
 * @param row     number of the row in the latest block of mw_point_reader_read(), from 0
 * @param length  receives the bytes of the text, which no NUL ends; 0 if there is no such row
 * @return the text, owned by the reader, valid until the next read; NULL if there is no such row,
 *         or the reader has no table.
 *
 * Several threads may call this at a time. O(1).
 */
MW_API const char *mw_point_reader_row(const mw_point_reader *reader, size_t row, size_t *length);

/** What a line of a stream of edits requests. */
typedef enum mw_edit_line_kind {
    /** Nothing: a blank line or a comment; from a reader: the end of the stream. */
    MW_EDIT_LINE_NONE = 0,
    MW_EDIT_LINE_EDIT,   /**< `edit`, for mw_edit_apply() */
    MW_EDIT_LINE_LOCATE, /**< locate (edit.x, edit.y) */
    MW_EDIT_LINE_UNDO,   /**< mw_edit_undo() */
    MW_EDIT_LINE_COMPACT /**< mw_editor_compact() */
} mw_edit_line_kind;

/** One line of a stream of edits. */
typedef struct mw_edit_line {
    mw_edit edit;
    mw_edit_line_kind kind;
    uint32_t reserved;
    int64_t line; /**< line of the file, from 1; 0: not from a file */
} mw_edit_line;

/** Options of edits as text. Zero-initialised options give fields by number. */
typedef struct mw_edit_text_options {
    /** Names of the fields in the order of their numbers (mw_editor_field_by_name()). Must outlive
     * a reader. */
    const char *const *fields;
    size_t field_count;
    uint32_t reserved[4]; /**< must be zero */
} mw_edit_text_options;

/** The word of a kind: "insert", "remove", "move", "flip", "constrain", "release" or "value"; NULL
 * for any other number. Thread-safe. O(1). */
MW_API const char *mw_edit_name(mw_edit_kind kind);

/**
 * Parse one line of edits.
 *
 * A line holds one request; blanks or commas separate its words, so CSV without a header works:
 *
 *     insert X Y [VALUE [FIELD]]   remove V   move V X Y   flip V V   constrain V V
 *     release V V   value V VALUE [FIELD]   locate X Y   undo   compact
 *
 * Words may be in any case and in double quotes. V is a vertex number from 0; 17.0 is accepted.
 * FIELD is a name or a number; without it the field z is meant if fields have names, else field 0.
 * At an insertion a VALUE that is missing or "nan" is interpolated. "#" begins a comment. Empty
 * cells at the end of a line are ignored. The editor decides later whether an edit is possible.
 *
 * @param text     one line, ended by NUL
 * @param options  NULL selects the defaults
 * @param line     receives the request; MW_EDIT_LINE_NONE on failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_INPUT for an unknown word or field, too few or too many words, or a word
 *         that is not a number; MW_ERROR_ARGUMENT for NULL.
 *
 * Thread-safe. O(length of the line).
 */
MW_API mw_status mw_edit_parse(const char *text, const mw_edit_text_options *options,
                               mw_edit_line *line, mw_error *error);

/** Room for any line of edits, its NUL included. */
#define MW_EDIT_TEXT_SIZE 160

/**
 * Write one line of edits, without a line end.
 *
 * mw_edit_parse() with the same options gives the same edit, every bit of its numbers (except the
 * sign of a NaN). Names of fields that cannot stand in a line are written as numbers.
 *
 * @param line     the request
 * @param options  NULL selects the defaults
 * @param text     receives the line, ended by NUL
 * @return the length; 0, and an empty text, for MW_EDIT_LINE_NONE and unknown kinds.
 *
 * Thread-safe. O(1).
 */
MW_API size_t mw_edit_format(const mw_edit_line *line, const mw_edit_text_options *options,
                             char text[MW_EDIT_TEXT_SIZE]);

/** A stream of edits, read line by line in constant memory. Opaque. */
typedef struct mw_edit_reader mw_edit_reader;

/**
 * Open a stream of edits.
 *
 * @param path     the file; "-": standard input
 * @param options  NULL selects the defaults
 * @param out      receives the reader, owned by the caller (mw_edit_reader_close()); NULL on
 *                 failure
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_SYSTEM if the file cannot be opened; MW_ERROR_MEMORY; MW_ERROR_ARGUMENT
 *         for NULL.
 *
 * Thread-safe. O(1).
 */
MW_API mw_status mw_edit_reader_open(const char *path, const mw_edit_text_options *options,
                                     mw_edit_reader **out, mw_error *error);

/**
 * Read the next line that is not blank.
 *
 * @param reader  the reader
 * @param line    receives the request; its kind is MW_EDIT_LINE_NONE at the end of the stream. On
 *                failure line->line is the number of the faulty line, and the next call continues
 *                after it. If line->line is 0, the file cannot be read further: close the reader
 * @param error   NULL, or receives the message of a failure, with file and line
 * @return as mw_edit_parse(); also MW_ERROR_SYSTEM, MW_ERROR_MEMORY.
 *
 * One thread at a time may use a reader. O(length of the line).
 */
MW_API mw_status mw_edit_reader_read(mw_edit_reader *reader, mw_edit_line *line, mw_error *error);

/** The part of the stream that has been read, as mw_point_reader_fraction(). */
MW_API double mw_edit_reader_fraction(const mw_edit_reader *reader);

/** Close a reader. NULL is allowed. */
MW_API void mw_edit_reader_close(mw_edit_reader *reader);

/** What a line of a stream of edits of a surface requests. */
typedef enum mw_surface_edit_line_kind {
    MW_SURFACE_EDIT_LINE_NONE = 0, /**< nothing: the end of the stream */
    MW_SURFACE_EDIT_LINE_EDIT,     /**< `edit`, for mw_surface_edit_apply() */
    MW_SURFACE_EDIT_LINE_PROBE,    /**< a probe from `point` along `motion`, for mw_probe() */
    MW_SURFACE_EDIT_LINE_UNDO,     /**< mw_surface_edit_undo() */
    MW_SURFACE_EDIT_LINE_COMPACT   /**< mw_surface_editor_compact() */
} mw_surface_edit_line_kind;

/** One line of a stream of edits of a surface. */
typedef struct mw_surface_edit_line {
    mw_surface_edit edit; /**< its paths are owned by the reader, valid until the next line */
    mw_surface_edit_line_kind kind;
    uint32_t reserved;
    double point[3], motion[3];
    const char *text; /**< the request as it was read, without comment; owned by the reader */
    int64_t line;     /**< line of the file, from 1 */
} mw_surface_edit_line;

/** A stream of edits of a surface, read line by line. Opaque. */
typedef struct mw_surface_edit_reader mw_surface_edit_reader;

/**
 * Open a stream of edits of a surface.
 *
 * A line holds one request, with words as in mw_edit_parse():
 *
 *     add-vertex X Y Z   remove-vertex V   move-vertex V X Y Z   add-triangle V V V
 *     remove-triangle T   split-edge V V [X Y Z]   split-triangle T [X Y Z]   flip V V
 *     collapse V V [X Y Z]   cut V V [V ...]   sew V V [V ...] to V V [V ...]
 *     probe X Y Z MX MY MZ   undo   compact
 *
 * V is the number of a vertex, T of a triangle, from 0.
 *
 * @param path   the file; "-": standard input
 * @param out    receives the reader, owned by the caller (mw_surface_edit_reader_close()); NULL on
 *               failure
 * @param error  NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_SYSTEM if the file cannot be opened; MW_ERROR_MEMORY; MW_ERROR_ARGUMENT
 *         for NULL.
 *
 * Thread-safe. O(1).
 */
MW_API mw_status mw_surface_edit_reader_open(const char *path, mw_surface_edit_reader **out,
                                             mw_error *error);

/**
 * Read the next request. Blank lines and comments are skipped.
 *
 * If the call fails with MW_ERROR_INPUT and names a line (line->line > 0), the next call continues
 * after that line.
 *
 * @param reader  the reader
 * @param line    receives the request; MW_SURFACE_EDIT_LINE_NONE at the end, with line 0
 * @param error   NULL, or receives the message of a failure, with the line
 * @return MW_OK, also at the end; MW_ERROR_INPUT for a line that is no request; MW_ERROR_SYSTEM,
 *         MW_ERROR_MEMORY.
 *
 * One thread at a time may use a reader. O(length of the line).
 */
MW_API mw_status mw_surface_edit_reader_read(mw_surface_edit_reader *reader,
                                             mw_surface_edit_line *line, mw_error *error);

/** The part of the stream that has been read, as mw_point_reader_fraction(). */
MW_API double mw_surface_edit_reader_fraction(const mw_surface_edit_reader *reader);

/** Close a reader. NULL is allowed. */
MW_API void mw_surface_edit_reader_close(mw_surface_edit_reader *reader);

/**
 * An output file that appears under its name only when it is complete. Opaque.
 *
 * It is written without a name, or under a temporary name in the same directory, and then gets its
 * name in one step. An existing file keeps its permissions. A symbolic link stays a link: the file
 * that it leads to is written. Pipes, terminals and devices are written directly. Writing into a
 * closed pipe raises SIGPIPE; a program that wants the error instead ignores that signal.
 */
typedef struct mw_output mw_output;

/**
 * Open an output.
 *
 * @param path   the file; "-": standard output
 * @param out    receives the output, owned by the caller (mw_output_close() releases it); NULL on
 *               failure
 * @param error  NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_SYSTEM if the file cannot be made; MW_ERROR_ARGUMENT for NULL;
 *         MW_ERROR_MEMORY.
 *
 * Thread-safe. O(1).
 */
MW_API mw_status mw_output_open(const char *path, mw_output **out, mw_error *error);

/**
 * Find the name under which the output of a path appears. Symbolic links are followed to the end.
 *
 * @param path   the path; the file need not exist
 * @param name   receives the name, released by the caller with free(); NULL on failure
 * @param error  NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_SYSTEM for links that lead to one another; MW_ERROR_ARGUMENT for NULL;
 *         MW_ERROR_MEMORY.
 *
 * Thread-safe. O(length of the path) for each link.
 */
MW_API mw_status mw_output_resolve(const char *path, char **name, mw_error *error);

/**
 * Write bytes. mw_output_close() reports a failure.
 *
 * @param output  the output
 * @param bytes   what to write
 * @param size    how many bytes
 *
 * One thread at a time may use an output.
 */
MW_API void mw_output_write(mw_output *output, const void *bytes, size_t size);

/**
 * Write as printf() does. mw_output_close() reports a failure.
 *
 * @param output  the output
 * @param format  for text and integers only: printf() writes decimals as the locale has them, so
 *                write doubles with mw_output_double()
 *
 * One thread at a time may use an output.
 */
MW_API void mw_output_printf(mw_output *output, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/**
 * Format a double as in the "C" locale: the shortest of %.15g, %.16g and %.17g that reads back as
 * the same double; "nan", "inf", "-inf".
 *
 * @param value  any double
 * @param text   receives the text, ended by NUL
 * @return its length, at most 24.
 *
 * Thread-safe. O(1).
 */
MW_API size_t mw_format_double(double value, char text[32]);

/** Write a double as mw_format_double() formats it. One thread at a time may use an output. */
MW_API void mw_output_double(mw_output *output, double value);

/** 1 if a write has failed, so that a long job can stop early; else 0. One thread at a time may use
 * an output. O(1). */
MW_API int mw_output_failed(const mw_output *output);

/** The name of the temporary file, which a program that is interrupted should remove; owned by the
 * output; NULL if there is none. O(1). */
MW_API const char *mw_output_temporary(const mw_output *output);

/**
 * Finish an output, and release it in any case.
 *
 * @param output  the output
 * @param commit  1: give the file its name; 0: remove it
 * @param error   NULL, or receives the first failure of a write: "FILE: No space left on device"
 * @return MW_OK; MW_ERROR_SYSTEM if a write failed or the file cannot get its name: then no file
 *         is left.
 *
 * One thread at a time may use an output.
 */
MW_API mw_status mw_output_close(mw_output *output, int commit, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
