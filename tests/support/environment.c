/* environment.c - seeds and long runs, from environment variables. */
#include "support/environment.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint64_t environment_seed(uint64_t usual)
{
    const char *given = getenv("MW_TEST_SEED");
    return given ? strtoull(given, NULL, 0) : usual;
}

uint64_t environment_print_seed(const char *test, uint64_t usual)
{
    uint64_t seed = environment_seed(usual);
    printf("%s: seed %llu\n", test, (unsigned long long)seed);
    return seed;
}

static bool environment_is_set(const char *name)
{
    const char *text = getenv(name);
    return text && strcmp(text, "0") != 0;
}

bool environment_is_long(void)
{
    return environment_is_set("MW_TEST_LONG");
}

bool environment_is_short(void)
{
    return environment_is_set("MW_TEST_SHORT");
}
