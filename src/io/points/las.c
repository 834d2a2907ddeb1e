/* Points from LAS 1.0 to 1.4, point formats 0 to 10, as published by the ASPRS. LAZ, the
 * compressed form, is refused.
 *
 * Reading stops after the number of points that the header gives; it is an error if the data end
 * before. The variable length records before the points, and in 1.4 also those after them, are
 * searched for the coordinate system. Everything else in the file (other records, waveforms) is
 * skipped. */
#include "io/points/las.h"

#include "base/posix.h"
#include "io/points/las_trailer.h"

#include "io/text/byte_order.h"
#include "io/text/crs_text.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER = 227, HEADER_1_4 = 375, VLR_HEADER = 54, LASZIP_RECORD = 22204 };
enum { WKT_RECORD = 2112, GEO_KEYS_RECORD = 34735 };

/* Bytes of a record of each format, and where in it some values stand (0: not there). */
typedef struct las_layout {
    uint8_t size, time, colour;
} las_layout;
static const las_layout layouts[] = {{20, 0, 0},   {28, 20, 0},  {26, 0, 20}, {34, 20, 28},
                                     {57, 20, 0},  {63, 20, 28}, {30, 22, 0}, {36, 22, 30},
                                     {38, 22, 30}, {59, 22, 0},  {67, 22, 30}};
enum { FORMATS = sizeof layouts / sizeof *layouts, OLD_FORMATS = 6 };

typedef enum las_column {
    X,
    Y,
    Z,
    INTENSITY,
    RETURN,
    RETURNS,
    CLASSIFICATION,
    ANGLE,
    USER_DATA,
    SOURCE,
    TIME,
    RED,
    GREEN,
    BLUE,
    COLUMN_COUNT
} las_column;
static const char *const column_names[COLUMN_COUNT] = {"x",
                                                       "y",
                                                       "z",
                                                       "intensity",
                                                       "return",
                                                       "returns",
                                                       "classification",
                                                       "scan_angle",
                                                       "user_data",
                                                       "point_source",
                                                       "time",
                                                       "red",
                                                       "green",
                                                       "blue"};

typedef struct las_reader {
    double scale[3], offset[3];
    unsigned format;
    size_t record_size;
    uint64_t count, done; /* points of the file, and how many of them were read */
    bool filtered;
    uint8_t classes[256];
    uint8_t columns[COLUMN_COUNT]; /* what the values of a point are */
} las_reader;

static double las_value(const las_reader *l, const unsigned char *record, las_column which)
{
    const las_layout *at = &layouts[l->format];
    bool old = l->format < OLD_FORMATS;
    switch (which) {
    case X:
    case Y:
    case Z: return mw__get_i32(record + 4 * which) * l->scale[which] + l->offset[which];
    case INTENSITY: return mw__get_u16(record + 12);
    case RETURN: return record[14] & (old ? 7 : 15);
    case RETURNS: return old ? record[14] >> 3 & 7 : record[14] >> 4;
    case CLASSIFICATION: return old ? record[15] & 31 : record[16];
    case ANGLE: return old ? (int8_t)record[16] : (int16_t)mw__get_u16(record + 18) * 0.006;
    case USER_DATA: return record[17];
    case SOURCE: return mw__get_u16(record + (old ? 18 : 20));
    case TIME: return at->time ? mw__get_f64(record + at->time) : NAN;
    case RED:
    case GREEN:
    case BLUE: return at->colour ? mw__get_u16(record + at->colour + 2 * (which - RED)) : NAN;
    case COLUMN_COUNT: break;
    }
    return NAN;
}

/* Whether the points of the file have the value. */
static bool las_has_column(const las_reader *l, las_column which)
{
    const las_layout *at = &layouts[l->format];
    return which < TIME || (which == TIME ? at->time > 0 : at->colour > 0);
}

/* Keep all values of a point as the row of a table. */
static mw_status las_keep_row(mw_point_reader *reader, const unsigned char *record, mw_error *error)
{
    const las_reader *l = reader->state;
    char row[32 * COLUMN_COUNT];
    size_t size = 0;
    if (!reader->table) return MW_OK;
    for (las_column c = X; c < COLUMN_COUNT; c++) {
        if (!las_has_column(l, c)) continue;
        if (size > 0) row[size++] = ',';
        size += mw_format_double(las_value(l, record, c), row + size);
    }
    return mw__row_texts_add(&reader->rows, row, size, ',', error);
}

static mw_status las_read_points(mw_point_reader *reader, double *values, size_t capacity,
                                 size_t *count, mw_error *error)
{
    las_reader *l = reader->state;
    while (*count < capacity && l->done < l->count && reader->rows.size < MW_ROW_TEXTS_LIMIT) {
        const char *next;
        const unsigned char *record;
        size_t have;
        mw_status status = mw__source_peek(&reader->source, l->record_size, &next, &have, error);
        if (status) return status;
        if (have < l->record_size && !reader->source.damage)
            return mw__source_fail(&reader->source, error,
                                   "the data end after %" PRIu64 " of %" PRIu64 " points", l->done,
                                   l->count);
        status = mw__source_bytes(&reader->source, l->record_size, &record, error);
        if (status) return status;
        l->done++;
        if (l->filtered && !l->classes[(unsigned)las_value(l, record, CLASSIFICATION)]) continue;
        status = las_keep_row(reader, record, error);
        if (status) return status;
        double *point = values + *count * reader->width;
        for (size_t i = 0; i < reader->width; i++)
            point[i] = las_value(l, record, (las_column)l->columns[i]);
        ++*count;
    }
    return MW_OK;
}

static mw_status las_refuse_laz(const mw_source *source, mw_error *error)
{
    const char *name = mw__source_name(source);
    return mw__fail(error, MW_ERROR_INPUT,
                    "%.240s: this is LAZ, compressed LAS, which is not read: unpack it first, for "
                    "instance with "
                    "'las2las -i FILE.laz -o FILE.las' or 'pdal translate FILE.laz FILE.las'",
                    name);
}

/* What the records before the points tell. */
typedef struct las_records {
    bool compressed;
    char *wkt;     /* NULL: none */
    unsigned epsg; /* 0: none */
} las_records;

/* The EPSG code of a directory of GeoTIFF keys: that of the projected system (key 3072), or else
 * of the geographic one (key 2048); 0 if it has none, as a system that its other keys define. */
static unsigned las_epsg_of_keys(const unsigned char *bytes, size_t size)
{
    enum {
        MODEL = 1024,
        GEOGRAPHIC = 2048,
        PROJECTED = 3072,
        IS_GEOGRAPHIC = 2,
        USER_DEFINED = 32767
    };
    unsigned model = 0, geographic = 0, projected = 0;
    for (size_t at = 8; at + 8 <= size; at += 8) {
        unsigned key = mw__get_u16(bytes + at), tag = mw__get_u16(bytes + at + 2),
                 value = mw__get_u16(bytes + at + 6);
        if (tag != 0 || value >= USER_DEFINED) continue;
        if (key == MODEL) model = value;
        if (key == GEOGRAPHIC) geographic = value;
        if (key == PROJECTED) projected = value;
    }
    return projected && model != IS_GEOGRAPHIC    ? projected
           : model == 0 || model == IS_GEOGRAPHIC ? geographic
                                                  : 0;
}

/* Read a record of those that are about the projection; of several of a kind the first counts. */
static mw_status las_read_record(mw_source *source, size_t length, unsigned number,
                                 las_records *records, mw_error *error)
{
    const unsigned char *bytes;
    bool wkt = number == WKT_RECORD && !records->wkt;
    bool keys = number == GEO_KEYS_RECORD && !records->epsg;
    if (!wkt && !keys) return mw__source_skip(source, length, error);
    mw_status status = mw__source_bytes(source, length, &bytes, error);
    if (status) return status;
    if (keys) records->epsg = las_epsg_of_keys(bytes, length);
    return wkt ? mw__crs_copy((const char *)bytes, length, &records->wkt, error) : MW_OK;
}

/* Go through what stands between the header and the points, as far as it consists of records. The
 * number of records is not trusted. */
static mw_status las_read_records(mw_source *source, uint64_t end, las_records *records,
                                  mw_error *error)
{
    while (end - source->offset >= VLR_HEADER) {
        const unsigned char *bytes;
        mw_status status = mw__source_bytes(source, VLR_HEADER, &bytes, error);
        if (status) return status;
        unsigned number = mw__get_u16(bytes + 18);
        bool projection =
            memcmp(bytes + 2, "LASF_Projection", 16) == 0 || memcmp(bytes + 2, "liblas", 7) == 0;
        records->compressed |= memcmp(bytes + 2, "laszip", 6) == 0 && number == LASZIP_RECORD;
        uint64_t length = mw__get_u16(bytes + 20), left = end - source->offset;
        if (length > left) length = left;
        status = projection ? las_read_record(source, (size_t)length, number, records, error)
                            : mw__source_skip(source, length, error);
        if (status) return status;
    }
    return mw__source_skip(source, end - source->offset, error);
}

/* In LAS 1.4 the WKT may stand behind the points. A pipe has no way there and back. */
static mw_status las_read_trailer(const mw_source *source, mw_las_trailer trailer,
                                  las_records *records, mw_error *error)
{
    if (records->wkt || records->compressed || trailer.count == 0 || source->size == 0)
        return MW_OK;
    return mw__las_trailer_wkt(source->path, trailer, &records->wkt, error);
}

/* Keep the coordinate system that the records name: WKT, or else EPSG:n. */
static mw_status las_keep_crs(mw_point_reader *reader, las_records *records, mw_error *error)
{
    char code[24];
    reader->crs = records->wkt;
    if (reader->crs || !records->epsg) return MW_OK;
    snprintf(code, sizeof code, "EPSG:%u", records->epsg);
    reader->crs = strdup(code);
    return reader->crs ? MW_OK : mw__fail_memory(error);
}

/* The fields that all versions have, and the records before the points; the rest of the header is
 * skipped. */
static mw_status las_read_header(mw_point_reader *reader, las_reader *l, mw_error *error)
{
    mw_source *source = &reader->source;
    const char *head;
    size_t have;
    mw_status status = mw__source_peek(source, HEADER_1_4, &head, &have, error);
    if (status) return status;
    const unsigned char *h = (const unsigned char *)head;
    if (have < HEADER)
        return mw__source_fail_at(source, have, error, "the data end within the header");
    unsigned minor = h[25], header_size = mw__get_u16(h + 94), format = h[104];
    uint64_t points_at = mw__get_u32(h + 96);
    l->record_size = mw__get_u16(h + 105);
    l->count = mw__get_u32(h + 107);
    if (h[24] != 1 || minor > 4)
        return mw__source_fail_at(source, 24, error,
                                  "LAS version %u.%u is not read, only 1.0 to 1.4", h[24], minor);
    if (minor == 4 && header_size >= HEADER_1_4 && have == HEADER_1_4 && mw__get_u64(h + 247) > 0)
        l->count = mw__get_u64(h + 247);
    mw_las_trailer trailer = {0};
    if (minor == 4 && header_size >= HEADER_1_4 && have == HEADER_1_4)
        trailer = (mw_las_trailer){mw__get_u64(h + 235), mw__get_u32(h + 243)};
    for (int k = 0; k < 3; k++) {
        l->scale[k] = mw__get_f64(h + 131 + 8 * k);
        l->offset[k] = mw__get_f64(h + 155 + 8 * k);
    }
    if (format & 0xc0) return las_refuse_laz(source, error);
    if (format >= FORMATS)
        return mw__source_fail_at(source, 104, error, "point format %u is not read, only 0 to %d",
                                  format, FORMATS - 1);
    l->format = format;
    if (l->record_size < layouts[format].size)
        return mw__source_fail_at(source, 105, error,
                                  "the point records have %zu bytes; format %u needs at least %u",
                                  l->record_size, format, layouts[format].size);
    if (header_size < HEADER || points_at < header_size)
        return mw__source_fail_at(source, 94, error,
                                  "the header has %u bytes, but the points begin at byte %" PRIu64,
                                  header_size, points_at);
    status = mw__source_skip(source, header_size, error);
    las_records records = {0};
    if (!status) status = las_read_records(source, points_at, &records, error);
    if (!status) status = las_read_trailer(source, trailer, &records, error);
    if (!status && records.compressed) status = las_refuse_laz(source, error);
    mw_status kept = las_keep_crs(reader, &records, status ? NULL : error);
    return status ? status : kept;
}

/* A name, or a number counted from 1; COLUMN_COUNT if it is neither. */
static size_t las_find_column(const char *item, size_t length)
{
    for (size_t c = 0; c < COLUMN_COUNT; c++)
        if (strlen(column_names[c]) == length && strncasecmp(column_names[c], item, length) == 0)
            return c;
    size_t number = 0;
    for (size_t i = 0; i < length; i++) {
        if (item[i] < '0' || item[i] > '9' || number > COLUMN_COUNT) return COLUMN_COUNT;
        number = 10 * number + (size_t)(item[i] - '0');
    }
    return number >= 1 && number <= COLUMN_COUNT ? number - 1 : COLUMN_COUNT;
}

static mw_status las_select_columns(mw_point_reader *reader, las_reader *l, const char *selection,
                                    mw_error *error)
{
    size_t length;
    bool taken[COLUMN_COUNT] = {false};
    const char *rest = selection ? selection : "x,y,z";
    for (const char *item; (item = mw__selection_item(&rest, &length));) {
        size_t found = las_find_column(item, length);
        int shown = length < 60 ? (int)length : 60;
        if (found == COLUMN_COUNT)
            return mw__fail(error, MW_ERROR_INPUT,
                            "%.240s: LAS has no column '%.*s'; it has x, y, z, intensity, return, "
                            "returns, classification, ...",
                            mw__source_name(&reader->source), shown, item);
        if (taken[found])
            return mw__fail(error, MW_ERROR_ARGUMENT, "columns '%.60s': '%.*s' is selected twice",
                            selection, shown, item);
        taken[found] = true;
        l->columns[reader->width] = (uint8_t)found;
        size_t column = mw__table_header_find(&reader->header, item, length);
        mw_status status = mw__point_reader_add(reader, column_names[found], column, error);
        if (status) return status;
    }
    return MW_OK;
}

/* The columns of the table: those that the point format has. */
static mw_status las_name_table(mw_point_reader *reader, const las_reader *l, mw_error *error)
{
    mw_table_header *header = &reader->header;
    header->names = mw__calloc(COLUMN_COUNT, sizeof *header->names);
    if (!header->names) return mw__fail_memory(error);
    for (las_column c = X; c < COLUMN_COUNT; c++) {
        if (!las_has_column(l, c)) continue;
        header->names[header->count] = strdup(column_names[c]);
        if (!header->names[header->count++]) return mw__fail_memory(error);
    }
    return mw__table_header_commas(header, ' ', error);
}

static mw_status las_select(mw_point_reader *reader, const size_t *columns, size_t count,
                            mw_error *error)
{
    las_reader *l = reader->state;
    for (size_t k = 0; k < count; k++) {
        const char *name = reader->header.names[columns[k]];
        l->columns[k] = (uint8_t)las_find_column(name, strlen(name));
        mw_status status = mw__point_reader_add(reader, name, columns[k], error);
        if (status) return status;
    }
    return MW_OK;
}

mw_status mw__las_start(mw_point_reader *reader, const mw_point_reader_options *options,
                        mw_error *error)
{
    reader->source.binary = true;
    las_reader *l = mw__calloc(1, sizeof *l);
    if (!l) return mw__fail_memory(error);
    reader->state = l;
    reader->read = las_read_points;
    reader->select = las_select;
    memcpy(l->classes, options->classes, sizeof l->classes);
    for (size_t c = 0; c < sizeof l->classes; c++) l->filtered |= l->classes[c] != 0;
    mw_status status = las_read_header(reader, l, error);
    if (!status) status = las_name_table(reader, l, error);
    if (status || (reader->table && !options->columns)) return status;
    return las_select_columns(reader, l, options->columns, error);
}
