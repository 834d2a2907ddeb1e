#include "bench/space/space_engine.h"

#include <stddef.h>

const space_engine *const space_engines[] = {
    &space_engine_certain, &space_engine_walk,
    &space_engine_guided,  &space_engine_star,
#ifdef MW_SPACE_EMBREE
    &space_engine_embree,
#endif
#ifdef MW_SPACE_CGAL
    &space_engine_cgal,
#endif
    &space_engine_trimesh, NULL,
};
