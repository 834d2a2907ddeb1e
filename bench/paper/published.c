#include "bench/paper/published.h"

#include <math.h>
#include <string.h>

typedef struct published_cell {
    quantity quantity;
    double value;
} published_cell;

#define MOST_CELLS 16

typedef struct published_row {
    const char *table, *dataset;
    size_t vertices;
    const char *algorithm;
    size_t count;
    published_cell cells[MOST_CELLS];
} published_row;

static const published_row rows[] = {
#define PUBLISHED(table, dataset, vertices, algorithm, ...)                                        \
    {#table,                                                                                       \
     dataset,                                                                                      \
     vertices,                                                                                     \
     algorithm,                                                                                    \
     sizeof(published_cell[]){__VA_ARGS__} / sizeof(published_cell),                               \
     {__VA_ARGS__}},
#include "bench/paper/published.def"
};
#define ROWS (sizeof rows / sizeof *rows)

static const double *published_row_cell(const published_row *r, quantity q)
{
    for (size_t i = 0; i < r->count; i++)
        if (r->cells[i].quantity == q) return &r->cells[i].value;
    return NULL;
}

static bool published_row_is_about(const published_row *r, const char *table, const char *walk)
{
    return strcmp(r->table, table) == 0 && strcmp(r->algorithm, walk) == 0;
}

double published_value(const char *table, const char *set, size_t vertices, const char *walk,
                       quantity q)
{
    for (const published_row *r = rows; r < rows + ROWS; r++) {
        if (!published_row_is_about(r, table, walk) || r->vertices != vertices ||
            strcmp(r->dataset, set) != 0)
            continue;
        const double *value = published_row_cell(r, q);
        return value ? *value : NAN;
    }
    return NAN;
}

bool published_prints(const char *table, const char *walk, quantity q)
{
    for (const published_row *r = rows; r < rows + ROWS; r++)
        if (published_row_is_about(r, table, walk) && published_row_cell(r, q)) return true;
    return false;
}

static bool published_row_is_real(const published_row *r, const char *table)
{
    static const char *const real[] = {"cadastre", "lidar", "skull", "bunny"};
    for (size_t i = 0; i < sizeof real / sizeof *real; i++)
        if (strcmp(r->dataset, real[i]) == 0) return strcmp(r->table, table) == 0;
    return false;
}

/* The rows of a set stand together. */
bool published_real(const char *table, size_t i, const char **set, size_t *vertices)
{
    for (const published_row *r = rows; r < rows + ROWS; r++) {
        bool again =
            r > rows && published_row_is_real(r - 1, table) && r[-1].vertices == r->vertices;
        if (!published_row_is_real(r, table) || again || i-- > 0) continue;
        *set = r->dataset;
        *vertices = r->vertices;
        return true;
    }
    return false;
}
