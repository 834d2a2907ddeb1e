"""Plots of the tables of measurements, as SVG that follows the colours of the page.

Each plot reads its table in the page at the time the site is built, so the two cannot disagree.
"""

from __future__ import annotations

import html
import itertools
import math
import re
from dataclasses import dataclass, field

_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8a8a8a")
_DASHES = ("", "7 3", "2 3", "9 3 2 3")
_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
_SIZE = re.compile(r"(?:(\d+) \* )?10\^(\d+)")


@dataclass
class Chart:
    """A plot of one table: the table whose first heading is `table` on a page."""

    page: str
    table: str
    title: str
    unit: str
    kind: str = "sizes"
    """`sizes`: a line a row, over the columns with a size; `rows`: a line a column, over the rows;
    `bars`: a bar for each row and column."""
    columns: list[str] = field(default_factory=list)
    number: int = 0
    """Of several numbers in a cell, which one."""


_PLACES = "docs/measurements/"
CHARTS = [
    Chart(_PLACES + "location.md", "`random`", "A query in random order", "ns a query"),
    Chart(_PLACES + "location.md", "`half-outside`", "Half of the points outside", "ns a query"),
    Chart(_PLACES + "location.md", "`total`", "From arrays to a million answers", "ns a query"),
    Chart(_PLACES + "location.md", "slivers", "Long thin triangles", "ns a query", "bars",
          ["`random`", "`dense`"]),
    Chart(_PLACES + "choices.md", "start", "Batches from each start", "ns a query", number=1),
    Chart(_PLACES + "choices.md", "walk", "Each walk in a million vertices", "ns a query", "bars",
          ["alone, 10^6", "batch, 10^6"]),
    Chart(_PLACES + "edits.md", "ns an edit, uniform: ours, CGAL's", "An edit, ours", "ns an edit"),
    Chart(_PLACES + "edits.md", "k", "k edits, then a thousand places", "ms", "rows",
          ["`meshwalk`, edits and places", "`meshwalk-anew`", "`embree`", "`geos`", "`boost`"]),
    Chart(_PLACES + "worst.md", "trap, vertices", "Traps, in a batch", "microseconds a query",
          "bars", ["in a batch: before", "now"]),
]  # fmt: skip


def _number(cell: str, which: int = 0) -> float | None:
    found = re.findall(r"\d[\d,]*(?:\.\d+)?", re.sub(r"\(.*?\)", "", cell))
    return float(found[which].rstrip(",").replace(",", "")) if len(found) > which else None


def _size(cell: str) -> float | None:
    power = _SIZE.search(cell)
    if power:
        return int(power[1] or 1) * 10.0 ** int(power[2])
    return _number(cell) if re.match(r"[\d,]+$", cell) else None


def _name(cell: str) -> str:
    text = re.sub(r"`|\*\*", "", cell).strip().replace(" * ", " · ")
    return re.sub(r"\^(\d+)", lambda power: power[1].translate(_SUPERSCRIPTS), text)


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def _series(chart: Chart, head: list[str], rows: list[list[str]]) -> dict[str, list]:
    """Return the points (size, value), or (row, value) of bars, of each line or column."""
    if chart.kind == "sizes":
        places = [(column, _size(cell)) for column, cell in enumerate(head[1:], 1) if _size(cell)]
        taken = {row[0]: [(size, _number(row[c], chart.number)) for c, size in places]
                 for row in rows}  # fmt: skip
    else:
        key = _name if chart.kind == "bars" else _size
        taken = {
            name: [(key(row[0]), _number(row[head.index(name)])) for row in rows]
            for name in chart.columns
        }
    return {
        _name(name): [point for point in points if None not in point and point[1] > 0]
        for name, points in taken.items()
    }


def _decades(values: list[float]) -> tuple[int, int]:
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


def _label(power: int) -> str:
    return f"{10.0**power:g}" if -3 <= power <= 3 else _name(f"10^{power}")


def _spread(wanted: list[float], gap: float) -> list[float]:
    """Move labels apart, down from the highest."""
    order = sorted(range(len(wanted)), key=wanted.__getitem__)
    placed = list(wanted)
    for before, after in itertools.pairwise(order):
        placed[after] = max(placed[after], placed[before] + gap)
    return placed


def _lines(series: dict[str, list]) -> tuple[list[str], int]:
    left, right, top, height = 52, 200, 12, max(220, 16 * len(series))
    width = 700 - left - right
    points = [point for line in series.values() for point in line]
    xs, ys = _decades([p[0] for p in points]), _decades([p[1] for p in points])

    def at(point: tuple[float, float]) -> tuple[float, float]:
        x = (math.log10(point[0]) - xs[0]) / (xs[1] - xs[0])
        y = (math.log10(point[1]) - ys[0]) / (ys[1] - ys[0])
        return left + x * width, top + (1 - y) * height

    parts = []
    for power in range(xs[0], xs[1] + 1):
        x = at((10.0**power, 1))[0]
        parts.append(f'<path class="grid" d="M{x:.1f} {top}v{height}"/>')
        parts.append(f'<text x="{x:.1f}" y="{top + height + 18}" text-anchor="middle">'
                     f"{_label(power)}</text>")  # fmt: skip
    for power in range(ys[0], ys[1] + 1):
        y = at((1, 10.0**power))[1]
        parts.append(f'<path class="grid" d="M{left} {y:.1f}h{width}"/>')
        parts.append(
            f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{_label(power)}</text>'
        )
    labels = _spread([at(line[-1])[1] for line in series.values()], 14)
    for number, ((name, line), label) in enumerate(zip(series.items(), labels, strict=True)):
        colour = _COLOURS[number % len(_COLOURS)]
        dash = _DASHES[number // len(_COLOURS) % len(_DASHES)]
        places = [at(point) for point in line]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        end = places[-1]
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2" '
                     f'stroke-dasharray="{dash}"/>')  # fmt: skip
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>' for x, y in places]
        parts.append(f'<path d="M{end[0] + 5:.1f} {end[1]:.1f}L{left + width + 14} {label:.1f}" '
                     f'stroke="{colour}" opacity="0.6"/>')  # fmt: skip
        parts.append(
            f'<text x="{left + width + 18}" y="{label + 4:.1f}">{html.escape(name)}</text>'
        )
    return parts, int(max(top + height + 28, max(labels) + 12))


def _bars(series: dict[str, list]) -> tuple[list[str], int]:
    left, width, bar = 210, 410, 15
    values = [value for points in series.values() for _, value in points]
    low, high = _decades(values)
    rows = list(dict.fromkeys(row for points in series.values() for row, _ in points))
    parts, y = [], 24
    bottom = y + len(rows) * (bar * len(series) + 8)
    for power in range(low, high + 1):
        x = left + (power - low) / (high - low) * width
        parts.append(f'<path class="grid" d="M{x:.1f} {y - 4}V{bottom}"/>')
        parts.append(f'<text x="{x:.1f}" y="14" text-anchor="middle">{_label(power)}</text>')
    for row in rows:
        middle = y + bar * len(series) / 2 + 4
        parts.append(
            f'<text x="{left - 8}" y="{middle:.1f}" text-anchor="end">{html.escape(row)}</text>'
        )
        for number, points in enumerate(series.values()):
            value = dict(points).get(row)
            if value is not None:
                length = (math.log10(value) - low) / (high - low) * width
                parts.append(f'<rect x="{left}" y="{y + 1}" width="{max(length, 1):.1f}" '
                             f'height="{bar - 2}" fill="{_COLOURS[number]}"/>')  # fmt: skip
                parts.append(f'<text x="{left + length + 5:.1f}" y="{y + 12}">{value:,g}</text>')
            y += bar
        y += 8
    for number, name in enumerate(series):
        x = left + number * 180
        parts.append(
            f'<rect x="{x}" y="{y + 4}" width="12" height="12" fill="{_COLOURS[number]}"/>'
        )
        parts.append(f'<text x="{x + 17}" y="{y + 14}">{html.escape(name)}</text>')
    return parts, y + 26


def _draw(chart: Chart, head: list[str], rows: list[list[str]]) -> str:
    series = {name: points for name, points in _series(chart, head, rows).items() if points}
    parts, height = _bars(series) if chart.kind == "bars" else _lines(series)
    over = {"sizes": " over the number of vertices", "rows": f" over {head[0]}", "bars": ""}
    title = html.escape(f"{chart.title}: {chart.unit}{over[chart.kind]}, on a logarithmic scale")
    picture = "".join(parts)
    return (
        f'\n```{{raw}} html\n<figure class="plot"><div><svg class="chart" role="img" '
        f'viewBox="0 0 700 {height}"><title>{title}</title>{picture}</svg></div>'
        f"<figcaption>{title}. Drawn from the table above.</figcaption></figure>\n```\n"
    )


def add(page: str, text: str) -> str:
    """Return a page with the plots of its tables, each below its table."""
    for chart in (chart for chart in CHARTS if chart.page == page):
        table = re.search(rf"^\| {re.escape(chart.table)} \|.*\n(\|.*\n)+", text, re.M)
        if not table:
            raise SystemExit(f"charts.py: {page} has no table that begins with {chart.table}")
        lines = table[0].splitlines()
        drawn = _draw(chart, _cells(lines[0]), [_cells(line) for line in lines[2:]])
        text = text[: table.end()] + drawn + text[table.end() :]
    return text
