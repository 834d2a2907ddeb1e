// bench_probe - which triangle a probe touches: walks over the surface and boxes, beside Embree's
// ray caster with a ray either way. First a probe that moves along a surface that stays as it is:
// just above it, where it touches, then out of reach. Then one above a surface that is deformed in
// every frame, where what is kept beside it has to follow. A control loop cares for its slowest
// query, so each is timed by itself.
#include "bench/programs/embree_caster.h"
#include "bench/programs/program.h"

#include <cmath>

namespace
{

using namespace bench;

const double reach_share = 0.01; // of the diagonal: the largest distance of a touch
const double hover_share =
    0.001; // of the diagonal: height of the probe above the surface where it touches
const double free_share = 0.03;     // and where it does not
const double step_share = 0.1;      // of an edge: from query to query
const double lean = 0.3;            // the motion points forward by so much
const double contact_budget = 1e-3; // seconds of a query
const double free_budget = 1e-2;

struct ProbeAnswer {
    bool hit;
    uint32_t triangle;
    double distance;
};
using ProbeAnswers = std::vector<ProbeAnswer>;

double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void normalise(double *a)
{
    double length = std::sqrt(dot(a, a));
    for (size_t k = 0; k < 3; k++) a[k] /= length;
}

// --- the surface and what answers

// Two rays, forward and back; `sign` tells the filter which one this is.
struct RayWay {
    RTCIntersectContext context; // first: the filter gets its address
    float sign;
};

// Only fronts count: the motion points at them, whichever way the ray goes.
void filter_fronts(const RTCFilterFunctionNArguments *args)
{
    float facing = RTCRayN_dir_x(args->ray, args->N, 0) * RTCHitN_Ng_x(args->hit, args->N, 0) +
                   RTCRayN_dir_y(args->ray, args->N, 0) * RTCHitN_Ng_y(args->hit, args->N, 0) +
                   RTCRayN_dir_z(args->ray, args->N, 0) * RTCHitN_Ng_z(args->hit, args->N, 0);
    if (reinterpret_cast<const RayWay *>(args->context)->sign * facing >= 0) args->valid[0] = 0;
}

ProbeAnswer cast_one(RTCScene scene, const double *query, float sign, double reach)
{
    RayWay way;
    rtcInitIntersectContext(&way.context);
    way.sign = sign;
    RTCRayHit ray = ray_from(query, query + 3, sign, reach);
    rtcIntersect1(scene, &way.context, &ray);
    return {ray.hit.geomID != RTC_INVALID_GEOMETRY_ID, ray.hit.primID, sign * ray.ray.tfar};
}

struct ProbeScene {
    Model model;
    mw_surface *surface = nullptr;
    mw_surface_info info;
    mw_prober *plain = nullptr, *boxed = nullptr;
    double diagonal, edge;

    ProbeScene(const std::string &name, const ProgramOptions &options)
        : model(make_model(name, options.seed))
    {
        mw_error error;
        mw_arrays arrays = model.arrays();
        mw_surface_options how = {};
        how.tolerant = 1;
        if (mw_surface_create(&arrays, &how, &surface, &error) != MW_OK ||
            mw_surface_describe(surface, &info, &error) != MW_OK)
            fail(error.message);
        plain = prober(false);
        boxed = prober(true);
        double size[3];
        for (size_t k = 0; k < 3; k++) size[k] = info.high[k] - info.low[k];
        diagonal = std::sqrt(dot(size, size));
        edge =
            std::sqrt(info.area / static_cast<double>(model.triangle_count()) * 4 / std::sqrt(3.0));
    }
    ~ProbeScene()
    {
        mw_prober_destroy(plain);
        mw_prober_destroy(boxed);
        mw_surface_destroy(surface);
    }
    ProbeScene(const ProbeScene &) = delete;
    ProbeScene &operator=(const ProbeScene &) = delete;

    double reach() const { return reach_share * diagonal; }
    mw_prober *prober(bool boxes) const
    {
        mw_prober *made;
        mw_error error;
        mw_prober_options options = {};
        options.boxes = boxes;
        if (mw_prober_create(surface, &options, &made, &error) != MW_OK) fail(error.message);
        return made;
    }
    void normal(uint32_t triangle, double n[3]) const
    {
        uint32_t v[3];
        double p[3][3], a[3], b[3];
        mw_surface_triangle(surface, triangle, v);
        for (size_t k = 0; k < 3; k++) mw_surface_vertex(surface, v[k], p[k]);
        for (size_t k = 0; k < 3; k++) a[k] = p[1][k] - p[0][k], b[k] = p[2][k] - p[0][k];
        for (size_t k = 0; k < 3; k++)
            n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        normalise(n);
    }
    std::vector<std::string> row(const std::string &what) const
    {
        return {model.name, std::to_string(model.triangle_count()), what};
    }
};

// Who answers: a walk with a cursor that remembers, or a caster.
class WalkProber
{
    const mw_prober *prober;
    mw_probe_options options = {};
    mw_probe_cursor cursor;

  public:
    WalkProber(const ProbeScene &scene, const mw_prober *p, bool certain, uint64_t seed) : prober(p)
    {
        options.max_distance = scene.reach();
        options.certain = certain;
        options.seed = seed;
        restart();
    }
    void restart()
    {
        mw_error error;
        if (mw_probe_cursor_init(prober, &options, &cursor, &error) != MW_OK) fail(error.message);
    }
    ProbeAnswer operator()(const double *query)
    {
        mw_touch touch = mw_probe(prober, &cursor, query, query + 3);
        if (touch.state == MW_TOUCH_BAD) fail("a probe that is not answered");
        return {touch.state == MW_TOUCH_HIT, touch.triangle, touch.distance};
    }
};

struct RayProber {
    RTCScene scene;
    double reach;

    void restart() {}
    ProbeAnswer operator()(const double *query) const
    {
        ProbeAnswer ahead = cast_one(scene, query, 1, reach);
        ProbeAnswer behind = cast_one(scene, query, -1, ahead.hit ? ahead.distance : reach);
        return behind.hit ? behind : ahead;
    }
};

// --- answers beside the exact ones

struct ProbeVerdict {
    size_t hits = 0, same = 0, other = 0, missed = 0, invented = 0;

    void add(const ProbeAnswer &answer, const ProbeAnswer &exact, double tolerance)
    {
        hits += answer.hit;
        bool near = std::abs(std::abs(answer.distance) - std::abs(exact.distance)) <= tolerance;
        if (!exact.hit && answer.hit)
            invented++;
        else if (exact.hit && !answer.hit)
            missed++;
        else if (!exact.hit || answer.triangle == exact.triangle || near)
            same++;
        else
            other++;
    }
    void add(const ProbeAnswers &answers, const ProbeAnswers &exact, double tolerance)
    {
        for (size_t i = 0; i < exact.size(); i++) add(answers[i], exact[i], tolerance);
    }
    void print(std::vector<std::string> &cells) const
    {
        for (size_t count : {hits, same, other, missed, invented})
            cells.push_back(std::to_string(count));
    }
};

double tolerance(const ProbeScene &scene)
{
    return 1e-6 * scene.diagonal; // single precision at the size of the model
}

// --- the path of a probe: x y z and motion of each query

// Ahead, turning a little at each step; where it gets no farther, at a border, elsewhere.
Coordinates make_path(const ProbeScene &scene, double height, size_t n, uint64_t seed)
{
    Coordinates turns = make_directions(n, seed), path;
    double step = step_share * scene.edge, p[3], ahead[3] = {}, up[3], moved[3], motion[3];
    mw_surface_vertex(scene.surface, scene.model.triangles[0], p);
    std::copy(p, p + 3, moved);
    for (size_t i = 0; i < n; i++) {
        mw_nearest_surface_point hit;
        mw_error error;
        if (mw_nearest_on_surface(scene.boxed, p, INFINITY, &hit, &error) != MW_OK)
            fail(error.message);
        for (size_t k = 0; k < 3; k++) moved[k] = hit.point[k] - moved[k];
        double turn = dot(moved, moved) < step * step / 4 ? 1 : 0.02;
        scene.normal(hit.triangle, up);
        for (size_t k = 0; k < 3; k++) ahead[k] = (1 - turn) * ahead[k] + turn * turns[3 * i + k];
        double rise = dot(ahead, up);
        for (size_t k = 0; k < 3; k++) ahead[k] -= rise * up[k];
        normalise(ahead);
        for (size_t k = 0; k < 3; k++) {
            motion[k] = lean * ahead[k] - up[k];
            p[k] = hit.point[k] + step * ahead[k];
            moved[k] = hit.point[k];
            path.push_back(hit.point[k] + height * up[k]);
        }
        normalise(motion);
        path.insert(path.end(), motion, motion + 3);
    }
    return path;
}

// --- the time of each query

// A pass over the path; the clock is read once for each query.
template <class Who>
double pass(Who &who, const double *path, ProbeAnswers &answers, std::vector<double> &seconds)
{
    using clock = std::chrono::steady_clock;
    clock::time_point begin = clock::now(), last = begin;
    for (size_t i = 0; i < answers.size(); i++) {
        answers[i] = who(path + 6 * i);
        clock::time_point now = clock::now();
        seconds[i] = std::chrono::duration<double>(now - last).count();
        last = now;
    }
    return std::chrono::duration<double>(last - begin).count();
}

double share(std::vector<double> values, double part)
{
    size_t rank = static_cast<size_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank),
                     values.end());
    return values[rank];
}

double mean(const std::vector<double> &values)
{
    double sum = 0;
    for (double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

// The mean of all but the slowest thousandth, which is mostly the machine's doing where each is
// timed once.
double mean_of_most(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    values.resize(values.size() - values.size() / 1000);
    return mean(values);
}

// ProbePasses over a path, round by round. What the machine does beside delays other queries in
// each round, so a query's time is its median over the rounds.
class ProbePasses
{
    std::vector<std::vector<double>> rounds;

  public:
    ProbeAnswers answers;

    template <class Who> void enter(Competitors &competitors, Who who, const Coordinates &path)
    {
        answers.resize(path.size() / 6);
        competitors.enter([this, who, &path]() mutable {
            who.restart();
            rounds.emplace_back(answers.size());
            return pass(who, path.data(), answers, rounds.back());
        });
    }
    void print(std::vector<std::string> &cells, size_t warmup, double budget)
    {
        rounds.erase(rounds.begin(), rounds.begin() + static_cast<std::ptrdiff_t>(warmup));
        std::vector<double> typical, one;
        double worst = 0;
        for (size_t i = 0; i < answers.size(); i++) {
            one.clear();
            for (const auto &round : rounds) one.push_back(round[i]);
            typical.push_back(share(one, 0.5));
            worst = std::max(worst, share(one, 1));
        }
        auto late =
            std::count_if(typical.begin(), typical.end(), [=](double t) { return t > budget; });
        for (double seconds : {mean(typical), share(typical, 0.999), share(typical, 1), worst})
            cells.push_back(number(1e6 * seconds, 2));
        cells.push_back(number(1e3 * budget, 0));
        cells.push_back(std::to_string(late));
    }
};

void measure_still(const ProbeScene &scene, const ProgramOptions &options, bool contact,
                   TextTable &table)
{
    Coordinates path = make_path(
        scene, (contact ? hover_share : free_share) * scene.diagonal,
        contact ? options.queries : std::max<size_t>(1, options.queries / 10), options.seed);
    EmbreeDevice device(options.threads);
    EmbreeCaster caster(device, scene.model, filter_fronts);
    Competitors competitors;
    ProbePasses published, certain, rays;
    published.enter(competitors, WalkProber(scene, scene.plain, false, options.seed), path);
    certain.enter(competitors, WalkProber(scene, scene.boxed, true, options.seed), path);
    rays.enter(competitors, RayProber{caster, scene.reach()}, path);
    competitors.measure(options);
    auto print = [&](const char *who, ProbePasses &passes) {
        std::vector<std::string> cells = scene.row(contact ? "contact" : "free");
        cells.push_back(who);
        passes.print(cells, static_cast<size_t>(options.warmup),
                     contact ? contact_budget : free_budget);
        ProbeVerdict verdict;
        verdict.add(passes.answers, certain.answers, tolerance(scene));
        verdict.print(cells);
        table.row(cells);
    };
    print("published", published);
    print("certain", certain);
    print("Embree", rays);
}

// --- what is kept beside the surface

double build_surface(const Model &model)
{
    mw_surface *surface;
    mw_error error;
    mw_surface_options how = {};
    mw_arrays arrays = model.arrays();
    how.tolerant = 1;
    Stopwatch watch;
    if (mw_surface_create(&arrays, &how, &surface, &error) != MW_OK) fail(error.message);
    double seconds = watch.seconds();
    mw_surface_destroy(surface);
    return seconds;
}

// The fit takes all threads when the boxes are made: it is timed once more, with those of the
// options.
double build_boxes(const ProbeScene &scene, unsigned threads, mw_prober_info &info)
{
    Stopwatch watch;
    mw_prober *prober = scene.prober(true);
    double seconds = watch.seconds();
    mw_prober_describe(prober, &info);
    seconds -= info.fit_seconds;
    mw_prober_update(prober, -1, threads);
    mw_prober_describe(prober, &info);
    mw_prober_destroy(prober);
    return seconds + info.fit_seconds;
}

double build_caster(const Model &model, unsigned threads, size_t &bytes)
{
    EmbreeDevice device(threads);
    size_t before = device.bytes();
    Stopwatch watch;
    EmbreeCaster caster(device, model, filter_fronts);
    double seconds = watch.seconds();
    bytes = device.bytes() - before;
    return seconds;
}

void measure_builds(const ProbeScene &scene, const ProgramOptions &options, TextTable &table)
{
    mw_prober_info info;
    size_t bytes = 0;
    Competitors competitors;
    size_t surface = competitors.enter([&] { return build_surface(scene.model); });
    size_t boxes = competitors.enter([&] { return build_boxes(scene, options.threads, info); });
    size_t embree =
        competitors.enter([&] { return build_caster(scene.model, options.threads, bytes); });
    competitors.measure(options);
    auto print = [&](const char *what, size_t competitor, size_t size) {
        std::vector<std::string> cells = scene.row(what);
        double triangles = static_cast<double>(scene.model.triangle_count());
        cells.insert(cells.end(), {number(1e3 * competitors.median(competitor), 1),
                                   number(double(size) / 1e6, 2),
                                   number(static_cast<double>(size) / triangles, 1)});
        table.row(cells);
    };
    print("surface", surface, mw_surface_bytes(scene.surface));
    print("boxes", boxes, info.box_bytes);
    print("Embree", embree, bytes);
}

// --- a surface that moves

// A wave that travels through space and moves what it finds across: points and probes alike.
struct Wave {
    double waves[3], across[3], amplitude;
    const double turn = 0.12; // of its phase, from frame to frame

    explicit Wave(const ProbeScene &scene)
        : waves{9, 6, 3}, across{0, 0.6, 0.8}, amplitude(0.002 * scene.diagonal)
    {
        for (double &n : waves) n /= scene.diagonal;
    }
    double farthest() const { return amplitude * turn * (1 + 1e-6); } // of a vertex in a frame
    void move(const double *rest, int frame, double *moved) const
    {
        double height = amplitude * std::sin(dot(waves, rest) - turn * frame);
        for (size_t k = 0; k < 3; k++) moved[k] = rest[k] + height * across[k];
    }
};

const int frames = 30;
const size_t frame_queries = 1000;

// One who answers, frame by frame.
struct SurfaceFollower {
    std::string name;
    std::function<double()> update; // what it costs to follow the surface: seconds
    std::function<void(const double *, ProbeAnswers &, std::vector<double> &)>
        probe;                            // the queries of a frame
    std::vector<double> updates, queries; // seconds
    ProbeVerdict verdict;
    ProbeAnswers answers = ProbeAnswers(frame_queries);

    void play(const double *path)
    {
        std::vector<double> seconds(frame_queries);
        updates.push_back(update());
        probe(path, answers, seconds);
        queries.insert(queries.end(), seconds.begin(), seconds.end());
    }
};

template <class Who>
SurfaceFollower follower(const std::string &name, std::function<double()> update, Who who)
{
    SurfaceFollower f;
    f.name = name;
    f.update = std::move(update);
    f.probe = [who](const double *path, ProbeAnswers &answers,
                    std::vector<double> &seconds) mutable { pass(who, path, answers, seconds); };
    return f;
}

void print_followers(const ProbeScene &scene, const std::vector<SurfaceFollower> &followers,
                     TextTable &table)
{
    for (const SurfaceFollower &f : followers) {
        std::vector<std::string> cells = scene.row(f.name);
        double each = 1e9 * mean(f.updates) / static_cast<double>(scene.model.vertex_count());
        double update = mean(f.updates), query = mean_of_most(f.queries);
        cells.insert(cells.end(),
                     {number(1e3 * update, 4), number(1e3 * share(f.updates, 1), 4),
                      number(each, 3), number(1e6 * query, 2),
                      number(1e6 * share(f.queries, 0.999), 2),
                      number(1e3 * (update + query * static_cast<double>(frame_queries)), 3)});
        f.verdict.print(cells);
        table.row(cells);
    }
}

// What the frames play with. Three have boxes: told how far vertices went, not told, and the one
// that knows the answers.
struct MovingSurface {
    const ProbeScene &scene;
    const Wave wave;
    mw_prober *boxed[3];
    std::vector<double> fits = std::vector<double>(3);
    double own = 0; // seconds that the surface asks for
    EmbreeDevice device;
    EmbreeCaster refit, rebuild;

    MovingSurface(const ProbeScene &s, const ProgramOptions &options)
        : scene(s), wave(s), device(options.threads),
          refit(device, s.model, filter_fronts, Moving::refit),
          rebuild(device, s.model, filter_fronts, Moving::rebuild)
    {
        for (mw_prober *&one : boxed) one = scene.prober(true);
    }
    ~MovingSurface()
    {
        for (mw_prober *one : boxed) mw_prober_destroy(one);
    }
    MovingSurface(const MovingSurface &) = delete;
    MovingSurface &operator=(const MovingSurface &) = delete;

    // The frame's coordinates, everywhere. What has to be done before the next query is timed; for
    // Embree later.
    void show(int frame, unsigned threads)
    {
        Stopwatch begin;
        mw_surface_begin_update(scene.surface);
        own = begin.seconds();
        double *points = mw_surface_points(scene.surface);
        size_t count = scene.model.points.size();
        for (size_t i = 0; i < count; i += 3) wave.move(&scene.model.points[i], frame, points + i);
        for (size_t i = 0; i < 3; i++) {
            Stopwatch watch;
            mw_prober_update(boxed[i], i == 0 && frame > 0 ? wave.farthest() : -1, threads);
            fits[i] = watch.seconds();
        }
        Stopwatch end;
        mw_surface_end_update(scene.surface);
        own += end.seconds();
        Coordinates moved(points, points + count);
        refit.set_points(moved);
        rebuild.set_points(moved);
    }
    std::vector<SurfaceFollower> followers(uint64_t seed)
    {
        auto update = [](EmbreeCaster &caster) {
            return [&caster] {
                Stopwatch watch;
                caster.update();
                return watch.seconds();
            };
        };
        std::vector<SurfaceFollower> all;
        all.push_back(follower(
            "published", [this] { return own; }, WalkProber(scene, scene.plain, false, seed)));
        all.push_back(follower(
            "certain, known how far", [this] { return own + fits[0]; },
            WalkProber(scene, boxed[0], true, seed)));
        all.push_back(follower(
            "certain, not known", [this] { return own + fits[1]; },
            WalkProber(scene, boxed[1], true, seed)));
        all.push_back(follower("Embree, refit", update(refit), RayProber{refit, scene.reach()}));
        all.push_back(
            follower("Embree, rebuilt", update(rebuild), RayProber{rebuild, scene.reach()}));
        return all;
    }
};

void measure_moving(const ProbeScene &scene, const ProgramOptions &options, TextTable &table)
{
    Coordinates path =
        make_path(scene, hover_share * scene.diagonal, frames * frame_queries, options.seed);
    MovingSurface film(scene, options);
    std::vector<SurfaceFollower> followers = film.followers(options.seed);
    WalkProber oracle(scene, film.boxed[2], true, options.seed);
    ProbeAnswers exact(frame_queries);
    int frame = -1;
    double *queries = nullptr;
    Competitors competitors;
    competitors.lead([&] { // each round is a frame
        frame++;
        film.show(frame, options.threads);
        queries = &path[6 * frame_queries * static_cast<size_t>(frame)];
        for (size_t i = 0; i < frame_queries; i++) {
            film.wave.move(queries + 6 * i, frame,
                           queries + 6 * i); // the probe goes with the surface
            exact[i] = oracle(queries + 6 * i);
        }
    });
    for (SurfaceFollower &one : followers)
        competitors.enter([&, f = &one] {
            f->play(queries);
            f->verdict.add(f->answers, exact, tolerance(scene));
            return f->updates.back();
        });
    competitors.measure(frames, 0);
    print_followers(scene, followers, table);
}

} // namespace

int main(int argc, char **argv)
{
    ProgramOptions defaults;
    defaults.data = {"bumps:250000"};
    defaults.queries = 20000;
    defaults.rounds = 5;
    ProgramOptions options =
        parse_options(argc, argv, defaults, "probes of surfaces beside Embree");
    print_machine(options.tsv, embree_version());
    TextTable builds({"data", "triangles", "built", "ms", "MB", "bytes/triangle"});
    TextTable still({"data", "triangles", "probe", "who", "mean us", "99.9 %", "worst",
                     "worst seen", "budget ms", "late", "hits", "same", "other", "missed",
                     "invented"});
    TextTable moving({"data", "triangles", "who", "update ms", "(worst)", "ns/vertex", "probe us",
                      "99.9 %", "frame ms", "hits", "same", "other", "missed", "invented"});
    for (const auto &name : options.data) {
        ProbeScene scene(name, options);
        measure_builds(scene, options, builds);
        measure_still(scene, options, true, still);
        measure_still(scene, options, false, still);
        measure_moving(scene, options, moving);
    }
    for (const TextTable *table : {&builds, &still, &moving}) {
        table->print(options.tsv);
        std::printf("\n");
    }
}
