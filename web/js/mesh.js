// mesh.js - meshes: arrays, values, defects, properties.
import { NONE, numberOrNull } from "./numbers.js";

const DEFECT_BYTES = 20;
const NO_EDGE = 255;

/** Names of the kinds of defects, as `meshwalk check --json` has them. */
export const DEFECT_KINDS = ["index", "not-finite", "repeated-vertex", "edge-shared", "folded",
  "turn", "crossing", "vertex-in-edge", "overlap", "flat", "clashing", "open-edge",
  "through-centre", "turned", "covered"];

const INFO = ["vertices", "triangles", "unusedVertices", "flatTriangles", "clockwiseTriangles",
  "clashingEdges", "borderEdges", "borderLoops", "components", "holes", "oriented", "embedding",
  "convex", "delaunay"];

/** A mesh of triangles. Release it with free(). */
export class Mesh {
  constructor(engine, address, name) {
    this.engine = engine;
    this.address = address;
    this.name = name;
    this.vertexCount = engine.call.web_mesh_vertex_count(address);
    this.triangleCount = engine.call.web_mesh_triangle_count(address);
    this.hasHeights = engine.call.web_mesh_has_z(address) === 1;
    this.crs = engine.text(engine.call.web_mesh_crs(address));
  }

  free() {
    this.engine.call.web_mesh_free(this.address);
    this.address = 0;
  }

  /** x, y, z of each vertex; a view that ends with the next call of the engine. */
  get points() {
    const { engine, address } = this;
    return engine.doubles(engine.call.web_mesh_points(address), 3 * this.vertexCount);
  }

  /** Three vertices of each triangle; a view like `points`. */
  get triangles() {
    const { engine, address } = this;
    return engine.numbers(engine.call.web_mesh_triangles(address), 3 * this.triangleCount);
  }

  names(ofTriangles) {
    const { engine, address } = this;
    const count = engine.call.web_mesh_field_count(address, ofTriangles);
    return Array.from({ length: count }, (_, i) =>
      engine.text(engine.call.web_mesh_field_name(address, ofTriangles, i)));
  }

  get fieldNames() {
    return this.names(0);
  }

  get triangleFieldNames() {
    return this.names(1);
  }

  values(ofTriangles, name) {
    const { engine, address } = this;
    const i = this.names(ofTriangles).indexOf(name);
    if (i < 0) return null;
    const count = ofTriangles ? this.triangleCount : this.vertexCount;
    return engine.doubles(engine.call.web_mesh_field(address, ofTriangles, i), count);
  }

  /** A value of each vertex; a view like `points`; null if there is no such field. */
  field(name) {
    return this.values(0, name);
  }

  /** A value of each triangle. */
  triangleField(name) {
    return this.values(1, name);
  }

  /** Links across the edges 0, 1, 2 of each triangle: 4 * neighbour + edge; NONE on a border. */
  links() {
    const { engine, address } = this;
    const count = 3 * this.triangleCount;
    return engine.withRoom(4 * count, (room) => {
      engine.need(engine.call.web_mesh_links(address, room));
      return engine.numbers(room, count).slice();
    });
  }

  /** What the mesh is: counts, extent, area. */
  describe() {
    const { engine, address } = this;
    return engine.withRoom(8 * 19, (room) => {
      engine.need(engine.call.web_mesh_describe(address, room));
      const values = engine.doubles(room, 19);
      const info = {};
      INFO.forEach((name, i) => { info[name] = i < 10 ? values[i] : values[i] === 1; });
      return { ...info, low: [values[14], values[15]], high: [values[16], values[17]],
        area: values[18] };
    });
  }

  /** Every defect of a mesh in the "plane", of a "surface", or of a "star" about a centre. */
  check(as = "plane", centre = [0, 0, 0]) {
    const { engine, address } = this;
    const way = ["plane", "surface", "star"].indexOf(as);
    const check = engine.need(engine.call.web_check(address, way, ...centre));
    const count = engine.call.web_check_count(check);
    const defects = Array.from({ length: count }, (_, i) => this.defect(check, i));
    const valid = engine.call.web_check_valid(check) === 1;
    engine.call.web_check_free(check);
    return { valid, defects };
  }

  defect(check, i) {
    const { engine } = this;
    const description = engine.text(engine.call.web_check_describe(check, i));
    const at = engine.call.web_check_defects(check) + DEFECT_BYTES * i;
    const view = engine.view(at, DEFECT_BYTES);
    return {
      kind: DEFECT_KINDS[view.getUint32(0, true)],
      triangle: numberOrNull(view.getUint32(4, true), NONE),
      other: numberOrNull(view.getUint32(8, true), NONE),
      vertex: numberOrNull(view.getUint32(12, true), NONE),
      edge: numberOrNull(view.getUint8(16), NO_EDGE),
      otherEdge: numberOrNull(view.getUint8(17), NO_EDGE),
      text: description,
    };
  }
}
