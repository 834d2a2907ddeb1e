"""Lay out what Sphinx reads: stage.py PROGRAM PAGE OUT.

PROGRAM is the built program, PAGE the page of `meshwalk view` without a mesh. The pages of the
repository keep their paths, so that their links hold. Links to other files lead to the reference
made of them, or to a page that shows the file.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path

import charts
import gallery
import headers
import javascript
import manual
import playground
import python_api
from crosslinks import BIBLIOGRAPHY, citation_id

import notebooks

SOURCE = Path(__file__).resolve().parents[2]
LANGUAGES = {".c": "c", ".h": "c", ".def": "c", ".cpp": "cpp", ".py": "python", ".js": "js"}
LANGUAGES |= {".ts": "typescript", ".mjs": "js", ".txt": "text", ".json": "json"}


def tracked_files() -> list[Path]:
    """Return the files of the repository, relative to its root."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=SOURCE, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if listed.returncode == 0:
        found = [Path(line) for line in listed.stdout.splitlines()]
    else:  # an archive without its history
        found = [path.relative_to(SOURCE) for path in SOURCE.rglob("*") if path.is_file()]
    return sorted(path for path in found if path.parts[0] != "build" and (SOURCE / path).exists())


class Pages:
    """The pages of the repository, and the pages that their links ask for."""

    def __init__(self, out: Path) -> None:
        self.out = out
        self.files = tracked_files()
        self.shown: dict[str, str] = {}

    def write(self, path: str | Path, text: str) -> None:
        """Write one page below `out`."""
        target = self.out / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)

    def _reference(self, path: Path) -> str | None:
        """Return the page that describes a file, if one is made."""
        name = path.as_posix()
        if path.match("docs/man/*.1"):
            return f"reference/program/{path.stem}.md"
        if name == "include/meshwalk":
            return "reference/c/index.md"
        if path.match("include/meshwalk/*.h") and path.stem not in ("version", "meshwalk"):
            return f"reference/c/{path.stem}.rst"
        if path.suffix == ".ipynb":
            return f"notebooks/{path.stem}.md"
        if name in ("web/js", "web/js/meshwalk.d.ts"):
            return "reference/javascript.rst"
        return "index.md" if name == "README.md" else None

    def _show(self, path: Path) -> str:
        """Return a page that shows a file, or what a folder holds."""
        name = path.as_posix()
        page = f"files/{name}/index.rst" if (SOURCE / path).is_dir() else f"files/{name}.rst"
        if page not in self.shown:
            self.shown[page] = name
            if (SOURCE / path).is_dir():
                self._show_folder(path, page)
            else:
                self._show_file(path, page)
        return page

    def _show_file(self, path: Path, page: str) -> None:
        name = path.as_posix()
        target = self.out / "files" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(SOURCE / path, target)
        language = LANGUAGES.get(path.suffix, "text")
        title = f":orphan:\n\n{name}\n{'=' * len(name)}\n\n"
        self.write(page, f"{title}.. literalinclude:: {path.name}\n   :language: {language}\n")

    def _show_folder(self, path: Path, page: str) -> None:
        name = path.as_posix()
        lines = [":orphan:", "", name, "=" * len(name), ""]
        for file in self.files:
            if file.is_relative_to(path):
                shown, link = file.relative_to(path).as_posix(), self.page_of(file)
                target = "/" + re.sub(r"\.(md|rst)$", "", link or "")
                lines.append(f"- :doc:`{shown} <{target}>`" if link else f"- ``{shown}``")
        self.write(page, "\n".join(lines) + "\n")

    def page_of(self, path: Path, show: bool = False) -> str | None:
        """Return the page for a path of the repository; with `show` one is made if need be."""
        page = self._reference(path)
        if page is None and path.suffix == ".md":
            page = path.as_posix()
        shows = show or path.suffix in (".c", ".cpp") or path.match("examples/*.csv")
        return page or (self._show(path) if shows else None)

    def _link(self, folder: Path, match: re.Match[str]) -> str:
        target = match[1]
        file, _, anchor = target.partition("#")
        if re.match(r"[a-z]+:", target) or not file:
            return match.group(0)
        path = Path(*(folder / file).parts)
        while ".." in path.parts:
            first = path.parts.index("..")
            path = Path(*path.parts[: first - 1], *path.parts[first + 1 :])
        if path.suffix in (".png", ".svg"):
            (self.out / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(SOURCE / path, self.out / path)
            return match.group(0)
        page = self.page_of(path, show=True)
        return f"]({'../' * len(folder.parts)}{page}{anchor and '#' + anchor})"

    def markdown(self, path: Path) -> str:
        """Return a page of the repository as Sphinx is to read it."""
        fenced, lines = False, []
        for line in (SOURCE / path).read_text().splitlines():
            if re.match(r" *```", line):
                line = re.sub(r"```output$", "```text", line)
                fenced = not fenced
            elif not fenced:
                line = re.sub(r"\]\(([^) ]+)\)", partial(self._link, path.parent), line)
            lines.append(line)
        return charts.add(path.as_posix(), "\n".join(lines) + "\n")


def _bibliography(text: str) -> str:
    """Give each entry an anchor."""
    anchor = r'<span id="{}"></span>**{}**'
    return re.sub(r"\*\*([^*]+? \d{4})\*\*", lambda m: anchor.format(citation_id(m[1]), m[1]), text)


def _toctree(title: str, pages: list[str], depth: int = 1) -> str:
    entries = "\n".join(re.sub(r"\.(md|rst)$", "", page) for page in pages)
    return f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n:maxdepth: {depth}\n\n{entries}\n```\n"


def _sections() -> dict[str, list[str]]:
    """Return the pages that docs/README.md lists, by its headings in bold type."""
    found: dict[str, list[str]] = {}
    for line in (SOURCE / "docs/README.md").read_text().splitlines():
        heading = re.match(r"\*\*(.*?)\*\*", line)
        if heading:
            found[heading[1]] = []
        for link in re.findall(r"\]\(([^)#]+\.md)\)", line):
            path = (SOURCE / "docs" / link).resolve().relative_to(SOURCE).as_posix()
            if found and not any(path in pages for pages in found.values()):
                found[next(reversed(found))].append(path)
    return found


def _below(files: list[Path], path: Path) -> list[str]:
    """Return the pages in the folder that has the name of a page."""
    folder = path.with_suffix("")
    return [p.as_posix() for p in files if p.suffix == ".md" and p.parent == folder]


def _index(pages: Pages, made: dict[str, list[str]]) -> str:
    sections = _sections()
    listed = {page for group in sections.values() for page in group}
    listed.update(below for page in tuple(listed) for below in _below(pages.files, Path(page)))
    rest = [p.as_posix() for p in pages.files if p.suffix == ".md" and p.as_posix() not in listed]
    sections["Inside"] += [page for page in rest if page != "README.md"]
    text = pages.markdown(Path("README.md"))
    text += _toctree("Begin here", ["docs/README.md", *sections.pop("Begin here")])
    text += _toctree("See", made["see"])
    how_to = sections.pop("How to")
    text += _toctree("How to", how_to)
    reference = [page for page in sections.pop("Reference") if page != "CHANGELOG.md"]
    text += _toctree("Reference", [*reference, *made["reference"], "CHANGELOG.md"])
    for title, group in sections.items():
        text += _toctree(title, group)
    return text


def main(program: str, page: str, out: Path) -> None:
    """Make the folder `out`."""
    pages = Pages(out)
    for path in pages.files:
        if path.suffix == ".md" and path.as_posix() != "README.md":
            text = pages.markdown(path)
            if path.as_posix() == f"{BIBLIOGRAPHY}.md":
                text = _bibliography(text)
            below = [Path(page).relative_to(path.parent) for page in _below(pages.files, path)]
            if below:
                text += _toctree("Pages", [page.as_posix() for page in below])
            pages.write(path, text)
    made = {
        "see": [
            gallery.make(pages, program),
            playground.make(pages, program, page),
            *notebooks.make(pages, SOURCE),
        ],
        "reference": [
            *manual.make(pages, SOURCE / "docs/man"),
            *headers.make(pages, SOURCE / "include/meshwalk"),
            python_api.make(pages, SOURCE / "python/meshwalk"),
            javascript.make(pages, SOURCE / "web/js/meshwalk.d.ts"),
        ],
    }
    pages.write("index.md", _index(pages, made))
    here = Path(__file__).parent
    for name in ("conf.py", "crosslinks.py", "navigation.py"):
        shutil.copyfile(here / name, out / name)
    for name in ("site.css", "site.js"):
        pages.write(f"_static/{name}", (here / name).read_text())
    version = out / "files/include/meshwalk/version.h"
    version.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(SOURCE / "include/meshwalk/version.h", version)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]))
