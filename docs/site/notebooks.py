"""The notebooks as pages: they are run, and their pictures are kept."""

from __future__ import annotations

import contextlib
import io
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from stage import Pages


def _cell(source: str, names: dict[str, object], pictures: Path, label: str) -> str:
    """Run a cell; return its code, what it printed, and its pictures."""
    import matplotlib.pyplot as plt

    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(source, label, "exec"), names)
    text = f"```python\n{source}\n```\n\n"
    if printed.getvalue():
        text += f"```text\n{printed.getvalue()}```\n\n"
    for number in plt.get_fignums():
        name = f"{label}-{number}.png"
        plt.figure(number).savefig(pictures / name, dpi=120, bbox_inches="tight")
        text += f"![{label}, picture {number}]({name})\n\n"
    plt.close("all")
    return text


def make(pages: Pages, source: Path) -> list[str]:
    """Make a page of each notebook."""
    import matplotlib as mpl

    mpl.use("agg")
    folder = pages.out / "notebooks"
    folder.mkdir(parents=True, exist_ok=True)
    before = Path.cwd()
    os.chdir(source / "python/notebooks")  # whose cells name files from there
    made = []
    for path in sorted((source / "python/notebooks").glob("*.ipynb")):
        names: dict[str, object] = {}
        text = ""
        for number, cell in enumerate(json.loads(path.read_text())["cells"]):
            content = "".join(cell["source"])
            code = cell["cell_type"] == "code"
            label = f"{path.stem}-{number}"
            text += _cell(content, names, folder, label) if code else content + "\n\n"
        pages.write(f"notebooks/{path.stem}.md", text)
        made.append(f"notebooks/{path.stem}.md")
    os.chdir(before)
    return made
