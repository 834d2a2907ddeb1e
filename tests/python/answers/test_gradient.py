"""Gradients of values at vertices, beside those of matplotlib and of planes."""

from __future__ import annotations

import numpy as np
import pytest

import meshwalk


def test_gradients_of_planes_are_known(
    scattered: meshwalk.Mesh, random: np.random.Generator
) -> None:
    hit = meshwalk.Locator(scattered).locate(random.uniform(0, 12, (4, 25, 2)))
    slopes = random.uniform(-3, 3, (2, 2, 3))  # x and y of 2 x 3 fields
    x, y = scattered.points.T[:, :, None, None]
    values = slopes[0] * x + slopes[1] * y
    got = hit.gradient(values)
    assert got.shape == (4, 25, 2, 3, 2)
    there = hit.triangle >= 0
    wanted = np.broadcast_to(np.moveaxis(slopes, 0, -1), got[there].shape)
    np.testing.assert_allclose(got[there], wanted, atol=1e-9)
    assert np.isnan(got[~there]).all()
    assert not there.all()


def test_gradients_are_those_of_matplotlib(
    scattered: meshwalk.Mesh, random: np.random.Generator
) -> None:
    tri = pytest.importorskip("matplotlib.tri")
    points, xy = scattered.points, random.uniform(1, 11, (300, 2))
    values = random.uniform(size=len(points))
    other = tri.LinearTriInterpolator(
        tri.Triangulation(*points.T, scattered.triangles), values
    ).gradient(*xy.T)
    got = meshwalk.Locator(scattered).locate(xy).gradient(values)
    for k in (0, 1):
        wanted = np.ma.filled(other[k], np.nan)
        np.testing.assert_allclose(got[:, k], wanted, rtol=1e-9, atol=1e-12)


def test_where_there_is_none(square: meshwalk.Mesh) -> None:
    mesh = meshwalk.Mesh(square.points, square.triangles, {"h": [1, np.nan, 3, 4]})
    xy = np.array([[3, 1], [1, 3], [9, 9], [-0.5, 3]])
    hit = meshwalk.Locator(mesh, border=True).locate(xy, tolerance=1)
    assert hit.gradient("h")[1].tolist() == [-0.25, 0.75]
    assert np.isfinite(hit.gradient("h"))[:, 0].tolist() == [False, True, False, True]
    assert hit[1].gradient("h").shape == (2,)
    borrowed = meshwalk.BorrowedMesh(mesh.points, mesh.triangles, [[-1, 1, -1], [-1, -1, 0]])
    one = borrowed.locate([1, 3]).gradient(mesh.fields["h"])
    np.testing.assert_array_equal(one, hit.gradient("h")[1])
    with pytest.raises(ValueError, match="a row for each of the 4 vertices"):
        hit.gradient([1, 2, 3])
    with pytest.raises(TypeError, match=r"locate in editor\.mesh"):
        meshwalk.Editor(mesh).locate([[1, 1]]).gradient("h")
    corners = [[1, 0, 0], [-1, 1, 0], [-1, -1, 0], [0, 0, 1], [0, 0, -1]]
    sides = [[0, 1, 3], [1, 2, 3], [2, 0, 3], [1, 0, 4], [2, 1, 4], [0, 2, 4]]
    star = meshwalk.Star(meshwalk.Surface(corners, sides))
    with pytest.raises(TypeError, match="a mesh in the plane, not of a surface"):
        star.locate([[1, 1, 1]]).gradient(np.zeros(5))
