// profile_panel.js - values along a line: exact pieces, one for each triangle.

const CHART = { left: 46, right: 8, top: 8, bottom: 22 };

class ProfilePanel {
  constructor(app) {
    this.app = app;
    byId("profile-save").addEventListener("click", () =>
      saveText(`${byId("file-name").textContent}-profile.csv`, this.table()));
    this.clear();
  }

  clear() {
    this.from = this.to = null;
    byId("profile-chart").hidden = byId("profile-save").hidden = true;
    byId("profile-command").textContent = "";
  }

  click(point) {
    byId("profile-panel").open = true;
    if (!this.from || this.to) {
      this.clear();
      this.from = point;
      this.app.setHint("Now click the other end of the profile");
    } else {
      this.to = point;
      this.app.setHint("");
      this.app.attempt(() => this.make());
    }
    this.app.stage.drawOverlay();
  }

  /** The field to draw: that of the colours if it has a value at each vertex, else heights. */
  field() {
    const { field } = this.app.colours;
    if (field && !field.ofTriangles) return field;
    const { points } = this.app.topology;
    return { name: "z", values: { at: (v) => points[3 * v + 2] } };
  }

  make() {
    const { app } = this;
    const pieces = app.locatorFor("straight").segment(this.from, this.to);
    const { name, values } = this.field();
    const value = (v) => (values.at ? values.at(v) : values[v]);
    this.name = name;
    const length = this.length();
    this.rows = pieces.map(({ from, to, triangle }) => ({
      from: from * length, to: to * length, triangle,
      begin: this.valueAt(triangle, from, value), end: this.valueAt(triangle, to, value),
    }));
    this.tell(name, length, pieces.length);
    byId("profile-save").hidden = false;
    if (pieces.length) this.chart(name, length);
  }

  /** The profile as CSV: rows where the line begins, enters a triangle, leaves the mesh, or ends.
   * The triangle is that in which the line goes on, or -1, as in `meshwalk profile`. */
  table() {
    const length = this.length();
    const lines = [];
    const add = (at, value, triangle) => {
      const [x, y] = this.pointAt(at / length);
      lines.push([at, x, y, value, triangle].join());
    };
    let end = 0;
    let last = "";
    for (const { from, to, begin, end: value, triangle } of this.rows) {
      if (from > end) add(end, last, -1);
      add(from, begin, triangle);
      [end, last] = [to, value];
    }
    if (end < length) add(end, last, -1);
    add(length, end < length ? "" : last, -1);
    const name = /[",\n]/.test(this.name) ? `"${this.name.replaceAll('"', '""')}"` : this.name;
    return `chainage,x,y,${name},triangle\n${lines.join("\n")}\n`;
  }

  length() {
    return Math.hypot(this.to[0] - this.from[0], this.to[1] - this.from[1]);
  }

  pointAt(part) {
    if (part === 1) return this.to;
    return [0, 1].map((k) => this.from[k] + part * (this.to[k] - this.from[k]));
  }

  /** The linear function of a triangle at a parameter of the line. */
  valueAt(triangle, part, value) {
    const { topology } = this.app;
    const point = this.pointAt(part);
    const [a, b, c] = topology.corners(triangle);
    const area = topology.area(triangle);
    const cross = (p, q) =>
      (p[0] - point[0]) * (q[1] - point[1]) - (q[0] - point[0]) * (p[1] - point[1]);
    const weights = [cross(b, c) / area, cross(c, a) / area, cross(a, b) / area];
    return weights.reduce((sum, w, k) => sum + w * value(topology.corner(triangle, k)), 0);
  }

  tell(name, length, count) {
    const ends = [this.from, this.to].map((point) => point.join());
    const all = this.rows.flatMap((row) => [row.begin, row.end]);
    byId("profile-about").textContent = count
      ? `${name} along ${readable(length, 5)} through ${plural(count, "triangle")}: from ` +
        `${readable(Math.min(...all))} to ${readable(Math.max(...all))}.`
      : "The line is outside the mesh.";
    byId("profile-command").textContent = `The line: ${ends.join(" to ")}; ` +
      "'meshwalk profile' writes its points as a table.";
  }

  chart(name, length) {
    const canvas = byId("profile-chart");
    canvas.hidden = false;
    canvas.setAttribute("aria-label", byId("profile-about").textContent);
    const { ratio } = this.app.stage;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const [low, high] = valueRange(this.rows.flatMap((row) => [row.begin, row.end]));
    const x = (at) => CHART.left + (at / length) * (width - CHART.left - CHART.right);
    const y = (value) => height - CHART.bottom -
      ((value - low) / (high - low || 1)) * (height - CHART.top - CHART.bottom);
    this.axes(context, { x, y, low, high, length, width, height });
    context.beginPath();
    for (const { from, to, begin, end } of this.rows) {
      context.moveTo(x(from), y(begin));
      context.lineTo(x(to), y(end));
    }
    context.strokeStyle = styleText("--accent");
    context.lineWidth = 2;
    context.stroke();
  }

  axes(context, { x, y, low, high, length, width, height }) {
    context.strokeStyle = styleText("--line");
    context.fillStyle = styleText("--soft");
    context.font = "11px system-ui, sans-serif";
    for (const value of [low, (low + high) / 2, high]) {
      context.beginPath();
      context.moveTo(CHART.left, y(value));
      context.lineTo(width - CHART.right, y(value));
      context.stroke();
      context.textAlign = "right";
      context.fillText(readable(value, 4), CHART.left - 5, y(value) + 4);
    }
    context.textAlign = "left";
    context.fillText("0", x(0), height - 6);
    context.textAlign = "right";
    context.fillText(readable(length, 4), x(length), height - 6);
  }

  draw(pen) {
    const colour = styleText("--way");
    if (this.from) pen.dot(this.from, colour);
    if (!this.to) return;
    pen.line([this.from, this.to], colour, 2.5);
    pen.dot(this.to, colour);
  }
}
