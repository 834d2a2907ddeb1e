/* bench space: rays and probes of surfaces in space, beside Embree, CGAL's AABB tree, and trimesh
 * with embreex. One row for each model, size, task, engine and way. */
#include "bench/space/bench_space.h"
#include "bench/core/word_list.h"
#include "bench/data/polyhedra.h"
#include "bench/space/space_comparison.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"

enum { RAYS = 100000, ROUNDS = 3 };

static const char *model_name(int i)
{
    return polyhedron_name(i);
}
static const choices model_choices = {"model", model_name, NULL};
static const choices space_task_choices = {"task", space_task_name, NULL};
static const choices space_engine_choices = {"engine", space_engine_name, NULL};

typedef struct space_command {
    space_plan plan;
    uint32_t models;
    size_list sizes;
    text table;
} space_command;

static int command_refuse(const char *why)
{
    complain("bench space %s", why);
    return END_USAGE;
}

static int command_read_settings(space_command *c, const bench_settings *s, const char *table)
{
    if (s->enclose != ENCLOSE_AUTO || s->no_times || s->plot || s->format == FORMAT_JSON)
        return command_refuse("has no plot and no corners, takes times, and prints them with "
                              "--format table or tsv");
    if (s->data && (table || s->sizes))
        return command_refuse("takes files or makes models: --data, or MODEL and --sizes");
    c->plan = (space_plan){.settings = s,
                           .engines = UINT32_MAX,
                           .tasks = UINT32_MAX,
                           .rays = s->queries ? s->queries : RAYS,
                           .rounds = s->rounds ? s->rounds : ROUNDS};
    c->models = 1u << POLYHEDRON_ICOSAHEDRON | 1u << POLYHEDRON_BUMPS;
    c->sizes = (size_list){{1000, 100000, 1000000}, 3};
    int end = options_limit("rounds", s->rounds, 1000, NULL);
    if (end == 0 && table) end = word_list_names(table, &model_choices, &c->models);
    if (end == 0 && s->sizes) end = word_list_sizes(s->sizes, &c->sizes);
    if (end == 0 && s->tasks) end = word_list_names(s->tasks, &space_task_choices, &c->plan.tasks);
    if (end == 0 && s->engines)
        end = word_list_names(s->engines, &space_engine_choices, &c->plan.engines);
    c->plan.engines |= 1; /* the others are compared with it */
    return end ? end : files_try_output(s->common.output, NULL);
}

static int command_make(space_command *c, int kind, size_t triangles)
{
    space_model model;
    int end = space_model_make(&model, kind, triangles, c->plan.settings->common.seed);
    if (end == 0) end = space_compare(&c->plan, &model, &c->table);
    space_model_release(&model);
    return end;
}

static int command_read_file(const char *path, void *self)
{
    space_command *c = self;
    space_model model;
    int end = space_model_read(&model, path);
    if (end == 0) end = space_compare(&c->plan, &model, &c->table);
    space_model_release(&model);
    return end;
}

int bench_space(const bench_settings *s, const char *table)
{
    space_command c = {.models = 0};
    int end = command_read_settings(&c, s, table);
    if (end) return end;
    space_header(&c.table, s->format == FORMAT_TSV);
    if (s->data) end = word_list_each(s->data, command_read_file, &c);
    for (int kind = 0; kind < POLYHEDRON_KINDS && !s->data && end == 0; kind++)
        for (size_t i = 0; i < c.sizes.count && (c.models >> kind & 1) && end == 0; i++)
            end = command_make(&c, kind, c.sizes.size[i]);
    if (end == 0) return files_write_text(s->common.output, &c.table);
    text_release(&c.table);
    return end;
}
