#include "cli/constraints/feature_values.h"
#include "cli/frame/message.h"
#include "src/base/posix.h"

#include <stdlib.h>
#include <string.h>

static int values_fail_name(const char *path, const char *name, size_t length,
                            const char *const *names, size_t count)
{
    text list = {0};
    for (size_t i = 0; i < count; i++) text_printf(&list, "%s%s", i ? ", " : "", names[i]);
    int size = list.size < 1000 ? (int)list.size : 1000;
    if (count > 0 && !list.failed)
        complain("%s: has no attribute '%.*s'; it has: %.*s", path, (int)length, name, size,
                 list.bytes);
    else
        complain("%s: has no attributes, so not '%.*s' either", path, (int)length, name);
    text_release(&list);
    return END_INPUT;
}

/* The attribute of a name; letters of another case count only where no name is the same. `count` if
 * there is none. */
static size_t values_find(const char *name, size_t length, const char *const *names, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strlen(names[i]) == length && strncmp(names[i], name, length) == 0) return i;
    for (size_t i = 0; i < count; i++)
        if (strlen(names[i]) == length && strncasecmp(names[i], name, length) == 0) return i;
    return count;
}

static bool values_take(feature_values *v, size_t field, const char *name, char kind)
{
    char **names = realloc(v->names, (v->count + 1) * sizeof *names);
    if (names) v->names = names;
    char *kinds = realloc(v->kinds, v->count + 1);
    if (kinds) v->kinds = kinds;
    size_t *fields = realloc(v->fields, (v->count + 1) * sizeof *fields);
    if (fields) v->fields = fields;
    if (!names || !kinds || !fields || !(names[v->count] = strdup(name))) return false;
    kinds[v->count] = kind;
    fields[v->count++] = field;
    return true;
}

int feature_values_choose(feature_values *v, const char *path, const char *const *names,
                          const char *kinds, size_t count)
{
    for (size_t i = 0; !v->list && i < count; i++)
        if (!values_take(v, i, names[i], kinds[i])) return fail_memory();
    if (!v->list) return 0;
    size_t whole = values_find(v->list, strlen(v->list), names, count);
    if (whole < count) return values_take(v, whole, names[whole], kinds[whole]) ? 0 : fail_memory();
    for (const char *name = v->list;; name++) {
        size_t length = strcspn(name, ","), field = values_find(name, length, names, count);
        if (field == count) return values_fail_name(path, name, length, names, count);
        if (!values_take(v, field, names[field], kinds[field])) return fail_memory();
        name += length;
        if (!*name) return 0;
    }
}

bool feature_values_add(feature_values *v, const char *cell)
{
    if (v->cell_count == v->cell_room) {
        size_t room = 2 * v->cell_room + 1024;
        size_t *begin = realloc(v->begin, room * sizeof *begin);
        if (!begin) return false;
        v->begin = begin;
        v->cell_room = room;
    }
    v->begin[v->cell_count++] = v->cells.size;
    text_bytes(&v->cells, cell, strlen(cell) + 1);
    return !v->cells.failed;
}

const char *feature_values_cell(const feature_values *v, size_t feature, size_t i)
{
    return v->cells.bytes + v->begin[feature * v->count + i];
}

void feature_values_release(feature_values *v)
{
    for (size_t i = 0; i < v->count; i++) free(v->names[i]);
    free(v->names);
    free(v->kinds);
    free(v->fields);
    free(v->begin);
    text_release(&v->cells);
    *v = (feature_values){0};
}
