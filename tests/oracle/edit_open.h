/* edit_open.h - makes an editor and its twin. */
#ifndef MW_TESTS_ORACLE_EDIT_OPEN_H
#define MW_TESTS_ORACLE_EDIT_OPEN_H

#include "oracle/edit_twin.h"

/* An editor of the mesh, which the twin then owns, and its twin. Gives the mesh two fields,
 * unless twin_bare. Reads the constraints of the options, which may be NULL. */
void twin_open(twin *t, mw_mesh *mesh, const mw_editor_options *options);

/* Gives a mesh the fields that twins have. */
void twin_set_fields(mw_mesh *mesh);

#endif
