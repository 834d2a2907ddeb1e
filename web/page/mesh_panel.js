// mesh_panel.js - what the mesh is: counts, and its borders and holes to jump to.

const LOOPS_SHOWN = 40;

function meshFacts(mesh, info) {
  const yes = (value) => (value ? "yes" : "no");
  const rows = [["vertices", readable(mesh.vertexCount)],
    ["triangles", readable(mesh.triangleCount)]];
  if (mesh.crs) rows.push(["coordinates", mesh.crs.slice(0, 60)]);
  if (!info) return rows;
  rows.push(["border edges", readable(info.borderEdges)],
    ["border loops", readable(info.borderLoops)],
    ["pieces", readable(info.components)],
    ["holes", info.embedding ? readable(info.holes) : "not known: no embedding"],
    ["flat triangles", readable(info.flatTriangles)],
    ["clockwise triangles", readable(info.clockwiseTriangles)],
    ["unused vertices", readable(info.unusedVertices)], ["convex", yes(info.convex)],
    ["Delaunay", yes(info.delaunay)], ["area", readable(info.area)],
    ["x", `${readable(info.low[0])} to ${readable(info.high[0])}`],
    ["y", `${readable(info.low[1])} to ${readable(info.high[1])}`]);
  return rows;
}

/** Borders and holes: a list, and the one that was chosen. */
class LoopPanel {
  constructor(app) {
    this.app = app;
    this.chosen = null;
  }

  show(info) {
    const loops = this.app.topology.loops();
    let holes = 0;
    this.chosen = null;
    byId("loops-head").hidden = loops.length === 0;
    byId("loops").replaceChildren(...loops.slice(0, LOOPS_SHOWN).map((loop) => {
      const name = loop.area < 0 ? `hole ${++holes}` : "outer border";
      const text = `${name}: ${plural(loop.vertices.length, "edge")}, ` +
        `length ${readable(loop.length, 4)}`;
      const item = document.createElement("li");
      item.append(makeButton(text, () => this.choose(loop)));
      return item;
    }));
    fillTable(byId("mesh-facts"), meshFacts(this.app.mesh, info));
  }

  choose(loop) {
    this.chosen = loop;
    this.app.stage.goTo(this.app.topology.box([], loop.vertices));
  }

  draw(pen) {
    if (!this.chosen) return;
    const { vertices } = this.chosen;
    const pairs = vertices.flatMap((v, i) => [v, vertices[(i + 1) % vertices.length]]);
    pen.edges(pairs, styleText("--accent"), 4);
  }
}
