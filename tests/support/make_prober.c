/* make_prober.c - a prober with boxes. */
#include "support/make_prober.h"

#include "support/meshes.h"

mw_prober *prober_with_boxes(const mw_surface *surface)
{
    mw_prober *prober;
    mw_error error;
    expect_ok(mw_prober_create(surface, &(mw_prober_options){.boxes = 1}, &prober, &error),
              "prober", &error);
    return prober;
}
