/* prepared_bytes.h - prepared files as bytes that tests change: made, repaired, and queried. */
#ifndef MW_TESTS_ORACLE_PREPARED_PREPARED_BYTES_H
#define MW_TESTS_ORACLE_PREPARED_PREPARED_BYTES_H

#include "prepared/prepared.h"

/* Make the checksums right again, so that what has been changed is looked at itself. Bytes that end
 * within the header stay as they are. `bytes` are at a multiple of MW_PREPARED_ALIGN. */
void prepared_bytes_repair(unsigned char *bytes, size_t size);

/* Ask everything of a mesh and a locator from a file: every query has to end, and where nothing is
 * cut, to have the right answer, which is looked for among all triangles. False: a wrong one. */
bool prepared_bytes_query(const mw_prepared *p);

#endif
