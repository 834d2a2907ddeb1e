#include "bench/peers/peers.h"

const engine_code *peers_engine(engine_id id)
{
    using Find = const engine_code *(*)(engine_id);
    static const Find finds[] = {
#ifdef MW_PEER_CGAL
        bench::cgal_engine,
#endif
#ifdef MW_PEER_EMBREE
        bench::embree_engine,
#endif
#ifdef MW_PEER_GEOS
        bench::geos_engine,
#endif
#ifdef MW_PEER_BOOST
        bench::boost_engine,
#endif
        bench::python_engine,
    };
    for (Find find : finds)
        if (const engine_code *code = find(id)) return code;
    return nullptr;
}

const editing_code *peers_editor(editor_id id)
{
#ifdef MW_PEER_CGAL
    return bench::cgal_editor(id);
#else
    (void)id;
    return nullptr;
#endif
}
