#include "bench/paper/paper_print.h"
#include "bench/paper/published.h"
#include "cli/frame/report.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* Four digits after the point hold more than a million queries tell. */
static double value_rounded(double value)
{
    return round(value * 1e4) / 1e4;
}

/* The figures of a result, one after the other. */
typedef struct paper_figure {
    const paper *paper;
    const paper_result *result;
    const algorithm *algorithm;
    quantity quantity;
    double ours, deviation, published, ratio; /* NaN: none */
} paper_figure;

typedef void paper_figure_print(text *t, const paper_figure *f);

static bool paper_has_deviation(const paper *p)
{
    return p->settings->seeds > 1;
}

static void paper_each_quantity(const paper *p, const paper_result *r, const algorithm *a,
                                const double *value, const double *deviation, uint64_t which,
                                text *t, paper_figure_print *print)
{
    for (quantity q = 0; q < QUANTITIES; q++) {
        if (!(which >> q & 1) || (quantity_is_time(q) && p->settings->no_times)) continue;
        paper_figure f = {p,
                          r,
                          a,
                          q,
                          value_rounded(value[q]),
                          paper_has_deviation(p) ? value_rounded(deviation[q]) : NAN,
                          0,
                          0};
        f.published = paper_published_of(p, r, a, q);
        f.ratio = f.published > 0 ? value_rounded(f.ours / f.published) : NAN;
        print(t, &f);
    }
}

static void paper_each_figure(const paper *p, const paper_result *r, text *t,
                              paper_figure_print *print)
{
    const paper_table *table = p->table;
    for (size_t i = 0; r->walks && table->algorithms[i]; i++)
        paper_each_quantity(p, r, table->algorithms[i], r->outcome.value[i], r->deviation.value[i],
                            table->quantities, t, print);
    if (r->whole)
        paper_each_quantity(p, r, table->whole, r->outcome.whole, r->deviation.whole,
                            table->whole_quantities, t, print);
}

/* --format tsv */

static void print_tsv_number(text *t, double value)
{
    text_string(t, "\t");
    if (!isnan(value)) text_double(t, value);
}

static void print_tsv_line(text *t, const paper_figure *f)
{
    text_printf(t, "%s\t", f->paper->table->name);
    for (const char *c = f->result->dataset; *c; c++)
        text_bytes(t, *c == '\t' || *c == '\n' ? " " : c, 1);
    text_printf(t, "\t%zu\t%s\t%s", f->result->outcome.vertices, f->algorithm->name,
                quantity_name(f->quantity));
    print_tsv_number(t, f->ours);
    print_tsv_number(t, f->published);
    print_tsv_number(t, f->ratio);
    if (paper_has_deviation(f->paper)) print_tsv_number(t, f->deviation);
    text_string(t, "\n");
}

/* --format json: an array of objects with the columns of the other format. */

static void print_json_number(text *t, const char *name, double value)
{
    text_printf(t, ", \"%s\": ", name);
    if (isnan(value))
        text_string(t, "null");
    else
        text_double(t, value);
}

static void print_json_object(text *t, const paper_figure *f)
{
    bool first = t->size == 1; /* nothing but the bracket */
    text_printf(t, "%s\n {\"table\": \"%s\", \"dataset\": ", first ? "" : ",",
                f->paper->table->name);
    report_quote(t, f->result->dataset);
    text_printf(t, ", \"vertices\": %zu, \"algorithm\": \"%s\", \"quantity\": \"%s\"",
                f->result->outcome.vertices, f->algorithm->name, quantity_name(f->quantity));
    print_json_number(t, "ours", f->ours);
    print_json_number(t, "published", f->published);
    print_json_number(t, "ratio", f->ratio);
    if (paper_has_deviation(f->paper)) print_json_number(t, "spread", f->deviation);
    text_string(t, "}");
}

/* --format table */

/* A cell of so many letters; empty without a value. */
static void print_cell(text *t, int width, int decimals, double value)
{
    if (isnan(value))
        text_printf(t, " %*s", width, "");
    else
        text_printf(t, " %*.*f", width, decimals, value);
}

/* The blanks of empty cells at the end of a line go. */
static void print_end_line(text *t)
{
    while (t->size > 0 && t->bytes[t->size - 1] == ' ') t->size--;
    text_string(t, "\n");
}

static int quantity_decimals(quantity q)
{
    if (q == LOCATOR_BYTES || q == MESH_TRIANGLES || q == MESH_BORDER_EDGES || q == MESH_HOLES ||
        q == OPTIMAL || q == SAMPLE || q == FOUND_PER_MILLION)
        return 0;
    if (q == LARGEST_ANGLE) return 4;
    return q == CORRELATION || q == LOCATOR_SECONDS || q == TRIANGULATION_SECONDS ? 3 : 2;
}

/* What is zero and not published says nothing, nor do layers where there are none. */
static void print_table_line(text *t, const paper_figure *f)
{
    int decimals = quantity_decimals(f->quantity);
    if (f->ours == 0 && isnan(f->published)) return;
    if (f->quantity == LAYERS && strcmp(f->paper->table->start, "layers") != 0) return;
    text_printf(t, "  %-26s %-4s %-21s", f->algorithm->name, f->algorithm->abbreviation,
                quantity_name(f->quantity));
    print_cell(t, 10, decimals, f->ours);
    if (paper_has_deviation(f->paper)) print_cell(t, 10, decimals, f->deviation);
    print_cell(t, 10, decimals, f->published);
    print_cell(t, 7, 3, f->ratio);
    print_end_line(t);
}

/* A figure of algorithm i over that of the reference, ours and published. Of real data what is
 * published is the least and the largest of the thesis' own real data. */
typedef double paper_proportion(const paper *p, const paper_result *r, size_t i, bool published);

static double proportion_triangles(const paper *p, const paper_result *r, size_t i, bool published)
{
    return paper_sum(p, r, i, PAPER_TRIANGLES, published);
}
static double proportion_tests(const paper *p, const paper_result *r, size_t i, bool published)
{
    return paper_sum(p, r, i, PAPER_TESTS, published) /
           paper_sum(p, r, i, PAPER_TRIANGLES, published);
}
static double proportion_side_length(const paper *p, const paper_result *r, size_t i,
                                     bool published)
{
    return published ? paper_published(p, r, i, SIDE_LENGTH) : r->outcome.value[i][SIDE_LENGTH];
}
static double proportion_time_in_doubles(const paper *p, const paper_result *r, size_t i,
                                         bool published)
{
    return published ? paper_published(p, r, i, TIME_US) : r->outcome.value[i][TIME_US];
}
static double proportion_time_exact(const paper *p, const paper_result *r, size_t i, bool published)
{
    return published ? paper_published(p, r, i, TIME_EXACT_US) : r->outcome.value[i][TIME_EXACT_US];
}

static const struct {
    paper_proportion *of;
    const char *name;
    quantity needs; /* a quantity that the table has, and measures */
} proportions[] = {
    {proportion_triangles, "triangles", TRIANGLES},
    {proportion_tests, "tests per triangle", ORIENT},
    {proportion_side_length, "side length", SIDE_LENGTH},
    {proportion_time_in_doubles, "time", TIME_US},
    {proportion_time_exact, "exact time", TIME_EXACT_US},
};
#define PROPORTIONS (sizeof proportions / sizeof *proportions)

static size_t proportion_reference(const paper_table *table)
{
    size_t i = 0;
    while (table->algorithms[i] != table->reference) i++;
    return i;
}

static double proportion_value(const paper *p, const paper_result *r, size_t i,
                               paper_proportion *of, bool published)
{
    return of(p, r, i, published) / of(p, r, proportion_reference(p->table), published);
}

/* From the least to the largest over the real data of the thesis. */
static void print_range(text *t, const paper *p, size_t i, paper_proportion *of)
{
    double least = INFINITY, most = -INFINITY;
    paper_result r = {.users_file = false};
    const char *set;
    for (size_t k = 0; published_real(p->table->name, k, &set, &r.outcome.vertices); k++) {
        strncpy(r.dataset, set, sizeof r.dataset - 1);
        r.dataset[sizeof r.dataset - 1] = 0;
        double value = proportion_value(p, &r, i, of, true);
        least = fmin(least, value);
        most = fmax(most, value);
    }
    if (least <= most) text_printf(t, "  %.3f to %.3f", least, most);
}

static void print_proportion_line(text *t, const paper *p, const paper_result *r, size_t i,
                                  size_t k)
{
    double ours = proportion_value(p, r, i, proportions[k].of, false);
    double published = proportion_value(p, r, i, proportions[k].of, true);
    text_printf(t, "  %-26s %-4s %-21s", p->table->algorithms[i]->name,
                p->table->algorithms[i]->abbreviation, proportions[k].name);
    print_cell(t, 10, 3, ours);
    if (paper_has_deviation(p)) print_cell(t, 10, 3, NAN);
    if (r->users_file) {
        print_range(t, p, i, proportions[k].of);
    } else {
        print_cell(t, 10, 3, published);
        print_cell(t, 7, 3, ours / published);
    }
    print_end_line(t);
}

static bool paper_has(const paper *p, quantity q)
{
    return p->table->quantities >> q & 1 && !(quantity_is_time(q) && p->settings->no_times);
}

static bool paper_has_range(const paper *p)
{
    const char *set;
    size_t vertices;
    return published_real(p->table->name, 0, &set, &vertices) &&
           !isnan(published_value(p->table->name, set, vertices, p->table->reference->name,
                                  TRIANGLES));
}

static void paper_print_proportions(text *t, const paper *p, const paper_result *r)
{
    text_printf(t, "\n  over those of %s%s\n", p->table->reference->name,
                r->users_file && paper_has_range(p)
                    ? "; published: from the least to the largest of the thesis' real data"
                    : "");
    for (size_t k = 0; k < PROPORTIONS; k++)
        for (size_t i = 0; paper_has(p, proportions[k].needs) && p->table->algorithms[i]; i++)
            if (p->table->algorithms[i] != p->table->reference)
                print_proportion_line(t, p, r, i, k);
}

static void paper_print_local_optima(text *t, const paper *p, const paper_result *r)
{
    for (size_t i = 0; paper_has(p, OPTIMAL) && p->table->algorithms[i]; i++)
        if (r->outcome.value[i][OPTIMAL] == 0)
            text_printf(t, "  %s: a local optimum only\n", p->table->algorithms[i]->name);
}

static bool paper_is_stand_in(const paper_result *r)
{
    return !r->users_file &&
           (strcmp(r->dataset, "cadastre") == 0 || strcmp(r->dataset, "lidar") == 0);
}

static void paper_print_table(text *t, const paper *p)
{
    text_printf(t,
                "%s: %s\n%" PRIu64
                " queries on each set, from %s; means per query, times in microseconds\n",
                p->table->name, p->table->title, p->queries, p->table->from);
    if (paper_has_deviation(p))
        text_printf(t, "means over %" PRIu32 " seeds, and the standard deviation of one\n",
                    p->settings->seeds);
    for (size_t i = 0; i < p->count; i++) {
        const paper_result *r = &p->results[i];
        text_printf(t, "\n%s, %zu vertices", r->dataset, r->outcome.vertices);
        if (paper_is_stand_in(r)) text_string(t, "; a made set in the place of the thesis' own");
        if (r->model[0])
            text_printf(t, "; published: the thesis' %s%s", r->model,
                        r->stands_in ? ", for which it stands in" : "");
        text_string(t, "\n\n");
        text_printf(t, "  %-31s %-21s %10s", "algorithm", "quantity", "ours");
        if (paper_has_deviation(p)) text_printf(t, " %10s", "spread");
        text_printf(t, " %10s %7s\n", "published", "ratio");
        paper_each_figure(p, r, t, print_table_line);
        if (!r->walks) continue;
        paper_print_local_optima(t, p, r);
        if (p->table->algorithms[1]) paper_print_proportions(t, p, r);
    }
}

void paper_print(const paper *p, text *t)
{
    switch (p->settings->format) {
    case FORMAT_TSV:
        text_string(t, "table\tdataset\tvertices\talgorithm\tquantity\tours\tpublished\tratio");
        text_string(t, paper_has_deviation(p) ? "\tspread\n" : "\n");
        for (size_t i = 0; i < p->count; i++)
            paper_each_figure(p, &p->results[i], t, print_tsv_line);
        break;
    case FORMAT_JSON:
        text_string(t, "[");
        for (size_t i = 0; i < p->count; i++)
            paper_each_figure(p, &p->results[i], t, print_json_object);
        text_string(t, "\n]\n");
        break;
    default: paper_print_table(t, p);
    }
}
