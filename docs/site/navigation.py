"""The list of pages at the left of each page.

Sphinx would copy the outline of every page, with each function of the references, for every page
that it writes, only to drop all but the titles: two thirds of the time of the whole site.
"""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any

from sphinx import addnodes

if TYPE_CHECKING:
    from sphinx.application import Sphinx


def _entry(app: Sphinx, name: str, page: str, level: int) -> tuple[str, bool]:
    """Return the entry of a page with those below it, and whether `page` is among them."""
    below = [
        _entry(app, child, page, level + 1) for child in app.env.toctree_includes.get(name, [])
    ]
    here = name == page
    current = here or any(found for _, found in below)
    mark = " current" if current else ""
    address = "#" if here else app.builder.get_relative_uri(page, name)
    title = html.escape(app.env.titles[name].astext())
    children = f"<ul>{''.join(text for text, _ in below)}</ul>" if below else ""
    return (
        f'<li class="toctree-l{level}{mark}"><a class="reference internal{mark * here}" '
        f'href="{address}">{title}</a>{children}</li>',
        current,
    )


def _list(app: Sphinx, page: str) -> str:
    text = ""
    for tree in app.env.get_doctree(app.config.root_doc).findall(addnodes.toctree):
        caption = html.escape(tree["caption"])
        text += f'<p class="caption" role="heading"><span class="caption-text">{caption}</span></p>'
        entries = (_entry(app, name, page, 1)[0] for _, name in tree["entries"])
        text += f"<ul>{''.join(entries)}</ul>"
    return text


def _replace(app: Sphinx, page: str, _: str, context: dict[str, Any], __: object) -> None:
    context["toctree"] = lambda **_: _list(app, page)


def setup(app: Sphinx) -> dict[str, bool]:
    """Tell Sphinx about it, before the theme asks for the list."""
    app.connect("html-page-context", _replace, priority=100)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
