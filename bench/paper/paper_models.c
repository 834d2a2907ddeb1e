#include "bench/paper/paper_models.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

typedef struct paper_model {
    const char *name;
    uint32_t triangles, vertices;
} paper_model;

static const paper_model star_models[] = {{"skull", 40000, 20002}, {"bunny", 71882, 35943}, {0}};

/* The vertices of these are not printed, but follow from the triangles where a surface is closed,
 * in one piece and without handles. */
static const paper_model surface_models[] = {{"pawn", 304, 154},
                                             {"triceratops", 5660, 2832},
                                             {"cow", 5804, 2904},
                                             {"fandisk", 12946, 6475},
                                             {"blob", 16068, 8036},
                                             {"gargoyle", 20000, 10002},
                                             {"venusbody", 22720, 11362},
                                             {"dinosaur", 28136, 14070},
                                             {"horse", 39698, 19851},
                                             {"skull", 40000, 20002},
                                             {"bunny", 71888, 35946},
                                             {"brain", 588032, 294018},
                                             {0}};

#define VERSION 0.05 /* of the triangles, may be more or fewer in another version of a model */

static const paper_model *table_models(const paper_table *table)
{
    static const paper_model none[] = {{0}};
    return table->subject == PAPER_STARS      ? star_models
           : table->subject == PAPER_SURFACES ? surface_models
                                              : none;
}

/* The length of the name before the '='; 0: there is none, or it is part of a path. */
static size_t word_name_length(const paper_table *table, const char *word)
{
    const char *sign = strchr(word, '=');
    if (!sign || !table_models(table)->name) return 0;
    const size_t length = (size_t)(sign - word);
    return strcspn(word, "./") < length ? 0 : length;
}

int paper_file_parse(const paper_table *table, const char *word, paper_file *file)
{
    const size_t length = word_name_length(table, word);
    *file = (paper_file){.path = length ? word + length + 1 : word};
    if (!length) return 0;
    snprintf(file->model, sizeof file->model, "%.*s", (int)length, word);
    spelling s = spelling_of(file->model);
    for (const paper_model *m = table_models(table); m->name; m++) {
        if (strcmp(m->name, file->model) == 0 && *file->path) return 0;
        spelling_try(&s, m->name);
    }
    spelling_complain(&s, "model", "");
    return END_USAGE;
}

void paper_models_match(const paper_table *table, const char *named, const char *suffix,
                        double triangles, paper_result *r)
{
    for (const paper_model *m = table_models(table); m->name && r->users_file; m++) {
        const double wanted = m->triangles;
        const bool alike = strncasecmp(r->dataset, m->name, strlen(m->name)) == 0 &&
                           fabs(triangles - wanted) <= VERSION * wanted;
        if (*named ? strcmp(named, m->name) != 0 : !alike) continue;
        snprintf(r->model, sizeof r->model, "%s%s", m->name, suffix);
        r->model_vertices = m->vertices;
        r->stands_in = *named != '\0';
    }
}
