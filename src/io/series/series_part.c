#include "io/series/series_kind.h"

#include <stdlib.h>
#include <string.h>

mw_status mw__series_part_add(mw_series_part *part, const char *name, const char *unit,
                              mw_series_field field, mw_error *error)
{
    enum { GROWTH = 32 };
    if (part->field_count % GROWTH == 0) {
        mw_series_field *fields =
            mw__realloc(part->fields, part->field_count + GROWTH, sizeof *fields);
        if (!fields) return mw__fail_memory(error);
        part->fields = fields;
    }
    field.name = strdup(name);
    field.unit = strdup(unit ? unit : "");
    part->fields[part->field_count++] = field;
    return field.name && field.unit ? MW_OK : mw__fail_memory(error);
}

void mw__series_part_release(mw_series_part *part)
{
    if (part->content) part->kind->close(part->content);
    for (size_t f = 0; f < part->field_count; f++) {
        free((void *)(uintptr_t)part->fields[f].name);
        free((void *)(uintptr_t)part->fields[f].unit);
    }
    free(part->fields);
    free(part->times);
    free(part->time_unit);
    free(part->calendar);
    *part = (mw_series_part){0};
}
