#include "cli/raster/raster_like.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_crs.h"

#include <stdlib.h>

int raster_like_read(raster_like *like, const char *path)
{
    *like = (raster_like){.path = path};
    return path ? gdal_raster_describe(path, &like->form, &like->crs) : 0;
}

void raster_like_release(raster_like *like)
{
    free(like->crs);
    *like = (raster_like){0};
}

int raster_like_grid(const raster_like *like, raster_grid *grid, const char *mesh,
                     const char *mesh_crs, bool quiet)
{
    char names[2][CRS_NAME];
    const gdal_raster_form *form = &like->form;
    *grid = (raster_grid){.west = form->corner[0],
                          .north = form->corner[1],
                          .width = form->size[0],
                          .height = form->size[1],
                          .columns = form->columns,
                          .rows = form->rows};
    if (mesh_crs && like->crs && !crs_same(mesh_crs, like->crs)) {
        complain("%s is in %s, %s in %s: transform one of them first; 'gdalwarp -t_srs' "
                 "brings a raster to another system",
                 mesh, crs_name(mesh_crs, names[0]), like->path, crs_name(like->crs, names[1]));
        return END_INPUT;
    }
    if (!mesh_crs != !like->crs && !quiet)
        complain("%s: warning: its coordinate system is not known, and %s is in %s: the mesh is "
                 "taken as it is",
                 mesh_crs ? like->path : mesh, mesh_crs ? mesh : like->path,
                 crs_name(mesh_crs ? mesh_crs : like->crs, names[0]));
    return raster_grid_complete(grid);
}
