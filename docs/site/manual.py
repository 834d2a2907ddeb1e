"""The manual pages of the program, as mandoc translates them."""

from __future__ import annotations

import re
import subprocess
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from stage import Pages


def _sections(html: str, known: set[str]) -> str:
    """Make headings of Sphinx of those of mandoc, and drop links to pages that are not ours."""
    body = re.search(r'<div class="manual-text">(.*)</div>\s*<table class="foot">', html, re.S)[1]
    body = re.sub(r"</?section[^>]*>", "", body)
    body = re.sub(
        r'<a class="Xr" href="([^"]+)\.html">(.*?)</a>',
        lambda match: match[0] if match[1] in known else match[2],
        body,
    )
    body = re.sub(r'<a class="permalink" href="#[^"]*">(.*?)</a>', r"\1", body, flags=re.S)
    text = ""
    parts = re.split(r'<h([12]) class="S[hs]" id="([^"]*)">(.*?)</h[12]>', body, flags=re.S)
    each = zip(parts[1::4], parts[2::4], parts[3::4], parts[4::4], strict=True)
    for level, anchor, heading, content in each:
        words = re.sub(r"<[^>]*>|\s+", " ", heading).strip()
        text += f"\n{'#' * (int(level) + 1)} {words.capitalize() if level == '1' else words}\n\n"
        text += f'`````{{raw}} html\n<div class="man" id="{anchor}">{content}</div>\n`````\n'
    return text


def make(pages: Pages, folder: Path) -> list[str]:
    """Make the page of each command, and their list."""
    manuals = sorted(folder.glob("*.1"))
    known = {path.stem for path in manuals}
    rows = []
    for path in manuals:
        html = subprocess.run(
            ["mandoc", "-T", "html", "-O", "fragment,man=%N.html", str(path)],
            check=True, capture_output=True, text=True,
        ).stdout  # fmt: skip
        pages.write(f"reference/program/{path.stem}.md", f"# {path.stem}\n{_sections(html, known)}")
        about = re.search(r"^\.Nd (.*)", path.read_text(), re.M)[1]
        rows.append(f"- [{path.stem}]({path.stem}.md): {about}")
    text = "# The program\n\nThe manual pages of `meshwalk` and its commands.\n\n"
    text += "\n".join(rows) + "\n\n```{toctree}\n:hidden:\n\n"
    text += "\n".join(path.stem for path in manuals) + "\n```\n"
    pages.write("reference/program/index.md", text)
    return ["reference/program/index.md"]
