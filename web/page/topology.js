// topology.js - borders, pieces and the triangles round a place, from the links of a mesh.

/** What the page asks about the connections of a mesh. Keeps copies of its arrays. */
class Topology {
  constructor(mesh) {
    this.points = mesh.points.slice();
    this.triangles = mesh.triangles.slice();
    this.links = mesh.links();
    this.border = this.findBorder();
  }

  corner(triangle, k) {
    return this.triangles[3 * triangle + (k % 3)];
  }

  at(vertex) {
    return this.points.subarray(3 * vertex, 3 * vertex + 3);
  }

  corners(triangle) {
    return [0, 1, 2].map((k) => this.at(this.corner(triangle, k)));
  }

  /** Twice the area in the plane; less than 0 clockwise. */
  area(triangle) {
    const [a, b, c] = this.corners(triangle);
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  }

  /** A normal of a triangle in space, on the side that points away from a middle. */
  outward(triangle, middle) {
    const [a, b, c] = this.corners(triangle);
    const [u, v] = [b, c].map((corner) => [0, 1, 2].map((k) => corner[k] - a[k]));
    const normal = [0, 1, 2].map((k) =>
      u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    const side = normal.reduce((sum, part, k) => sum + part * (a[k] - middle[k]), 0);
    return side < 0 ? normal.map((part) => -part) : normal;
  }

  /** Border edges as pairs of vertices, with the mesh on the left. */
  findBorder() {
    const found = [];
    for (let i = 0; i < this.links.length; i++) {
      if (this.links[i] !== NONE) continue;
      const triangle = Math.floor(i / 3);
      const edge = [this.triangles[i], this.corner(triangle, (i % 3) + 1)];
      found.push(...(this.area(triangle) < 0 ? edge.reverse() : edge));
    }
    return found;
  }

  /** The border as loops of vertices: { vertices, area, length }, the longest first. */
  loops() {
    const next = new Map();
    for (let i = 0; i < this.border.length; i += 2) {
      const from = this.border[i];
      if (!next.has(from)) next.set(from, []);
      next.get(from).push(this.border[i + 1]);
    }
    const loops = [];
    for (const [first, ways] of next)
      while (ways.length) loops.push(this.loopFrom(next, first));
    return loops.sort((a, b) => b.length - a.length);
  }

  loopFrom(next, first) {
    const vertices = [];
    let vertex = first;
    let area = 0;
    let length = 0;
    while (next.get(vertex) && next.get(vertex).length) {
      const other = next.get(vertex).pop();
      const [a, b] = [this.at(vertex), this.at(other)];
      area += (a[0] * b[1] - b[0] * a[1]) / 2;
      length += Math.hypot(b[0] - a[0], b[1] - a[1]);
      vertices.push(vertex);
      vertex = other;
    }
    return { vertices, area, length };
  }

  /** The number of the piece of each triangle: pieces share no vertex. */
  pieces() {
    const parent = Uint32Array.from({ length: this.points.length / 3 }, (_, i) => i);
    const root = (v) => {
      while (parent[v] !== v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (let i = 0; i < this.triangles.length; i += 3)
      for (let k = 1; k < 3; k++) parent[root(this.triangles[i + k])] = root(this.triangles[i]);
    const numbers = new Map();
    return Float64Array.from({ length: this.triangles.length / 3 }, (_, t) => {
      const own = root(this.triangles[3 * t]);
      if (!numbers.has(own)) numbers.set(own, numbers.size);
      return numbers.get(own);
    });
  }

  /** The triangles that share the edge or vertex of a location, the answer first. */
  tie({ where, triangle, local }) {
    if (where === "vertex") return this.around([this.corner(triangle, local)]);
    if (where !== "edge") return triangle === null ? [] : [triangle];
    return this.around([this.corner(triangle, local), this.corner(triangle, local + 1)]);
  }

  /** Triangles that have corners at all the places of some vertices. */
  around(vertices) {
    const places = vertices.map((v) => this.at(v));
    const found = [];
    const same = (v, place) =>
      this.points[3 * v] === place[0] && this.points[3 * v + 1] === place[1];
    for (let t = 0; t < this.triangles.length / 3; t++) {
      const all = places.every((place) => [0, 1, 2].some((k) => same(this.corner(t, k), place)));
      if (all) found.push(t);
    }
    return found;
  }

  /** The box of some triangles and vertices: { low, high } in space. */
  box(triangles, vertices = []) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    const add = (v) => this.at(v).forEach((value, k) => {
      if (!Number.isFinite(value)) return;
      low[k] = Math.min(low[k], value);
      high[k] = Math.max(high[k], value);
    });
    for (const t of triangles) [0, 1, 2].forEach((k) => add(this.corner(t, k)));
    vertices.forEach(add);
    return { low, high };
  }

  /** The box of all vertices that triangles use. */
  extent() {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < this.triangles.length; i++)
      for (let k = 0; k < 3; k++) {
        const value = this.points[3 * this.triangles[i] + k];
        if (value < low[k]) low[k] = value;
        if (value > high[k]) high[k] = value;
      }
    return low[0] <= high[0] ? { low, high } : { low: [0, 0, 0], high: [1, 1, 1] };
  }
}
