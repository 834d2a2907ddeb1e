/* bench worst: meshes on which point location, or making a mesh, may be slow. One row for each trap
 * and size, so that the growth shows. */
#include "bench/worst/bench_worst.h"
#include "bench/core/word_list.h"
#include "bench/worst/trap.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/spelling.h"

#include <math.h>
#include <string.h>

enum { QUERIES = 100000, ROUNDS = 3, FEWEST_VERTICES = 100 };

typedef struct worst_run {
    const bench_settings *settings;
    size_list sizes;
    text table;
} worst_run;

static int worst_named(const char *name)
{
    int i = 0;
    while (trap_name(i) && strcmp(trap_name(i), name) != 0) i++;
    return trap_name(i) ? i : -1;
}

static int worst_check_name(const char *name, void *self)
{
    (void)self;
    if (worst_named(name) >= 0) return 0;
    spelling s = spelling_of(name);
    for (int i = 0; trap_name(i); i++) spelling_try(&s, trap_name(i));
    spelling_complain(&s, "trap", "");
    return END_USAGE;
}

static int worst_check_settings(const bench_settings *s)
{
    if (s->enclose != ENCLOSE_AUTO || s->no_times || s->data || s->plot || s->engines || s->tasks ||
        s->format == FORMAT_JSON) {
        complain("bench worst makes its own meshes, takes times of meshwalk alone, and prints "
                 "them with --format table or tsv");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

static const char *const columns[] = {"build_s", "batch_us", "single_us", "steps", "bytes"};
enum { COLUMNS = sizeof columns / sizeof *columns };

static void worst_print_header(worst_run *r)
{
    bool tsv = r->settings->format == FORMAT_TSV;
    text_printf(&r->table, tsv ? "%s\t%s" : "%-16s %9s", "trap", "vertices");
    for (int k = 0; k < COLUMNS; k++) text_printf(&r->table, tsv ? "\t%s" : " %12s", columns[k]);
    text_string(&r->table, "\n");
}

static void worst_print_row(worst_run *r, int trap, size_t vertices, const trap_figures *f)
{
    const double figures[COLUMNS] = {f->build, f->batch, f->alone, f->steps, f->bytes};
    bool tsv = r->settings->format == FORMAT_TSV;
    text_printf(&r->table, tsv ? "%s\t%zu" : "%-16s %9zu", trap_name(trap), vertices);
    for (int k = 0; k < COLUMNS; k++) {
        if (isnan(figures[k]))
            text_printf(&r->table, tsv ? "\t" : " %12s", "");
        else
            text_printf(&r->table, tsv ? "\t%.6g" : " %12.6g", figures[k]);
    }
    text_string(&r->table, "\n");
}

static int worst_run_trap(const char *name, void *self)
{
    worst_run *r = self;
    const bench_settings *s = r->settings;
    int trap = worst_named(name), end = 0;
    for (size_t i = 0; i < r->sizes.count && end == 0; i++) {
        trap_figures figures;
        trap_plan plan = {.vertices = r->sizes.size[i],
                          .queries = s->queries ? s->queries : QUERIES,
                          .rounds = s->rounds ? s->rounds : ROUNDS,
                          .seed = s->common.seed};
        if (plan.vertices < FEWEST_VERTICES) plan.vertices = FEWEST_VERTICES;
        progress_phase(trap_help(trap), name);
        end = trap_measure(trap, &plan, &figures);
        if (end == 0) worst_print_row(r, trap, plan.vertices, &figures);
    }
    return end;
}

static int worst_run_all(worst_run *r)
{
    int end = 0;
    for (int i = 0; trap_name(i) && end == 0; i++) end = worst_run_trap(trap_name(i), r);
    return end;
}

int bench_worst(const bench_settings *s, const char *traps)
{
    worst_run r = {.settings = s, .sizes = {{1000, 10000, 100000, 1000000}, 4}};
    int end = worst_check_settings(s);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &r.sizes);
    if (end == 0 && traps) end = word_list_each(traps, worst_check_name, NULL);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    if (end == 0) {
        worst_print_header(&r);
        end = traps ? word_list_each(traps, worst_run_trap, &r) : worst_run_all(&r);
    }
    if (end == 0) return files_write_text(s->common.output, &r.table);
    text_release(&r.table);
    return end;
}
