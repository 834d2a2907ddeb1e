"""The Python reference: a page for each file of the package, by its docstrings."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from stage import Pages


def _directive(name: str) -> str:
    import meshwalk

    thing = getattr(meshwalk, name)
    if not callable(thing):
        return f".. autodata:: meshwalk.{name}\n   :no-value:\n"
    if not isinstance(thing, type):
        return f".. autofunction:: meshwalk.{name}\n"
    if issubclass(thing, BaseException):
        return f".. autoexception:: meshwalk.{name}\n   :members:\n"
    own = "int, tuple, object"  # what these have is not ours to describe
    return f".. autoclass:: meshwalk.{name}\n   :members:\n   :inherited-members: {own}\n"


def make(pages: Pages, package: Path) -> str:
    """Make the pages, and return their list."""
    import meshwalk

    tree = ast.parse((package / "__init__.py").read_text())
    groups: dict[str, list[str]] = {}
    files: dict[str, Path] = {}
    for node in ast.walk(tree):  # some are there for type checkers only
        if isinstance(node, ast.ImportFrom):
            names = [a.name for a in node.names if a.name in dir(meshwalk)]
            if names:
                module = node.module.removeprefix("meshwalk.")
                group = module.rpartition(".")[2].removeprefix("_")
                groups.setdefault(group, []).extend(names)
                files[group] = package / (module.replace(".", "/") + ".py")
    rows = []
    for group, names in groups.items():
        source = files[group].read_text() if group != "core" else None
        about = ast.get_docstring(ast.parse(source)) if source else "One answer."
        title = about.partition("\n")[0].rstrip(".")
        body = "\n".join(_directive(name) for name in names)
        heading = f"{title}\n{'=' * len(title)}\n\n.. currentmodule:: meshwalk\n\n"
        pages.write(f"reference/python/{group}.rst", heading + body)
        rows.append(f"- [{title}]({group}.rst): " + ", ".join(f"`{name}`" for name in names))
    text = (
        "# The Python module\n\nBegin at [its page](../../python/README.md). `import meshwalk`:\n\n"
    )
    text += "\n".join(rows) + "\n\n```{toctree}\n:hidden:\n\n" + "\n".join(groups) + "\n```\n"
    pages.write("reference/python/index.md", text)
    return "reference/python/index.md"
