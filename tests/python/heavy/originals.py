"""The tests that the originals publish, run with a drop-in in place."""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest


def sources(name: str) -> Path:
    """The sources of the installed version of a package, from PyPI once."""
    folder = Path(sys.prefix) / "sources"
    stem = f"{name}-{version(name)}"
    if not (folder / stem).exists():
        command = ["download", "--quiet", "--no-deps", "--no-binary", ":all:"]
        asked = [*command, "--dest", str(folder), stem.replace(f"{name}-", f"{name}==")]
        got = subprocess.run([sys.executable, "-m", "pip", *asked], capture_output=True, text=True)
        if got.returncode != 0:
            pytest.skip(f"the sources of {stem} cannot be had: {got.stderr.strip()[-200:]}")
        with tarfile.open(folder / f"{stem}.tar.gz") as archive:
            # Python 3.11.4 and later refuse paths out of the folder.
            safe: dict[str, Any] = {"filter": "data"} if hasattr(tarfile, "data_filter") else {}
            archive.extractall(folder, **safe)
    return folder / stem


def run_their_tests(
    folder: Path, files: list[str], drop_in: str, choice: str, least: int, work: Path
) -> None:
    """Run test files of a folder; `drop_in` is the program that puts the drop-in in place.

    Parameters
    ----------
    folder : Path
        Where their folder `tests` lies; it is not written to.
    files : list of str
        The files, relative to it.
    drop_in : str
        Lines of Python that run before the tests are collected.
    choice : str
        What pytest's option ``-k`` chooses.
    least : int
        So many have to pass, so that none is lost when the original changes.
    work : Path
        An empty folder.
    """
    (work / "drop_in.py").write_text(drop_in)
    command = [sys.executable, "-m", "pytest", "-q", "-p", "drop_in", "-p", "no:cacheprovider"]
    ran = subprocess.run(
        [*command, "-k", choice, *files],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(work), "MPLBACKEND": "agg"},
        capture_output=True,
        text=True,
    )
    assert ran.returncode == 0, ran.stdout[-3000:]
    passed = int(ran.stdout.rsplit(" passed", 1)[0].split()[-1])
    assert passed >= least, ran.stdout[-500:]
