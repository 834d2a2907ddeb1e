#include "bench/programs/datasets.h"

#include "bench/programs/harness.h"

#include "bench/data/datasets.h"

#include <meshwalk/io.h>

namespace bench
{

namespace
{

Coordinates from_file(const std::string &path, size_t n)
{
    mw_point_reader *reader;
    mw_error error;
    if (mw_point_reader_open(path.c_str(), nullptr, &reader, &error) != MW_OK) fail(error.message);
    size_t width = mw_point_reader_width(reader), count = 0;
    std::vector<double> values(width * 4096);
    Coordinates points;
    do {
        if (mw_point_reader_read(reader, values.data(), 4096, &count, &error) != MW_OK) fail(error.message);
        for (size_t i = 0; i < count && points.size() < 2 * n; i++) {
            points.push_back(values[i * width]);
            points.push_back(values[i * width + 1]);
        }
    } while (count > 0 && points.size() < 2 * n);
    mw_point_reader_close(reader);
    return points;
}

} // namespace

Coordinates make_points(const std::string &name, size_t n, uint64_t seed)
{
    for (int kind = 0; kind < DATASET_KINDS; kind++) {
        if (name != dataset_name(kind)) continue;
        dataset made;
        if (!dataset_make(&made, static_cast<dataset_kind>(kind), n, false, seed)) fail("out of memory");
        Coordinates points(made.points, made.points + 2 * n);
        dataset_release(&made);
        return points;
    }
    return from_file(name, n);
}

Coordinates make_queries(const Coordinates &points, size_t n, uint64_t seed)
{
    Coordinates copy = points, queries(2 * n);
    dataset extent = {};
    extent.points = copy.data();
    extent.count = copy.size() / 2;
    if (!dataset_bound(&extent, extent.count)) fail("the extent of the points is too large for a double");
    uint64_t random = ~seed;
    dataset_draw(&extent, queries.data(), n, &random);
    return queries;
}

} // namespace bench
