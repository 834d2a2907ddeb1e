#include "cli/input/taken_as.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/input/sphere.h"

static const char *as_name(int i)
{
    static const char *const names[] = {"plane", "surface", "star", NULL};
    return names[i];
}
static const char *as_help(int i)
{
    static const char *const texts[] = {"a mesh in the plane of x and y, as for locate and sample",
                                        "a surface in space, as for probe",
                                        "a closed polyhedron, star-shaped about a centre, as for star"};
    return texts[i];
}
static const choices kinds = {"way to take a mesh", as_name, as_help};

const option taken_as_options[] = {
    {"as", 0, OPTION_CHOICE, offsetof(taken_as, as), "NAME", "what to take MESH as (default: plane):", &kinds},
    {"centre", 0, OPTION_POINT, offsetof(taken_as, centre), "X,Y,Z",
     "--as star: the centre, which is to see all facets from inside (default: 0,0,0)", NULL},
    {"lonlat", 0, OPTION_FLAG, offsetof(taken_as, lonlat), NULL,
     "--as star: x and y of a MESH without z are longitude and latitude on the unit sphere, in degrees", NULL},
    {"weld", 0, OPTION_FLAG, offsetof(taken_as, weld), NULL,
     "--as surface: vertices with equal coordinates are one; with --as star they always are", NULL},
    {0},
};

static int wants(const char *name, const char *as)
{
    complain("option '--%s' wants --as %s", name, as);
    return END_USAGE;
}

static int check_options(const taken_as *s)
{
    if (s->centre.count > 0 && s->as != AS_STAR) return wants("centre", "star");
    if (s->lonlat && s->as != AS_STAR) return wants("lonlat", "star");
    if (s->weld && s->as == AS_PLANE) return wants("weld", "surface");
    return 0;
}

int taken_as_read(const taken_as *s, const char *const *operands, mw_mesh_file *file)
{
    int end = check_options(s);
    if (end == 0) end = files_check(s->common.output, operands, 1);
    if (end == 0) end = files_read_mesh(operands[0], file);
    if (end == 0 && s->lonlat) end = sphere_place(operands[0], file);
    return end;
}

bool taken_as_welded(const taken_as *s)
{
    return s->weld || s->as == AS_STAR;
}
