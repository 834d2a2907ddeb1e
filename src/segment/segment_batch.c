/* segment_batch.c - the pieces of many segments, in chunks for the threads. */
#include "segment/segment_run.h"

#include "base/cache.h"
#include "base/job.h"
#include "base/options.h"
#include "segment/segment.h"
#include "walk/remembering_fast.h"

#include <stdlib.h>
#include <string.h>

/* Segments of a chunk; those of a lane come one after the other. In a mesh that caches do not hold,
 * lanes take turns, and memory is asked for what they need next. */
enum { BATCH_CHUNK = 1024, BATCH_MOST_LANES = 32, BATCH_LOCATING_STEPS = 64 };
_Static_assert(BATCH_CHUNK % MW_INDEX_MANY == 0, "groups of first tiles fill a chunk");

/* What the segments of one chunk have given. */
typedef struct segments_chunk {
    mw_segment_piece *piece;
    size_t count, bad;
} segments_chunk;

typedef struct segment_batch {
    const mw_locator *locator;
    const double *segments;
    size_t n, stride;
    uint32_t lanes;
    mw_cursor cursor;      /* each chunk has a copy */
    segments_chunk *chunk; /* [chunk] */
    size_t *offset;        /* at i + 1: the number of pieces of segment i, later their end */
    mw_segment_piece *piece;
    bool in_order;      /* one thread answers chunk after chunk: pieces are appended at once */
    size_t count, room; /* of pieces, then */
    mw_job *job;
    atomic_bool no_memory;
} segment_batch;

/* Segments first .. end - 1, one at a time. */
typedef struct segments_follower {
    mw_segment s;
    mw_cursor *cursor;
    const uint32_t *tile; /* near the beginning of each segment, from `first` on */
    size_t first, at, end;
    uint32_t locating; /* steps that may still lead nearer to the beginning */
    bool continues;    /* s has come to the end of the segment before */
    mw_segment_piece *piece;
    size_t count, room, begun; /* begun: the first piece of this segment */
    size_t bad;
} segments_follower;

static const double *segments_ends(const segment_batch *b, size_t i)
{
    return b->segments + i * b->stride;
}

static bool segments_is_finite(const double *ends)
{
    return isfinite(ends[0]) && isfinite(ends[1]) && isfinite(ends[2]) && isfinite(ends[3]);
}

/* Tiles near the beginnings of count segments, from the locator's guide; memory is asked for
 * them. */
static void segments_find_first_tiles(const segment_batch *b, size_t first, uint32_t count,
                                      uint32_t *tile)
{
    const mw_locator *locator = b->locator;
    mw_point a[MW_INDEX_MANY];
    for (uint32_t i = 0; i < count; i++) {
        const double *ends = segments_ends(b, first + i);
        bool finite = segments_is_finite(ends);
        a[i] = (mw_point){finite ? ends[0] : locator->low[0], finite ? ends[1] : locator->low[1]};
        tile[i] = b->cursor.last;
    }
    if (locator->guide.start != MW_START_AUTO)
        mw__index_first_many(&locator->tiling, &locator->guide, a, count, tile);
}

/* Make room for `more` pieces; with these, `done` segments have theirs. The room is enough for all
 * segments if the others have equally many each, so that pieces are not copied again. */
static bool batch_make_room(segment_batch *b, size_t more, size_t done)
{
    const size_t wanted = b->count + more, least = wanted + wanted / 2;
    const double guess = done ? 1.05 * (double)wanted / (double)done * (double)b->n : 0,
                 most = 16 * (double)wanted; /* the others may be shorter */
    if (wanted <= b->room) return true;
    size_t room = guess < (double)least ? least : (size_t)(guess < most ? guess : most);
    mw_segment_piece *piece = mw__alloc_lines(room, sizeof *piece);
    if (!piece && room > least) piece = mw__alloc_lines(room = least, sizeof *piece);
    if (!piece) return false;
    if (b->count) memcpy(piece, b->piece, b->count * sizeof *piece);
    free(b->piece);
    b->piece = piece;
    b->room = room;
    return true;
}

/* --- lanes --- */

/* The lane's pieces are those of the batch: it appends to them. */
static bool batch_is_appended_to(const segment_batch *b)
{
    return b->in_order && b->lanes == 1;
}

static void follower_take_pieces(segments_follower *lane, const segment_batch *b)
{
    lane->piece = b->piece;
    lane->count = b->count;
    lane->room = b->room;
}

static bool follower_make_room(segment_batch *b, segments_follower *lane)
{
    enum { MORE = 256 };
    if (batch_is_appended_to(b)) {
        b->count = lane->count;
        if (!batch_make_room(b, MORE, lane->at)) return false;
        follower_take_pieces(lane, b);
        return true;
    }
    size_t room = 2 * lane->room + MORE;
    mw_segment_piece *piece = mw__realloc(lane->piece, room, sizeof *piece);
    if (!piece) return false;
    lane->piece = piece;
    lane->room = room;
    return true;
}

/* Begin the segment, near which the lane is. There is room for a piece. */
static void follower_set(const segment_batch *b, segments_follower *lane)
{
    const double *ends = segments_ends(b, lane->at);
    if (MW_LIKELY(!b->locator->tiling.cut) &&
        MW_LIKELY(mw__segment_begin_inside(&lane->s, b->locator, lane->s.tile, ends, ends + 2,
                                           lane->piece + lane->count, &lane->count)))
        return;
    lane->cursor->last = lane->s.tile;
    mw__segment_set(&lane->s, b->locator, lane->cursor, ends, ends + 2);
}

/* Begin with segment lane->at, or the next one that is finite. False: there is none. */
static bool follower_begin(const segment_batch *b, segments_follower *lane)
{
    for (; lane->at < lane->end; lane->at++) {
        const double *ends = segments_ends(b, lane->at);
        lane->begun = lane->count;
        if (segments_is_finite(ends)) break;
        lane->bad++;
        lane->continues = false;
    }
    if (lane->at == lane->end) return false;
    const double *a = segments_ends(b, lane->at);
    if (lane->continues && a[0] == lane->s.b[0] && a[1] == lane->s.b[1]) {
        lane->locating = 1;
        return true;
    }
    lane->s.tile = lane->tile[lane->at - lane->first];
    lane->locating = BATCH_LOCATING_STEPS;
    return true;
}

static bool follower_end_segment(const segment_batch *b, segments_follower *lane)
{
    b->offset[lane->at + 1] = lane->count - lane->begun;
    lane->continues = true;
    lane->at++;
    return follower_begin(b, lane);
}

/* Walk one step towards the beginning of the segment; if it is reached, begin the segment. */
static MW_INLINE void follower_locate(const segment_batch *b, segments_follower *lane)
{
    const double *a = segments_ends(b, lane->at);
    if (--lane->locating > 0) {
        uint32_t link = mw__link_nearer(&b->locator->tiling, (mw_point){a[0], a[1]}, lane->s.tile);
        if (link != MW_NONE && mw__link_triangle(link) != lane->s.tile) {
            lane->s.tile = mw__link_triangle(link);
            return;
        }
    }
    lane->locating = 0;
    follower_set(b, lane);
}

/* The next pieces of the lane's segment, for which there is room. False: it has ended. */
static MW_INLINE bool follower_go_on(const segment_batch *b, segments_follower *lane)
{
    mw_segment *s = &lane->s;
    mw_segment_piece *piece = lane->piece + lane->count;
    if (mw__segment_may_run(s)) {
        bool sure = b->lanes > 1
                        ? mw__segment_run(s, false, piece, &lane->count)
                        : mw__segment_run_far(s, lane->room - lane->count, piece, &lane->count);
        if (s->phase == MW_SEGMENT_ENDED) return false;
        if (sure || lane->count == lane->room) return true;
        piece = lane->piece + lane->count;
    }
    bool more = mw__segment_next_surely(s, piece);
    lane->count += more;
    return more;
}

/* False: the lane has no more segments, or there is no memory. */
static MW_INLINE bool follower_step(segment_batch *b, segments_follower *lane)
{
    if (MW_UNLIKELY(lane->count == lane->room) && !follower_make_room(b, lane)) {
        atomic_store_explicit(&b->no_memory, true, memory_order_relaxed);
        return false;
    }
    if (lane->locating) {
        follower_locate(b, lane);
        return true;
    }
    return follower_go_on(b, lane) || follower_end_segment(b, lane);
}

/* Lanes take turns. After a step memory is asked for the new tile; half a lap later, when that has
 * come, for its vertices. */
static void followers_run(segment_batch *b, segments_follower *lanes, uint32_t count)
{
    const mw_tiling *tiling = &b->locator->tiling;
    segments_follower *alive[BATCH_MOST_LANES];
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++)
        if (follower_begin(b, &lanes[i])) alive[n++] = &lanes[i];
    for (uint32_t i = 0, ahead = n / 2; n > 0;) {
        if (!follower_step(b, alive[i])) {
            alive[i] = alive[--n];
            ahead = n / 2;
            if (i >= n) i = 0;
            continue;
        }
        if (n > 1) {
            uint32_t j = i + ahead < n ? i + ahead : i + ahead - n;
            const uint32_t *v = tiling->tri[alive[j]->s.tile].v;
            __builtin_prefetch(&tiling->tri[alive[i]->s.tile]);
            for (uint32_t k = 0; k < 3; k++) __builtin_prefetch(&tiling->point[v[k]]);
        }
        if (++i == n) i = 0;
    }
}

/* --- chunks --- */

/* The chunk has the pieces of its only lane. */
static void chunk_take(segments_chunk *chunk, segments_follower *lane)
{
    mw_segment_piece *fits = mw__realloc(lane->piece, lane->count, sizeof *fits);
    chunk->piece = fits ? fits : lane->piece;
    chunk->count = lane->count;
    lane->piece = NULL;
}

/* The pieces of all lanes, in the order of the segments. */
static bool chunk_join(segments_chunk *chunk, segments_follower *lanes, uint32_t count)
{
    size_t all = 0;
    if (count == 1) {
        chunk_take(chunk, lanes);
        return true;
    }
    for (uint32_t i = 0; i < count; i++) all += lanes[i].count;
    chunk->piece = mw__alloc(all, sizeof *chunk->piece);
    if (!chunk->piece) return false;
    for (uint32_t i = 0; i < count; i++) {
        if (lanes[i].count)
            memcpy(chunk->piece + chunk->count, lanes[i].piece,
                   lanes[i].count * sizeof *chunk->piece);
        chunk->count += lanes[i].count;
    }
    return true;
}

/* Append the pieces of all lanes; `done` segments have theirs then. */
static bool batch_append(segment_batch *b, segments_follower *lanes, uint32_t count, size_t done)
{
    size_t all = 0;
    if (batch_is_appended_to(b)) {
        b->count = lanes->count;
        lanes->piece = NULL;
        return true;
    }
    for (uint32_t i = 0; i < count; i++) all += lanes[i].count;
    if (!batch_make_room(b, all, done)) return false;
    for (uint32_t i = 0; i < count; i++) {
        if (lanes[i].count)
            memcpy(b->piece + b->count, lanes[i].piece, lanes[i].count * sizeof *b->piece);
        b->count += lanes[i].count;
    }
    return true;
}

static void segments_answer_chunk(void *work, uint64_t number, uint32_t member)
{
    segment_batch *b = work;
    segments_follower lanes[BATCH_MOST_LANES];
    uint32_t tile[BATCH_CHUNK], count = b->lanes;
    mw_cursor cursor = b->cursor;
    size_t first = (size_t)number * BATCH_CHUNK,
           size = b->n - first < BATCH_CHUNK ? b->n - first : BATCH_CHUNK;
    (void)member;
    if (atomic_load_explicit(&b->no_memory, memory_order_relaxed)) return;
    for (size_t i = 0; i < size; i += MW_INDEX_MANY)
        segments_find_first_tiles(b, first + i,
                                  (uint32_t)(size - i < MW_INDEX_MANY ? size - i : MW_INDEX_MANY),
                                  tile + i);
    for (uint32_t i = 0; i < count; i++) {
        size_t from = size * i / count;
        lanes[i] = (segments_follower){.cursor = &cursor,
                                       .tile = tile + from,
                                       .first = first + from,
                                       .at = first + from,
                                       .end = first + size * (i + 1) / count};
    }
    if (batch_is_appended_to(b)) follower_take_pieces(lanes, b);
    followers_run(b, lanes, count);
    segments_chunk *chunk = &b->chunk[number];
    for (uint32_t i = 0; i < count; i++) chunk->bad += lanes[i].bad;
    if (!(b->in_order ? batch_append(b, lanes, count, first + size)
                      : chunk_join(chunk, lanes, count)))
        atomic_store_explicit(&b->no_memory, true, memory_order_relaxed);
    for (uint32_t i = 0; i < count; i++) free(lanes[i].piece);
}

/* The pieces of a chunk go to their place. */
static void segments_collect_chunk(void *work, uint64_t number, uint32_t member)
{
    segment_batch *b = work;
    segments_chunk *chunk = &b->chunk[number];
    (void)member;
    if (chunk->count)
        memcpy(b->piece + b->offset[(size_t)number * BATCH_CHUNK], chunk->piece,
               chunk->count * sizeof *chunk->piece);
    free(chunk->piece);
    chunk->piece = NULL;
}

/* The pieces of all chunks, one after another. */
static mw_status segments_collect(segment_batch *b, uint32_t team, size_t chunks, mw_error *error)
{
    b->piece = mw__alloc_lines(b->offset[b->n], sizeof *b->piece);
    if (!b->piece) return mw__fail_memory(error);
    mw__job_stage(b->job, "collecting pieces", 0.1);
    if (!mw__job_chunks(b->job, team, chunks, segments_collect_chunk, b))
        return mw__fail_memory(error);
    return MW_OK;
}

/* Give back the room that was too much. */
static mw_status segments_fit(segment_batch *b, mw_error *error)
{
    mw_segment_piece *piece = b->piece ? mw__realloc(b->piece, b->count, sizeof *piece)
                                       : mw__alloc_lines(0, sizeof *piece);
    if (!piece) return mw__fail_memory(error);
    b->piece = piece;
    return MW_OK;
}

static mw_status segments_run(segment_batch *b, mw_segment_pieces *pieces, mw_error *error)
{
    size_t chunks = (b->n + BATCH_CHUNK - 1) / BATCH_CHUNK;
    uint32_t team = mw__job_team(b->job, chunks);
    b->in_order = team == 1;
    mw__job_stage(b->job, "following segments", b->in_order ? 1 : 0.9);
    if (!mw__job_chunks(b->job, team, chunks, segments_answer_chunk, b) || b->no_memory)
        return mw__fail_memory(error);
    for (size_t i = 0; i < b->n; i++) b->offset[i + 1] += b->offset[i];
    for (size_t i = 0; i < chunks; i++) pieces->bad_count += b->chunk[i].bad;
    return b->in_order ? segments_fit(b, error) : segments_collect(b, team, chunks, error);
}

static mw_status segments_check(const mw_locator *locator, const double *segments, size_t n,
                                size_t stride, const mw_segment_pieces *pieces, mw_error *error)
{
    mw_status status = mw__segment_check_locator(locator, error);
    if (status) return status;
    if ((n && !segments) || !pieces)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the segments or the results are NULL");
    if (stride == 1 || stride == 3)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "a stride of %zu is too small for a segment: it must be 2 or at least 4",
                        stride);
    return MW_OK;
}

/* Do lanes take turns? They do where the mesh is much larger than the cache of a core. */
static uint32_t segments_choose_lanes(const mw_tiling *tiling)
{
    enum { CACHES = 2 };
    size_t bytes =
        tiling->tri_count * sizeof *tiling->tri + tiling->point_count * sizeof *tiling->point;
    return bytes / CACHES > mw__caches().second ? BATCH_MOST_LANES : 1;
}

/* Makes everything, or nothing. */
static mw_status segments_make(segment_batch *b, mw_segment_pieces *pieces, mw_error *error)
{
    size_t chunks = (b->n + BATCH_CHUNK - 1) / BATCH_CHUNK;
    b->chunk = mw__calloc(chunks, sizeof *b->chunk);
    b->offset = mw__calloc(b->n + 1, sizeof *b->offset);
    mw_status status =
        b->chunk && b->offset ? segments_run(b, pieces, error) : mw__fail_memory(error);
    for (size_t i = 0; b->chunk && i < chunks; i++) free(b->chunk[i].piece);
    free(b->chunk);
    return mw__job_end(b->job, status, error);
}

mw_status mw_segment_batch(const mw_locator *locator, const double *segments, size_t n,
                           size_t stride, const mw_segment_options *options,
                           mw_segment_pieces *pieces, mw_error *error)
{
    static const mw_segment_options defaults;
    if (!options) options = &defaults;
    if (pieces) *pieces = (mw_segment_pieces){0};
    mw_status status = segments_check(locator, segments, n, stride, pieces, error);
    if (!status) status = MW_RESERVED_CHECK(mw_segment_options, options, error);
    if (status) return status;
    mw_job job = mw__job(options->threads, options->progress);
    segment_batch b = {.locator = locator,
                       .segments = segments,
                       .n = n,
                       .stride = stride ? stride : 4,
                       .lanes = segments_choose_lanes(&locator->tiling),
                       .job = &job};
    status = mw_cursor_init(locator, NULL, &b.cursor, error);
    if (status) return status;
    status = segments_make(&b, pieces, error);
    if (status) {
        free(b.piece);
        free(b.offset);
        *pieces = (mw_segment_pieces){0};
        return status;
    }
    pieces->offset = b.offset;
    pieces->piece = b.piece;
    pieces->segment_count = n;
    pieces->piece_count = b.offset[n];
    return MW_OK;
}

void mw_segment_pieces_release(mw_segment_pieces *pieces)
{
    if (!pieces) return;
    free(pieces->offset);
    free(pieces->piece);
    *pieces = (mw_segment_pieces){0};
}
