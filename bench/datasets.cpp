#include "datasets.h"

#include "harness.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <meshwalk/io.h>

namespace bench
{

namespace
{

using Random = std::mt19937_64;

Coordinates uniform(size_t n, Random &random)
{
    std::uniform_real_distribution<double> unit;
    Coordinates points(2 * n);
    for (double &value : points) value = unit(random);
    return points;
}

Coordinates grid(size_t n)
{
    size_t width = std::max<size_t>(1, static_cast<size_t>(std::sqrt(static_cast<double>(n))));
    Coordinates points;
    for (size_t i = 0; i < n; i++) {
        points.push_back(static_cast<double>(i % width));
        points.push_back(static_cast<double>(i / width));
    }
    return points;
}

Coordinates gaussian(size_t n, Random &random)
{
    std::normal_distribution<double> normal;
    Coordinates points(2 * n);
    for (double &value : points) value = normal(random);
    return points;
}

Coordinates clusters(size_t n, Random &random)
{
    Coordinates centres = uniform(100, random), points = gaussian(n, random);
    std::uniform_int_distribution<size_t> which(0, 99);
    for (size_t i = 0; i < n; i++) {
        size_t c = which(random);
        for (size_t k = 0; k < 2; k++) points[2 * i + k] = centres[2 * c + k] + 0.001 * points[2 * i + k];
    }
    return points;
}

Coordinates from_file(const std::string &path, size_t n)
{
    mw_point_reader *reader;
    mw_error error;
    if (mw_points_open(path.c_str(), nullptr, &reader, &error) != MW_OK) fail(error.message);
    size_t width = mw_points_width(reader), count = 0;
    std::vector<double> values(width * 4096);
    Coordinates points;
    do {
        if (mw_points_read(reader, values.data(), 4096, &count, &error) != MW_OK) fail(error.message);
        for (size_t i = 0; i < count && points.size() < 2 * n; i++) {
            points.push_back(values[i * width]);
            points.push_back(values[i * width + 1]);
        }
    } while (count > 0 && points.size() < 2 * n);
    mw_points_close(reader);
    return points;
}

} // namespace

Coordinates make_points(const std::string &name, size_t n, uint64_t seed)
{
    Random random(seed);
    if (name == "uniform") return uniform(n, random);
    if (name == "grid") return grid(n);
    if (name == "gaussian") return gaussian(n, random);
    if (name == "clusters") return clusters(n, random);
    return from_file(name, n);
}

Coordinates make_queries(const Coordinates &points, size_t n, uint64_t seed)
{
    Random random(seed + 1);
    double low[2] = {points[0], points[1]}, high[2] = {points[0], points[1]};
    for (size_t i = 0; i < points.size(); i++) {
        low[i % 2] = std::min(low[i % 2], points[i]);
        high[i % 2] = std::max(high[i % 2], points[i]);
    }
    Coordinates queries = uniform(n, random);
    for (size_t i = 0; i < queries.size(); i++) queries[i] = low[i % 2] + queries[i] * (high[i % 2] - low[i % 2]);
    return queries;
}

} // namespace bench
