/* environment.h - what the environment asks of a test: MW_TEST_SEED=n other cases,
 * MW_TEST_LONG=1 many more, MW_TEST_SHORT=1 fewer. */
#ifndef MW_TESTS_SUPPORT_ENVIRONMENT_H
#define MW_TESTS_SUPPORT_ENVIRONMENT_H

#include <stdbool.h>
#include <stdint.h>

/* The seed in MW_TEST_SEED, or `usual` where the variable is not set. */
uint64_t environment_seed(uint64_t usual);

/* The same; prints it with the name of the test, so that a failure can be repeated. */
uint64_t environment_print_seed(const char *test, uint64_t usual);

/* Is MW_TEST_LONG set to anything but 0? Then a test may take hours. */
bool environment_is_long(void);

/* Is MW_TEST_SHORT set to anything but 0, for an emulator? Then tests that try very many cases try
 * fewer. */
bool environment_is_short(void);

#endif
