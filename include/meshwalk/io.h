/* io.h - reading and writing meshes and points.
 *
 * Formats are recognised by content where it tells, else by the name; every reader takes gzip. Readers trust no count
 * in a header, and use memory in proportion to what a file really holds. Errors read "FILE:LINE: what is wrong" (then
 * mw_error.line is set; binary files: "FILE: at byte N: ..."). Numbers are read and written the same in every locale,
 * and round-trip. A written file appears under its final name only when it is complete. "-" is standard input or
 * output. Functions are thread-safe on different objects. */
#ifndef MESHWALK_IO_H
#define MESHWALK_IO_H

#include <meshwalk/edit.h>
#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A mesh as read: arrays owned by the structure; release with mw_mesh_file_release. Faces of more than three corners
 * are cut into triangles, a fan from the first corner. */
typedef struct mw_mesh_file {
    double *points;      /* 3 per vertex: x y z (z = 0 where the file has none) */
    uint32_t *triangles; /* 3 per triangle */
    size_t point_count, triangle_count;
    int has_z;
    char **field_names; /* further values per vertex (attributes of .node, properties of PLY) */
    double **fields;    /* field_count arrays of point_count */
    size_t field_count;
    size_t welded; /* STL: vertices merged because their coordinates are equal */
    char *crs;     /* the coordinate system of x and y, as WKT or "EPSG:n"; NULL = not known. PLY has
                      it in a line "comment crs ...", other files in a .prj file beside them */
} mw_mesh_file;

/** How a whole file is read or written. */
typedef struct mw_file_options {
    const mw_progress
        *progress; /**< who watches, and may cancel: base.h; NULL: nobody. Of a pipe the fraction is a guess */
    uint32_t reserved[6];
} mw_file_options;

/* Read a mesh. Coordinates may be NaN or infinite; vertex numbers all exist.
 *   OFF          with normals, colours or texture coordinates, which are passed over
 *   OBJ          v and f; all else is passed over
 *   PLY          text, little- and big-endian; numbers of the vertices beside x, y, z become fields; also triangle
 *                strips
 *   STL          text and binary; corners with equal coordinates become one vertex (-0.0 equals 0.0)
 *   .node, .ele  Triangle: path is the name of either, or the name without ending; numbered from 0 or 1. Attributes
 *                become fields "attribute1", ..., unless a comment "# attributes: NAME, NAME" on top names them; one
 *                called z is the height
 * MW_ERROR_SYSTEM: cannot be opened or read; MW_ERROR_INPUT: malformed, truncated, or a format that is not known;
 * MW_ERROR_LIMIT; MW_ERROR_MEMORY; MW_CANCELLED. On failure `file` is empty. options: NULL = all zero. */
MW_API mw_status mw_read_mesh(const char *path, const mw_file_options *options, mw_mesh_file *file, mw_error *error);
MW_API void mw_mesh_file_release(mw_mesh_file *file); /* NULL and an empty file are allowed */

/* The mesh of a file as arrays for mw_mesh_create and mw_check_arrays. */
MW_API mw_arrays mw_mesh_file_arrays(const mw_mesh_file *file);

/* A ring that was skipped, as it has fewer than three different points. */
typedef struct mw_skipped_ring {
    uint32_t record;  /* number of the feature, from 0 */
    uint32_t polygon; /* of that feature, from 0: it may have several */
    uint32_t ring;    /* of that polygon; 0 is the outer one, with which the whole polygon is skipped */
} mw_skipped_ring;

/* Constraints for mw_constrained_delaunay as read: arrays owned by the structure; release with
 * mw_constraint_file_release. */
typedef struct mw_constraint_file {
    double *points; /* 3 per point: x y z (NaN where the file has no z for it); points of rings and lines once each, in
                       the order of the file; a ring's closing point is not repeated                               */
    size_t point_count;
    int has_z;          /* some point has a z */
    uint32_t *segments; /* 2 per segment */
    uint32_t *polygon;  /* per segment the number of its polygon, or MW_NONE for lines */
    uint32_t *record;   /* per segment the record of the file that it comes from: number of a line or of a feature */
    size_t segment_count;
    size_t polygon_count;
    double *hole_seeds; /* x, y of a point in each hole */
    size_t hole_seed_count;
    const char *record_name; /* "line" or "feature": what `record` counts, lines from 1, features from 0 */
    char **field_names;      /* further values per point (attributes of .poly) */
    double **fields;
    size_t field_count;
    mw_skipped_ring *skipped; /* what is not among the above; a warning, or an error, as the caller decides */
    size_t skipped_count;
    char *crs; /* the coordinate system, as WKT or "EPSG:n"; NULL = not known. GeoJSON has longitudes
                  and latitudes (EPSG:4326) unless it says otherwise or its numbers cannot be
                  such; .poly has a .prj file beside it */
} mw_constraint_file;

/* Read constraints.
 *   .poly     Triangle: with its points inside, or in a .node file of the same name; numbered from 0 or 1; holes. Every
 *             segment bounds: there are no polygons, polygon[i] is MW_NONE
 *   GeoJSON   Point, MultiPoint, LineString, MultiLineString, Polygon, MultiPolygon, GeometryCollection, Feature and
 *             FeatureCollection; each polygon of a MultiPolygon is one. A ring that is not closed is closed; null and
 *             empty geometries are passed over; rings of fewer than three different points are skipped
 *             and listed. Refused where the library was built without Jansson
 * Recognised by content; gzip is taken. MW_ERROR_SYSTEM, MW_ERROR_INPUT, MW_ERROR_LIMIT, MW_ERROR_MEMORY as
 * mw_read_mesh, MW_CANCELLED too. On failure `file` is empty. options: NULL = all zero. */
MW_API mw_status mw_read_constraints(const char *path, const mw_file_options *options, mw_constraint_file *file,
                                     mw_error *error);
MW_API void mw_constraint_file_release(mw_constraint_file *file); /* NULL and an empty file are allowed */
/* Would mw_read_constraints take the file for one of a format that it reads, sound or not? 0 also for a file that cannot
 * be opened. Of standard input this uses up the beginning. */
MW_API int mw_constraints_known(const char *path);

/* Write a mesh. The format follows `format`, or the ending of path where it is NULL:
 *   "off"         Geomview; fields are not written
 *   "ply"         binary, little-endian; "ply-ascii" the same as text (.ply names "ply")
 *   "node"        Triangle: two files, .node and .ele, whichever is named; z becomes the first attribute
 *   "obj", "stl"  (STL as text, with all digits); fields are not written
 *   "vtk"         legacy VTK as text, an unstructured grid with the fields as point data, for ParaView; not read
 *   "csv"         a table for other programs: a row for each corner of each triangle, with the columns
 *                 triangle,corner,vertex,x,y,z and the fields; not read as a mesh
 * A crs is written to PLY, in a line "comment crs ...", and passed over elsewhere.
 * Vertices, triangles, z and fields keep their order and every bit (the sign of a NaN apart), but for the vertices of
 * STL and csv, which have corners only; names of fields become single words. Of "node" both files are complete before
 * .ele and then .node get their names; who interrupts the program between these two steps finds a new .ele beside no
 * .node or an old one. MW_ERROR_ARGUMENT: unknown format, or a path that ends in .gz; MW_ERROR_INPUT: a triangle names
 * a vertex that does not exist; MW_ERROR_SYSTEM: cannot be written, and then no file is left (but for that .ele, if
 * only .node cannot get its name); MW_CANCELLED: likewise. options: NULL = all zero. */
MW_API mw_status mw_write_mesh(const char *path, const mw_mesh_file *file, const char *format,
                               const mw_file_options *options, mw_error *error);
/* Names of the formats that mw_write_mesh takes, i from 0; NULL beyond the last. */
MW_API const char *mw_mesh_format_name(size_t i);

/* All zero = take everything, as the file has it. */
typedef struct mw_point_reader_options {
    const char *columns;  /* NULL = see mw_point_reader_open; else names or 1-based numbers, "x,y", "lon,lat,z" */
    uint8_t classes[256]; /* LAS: 1 = take points of this class; all zero = take all */
    uint32_t table;       /* 1 = keep the text of every row; see mw_point_reader_table */
    uint32_t texts; /* 1 = with `columns` NULL, cells of further columns may be texts; see mw_point_reader_texts */
    uint32_t reserved[2];
} mw_point_reader_options;

/** Tell the coordinate system that a .prj file beside a file names: the name without .gz and without its ending, and
 * .prj. The readers of meshes, points and constraints do this by themselves.
 * @param path  name of the file, which need not exist; "-" has none beside it
 * @param crs   a text on one line, WKT or "EPSG:n", released by the caller with free(); NULL = there is no such file, or
 *              it names no system
 * @return MW_OK; MW_ERROR_ARGUMENT: NULL; MW_ERROR_MEMORY. Thread-safe. */
MW_API mw_status mw_read_prj(const char *path, char **crs, mw_error *error);

/** Names that files give to the coordinates of a point, as "lon", "lat" and "z". */
typedef struct mw_axis_names {
    const char *axis[3];
    int lonlat; /* 1 = the first two are longitude and latitude */
    uint32_t reserved;
} mw_axis_names;

/** Tell a set of names that columns of coordinates are known by.
 * @param i  number of the set, from 0
 * @return the set, a constant; NULL beyond the last. Thread-safe. */
MW_API const mw_axis_names *mw_axis_names_at(size_t i);

/** Decide whether a column's name means a coordinate: letters of any case, without regard to blanks, '_', '-', '.' and
 * a unit in brackets behind it, as "Point X (m)" does mean "point_x".
 * @param column  name of the column
 * @param name    one of a set of mw_axis_names_at
 * @return 1 or 0. Thread-safe. */
MW_API int mw_axis_name_matches(const char *column, const char *name);

/* A stream of points, read block by block in constant memory: text, or LAS 1.0-1.4 (LAZ is refused with a hint).
 *
 * Text: columns separated by semicolons, tabs, commas or blanks (what the first row has, in this order of preference).
 * The first row is a header if none of its fields is a number, or if two of them name coordinates (mw_axis_names_at).
 * Empty lines and lines that begin with # are skipped (but see mw_point_reader_table). Rows all have
 * the same number of columns. A field that begins with a double quote ends with one, and may hold
 * separators, line ends and "" for a quote. "inf" is a number; NaN, NA, N/A, NULL (in letters of any
 * case), "-" and an empty field are missing values, NaN. Decimal commas are taken where semicolons or
 * tabs separate, and refused elsewhere, and beside decimal points. Triangle's .node is read too, without its numbers and markers.
 *
 * Columns: those selected, in the order given. With `columns` NULL: all columns that hold numbers in the first row;
 * where a header names x and y as a set of mw_axis_names_at does, these, and z, come first.
 * LAS has x, y, z, intensity, return, returns, classification, scan_angle, user_data, point_source, time, red, green,
 * blue (time and colours NaN where the point format has none); with `columns` NULL x, y, z.
 *
 * MW_ERROR_SYSTEM, MW_ERROR_INPUT (also for a column that the file does not have), MW_ERROR_MEMORY; MW_ERROR_ARGUMENT:
 * a selection of fewer than two columns, or of one twice. A file without rows is a stream of no points. */
typedef struct mw_point_reader mw_point_reader;

MW_API mw_status mw_point_reader_open(const char *path, const mw_point_reader_options *options, mw_point_reader **out,
                                      mw_error *error);
/* Values per point: the columns of the file (or the selected ones); at least 2. */
MW_API size_t mw_point_reader_width(const mw_point_reader *reader);
/* Name of a column: that of the header; else "x", "y", "z", "c4", ... Owned by the reader; NULL beyond the last. */
MW_API const char *mw_point_reader_column(const mw_point_reader *reader, size_t column);
/* Read up to `capacity` points, mw_point_reader_width doubles each, into values. *count < capacity only at the end,
 * where it becomes 0; a reader with `table` also ends a block early where its text is long. On failure *count points before the faulty one are valid, and the reader can only be closed. */
MW_API mw_status mw_point_reader_read(mw_point_reader *reader, double *values, size_t capacity, size_t *count,
                                      mw_error *error);
/** Tell the coordinate system of the points: that of the records of LAS (WKT, or the EPSG code of its
 * GeoTIFF keys), or else of a .prj file beside the points.
 * @param reader  not NULL
 * @return WKT or "EPSG:n", owned by the reader; NULL = not known. Thread-safe on different readers. */
MW_API const char *mw_point_reader_crs(const mw_point_reader *reader);
/**
 * How much of the file has been read, to show to people: from 0 to 1, or -1 where the size is not known, as of a pipe.
 * Not safe while another thread reads by the same reader.
 */
MW_API double mw_point_reader_fraction(const mw_point_reader *reader);
MW_API void mw_point_reader_close(mw_point_reader *reader); /* NULL is allowed */

/** The columns of a file, whether they are read as numbers or not. Texts belong to the reader. */
typedef struct mw_point_table {
    const char *const *names; /* of the columns, "" for one without a name; NULL = the file has no header */
    const char *header;       /* the header as it stands in the file; NULL = it has none */
    size_t column_count;
    char separator; /* of the rows' texts: ',', ';' or a tab. White space in the file becomes commas */
    char decimal;   /* '.', or ',' as soon as a number with a decimal comma was read */
    uint32_t reserved[4];
} mw_point_table;

/** Describe the table that a reader reads. A line that begins with # is a row of it, not a comment, if
 * it has as many columns as the header, a column that is not read begins it, and blanks do not separate
 * them: #12 is an id. LAS is a table with commas of all the values that its points have.
 * @param table  is filled in; its texts last until mw_point_reader_close
 * @return MW_OK; MW_ERROR_ARGUMENT: NULL. Thread-safe on different readers. */
MW_API mw_status mw_point_reader_table(const mw_point_reader *reader, mw_point_table *table, mw_error *error);

/** Choose the columns to read as numbers, in place of those chosen so far. A reader that was opened with `table` and
 * without `columns` reads none before this call.
 * @param columns  numbers of columns, from 0, at least two, each once
 * @return MW_OK; MW_ERROR_ARGUMENT: NULL, no such column, one twice, a reader without `table`, or after the first
 * mw_point_reader_read; MW_ERROR_MEMORY. Thread-safe on different readers. */
MW_API mw_status mw_point_reader_select(mw_point_reader *reader, const size_t *columns, size_t count, mw_error *error);

/** Tell which column of the file a value comes from.
 * @param column  number of the value within a point, from 0
 * @return the number of the column in mw_point_table, from 0; SIZE_MAX = no such value. Thread-safe. */
MW_API size_t mw_point_reader_place(const mw_point_reader *reader, size_t column);

/** Tell how many cells that were read held a text where a number belongs. Such a cell is a missing value, NaN, in
 * columns beyond x, y and z of a reader that was opened with `texts`; elsewhere it ends the reading with an error.
 * @param column  number of the value within a point, from 0
 * @param line    line of the first of these cells, from 1; unchanged if there is none. NULL is allowed
 * @return how many; 0 also if there is no such value. Thread-safe on different readers. */
MW_API uint64_t mw_point_reader_texts(const mw_point_reader *reader, size_t column, int64_t *line);

/** Give the text of a row: as it stands in the file, without its line end, whatever its cells hold.
 * @param row     number of the row in the block that mw_point_reader_read gave last, from 0
 * @param length  bytes of the text, which no NUL ends; 0 on failure
 * @return the text, until the next read or close; NULL = no such row, or a reader without `table`. Several threads may
 * call this at a time. */
MW_API const char *mw_point_reader_row(const mw_point_reader *reader, size_t row, size_t *length);

/* What a line of a stream of edits asks for. */
typedef enum mw_edit_line_kind {
    MW_EDIT_LINE_NONE = 0, /* nothing: a blank line or a comment; of a reader: the stream has ended */
    MW_EDIT_LINE_EDIT,     /* `edit`, for mw_edit_apply                                             */
    MW_EDIT_LINE_LOCATE,   /* which triangle contains edit.x, edit.y?                               */
    MW_EDIT_LINE_UNDO,     /* mw_edit_undo                                                          */
    MW_EDIT_LINE_COMPACT   /* mw_editor_compact                                                     */
} mw_edit_line_kind;

typedef struct mw_edit_line {
    mw_edit edit;
    mw_edit_line_kind kind;
    uint32_t reserved;
    int64_t line; /* of the file, from 1; 0: not of a file */
} mw_edit_line;

/* All zero = fields go by their numbers. */
typedef struct mw_edit_text_options {
    const char *const
        *fields; /* their names, in the order of their numbers (mw_editor_field_by_name); has to outlive a reader */
    size_t field_count;
    uint32_t reserved[4];
} mw_edit_text_options;

/* "insert", "remove", "move", "flip", "constrain", "release", "value"; NULL for another number. */
MW_API const char *mw_edit_name(mw_edit_kind kind);

/* Edits as text, a line each, its words separated by blanks or by a comma (so that CSV without a header will do):
 *   insert X Y [VALUE [FIELD]]   remove V   move V X Y   flip V V   constrain V V   release V V   value V VALUE [FIELD]
 *   locate X Y   undo   compact
 * Words are taken in any case and may stand in double quotes. V is the number of a vertex, from 0; 17.0 is one, too. FIELD is a name
 * or a number; without it the field z is meant, where fields have names, else number 0. A VALUE that is missing or "nan" is
 * interpolated at an insertion. "#" begins a comment. Cells that are empty at the end of a line are passed over. Whether
 * an edit is possible, the editor tells.
 *
 * Read one line; options: NULL = all zero. MW_ERROR_INPUT: an unknown word, too few or too many of them, something that is no
 * number, an unknown field; then line->kind is MW_EDIT_LINE_NONE. MW_ERROR_ARGUMENT: NULL. Thread-safe. */
MW_API mw_status mw_edit_parse(const char *text, const mw_edit_text_options *options, mw_edit_line *line,
                               mw_error *error);

/* Write one line, ended by NUL instead of a newline, so that mw_edit_parse with the same options gives the same edit, every bit of its
 * numbers (the sign of a NaN apart). Names of fields that cannot stand in a line are written as numbers. Returns its length; 0 and
 * an empty text for MW_EDIT_LINE_NONE and unknown kinds. Thread-safe. */
#define MW_EDIT_TEXT_SIZE 160
MW_API size_t mw_edit_format(const mw_edit_line *line, const mw_edit_text_options *options,
                             char text[MW_EDIT_TEXT_SIZE]);

/* A stream of them, read line by line in constant memory. MW_ERROR_SYSTEM, MW_ERROR_MEMORY; MW_ERROR_ARGUMENT: NULL. */
typedef struct mw_edit_reader mw_edit_reader;
MW_API mw_status mw_edit_reader_open(const char *path, const mw_edit_text_options *options, mw_edit_reader **out,
                                     mw_error *error);
/* Read the next line that is not blank; line->kind is MW_EDIT_LINE_NONE at the end. Errors as of mw_edit_parse, with file and
 * line; then line->line tells whether the reader can go on: the number of the line, which the next call will be behind,
 * or 0: the file cannot be read on (also MW_ERROR_SYSTEM, MW_ERROR_MEMORY), and the reader can only be closed. */
MW_API mw_status mw_edit_reader_read(mw_edit_reader *reader, mw_edit_line *line, mw_error *error);
/** As mw_point_reader_fraction. */
MW_API double mw_edit_reader_fraction(const mw_edit_reader *reader);
MW_API void mw_edit_reader_close(mw_edit_reader *reader); /* NULL is allowed */

/* A file that appears under its name only when it is complete: written without a name, or under a temporary one beside
 * it, then given its name, in one step where a file of that name exists (its permissions are kept, and so is a symbolic
 * link to it, whether the file existed or not). Pipes, terminals and devices are written directly.
 * Writing into a closed pipe raises SIGPIPE: a program that wants the error instead ignores that signal. */
typedef struct mw_output mw_output;
MW_API mw_status mw_output_open(const char *path, mw_output **out, mw_error *error);

/* Find the name under which the output of `path` appears: what symbolic links lead to, whether
 * there is a file or not.
 *   name  released by the caller with free(); NULL on failure
 * MW_ERROR_SYSTEM: links that lead to one another; MW_ERROR_MEMORY, MW_ERROR_ARGUMENT. */
MW_API mw_status mw_output_resolve(const char *path, char **name, mw_error *error);
/* Errors are kept for mw_output_close. */
MW_API void mw_output_write(mw_output *output, const void *bytes, size_t size);
/* As printf, for text and integers: decimals would follow the locale. */
MW_API void mw_output_printf(mw_output *output, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The shortest of %.15g, %.16g and %.17g in the "C" locale that reads back as the same double; "nan", "inf", "-inf".
 * Returns its length, at most 24. */
MW_API size_t mw_format_double(double value, char text[32]);
MW_API void mw_output_double(mw_output *output, double value);
/* Has a write failed yet? Long jobs ask, and stop. */
MW_API int mw_output_failed(const mw_output *output);
/* The temporary file that an interrupted program should remove; NULL where the system needs none. Owned by the
 * output. */
MW_API const char *mw_output_temporary(const mw_output *output);
/* commit = 1: finish and rename; 0: remove. Reports the first failed write ("FILE: No space left on device").
 * Frees the output in any case. */
MW_API mw_status mw_output_close(mw_output *output, int commit, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
