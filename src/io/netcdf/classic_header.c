/* The grammar of the header stands in the specification of the classic formats (CDF-1, 2 and 5):
 * three lists, of dimensions, attributes and variables, each with a tag and a count. */
#include "io/netcdf/classic_header.h"

#include <inttypes.h>
#include <string.h>

enum { LONGEST_NAME = 256 };
enum { TAG_NONE = 0, TAG_DIMENSIONS = 10, TAG_VARIABLES = 11, TAG_ATTRIBUTES = 12 };

typedef struct classic_header {
    mw_source *source;
    size_t count_size;  /* bytes of a count: 8 in CDF-5 */
    size_t offset_size; /* bytes of a position in the file: 4 in CDF-1 */
    mw_error *error;
} classic_header;

static mw_status classic_integer(const classic_header *header, size_t size, uint64_t *value)
{
    const unsigned char *bytes;
    mw_status status = mw__source_bytes(header->source, size, &bytes, header->error);
    *value = 0;
    for (size_t i = 0; i < size && !status; i++) *value = *value << 8 | bytes[i];
    return status;
}

static mw_status classic_count(const classic_header *header, uint64_t *value)
{
    return classic_integer(header, header->count_size, value);
}

/* Bytes that are padded to a multiple of four. */
static mw_status classic_skip(const classic_header *header, uint64_t size)
{
    if (size > UINT64_MAX / 2) size = UINT64_MAX / 2;
    return mw__source_skip(header->source, (size + 3) / 4 * 4, header->error);
}

static mw_status classic_name(const classic_header *header)
{
    uint64_t length;
    mw_status status = classic_count(header, &length);
    if (status) return status;
    if (length > LONGEST_NAME) /* libnetcdf would copy it into a buffer for so many */
        return mw__source_fail(header->source, header->error,
                               "the header of the file is damaged: a name of %" PRIu64 " bytes",
                               length);
    return classic_skip(header, length);
}

/* The beginning of a list: its count, 0 for a list that is not there. */
static mw_status classic_list(const classic_header *header, uint64_t tag, uint64_t *count)
{
    uint64_t found;
    mw_status status = classic_integer(header, 4, &found);
    if (!status) status = classic_count(header, count);
    if (status || found == tag || (found == TAG_NONE && *count == 0)) return status;
    return mw__source_fail(header->source, header->error,
                           "the header of the file is damaged: %" PRIu64 " instead of the tag "
                           "%" PRIu64,
                           found, tag);
}

static mw_status classic_dimensions(const classic_header *header)
{
    uint64_t count, length;
    mw_status status = classic_list(header, TAG_DIMENSIONS, &count);
    for (uint64_t i = 0; i < count && !status; i++) {
        status = classic_name(header);
        if (!status) status = classic_count(header, &length);
    }
    return status;
}

static mw_status classic_type(const classic_header *header, uint64_t *size)
{
    static const unsigned char sizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    uint64_t type;
    mw_status status = classic_integer(header, 4, &type);
    if (status) return status;
    if (type == 0 || type >= sizeof sizes)
        return mw__source_fail(header->source, header->error,
                               "the header of the file is damaged: no type %" PRIu64, type);
    *size = sizes[type];
    return MW_OK;
}

static mw_status classic_attributes(const classic_header *header)
{
    uint64_t count, values, size = 0;
    mw_status status = classic_list(header, TAG_ATTRIBUTES, &count);
    for (uint64_t i = 0; i < count && !status; i++) {
        status = classic_name(header);
        if (!status) status = classic_type(header, &size);
        if (!status) status = classic_count(header, &values);
        if (!status)
            status = classic_skip(header, values > UINT64_MAX / 16 ? values : values * size);
    }
    return status;
}

static mw_status classic_variables(const classic_header *header)
{
    uint64_t count, rank, size;
    mw_status status = classic_list(header, TAG_VARIABLES, &count);
    for (uint64_t i = 0; i < count && !status; i++) {
        status = classic_name(header);
        if (!status) status = classic_count(header, &rank);
        for (uint64_t k = 0; k < rank && !status; k++) status = classic_count(header, &size);
        if (!status) status = classic_attributes(header);
        if (!status) status = classic_type(header, &size);
        if (!status) status = classic_count(header, &size);
        if (!status) status = classic_integer(header, header->offset_size, &size);
    }
    return status;
}

mw_status mw__classic_header_check(mw_source *source, mw_error *error)
{
    const char *head;
    size_t size;
    uint64_t ignored;
    mw_status status = mw__source_peek(source, 4, &head, &size, error);
    if (status || size < 4 || memcmp(head, "CDF", 3) != 0) return status;
    char version = head[3];
    classic_header header = {.source = source,
                             .count_size = version == 5 ? 8 : 4,
                             .offset_size = version == 1 ? 4 : 8,
                             .error = error};
    source->binary = true;
    status = classic_integer(&header, 4, &ignored);
    if (!status) status = classic_count(&header, &ignored); /* records */
    if (!status) status = classic_dimensions(&header);
    if (!status) status = classic_attributes(&header);
    if (!status) status = classic_variables(&header);
    return status;
}
