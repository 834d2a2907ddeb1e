/* make_prober.h - a prober for tests of what the boxes of a surface find. */
#ifndef MW_TESTS_SUPPORT_MAKE_PROBER_H
#define MW_TESTS_SUPPORT_MAKE_PROBER_H

#include <meshwalk/meshwalk.h>

/* A prober of the surface that keeps boxes; ends the program where that fails. The caller
 * destroys it. */
mw_prober *prober_with_boxes(const mw_surface *surface);

#endif
