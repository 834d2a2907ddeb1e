#!/usr/bin/env python3
"""Heights for a table of many rows and six columns, beside programs that read and write it.

bench_tables.py MESHWALK [--rows N] [--rounds N] [--folder FOLDER]

Makes a terrain of data/jacksboro.csv and a table of random positions in it, with an id, a code, a
time and a value. Then, in rounds, each competitor once, on one thread:

    meshwalk    `meshwalk sample`: every row as it stands, the height behind it
    discard     the same to /dev/null
    cat         copies the bytes: what the disk takes
    duckdb      reads the table, adds a column (x + y), writes it (PyPI: duckdb)
    pyarrow     the same in batches (PyPI: pyarrow)

Names what is not installed, and leaves it out. Prints the medians: wall and processor time in
nanoseconds a row, and the most memory, in MB. Where others use the machine, compare the processor
time.
"""

import argparse
import glob
import importlib.util
import os
import random
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

DUCKDB = """
import duckdb, sys
c = duckdb.connect(config={"threads": 1, "memory_limit": "2GB"})
c.execute(f"COPY (SELECT *, x + y AS z FROM read_csv('{sys.argv[1]}')) TO '{sys.argv[2]}' (HEADER)")
"""

PYARROW = """
import sys
import pyarrow as pa, pyarrow.compute as pc, pyarrow.csv as csv
pa.set_cpu_count(1)
pa.set_io_thread_count(1)
out = None
for batch in csv.open_csv(sys.argv[1], read_options=csv.ReadOptions(use_threads=False)):
    table = pa.Table.from_batches([batch])
    table = table.append_column("z", pc.add(table["x"], table["y"]))
    out = out or csv.CSVWriter(sys.argv[2], table.schema)
    out.write_table(table)
out.close()
"""


def make_table(path, rows):
    """Write the table: the rows after the first hundred thousand repeat these but for their ids."""
    draw = random.Random(1)
    block = [
        f"{draw.uniform(0, 30000):.3f},{draw.uniform(0, 20000):.3f},B{i % 1000},"
        f"2026-03-{i % 28 + 1:02d}T12:{i % 60:02d}:00,{draw.uniform(0, 30):.2f}\n"
        for i in range(min(rows, 100_000))
    ]
    with open(path, "w", encoding="ascii") as file:
        file.write("id,x,y,code,time,value\n")
        for first in range(0, rows, len(block)):
            last = min(rows - first, len(block))
            file.write("".join([f"{first + i},{block[i]}" for i in range(last)]))


def run(command, out=None):
    """Run a command: wall and processor seconds, and the most memory in MB."""
    begin = time.monotonic()
    with open(out or os.devnull, "wb") as file:
        child = subprocess.Popen(command, stdout=file)
        _, status, usage = os.wait4(child.pid, 0)
    if status:
        sys.exit(f"bench_tables: {command[0]} failed")
    return time.monotonic() - begin, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def competitors(meshwalk, terrain, table, folder):
    """Name each competitor, with its command and the file that takes its standard output."""
    sample = [meshwalk, "sample", terrain, table, "--threads", "1", "-q", "-o"]
    found = {
        "meshwalk": (sample + [os.path.join(folder, "meshwalk.csv")], None),
        "discard": (sample + [os.devnull], None),
        "cat": (["cat", table], os.path.join(folder, "cat.csv")),
    }
    for name, program in (("duckdb", DUCKDB), ("pyarrow", PYARROW)):
        if importlib.util.find_spec(name):
            out = os.path.join(folder, name + ".csv")
            found[name] = ([sys.executable, "-c", program, table, out], None)
        else:
            print(f"skipped: {name} is not installed ('pip install {name}')")
    return found


def main():
    """Make the files, measure, print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("meshwalk")
    parser.add_argument("--rows", type=float, default=1e7)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--folder", help="where the files go, for a while (default: the system's)")
    wanted = parser.parse_args()
    rows = int(wanted.rows)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory(dir=wanted.folder) as folder:
        terrain, table = os.path.join(folder, "terrain.ply"), os.path.join(folder, "table.csv")
        points = os.path.join(ROOT, "data", "jacksboro.csv")
        run([wanted.meshwalk, "triangulate", "-q", points, "-o", terrain])
        make_table(table, rows)
        found = competitors(wanted.meshwalk, terrain, table, folder)
        names = list(found)
        times = {name: [] for name in names}
        for i in range(wanted.rounds):
            for name in names[i % len(names) :] + names[: i % len(names)]:
                # A file that replaces another is flushed to the disk first, on ext4 for one.
                for old in glob.glob(os.path.join(folder, name + ".csv")):
                    os.remove(old)
                times[name].append(run(*found[name]))
        print(f"{rows} rows, {os.path.getsize(table) / 1e6:.0f} MB, {wanted.rounds} rounds")
        print(f"{'':10}{'ns a row':>10}{'processor':>11}{'MB':>8}")
        for name in names:
            wall, processor, memory = (statistics.median(column) for column in zip(*times[name]))
            print(f"{name:10}{1e9 * wall / rows:10.0f}{1e9 * processor / rows:11.0f}{memory:8.0f}")


if __name__ == "__main__":
    main()
