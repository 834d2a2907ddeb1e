// defect_panel.js - every defect: listed, jumped to, explained.

const DEFECTS_SHOWN = 200;

class DefectPanel {
  constructor(app) {
    this.app = app;
    this.chosen = null;
  }

  /** Fill the list; returns how many are no mere remarks. */
  show(check, space, voided) {
    this.space = space;
    const { defects } = check;
    const real = defects.filter((defect) => defect.kind !== "flat").length;
    this.chosen = null;
    byId("defect-panel").open = real > 0;
    byId("defect-count").textContent = real || (defects.length ? defects.length : "none");
    byId("defect-count").classList.toggle("good", real === 0);
    byId("defect-about").innerHTML = "";
    byId("defects").replaceChildren(...defects.slice(0, DEFECTS_SHOWN).map((d) => this.item(d)));
    if (defects.length > DEFECTS_SHOWN) this.tell(`The first ${DEFECTS_SHOWN} of ` +
      `${plural(defects.length, "defect")}; 'meshwalk check${this.as()}' lists all.`);
    if (voided) this.tell(`So long as they are there, a promise does not hold: ${voided}.`);
    if (!defects.length) this.tell(space === "space" ? `None, as a ${this.app.as}.` : "None.");
    if (space === "space") this.tellPlane();
    return real;
  }

  /** A terrain may be meant after all. */
  tellPlane() {
    const { plane } = this.app.checks;
    if (!plane.valid) this.tell(`In the plane it has ${plural(plane.defects.length, "defect")}: ` +
      "choose the plane under Colour to see them.");
  }

  tell(text) {
    const line = document.createElement("p");
    line.className = "small";
    line.textContent = text;
    byId("defect-about").append(line);
  }

  item(defect) {
    const item = document.createElement("li");
    item.append(makeButton(defect.text, (button) => this.choose(defect, button)));
    return item;
  }

  choose(defect, button) {
    const { stage, topology } = this.app;
    this.chosen = defect;
    for (const other of byId("defects").querySelectorAll("button"))
      other.setAttribute("aria-current", other === button);
    this.explain(defect);
    const box = topology.box(this.triangles(), this.vertices());
    if (stage.space === "space" && defect.triangle !== null) {
      const { low, high } = topology.extent();
      stage.camera.face(topology.outward(defect.triangle, low.map((v, k) => (v + high[k]) / 2)));
    }
    if (Number.isFinite(box.low[0])) stage.goTo(box);
    else stage.drawOverlay();
  }

  explain({ kind, text }) {
    const { title, text: why, mendable } = explainDefect(kind);
    const box = document.createElement("div");
    box.className = "explained";
    const head = document.createElement("strong");
    head.textContent = title;
    const words = document.createElement("div");
    words.textContent = `${why} Here: ${text}.`;
    box.append(head, words);
    if (mendable) {
      const hint = document.createElement("code");
      hint.textContent = `meshwalk check --fix all${this.as()} -o mended.ply ` +
        this.app.mesh.name;
      box.append("Perhaps this mends it: ", hint);
    }
    byId("defect-about").replaceChildren(box);
  }

  /** The option of the command line for a surface. */
  as() {
    return this.space === "space" ? ` --as ${this.app.as}` : "";
  }

  triangles() {
    const { triangle, other } = this.chosen;
    return [triangle, other].filter((number) => number !== null);
  }

  vertices() {
    return this.chosen.vertex === null ? [] : [this.chosen.vertex];
  }

  edgesOf({ triangle, edge, other, otherEdge }) {
    const { topology } = this.app;
    const pairs = [];
    for (const [t, k] of [[triangle, edge], [other, otherEdge]])
      if (t !== null && k !== null) pairs.push(topology.corner(t, k), topology.corner(t, k + 1));
    return pairs;
  }

  draw(pen) {
    if (!this.chosen) return;
    const bad = styleText("--bad");
    const { triangle, other, vertex } = this.chosen;
    if (other !== null) pen.triangles([other], { fill: bad, alpha: 0.25, stroke: bad });
    if (triangle !== null)
      pen.triangles([triangle], { fill: bad, alpha: 0.45, stroke: bad, width: 2 });
    pen.edges(this.edgesOf(this.chosen), bad, 5);
    if (vertex !== null) pen.dot(this.app.topology.at(vertex), bad, 7);
  }
}
