/* bench_peers.h - the measurements 'meshwalk bench peers [SET]' and 'bench scale [SET]'. */
#ifndef MW_BENCH_PEERS_BENCH_PEERS_H
#define MW_BENCH_PEERS_BENCH_PEERS_H

#include "bench/core/settings.h"

/* `set`: names of sets of points, with commas between them, or NULL. Return the exit code. */
int bench_peers(const bench_settings *s, const char *set);
int bench_scale(const bench_settings *s, const char *set);

#endif
