/* meshwalk.h - point location in triangle meshes by walking: the whole public interface. */
#ifndef MESHWALK_MESHWALK_H
#define MESHWALK_MESHWALK_H

#include <meshwalk/version.h>
#include <meshwalk/base.h>
#include <meshwalk/predicates.h>
#include <meshwalk/mesh.h>
#include <meshwalk/mend.h>
#include <meshwalk/triangulate.h>
#include <meshwalk/locate.h>
#include <meshwalk/segment.h>
#include <meshwalk/sight.h>
#include <meshwalk/volume.h>
#include <meshwalk/operator.h>
#include <meshwalk/remap.h>
#include <meshwalk/polygons.h>
#include <meshwalk/borrow.h>
#include <meshwalk/edit.h>
#include <meshwalk/surface.h>
#include <meshwalk/star.h>
#include <meshwalk/probe.h>
#include <meshwalk/surface_edit.h>
#include <meshwalk/remesh.h>
#include <meshwalk/io.h>
#include <meshwalk/prepared.h>
#include <meshwalk/weights.h>
#include <meshwalk/series.h>
#include <meshwalk/point_series.h>

#endif
