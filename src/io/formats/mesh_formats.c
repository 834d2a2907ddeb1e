#include "io/formats/mesh_formats.h"

#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "io/text/file_head.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

/* [ST][C][N][4][n]OFF */
static bool is_off(const char *word)
{
    if (strncmp(word, "ST", 2) == 0) word += 2;
    word += *word == 'C';
    word += *word == 'N';
    word += *word == '4';
    word += *word == 'n';
    return strcmp(word, "OFF") == 0;
}

static bool is_ply(const char *word)
{
    return strcmp(word, "ply") == 0;
}

static bool is_solid(const char *word)
{
    return strcasecmp(word, "solid") == 0;
}

static bool is_obj(const char *word)
{
    static const char *const words[] = {"v", "vt", "vn", "vp",     "f",
                                        "o", "g",  "s",  "mtllib", "usemtl"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(word, words[i]) == 0) return true;
    return false;
}

static const mw_mesh_format formats[] = {
    {.name = "off",
     .endings = ".off\0.coff\0.noff\0",
     .first_word = is_off,
     .read = mw__read_off,
     .write = mw__write_off},
    {.name = "ply",
     .endings = ".ply\0",
     .first_word = is_ply,
     .read = mw__read_ply,
     .write = mw__write_ply},
    {.name = "ply-ascii", .endings = "", .write = mw__write_ply_ascii},
    {.name = "node",
     .endings = ".node\0.ele\0",
     .read_path = mw__read_node_ele,
     .write = mw__write_node_ele},
    {.name = "obj",
     .endings = ".obj\0",
     .first_word = is_obj,
     .common_words = true,
     .read = mw__read_obj,
     .write = mw__write_obj},
    {.name = "stl",
     .endings = ".stl\0",
     .first_word = is_solid,
     .read = mw__read_stl,
     .write = mw__write_stl},
    {.name = "csv", .endings = ".csv\0", .write = mw__write_csv},
    {.name = "vtk", .endings = ".vtk\0", .write = mw__write_vtk},
};
enum { FORMAT_COUNT = sizeof formats / sizeof *formats };

const mw_mesh_format *mw__mesh_format_by_name(const char *name)
{
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        if (strcasecmp(name, formats[i].name) == 0) return &formats[i];
    return NULL;
}

const char *mw_mesh_format_name(size_t i)
{
    for (size_t k = 0; k < FORMAT_COUNT; k++)
        if (formats[k].write && i-- == 0) return formats[k].name;
    return NULL;
}

const mw_mesh_format *mw__mesh_format_by_path(const char *path)
{
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        for (const char *ending = formats[i].endings; *ending; ending += strlen(ending) + 1)
            if (mw__path_ends(path, ending)) return &formats[i];
    return NULL;
}

/* The first word of a text, blank lines, comments and a byte order mark passed over; empty if it
 * is too long. */
static void head_first_word(const char *p, const char *end, char *word, size_t room)
{
    p = mw__head_skip_comments(mw__head_skip_mark(p, end), end);
    size_t length = 0;
    for (; p < end && !mw__is_space(*p) && *p != '#'; p++)
        if (length < room) word[length++] = *p;
    word[length < room ? length : 0] = 0;
}

const mw_mesh_format *mw__mesh_format_by_content(const char *head, size_t size)
{
    char word[16];
    head_first_word(head, head + size, word, sizeof word);
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        if (formats[i].first_word && formats[i].first_word(word)) return &formats[i];
    return NULL;
}

void mw__mesh_format_list(bool writers, char *text, size_t size)
{
    size_t used = 0;
    text[0] = 0;
    for (size_t i = 0; i < FORMAT_COUNT; i++) {
        bool listed = writers ? formats[i].write != NULL : formats[i].read || formats[i].read_path;
        if (listed && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     formats[i].name);
    }
}
