// words.js - texts: what a defect is and what to do, numbers for people, elements by their name.

const DEFECT_WORDS = {
  "not-finite": ["A corner has no place", "A coordinate of this vertex is NaN or infinite. The " +
    "program that wrote the file marked a missing value, or divided by zero."],
  "repeated-vertex": ["One vertex twice", "A triangle names one vertex at two of its corners, so " +
    "it is a line. Dropping it changes nothing."],
  "edge-shared": ["An edge of three triangles", "In the plane an edge has at most two triangles. " +
    "Usually a triangle is in the file twice, or two sheets are glued along a line."],
  folded: ["A fold", "Two neighbours lie on the same side of their common edge: the mesh is " +
    "folded over there. Often a vertex lies on the wrong side of an edge."],
  turn: ["Too many turns round a vertex", "The triangles round this vertex turn by more than " +
    "once: the mesh winds round it like a spiral stair."],
  crossing: ["Borders cross", "Two border edges cut each other, so two parts of the mesh overlap " +
    "behind the crossing."],
  "vertex-in-edge": ["A vertex inside an edge", "A vertex lies on the edge of a larger triangle " +
    "without being a corner of it (a T-junction). Splitting that triangle mends it."],
  overlap: ["An overlap", "The mesh covers this place more than once, so a point there has no " +
    "single triangle. A part may be in the file twice."],
  flat: ["A flat triangle", "Its corners lie on a line. It contains no point and does no harm: " +
    "this is a remark."],
  clashing: ["Neighbours face opposite ways", "Two neighbours have opposite orientation: one of " +
    "them shows its back."],
  "through-centre": ["A facet seen edge-on", "Its plane passes through the centre, so no ray " +
    "from there meets it in one point."],
  turned: ["A facet that shows its back", "Seen from the centre it is turned the other way than " +
    "its neighbour: the polyhedron is not star-shaped about this centre."],
  covered: ["Covered", "A ray from the centre meets this facet and another one."],
  "open-edge": ["An open edge", "This edge has one triangle only, so the surface is not closed."],
};

/** Kinds that `meshwalk check --fix` mends, if not always. */
const MENDABLE = new Set(["not-finite", "repeated-vertex", "edge-shared", "vertex-in-edge",
  "overlap", "flat", "clashing"]);

/** What a defect is: { title, text }. */
function explainDefect(kind) {
  const [title, text] = DEFECT_WORDS[kind] || [kind, ""];
  return { title, text, mendable: MENDABLE.has(kind) };
}

function byId(id) {
  return document.getElementById(id);
}

/** A number with as many digits as people read. */
function readable(value, digits = 6) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return value.toLocaleString("en");
  return String(Number(value.toPrecision(digits)));
}

function plural(count, one, many = `${one}s`) {
  return `${count.toLocaleString("en")} ${count === 1 ? one : many}`;
}

/** Fill a table with rows of a name and a value. */
function fillTable(table, rows) {
  table.replaceChildren(...rows.map(([name, value, colour]) => {
    const row = document.createElement("tr");
    const head = document.createElement("th");
    const cell = document.createElement("td");
    head.scope = "row";
    head.textContent = name;
    cell.textContent = value;
    if (colour) {
      cell.className = "swatch";
      cell.style.setProperty("--swatch", colour);
    }
    row.append(head, cell);
    return row;
  }));
}

/** Save a text as a file, as the browser does with downloads. */
function saveText(name, text) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** A button with a text and what it does. */
function makeButton(text, act) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = text;
  button.addEventListener("click", () => act(button));
  return button;
}

/** "x, y" of a field, or "x, y, z"; null if it holds anything else. */
function parsePoint(text, count = 2) {
  const parts = text.trim().split(/[\s,;]+/).map(Number);
  return parts.length === count && parts.every(Number.isFinite) ? parts : null;
}
