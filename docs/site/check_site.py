"""Is the site whole? check_site.py FOLDER.

Every link leads to a file and an anchor in the folder, and no page loads anything from elsewhere.
"""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlparse


class _Page(HTMLParser):
    """The anchors of one page, what it links to, and what it loads."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.loads: list[str] = []
        self.feed(path.read_text())

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        found = {name: value or "" for name, value in attributes}
        self.anchors |= {found[name] for name in ("id", "name") if name in found}
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
        loads = found.get("src") or (found.get("href") if tag == "link" else None)
        if loads:
            self.loads.append(loads)


def _faults(folder: Path, path: Path, pages: dict[Path, _Page]) -> list[str]:
    found = []
    for link in pages[path].links + pages[path].loads:
        address, anchor = urldefrag(link)
        if urlparse(address).scheme in ("http", "https", "mailto", "data", "javascript"):
            if link in pages[path].loads and not address.startswith("data:"):
                found.append(f"loads {link} from elsewhere")
            continue
        name = unquote(urlparse(address).path)
        target = (path.parent / name).resolve() if name else path
        if not target.is_relative_to(folder) or not target.is_file():
            found.append(f"no file {link}")
        elif anchor and target in pages and unquote(anchor) not in pages[target].anchors:
            found.append(f"no anchor {link}")
    return found


def main(folder: Path) -> int:
    """Print every fault."""
    pages = {path: _Page(path) for path in sorted(folder.rglob("*.html"))}
    faults = 0
    for path in pages:
        for fault in _faults(folder, path, pages):
            print(f"{path.relative_to(folder)}: {fault}")
            faults += 1
    links = sum(len(page.links) for page in pages.values())
    print(f"{len(pages)} pages, {links} links, {faults} faults")
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
