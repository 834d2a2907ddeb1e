#!/usr/bin/env python3
"""The cost model of docs/scaling.md: its constants, measured here, and what it foretells.

python bench/programs/bench_scaling.py [--sizes LIST] [--routing FILE]

One thread, processor time. FILE is what `meshwalk bench scale --ranks LIST --format tsv` prints;
for each of its rows the model tells what a mesh and queries of --mesh and --queries take. --message
and --bandwidth are those of a network that is not here. Needs the Python module.
"""

from __future__ import annotations

import argparse
import csv
import os
import tempfile
import time
from typing import Any

import meshwalk
import numpy as np

BLOCK = 2**18  # queries of a block, and questions that a rank takes in a round
MESSAGES = 5  # that each two ranks exchange in a round
BOX, MOST_BOXES, BOXES_OF_A_RANK = 40, 2**20, 64
RIM = 300  # bytes of a triangle at the border, on each rank
LOCATION = 48  # bytes of an answer, as it goes and as it comes
ASKED, SORTED = 64, 25  # bytes of a question of others, and of a query of the rank's own block


def spent(work: Any, rounds: int = 1) -> tuple[float, Any]:
    """Seconds of the processor, in the best round, and what the work gave."""
    best, result = np.inf, None
    for _ in range(rounds):
        begin = time.process_time()
        result = work()
        best = min(best, time.process_time() - begin)
    return best, result


def constants(vertices: int, queries: int, seed: int) -> dict[str, float]:
    """What a vertex and a query cost."""
    random = np.random.default_rng(seed)
    given = meshwalk.delaunay(random.uniform(size=(vertices, 2)))
    points, triangles = given.points, given.triangles
    make, mesh = spent(lambda: meshwalk.Mesh(points, triangles, threads=1))
    link, locator = spent(lambda: meshwalk.Locator(mesh, threads=1))
    xy = random.uniform(size=(queries, 2))
    batch, hit = spent(lambda: locator.locate(xy, threads=1), 3)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.mwm")
        write, _ = spent(lambda: locator.prepare(path))
        size = os.stat(path).st_size
        check, _ = spent(lambda: meshwalk.map(path, threads=1))
        mapped = meshwalk.map(path, trust=True)
        batch_mapped, _ = spent(lambda: mapped.locate(xy, threads=1), 3)
    assert (hit.triangle >= -1).all()
    return {
        "vertices": vertices,
        "bytes a vertex": size / vertices,
        "prepare, us a vertex": 1e6 * (make + link) / vertices,
        "write, us a vertex": 1e6 * write / vertices,
        "check, us a vertex": 1e6 * check / vertices,
        "query, ns": 1e9 * batch / queries,
        "query, mapped, ns": 1e9 * batch_mapped / queries,
    }


def foretell(row: dict[str, str], cost: dict[str, float], given: argparse.Namespace) -> list[str]:
    """What the mesh and the queries take, routed as the row of `bench scale --ranks` says."""
    ranks, work, rounds = int(row["ranks"]), float(row["work"]), float(row["rounds"])
    each = given.queries / ranks  # queries of a rank
    boxes = BOX * min(MOST_BOXES, BOXES_OF_A_RANK * ranks)
    memory = given.mesh * cost["bytes a vertex"] / ranks + boxes + RIM * 4 * given.mesh**0.5
    memory += BLOCK * (2 * LOCATION + ASKED + SORTED)
    prepare = 1e-6 * cost["prepare, us a vertex"] * given.mesh / ranks
    locate = 1e-9 * cost["query, ns"] * each * work
    traffic = each * (float(row["out_B"]) + float(row["back_B"])) / given.bandwidth
    agree = max(each / BLOCK, 1) * rounds * MESSAGES * (ranks - 1) * given.message
    figures = [memory / 1e6, prepare, locate, traffic, agree]
    return [row["queries"], f"{ranks}", *(f"{figure:.3g}" for figure in figures)]


def main() -> None:
    """Print the constants, and the model for each row of a routing."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sizes", default="1e5,1e6", help="vertices to measure with")
    parser.add_argument("--points", type=float, default=1e6, help="queries to measure with")
    parser.add_argument("--routing", help="a table of bench scale --ranks, of the format tsv")
    parser.add_argument("--mesh", type=float, default=1e10, help="vertices of the model")
    parser.add_argument("--queries", type=float, default=1e13, help="queries of the model")
    parser.add_argument("--message", type=float, default=1e-6, help="seconds of a message")
    parser.add_argument("--bandwidth", type=float, default=1e9, help="bytes a second of a rank")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    for size in given.sizes.split(","):
        cost = constants(int(float(size)), int(given.points), given.seed)
        print("  ".join(f"{name}: {value:.4g}" for name, value in cost.items()))
    if given.routing:
        print("queries\tranks\tmemory_MB\tprepare_s\tlocate_s\ttraffic_s\trounds_s")
        with open(given.routing, encoding="ascii") as table:
            for row in csv.DictReader(table, delimiter="\t"):
                print("\t".join(foretell(row, cost, given)))


if __name__ == "__main__":
    main()
