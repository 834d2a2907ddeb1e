// meshwalk.js - the library in JavaScript: meshwalk.d.ts says what everything is.
import { Engine, MeshwalkError } from "./engine.js";
import { Mesh, DEFECT_KINDS } from "./mesh.js";
import { Locator, Locations } from "./locator.js";
import { Picture } from "./picture.js";
import { Surface } from "./surface.js";

export { MeshwalkError, Mesh, Locator, Locations, Surface, Picture, DEFECT_KINDS };

/** The engine, ready: what reads and makes meshes. */
export class Meshwalk {
  constructor(engine) {
    this.engine = engine;
    this.version = engine.text(engine.call.web_version());
    this.walks = this.list((i, what) => engine.call.web_walk_text(i, what));
    this.starts = this.list((i, what) =>
      engine.call.web_start_text(i, what === 2 ? 1 : what));
    this.starWalks = this.list((i, what) => engine.call.web_star_walk_text(i, what));
    this.names = {
      walk: ["auto", ...this.walks.map((walk) => walk.name)],
      start: ["auto", ...this.starts.map((start) => start.name)],
    };
  }

  /** The entries from 1 on; 0 is the engine's own choice. */
  list(text) {
    const entries = [];
    for (let i = 1; text(i, 0); i++) {
      const [name, source, help] = [0, 1, 2].map((what) => this.engine.text(text(i, what)));
      entries.push({ name, source, help });
    }
    return entries;
  }

  /** Read a mesh from the bytes of a file; `beside`: further files, such as x.ele or x.prj. */
  readMesh(name, bytes, beside = {}) {
    const { engine } = this;
    try {
      return engine.withFiles({ ...beside, [name]: bytes }, () =>
        engine.withText(name, (path) =>
          new Mesh(engine, engine.need(engine.call.web_mesh_read(path)), name)));
    } catch (error) {
      throw this.withoutLibraries(name, error);
    }
  }

  /** What a program would load a library for cannot be had in a browser. */
  withoutLibraries(name, error) {
    if (!/libnetcdf/.test(error.message)) return error;
    return new MeshwalkError(`${name}: netCDF files cannot be read here: 'meshwalk view ${name}' ` +
      "makes a page of one, 'meshwalk convert' another file", "system", {});
  }

  /** Read points: { columns, width, count, values }. */
  readPoints(name, bytes) {
    const { engine } = this;
    return engine.withFiles({ [name]: bytes }, () => engine.withText(name, (path) => {
      const points = engine.need(engine.call.web_points_read(path));
      const width = engine.call.web_points_width(points);
      const count = engine.call.web_points_count(points);
      const columns = Array.from({ length: width }, (_, i) =>
        engine.text(engine.call.web_points_column(points, i)));
      const values = engine.doubles(engine.call.web_points_values(points), width * count).slice();
      engine.call.web_points_free(points);
      return { columns, width, count, values };
    }));
  }

  /** The columns that may be x and y by their names: all pairs, and whether any name is known. */
  coordinateColumns(columns) {
    const { engine } = this;
    const matches = (column, set, axis) =>
      engine.withText(column, (text) => engine.call.web_axis_match(text, set, axis));
    const fits = [];
    let known = false;
    for (let set = 0; matches("", set, 0) >= 0; set++) {
      const [xs, ys, zs] = [0, 1, 2].map((axis) =>
        [...columns.keys()].filter((i) => matches(columns[i], set, axis) > 0));
      for (const x of xs) for (const y of ys) fits.push([x, y]);
      known = known || xs.length + ys.length + zs.length > 0;
    }
    return { fits, known };
  }

  /** A mesh from arrays: points of `dimension` 2 or 3 numbers, triangles of 3 vertices. */
  createMesh({ points, triangles, dimension = 2, name = "mesh", fields = {},
    triangleFields = {} }) {
    const { engine } = this;
    const count = Math.floor(points.length / dimension);
    const address = engine.need(engine.call.web_mesh_make(count, triangles.length / 3));
    engine.call.web_mesh_set_has_z(address, dimension === 3 ? 1 : 0);
    const mesh = new Mesh(engine, address, name);
    const xyz = mesh.points;
    for (let i = 0; i < count; i++)
      for (let k = 0; k < dimension; k++) xyz[3 * i + k] = points[dimension * i + k];
    mesh.triangles.set(triangles);
    this.addFields(mesh, 0, fields);
    this.addFields(mesh, 1, triangleFields);
    return mesh;
  }

  addFields(mesh, ofTriangles, fields) {
    const { engine } = this;
    for (const [name, values] of Object.entries(fields)) {
      const at = engine.withText(name, (text) =>
        engine.call.web_mesh_add_field(mesh.address, ofTriangles, text));
      engine.doubles(engine.need(at), values.length).set(values);
    }
  }

  /** The Delaunay triangulation of points x, y. */
  triangulate(points, name = "points") {
    const { engine } = this;
    const count = points.length >> 1;
    const xyz = new Float64Array(3 * count);
    for (let i = 0; i < count; i++) xyz.set([points[2 * i], points[2 * i + 1]], 3 * i);
    return engine.withDoubles(xyz, (address) =>
      new Mesh(engine, engine.need(engine.call.web_mesh_delaunay(address, count)), name));
  }

  /** Take a mesh as a surface in space; { weld: true } joins vertices with equal coordinates. */
  createSurface(mesh, options) {
    const names = ["auto", ...this.starWalks.map((walk) => walk.name)];
    return new Surface(this.engine, mesh, names, options);
  }

  /** The side of the line from a to b that c is on, exactly: 1 left, -1 right, 0 on it. */
  orient2d(a, b, c) {
    return this.engine.call.web_orient2d(a[0], a[1], b[0], b[1], c[0], c[1]);
  }

  /** Prepare a mesh for queries. */
  createLocator(mesh, options) {
    return new Locator(this.engine, mesh, this.names, options);
  }
}

/** Load the engine from the bytes of meshwalk.wasm. */
export async function loadMeshwalk(bytes) {
  return new Meshwalk(await Engine.create(bytes));
}
