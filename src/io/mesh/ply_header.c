#include "io/mesh/ply_header.h"

#include "io/text/crs_text.h"
#include "io/text/number_text.h"

#include <stdlib.h>
#include <string.h>

enum { ELEMENT_LIMIT = 256, PROPERTY_LIMIT = 4096 };

static const struct {
    const char *name;
    mw_ply_number number;
} types[] = {
    {"char", {MW_PLY_SIGNED, 1}},     {"int8", {MW_PLY_SIGNED, 1}},
    {"uchar", {MW_PLY_UNSIGNED, 1}},  {"uint8", {MW_PLY_UNSIGNED, 1}},
    {"short", {MW_PLY_SIGNED, 2}},    {"int16", {MW_PLY_SIGNED, 2}},
    {"ushort", {MW_PLY_UNSIGNED, 2}}, {"uint16", {MW_PLY_UNSIGNED, 2}},
    {"int", {MW_PLY_SIGNED, 4}},      {"int32", {MW_PLY_SIGNED, 4}},
    {"uint", {MW_PLY_UNSIGNED, 4}},   {"uint32", {MW_PLY_UNSIGNED, 4}},
    {"float", {MW_PLY_FLOAT, 4}},     {"float32", {MW_PLY_FLOAT, 4}},
    {"double", {MW_PLY_FLOAT, 8}},    {"float64", {MW_PLY_FLOAT, 8}},
    {"int64", {MW_PLY_SIGNED, 8}},    {"uint64", {MW_PLY_UNSIGNED, 8}},
};

/* Cut the next word off *rest; "" at the end. */
static char *ply_next_word(char **rest)
{
    char *word = mw__skip_blanks(*rest), *end = word;
    while (!mw__at_gap(end)) end++;
    *rest = *end ? end + 1 : end;
    *end = 0;
    return word;
}

static mw_status ply_read_type(const mw_source *source, const char *word, mw_ply_number *number,
                               mw_error *error)
{
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(word, types[i].name) == 0) {
            *number = types[i].number;
            return MW_OK;
        }
    return mw__source_fail(source, error, "'%s' is not a property type", mw__excerpt(word).text);
}

static mw_status ply_read_format(const mw_source *source, char *rest, mw_ply_kind *kind,
                                 mw_error *error)
{
    static const char *const kinds[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const char *word = ply_next_word(&rest), *version = ply_next_word(&rest);
    for (unsigned i = 0; i < 3; i++)
        if (strcmp(word, kinds[i]) == 0 && strcmp(version, "1.0") == 0) {
            *kind = (mw_ply_kind)i;
            return MW_OK;
        }
    return mw__source_fail(
        source, error,
        "the format has to be 'ascii 1.0', 'binary_little_endian 1.0' or 'binary_big_endian 1.0'");
}

static mw_status ply_add_element(const mw_source *source, char *rest, mw_ply_header *header,
                                 mw_error *error)
{
    const char *name = ply_next_word(&rest), *text = ply_next_word(&rest);
    int64_t count;
    const char *end = mw__read_integer(text, &count);
    if (!*name || !end || *end || count < 0)
        return mw__source_fail(source, error, "expected 'element', a name and a count");
    if (!mw__integer_fits(count)) return mw__source_fail_large(source, text, end, error);
    if (header->element_count == ELEMENT_LIMIT)
        return mw__source_fail(source, error, "more than %d elements", ELEMENT_LIMIT);
    for (size_t e = 0; e < header->element_count; e++)
        if (strcmp(header->elements[e].name, name) == 0)
            return mw__source_fail(source, error, "there is a second element '%s'",
                                   mw__excerpt(name).text);
    mw_ply_element *elements =
        mw__realloc(header->elements, header->element_count + 1, sizeof *elements);
    if (!elements) return mw__fail_memory(error);
    header->elements = elements;
    mw_ply_element *element = &elements[header->element_count];
    *element = (mw_ply_element){.name = strdup(name), .count = (uint64_t)count};
    if (!element->name) return mw__fail_memory(error);
    header->element_count++;
    return MW_OK;
}

static mw_status ply_add_property(const mw_source *source, char *rest, mw_ply_header *header,
                                  mw_error *error)
{
    if (header->element_count == 0)
        return mw__source_fail(source, error, "a property stands before the first element");
    mw_ply_element *element = &header->elements[header->element_count - 1];
    mw_ply_property property = {0};
    const char *word = ply_next_word(&rest);
    mw_status status = MW_OK;
    property.list = strcmp(word, "list") == 0;
    if (property.list) {
        status = ply_read_type(source, ply_next_word(&rest), &property.count, error);
        word = ply_next_word(&rest);
    }
    if (!status) status = ply_read_type(source, word, &property.number, error);
    if (status) return status;
    const char *name = ply_next_word(&rest);
    if (property.list && property.count.type == MW_PLY_FLOAT)
        return mw__source_fail(source, error, "the count of a list has to be an integer");
    if (!*name) return mw__source_fail(source, error, "a property has no name");
    if (mw__ply_property(element, name) < element->property_count)
        return mw__source_fail(source, error, "the element has a second property '%s'",
                               mw__excerpt(name).text);
    if (element->property_count == PROPERTY_LIMIT)
        return mw__source_fail(source, error, "more than %d properties", PROPERTY_LIMIT);
    mw_ply_property *properties =
        mw__realloc(element->properties, element->property_count + 1, sizeof *properties);
    if (!properties) return mw__fail_memory(error);
    element->properties = properties;
    property.name = strdup(name);
    if (!property.name) return mw__fail_memory(error);
    properties[element->property_count++] = property;
    return MW_OK;
}

/* "comment crs ..." names the coordinate system, as MDAL reads it. The first one counts. */
static mw_status ply_read_comment(char *rest, mw_ply_header *header, mw_error *error)
{
    if (header->crs || strcmp(ply_next_word(&rest), "crs") != 0) return MW_OK;
    return mw__crs_copy(rest, strlen(rest), &header->crs, error);
}

mw_status mw__ply_read_header(mw_source *source, mw_ply_header *header, mw_error *error)
{
    *header = (mw_ply_header){0};
    bool have_format = false;
    for (;;) {
        char *line;
        mw_status status = mw__source_line(source, &line, error);
        if (status) return status;
        if (!line) return mw__source_fail(source, error, "the file ends before 'end_header'");
        const char *word = ply_next_word(&line);
        if (source->line == 1) {
            if (strcmp(word, "ply") != 0)
                return mw__source_fail(source, error, "a PLY file begins with 'ply'");
        } else if (strcmp(word, "format") == 0) {
            status = ply_read_format(source, line, &header->kind, error);
            have_format = true;
        } else if (strcmp(word, "element") == 0) {
            status = ply_add_element(source, line, header, error);
        } else if (strcmp(word, "property") == 0) {
            status = ply_add_property(source, line, header, error);
        } else if (strcmp(word, "comment") == 0) {
            status = ply_read_comment(line, header, error);
        } else if (strcmp(word, "end_header") == 0) {
            return have_format
                       ? MW_OK
                       : mw__source_fail(source, error, "the line with the format is missing");
        } else if (*word && strcmp(word, "obj_info") != 0) {
            return mw__source_fail(source, error, "'%s' was not expected in the header",
                                   mw__excerpt(word).text);
        }
        if (status) return status;
    }
}

void mw__ply_release_header(mw_ply_header *header)
{
    for (size_t e = 0; e < header->element_count; e++) {
        mw_ply_element *element = &header->elements[e];
        for (size_t p = 0; p < element->property_count; p++) free(element->properties[p].name);
        free(element->properties);
        free(element->name);
    }
    free(header->elements);
    free(header->crs);
    *header = (mw_ply_header){0};
}

size_t mw__ply_property(const mw_ply_element *element, const char *name)
{
    size_t p = 0;
    while (p < element->property_count && strcmp(element->properties[p].name, name) != 0) p++;
    return p;
}
