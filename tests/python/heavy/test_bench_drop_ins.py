"""The rows of ``python -m meshwalk.bench --task drop-ins`` whose originals are large."""

from __future__ import annotations

from importlib.util import find_spec

import pytest
from conftest import NOT_HERE

from meshwalk._drop_ins.bench import PAIRS, measure


@pytest.mark.parametrize("name", sorted(set(PAIRS) - {"matplotlib", "scipy"}))
def test_answers_are_the_same(name: str) -> None:
    if find_spec(PAIRS[name].original) is None:
        pytest.skip(f"{PAIRS[name].original} {NOT_HERE}")
    [(theirs, ours)] = measure([name], 300, 500, 1)
    # OpenDrift takes the face whose centre is the nearest.
    assert 0.5 < theirs.same < 1 if name == "opendrift" else theirs.same == 1
    assert ours.name == f"meshwalk.{name}"
    assert ours.query > 0
