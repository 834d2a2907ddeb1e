/* engine_meshwalk.h - our engines. */
#ifndef MW_BENCH_PEERS_ENGINE_MESHWALK_H
#define MW_BENCH_PEERS_ENGINE_MESHWALK_H

#include "bench/peers/engine.h"

/* The code of one of ours. */
const engine_code *engine_meshwalk_code(engine_id id);

#endif
