/* migrate.c - particles move to the rank that has their triangle. */
#include "mpi/mesh/mesh.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 1 << 16 };

/* What travels: this, then the payload, filled up to a multiple of 8 bytes. */
typedef struct traveller {
    mwp_location at;
    uint64_t index; /* its place among the particles of its former rank */
    int32_t from;
    uint32_t reserved;
} traveller;

typedef struct migration {
    mwp_mesh *mesh;
    const mwp_location *at;
    const char *payload;
    size_t n, next, bytes, record;
    char *here; /* travellers that have arrived, or stay */
    size_t count, room;
} migration;

static mw_status migration_add(migration *m, const void *records, size_t n, mwp_error *error)
{
    if (m->count + n > m->room) {
        const size_t room = 2 * (m->count + n);
        char *grown = m->record > SIZE_MAX / room ? NULL : realloc(m->here, room * m->record);
        if (!grown) return mwp__fail_memory(error);
        m->here = grown;
        m->room = room;
    }
    mwp__copy(m->here + m->count * m->record, records, n * m->record);
    m->count += n;
    return MW_OK;
}

static void traveller_write(const migration *m, size_t i, char *record)
{
    const traveller t = {.at = m->at[i], .index = i, .from = m->mesh->wire.rank};
    memset(record, 0, m->record);
    memcpy(record, &t, sizeof t);
    if (m->bytes) memcpy(record + sizeof t, m->payload + i * m->bytes, m->bytes);
}

static bool particle_stays(const migration *m, size_t i)
{
    return m->at[i].rank < 0 || m->at[i].rank == m->mesh->wire.rank;
}

static mw_status block_stay(migration *m, size_t begin, size_t end, mwp_error *error)
{
    char *record = mwp__alloc(1, m->record);
    mw_status status = record ? MW_OK : mwp__fail_memory(error);
    for (size_t i = begin; i < end && !status; i++) {
        if (!particle_stays(m, i)) continue;
        traveller_write(m, i, record);
        status = migration_add(m, record, 1, error);
    }
    free(record);
    return status;
}

static mw_status migrate_load(void *self, mwp_parcels *questions, bool *more, mwp_error *error)
{
    migration *m = self;
    const size_t begin = m->next, end = m->n - begin > BLOCK ? begin + BLOCK : m->n;
    m->next = end;
    *more = end < m->n;
    mw_status status = block_stay(m, begin, end, error);
    uint32_t *count = calloc((size_t)m->mesh->wire.size, sizeof *count);
    for (size_t i = begin; count && i < end; i++)
        if (!particle_stays(m, i)) count[m->at[i].rank]++;
    if (!status && (!count || !mwp__parcels_create(questions, &m->mesh->wire, m->record, count)))
        status = mwp__fail_memory(error);
    for (size_t i = begin; i < end && !status; i++)
        if (!particle_stays(m, i))
            traveller_write(m, i, mwp__parcels_add(questions, m->at[i].rank));
    free(count);
    return status;
}

static mw_status migrate_answer(void *self, const void *questions, size_t n, void *answers,
                                size_t *count, mwp_error *error)
{
    (void)answers;
    *count = 0;
    return migration_add(self, questions, n, error);
}

static void migrate_take(void *self, int rank, size_t first, const void *answers, size_t n)
{
    (void)self;
    (void)rank;
    (void)first;
    (void)answers;
    (void)n;
}

static mw_status migrate_settle(void *self, mwp_error *error)
{
    (void)self;
    (void)error;
    return MW_OK;
}

/* --- the order of what has arrived ------------------------------------------------------------ */

typedef struct arrival {
    uint64_t index;
    size_t place;
    int32_t from;
} arrival;

static int compare_arrivals(const void *left, const void *right)
{
    const arrival *a = left, *b = right;
    if (a->from != b->from) return a->from < b->from ? -1 : 1;
    return a->index < b->index ? -1 : a->index > b->index;
}

static bool particles_unpack(const migration *m, mwp_particles *out)
{
    arrival *order = mwp__alloc(m->count, sizeof *order);
    out->locations = mwp__alloc(m->count, sizeof *out->locations);
    out->payload = mwp__alloc(m->count, m->bytes);
    out->count = m->count;
    const bool room = order && out->locations && out->payload;
    for (size_t i = 0; room && i < m->count; i++) {
        traveller t;
        memcpy(&t, m->here + i * m->record, sizeof t);
        order[i] = (arrival){t.index, i, t.from};
    }
    if (room) qsort(order, m->count, sizeof *order, compare_arrivals);
    for (size_t i = 0; room && i < m->count; i++) {
        const char *record = m->here + order[i].place * m->record;
        memcpy(&out->locations[i], record, sizeof *out->locations);
        mwp__copy((char *)out->payload + i * m->bytes, record + sizeof(traveller), m->bytes);
    }
    free(order);
    return room;
}

static mw_status migration_check(const migration *m, const mwp_particles *out, mwp_error *error)
{
    if (!out || (m->n && (!m->at || (m->bytes && !m->payload))))
        return mwp__fail(error, MW_ERROR_ARGUMENT, "the particles are NULL");
    if (m->bytes > 1 << 20)
        return mwp__fail(error, MW_ERROR_ARGUMENT,
                         "a payload of %zu bytes is too large; at most 2^20 are possible",
                         m->bytes);
    for (size_t i = 0; i < m->n; i++)
        if (m->at[i].rank < -1 || m->at[i].rank >= m->mesh->wire.size)
            return mwp__fail(error, MW_ERROR_ARGUMENT,
                             "particle %zu is on rank %d; there are %d ranks", i, m->at[i].rank,
                             m->mesh->wire.size);
    return MW_OK;
}

mw_status mwp_migrate(mwp_mesh *mesh, const mwp_location *locations, const void *payload,
                      size_t bytes, size_t n, mwp_particles *out, mwp_error *error)
{
    mwp_error own_error = {0};
    if (!error) error = &own_error;
    if (out) *out = (mwp_particles){0};
    migration m = {.mesh = mesh,
                   .at = locations,
                   .payload = payload,
                   .n = n,
                   .bytes = bytes,
                   .record = sizeof(traveller) + (bytes + 7) / 8 * 8};
    const mwp_talk_about about = {m.record,     sizeof(uint64_t), migrate_load, migrate_answer,
                                  migrate_take, migrate_settle,   NULL};
    mwp_talk talk;
    mw_status status = migration_check(&m, out, error);
    status = mwp__wire_same(&mesh->wire, status, (int64_t)bytes, "the bytes of a payload", error);
    if (status) return status;
    mwp__talk_begin(&talk, &mesh->wire, &mesh->tables, &about, &m, BLOCK, MW_OK, error);
    status = mwp__talk_end(&talk, error);
    if (!status)
        status = mwp__wire_agree(
            &mesh->wire, particles_unpack(&m, out) ? MW_OK : mwp__fail_memory(error), error);
    free(m.here);
    if (status && out) mwp_particles_release(out);
    return status;
}

void mwp_particles_release(mwp_particles *particles)
{
    free(particles->locations);
    free(particles->payload);
    *particles = (mwp_particles){0};
}
