/* peer_list.h - which peers were built. Each is a file peer_NAME.cpp, which knows its engines by
 * number. */
#ifndef MW_BENCH_PEERS_PEER_LIST_H
#define MW_BENCH_PEERS_PEER_LIST_H

#include "bench/peers/engine.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The code of an engine of any peer; NULL: it was not built. */
const engine_code *peer_engine(engine_id id);

/* The code of an engine of this peer; NULL: it is not one of its engines. */
const engine_code *peer_boost_engine(engine_id id);
const engine_code *peer_cgal_engine(engine_id id);
const engine_code *peer_embree_engine(engine_id id);
const engine_code *peer_geos_engine(engine_id id);
const engine_code *peer_python_engine(engine_id id);

#ifdef __cplusplus
}
#endif

#endif
