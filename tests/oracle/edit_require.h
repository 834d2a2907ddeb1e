/* edit_require.h - what the twin of an editor (edit_twin.h) requires: failures end the program
 * and name the seed, the step and the edit. It is not cmocka's, because fuzz targets use it as
 * well. */
#ifndef MW_TESTS_ORACLE_EDIT_REQUIRE_H
#define MW_TESTS_ORACLE_EDIT_REQUIRE_H

#include <meshwalk/meshwalk.h>
#include <stddef.h>
#include <stdint.h>

/* What runs now; tests keep it up to date for the message. */
typedef struct edit_case_now {
    const char *name;
    uint64_t seed, step;
    mw_edit edit;
} edit_case_now;
extern edit_case_now edit_case;

#define REQUIRE(right) ((right) ? (void)0 : require_failed(#right, __FILE__, __LINE__))

_Noreturn void require_failed(const char *what, const char *file, int line);

/* Memory for `count` elements and one more, all zero; grown, its new part not set; a copy. The
 * caller frees it. */
void *require_room(size_t count, size_t size);
void *require_more_room(void *memory, size_t count, size_t size);
void *require_copy(const void *memory, size_t count, size_t size);

#endif
