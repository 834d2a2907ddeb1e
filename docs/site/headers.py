"""The C reference: Doxygen reads the public headers, Breathe lays them out."""

from __future__ import annotations

import re
import subprocess
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from stage import Pages

_DOXYFILE = """
INPUT = headers
FILE_PATTERNS = *.h
OUTPUT_DIRECTORY = .
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
OPTIMIZE_OUTPUT_FOR_C = YES
SORT_MEMBER_DOCS = NO
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = MW_API= "__attribute__(x)="
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_IF_INCOMPLETE_DOC = NO
"""


def _entries(folder: Path, match: re.Match[str]) -> str:
    """Write out the values that a list (`walks.def`) makes, which Doxygen cannot follow."""
    prefix, name = match.groups()
    text = re.sub(r"/\*.*?\*/", "", (folder / name).read_text(), flags=re.S)
    values = []
    for arguments in re.findall(r"^MW_\w+_ENTRY\((.*?)\)$", text, re.S | re.M):
        words = re.findall(r'"([^"]*)"', arguments)
        number = re.match(r"\w+", arguments)[0]
        values.append(f"{prefix}{number}, /**< `{words[0]}`: {words[-1]} ({words[1]}) */")
    return "\n".join(values)


def _plain(folder: Path, text: str) -> str:
    """Return a header as Doxygen and Sphinx's C domain understand it.

    No lists of values from other files, no type declared twice (`typedef struct x {} x`), one
    parameter at a time.
    """
    entry = r"#define MW_\w+_ENTRY\(.*\) (\w+)##id,\n#include <meshwalk/(\w+\.def)>"
    text = re.sub(entry, lambda match: _entries(folder, match), text)
    text = re.sub(r"^typedef ((?:struct|enum|union) \w+ \{)", r"\1", text, flags=re.M)
    text = re.sub(r"\} mw_\w+;", "};", text)
    return re.sub(r"@param (\w+(?:, \w+)+)((?:.*\n \* (?!@))*.*)", _parameters, text)


def _parameters(match: re.Match[str]) -> str:
    """Give each parameter of a list the text of all."""
    return "\n * ".join(f"@param {name}{match[2]}" for name in match[1].split(", "))


def make(pages: Pages, folder: Path) -> list[str]:
    """Make a page for each header, and their list."""
    work = pages.out / "doxygen"
    (work / "headers").mkdir(parents=True)
    rows, names = [], []
    for name in re.findall(r"<meshwalk/(\w+)\.h>", (folder / "meshwalk.h").read_text()):
        text = (folder / f"{name}.h").read_text()
        about = re.search(r"@file \w+\.h\s*\n \* (.*?)(?:\.|\n \*\n)", text, re.S)
        if not about:
            continue
        (work / "headers" / f"{name}.h").write_text(_plain(folder, text))
        title = f"{name}.h"
        pages.write(
            f"reference/c/{name}.rst",
            f"{title}\n{'=' * len(title)}\n\n"
            f".. code-block:: c\n\n   #include <meshwalk/{title}>\n\n"
            f".. doxygenfile:: {title}\n   :sections: detaileddescription define enum typedef "
            "innerclass func var\n",
        )
        names.append(name)
        rows.append(f"- [{title}]({name}.rst): " + re.sub(r"\s*\n \*\s*", " ", about[1]))
    (work / "Doxyfile").write_text(_DOXYFILE)
    subprocess.run(["doxygen"], cwd=work, check=True)
    text = "# The C library\n\n`#include <meshwalk/meshwalk.h>` brings all of these headers.\n\n"
    text += "\n".join(rows) + "\n\n```{toctree}\n:hidden:\n\n" + "\n".join(names) + "\n```\n"
    pages.write("reference/c/index.md", text)
    return ["reference/c/index.md"]
