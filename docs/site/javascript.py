"""The JavaScript reference, made of web/js/meshwalk.d.ts."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from stage import Pages

_TITLE = "The JavaScript interface"


def _comment(text: str) -> str:
    """Return the text of a comment as reStructuredText."""
    text = re.sub(r"^\s*\*?/?\**", "", text.strip()[3:-2], flags=re.M)
    return re.sub(r"\s+", " ", text.replace("`", "``")).strip()


def _statements(text: str) -> list[tuple[str, str]]:
    """Return the declarations of a text, each with the comment before it."""
    found, comment, start, depth, at = [], "", 0, 0, 0
    while at < len(text):
        if depth == 0 and text.startswith(("//", "/*"), at):
            line = text.startswith("//", at)
            end = text.index("\n", at) if line else text.index("*/", at) + 2
            if not line:
                comment = _comment(text[at:end])
            at = start = end
            continue
        depth += (text[at] in "{([") - (text[at] in "})]")
        block = text[at] == "}" and re.match(r"\s*export (class|interface)", text[start:at])
        if depth == 0 and (text[at] == ";" or block):
            found.append((re.sub(r"\s+", " ", text[start:at]).strip(" ;") if not block
                          else text[start:at].strip(), comment))  # fmt: skip
            comment, start = "", at + 1
        at += 1
    return found


def _names(arguments: str) -> str:
    """Return the names of arguments, optional ones in brackets."""
    depth, parts = 0, [""]
    for letter in arguments:
        depth += (letter in "{([<") - (letter in "})]>")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    names = [part.partition(":")[0].strip() for part in parts if part.strip()]
    needed = [name for name in names if not name.endswith("?")]
    others = [name[:-1] for name in names if name.endswith("?")]
    return ", ".join(needed) + "".join(f"[, {name}" for name in others) + "]" * len(others)


def _entry(kind: str, name: str, declared: str, about: str, indent: str) -> str:
    code = re.sub(r"^(export|declare) ", "", declared)
    text = f"{indent}.. js:{kind}:: {name}\n\n"
    text += f"{indent}   .. code-block:: typescript\n\n{indent}      {code}\n\n"
    return text + (f"{indent}   {about}\n\n" if about else "")


def _member(declared: str, about: str) -> str:
    words = re.sub(r"^(static |readonly )+", "", declared)
    call = re.match(r"(\w+)\((.*)\): (.*)$", words) or re.match(r"(constructor)\((.*)\)()$", words)
    if call:
        return _entry("method", f"{call[1]}({_names(call[2])})", declared, about, "   ")
    return _entry("attribute", re.match(r"\w+", words)[0], declared, about, "   ")


def _thing(declared: str, about: str) -> str:
    block = re.match(r"export (?:class|interface) (\w+)( extends \w+)? \{(.*)$", declared, re.S)
    if block:
        text = f".. js:class:: {block[1]}\n\n" + (f"   {about}\n\n" if about else "")
        return text + "".join(_member(*member) for member in _statements(block[3]))
    call = re.match(r"export function (\w+)\((.*)\): (.*)$", declared)
    if call:
        return _entry("function", f"{call[1]}({_names(call[2])})", declared, about, "")
    return _entry(
        "data", re.match(r"export (?:type|const) (\w+)", declared)[1], declared, about, ""
    )


def make(pages: Pages, declarations: Path) -> str:
    """Make the page."""
    text = declarations.read_text()
    opening = re.match(r"(//.*\n)+", text)[0]
    text = text[len(opening) :]
    prose = re.sub(r"^// ?", "", opening, flags=re.M).split("\n\n")
    page = f"{_TITLE}\n{'=' * len(_TITLE)}\n\n:doc:`In a browser </docs/web>` shows how to begin.\n"
    for paragraph in prose[1:]:
        code = paragraph.startswith("  ")
        page += ("\n.. code-block:: js\n\n" + paragraph if code else "\n" + paragraph) + "\n"
    page += "\n" + "".join(_thing(*thing) for thing in _statements(text))
    pages.write("reference/javascript.rst", page)
    return "reference/javascript.rst"
