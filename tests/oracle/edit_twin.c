/* edit_twin.c - a twin of an editor: copied, released; its constraints. */
#include "oracle/edit_twin.h"

#include <stdlib.h>
#include <string.h>

const char *const twin_field[TWIN_FIELDS] = {"height", "mark"};
bool twin_bare;

/* --- constraints ------------------------------------------------------------------------------ */

static size_t fixed_index(const twin *t, uint32_t a, uint32_t b)
{
    size_t i = 0;
    while (i < t->fixed_count &&
           !(t->fixed[2 * i] == (a < b ? a : b) && t->fixed[2 * i + 1] == (a < b ? b : a)))
        i++;
    return i;
}

bool twin_is_fixed(const twin *t, uint32_t a, uint32_t b)
{
    return fixed_index(t, a, b) < t->fixed_count;
}

void twin_fix(twin *t, uint32_t a, uint32_t b)
{
    if (twin_is_fixed(t, a, b)) return;
    t->fixed = require_more_room(t->fixed, 2 * (t->fixed_count + 1), sizeof *t->fixed);
    t->fixed[2 * t->fixed_count] = a < b ? a : b;
    t->fixed[2 * t->fixed_count++ + 1] = a < b ? b : a;
}

void twin_unfix(twin *t, uint32_t a, uint32_t b)
{
    size_t i = fixed_index(t, a, b);
    REQUIRE(i < t->fixed_count);
    t->fixed_count--;
    memcpy(t->fixed + 2 * i, t->fixed + 2 * t->fixed_count, 2 * sizeof *t->fixed);
}

/* --- made, copied, released ------------------------------------------------------------------- */

void twin_close(twin *t)
{
    if (!t->shared) {
        mw_editor_destroy(t->editor);
        mw_locator_destroy(t->first_locator);
        mw_mesh_destroy(t->first);
    }
    free(t->point);
    free(t->state);
    free(t->triangle);
    for (int f = 0; f < TWIN_FIELDS; f++) free(t->value[f]);
    free(t->fixed);
    free(t->border);
}

twin twin_copy(const twin *t)
{
    twin c = *t;
    c.shared = true;
    c.point = require_copy(t->point, 2 * (size_t)t->vertex_range, sizeof *c.point);
    c.state = require_copy(t->state, t->vertex_range, 1);
    c.triangle = require_copy(t->triangle, 3 * (size_t)t->triangle_range, sizeof *c.triangle);
    for (int f = 0; f < TWIN_FIELDS; f++)
        c.value[f] = require_copy(t->value[f], t->vertex_range, sizeof(double));
    c.fixed = require_copy(t->fixed, 2 * t->fixed_count, sizeof *c.fixed);
    c.border = require_copy(t->border, 4 * t->border_count, sizeof *c.border);
    return c;
}
