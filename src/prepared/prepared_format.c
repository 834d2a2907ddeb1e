/* prepared_format.c - which parts a prepared file has, and where. */
#include "prepared/prepared_format.h"

#include "base/checksum.h"
#include "base/hilbert.h"
#include "io/text/byte_source.h"
#include "locate/border_tree.h"

_Static_assert(sizeof(mw_point) == 16 && sizeof(mw_triangle) == 32 && sizeof(mw_key) == 8 &&
                   sizeof(mw_chains_edge) == 40 && sizeof(mw_border_edge) == 40 &&
                   sizeof(mw_box) == 32 && sizeof(mw_marked_edge) == 12 && sizeof(mw_lattice) == 72,
               "records of the file");
_Static_assert(sizeof(mw_prepared_facts) == 104 + 32 + 72 + 160 &&
                   sizeof(mw_prepared_header) == 32 + 368 + 24 * MW_PART_COUNT,
               "no gaps in the header");

static const struct {
    const char *name;
    uint32_t size; /* of a record, in bytes */
} parts[MW_PART_COUNT] = {
    [MW_PART_POINTS] = {"points", sizeof(mw_point)},
    [MW_PART_TRIANGLES] = {"triangles", sizeof(mw_triangle)},
    [MW_PART_TRIANGLE_SLOTS] = {"triangle slots", sizeof(uint32_t)},
    [MW_PART_VERTEX_SLOTS] = {"vertex slots", sizeof(uint32_t)},
    [MW_PART_VERTEX_NUMBERS] = {"vertex numbers", sizeof(uint32_t)},
    [MW_PART_TILES] = {"tiles", sizeof(mw_triangle)},
    [MW_PART_OWNERS] = {"owners", sizeof(uint32_t)},
    [MW_PART_CELLS] = {"cells", sizeof(uint32_t)},
    [MW_PART_SAMPLES] = {"samples", sizeof(mw_key)},
    [MW_PART_BUCKETS] = {"buckets", sizeof(uint32_t)},
    [MW_PART_CHAIN_EDGES] = {"chain edges", sizeof(mw_chains_edge)},
    [MW_PART_CHAIN_STARTS] = {"chain starts", sizeof(uint32_t)},
    [MW_PART_CHAIN_TILES] = {"chain tiles", sizeof(uint32_t)},
    [MW_PART_BORDER_EDGES] = {"border edges", sizeof(mw_border_edge)},
    [MW_PART_BORDER_BOXES] = {"border boxes", sizeof(mw_box)},
    [MW_PART_FIELDS] = {"fields", sizeof(double)},
    [MW_PART_TRIANGLE_FIELDS] = {"triangle fields", sizeof(double)},
    [MW_PART_FACES] = {"faces", sizeof(uint32_t)},
    [MW_PART_MARKED_EDGES] = {"marked edges", sizeof(mw_marked_edge)},
    [MW_PART_NAMES] = {"names", 1},
};

const char *mw__prepared_part_name(mw_prepared_kind kind)
{
    return parts[kind].name;
}

static uint64_t count_if(const mw_prepared_facts *f, uint32_t flag, uint64_t count)
{
    return f->flags & flag ? count : 0;
}

static uint64_t count_of_guide(const mw_prepared_facts *f, mw_prepared_kind kind)
{
    const bool grid = f->guide == MW_GUIDE_GRID || f->guide == MW_GUIDE_CURVE,
               curve = f->guide == MW_GUIDE_CURVE, chains = f->chain_edges > 0;
    switch (kind) {
    case MW_PART_CELLS: return grid ? (uint64_t)f->lattice.columns * f->lattice.rows : 0;
    case MW_PART_SAMPLES: return curve ? f->samples : 0;
    case MW_PART_BUCKETS: return curve ? (UINT64_C(1) << (32 - f->sample_shift)) + 1 : 0;
    case MW_PART_CHAIN_EDGES: return f->chain_edges;
    case MW_PART_CHAIN_STARTS: return chains ? (uint64_t)f->chain_tiles + 3 : 0;
    default: return chains ? (uint64_t)f->chain_tiles + 2 : 0;
    }
}

static uint64_t count_of_boxes(const mw_prepared_facts *f)
{
    mw_box_tree tree;
    return count_if(f, MW_PREPARED_BORDER, mw__box_tree_lay_out(&tree, f->border_edges));
}

uint64_t mw__prepared_part_count(const mw_prepared_facts *f, mw_prepared_kind kind)
{
    switch (kind) {
    case MW_PART_POINTS:
    case MW_PART_OWNERS: return f->points;
    case MW_PART_TRIANGLES: return f->triangles;
    case MW_PART_TRIANGLE_SLOTS: return count_if(f, MW_PREPARED_TRIANGLES_LAID, f->triangles);
    case MW_PART_VERTEX_SLOTS:
    case MW_PART_VERTEX_NUMBERS: return count_if(f, MW_PREPARED_LAID_OUT, f->points);
    case MW_PART_TILES: return count_if(f, MW_PREPARED_OWN_TILES, f->tiles);
    case MW_PART_CELLS:
    case MW_PART_SAMPLES:
    case MW_PART_BUCKETS:
    case MW_PART_CHAIN_EDGES:
    case MW_PART_CHAIN_STARTS:
    case MW_PART_CHAIN_TILES: return count_of_guide(f, kind);
    case MW_PART_BORDER_EDGES: return count_if(f, MW_PREPARED_BORDER, f->border_edges);
    case MW_PART_BORDER_BOXES: return count_of_boxes(f);
    case MW_PART_FIELDS: return (uint64_t)f->fields * f->points;
    case MW_PART_TRIANGLE_FIELDS: return (uint64_t)f->triangle_fields * f->triangles;
    case MW_PART_FACES: return count_if(f, MW_PREPARED_FACES, f->triangles);
    case MW_PART_MARKED_EDGES: return f->marked_edges;
    case MW_PART_NAMES: return f->name_bytes;
    case MW_PART_COUNT: break;
    }
    return 0;
}

static uint64_t offset_aligned(uint64_t offset)
{
    return (offset + MW_PREPARED_ALIGN - 1) / MW_PREPARED_ALIGN * MW_PREPARED_ALIGN;
}

void mw__prepared_lay_out(mw_prepared_header *header)
{
    uint64_t offset = offset_aligned(sizeof *header);
    for (int kind = 0; kind < MW_PART_COUNT; kind++) {
        mw_prepared_part *part = &header->part[kind];
        part->bytes =
            mw__prepared_part_count(&header->facts, (mw_prepared_kind)kind) * parts[kind].size;
        part->offset = part->bytes ? offset : 0;
        offset = offset_aligned(offset + part->bytes);
    }
    header->bytes = offset;
}

uint64_t mw__prepared_header_checksum(const mw_prepared_header *header)
{
    mw_prepared_header plain = *header;
    plain.checksum = 0;
    return mw__checksum_of(&plain, sizeof plain);
}

static bool guide_fits(const mw_prepared_facts *f)
{
    const mw_lattice *l = &f->lattice;
    switch (f->guide) {
    case MW_GUIDE_NONE: return true;
    case MW_GUIDE_CHAINS: return f->chain_edges > 0 && f->chain_tiles == f->tiles;
    case MW_GUIDE_CURVE:
        if (f->samples < 3 || f->sample_shift < 1 || f->sample_shift > 31) return false;
        break;
    case MW_GUIDE_GRID: break;
    default: return false;
    }
    return l->columns > 0 && l->rows > 0 && (uint64_t)l->columns * l->rows <= MW_MAX_CELLS;
}

static bool tiles_fit(const mw_prepared_facts *f)
{
    if (f->tiles < 1 || f->tiles > MW_MAX_TRIANGLES || f->ghosts >= f->tiles ||
        f->centre >= f->tiles)
        return false;
    if (f->flags & MW_PREPARED_OWN_TILES) return true;
    return f->tiles == f->triangles && f->ghosts == 0 && f->holes == 0 && f->flat == 0 &&
           !(f->flags & MW_PREPARED_CUT);
}

bool mw__prepared_facts_fit(const mw_prepared_facts *f)
{
    return !(f->flags & ~(uint32_t)MW_PREPARED_FLAGS) && f->chain_tiles <= MW_MAX_TRIANGLES &&
           f->points >= 3 && f->points <= MW_MAX_VERTICES && f->triangles >= 1 &&
           f->triangles <= MW_MAX_TRIANGLES && f->flat < f->triangles && tiles_fit(f) &&
           guide_fits(f) && f->fields <= MW_COLUMN_LIMIT && f->triangle_fields <= MW_COLUMN_LIMIT &&
           f->border_edges <= 3 * (uint64_t)MW_MAX_TRIANGLES && f->marks <= f->name_bytes &&
           f->first_number <= 1;
}
