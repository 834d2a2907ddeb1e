/* inflate.c - unpacks DEFLATE [RFC 1951] in zlib's wrapper [RFC 1950] or bare.
 *
 * A code of at most 15 bits is looked up in one table of 2^15 entries: the symbol and the length of
 * its code. Output stops where there is no room for it, between two bytes, and goes on with the
 * next call; input is all there from the beginning. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    LONGEST_CODE = 15,
    TABLE = 1 << LONGEST_CODE,
    WINDOW = 1 << 15,
    LENGTH_SYMBOLS = 288,
    DISTANCE_SYMBOLS = 30,
    END_OF_BLOCK = 256,
    ADLER_PRIME = 65521,
    ADLER_RUN = 5552 /* bytes whose sums surely fit in 32 bits */
};

typedef enum stage {
    STAGE_HEADER,
    STAGE_BLOCK,
    STAGE_STORED,
    STAGE_CODES,
    STAGE_SUM,
    STAGE_END
} stage;

/* entry[the next 15 bits] is symbol * 16 + length of its code; 0: no such code. */
typedef struct code_table {
    uint16_t entry[TABLE];
} code_table;

typedef struct inflater {
    stage stage;
    bool wrapped, last;
    uint64_t bits;
    unsigned bit_count;
    uint32_t adler;
    size_t at;               /* bytes made so far */
    uint32_t left, distance; /* of a stored block, or of a copy */
    uint8_t window[WINDOW];
    code_table lengths, distances;
} inflater;

static const uint16_t length_base[] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                       15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                       67, 83, 99, 115, 131, 163, 195, 227, 258};
static const uint8_t length_bits[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                      2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};

/* --- sums ------------------------------------------------------------------------------------- */

uLong crc32(uLong crc, const Bytef *bytes, uInt count)
{
    if (!bytes) return 0;
    uint32_t sum = ~(uint32_t)crc;
    for (uInt i = 0; i < count; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) sum = sum >> 1 ^ (0xedb88320u & -(sum & 1));
    }
    return (uLong)~sum;
}

uLong adler32(uLong adler, const Bytef *bytes, uInt count)
{
    if (!bytes) return 1;
    uint32_t a = (uint32_t)adler & 0xffff, b = (uint32_t)adler >> 16;
    while (count > 0) {
        uInt run = count < ADLER_RUN ? count : ADLER_RUN;
        for (uInt i = 0; i < run; i++) {
            a += bytes[i];
            b += a;
        }
        a %= ADLER_PRIME;
        b %= ADLER_PRIME;
        bytes += run;
        count -= run;
    }
    return (uLong)(b << 16 | a);
}

/* --- bits ------------------------------------------------------------------------------------- */

/* Have at least `count` bits, at most 32, if there are as many. */
static bool bits_fill(inflater *z, z_stream *in, unsigned count)
{
    while (z->bit_count < count && in->avail_in > 0) {
        z->bits |= (uint64_t)*in->next_in++ << z->bit_count;
        in->avail_in--;
        z->bit_count += 8;
    }
    return z->bit_count >= count;
}

static void bits_drop(inflater *z, unsigned count)
{
    z->bits >>= count;
    z->bit_count -= count;
}

static bool bits_take(inflater *z, z_stream *in, unsigned count, uint32_t *value)
{
    if (!bits_fill(z, in, count)) return false;
    *value = (uint32_t)(z->bits & ((1ull << count) - 1));
    bits_drop(z, count);
    return true;
}

/* --- codes ------------------------------------------------------------------------------------ */

static uint32_t code_reversed(uint32_t code, unsigned length)
{
    uint32_t reversed = 0;
    for (unsigned i = 0; i < length; i++) reversed |= (code >> i & 1) << (length - 1 - i);
    return reversed;
}

/* The canonical code of the lengths. Returns false if there are more codes than bits allow, or
 * fewer. As in zlib a code may be without symbols, and, if `lone`, of one symbol with one bit. */
static bool code_table_make(code_table *table, const uint8_t *lengths, unsigned count, bool lone)
{
    uint32_t used[LONGEST_CODE + 1] = {0}, next[LONGEST_CODE + 2] = {0}, codes = 0;
    memset(table, 0, sizeof *table);
    for (unsigned i = 0; i < count; i++) used[lengths[i]]++;
    used[0] = 0;
    for (unsigned length = 1; length <= LONGEST_CODE; length++) {
        next[length + 1] = (next[length] + used[length]) << 1;
        if (next[length] + used[length] > 1u << length) return false;
        codes += used[length];
    }
    bool complete = next[LONGEST_CODE] + used[LONGEST_CODE] == 1u << LONGEST_CODE;
    if (!complete && codes > 0 && !(lone && codes == used[1])) return false;
    for (unsigned i = 0; i < count; i++) {
        unsigned length = lengths[i];
        if (length == 0) continue;
        uint32_t code = code_reversed(next[length]++, length);
        for (uint32_t k = code; k < TABLE; k += 1u << length)
            table->entry[k] = (uint16_t)(i << 4 | length);
    }
    return true;
}

/* Only a code of no symbols or one has bits without a symbol: a single bit tells. */
static int code_take(inflater *z, z_stream *in, const code_table *table, uint32_t *symbol)
{
    bits_fill(z, in, LONGEST_CODE);
    unsigned entry = table->entry[z->bits & (TABLE - 1)], length = entry & 15;
    if (length > z->bit_count || z->bit_count == 0) return Z_BUF_ERROR;
    if (length == 0) return Z_DATA_ERROR;
    bits_drop(z, length);
    *symbol = entry >> 4;
    return Z_OK;
}

static bool codes_make_fixed(inflater *z)
{
    uint8_t lengths[LENGTH_SYMBOLS], distances[DISTANCE_SYMBOLS + 2];
    for (unsigned i = 0; i < LENGTH_SYMBOLS; i++)
        lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    memset(distances, 5, sizeof distances);
    return code_table_make(&z->lengths, lengths, LENGTH_SYMBOLS, false) &&
           code_table_make(&z->distances, distances, DISTANCE_SYMBOLS + 2, false);
}

/* The lengths of both codes, themselves coded, with runs of equal ones. */
static int codes_read_lengths(inflater *z, z_stream *in, uint8_t *lengths, unsigned count)
{
    for (unsigned i = 0; i < count;) {
        uint32_t symbol, run = 1, more = 0;
        int result = code_take(z, in, &z->lengths, &symbol);
        if (result != Z_OK) return result;
        if (symbol >= 16 && !bits_take(z, in, symbol == 16 ? 2 : symbol == 17 ? 3 : 7, &more))
            return Z_BUF_ERROR;
        if (symbol >= 16) run = more + (symbol == 18 ? 11 : 3);
        if (run > count - i || (symbol == 16 && i == 0)) return Z_DATA_ERROR;
        memset(lengths + i, symbol < 16 ? (int)symbol : symbol == 16 ? lengths[i - 1] : 0, run);
        i += run;
    }
    return Z_OK;
}

static int codes_read(inflater *z, z_stream *in)
{
    static const uint8_t order[] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                    11, 4,  12, 3, 13, 2, 14, 1, 15};
    uint8_t lengths[LENGTH_SYMBOLS + 32] = {0}, coded[19] = {0};
    uint32_t length_count, distance_count, coded_count, value;
    if (!bits_take(z, in, 5, &length_count) || !bits_take(z, in, 5, &distance_count) ||
        !bits_take(z, in, 4, &coded_count))
        return Z_BUF_ERROR;
    length_count += 257;
    distance_count += 1;
    if (length_count > 286 || distance_count > DISTANCE_SYMBOLS) return Z_DATA_ERROR;
    for (unsigned i = 0; i < coded_count + 4; i++) {
        if (!bits_take(z, in, 3, &value)) return Z_BUF_ERROR;
        coded[order[i]] = (uint8_t)value;
    }
    if (!code_table_make(&z->lengths, coded, 19, false)) return Z_DATA_ERROR;
    int result = codes_read_lengths(z, in, lengths, length_count + distance_count);
    if (result != Z_OK) return result;
    bool sound = lengths[END_OF_BLOCK] > 0 &&
                 code_table_make(&z->distances, lengths + length_count, distance_count, true) &&
                 code_table_make(&z->lengths, lengths, length_count, true);
    return sound ? Z_OK : Z_DATA_ERROR;
}

/* --- output ----------------------------------------------------------------------------------- */

static void output_put(inflater *z, z_stream *out, uint8_t byte)
{
    z->window[z->at++ % WINDOW] = byte;
    *out->next_out++ = byte;
    out->avail_out--;
}

static void output_copy(inflater *z, z_stream *out)
{
    for (; z->left > 0 && out->avail_out > 0; z->left--)
        output_put(z, out, z->window[(z->at - z->distance) % WINDOW]);
}

/* --- stages ----------------------------------------------------------------------------------- */

static int stage_header(inflater *z, z_stream *s)
{
    uint32_t head;
    if (z->wrapped) {
        if (!bits_take(z, s, 16, &head)) return Z_BUF_ERROR;
        uint32_t first = head & 255, second = head >> 8;
        bool deflate = (first & 15) == 8 && first >> 4 <= MAX_WBITS - 8;
        if (!deflate || (first * 256 + second) % 31 != 0 || second & 32) return Z_DATA_ERROR;
    }
    z->stage = STAGE_BLOCK;
    return Z_OK;
}

static int stage_block(inflater *z, z_stream *s)
{
    uint32_t last, kind, size;
    if (z->last) {
        z->stage = STAGE_SUM;
        return Z_OK;
    }
    if (!bits_take(z, s, 1, &last) || !bits_take(z, s, 2, &kind)) return Z_BUF_ERROR;
    z->last = last;
    z->stage = kind == 0 ? STAGE_STORED : STAGE_CODES;
    if (kind == 1) return codes_make_fixed(z) ? Z_OK : Z_DATA_ERROR;
    if (kind == 2) return codes_read(z, s);
    if (kind == 3) return Z_DATA_ERROR;
    bits_drop(z, z->bit_count % 8);
    if (!bits_take(z, s, 32, &size)) return Z_BUF_ERROR;
    z->left = size & 0xffff;
    return (size >> 16 ^ 0xffff) == z->left ? Z_OK : Z_DATA_ERROR;
}

static int stage_stored(inflater *z, z_stream *s)
{
    uint32_t byte;
    for (; z->left > 0 && s->avail_out > 0; z->left--) {
        if (!bits_take(z, s, 8, &byte)) return Z_BUF_ERROR;
        output_put(z, s, (uint8_t)byte);
    }
    if (z->left == 0) z->stage = STAGE_BLOCK;
    return Z_OK;
}

static int stage_codes_copy(inflater *z, z_stream *s, uint32_t symbol)
{
    uint32_t more, length, distance;
    symbol -= END_OF_BLOCK + 1;
    if (symbol >= sizeof length_bits) return Z_DATA_ERROR;
    if (!bits_take(z, s, length_bits[symbol], &more)) return Z_BUF_ERROR;
    length = length_base[symbol] + more;
    int result = code_take(z, s, &z->distances, &distance);
    if (result != Z_OK) return result;
    if (distance >= DISTANCE_SYMBOLS) return Z_DATA_ERROR;
    unsigned extra = distance < 4 ? 0 : distance / 2 - 1;
    uint32_t base = distance < 4 ? distance + 1 : ((2 + distance % 2) << extra) + 1;
    if (!bits_take(z, s, extra, &more)) return Z_BUF_ERROR;
    if (base + more > z->at || base + more > WINDOW) return Z_DATA_ERROR;
    z->distance = base + more;
    z->left = length;
    output_copy(z, s);
    return Z_OK;
}

static int stage_codes(inflater *z, z_stream *s)
{
    uint32_t symbol;
    output_copy(z, s);
    while (s->avail_out > 0) {
        int result = code_take(z, s, &z->lengths, &symbol);
        if (result == Z_OK && symbol == END_OF_BLOCK) {
            z->stage = STAGE_BLOCK;
            return Z_OK;
        }
        if (result == Z_OK && symbol < END_OF_BLOCK)
            output_put(z, s, (uint8_t)symbol);
        else if (result == Z_OK)
            result = stage_codes_copy(z, s, symbol);
        if (result != Z_OK) return result;
    }
    return Z_OK;
}

/* The sum of everything is compared; what was read too far is given back. */
static int stage_sum(inflater *z, z_stream *s)
{
    uint32_t byte, sum = 0;
    bits_drop(z, z->bit_count % 8);
    for (int i = 0; z->wrapped && i < 4; i++) {
        if (!bits_take(z, s, 8, &byte)) return Z_BUF_ERROR;
        sum = sum << 8 | byte;
    }
    if (z->wrapped && sum != z->adler) return Z_DATA_ERROR;
    for (; z->bit_count >= 8; z->bit_count -= 8) {
        s->next_in--;
        s->avail_in++;
    }
    z->stage = STAGE_END;
    return Z_STREAM_END;
}

/* One stage, as far as there is room. */
static int inflater_step(inflater *z, z_stream *s)
{
    switch (z->stage) {
    case STAGE_HEADER: return stage_header(z, s);
    case STAGE_BLOCK: return stage_block(z, s);
    case STAGE_STORED: return stage_stored(z, s);
    case STAGE_CODES: return stage_codes(z, s);
    default: return Z_STREAM_END;
    }
}

int inflateInit2(z_stream *stream, int window_bits)
{
    stream->state = calloc(1, sizeof *stream->state);
    if (!stream->state) return Z_MEM_ERROR;
    stream->state->wrapped = window_bits > 0;
    stream->state->adler = 1;
    return Z_OK;
}

int inflate(z_stream *stream, int flush)
{
    inflater *z = stream->state;
    Bytef *begin = stream->next_out;
    int result = Z_OK;
    (void)flush;
    if (z->stage == STAGE_END) return Z_STREAM_END;
    while (result == Z_OK && z->stage != STAGE_SUM) {
        result = inflater_step(z, stream);
        bool full = stream->avail_out == 0;
        if (full && (z->stage == STAGE_CODES || (z->stage == STAGE_STORED && z->left > 0))) break;
    }
    z->adler = (uint32_t)adler32(z->adler, begin, (uInt)(stream->next_out - begin));
    return z->stage == STAGE_SUM && result == Z_OK ? stage_sum(z, stream) : result;
}

int inflateEnd(z_stream *stream)
{
    free(stream->state);
    stream->state = NULL;
    return Z_OK;
}
