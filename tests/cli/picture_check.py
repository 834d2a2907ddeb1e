"""Check the picture of one walk, an SVG: picture_check.py SVG MESH LIST VIEW FROM TO [CENTRE]

MESH is OFF, LIST what `meshwalk walk` lists, VIEW plane, star or surface; FROM, TO and CENTRE are
X,Y[,Z]. Where the eye is follows from the walk; then every triangle has its place on the page, its
turn and its colour.
"""

import math
import re
import sys

GREEN, VERMILION, WHITE = (0, 62, 45), (84, 37, 0), (100, 100, 100)


def inner(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def outer(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def unit(a):
    return [x / math.sqrt(inner(a, a)) for x in a]


def read_off(name):
    words = open(name).read().split()
    points, triangles = int(words[1]), int(words[2])
    numbers = words[4:]
    at = [[float(x) for x in numbers[3 * i : 3 * i + 3]] for i in range(points)]
    rest = [int(x) for x in numbers[3 * points :]]
    return at, [rest[4 * i + 1 : 4 * i + 4] for i in range(triangles)]


def read_svg(name):
    """The size of the page, and paths as (style, commands, points) without those of letters."""
    text = open(name).read()
    size = [float(x) for x in re.search(r'viewBox="0 0 (\S+) (\S+)"', text).groups()]
    text = re.sub(r"(?s)<defs>.*?</defs>", "", text)
    paths = []
    for style, way in re.findall(r'<path style="([^"]*)" d="([^"]*)"', text):
        numbers = [float(x) for x in re.findall(r"-?[\d.]+", way)]
        points = list(zip(numbers[::2], numbers[1::2]))
        paths.append((style, re.sub(r"[^A-Z]", "", way), points))
    return size, paths


def colour_of(style, what):
    found = re.search(rf"(?:^|;| ){what}:rgb\(([\d.]+)%,([\d.]+)%,([\d.]+)%", style)
    return tuple(float(x) for x in found.groups()) if found else None


def axes_of(view, at, triangles, path, line, centre):
    """Right, up, and towards the eye."""
    if view == "plane":
        return [1, 0, 0], [0, 1, 0], [0, 0, 1]
    looks = []
    for t in path:
        corners = [at[v] for v in triangles[t]]
        if view == "star":
            looks.append(unit([sum(c[k] for c in corners) / 3 - centre[k] for k in range(3)]))
        else:
            looks.append(unit(outer(minus(corners[1], corners[0]), minus(corners[2], corners[0]))))
    total = [sum(look[k] for look in looks) for k in range(3)]
    if math.sqrt(inner(total, total)) < 0.3 * len(path):
        total = looks[-1]
    eye = unit(total)

    def up_of(eye):
        first = 2 if view == "star" else 1
        axis = first if abs(eye[first]) < 0.9 else 3 - first
        north = [float(k == axis) for k in range(3)]
        return unit([north[k] - eye[k] * eye[axis] for k in range(3)])

    if view == "surface" and abs(inner(unit(minus(line[1], line[0])), eye)) >= 0.85:
        up = up_of(eye)
        side = outer(up, eye)
        eye = unit([eye[k] + 0.55 * side[k] + 0.25 * up[k] for k in range(3)])
    up = up_of(eye)
    return outer(up, eye), up, eye


def box_of(points):
    return tuple([of(p[k] for p in points) for k in range(2)] for of in (min, max))


def box_side(box):
    return max(box[1][k] - box[0][k] for k in range(2))


def widen(box, margin):
    return [x - margin for x in box[0]], [x + margin for x in box[1]]


def shown_box(view, triangles, path, seen, line):
    """The walk, the ends of its line and what is near; all, where that is not much more."""
    whole = box_of([seen[v] for t in triangles for v in t])
    sides = [box_side(box_of([seen[v] for v in triangles[t]])) for t in path]
    points = [seen[v] for t in path for v in triangles[t]]
    for end in line:
        box = widen(whole, 2 * box_side(whole)) if view == "plane" else box_of(points)
        box = widen(box, box_side(box))
        if all(box[0][k] <= end[k] <= box[1][k] for k in range(2)):
            points.append(end)
    walk = box_of(points)
    near = widen(walk, max(0.12 * box_side(walk), 1.5 * sum(sides) / len(sides)))
    most = box_of([*walk, *whole])
    if box_side(near) > 0.6 * box_side(whole):
        return most
    return (
        [max(a, b) for a, b in zip(near[0], most[0])],
        [min(a, b) for a, b in zip(near[1], most[1])],
    )


def same_corners(corners, points):
    """Is it the triangle? One that is seen from its side has lost a corner."""

    def found(some, others):
        return all(any(abs(x - a) + abs(y - b) < 0.02 for a, b in others) for x, y in some)

    return found(points, corners) and (found(corners, points) or len(set(points)) < 3)


def main():
    svg, mesh, listed, view, *places = sys.argv[1:]
    line = [[*(float(x) for x in place.split(",")), 0.0][:3] for place in places[:2]]
    centre = [float(x) for x in (places[2] if len(places) > 2 else "0,0,0").split(",")]
    at, triangles = read_off(mesh)
    path = [int(row.split(",")[1]) for row in open(listed).read().split()[1:]]
    size, paths = read_svg(svg)
    axes = axes_of(view, at, triangles, path, line, centre)
    seen = [[inner(axis, p) for axis in axes] for p in at]

    # The page: what is shown fills the longer side, between margins.
    low, high = shown_box(
        view, triangles, path, seen, [[inner(axis, p) for axis in axes] for p in line]
    )
    side = max(high[k] - low[k] for k in range(2))
    frame = 0.02 * side
    scale = 720 / (side + 2 * frame)

    def page(p):
        return 14 + (p[0] - low[0] + frame) * scale, 14 + (high[1] + frame - p[1]) * scale

    height = 14 + (high[1] - low[1] + 2 * frame) * scale + 40
    assert abs(size[1] - height) < 0.01, ("height", size, height)
    width = 28 + (high[0] - low[0] + 2 * frame) * scale
    assert size[0] > width - 0.01 and (size[0] < width + 0.01 or width < 748), (
        "width",
        size,
        width,
    )

    # Triangles, in the order in which they are painted.
    visit = {t: i for i, t in reversed(list(enumerate(path)))}
    keys = []
    for t, v in enumerate(triangles):
        p = [page(seen[i]) for i in v]
        turn = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])
        back = view != "plane" and turn > 0  # on the page y goes down
        depth = sum(seen[i][2] for i in v) / 3 - (10 if back else 0)
        box = box_of(p)
        if box[1][0] < 14 or box[0][0] > width - 14 or box[1][1] < 14 or box[0][1] > height - 40:
            continue
        if t in visit or not back:
            keys.append((visit.get(t, -1) if view == "plane" else depth, t, p, back))
    keys.sort(key=lambda key: key[:2])
    painted = [path for path in paths if path[1] in ("MLLZM", "MLZM", "MLZ", "MLLZ")]
    assert len(painted) == len(keys), ("painted", len(painted), len(keys))
    between, places_taken = [], set()
    for i, (key, t, corners, back) in enumerate(keys):
        for place, (style, _, points) in enumerate(painted):
            if place not in places_taken and same_corners(corners, points):
                break
        else:
            raise AssertionError((t, corners))
        places_taken.add(place)
        # Equal depths may come in any order.
        assert sum(k[0] < key - 1e-6 for k in keys) <= place <= sum(k[0] < key + 1e-6 for k in keys)
        fill = colour_of(style, "fill")
        if t not in visit:
            assert fill is None if view == "plane" else fill == WHITE, (t, style)
        elif back:
            assert fill not in (GREEN, VERMILION, WHITE), (t, style)
        elif t == path[-1]:
            assert fill == VERMILION, (t, style)
        elif t == path[0]:
            assert fill == GREEN, (t, style)
        else:
            between.append((visit[t], fill))
        grey = colour_of(style, "stroke")
        assert grey == ((25, 25, 25) if t in visit and not back else (70, 70, 70)), (t, style)
    between.sort()
    if view == "plane" and len(between) > 2:  # darker along the way, in equal steps
        for k in range(3):
            steps = [a[1][k] - b[1][k] for a, b in zip(between, between[1:])]
            assert min(steps) > 0 and max(steps) - min(steps) < 0.01, (k, between)
            assert 3 <= between[-1][1][k] and between[0][1][k] <= 98, between

    # The ends of the line: a ring, then a disc.
    if view == "star":  # where rays meet the facets
        for i, facet in enumerate((triangles[path[0]], triangles[path[-1]])):
            corner = [at[v] for v in facet]
            n = outer(minus(corner[1], corner[0]), minus(corner[2], corner[0]))
            ray = minus(line[i], centre)
            share = inner(n, minus(corner[0], centre)) / inner(n, ray)
            line[i] = [centre[k] + share * ray[k] for k in range(3)]
    ends = [page([inner(axis, p) for axis in axes]) for p in line]
    inside = [0 <= x <= size[0] and 0 <= y <= height - 36 for x, y in ends]
    marks = [p for p in paths if p[1].startswith("MCC") and "stroke-width:1.1" in p[0]]
    assert len(marks) == sum(inside), ([path[0] for path in marks], ends)
    fills = []
    for (style, _, points), want in zip(marks, [end for end, seen in zip(ends, inside) if seen]):
        box = box_of(points)
        middle = [(box[0][k] + box[1][k]) / 2 for k in range(2)]
        assert abs(middle[0] - want[0]) + abs(middle[1] - want[1]) < 0.1, (middle, want)
        assert abs(box[1][0] - box[0][0] - 5) < 0.01, points
        fills.append(colour_of(style, "fill"))
    assert not all(inside) or fills[0] == WHITE != fills[1], fills

    # Triangles that are too small to show their colour have a ring of it.
    rings = [p for p in paths if p[1].startswith("MCC") and "stroke-width:2" in p[0]]
    for colour, t in ((GREEN, path[0]), (VERMILION, path[-1])):
        box = box_of([page(seen[v]) for v in triangles[t]])
        if min(box[1][k] - box[0][k] for k in range(2)) > 12:
            continue
        style, _, points = rings.pop(0)
        ring = box_of(points)
        assert colour_of(style, "stroke") == colour, style
        assert abs(ring[1][0] - ring[0][0] - 16) < 0.1, ring
        for k in range(2):
            assert abs(ring[0][k] + ring[1][k] - box[0][k] - box[1][k]) < 0.2, (ring, box)
    assert not rings, rings

    # The legend: samples of colours, side by side under the picture.
    legend = [path for path in paths if path[1] in ("MLLLZM", "MLLLZ")]
    assert [colour_of(p[0], "fill") for p in legend[:2]] == [GREEN, VERMILION], legend
    assert all(abs(p[2][0][1] - legend[0][2][0][1]) < 0.01 for p in legend)
    left = [p[2][0][0] for p in legend]
    assert left[0] == 14 and all(a + 20 < b for a, b in zip(left, left[1:])), left


main()
