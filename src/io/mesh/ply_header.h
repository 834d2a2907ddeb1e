/* ply_header.h - the header of a PLY file: elements and their properties, in the order of the
 * data. Private. */
#ifndef MW_SRC_IO_MESH_PLY_HEADER_H
#define MW_SRC_IO_MESH_PLY_HEADER_H

#include "io/text/byte_source.h"

typedef enum mw_ply_kind { MW_PLY_ASCII, MW_PLY_LITTLE, MW_PLY_BIG } mw_ply_kind;

typedef enum mw_ply_type { MW_PLY_SIGNED, MW_PLY_UNSIGNED, MW_PLY_FLOAT } mw_ply_type;

typedef struct mw_ply_number {
    mw_ply_type type;
    uint8_t size; /* bytes in a binary file: 1, 2, 4 or 8 */
} mw_ply_number;

typedef struct mw_ply_property {
    char *name;
    mw_ply_number number; /* of the value, or of the items of a list */
    bool list;
    mw_ply_number count; /* of a list */
} mw_ply_property;

typedef struct mw_ply_element {
    char *name;
    uint64_t count; /* as announced */
    mw_ply_property *properties;
    size_t property_count;
} mw_ply_element;

typedef struct mw_ply_header {
    mw_ply_kind kind;
    mw_ply_element *elements;
    size_t element_count;
    char *crs; /* of the line "comment crs ..."; NULL without one */
} mw_ply_header;

/* Read up to and with "end_header". Release the header in any case. */
mw_status mw__ply_read_header(mw_source *source, mw_ply_header *header, mw_error *error);
void mw__ply_release_header(mw_ply_header *header);

/* Position of a property by name; property_count if there is none. */
size_t mw__ply_property(const mw_ply_element *element, const char *name);

#endif
