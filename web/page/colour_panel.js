// colour_panel.js - what colours mean: field, palette, light, legend.

const MISSING_COLOUR = [200, 90, 160];

class ColourPanel {
  constructor(app) {
    this.app = app;
    const palettes = Object.keys(ANCHORS).map((name) => new Option(name));
    byId("colour-palette").replaceChildren(...palettes);
    for (const id of ["colour-field", "colour-palette"])
      byId(id).addEventListener("change", () => this.apply());
    byId("light").addEventListener("change", () => app.stage.setLight(byId("light").checked));
    for (const id of ["edges", "borders"])
      byId(id).addEventListener("change", () => app.stage.redraw());
    byId("space").addEventListener("change", () => app.setSpace(byId("space").value));
  }

  /** Offer what the mesh has. */
  show() {
    const { mesh } = this.app;
    const options = [["none", "nothing"]];
    const heights = mesh.hasHeights && varies(this.heights());
    if (heights) options.push(["z", "height z"]);
    for (const name of mesh.fieldNames) options.push([`vertex:${name}`, name]);
    for (const name of mesh.triangleFieldNames) options.push([`triangle:${name}`, name]);
    options.push(["piece", "piece"], ["number", "number of the triangle"]);
    const choices = options.map(([value, text]) => new Option(text, value));
    byId("colour-field").replaceChildren(...choices);
    byId("colour-field").value = this.firstChoice(options);
    byId("light").checked = heights;
    this.apply();
  }

  firstChoice(options) {
    const [, second] = options;
    return second[0] === "piece" ? "none" : second[0];
  }

  /** { name, values, ofTriangles } of the chosen field; null: none. */
  chosen() {
    const { mesh, topology } = this.app;
    const [kind, ...rest] = byId("colour-field").value.split(":");
    const name = rest.join(":");
    if (kind === "z") return { name: "z", values: this.heights(), ofTriangles: false };
    if (kind === "vertex") return { name, values: mesh.field(name).slice(), ofTriangles: false };
    if (kind === "triangle")
      return { name, values: mesh.triangleField(name).slice(), ofTriangles: true };
    if (kind === "piece") return { name: "piece", values: topology.pieces(), ofTriangles: true };
    if (kind === "number") return { name: "triangle", values: this.numbers(), ofTriangles: true };
    return null;
  }

  heights() {
    const { points } = this.app.topology;
    return Float64Array.from({ length: points.length / 3 }, (_, i) => points[3 * i + 2]);
  }

  numbers() {
    return Float64Array.from({ length: this.app.mesh.triangleCount }, (_, i) => i);
  }

  apply() {
    const { stage } = this.app;
    const field = this.chosen();
    const [low, high] = field ? valueRange(field.values) : [0, 1];
    const colours = makePalette(byId("colour-palette").value);
    this.field = field;
    stage.picture.setPalette(colours, MISSING_COLOUR, styleColour("--mesh"));
    stage.picture.setValues(field && field.values, field && field.ofTriangles, low, high);
    this.showLegend(field, low, high, colours);
    stage.setLight(byId("light").checked);
  }

  showLegend(field, low, high, colours) {
    byId("legend").hidden = !field;
    if (!field) return;
    const context = byId("legend-bar").getContext("2d");
    colours.forEach(([r, g, b], i) => {
      context.fillStyle = `rgb(${r} ${g} ${b})`;
      context.fillRect(i, 0, 1, 12);
    });
    byId("legend-name").textContent = field.name;
    byId("legend-low").textContent = readable(low, 5);
    byId("legend-middle").textContent = readable((low + high) / 2, 5);
    byId("legend-high").textContent = readable(high, 5);
  }
}

function varies(values) {
  const [low, high] = valueRange(values);
  return low < high;
}

/** The least and the greatest finite value. */
function valueRange(values) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : [0, 1];
}
