// bench_star - which facet of a star-shaped polyhedron a ray from its centre meets: walks from
// several first facets, beside Embree's ray caster. What both build, in time and memory; the time
// of a query; and how often Embree is wrong, which computes in single precision: rays that meet no
// facet, and facets that the exact answer does not touch.
#include "bench/programs/embree_caster.h"
#include "bench/programs/program.h"

#include <cmath>
#include <memory>

namespace
{

using namespace bench;

using StarLocations = std::vector<mw_location>;
using Facets = std::vector<uint32_t>; // by Embree; MW_NONE: it found none

const mw_star_start_kind indexed[] = {MW_STAR_START_GRID, MW_STAR_START_NONUNIFORM_GRID,
                                      MW_STAR_START_OCTAHEDRON};

// A polyhedron with its centre at the origin, prepared.
struct Polyhedron {
    mw_surface *surface = nullptr;
    mw_star *star = nullptr;
    mw_star_index *index[MW_STAR_START_COUNT] = {};

    // Is it star-shaped?
    bool prepare(const Model &model, bool angles, mw_error *error)
    {
        mw_arrays arrays = model.arrays();
        mw_star_options options = {};
        options.angles = angles;
        options.threads = 1;
        return mw_surface_create(&arrays, nullptr, &surface, error) == MW_OK &&
               mw_star_create(surface, &options, &star, error) == MW_OK;
    }
    void add_index(mw_star_start_kind start)
    {
        mw_error error;
        if (mw_star_index_create(star, start, nullptr, &index[start], &error) != MW_OK)
            fail(error.message);
    }
    size_t index_bytes(mw_star_start_kind start) const
    {
        mw_star_index_info info;
        mw_star_index_describe(index[start], &info);
        return info.bytes;
    }
    ~Polyhedron()
    {
        for (mw_star_index *one : index) mw_star_index_destroy(one);
        mw_star_destroy(star);
        mw_surface_destroy(surface);
    }
    Polyhedron() = default;
    Polyhedron(const Polyhedron &) = delete;
    Polyhedron &operator=(const Polyhedron &) = delete;
};

// The model moved so that the origin sees all its facets: as it is, or by the mean of its vertices.
Model centred(Model model)
{
    mw_error error;
    if (Polyhedron().prepare(model, false, &error)) return model;
    for (size_t k = 0; k < 3; k++) {
        double sum = 0;
        for (size_t i = k; i < model.points.size(); i += 3) sum += model.points[i];
        double mean = sum / static_cast<double>(model.vertex_count());
        for (size_t i = k; i < model.points.size(); i += 3) model.points[i] -= mean;
    }
    if (!Polyhedron().prepare(model, false, &error)) fail(model.name + ": " + error.message);
    return model;
}

// --- building

struct StarBuild {
    std::string what;
    size_t competitor, bytes;
};

void print_builds(const Model &model, const std::vector<StarBuild> &builds,
                  const Competitors &competitors, TextTable &table)
{
    for (const StarBuild &one : builds) {
        double bytes = static_cast<double>(one.bytes);
        table.row({model.name, std::to_string(model.triangle_count()), one.what,
                   number(1e3 * competitors.median(one.competitor), 1),
                   number(1e3 * competitors.least(one.competitor), 1), number(bytes / 1e6, 2),
                   number(bytes / static_cast<double>(model.triangle_count()), 1)});
    }
}

void measure_builds(const Model &model, const ProgramOptions &options, TextTable &table)
{
    Competitors competitors;
    std::vector<StarBuild> builds;
    Polyhedron kept;
    mw_star_info info;
    mw_error error;
    kept.prepare(model, true, &error);
    mw_star_describe(kept.star, &info);
    for (bool angles : {false, true}) {
        size_t bytes =
            mw_surface_bytes(kept.surface) + info.bytes - (angles ? 0 : info.angle_bytes);
        size_t competitor = competitors.enter([=, &model] {
            Polyhedron made;
            mw_error why;
            Stopwatch watch;
            made.prepare(model, angles, &why);
            return watch.seconds();
        });
        builds.push_back({angles ? "the same with angles" : "surface and star", competitor, bytes});
    }
    for (mw_star_start_kind start : indexed) {
        kept.add_index(start);
        size_t competitor = competitors.enter([=, &kept] {
            mw_star_index_destroy(kept.index[start]);
            Stopwatch watch;
            kept.add_index(start);
            return watch.seconds();
        });
        builds.push_back({std::string("index: ") + mw_star_start_name(start), competitor,
                          kept.index_bytes(start)});
    }
    EmbreeDevice device(options.threads);
    size_t before = device.bytes();
    std::unique_ptr<EmbreeCaster> caster = std::make_unique<EmbreeCaster>(device, model);
    size_t bytes = device.bytes() - before;
    size_t competitor = competitors.enter([&] {
        caster.reset();
        Stopwatch watch;
        caster = std::make_unique<EmbreeCaster>(device, model);
        return watch.seconds();
    });
    builds.push_back({"Embree", competitor, bytes});
    competitors.measure(options);
    print_builds(model, builds, competitors, table);
}

// --- queries

mw_star_query_options how(const Polyhedron &p, mw_star_walk_kind walk, mw_star_start_kind start,
                          bool count)
{
    mw_star_query_options options = {};
    options.walk = walk;
    options.start = start;
    options.index = p.index[start];
    options.threads = 1;
    options.counters = count;
    return options;
}

double rays_singly(const Polyhedron &p, const Coordinates &rays,
                   const mw_star_query_options &options, StarLocations &found,
                   mw_counters *counters = nullptr)
{
    mw_star_cursor cursor;
    mw_error error;
    if (mw_star_cursor_init(p.star, &options, &cursor, &error) != MW_OK) fail(error.message);
    Stopwatch watch;
    for (size_t i = 0; i < found.size(); i++)
        found[i] = mw_star_locate(p.star, &cursor, &rays[3 * i]);
    double seconds = watch.seconds();
    if (counters) *counters = cursor.counters;
    return seconds;
}

double rays_in_batch(const Polyhedron &p, const Coordinates &rays,
                     const mw_star_query_options &options, StarLocations &found,
                     mw_counters *counters = nullptr)
{
    mw_error error;
    Stopwatch watch;
    if (mw_star_locate_batch(p.star, rays.data(), found.size(), 3, &options, found.data(), counters,
                             &error) != MW_OK)
        fail(error.message);
    return watch.seconds();
}

const double origin[3] = {};

double cast_single(const EmbreeCaster &caster, const Coordinates &rays, Facets &facets)
{
    Stopwatch watch;
    for (size_t i = 0; i < facets.size(); i++) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit ray = ray_from(origin, &rays[3 * i]);
        rtcIntersect1(caster, &context, &ray);
        facets[i] = ray.hit.primID;
    }
    return watch.seconds();
}

double cast_packets(const EmbreeCaster &caster, const Coordinates &rays,
                    RTCIntersectContextFlags flags, Facets &facets)
{
    Stopwatch watch;
    for (size_t i = 0; i < facets.size(); i += 8) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = flags;
        RTCRayHit8 packet = {};
        alignas(32) int valid[8];
        for (size_t k = 0; k < 8; k++) {
            valid[k] = i + k < facets.size() ? -1 : 0;
            if (!valid[k]) continue;
            packet.ray.dir_x[k] = static_cast<float>(rays[3 * (i + k)]);
            packet.ray.dir_y[k] = static_cast<float>(rays[3 * (i + k) + 1]);
            packet.ray.dir_z[k] = static_cast<float>(rays[3 * (i + k) + 2]);
            packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
            packet.ray.mask[k] = ~0u;
            packet.hit.geomID[k] = packet.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid, caster, &context, &packet);
        for (size_t k = 0; k < 8 && i + k < facets.size(); k++)
            facets[i + k] = packet.hit.primID[k];
    }
    return watch.seconds();
}

struct StarLine {
    std::string walk, start, way, order;
    size_t competitor;
    mw_counters counters;
};

class StarQueries
{
    const Polyhedron &p;
    const Coordinates &mixed, sorted;
    StarLocations found, expected;
    Facets facets;
    Competitors competitors;
    std::vector<StarLine> lines;

    const Coordinates &rays(bool in_order) const { return in_order ? sorted : mixed; }
    static const char *order(bool in_order) { return in_order ? "sorted" : "random"; }

    // All walks from all starts give the same answers.
    void compare(const std::string &who)
    {
        for (size_t i = 0; i < found.size(); i++)
            if (found[i].triangle != expected[i].triangle || found[i].where != expected[i].where)
                fail("query " + std::to_string(i) + ": another facet by " + who);
    }

  public:
    StarQueries(const Polyhedron &polyhedron, const Coordinates &queries)
        : p(polyhedron), mixed(queries), sorted(in_morton_order(queries)),
          found(queries.size() / 3), facets(queries.size() / 3)
    {
    }
    void enter(mw_star_walk_kind walk, mw_star_start_kind start, bool batch, bool in_order)
    {
        auto run = [=](bool count, mw_counters *counters) {
            mw_star_query_options options = how(p, walk, start, count);
            return batch ? rays_in_batch(p, rays(in_order), options, found, counters)
                         : rays_singly(p, rays(in_order), options, found, counters);
        };
        StarLine line = {mw_star_walk_name(walk),
                         mw_star_start_name(start),
                         batch ? "batch" : "single",
                         order(in_order),
                         competitors.enter([=] { return run(false, nullptr); }),
                         {}};
        run(true, &line.counters);
        if (expected.empty()) expected = found;
        if (!in_order) compare(line.walk + " from " + line.start);
        lines.push_back(line);
    }
    void enter(const EmbreeCaster &caster, bool packets, bool in_order)
    {
        auto flags =
            in_order ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        size_t competitor = competitors.enter([=, &caster] {
            return packets ? cast_packets(caster, rays(in_order), flags, facets)
                           : cast_single(caster, rays(in_order), facets);
        });
        lines.push_back(
            {"Embree", "-", packets ? "packets of 8" : "single", order(in_order), competitor, {}});
    }
    void measure(const Model &model, const ProgramOptions &options, TextTable &table)
    {
        competitors.measure(options);
        double queries = static_cast<double>(found.size()), base = 0;
        for (const StarLine &line : lines)
            if (base == 0 && line.walk == "Embree") base = competitors.median(line.competitor);
        for (const StarLine &line : lines) {
            double median = competitors.median(line.competitor);
            auto each = [&](uint64_t count) {
                return line.walk == "Embree" ? std::string("-")
                                             : number(double(count) / queries, 2);
            };
            table.row({model.name, std::to_string(model.triangle_count()), line.walk, line.start,
                       line.way, line.order, number(1e9 * median / queries, 1),
                       number(1e9 * competitors.least(line.competitor) / queries, 1),
                       number(median / base, 3), each(line.counters.triangles_visited),
                       each(line.counters.orient_init + line.counters.orient +
                            line.counters.orient_final)});
        }
    }
};

void measure_queries(const Model &model, const ProgramOptions &options, TextTable &table)
{
    Polyhedron p;
    mw_error error;
    p.prepare(model, true, &error);
    for (mw_star_start_kind start : indexed) p.add_index(start);
    EmbreeDevice device(options.threads);
    EmbreeCaster caster(device, model);
    Coordinates rays = make_directions(options.queries, options.seed);
    StarQueries star_queries(p, rays);
    star_queries.enter(caster, false, false);
    star_queries.enter(caster, true, false);
    star_queries.enter(caster, false, true);
    star_queries.enter(caster, true, true);
    for (const std::string &name : options.walks) {
        mw_star_walk_kind walk = mw_star_walk_by_name(name.c_str());
        if (walk == MW_STAR_WALK_COUNT) fail("no such walk: " + name);
        for (mw_star_start_kind start :
             {MW_STAR_START_LAST, MW_STAR_START_SAMPLE, MW_STAR_START_GRID,
              MW_STAR_START_NONUNIFORM_GRID, MW_STAR_START_OCTAHEDRON})
            star_queries.enter(walk, start, false, false);
        star_queries.enter(walk, MW_STAR_START_LAST, false, true);
    }
    star_queries.enter(MW_STAR_WALK_AUTO, MW_STAR_START_AUTO, false, false);
    star_queries.enter(MW_STAR_WALK_AUTO, MW_STAR_START_AUTO, false, true);
    star_queries.enter(MW_STAR_WALK_AUTO, MW_STAR_START_AUTO, true, false);
    star_queries.measure(model, options, table);
}

// --- wrong answers

// Rays through vertices, and through the middle of edges up to rounding.
Coordinates rays_at(const Model &model, bool vertices, size_t n)
{
    Coordinates rays;
    size_t corners = model.triangles.size(), count = std::min(n, corners);
    for (size_t i = 0; i < count; i++) {
        size_t corner = i * corners / count, next = corner - corner % 3 + (corner + 1) % 3;
        const double *a = &model.points[3 * size_t(model.triangles[corner])];
        const double *b = &model.points[3 * size_t(model.triangles[next])];
        for (size_t k = 0; k < 3; k++) rays.push_back(vertices ? a[k] : a[k] + b[k]);
    }
    return rays;
}

// Coordinates that are multiples of 2^-22 of about their extent: single precision holds them, and
// the sum of two.
void shorten(Coordinates &points)
{
    double most = 0;
    for (double x : points) most = std::max(most, std::abs(x));
    double unit = std::ldexp(1, std::ilogb(most) + 1 - 22);
    for (double &x : points) x = unit * std::round(x / unit);
}

// Does the facet touch the point that was found exactly?
bool touches(const mw_surface *surface, const mw_location &found, uint32_t facet)
{
    uint32_t own[3], other[3];
    mw_surface_triangle(surface, found.triangle, own);
    mw_surface_triangle(surface, facet, other);
    auto shared = [&](size_t corner) {
        return std::find(other, other + 3, own[corner % 3]) != other + 3;
    };
    return facet == found.triangle || (found.where == MW_ON_VERTEX && shared(found.local)) ||
           (found.where == MW_ON_EDGE && shared(found.local) && shared(found.local + 1u));
}

void count_wrong(const Model &model, const std::string &given, const ProgramOptions &options,
                 TextTable &table)
{
    Polyhedron p;
    mw_error error;
    if (!p.prepare(model, false, &error)) return; // shortened, it need not be star-shaped
    EmbreeDevice device(options.threads);
    EmbreeCaster caster(device, model);
    for (std::string through : {"anything", "edges", "vertices"}) {
        Coordinates rays = through == "anything"
                               ? make_directions(options.queries, options.seed)
                               : rays_at(model, through == "vertices", options.queries);
        if (given == "short" && through == "anything") shorten(rays);
        StarLocations found(rays.size() / 3);
        Facets facets(found.size());
        rays_in_batch(p, rays, how(p, MW_STAR_WALK_AUTO, MW_STAR_START_AUTO, false), found);
        cast_single(caster, rays, facets);
        size_t lost = 0, wrong = 0, ties = 0;
        for (size_t i = 0; i < facets.size(); i++) {
            ties += found[i].where != MW_INSIDE;
            lost += facets[i] == RTC_INVALID_GEOMETRY_ID;
            wrong +=
                facets[i] != RTC_INVALID_GEOMETRY_ID && !touches(p.surface, found[i], facets[i]);
        }
        table.row({model.name, std::to_string(model.triangle_count()), given, through,
                   std::to_string(found.size()), std::to_string(ties), std::to_string(lost),
                   std::to_string(wrong)});
    }
}

} // namespace

int main(int argc, char **argv)
{
    ProgramOptions defaults;
    defaults.data = {"icosahedron:163842", "star:100000"};
    defaults.queries = 50000;
    defaults.walks = {"stochastic", "orthogonal"};
    ProgramOptions options = parse_options(
        argc, argv, defaults, "rays from the centre of star-shaped polyhedra beside Embree");
    print_machine(options.tsv, embree_version());
    TextTable builds({"data", "facets", "built", "ms", "(least)", "MB", "bytes/facet"});
    TextTable queries({"data", "facets", "walk", "start", "way", "order", "ns/query", "(least)",
                       "ratio", "facets/query", "tests/query"});
    TextTable wrong({"data", "facets", "given", "rays through", "rays", "on edge or vertex",
                     "Embree: none", "another"});
    for (const auto &name : options.data) {
        Model model = centred(make_model(name, options.seed));
        measure_builds(model, options, builds);
        measure_queries(model, options, queries);
        count_wrong(model, "doubles", options, wrong);
        shorten(model.points);
        count_wrong(model, "short", options, wrong);
    }
    for (const TextTable *table : {&builds, &queries, &wrong}) {
        table->print(options.tsv);
        std::printf("\n");
    }
}
