/* bench worst: meshes on which point location, or making a mesh, may be slow, and other libraries
 * on the same. One row for each trap and size, so that the growth shows. */
#include "bench/worst/bench_worst.h"
#include "bench/core/word_list.h"
#include "bench/peers/engine_list.h"
#include "bench/worst/trap.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/spelling.h"

#include <math.h>
#include <string.h>

enum { QUERIES = 100000, ROUNDS = 3, FEWEST_VERTICES = 100 };
static const double TOO_LONG = 60; /* for a peer to build, seconds */

typedef struct worst_run {
    const bench_settings *settings;
    size_list sizes;
    uint32_t engines; /* a bit for each */
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
    if (s->enclose != ENCLOSE_AUTO || s->no_times || s->data || s->plot || s->tasks ||
        s->format == FORMAT_JSON) {
        complain("bench worst makes its own meshes, and prints times with --format table or tsv");
        return END_USAGE;
    }
    return options_limit("rounds", s->rounds, 1000, NULL);
}

/* The engines that --engines names; without it those of three libraries that are there. */
static int worst_choose_engines(worst_run *r)
{
    static const engine_id usual[] = {ENGINE_GEOS, ENGINE_EMBREE_SINGLE, ENGINE_CGAL_HIERARCHY,
                                      ENGINE_CGAL};
    if (r->settings->engines) return engine_list_named(r->settings->engines, &r->engines);
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++)
        if (engine_code_of(usual[i])) r->engines |= UINT32_C(1) << usual[i];
    return 0;
}

static const char *const columns[] = {"build_s", "batch_us", "single_us", "steps", "bytes"};
static const char *const peer_columns[] = {"build_s", "us", "wrong"};
enum { COLUMNS = sizeof columns / sizeof *columns, PEER_COLUMNS = 3, FIGURE = 12 };

/* One that only triangulates has no queries. */
static int worst_peer_columns(const worst_run *r, engine_id id)
{
    if (!engine_is_in(r->engines, id)) return 0;
    return engine_code_of(id)->locate ? PEER_COLUMNS : 1;
}

/* The peers' columns are as wide as their names, or as figures. */
static int worst_name_width(engine_id id, int column)
{
    return (int)(strlen(engines[id].name) + 1 + strlen(peer_columns[column]));
}

static int worst_indent(engine_id id, int column)
{
    int name = worst_name_width(id, column);
    return name < FIGURE ? FIGURE - name : 0;
}

static int worst_width(engine_id id, int column)
{
    return worst_indent(id, column) + worst_name_width(id, column);
}

static void worst_print_header(worst_run *r)
{
    bool tsv = r->settings->format == FORMAT_TSV;
    text_printf(&r->table, tsv ? "%s\t%s" : "%-16s %9s", "trap", "vertices");
    for (int k = 0; k < COLUMNS; k++) text_printf(&r->table, tsv ? "\t%s" : " %12s", columns[k]);
    for (engine_id id = 0; id < ENGINES; id++)
        for (int k = 0; k < worst_peer_columns(r, id); k++) {
            text_string(&r->table, tsv ? "\t" : " ");
            text_printf(&r->table, "%*s%s_%s", tsv ? 0 : worst_indent(id, k), "", engines[id].name,
                        peer_columns[k]);
        }
    text_string(&r->table, "\n");
}

static void worst_print_figure(worst_run *r, int width, double figure)
{
    bool tsv = r->settings->format == FORMAT_TSV;
    text_string(&r->table, tsv ? "\t" : " ");
    if (isnan(figure))
        text_printf(&r->table, "%*s", tsv ? 0 : width, "");
    else
        text_printf(&r->table, "%*.6g", tsv ? 0 : width, figure);
}

static void worst_print_row(worst_run *r, int trap, size_t vertices, const trap_figures *f)
{
    const double figures[COLUMNS] = {f->build, f->batch, f->alone, f->steps, f->bytes};
    bool tsv = r->settings->format == FORMAT_TSV;
    text_printf(&r->table, tsv ? "%s\t%zu" : "%-16s %9zu", trap_name(trap), vertices);
    for (int k = 0; k < COLUMNS; k++) worst_print_figure(r, FIGURE, figures[k]);
    for (engine_id id = 0; id < ENGINES; id++) {
        const trap_peer_figures *p = &f->peers[id];
        const double of_peer[PEER_COLUMNS] = {p->build, p->query, p->wrong};
        for (int k = 0; k < worst_peer_columns(r, id); k++)
            worst_print_figure(r, worst_width(id, k), of_peer[k]);
    }
    text_string(&r->table, "\n");
}

/* Drop those that would take more than a minute to build at the next size. */
static void worst_drop_slow(const trap_figures *f, double growth, uint32_t *set)
{
    for (engine_id id = 0; id < ENGINES; id++)
        if (f->peers[id].build * growth > TOO_LONG) *set &= ~(UINT32_C(1) << id);
}

static int worst_run_trap(const char *name, void *self)
{
    worst_run *r = self;
    const bench_settings *s = r->settings;
    int trap = worst_named(name), end = 0;
    uint32_t left = r->engines;
    for (size_t i = 0; i < r->sizes.count && end == 0; i++) {
        trap_figures figures;
        trap_plan plan = {.vertices = r->sizes.size[i],
                          .queries = s->queries ? s->queries : QUERIES,
                          .rounds = s->rounds ? s->rounds : ROUNDS,
                          .seed = s->common.seed,
                          .engines = left};
        if (plan.vertices < FEWEST_VERTICES) plan.vertices = FEWEST_VERTICES;
        progress_phase(trap_help(trap), name);
        end = trap_measure(trap, &plan, &figures);
        if (end == 0) worst_print_row(r, trap, plan.vertices, &figures);
        if (end == 0 && i + 1 < r->sizes.count)
            worst_drop_slow(&figures, (double)r->sizes.size[i + 1] / (double)plan.vertices, &left);
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
    if (end == 0) end = worst_choose_engines(&r);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    if (end == 0) {
        worst_print_header(&r);
        end = traps ? word_list_each(traps, worst_run_trap, &r) : worst_run_all(&r);
    }
    if (end == 0) return files_write_text(s->common.output, &r.table);
    text_release(&r.table);
    return end;
}
