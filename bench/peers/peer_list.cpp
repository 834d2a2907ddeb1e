#include "bench/peers/peer_list.h"

const engine_code *peer_engine(engine_id id)
{
    using Find = const engine_code *(*)(engine_id);
    static const Find finds[] = {
#ifdef MW_PEER_CGAL
        peer_cgal_engine,
#endif
#ifdef MW_PEER_EMBREE
        peer_embree_engine,
#endif
#ifdef MW_PEER_GEOS
        peer_geos_engine,
#endif
#ifdef MW_PEER_BOOST
        peer_boost_engine,
#endif
        peer_python_engine,
    };
    for (Find find : finds)
        if (const engine_code *code = find(id)) return code;
    return nullptr;
}
