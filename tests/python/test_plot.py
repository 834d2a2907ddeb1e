"""Walks, and pictures of them: what is drawn is what was answered."""

from __future__ import annotations

import itertools

import matplotlib as mpl
import numpy as np
import pytest

import meshwalk

mpl.use("agg")


def test_walks_are_chains(random: np.random.Generator) -> None:
    mesh = meshwalk.delaunay(random.uniform(size=(500, 2)))
    locator = meshwalk.Locator(mesh)
    neighbours = mesh.neighbours
    for walk in ("auto", "straight", "lawson", "celestial"):
        for x, y in random.uniform(0.2, 0.8, (10, 2)):
            path = locator.walk_path(x, y, walk=walk, start="random", seed=int(1e6 * x))
            assert path[-1] == locator.locate_one(x, y).triangle
            for one, following in itertools.pairwise(path):
                assert following in neighbours[one]
    assert locator.walk_path(np.nan, 0).size == 0
    with pytest.raises(ValueError, match="there is no walk 'ramble'"):
        locator.walk_path(0.5, 0.5, walk="ramble")
    with pytest.raises(ValueError, match="index"):
        locator.walk_path(0.5, 0.5, start="grid")


@pytest.mark.parametrize(
    ("point", "title"),
    [
        ((3, 1), "inside of triangle 0"),
        ((2, 2), "on edge 2 of triangle 0; triangle 1 has it, too, and a higher number"),
        ((2, 0), "on edge 0 of triangle 0"),
        ((4, 4), "at vertex 2 of triangle 0; triangle 1 has it, too, and a higher number"),
        ((9, 9), "outside"),
    ],
)
def test_explanations(square: meshwalk.Mesh, point: tuple[float, float], title: str) -> None:
    axes = meshwalk.explain(meshwalk.Locator(square), *point)
    assert axes.get_title().replace("\n", " ") == title
    mpl.pyplot.close("all")


def test_explanations_of_holes_and_fans(ring: meshwalk.Mesh) -> None:
    assert meshwalk.explain(meshwalk.Locator(ring), 3, 3).get_title() == "in hole 0"
    points = [[0, 0], [1, 0], [0, 1], [-1, 0], [0, -1]]
    fan = meshwalk.Mesh(points, [[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    title = meshwalk.explain(meshwalk.Locator(fan), 0, 0).get_title()
    wanted = "at vertex 0 of triangle 0; triangles 1, 2 have it, too, and higher numbers"
    assert title.replace("\n", " ") == wanted
    assert max(map(len, title.split("\n"))) < 60
    with pytest.raises(ValueError, match="not finite"):
        meshwalk.explain(meshwalk.Locator(fan), np.nan, 0)
    mpl.pyplot.close("all")


def test_plots(square: meshwalk.Mesh) -> None:
    axes = meshwalk.plot(square)
    assert meshwalk.plot(square, [1, 2, 3, 4], axes) is axes
    with pytest.raises(ValueError, match="4 vertices"):
        meshwalk.plot(square, [1, 2])
    mpl.pyplot.close("all")


def test_values_of_triangles() -> None:
    points = [[0, 0], [4, 0], [4, 4], [0, 4]]
    mesh = meshwalk.Mesh(points, [[0, 1, 2], [0, 2, 3]], triangle_fields={"soil": [1, 2]})
    colours = meshwalk.plot(mesh, "soil").collections[0].get_array()
    assert colours is not None
    assert np.asarray(colours).tolist() == [1, 2]
    with pytest.raises(KeyError, match="no field 'rock'"):
        meshwalk.plot(mesh, "rock")


def test_an_explanation_shows_the_walk(random: np.random.Generator) -> None:
    mesh = meshwalk.delaunay(random.uniform(size=(2000, 2)))
    locator = meshwalk.Locator(mesh)
    x, y = 0.5, 0.5
    axes = meshwalk.explain(locator, x, y)
    path = locator.walk_path(x, y)
    shown = mesh.points[mesh.triangles[path]].reshape(-1, 2)
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    inside = (shown > [left, bottom]) & (shown < [right, top])
    assert inside.all()
    extent = max(np.ptp(shown, axis=0))
    assert extent < right - left < 2 * extent, "the walk fills the picture"
    legend = axes.get_legend()
    assert legend is not None
    words = [text.get_text() for text in legend.get_texts()]
    assert words == ["visited", "the answer", "the walk", "the point"]
    mpl.pyplot.close("all")
