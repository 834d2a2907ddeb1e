// here_panel.js - what lies under the mouse or was clicked: triangle, weights, values, ties.

const TIE_WORDS = { edge: "on an edge", vertex: "at a vertex", inside: "inside a triangle",
  outside: "outside the mesh", hole: "in a hole", near: "near the mesh", bad: "nowhere" };
const TIES_SHOWN = 12;
const NEAR = 6; // pixels

class HerePanel {
  constructor(app) {
    this.app = app;
    byId("here-form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.showTyped();
    });
    this.clear();
  }

  clear() {
    this.point = null;
    this.ties = [];
    this.location = null;
    this.kept = false;
    byId("here").innerHTML = "<p>Move over the mesh, or tap it.</p>";
  }

  /** Tell what is at a place of the screen; `keep`: until the next click. */
  show(screen, keep) {
    if (this.kept && !keep) return;
    const { app } = this;
    this.kept = keep && !(this.kept && this.sameAs(screen));
    if (app.stage.space === "space") this.showSpace(screen);
    else if (keep) this.showPoint(this.snapped(app.stage.camera.toMesh(screen)));
    else this.showPoint(app.stage.camera.toMesh(screen));
    app.stage.drawOverlay();
  }

  sameAs(screen) {
    if (!this.point) return false;
    const at = this.app.stage.camera.toScreen(this.point);
    return Math.hypot(at[0] - screen[0], at[1] - screen[1]) < 3;
  }

  leave() {
    if (this.kept) return;
    this.ties = [];
    this.app.stage.drawOverlay();
  }

  /** A click near a vertex means the vertex: its triangles are a tie. */
  snapped(point) {
    const { stage, topology } = this.app;
    const found = this.app.locate(point);
    if (!found || found.triangle === null) return point;
    const at = stage.camera.toScreen(point);
    const close = (other) => {
      const screen = stage.camera.toScreen(other);
      return Math.hypot(screen[0] - at[0], screen[1] - at[1]) < NEAR;
    };
    const corner = topology.corners(found.triangle).find(close);
    return corner ? [corner[0], corner[1]] : point;
  }

  /** The point in the field. */
  showTyped() {
    const point = parsePoint(byId("here-at").value);
    this.app.complain(point ? "" : "A point is two numbers: x, y");
    if (!point) return;
    this.kept = true;
    this.showPoint(point);
    this.app.stage.drawOverlay();
  }

  showPoint(point) {
    const { app } = this;
    const found = app.locate(point);
    this.point = point;
    this.location = found;
    this.ties = found ? app.topology.tie(found) : [];
    const rows = [["x, y", point.map((value) => Number(value.toPrecision(9))).join(", ")]];
    if (found) rows.push(...this.locationRows(found));
    else rows.push(["answer", "none: the mesh has a defect"]);
    this.fill(rows);
  }

  locationRows(found) {
    const rows = [["status", `${found.where}: ${TIE_WORDS[found.where]}`]];
    if (found.hole !== null) rows.push(["hole", found.hole]);
    if (found.triangle === null) return rows;
    rows.push(["triangle", found.triangle]);
    if (this.ties.length > 1) rows.push(["tie of", this.tieText()]);
    rows.push(["vertices", this.cornersText(found.triangle)]);
    rows.push(["weights", found.weights.map((weight) => readable(weight, 5)).join("  ")]);
    return rows.concat(this.valueRows(found));
  }

  tieText() {
    const shown = this.ties.slice(0, TIES_SHOWN).join(", ");
    const more = this.ties.length - TIES_SHOWN;
    return `${shown}${more > 0 ? ` and ${more} more` : ""}: the lowest wins`;
  }

  cornersText(triangle) {
    return [0, 1, 2].map((k) => this.app.topology.corner(triangle, k)).join(", ");
  }

  valueRows({ triangle, weights }) {
    const { app } = this;
    const corners = [0, 1, 2].map((k) => app.topology.corner(triangle, k));
    const mixed = (value) => corners.reduce((sum, v, k) =>
      sum + (weights[k] ? weights[k] * value(v) : 0), 0);
    const rows = [];
    if (app.mesh.hasHeights) rows.push(["z", readable(mixed((v) => app.topology.at(v)[2]))]);
    for (const name of app.mesh.fieldNames.slice(0, 8)) {
      const values = app.mesh.field(name);
      rows.push([name, readable(mixed((v) => values[v]))]);
    }
    for (const name of app.mesh.triangleFieldNames.slice(0, 8))
      rows.push([name, readable(app.mesh.triangleField(name)[triangle])]);
    return rows;
  }

  showSpace(screen) {
    const { stage } = this.app;
    const [x, y] = screen.map((value) => Math.floor(value * stage.ratio));
    const triangle = stage.picture.triangleAt(x, y);
    this.point = null;
    this.ties = triangle === null ? [] : [triangle];
    if (triangle === null) this.fill([["status", "beside the mesh"]]);
    else this.fill([["triangle", triangle], ["vertices", this.cornersText(triangle)],
      ...this.valueRows({ triangle, weights: [1 / 3, 1 / 3, 1 / 3] }).map(([name, value]) =>
        [`${name}, middle`, value])]);
  }

  fill(rows) {
    const table = document.createElement("table");
    fillTable(table, rows);
    byId("here").replaceChildren(table);
  }

  draw(pen) {
    if (!this.ties.length) return;
    const accent = styleText("--accent");
    if (this.ties.length > 1)
      pen.triangles(this.ties, { fill: accent, alpha: 0.22 });
    pen.triangles(this.ties.slice(0, 1), { stroke: accent, width: 2.5 });
    if (this.point && this.kept) pen.dot(this.point, accent);
  }
}
