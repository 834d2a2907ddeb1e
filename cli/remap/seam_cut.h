/* seam_cut.h - meshes that go round the globe, cut so that they lie in the plane.
 *
 *     W               E     A triangle with longitudes on both sides of the seam is cut there: its
 *     |\             /|     pieces lie at either end of the 360 degrees between W and E. Edges are
 *     | \           / |     straight in longitude and latitude. One with a pole inside, or as a
 *     |_/           \_|     vertex, reaches up to the pole's latitude over all its longitudes. */
#ifndef MW_CLI_REMAP_SEAM_CUT_H
#define MW_CLI_REMAP_SEAM_CUT_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

/* Does a triangle of the file have longitudes that differ by more than 180 degrees, or a pole as a
 * vertex? No if a coordinate is no number: that is for others to tell. */
bool seam_crosses(const mw_mesh_file *file);

/* Cut the mesh: pieces take the place of each triangle, in its face. New vertices follow the old
 * ones; fields are dropped. Longitudes have to lie between -180 and 180, or between 0 and 360.
 * *west: the longitude at which they begin then. Returns 0, or an exit code after a complaint. */
int seam_cut(mw_mesh_file *file, const char *path, double *west);

#endif
