#!/usr/bin/env python3
"""Which parcel holds each point: `meshwalk locate --polygons` beside shapely's tree.

bench_parcels.py MESHWALK [--side N] [--points N] [--rounds N]

Makes N x N parcels with moved corners, some with a courtyard (a hole), and random points. In each
round every competitor runs once, on one thread, in a process of its own:

    meshwalk    reads parcels and points, writes a row for each point
    shapely     reads the same, builds an STRtree, asks for all pairs of a point and a polygon that
                holds it (PyPI: shapely)

Both must find the same number of pairs. Prints medians of the processor time: of the whole, and of
each further point (the whole less the whole with one point), where building cancels out.
`build/bench/bench/bench_polygons` measures the library beside GEOS, without reading and writing.
"""

import argparse
import importlib.util
import json
import os
import random
import resource
import statistics
import subprocess
import sys
import tempfile

SHAPELY = """
import json, sys
import numpy as np, shapely
with open(sys.argv[1]) as file:
    parcels = [shapely.geometry.shape(f["geometry"]) for f in json.load(file)["features"]]
points = shapely.points(np.loadtxt(sys.argv[2], delimiter=",", skiprows=1, ndmin=2))
tree = shapely.STRtree(parcels)
print(tree.query(points, predicate="intersects").shape[1])
"""


def make_parcels(path, side, draw):
    """Write the parcels: quadrilaterals between the moved corners of a grid."""
    corner = [
        [(x + draw.uniform(-0.3, 0.3), y + draw.uniform(-0.3, 0.3)) for x in range(side + 1)]
        for y in range(side + 1)
    ]
    features = []
    for y in range(side):
        for x in range(side):
            ring = [corner[y][x], corner[y][x + 1], corner[y + 1][x + 1], corner[y + 1][x]]
            rings = [[*ring, ring[0]]]
            if (x + y) % 7 == 0:
                middle = [sum(p[k] for p in ring) / 4 for k in (0, 1)]
                hole = [[(3 * middle[k] + p[k]) / 4 for k in (0, 1)] for p in reversed(ring)]
                rings.append([*hole, hole[0]])
            geometry = {"type": "Polygon", "coordinates": rings}
            features.append({"type": "Feature", "properties": {}, "geometry": geometry})
    with open(path, "w") as file:
        json.dump({"type": "FeatureCollection", "features": features}, file)


def make_points(path, count, side, draw):
    """Write random points, one in twenty or so outside of all parcels."""
    with open(path, "w") as file:
        file.write("x,y\n")
        for _ in range(count):
            file.write(
                f"{draw.uniform(-0.5, side + 0.5):.6f},{draw.uniform(-0.5, side + 0.5):.6f}\n"
            )


def processor_time(command, out):
    """Run a command and return the processor seconds that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, stdout=out, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def count_pairs(path):
    """Count the pairs that the program reports: the feature of a row, and the others behind it."""
    with open(path) as file:
        header = file.readline().strip().split(",")
        feature, others = header.index("feature"), header.index("others")
        rows = (line.rstrip("\n").split(",") for line in file)
        return sum((row[feature] != "-1") + len(row[others].split()) for row in rows)


def main():
    """Measure, check and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("meshwalk")
    parser.add_argument("--side", type=int, default=200)
    parser.add_argument("--points", type=int, default=500_000)
    parser.add_argument("--rounds", type=int, default=3)
    asked = parser.parse_args()
    engines = ["meshwalk"]
    if importlib.util.find_spec("shapely"):
        engines.append("shapely")
    else:
        print("without shapely: pip install shapely", file=sys.stderr)
    draw = random.Random(1)
    with tempfile.TemporaryDirectory() as folder:
        parcels, many, one, out = (
            os.path.join(folder, n) for n in ("p.geojson", "many.csv", "one.csv", "out")
        )
        make_parcels(parcels, asked.side, draw)
        make_points(many, asked.points, asked.side, draw)
        make_points(one, 1, asked.side, draw)
        whole = {e: [] for e in engines}
        more = {e: [] for e in engines}
        pairs = {}
        for _ in range(asked.rounds):
            for engine in engines:
                times = []
                for points in (one, many):
                    command = [sys.executable, "-c", SHAPELY, parcels, points]
                    if engine == "meshwalk":
                        command = [asked.meshwalk, "locate", "-q", "--threads", "1", "--polygons"]
                        command += [parcels, "--points-crs", "same", points]
                    with open(out, "w") as file:
                        times.append(processor_time(command, file))
                whole[engine].append(times[1])
                more[engine].append((times[1] - times[0]) / asked.points * 1e9)
                with open(out) as file:
                    pairs[engine] = count_pairs(out) if engine == "meshwalk" else int(file.read())
    print("engine\tpairs\twhole_s\tpoint_ns")
    for engine in engines:
        print(
            f"{engine}\t{pairs[engine]}\t{statistics.median(whole[engine]):.2f}\t{statistics.median(more[engine]):.0f}"
        )
    if len(set(pairs.values())) > 1:
        sys.exit("the engines do not find the same pairs")


if __name__ == "__main__":
    main()
