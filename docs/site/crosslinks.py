"""Links that the pages do not have to write.

A name in code type leads to its reference: `mw_locate`, `Locator.locate`, `meshwalk check`,
`include/meshwalk/io.h`. A work in brackets, [Lawson 1977], leads to the bibliography. So the pages
stay plain Markdown.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from docutils import nodes
from sphinx.domains.c import CDomain

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sphinx.application import Sphinx

BIBLIOGRAPHY = "docs/bibliography"
_COMMAND = re.compile(r"meshwalk ([a-z]+)( .*)?$")
_HEADER = re.compile(r"(?:include/meshwalk/|meshwalk/)?([a-z_]+\.h)$")


class Headers(CDomain):
    """Sphinx's domain of C, but without parameters of functions among its names."""

    def get_objects(self) -> Iterator[tuple[str, str, str, str, str, int]]:
        """List what has a name that is worth a search."""
        return (thing for thing in super().get_objects() if thing[2] != "functionParam")


def citation_id(work: str) -> str:
    """Return the anchor of a work, such as "Lawson 1977", in the bibliography."""
    return "work-" + re.sub(r"[^a-z0-9]+", "-", work.lower()).strip("-")


def _targets(app: Sphinx) -> dict[str, dict[str, tuple[str, str]]]:
    """Page and anchor of each name, by language; of `a.B.c` also under `B.c` and, in C, `c`."""
    found: dict[str, dict[str, tuple[str, str]]] = {}
    for language in ("c", "py", "js"):
        names = found[language] = {}
        for name, _, _, page, anchor, _ in app.env.get_domain(language).get_objects():
            parts = name.split(".")
            for first in range(len(parts)):
                last = ".".join(parts[first:])
                if first == 0 or language == "c" or last[0].isupper():
                    names.setdefault(last, (page, anchor))
    return found


def _language(page: str) -> str:
    return "js" if page in ("docs/web", "reference/javascript") else "py"


def _find(app: Sphinx, page: str, text: str) -> tuple[str, str] | None:
    name = re.sub(r"\(.*\)$", "", text)
    command = _COMMAND.match(text)
    header = _HEADER.match(text)
    if re.match(r"(mw|MW)_\w+$", name):
        return app.targets["c"].get(name)
    if command:
        found = f"reference/program/meshwalk-{command.group(1)}"
        return (found, "") if found in app.env.all_docs else None
    if header:
        found = f"reference/c/{header.group(1)[:-2]}"
        return (found, "") if found in app.env.all_docs else None
    if re.match(r"\w+(\.\w+){0,2}$", name):
        names = app.targets[_language(page)]
        whole = f"meshwalk.{name}" if page.startswith(("python/", "reference/python/")) else name
        return names.get(name) or names.get(whole)
    return None


def _link(app: Sphinx, page: str, target: tuple[str, str], inside: nodes.Node) -> nodes.reference:
    uri = app.builder.get_relative_uri(page, target[0]) + (target[1] and f"#{target[1]}")
    return nodes.reference("", "", inside, refuri=uri, internal=True)


def _stands_alone(node: nodes.Node) -> bool:
    above: Any = node.parent
    while above is not None:
        if isinstance(above, (nodes.reference, nodes.title, nodes.literal, nodes.literal_block)):
            return False
        if above.tagname.startswith("desc_sig"):
            return False
        above = above.parent
    return True


def _link_names(app: Sphinx, tree: nodes.document, page: str) -> None:
    for node in list(tree.findall(nodes.literal)):
        target = _find(app, page, node.astext()) if _stands_alone(node) else None
        if target and target != (page, ""):
            node.replace_self(_link(app, page, target, node.deepcopy()))


def _link_works(app: Sphinx, tree: nodes.document, page: str) -> None:
    for node in list(tree.findall(nodes.Text)):
        if "[" not in node or not _stands_alone(node):
            continue
        parts: list[nodes.Node] = []
        for part in re.split(r"(\[[^\[\]]+\])", str(node)):
            anchor = part[:1] == "[" and next(
                (app.works[work] for work in app.works if part[1:-1].startswith(work)), None
            )
            text = nodes.Text(part)
            parts.append(_link(app, page, (BIBLIOGRAPHY, anchor), text) if anchor else text)
        if len(parts) > 1:
            node.parent.replace(node, parts)


def _resolve(app: Sphinx, tree: nodes.document, page: str) -> None:
    if not hasattr(app, "targets"):
        app.targets = _targets(app)
        text = (app.srcdir / f"{BIBLIOGRAPHY}.md").read_text()
        works = re.findall(r"\*\*([^*]+? \d{4})\*\*", text)
        app.works = {work: citation_id(work) for work in sorted(works, key=len, reverse=True)}
    _link_names(app, tree, page)
    if page != BIBLIOGRAPHY:
        _link_works(app, tree, page)


def setup(app: Sphinx) -> dict[str, bool]:
    """Tell Sphinx about it."""
    app.add_domain(Headers, override=True)
    app.connect("doctree-resolved", _resolve)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
