#include "io/series/series_kind.h"

#include <stdlib.h>
#include <string.h>

/* The texts of a field. */
enum { FIELD_TEXTS = 4 };

static void field_texts(mw_series_field *field, const char **texts[FIELD_TEXTS])
{
    texts[0] = &field->name;
    texts[1] = &field->unit;
    texts[2] = &field->long_name;
    texts[3] = &field->standard_name;
}

mw_status mw__series_part_add(mw_series_part *part, mw_series_field field, mw_error *error)
{
    enum { GROWTH = 32 };
    if (part->field_count % GROWTH == 0) {
        mw_series_field *fields =
            mw__realloc(part->fields, part->field_count + GROWTH, sizeof *fields);
        if (!fields) return mw__fail_memory(error);
        part->fields = fields;
    }
    const char **texts[FIELD_TEXTS];
    bool copied = true;
    field_texts(&field, texts);
    for (size_t k = 0; k < FIELD_TEXTS; k++) {
        *texts[k] = strdup(*texts[k] ? *texts[k] : "");
        copied = copied && *texts[k];
    }
    part->fields[part->field_count++] = field;
    return copied ? MW_OK : mw__fail_memory(error);
}

void mw__series_part_release(mw_series_part *part)
{
    if (part->content) part->kind->close(part->content);
    for (size_t f = 0; f < part->field_count; f++) {
        const char **texts[FIELD_TEXTS];
        field_texts(&part->fields[f], texts);
        for (size_t k = 0; k < FIELD_TEXTS; k++) free((void *)(uintptr_t)*texts[k]);
    }
    free(part->fields);
    free(part->times);
    free(part->time_unit);
    free(part->calendar);
    *part = (mw_series_part){0};
}
