// point_panel.js - many points, coloured by where they lie.

class PointPanel {
  constructor(app) {
    this.app = app;
    this.clear();
    byId("point-triangulate").addEventListener("click", () =>
      app.attempt(() => app.open(app.meshwalk.triangulate(this.xy, this.name))));
  }

  clear() {
    this.xy = null;
    byId("point-panel").hidden = true;
  }

  /** `axes`: the names of the columns that are x and y, if a table told them. */
  show(name, xy, axes = null) {
    const { app } = this;
    this.axes = axes;
    this.name = name;
    this.xy = xy;
    byId("point-panel").hidden = false;
    byId("point-panel").open = true;
    byId("point-count").textContent = (xy.length / 2).toLocaleString("en");
    this.locate();
    app.stage.drawOverlay();
  }

  locate() {
    if (!this.app.locator) {
      this.statuses = new Array(this.xy.length / 2).fill("bad");
      return;
    }
    const found = this.app.locator.locate(this.xy);
    this.statuses = Array.from(found.where, (where) => Locations.names[where]);
    const counts = new Map();
    for (const status of this.statuses) counts.set(status, (counts.get(status) || 0) + 1);
    const rows = [...counts].map(([status, count]) =>
      [status, count.toLocaleString("en"), STATUS_COLOURS[status]]);
    if (this.axes) rows.unshift(["x, y", this.axes.join(", ")]);
    fillTable(byId("point-facts"), rows);
  }

  draw(pen, notes) {
    if (!this.xy || this.app.stage.space === "space") return;
    const drawn = pen.points(this.xy, this.statuses);
    const count = this.xy.length / 2;
    if (drawn < count) notes.push(`${readable(drawn)} of ${readable(count)} points are drawn`);
  }
}
