#!/usr/bin/env python3
"""Thin the Jacksboro fault elevation grid to an irregular set of points: data/jacksboro.csv.

    tools/make_jacksboro.py [--points N] [GRID.npz [OUTPUT.csv]]

Greedy insertion [Garland, Heckbert 1995]: start from the four corners of the grid. Again and again
take the grid point whose height the present Delaunay triangulation misses by most, and insert it
[Bowyer 1981; Watson 1981]. So the points stand in order of importance: the first n lines are a
model of n points.

All decisions are made on integers (grid cells, centimetres, metres of height), so every machine
writes the same bytes. Needs NumPy. The grid comes with Debian's python-matplotlib-data.
"""
import argparse
import heapq
import math

import numpy as np

GRID = "/usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz"
OUTPUT = "data/jacksboro.csv"


def centimetres_per_cell(latitude, cell):
    """Size of a cell of `cell` degrees on the WGS 84 ellipsoid: east-west and north-south."""
    a, e2 = 6378137.0, 0.00669437999014
    phi = math.radians(latitude)
    w2 = 1.0 - e2 * math.sin(phi) ** 2
    east = a / math.sqrt(w2) * math.cos(phi)
    north = a * (1.0 - e2) / w2**1.5
    return 100.0 * math.radians(cell) * east, 100.0 * math.radians(cell) * north


class Grid:
    """Heights by row from the south and column from the west, with the centimetres of each row and column."""

    def __init__(self, path):
        data = np.load(path)
        # The file calls the northern edge ymin: its rows run from north to south.
        south, north = sorted((float(data["ymin"]), float(data["ymax"])))
        self.height = data["elevation"][::-1].astype(np.int64)
        self.rows, self.columns = self.height.shape
        east_cm, north_cm = centimetres_per_cell((south + north) / 2, float(data["dx"]))
        self.x = [round(column * east_cm) for column in range(self.columns)]
        self.y = [round(row * north_cm) for row in range(self.rows)]

    def place(self, point):
        row, column = divmod(point, self.columns)
        return self.x[column], self.y[row]


def orient(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def incircle(a, b, c, d):
    ax, ay, bx, by = a[0] - d[0], a[1] - d[1], b[0] - d[0], b[1] - d[1]
    cx, cy = c[0] - d[0], c[1] - d[1]
    a2, b2, c2 = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    return ax * (by * c2 - b2 * cy) - ay * (bx * c2 - b2 * cx) + a2 * (bx * cy - by * cx)


class Thinning:
    """A Delaunay triangulation of some grid points, and for each triangle the point that it misses by most."""

    def __init__(self, grid):
        self.grid = grid
        self.across = {}  # directed edge (a, b) -> the triangle to its left
        self.worst = []  # heap of (-error, point, triangle); triangles that are gone are skipped
        last = grid.rows * grid.columns - 1
        south_west, south_east, north_west = 0, grid.columns - 1, last - grid.columns + 1
        self.points = [south_west, south_east, last, north_west]
        self.add((south_west, south_east, last))
        self.add((south_west, last, north_west))

    def add(self, triangle):
        a, b, c = triangle
        for edge in ((a, b), (b, c), (c, a)):
            self.across[edge] = triangle
        error, point = self.largest_error(triangle)
        if error > 0:
            heapq.heappush(self.worst, (-error, point, triangle))

    def remove(self, triangle):
        a, b, c = triangle
        for edge in ((a, b), (b, c), (c, a)):
            if self.across.get(edge) == triangle:
                del self.across[edge]

    def largest_error(self, triangle):
        """(error, point): 2^16 times the height that the triangle misses there, rounded down."""
        grid = self.grid
        corners = [divmod(point, grid.columns) for point in triangle]
        row0, row1 = min(r for r, _ in corners), max(r for r, _ in corners)
        column0, column1 = min(c for _, c in corners), max(c for _, c in corners)
        row = np.arange(row0, row1 + 1, dtype=np.int64)[:, None]
        column = np.arange(column0, column1 + 1, dtype=np.int64)[None, :]
        weights = []
        for k in range(3):
            (r1, c1), (r2, c2) = corners[(k + 1) % 3], corners[(k + 2) % 3]
            weights.append((c2 - c1) * (row - r1) - (r2 - r1) * (column - c1))
        inside = (weights[0] >= 0) & (weights[1] >= 0) & (weights[2] >= 0)
        area = int(weights[0][0, 0] + weights[1][0, 0] + weights[2][0, 0])
        found = sum(w * int(grid.height[corner]) for w, corner in zip(weights, corners))
        miss = np.abs(found - area * grid.height[row0 : row1 + 1, column0 : column1 + 1])
        error = np.where(inside, miss * 65536 // area, 0)
        at = int(error.argmax())
        r, c = divmod(at, error.shape[1])
        return int(error[r, c]), (row0 + r) * grid.columns + column0 + c

    def cavity(self, triangle, place):
        """Triangles whose circle holds `place`, found from the one that contains it."""
        found, todo = {triangle}, [triangle]
        while todo:
            a, b, c = todo.pop()
            for edge in ((b, a), (c, b), (a, c)):
                other = self.across.get(edge)
                if other is None or other in found:
                    continue
                if incircle(*(self.grid.place(p) for p in other), place) > 0:
                    found.add(other)
                    todo.append(other)
        return found

    def insert(self, point, triangle):
        place = self.grid.place(point)
        cavity = self.cavity(triangle, place)
        edges = {edge for a, b, c in cavity for edge in ((a, b), (b, c), (c, a))}
        for old in cavity:
            self.remove(old)
        for a, b in sorted(edges):
            if (b, a) in edges:
                continue
            # not the piece of border it lies on
            if orient(self.grid.place(a), self.grid.place(b), place) > 0:
                self.add((a, b, point))
        self.points.append(point)

    def present(self, triangle):
        return self.across.get(triangle[:2]) == triangle

    def run(self, count):
        """Insert until there are `count` points; the error that is left, in metres."""
        while self.worst:
            error, point, triangle = self.worst[0]
            if not self.present(triangle):
                heapq.heappop(self.worst)
                continue
            if len(self.points) == count:
                return -error / 65536
            heapq.heappop(self.worst)
            self.insert(point, triangle)
        return 0.0


def metres(centimetres):
    return f"{centimetres // 100}.{centimetres % 100:02d}"


def main():
    parser = argparse.ArgumentParser(description="Thin the Jacksboro elevation grid to an irregular set of points.")
    parser.add_argument("grid", nargs="?", default=GRID, help="jacksboro_fault_dem.npz (default: %(default)s)")
    parser.add_argument("output", nargs="?", default=OUTPUT, help="default: %(default)s")
    parser.add_argument("--points", type=int, default=20000, help="how many points to keep (default: %(default)s)")
    options = parser.parse_args()

    grid = Grid(options.grid)
    thinning = Thinning(grid)
    error = thinning.run(options.points)
    with open(options.output, "w", encoding="ascii", newline="\n") as output:
        output.write("x,y,z\n")
        for point in thinning.points:
            x, y = grid.place(point)
            height = int(grid.height.flat[point])
            output.write(f"{metres(x)},{metres(y)},{height}\n")
    print(f"{len(thinning.points)} of {grid.rows * grid.columns} points; heights are missed by at most {error:.2f} m")


if __name__ == "__main__":
    main()
