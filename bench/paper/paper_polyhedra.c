/* paper_polyhedra.c - the polyhedra of App. F and the surfaces of App. G: those that are made, and
 * those of files. */
#include "bench/paper/paper_polyhedra.h"
#include "bench/data/polyhedra.h"
#include "bench/paper/paper_probe.h"
#include "bench/paper/paper_star.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

static int paper_measure_arrays(paper *p, const mw_arrays *arrays, const char *name,
                                const char *model)
{
    return p->table->subject == PAPER_STARS ? paper_star(p, arrays, name, model)
                                            : paper_probe(p, arrays, name, model);
}

static int paper_measure_made(paper *p, polyhedron_kind kind, size_t size)
{
    mw_error error;
    polyhedron made;
    const char *name = polyhedron_name((int)kind);
    progress_phase("making the polyhedron", name);
    if (polyhedron_make(&made, kind, size, p->settings->common.seed, &error) != MW_OK)
        return fail_mesh(name, &error);
    mw_arrays arrays = polyhedron_arrays(&made);
    int end = paper_measure_arrays(p, &arrays, name, NULL);
    polyhedron_release(&made);
    return end;
}

/* A number of vertices that a subdivided tetrahedron, octahedron or icosahedron has makes it: no
 * two of them have the same. */
int paper_polyhedra_stars(paper *p, const size_t *sizes)
{
    int end = 0;
    for (size_t i = 0; i < MOST_SIZES && sizes[i] && end == 0; i++)
        end = paper_measure_made(p, polyhedron_subdivided(sizes[i], POLYHEDRON_STAR), sizes[i]);
    return end;
}

int paper_polyhedra_surfaces(paper *p, const size_t *sizes)
{
    static const polyhedron_kind kinds[] = {POLYHEDRON_BUMPS, POLYHEDRON_KNOT};
    int end = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t i = 0; i < MOST_SIZES && sizes[i] && end == 0; i++)
            end = paper_measure_made(p, kinds[k], sizes[i]);
    return end;
}

int paper_polyhedra_file(paper *p, const char *path, const char *name, const char *model)
{
    mw_mesh_file file;
    progress_phase("reading", path);
    int end = files_read_mesh(path, &file);
    if (end) return end;
    mw_arrays arrays = mw_mesh_file_arrays(&file);
    end = paper_measure_arrays(p, &arrays, name, model);
    mw_mesh_file_release(&file);
    return end;
}
