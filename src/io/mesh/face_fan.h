/* face_fan.h - faces put together again from the triangles into which they were cut, for writers.
 * Private. */
#ifndef MW_SRC_IO_MESH_FACE_FAN_H
#define MW_SRC_IO_MESH_FACE_FAN_H

#include <meshwalk/io.h>

/* How many triangles, from triangle t on, are written as one face. That is the number of triangles
 * of the face if it has at most `corners` corners, they form a fan, and they have the same values;
 * else 1. */
size_t mw__face_triangles(const mw_mesh_file *file, size_t t, size_t corners);
/* Corner k of the face that begins with triangle t. */
uint32_t mw__face_corner(const mw_mesh_file *file, size_t t, size_t k);
/* How many faces are written so. */
size_t mw__face_count(const mw_mesh_file *file, size_t corners);

#endif
