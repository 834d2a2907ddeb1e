"""The sample meshes of the gallery and the playground: samples.py FOLDER writes them."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import meshwalk


def _ring(centre: tuple[float, float], radius: float, count: int, wave: float) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    r = radius * (1 + wave * np.sin(3 * angle) + wave / 2 * np.cos(7 * angle))
    return np.column_stack([centre[0] + r * np.cos(angle), centre[1] + r * np.sin(angle)])


def bay() -> meshwalk.Mesh:
    """Return a bay with three islands, which are holes, and its depths."""
    rings = [
        _ring((0, 0), 100, 220, 0.08),
        _ring((-35, 20), 18, 60, 0.1),
        _ring((40, -10), 14, 50, 0.1),
        _ring((5, -50), 9, 40, 0.05),
    ]
    rng = np.random.default_rng(33)
    points, segments = [], []
    for ring in rings:
        first = sum(map(len, points))
        number = first + np.arange(len(ring))
        points.append(ring)
        segments.append(np.column_stack([number, first + (number - first + 1) % len(ring)]))
    inner = rng.uniform(-110, 110, (3000, 2))
    points.append(inner)
    holes = [(-35, 20), (40, -10), (5, -50)]
    mesh = meshwalk.constrained_delaunay(np.vstack(points), np.vstack(segments), holes)
    near = [np.hypot(*(mesh.points[:, :2] - hole).T) for hole in holes]
    depth = 30 * (1 - np.exp(-np.minimum.reduce(near) / 40)) + 5 * np.sin(mesh.points[:, 0] / 30)
    return meshwalk.Mesh(mesh.points[:, :2], mesh.triangles, fields={"depth": depth})


def broken() -> tuple[np.ndarray, np.ndarray]:
    """Return the arrays of a mesh with a fold, an overlap and a corner inside an edge."""
    rng = np.random.default_rng(5)
    mesh = meshwalk.delaunay(rng.uniform(0, 100, (1500, 2)))
    points, triangles = mesh.points[:, :2].copy(), mesh.triangles.copy()
    corners = triangles[int(meshwalk.Locator(mesh).locate([[30, 70]]).triangle[0])]
    across = points[corners[1]] + points[corners[2]] - points[corners[0]]
    points[corners[0]] = points[corners[0]] + 1.6 * (across - points[corners[0]])  # a fold
    extra = np.array([[60, 20], [66, 22], [62, 27]])  # a triangle on top of others
    first = len(points)
    points = np.vstack([points, extra])
    triangles = np.vstack([triangles, [[first, first + 1, first + 2]]])
    edge = triangles[int(meshwalk.Locator(mesh).locate([[75, 80]]).triangle[0])]
    middle = (points[edge[0]] + points[edge[1]]) / 2  # a corner inside the edge of a neighbour
    points = np.vstack([points, [middle]])
    keep = triangles[~(triangles == edge).all(axis=1)]
    halves = [[edge[0], len(points) - 1, edge[2]], [len(points) - 1, edge[1], edge[2]]]
    return points, np.vstack([keep, halves])


def globe(times: int = 4) -> tuple[np.ndarray, np.ndarray]:
    """Return an octahedron cut into a sphere, a little flat and bumpy."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(times):
        middle: dict[tuple[int, int], int] = {}

        def half(a: int, b: int) -> int:
            key = (min(a, b), max(a, b))
            if key not in middle:  # noqa: B023
                middle[key] = len(points)  # noqa: B023
                points.append(tuple((np.array(points[a]) + points[b]) / 2))
            return middle[key]  # noqa: B023

        cut = []
        for a, b, c in faces:
            ab, bc, ca = half(a, b), half(b, c), half(c, a)
            cut += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = cut
    p = np.array(points, float)
    p /= np.linalg.norm(p, axis=1)[:, None]
    bumps = 1 + 0.08 * np.sin(5 * p[:, 0] + 1) * np.cos(4 * p[:, 1]) + 0.05 * np.sin(9 * p[:, 2])
    return p * bumps[:, None] * [1, 1, 0.9], np.array(faces, np.uint32)


def torus() -> tuple[np.ndarray, np.ndarray]:
    """Return a ring round which a wave runs: no star, and no mesh of the plane."""
    n, m = 96, 32
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    r = 1 + 0.15 * np.sin(6 * u)
    p = np.stack(
        [(3 + r * np.cos(v)) * np.cos(u), (3 + r * np.cos(v)) * np.sin(u), r * np.sin(v)], -1
    )
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    a, b = m * i + j, m * ((i + 1) % n) + j
    c, d = m * ((i + 1) % n) + (j + 1) % m, m * i + (j + 1) % m
    return p.reshape(-1, 3), np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def write_off(path: Path, points: np.ndarray, triangles: np.ndarray) -> None:
    """Write arrays as they are, defects and all."""
    rows = [f"OFF\n{len(points)} {len(triangles)} 0"]
    rows += [" ".join(f"{x:.17g}" for x in (*p, 0.0)[:3]) for p in points.tolist()]
    rows += [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    path.write_text("\n".join(rows) + "\n")


def main(folder: Path) -> None:
    """Write all samples."""
    bay().write(folder / "bay.ply")
    write_off(folder / "broken.off", *broken())
    write_off(folder / "globe.off", *globe())
    write_off(folder / "torus.off", *torus())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
