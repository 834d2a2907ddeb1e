#include "cli/input/query_columns.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/text.h"
#include "src/base/posix.h"

#include <string.h>

/* The columns that a set of names leads to. */
typedef struct found_columns {
    size_t index[MAX_QUERY_COLUMNS];
    const char *names[MAX_QUERY_COLUMNS]; /* as the table has them */
    const char *doubled;                  /* a name that several columns have; NULL: none */
} found_columns;

static size_t coordinate_count(const query_columns *wanted)
{
    return wanted->axes == QUERY_SPACE ? 3 : 2;
}

static bool set_is_wanted(const query_columns *wanted, const mw_axis_names *set)
{
    return wanted->axes == QUERY_LONLAT ? set->lonlat : wanted->axes == QUERY_PLANE || !set->lonlat;
}

/* Can the columns of a table that has exactly the columns needed be taken in their order? Yes if
 * they are the coordinates of a set, or if none of their names is known. */
static bool columns_are_in_order(const query_columns *wanted, const mw_point_table *table)
{
    const mw_axis_names *set;
    bool known = false;
    size_t count = coordinate_count(wanted);
    for (size_t s = 0; table->names && (set = mw_axis_names_at(s)); s++) {
        size_t matches = 0;
        for (size_t k = 0; k < count; k++) {
            matches += (size_t)mw_axis_name_matches(table->names[k], set->axis[k]);
            for (int axis = 0; axis < 3; axis++)
                known |= mw_axis_name_matches(table->names[k], set->axis[axis]) != 0;
        }
        if (matches == count && set_is_wanted(wanted, set)) return true;
    }
    return !known;
}

/* Find the column of that name; of several the first, and *doubled is set. */
static bool column_find(const mw_point_table *table, const char *name, size_t k,
                        found_columns *found)
{
    size_t matches = 0;
    for (size_t i = 0; i < table->column_count; i++) {
        if (!mw_axis_name_matches(table->names[i], name)) continue;
        if (matches++ > 0)
            found->doubled = table->names[i];
        else
            found->index[k] = i;
    }
    if (matches > 0) found->names[k] = table->names[found->index[k]];
    return matches > 0;
}

static bool columns_find_set(const query_columns *wanted, const mw_point_table *table,
                             const mw_axis_names *set, found_columns *found)
{
    *found = (found_columns){0};
    if (!set_is_wanted(wanted, set)) return false;
    for (size_t k = 0; k < wanted->count; k++)
        if (!column_find(table, k < coordinate_count(wanted) ? set->axis[k] : wanted->names[k], k,
                         found))
            return false;
    return true;
}

/* How many sets of names fit, of the preferred ones: 0, 1 or 2, which stands for more. The first
 * two are kept. */
static size_t columns_find_sets(const query_columns *wanted, const mw_point_table *table,
                                query_preference prefer, found_columns found[2])
{
    const mw_axis_names *set;
    size_t count = 0;
    if (!table->names) return 0;
    for (size_t i = 0; count < 2 && (set = mw_axis_names_at(i)); i++) {
        bool preferred = prefer == PREFER_NOTHING || set->lonlat == (prefer == PREFER_LONLAT);
        if (preferred && columns_find_set(wanted, table, set, &found[count])) count++;
    }
    return count;
}

/* The preference matters only if several sets fit. */
static size_t columns_find_clear(const query_columns *wanted, const mw_point_table *table,
                                 found_columns found[2])
{
    found_columns preferred[2];
    size_t count = columns_find_sets(wanted, table, PREFER_NOTHING, found);
    if (count < 2 || wanted->prefer == PREFER_NOTHING) return count;
    if (columns_find_sets(wanted, table, wanted->prefer, preferred) != 1) return count;
    found[0] = preferred[0];
    return 1;
}

bool query_names_are_lonlat(const char *x, const char *y)
{
    const mw_axis_names *set;
    for (size_t s = 0; x && y && (set = mw_axis_names_at(s)); s++)
        if (set->lonlat && mw_axis_name_matches(x, set->axis[0]) &&
            mw_axis_name_matches(y, set->axis[1]))
            return true;
    return false;
}

static bool columns_are_lonlat(const mw_point_table *table, const size_t *index)
{
    return table->names && query_names_are_lonlat(table->names[index[0]], table->names[index[1]]);
}

/* Files that end in .xyz have x, y and z first, without saying so. */
static bool path_says_xyz(const char *path)
{
    size_t length = strlen(path);
    if (length > 3 && strcasecmp(path + length - 3, ".gz") == 0) length -= 3;
    return length > 4 && strncasecmp(path + length - 4, ".xyz", 4) == 0;
}

/* --- complaints ------------------------------------------------------------------------------- */

/* Add a name from a file: not too long, and without control characters. */
static void text_column_name(text *t, const char *name)
{
    size_t length = strlen(name), shown = length > 40 ? 37 : length;
    for (size_t i = 0; i < shown; i++) {
        bool control = (unsigned char)name[i] < 0x20 || name[i] == 0x7f;
        text_bytes(t, control ? "?" : &name[i], 1);
    }
    if (shown < length) text_string(t, "...");
}

static void text_column_list(text *t, const char *const *names, size_t count, const char *comma)
{
    for (size_t k = 0; k < count; k++) {
        if (k > 0) text_string(t, comma);
        if (t->size > 1400) {
            text_string(t, "...");
            return;
        }
        text_column_name(t, names[k]);
    }
}

static int columns_complain(text *t, int end)
{
    if (t->failed)
        end = fail_memory();
    else
        complain("%.*s", (int)t->size, t->bytes);
    text_release(t);
    return end;
}

static int columns_fail_count(const query_columns *wanted, size_t width)
{
    text t = {0};
    text_printf(&t, "option '--columns' must name %zu columns, ", wanted->count);
    text_column_list(&t, wanted->names, wanted->count, ",");
    text_printf(&t, ", not %zu", width);
    return columns_complain(&t, END_USAGE);
}

static int columns_fail_few(const query_columns *wanted, const char *file, size_t width)
{
    text t = {0};
    text_printf(&t, "%s: has %zu column%s, but a row is ", file, width, width == 1 ? "" : "s");
    text_column_list(&t, wanted->names, wanted->count, ",");
    text_string(&t, wanted->hint ? wanted->hint : "");
    return columns_complain(&t, END_INPUT);
}

/* Why the columns are not clear: which of the table fit, if any. */
static void text_column_doubts(text *t, const query_columns *wanted, const found_columns found[2],
                               size_t count)
{
    if (count > 1) {
        text_string(t, "Both ");
        text_column_list(t, found[0].names, wanted->count, ",");
        text_string(t, " and ");
        text_column_list(t, found[1].names, wanted->count, ",");
        text_string(t, " fit. ");
    } else if (count == 1) {
        text_string(t, "Several are called ");
        text_column_name(t, found[0].doubled);
        text_string(t, ". ");
    }
}

static int columns_fail_unclear(const query_columns *wanted, const char *file,
                                const mw_point_table *table, const found_columns found[2],
                                size_t count)
{
    text t = {0};
    text_printf(&t, "%s: which of its %zu columns are ", file, table->column_count);
    text_column_list(&t, wanted->names, wanted->count, ",");
    text_string(&t, "? ");
    text_column_doubts(&t, wanted, found, count);
    if (table->names) {
        text_string(&t, "They are: ");
        text_column_list(&t, table->names, table->column_count, ", ");
    } else {
        text_string(&t, "They have no names");
    }
    text_string(&t, "; use --columns, with names or with numbers from 1");
    text_string(&t, wanted->hint ? wanted->hint : "");
    return columns_complain(&t, END_USAGE);
}

/* --- the search ------------------------------------------------------------------------------- */

static int columns_check_chosen(const query_columns *wanted, const mw_point_reader *reader,
                                size_t *index)
{
    size_t width = mw_point_reader_width(reader);
    if (width != wanted->count) return columns_fail_count(wanted, width);
    for (size_t k = 0; k < width; k++) index[k] = mw_point_reader_column_number(reader, k);
    return 0;
}

int query_columns_check_points(const char *path, const mw_point_reader *reader)
{
    static const query_columns wanted = {.axes = QUERY_PLANE, .names = {"x", "y"}, .count = 2};
    mw_error error;
    mw_point_table table;
    found_columns found[2] = {0};
    if (mw_point_reader_table(reader, &table, &error) != MW_OK) return fail_reading(&error);
    size_t count = columns_find_sets(&wanted, &table, PREFER_NOTHING, found);
    bool few = table.column_count <= 3 && columns_are_in_order(&wanted, &table);
    if (!table.names || (count == 1 && !found[0].doubled) || (count == 0 && few)) return 0;
    return columns_fail_unclear(&wanted, files_is_standard(path) ? "standard input" : path, &table,
                                found, count);
}

int query_columns_find(const query_columns *wanted, const char *path, mw_point_reader *reader,
                       bool chosen, size_t index[MAX_QUERY_COLUMNS], bool *lonlat)
{
    mw_error error;
    mw_point_table table;
    found_columns found[2] = {0};
    if (mw_point_reader_table(reader, &table, &error) != MW_OK) return fail_reading(&error);
    for (size_t k = 0; k < wanted->count; k++) index[k] = k;
    *lonlat = false;
    if (table.column_count == 0) return 0;
    if (chosen) {
        int end = columns_check_chosen(wanted, reader, index);
        *lonlat = end == 0 && columns_are_lonlat(&table, index);
        return end;
    }
    const char *file = files_is_standard(path) ? "standard input" : path;
    if (table.column_count < wanted->count)
        return columns_fail_few(wanted, file, table.column_count);
    bool first = !table.names && wanted->count <= 3 && path_says_xyz(path);
    size_t count = columns_find_clear(wanted, &table, found);
    if (count == 1 && !found[0].doubled)
        memcpy(index, found[0].index, wanted->count * sizeof *index);
    else if (!first && (count > 0 || table.column_count > wanted->count ||
                        !columns_are_in_order(wanted, &table)))
        return columns_fail_unclear(wanted, file, &table, found, count);
    *lonlat = columns_are_lonlat(&table, index);
    return mw_point_reader_select(reader, index, wanted->count, &error) == MW_OK
               ? 0
               : fail_reading(&error);
}
