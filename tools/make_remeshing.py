#!/usr/bin/env python3
"""Draw docs/remeshing.png: a star-shaped polyhedron, and the same shape on icospheres.

    tools/make_remeshing.py [OUTPUT.png]

The polyhedron is a ball with dents, of triangles that are crowded at its poles. The colour of each
new triangle is the distance of its middle from the polyhedron. Needs the Python module and
matplotlib.
"""

from __future__ import annotations

import sys

import matplotlib as mpl

mpl.use("agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import meshwalk

COLUMNS, ROWS = 48, 24
LEVELS = 3, 4, 5
MOST = 0.03  # the distance with the last colour
TOWARDS_EYE = np.array([0.62, -0.62, 0.48])


def radius(direction: np.ndarray) -> np.ndarray:
    """A ball with narrow dents."""
    dents = np.array([[0.9, -0.3, 0.3], [0.2, -0.9, 0.4], [0.5, -0.5, 0.75], [0.75, -0.65, -0.1]])
    r = 1 + 0.12 * direction[:, 2] * direction[:, 0]
    for dent, width in zip(dents, (0.30, 0.22, 0.16, 0.12), strict=True):
        away = np.arccos(np.clip(direction @ (dent / np.linalg.norm(dent)), -1, 1))
        r = r - 0.25 * np.exp(-((away / width) ** 2))
    return r


def polyhedron() -> meshwalk.Surface:
    """Rows of triangles along parallels, one vertex at each pole."""
    longitude = np.arange(COLUMNS) * 360 / COLUMNS
    latitude = np.linspace(-90, 90, ROWS + 1)[1:-1]
    places = [(x, y) for y in latitude for x in longitude]
    directions = meshwalk.lonlat_to_direction([*places, (0, -90), (0, 90)])
    triangles = []
    south, north = len(places), len(places) + 1
    for i in range(COLUMNS):
        j = (i + 1) % COLUMNS
        triangles.append((south, j, i))
        last = COLUMNS * (ROWS - 2)
        triangles.append((north, last + i, last + j))
        for row in range(ROWS - 2):
            a, b = COLUMNS * row + i, COLUMNS * row + j
            triangles += [(a, b, b + COLUMNS), (a, b + COLUMNS, a + COLUMNS)]
    return meshwalk.Surface(directions * radius(directions)[:, None], triangles)


def draw(ax, surface: meshwalk.Surface, distances: np.ndarray | None, title: str) -> None:
    """The facets that face the eye, lit from the upper left, in the colours of the distances."""
    corners = surface.points[surface.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    seen = normal @ TOWARDS_EYE > 0
    light = 0.45 + 0.55 * np.clip(normal @ np.array([0.1, -0.6, 0.8]), 0, 1)
    if distances is None:
        colours = np.full((len(corners), 3), 0.85)
    else:
        colours = mpl.colormaps["YlOrRd"](np.clip(distances / MOST, 0, 1))[:, :3]
    faces = Poly3DCollection(
        corners[seen],
        facecolors=(colours * light[:, None])[seen],
        edgecolors=(0.1, 0.1, 0.1, 0.35),
        linewidths=0.25,
    )
    ax.add_collection3d(faces)
    ax.view_init(elev=np.degrees(np.arcsin(TOWARDS_EYE[2])), azim=-45)
    ax.set(xlim=(-0.75, 0.75), ylim=(-0.75, 0.75), zlim=(-0.75, 0.75), box_aspect=(1, 1, 1))
    ax.set_axis_off()
    ax.set_title(title, fontsize=9)


def main() -> None:
    """Draw the picture."""
    given = polyhedron()
    star = meshwalk.Star(given)
    boxes = meshwalk.Prober(given, boxes=True)
    figure = plt.figure(figsize=(12, 3.6))
    draw(
        figure.add_subplot(1, 4, 1, projection="3d"),
        given,
        None,
        f"the polyhedron\n{given.triangle_count} triangles",
    )
    for i, level in enumerate(LEVELS):
        made = star.remesh(level).surface
        distances = boxes.nearest(made.points[made.triangles].mean(1)).distance
        there = boxes.deviation(made)
        back = meshwalk.Prober(made, boxes=True).deviation(given)
        largest = max(there.largest, back.largest)
        draw(
            figure.add_subplot(1, 4, i + 2, projection="3d"),
            made,
            distances,
            f"level {level}: {made.triangle_count} triangles\n"
            f"largest distance {largest:.3f}, mean {there.mean:.4f}",
        )
    figure.subplots_adjust(0, 0, 0.93, 0.88, wspace=0)
    scale = mpl.cm.ScalarMappable(mpl.colors.Normalize(0, MOST), "YlOrRd")
    bar = figure.colorbar(scale, cax=figure.add_axes((0.935, 0.15, 0.01, 0.6)), extend="max")
    bar.set_label("distance of a triangle's middle", fontsize=8)
    bar.ax.tick_params(labelsize=8)
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "docs/remeshing.png", dpi=110)


main()
