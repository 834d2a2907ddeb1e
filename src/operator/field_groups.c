/* field_groups.c - fields one after another, of scattered columns or rows, a group of them at a
 * time.
 *
 * A group is as many fields as a cache line has room for values. Its values are brought side by
 * side, a line for each column (field_rows.c), in the order in which the ranks use the columns;
 * then line_sums.c makes a line of results for each row; then the lines go back to the fields. So
 * memory is read in order, and lines that go anywhere are written whole, past the caches.
 *
 * The lines take 64 bytes for each row and column. To get so much memory from the system takes a
 * fifth of a call's time. So a call leaves them to the operator for the next call. */
#include "operator/field_groups.h"

#include "operator/column_places.h"
#include "operator/field_rows.h"
#include "operator/line_sums.h"
#include "operator/past_caches.h"

#include <stdlib.h>

enum { RANGE = 1 << 14 }; /* ranks of a chunk of work */

/* Do consecutive ranks mostly read values that are far apart? */
static bool columns_jump(const mw_operator *o)
{
    enum { LOOKS = 256, FAR = 4096 };
    const size_t apart = o->rows / LOOKS;
    size_t far = 0;
    for (size_t i = 0; i < LOOKS && apart > 1 && o->entries > 0; i++) {
        const uint64_t a = mw__operator_first(o, i * apart),
                       b = mw__operator_first(o, i * apart + 1);
        if (b >= mw__operator_first(o, o->rows)) continue;
        const uint32_t x = o->column[a], y = o->column[b];
        far += (x > y ? x - y : y - x) >= FAR;
    }
    return far > LOOKS / 4;
}

/* Yes if most columns are used and a field is larger than the nearest caches. */
bool mw__field_groups_repay(const mw_apply_call *c)
{
    enum { FEWEST = 4, MANY = 1 << 12 };
    const mw_operator *o = c->o;
    return c->step > 1 && c->count >= FEWEST && o->columns >= MANY && o->rows >= o->columns / 2 &&
           (o->row || columns_jump(o));
}

/* --- memory ----------------------------------------------------------------------------------- */

/* A line for each column and then one for each row. A call takes those of the operator, or makes
 * them if another call has them. */
static char *group_lines_take(const mw_operator *o)
{
    char *lines = atomic_exchange(&((mw_operator *)o)->lines, NULL);
    return lines ? lines : mw__alloc_lines(o->columns + (uint64_t)o->rows, MW_CACHE_LINE);
}

static void group_lines_give_back(const mw_operator *o, char *lines)
{
    free(atomic_exchange(&((mw_operator *)o)->lines, lines));
}

/* --- groups ----------------------------------------------------------------------------------- */

/* The fields of a group as lines, and the operator whose columns are in the order of these. */
typedef struct field_group {
    mw_field_rows in, out;
    mw_operator placed;
    mw_apply_call sums;
} field_group;

static mw_operator operator_placed(const mw_operator *o, const uint32_t *places)
{
    return (mw_operator){.rows = o->rows,
                         .columns = o->columns,
                         .entries = o->entries,
                         .row = o->row,
                         .first = o->first,
                         .column = (uint32_t *)places + o->columns,
                         .weight = o->weight};
}

static field_group group_begin(const mw_apply_call *c, const uint32_t *places, char *lines)
{
    const mw_operator *o = c->o;
    const size_t size = mw__operand_size(c->narrow), width = MW_CACHE_LINE / size;
    field_group g = {.placed = operator_placed(o, places), .sums = *c};
    g.in = (mw_field_rows){.place = places,
                           .rows = lines,
                           .n = o->columns,
                           .size = size,
                           .stride = c->stride,
                           .step = c->step};
    g.out = (mw_field_rows){.rows = lines + o->columns * (size_t)MW_CACHE_LINE,
                            .n = o->rows,
                            .size = size,
                            .stride = 1,
                            .step = c->field};
    g.sums.values = g.in.rows;
    g.sums.result = g.out.rows;
    g.sums.count = g.sums.fields = g.sums.stride = g.sums.row = width;
    g.sums.step = g.sums.field = 1;
    g.sums.past_caches = true;
    return g;
}

/* The fields from k on. */
static void group_set_fields(field_group *g, const mw_apply_call *c, size_t k)
{
    const size_t left = c->count - k, width = g->sums.count;
    g->in.fields = (char *)c->values + k * c->step * g->in.size;
    g->out.fields = (char *)c->result + k * c->field * g->in.size;
    g->in.count = g->out.count = left < width ? left : width;
}

static void group_sum_range(void *work, uint64_t chunk, uint32_t member)
{
    const mw_apply_call *c = work;
    const size_t from = chunk * RANGE, left = c->o->rows - from;
    (void)member;
    mw__line_sums(c, from, from + (left < RANGE ? left : RANGE));
}

/* Part `part` of three of a group. */
static bool group_part(field_group *g, int part, mw_job *job)
{
    const uint64_t ranges = (g->placed.rows + (uint64_t)RANGE - 1) / RANGE;
    if (part == 0) return mw__field_rows_copy(&g->in, job);
    if (part == 2) return mw__field_rows_copy(&g->out, job);
    g->sums.o = &g->placed;
    return mw__job_chunks(job, mw__job_team(job, ranges), ranges, group_sum_range, &g->sums);
}

static void groups_apply(const mw_apply_call *c, const uint32_t *places, char *lines, mw_job *job)
{
    field_group g = group_begin(c, places, lines);
    bool on = true;
    for (size_t k = 0; k < c->count && on; k += g.sums.count) {
        group_set_fields(&g, c, k);
        const uint64_t n = g.in.count;
        for (int part = 0; part < 3 && on; part++) {
            mw_job_span outer = mw__job_steps_of(job, 3 * k + (uint64_t)part * n, n, 3 * c->count);
            on = group_part(&g, part, job);
            mw__job_steps_end(job, outer);
        }
    }
}

bool mw__field_groups_apply(const mw_apply_call *c, mw_job *job)
{
    const uint32_t *places = mw__column_places(c->o);
    char *lines = places ? group_lines_take(c->o) : NULL;
    if (!lines) return false;
    groups_apply(c, places, lines, job);
    group_lines_give_back(c->o, lines);
    return true;
}
