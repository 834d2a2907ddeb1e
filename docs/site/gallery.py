"""The gallery: each picture is made by the commands, or the Python, that stand below it."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import samples

if TYPE_CHECKING:
    from stage import Pages


class Picture(NamedTuple):
    """One picture: its file, and what makes it."""

    file: str
    title: str
    about: str
    source: str
    language: str = "sh"


PICTURES = [
    Picture("jacksboro.png", "A terrain",
            "Twenty thousand measured heights, triangulated; one search for each pixel.",
            "meshwalk triangulate data/jacksboro.csv -q -o terrain.ply\n"
            "picture terrain.ply jacksboro.png 900"),
    Picture("race.png", "Sixteen walks race",
            "All look for one point. Four of them go round in a ring, in a mesh that is not "
            "Delaunay.",
            "meshwalk walk data/trap.off --walk all --from 0.9,0.1 --to 0.503,0.497 "
            "--animate race.png"),
    Picture("lawson.svg", "Lawson's walk in a ring",
            "It leaves each triangle through the first edge that the point lies beyond, and comes "
            "back to where it was. The library notices that, and another walk ends the search.",
            "meshwalk walk data/trap.off --walk lawson --from 0.9,0.1 --to 0.503,0.497 "
            "-o lawson.svg"),
    Picture("celestial.svg", "The celestial walk in the same mesh",
            "It never moves away from the point, so it ends on every mesh.",
            "meshwalk walk data/trap.off --walk celestial --from 0.9,0.1 --to 0.503,0.497 "
            "-o celestial.svg"),
    Picture("border.svg", "Round the islands",
            "The border walk goes straight, and along the borders of holes that are in its way.",
            "meshwalk walk bay.ply --walk border --from -80,20 --to 70,-20 -o border.svg"),
    Picture("globe.svg", "Over a globe",
            "From one ray out of the centre to another: a walk over the facets of a star-shaped "
            "polyhedron.",
            "meshwalk walk --as star globe.off --walk straight --from 1,0.2,0.3 --to -0.2,1,-0.4 "
            "-o globe.svg"),
    Picture("grid.svg", "Longitude and polar angle",
            "The orthogonal walk goes along a parallel, then along a meridian. It begins in the "
            "first facet of a cell of a grid; these facets are yellow.",
            "meshwalk walk --as star --plane --grid nonuniform globe.off --walk orthogonal "
            "--to -0.2,1,-0.4 -o grid.svg"),
    Picture("probe.svg", "A probe touches a surface",
            "The walk follows the surface along a plane, to the triangle that the line of motion "
            "goes through.",
            "meshwalk walk --as surface torus.off --from 3,0,4 --to 3,0,0 -o probe.svg"),
    Picture("cut.svg", "The plane of a probe's walk",
            "The same walk in its plane, with the triangles that the plane cuts.",
            "meshwalk walk --as surface --plane torus.off --from 3,0,4 --to 3,0,0 -o cut.svg"),
    Picture("depths.png", "Depths of a bay",
            "Values at vertices; the islands are holes of the mesh.",
            'mesh = meshwalk.read("bay.ply")\n'
            'ax = meshwalk.plot(mesh, "depth", cmap="viridis_r", shading="gouraud")\n'
            "ax.figure.colorbar(ax.collections[0], label=\"depth\")", "python"),
    Picture("explain.png", "Why this triangle?",
            "`explain` draws the walk, the triangle, and the triangles of a tie.",
            'mesh = meshwalk.read("data/trap.off")\n'
            "meshwalk.explain(meshwalk.Locator(mesh), 0.503, 0.497)", "python"),
    Picture("segment.png", "The triangles along a line",
            "In order and exactly, with where each piece begins and ends.",
            'mesh = meshwalk.read("bay.ply")\n'
            "a, b = (-95, -20), (95, 30)\n"
            "pieces = meshwalk.Locator(mesh).segment(a, b)\n"
            "along = np.full(len(mesh.triangles), np.nan)\n"
            "found = pieces.triangle >= 0\n"
            "along[pieces.triangle[found]] = np.flatnonzero(found)\n"
            'ax = meshwalk.plot(mesh, color="0.8", linewidth=0.4)\n'
            "ax.tripcolor(*mesh.points[:, :2].T, mesh.triangles, facecolors=along)\n"
            'ax.plot(*zip(a, b), "k", linewidth=1)', "python"),
    Picture("contours.png", "Contours",
            "Exact lines of equal height, each closed or from border to border.",
            "subprocess.run(\n"
            '    ["meshwalk", "contours", "terrain.ply", "--interval", "50", "-o", "lines.csv"],\n'
            "    check=True,\n"
            ")\n"
            'rows = np.genfromtxt("lines.csv", delimiter=",", names=True)\n'
            'ends = np.flatnonzero(np.diff(rows["line"])) + 1\n'
            'colours = plt.cm.viridis((rows["elevation"] - 150) / 900)\n'
            'plt.gca().set_aspect("equal")\n'
            "for part in np.split(np.arange(len(rows)), ends):\n"
            '    plt.plot(rows["x"][part], rows["y"][part], color=colours[part[0]], linewidth=0.6)',
            "python"),
    Picture("profile.png", "A profile",
            "The heights along a line: a row for every edge that it crosses, so nothing is left "
            "out.",
            'Path("line.csv").write_text("x,y\\n2000,2000\\n28000,26000\\n")\n'
            "subprocess.run(\n"
            '    ["meshwalk", "profile", "terrain.ply", "line.csv", "-o", "profile.csv"],\n'
            "    check=True,\n"
            ")\n"
            'rows = np.genfromtxt("profile.csv", delimiter=",", names=True)\n'
            "plt.figure(figsize=(8, 3))\n"
            'plt.fill_between(rows["chainage"], rows["z"], 100)\n'
            'plt.xlabel("distance, m")\n'
            'plt.ylabel("height, m")', "python"),
]  # fmt: skip


def _draw(picture: Picture) -> None:
    """Run what makes a picture, here."""
    if picture.language == "sh":
        subprocess.run(["sh", "-eu"], input=picture.source, text=True, check=True)
        return
    import matplotlib.pyplot as plt
    import numpy as np

    import meshwalk

    names = {"np": np, "plt": plt, "meshwalk": meshwalk, "subprocess": subprocess, "Path": Path}
    exec(compile(picture.source, picture.file, "exec"), names)
    plt.savefig(picture.file, dpi=120, bbox_inches="tight")
    plt.close("all")


def make(pages: Pages, program: str) -> str:
    """Make the page and its pictures."""
    import matplotlib as mpl

    mpl.use("agg")
    folder = pages.out / "gallery"
    work = pages.out / "samples"
    folder.mkdir(parents=True)
    work.mkdir()
    shutil.copytree(Path(__file__).parents[2] / "data", work / "data")
    samples.main(work)
    tools = [str(Path(program).parent), str(Path(program).parents[1] / "examples")]
    os.environ["PATH"] = os.pathsep.join([*tools, os.environ["PATH"]])
    text = "# Gallery\n\nEach picture is made by the commands below it when the site is built. "
    text += "The meshes are those of the [playground](../playground/index.md).\n"
    with contextlib.chdir(work):
        for picture in PICTURES:
            _draw(picture)
            shutil.copyfile(picture.file, folder / picture.file)
            text += (
                f"\n## {picture.title}\n\n{picture.about}\n\n![{picture.title}]({picture.file})\n"
            )
            text += f"\n```{picture.language}\n{picture.source}\n```\n"
    pages.write("gallery/index.md", text)
    return "gallery/index.md"
