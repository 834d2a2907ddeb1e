/* probers.h - what tests of probers share: a seed, a prober of a surface. */
#ifndef MW_TEST_PROBERS_H
#define MW_TEST_PROBERS_H

#include "shapes.h"
#include "surface/prober.h"

/* The usual seed of a test program, or that of MW_TEST_SEED; it is printed with the name of the test. */
static inline uint64_t probers_seed(const char *name, uint64_t usual)
{
    const char *given = getenv("MW_TEST_SEED");
    uint64_t seed = given ? strtoull(given, NULL, 0) : usual;
    printf("%s: seed %llu\n", name, (unsigned long long)seed);
    return seed;
}

/* With boxes. */
static inline mw_prober *new_prober(const mw_surface *surface)
{
    mw_prober *prober;
    mw_error error;
    expect_ok(mw_prober_create(surface, &(mw_prober_options){.boxes = 1}, &prober, &error), "prober", &error);
    return prober;
}

#endif
