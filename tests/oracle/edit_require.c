/* edit_require.c - the end of a test that failed, and memory that has to be there. */
#include "oracle/edit_require.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

edit_case_now edit_case = {.name = ""};

void require_failed(const char *what, const char *file, int line)
{
    static const char *const kinds[] = {"insert",    "remove",  "move", "flip",
                                        "constrain", "release", "value"};
    const mw_edit *e = &edit_case.edit;
    fprintf(stderr,
            "%s:%d: not so: %s\n%s, seed %llu, step %llu: %s %u %u, field %u, to %.17g %.17g, "
            "value %g\n",
            file, line, what, edit_case.name, (unsigned long long)edit_case.seed,
            (unsigned long long)edit_case.step,
            (unsigned)e->kind < MW_EDIT_KIND_COUNT ? kinds[e->kind] : "?", e->vertex, e->other,
            e->field, e->x, e->y, e->value);
    abort();
}

void *require_room(size_t count, size_t size)
{
    void *memory = calloc(count + 1, size);
    REQUIRE(memory != NULL);
    return memory;
}

void *require_more_room(void *memory, size_t count, size_t size)
{
    memory = realloc(memory, (count + 1) * size);
    REQUIRE(memory != NULL);
    return memory;
}

void *require_copy(const void *memory, size_t count, size_t size)
{
    void *copy = require_room(count, size);
    if (count) memcpy(copy, memory, count * size);
    return copy;
}
