"""The playground: the page of `meshwalk view`, empty and with sample meshes."""

from __future__ import annotations

import html
import shutil
import subprocess
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from stage import Pages


class Sample(NamedTuple):
    """A mesh, how it is taken, and a picture of it in the gallery."""

    name: str
    title: str
    about: str
    mesh: str
    options: tuple[str, ...] = ()
    picture: str = ""


SAMPLES = [
    Sample("trap", "A trap",
           "Lawson's walk goes round in a ring here, and the celestial walk does not: press "
           "Race all.", "data/trap.off", ("--points", "data/trap.csv"), "lawson.svg"),
    Sample("broken", "A mesh with defects", "Find the fold, the overlap, and the corner inside an "
           "edge: the list of defects leads there.", "broken.off", (), "broken.png"),
    Sample("terrain", "A terrain", "Heights of 39,639 triangles: hillshade, profiles.",
           "terrain.ply", (), "jacksboro.png"),
    Sample("bay", "A bay with islands", "Holes, borders and depths.", "bay.ply", (), "depths.png"),
    Sample("globe", "A globe", "Walks from ray to ray out of the centre.", "globe.off",
           ("--as", "star"), "globe.svg"),
    Sample("torus", "A ring", "Probes along the line of sight.", "torus.off",
           ("--as", "surface"), "probe.svg"),
]  # fmt: skip


def _picture_of_broken(pages: Pages) -> None:
    """Draw the mesh with defects, which the program does not draw."""
    import matplotlib.pyplot as plt
    import samples

    import meshwalk

    points, triangles = samples.broken()
    plt.figure(figsize=(6, 4.5))
    plt.gca().set_aspect("equal")
    plt.triplot(*points.T, triangles, linewidth=0.5, color="0.6")
    defects = meshwalk.check(points, triangles).defects
    bad = sorted({defect.triangle for defect in defects if defect.triangle is not None})
    plt.tripcolor(*points.T, triangles[bad], facecolors=bad, cmap="autumn")
    plt.axis("off")
    plt.savefig(pages.out / "gallery/broken.png", dpi=100, bbox_inches="tight")
    plt.close("all")


def make(pages: Pages, program: str, page: str) -> str:
    """Make the pages of the samples, and the page that leads to them."""
    folder = pages.out / "_extra/playground"
    folder.mkdir(parents=True)
    pictures = pages.out / "_static/playground"
    pictures.mkdir(parents=True)
    _picture_of_broken(pages)
    shutil.copyfile(page, folder / "empty.html")
    cards = ""
    for sample in SAMPLES:
        subprocess.run(
            [program, "view", "-q", sample.mesh, *sample.options, "-o",
             str(folder / f"{sample.name}.html")],
            cwd=pages.out / "samples", check=True,
        )  # fmt: skip
        shutil.copyfile(pages.out / "gallery" / sample.picture, pictures / sample.picture)
        cards += (
            f'<a class="card" href="{sample.name}.html">'
            f'<img alt="" loading="lazy" src="../_static/playground/{sample.picture}">'
            f"<b>{html.escape(sample.title)}</b><span>{html.escape(sample.about)}</span></a>\n"
        )
    text = (
        "# Playground\n\nThe page of `meshwalk view`, with a mesh to begin with. It runs in your "
        "browser, and nothing leaves it. Press `?` there for the keys.\n\n"
        f'```{{raw}} html\n<div class="cards">\n{cards}</div>\n```\n\n## Your own mesh\n\n'
        "```{raw} html\n"
        '<p><a href="empty.html"><b>Open the empty page</b></a>, and drop a file on it: OFF, PLY, '
        "OBJ, STL, <code>.node</code> and <code>.ele</code>, <code>fort.14</code>, VTK and others, "
        "packed or not.</p>\n```\n\n[In a browser](../docs/web.md) tells what the page can do.\n"
    )
    pages.write("playground/index.md", text)
    return "playground/index.md"
