"""Arrays that are mended."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import meshwalk

# Two squares side by side: twice the same edge, a T-junction, a triangle too many, one without
# area, one turned.
POINTS = [[0, 0, 5], [2, 0, 6], [2, 2, 7], [0, 2, 8], [2, 0, 6], [4, 0, 1], [4, 2, 1], [2, 2, 7]]
TRIANGLES = [[0, 1, 2], [0, 3, 2], [4, 5, 6], [4, 6, 7], [2, 1, 0], [0, 1, 5]]


def test_each_repair() -> None:
    mended = meshwalk.mend(POINTS, TRIANGLES)
    kinds = [change.kind for change in mended.changes]
    assert sorted(set(kinds)) == ["dropped, duplicate", "dropped, flat", "turned", "welded"]
    assert mended.points.tolist() == [POINTS[i] for i in (0, 1, 2, 3, 5, 6)]
    assert mended.vertex_from.tolist() == [0, 1, 2, 3, 5, 6]
    assert mended.vertex_to.tolist() == [0, 1, 2, 3, 1, 4, 5, 2]
    assert mended.triangle_from.tolist() == [0, 1, 2, 3]
    mesh = mended.mesh({"id": range(8)}, crs="EPSG:2056")
    assert mesh.check().valid
    assert mesh.crs == "EPSG:2056"
    assert mesh.fields["id"].tolist() == [0, 1, 2, 3, 5, 6]
    again = meshwalk.mend(mended.points, mended.triangles)
    assert again.changes == []
    np.testing.assert_array_equal(again.triangles, mended.triangles)


def test_chosen_repairs() -> None:
    mended = meshwalk.mend(POINTS, TRIANGLES, "orient")
    assert [change.kind for change in mended.changes] == ["turned"] * 2
    assert len(mended.points) == 8
    split = meshwalk.mend(
        [[0, 0], [4, 0], [2, 3], [2, 0], [2, -1]], [[0, 1, 2], [0, 4, 3], [3, 4, 1]], ["split"]
    )
    assert split.triangle_from.tolist() == [0, 0, 1, 2]
    assert split.changes[0].kind == "split"
    assert split.changes[0][2:4] == (0, 3)
    near = np.array([[0, 0], [1, 0], [0, 1], [1.25, 0], [1, 1]])
    assert len(meshwalk.mend(near, [[0, 1, 2], [3, 4, 2]], ["weld"]).points) == 5
    assert len(meshwalk.mend(near, [[0, 1, 2], [3, 4, 2]], ["weld"], tolerance=0.25).points) == 4


def test_in_space() -> None:
    points = [[0, 0, 0], [1, 0, 0], [0, 0, 1], [1, 0, 1]]
    mended = meshwalk.mend(points, [[0, 1, 2], [1, 2, 3]], space=True)
    assert [change.kind for change in mended.changes] == ["turned"]
    assert meshwalk.Surface(mended.points, mended.triangles).describe().oriented


def test_what_is_refused() -> None:
    with pytest.raises(ValueError, match="repairs must be of weld, drop, split, orient, not 'glue"):
        meshwalk.mend(POINTS, TRIANGLES, ["glue"])
    with pytest.raises(ValueError, match="at least one"):
        meshwalk.mend(POINTS, TRIANGLES, [])
    for tolerance in (-1, np.nan, np.inf):
        with pytest.raises(ValueError, match="tolerance"):
            meshwalk.mend(POINTS, TRIANGLES, tolerance=tolerance)
    with pytest.raises(meshwalk.InputError, match="local vertex 2 does not exist"):
        meshwalk.mend(POINTS, [[0, 1, 8]], "orient")
    with pytest.raises(ValueError, match="shape"):
        meshwalk.mend(np.zeros((3, 2)), [[0, 1, 2]], space=True)
    empty = meshwalk.mend(np.zeros((0, 2)), np.zeros((0, 3), int))
    assert empty.triangles.shape == (0, 3)


def test_as_the_program(tmp_path: Path) -> None:
    lines = ["OFF", f"{len(POINTS)} {len(TRIANGLES)} 0"]
    lines += [" ".join(map(str, point)) for point in POINTS]
    lines += ["3 " + " ".join(map(str, corners)) for corners in TRIANGLES]
    (tmp_path / "bad.off").write_text("\n".join(lines) + "\n")
    command = [os.environ["MESHWALK"], "check", "-q", "--fix", "weld,drop,split,orient"]
    subprocess.run(
        [*command, "bad.off", "-o", "good.ply"], cwd=tmp_path, check=True, stdout=subprocess.DEVNULL
    )
    good = meshwalk.read(tmp_path / "good.ply")
    mended = meshwalk.mend(POINTS, TRIANGLES)
    np.testing.assert_array_equal(good.points, mended.points[:, :2])
    np.testing.assert_array_equal(good.triangles, mended.triangles)
