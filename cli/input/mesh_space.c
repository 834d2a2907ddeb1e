#include "cli/input/mesh_space.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/input/lonlat_input.h"

static const char *space_name(int i)
{
    static const char *const names[] = {"plane", "surface", "star", NULL};
    return names[i];
}
static const char *space_help(int i)
{
    static const char *const texts[] = {
        "a mesh in the plane of x and y, as for locate and sample",
        "a surface in space, as for probe",
        "a closed polyhedron, star-shaped about a centre, as for star"};
    return texts[i];
}
static const choices space_choices = {"way to take a mesh", space_name, space_help};

const option mesh_space_options[] = {
    {"as", 0, OPTION_CHOICE, offsetof(mesh_space_settings, space), "NAME",
     "what to take MESH as (default: plane):", &space_choices},
    {"centre", 0, OPTION_XYZ, offsetof(mesh_space_settings, centre), "X,Y,Z",
     "--as star: the centre, which is to see all facets from inside (default: 0,0,0)", NULL},
    {"lonlat", 0, OPTION_FLAG, offsetof(mesh_space_settings, lonlat), NULL,
     "--as star: x and y of a MESH without z are longitude and latitude on the unit sphere, in "
     "degrees",
     NULL},
    {"weld", 0, OPTION_FLAG, offsetof(mesh_space_settings, weld), NULL,
     "--as surface: vertices with equal coordinates are one; with --as star they always are", NULL},
    {0},
};

static int mesh_space_option_wants(const char *name, const char *as)
{
    complain("option '--%s' needs --as %s", name, as);
    return END_USAGE;
}

static int mesh_space_check_options(const mesh_space_settings *s)
{
    if (s->centre.count > 0 && s->space != SPACE_STAR)
        return mesh_space_option_wants("centre", "star");
    if (s->lonlat && s->space != SPACE_STAR) return mesh_space_option_wants("lonlat", "star");
    if (s->weld && s->space == SPACE_PLANE) return mesh_space_option_wants("weld", "surface");
    return 0;
}

int mesh_space_read(const mesh_space_settings *s, const char *const *operands, mw_mesh_file *file)
{
    int end = mesh_space_check_options(s);
    if (end == 0) end = files_check_output(s->common.output, operands, 1);
    if (end == 0) end = files_read_mesh(operands[0], file);
    if (end == 0 && s->lonlat) end = lonlat_input_mesh(operands[0], file);
    return end;
}

bool mesh_space_is_welded(const mesh_space_settings *s)
{
    return s->weld || s->space == SPACE_STAR;
}
