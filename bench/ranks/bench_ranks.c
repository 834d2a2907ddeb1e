/* bench scale --ranks: queries on many ranks, replayed on one machine. Nothing is timed: each query
 * is located in the whole mesh, and sent where libmeshwalk-mpi sends it (mpi/query/locate.c):
 *
 *   A point in a box of the rank that asks is located there; strictly inside a triangle of that
 *   rank, it is done. Any other is asked of every other rank in whose boxes it lies, 16 bytes each;
 *   who has its triangle answers, 48 bytes. In each round every rank tells every other how many
 *   questions it has, how many it takes, and how many answers come: 16 bytes a pair of ranks. */
#include "bench/ranks/bench_ranks.h"
#include "bench/core/word_list.h"
#include "bench/ranks/rank_boxes.h"
#include "bench/ranks/rank_queries.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/spelling.h"

#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdlib.h>

enum { QUERIES = 1000000, VERTICES = 1000000, QUESTION = 16, ANSWER = 48, ROUND = 16 };
/* A block of queries, and the most questions that a rank takes in a round. */
#define BLOCK 262144.0

typedef struct ranks_run {
    const bench_settings *settings;
    dataset_kind set;
    dataset domain;
    mw_mesh *mesh;
    mw_locator *locator;
    rank_boxes boxes;
    size_t count; /* of queries */
    double *points;
    mw_location *found;
    text table;
} ranks_run;

/* What happened, over all queries, and to each rank. */
typedef struct ranks_tally {
    uint64_t questions, answers, local, moves;
    uint32_t *asked;  /* per rank: questions of others */
    uint32_t *worked; /* and all that it located */
    uint32_t *ranks;  /* of one query */
} ranks_tally;

static bool tally_create(ranks_tally *t, uint32_t ranks)
{
    *t = (ranks_tally){.asked = calloc(ranks, sizeof *t->asked),
                       .worked = calloc(ranks, sizeof *t->worked),
                       .ranks = malloc(ranks * sizeof *t->ranks)};
    return t->asked && t->worked && t->ranks;
}

static void tally_release(ranks_tally *t)
{
    free(t->asked);
    free(t->worked);
    free(t->ranks);
}

static double tally_most(const uint32_t *of, uint32_t ranks)
{
    uint32_t most = 0;
    for (uint32_t r = 0; r < ranks; r++) most = of[r] > most ? of[r] : most;
    return most;
}

/* --- one query -------------------------------------------------------------------------------- */

/* The rank that has the triangle of query i, or the number of ranks if there is none. */
static uint32_t ranks_owner(const ranks_run *r, size_t i)
{
    const uint32_t t = r->found[i].triangle;
    return t == MW_NONE ? r->boxes.ranks : rank_boxes_owner(&r->boxes, t);
}

/* The rank that asks query i: any, or for a particle the one that had it a step before. */
static uint32_t ranks_home(const ranks_run *r, rank_spread spread, size_t i, uint64_t *random)
{
    const uint32_t any = (uint32_t)(dataset_bits(random) % r->boxes.ranks);
    const size_t particles = r->count / RANK_CLOUD_STEPS;
    if (spread != RANK_SPREAD_CLOUD || i < particles) return any;
    const uint32_t before = ranks_owner(r, i - particles);
    return before < r->boxes.ranks ? before : any;
}

static void ranks_ask(const ranks_run *r, ranks_tally *t, size_t i, uint32_t home)
{
    const uint32_t owner = ranks_owner(r, i);
    const uint32_t count = rank_boxes_find(&r->boxes, r->points + 2 * i, t->ranks);
    bool here = false;
    for (uint32_t k = 0; k < count; k++) here |= t->ranks[k] == home;
    t->worked[home] += here;
    if (here && owner == home && r->found[i].where == MW_INSIDE) {
        t->local++;
        return;
    }
    t->moves += owner < r->boxes.ranks && owner != home;
    for (uint32_t k = 0; k < count; k++) {
        if (t->ranks[k] == home) continue;
        t->questions++;
        t->asked[t->ranks[k]]++;
        t->worked[t->ranks[k]]++;
        t->answers += t->ranks[k] == owner;
    }
}

/* --- the table -------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    int width;
} columns[] = {{"local", 8}, {"asked", 8}, {"moved", 8},  {"out_B", 8},    {"back_B", 8},
               {"work", 10}, {"hot", 10},  {"rounds", 8}, {"round_B", 10}, {"boxes_MB", 9}};
enum { COLUMNS = sizeof columns / sizeof *columns };

static void ranks_print_header(ranks_run *r)
{
    const bool tsv = r->settings->format == FORMAT_TSV;
    text_string(&r->table, tsv ? "vertices\tranks\tqueries" : " vertices   ranks queries ");
    for (int k = 0; k < COLUMNS; k++) {
        if (tsv)
            text_printf(&r->table, "\t%s", columns[k].name);
        else
            text_printf(&r->table, " %*s", columns[k].width, columns[k].name);
    }
    text_string(&r->table, "\n");
}

static void ranks_print_row(ranks_run *r, rank_spread spread, const ranks_tally *t)
{
    const uint32_t ranks = r->boxes.ranks, vertices = mw_mesh_vertex_count(r->mesh);
    const double n = (double)r->count, mean = n / ranks;
    const double hot = tally_most(t->asked, ranks) / mean;
    /* each rank has a block of queries: the hottest takes a block of questions in a round */
    const double rounds = fmax(1, ceil(hot));
    const double figures[COLUMNS] = {(double)t->local / n,
                                     (double)t->questions / n,
                                     (double)t->moves / n,
                                     QUESTION * (double)t->questions / n,
                                     ANSWER * (double)t->answers / n,
                                     tally_most(t->worked, ranks) / mean,
                                     hot,
                                     rounds,
                                     ROUND * (double)ranks * rounds / BLOCK,
                                     (double)rank_boxes_bytes(&r->boxes) / 1e6};
    const bool tsv = r->settings->format == FORMAT_TSV;
    text_printf(&r->table, tsv ? "%u\t%u\t%s" : "%9u %7u %-8s", vertices, ranks,
                rank_spread_name(spread));
    for (int k = 0; k < COLUMNS; k++) {
        if (tsv)
            text_printf(&r->table, "\t%.4g", figures[k]);
        else
            text_printf(&r->table, " %*.4g", columns[k].width, figures[k]);
    }
    text_string(&r->table, "\n");
}

/* --- the runs --------------------------------------------------------------------------------- */

static int ranks_replay(ranks_run *r, rank_spread spread)
{
    uint64_t random = r->settings->common.seed + 2;
    ranks_tally tally;
    int end = tally_create(&tally, r->boxes.ranks) ? 0 : fail_memory();
    if (end == 0) {
        for (size_t i = 0; i < r->count; i++)
            ranks_ask(r, &tally, i, ranks_home(r, spread, i, &random));
        ranks_print_row(r, spread, &tally);
    }
    tally_release(&tally);
    return end;
}

static int ranks_cut(ranks_run *r, size_t ranks, rank_spread spread)
{
    if (ranks > r->boxes.triangles) {
        complain("bench scale: %zu ranks are more than the %u triangles: make --sizes larger",
                 ranks, r->boxes.triangles);
        return END_USAGE;
    }
    if (!rank_boxes_cut(&r->boxes, r->mesh, (uint32_t)ranks)) return fail_memory();
    return ranks_replay(r, spread);
}

static int ranks_measure_spread(ranks_run *r, const size_list *ranks, rank_spread spread)
{
    const mw_query_options options = {.threads = r->settings->common.threads};
    mw_error error;
    rank_spread_draw(&r->domain, spread, r->points, r->count, r->settings->common.seed + 1);
    if (mw_locate_batch(r->locator, r->points, r->count, 2, &options, r->found, NULL, &error))
        return fail_query(&error);
    int end = 0;
    for (size_t i = 0; i < ranks->count && end == 0; i++)
        end = ranks_cut(r, ranks->size[i], spread);
    return end;
}

static int ranks_make(ranks_run *r, size_t vertices)
{
    mw_error error;
    if (!dataset_make(&r->domain, r->set, vertices, false, r->settings->common.seed))
        return fail_memory();
    if (mw_delaunay(r->domain.points, r->domain.count, 2, NULL, NULL, NULL, &r->mesh, &error) !=
            MW_OK ||
        mw_locator_create(r->mesh, NULL, &r->locator, &error) != MW_OK)
        return fail_query(&error);
    return rank_boxes_create(&r->boxes, r->mesh) ? 0 : fail_memory();
}

static int ranks_measure_size(ranks_run *r, size_t vertices, const size_list *ranks)
{
    progress_phase("replaying", "queries");
    int end = ranks_make(r, vertices);
    for (int spread = 0; spread < RANK_SPREADS && end == 0; spread++)
        end = ranks_measure_spread(r, ranks, (rank_spread)spread);
    rank_boxes_release(&r->boxes);
    mw_locator_destroy(r->locator);
    mw_mesh_destroy(r->mesh);
    dataset_release(&r->domain);
    r->locator = NULL;
    r->mesh = NULL;
    return end;
}

static int ranks_check_settings(const bench_settings *s)
{
    if (s->enclose != ENCLOSE_AUTO || s->no_times || s->data || s->plot || s->engines || s->tasks ||
        s->rounds || s->format == FORMAT_JSON) {
        complain("bench scale --ranks makes its own mesh and queries, takes no times, and prints "
                 "with --format table or tsv");
        return END_USAGE;
    }
    return 0;
}

static int ranks_take_set(ranks_run *r, const char *set)
{
    r->set = set ? (dataset_kind)dataset_named(set) : DATASET_GRID;
    if (r->set < DATASET_KINDS) return 0;
    spelling s = spelling_of(set);
    for (int kind = 0; kind < DATASET_KINDS; kind++) spelling_try(&s, dataset_name(kind));
    spelling_complain(&s, "set", "");
    return END_USAGE;
}

int bench_ranks(const bench_settings *s, const char *set)
{
    ranks_run r = {.settings = s};
    size_list sizes = {{VERTICES}, 1}, ranks = {.count = 0};
    const size_t n = s->queries ? s->queries : QUERIES;
    int end = ranks_check_settings(s);
    if (end == 0) end = ranks_take_set(&r, set);
    if (end == 0) end = word_list_ranks(s->ranks, &ranks);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &sizes);
    if (end == 0) end = files_try_output(s->common.output, NULL);
    r.count = (n + RANK_CLOUD_STEPS - 1) / RANK_CLOUD_STEPS * RANK_CLOUD_STEPS;
    r.points = malloc(2 * r.count * sizeof *r.points);
    r.found = malloc(r.count * sizeof *r.found);
    if (end == 0 && (!r.points || !r.found)) end = fail_memory();
    ranks_print_header(&r);
    for (size_t i = 0; i < sizes.count && end == 0; i++)
        end = ranks_measure_size(&r, sizes.size[i], &ranks);
    free(r.points);
    free(r.found);
    if (end == 0) return files_write_text(s->common.output, &r.table);
    text_release(&r.table);
    return end;
}
