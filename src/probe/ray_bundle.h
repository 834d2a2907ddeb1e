/* ray_bundle.h - rays that lie close together are searched for as one. Private.
 *
 * A bundle of rays with the same signs of their directions has a hull: on each axis, least and
 * greatest coordinates of where rays begin, and of 1 / m. A box that any of the rays meets is met
 * by the hull: (side - q) / m is monotonic in q and in 1 / m, and so are the differences, products
 * and roundings of floats by which bvh_beam.h tests a single ray. So one search visits the nodes
 * for all rays; only the boxes of triangles that the hull meets are tested against each ray, eight
 * rays at a time, and what is left by exact predicates, as everywhere. */
#ifndef MW_SRC_PROBE_RAY_BUNDLE_H
#define MW_SRC_PROBE_RAY_BUNDLE_H

#include "probe/ray.h"

#define MW_BUNDLE_RAYS 16

/* Search for the nearest triangle of each of MW_BUNDLE_RAYS rays: of the queries at `queries`, six
 * numbers each, `stride` apart. Returns whether they were close enough together; then searches have
 * ended, and hold the answers. Else nothing is known of them. The BVH must be up to date. */
bool mw__ray_bundle_run(const mw_prober *prober, const mw_probe_options *options,
                        const double *queries, size_t stride, mw_ray_query ray[MW_BUNDLE_RAYS],
                        mw_ray_search search[MW_BUNDLE_RAYS]);

#endif
