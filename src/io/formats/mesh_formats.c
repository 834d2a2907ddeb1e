#include "io/formats/mesh_formats.h"

#include "base/posix.h"
#include "io/grid/grid_readers.h"
#include "io/grid/grid_writers.h"
#include "io/grid/selafin.h"
#include "io/layouts/netcdf_mesh.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "io/text/file_head.h"
#include "prepared/prepared_read.h"

#include <stdio.h>
#include <string.h>

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

static bool is_msh(const char *word)
{
    return strcmp(word, "$MeshFormat") == 0;
}

static bool is_2dm(const char *word)
{
    return strcmp(word, "MESH2D") == 0;
}

/* "NDIME=" or another keyword that may come first, behind comments. */
static bool begins_su2(const char *head, size_t size)
{
    static const char *const keys[] = {"NZONE", "NDIME", "NELEM", "NPOIN"};
    const char *p = mw__head_skip_mark(head, head + size), *end = head + size;
    while (p < end && (*p == '%' || mw__is_space(*p))) {
        if (*p == '%')
            while (p < end && *p != '\n') p++;
        else
            p++;
    }
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        const size_t length = strlen(keys[k]);
        if ((size_t)(end - p) <= length || memcmp(p, keys[k], length) != 0) continue;
        const char *sign = p + length;
        while (sign < end && mw__is_blank(*sign)) sign++;
        if (sign < end && *sign == '=') return true;
    }
    return false;
}

static bool begins_vtk(const char *head, size_t size)
{
    static const char mark[] = "# vtk DataFile";
    return size >= sizeof mark - 1 && memcmp(head, mark, sizeof mark - 1) == 0;
}

static bool begins_vtu(const char *head, size_t size)
{
    static const char mark[] = "<VTKFile";
    if (size < 8 || (memcmp(head, "<?xml", 5) != 0 && memcmp(head, mark, 8) != 0)) return false;
    for (size_t i = 0; i + 8 <= size; i++)
        if (memcmp(head + i, mark, 8) == 0) return true;
    return false;
}

/* A zip file whose first entry is an array. */
static bool begins_npz(const char *head, size_t size)
{
    if (size < 40 || memcmp(head, "PK\3\4", 4) != 0) return false;
    size_t length = (unsigned char)head[26] + 256 * (size_t)(unsigned char)head[27];
    return length > 4 && length <= size - 30 && memcmp(head + 30 + length - 4, ".npy", 4) == 0;
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
    {.name = "netcdf",
     .endings = ".nc\0.nc4\0",
     .first_bytes = mw__netcdf_begins,
     .read = mw__read_netcdf,
     .write = mw__write_netcdf},
    {.name = "csv", .endings = ".csv\0", .write = mw__write_csv},
    {.name = "vtk",
     .endings = ".vtk\0",
     .first_bytes = begins_vtk,
     .read = mw__read_vtk,
     .write = mw__write_vtk},
    {.name = "vtu",
     .endings = ".vtu\0",
     .first_bytes = begins_vtu,
     .read = mw__read_vtu,
     .write = mw__write_vtu},
    {.name = "fort.14",
     .endings = ".14\0.grd\0",
     .titled = true,
     .read = mw__read_fort14,
     .write = mw__write_fort14},
    {.name = "gr3",
     .endings = ".gr3\0",
     .titled = true,
     .read = mw__read_fort14,
     .write = mw__write_gr3},
    {.name = "ll", .endings = ".ll\0", .titled = true, .read = mw__read_hgrid_ll},
    {.name = "2dm",
     .endings = ".2dm\0",
     .first_word = is_2dm,
     .read = mw__read_2dm,
     .write = mw__write_2dm},
    {.name = "msh",
     .endings = ".msh\0",
     .first_word = is_msh,
     .read = mw__read_msh,
     .write = mw__write_msh},
    {.name = "selafin",
     .endings = ".slf\0.selafin\0.ser\0",
     .first_bytes = mw__is_selafin,
     .read = mw__read_selafin},
    {.name = "su2", .endings = ".su2\0", .first_bytes = begins_su2, .read = mw__read_su2},
    {.name = "npz", .endings = ".npz\0", .first_bytes = begins_npz, .read = mw__read_npz},
    {.name = "mwm",
     .endings = ".mwm\0",
     .first_bytes = mw__prepared_begins,
     .read = mw__read_prepared},
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

const char *mw_mesh_format_of_path(const char *path)
{
    const mw_mesh_format *format = path ? mw__mesh_format_by_path(path) : NULL;
    return format && format->write ? format->name : NULL;
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

static const mw_mesh_format *format_by_bytes(const char *head, size_t size)
{
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        if (formats[i].first_bytes && formats[i].first_bytes(head, size)) return &formats[i];
    return NULL;
}

static const mw_mesh_format *format_by_word(const char *head, size_t size)
{
    char word[16];
    head_first_word(head, head + size, word, sizeof word);
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        if (formats[i].first_word && formats[i].first_word(word)) return &formats[i];
    return NULL;
}

const mw_mesh_format *mw__mesh_format_by_content(const char *head, size_t size)
{
    const mw_mesh_format *format = format_by_bytes(head, size);
    return format ? format : format_by_word(head, size);
}

const mw_mesh_format *mw__mesh_format_of(const char *path, const char *head, size_t size)
{
    const mw_mesh_format *named = mw__mesh_format_by_path(path);
    const mw_mesh_format *format = format_by_bytes(head, size);
    if (!format && !(named && named->titled)) format = format_by_word(head, size);
    return format ? format : named;
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
