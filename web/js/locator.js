// locator.js - points located in a mesh, and walks followed triangle by triangle.
import { NONE, numberOrNull } from "./numbers.js";

const LOCATION_BYTES = 40;
const NO_LOCAL = 255;
const WHERES = ["inside", "edge", "vertex", "outside", "hole", "near", "bad"];
const STAGES = ["init", "walk", "final", "border"];
const FILLS = { auto: 0, filled: 1, open: 2 };

/** Where a point lies, from the engine's memory. */
function readLocation(engine, address) {
  const view = engine.view(address, LOCATION_BYTES);
  return {
    where: WHERES[view.getUint8(32)],
    triangle: numberOrNull(view.getUint32(24, true), NONE),
    local: numberOrNull(view.getUint8(33), NO_LOCAL),
    hole: numberOrNull(view.getUint32(28, true), NONE),
    weights: [0, 8, 16].map((at) => view.getFloat64(at, true)),
  };
}

/** What a walk did, from the engine's memory. */
export function takeCounters(engine, address) {
  const [visited, orientations, implicit, comparisons, cycles, handovers] =
    engine.doubles(address, 6);
  return { visited, orientations, implicit, comparisons, cycles, handovers };
}

/** Where many points lie: an array for each member. */
export class Locations {
  constructor(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    const count = bytes.length / LOCATION_BYTES;
    this.bytes = bytes; // as the engine has them
    this.length = count;
    this.where = new Uint8Array(count); // number of Locations.names
    this.triangle = new Uint32Array(count); // NONE: 4294967295
    this.hole = new Uint32Array(count);
    this.local = new Uint8Array(count); // 255: none
    this.weights = new Float64Array(3 * count);
    for (let i = 0, at = 0; i < count; i++, at += LOCATION_BYTES) {
      for (let k = 0; k < 3; k++) this.weights[3 * i + k] = view.getFloat64(at + 8 * k, true);
      this.triangle[i] = view.getUint32(at + 24, true);
      this.hole[i] = view.getUint32(at + 28, true);
      this.where[i] = view.getUint8(at + 32);
      this.local[i] = view.getUint8(at + 33);
    }
  }
}
Locations.names = WHERES;

/** A mesh prepared for queries. Release it with free(), before its mesh. */
export class Locator {
  constructor(engine, mesh, names, options = {}) {
    const { any = false, border = false, fill = "auto" } = options;
    this.engine = engine;
    this.mesh = mesh;
    this.names = names; // of walks and starts
    this.address = engine.need(engine.call.web_locator_make(mesh.address, any ? 1 : 0,
      border ? 1 : 0, FILLS[fill]));
  }

  free() {
    this.engine.call.web_locator_free(this.address);
    this.address = 0;
  }

  /** The promise that does not hold because the mesh is no embedding; null: all hold. */
  get voidPromise() {
    return this.engine.text(this.engine.call.web_locator_void_promise(this.address));
  }

  numberOf(kind, name) {
    const found = this.names[kind].indexOf(name);
    if (found < 0) throw new RangeError(`there is no ${kind} '${name}'`);
    return found;
  }

  /** Locate points x, y. */
  locate(points, options = {}) {
    const { walk = "auto", start = "auto", seed = 0, tolerance = 0 } = options;
    const { engine, address } = this;
    const count = points.length >> 1;
    const how = [this.numberOf("walk", walk), this.numberOf("start", start), seed, tolerance];
    return engine.withDoubles(points, (xy) =>
      engine.withRoom(LOCATION_BYTES * count, (room) => {
        engine.need(engine.call.web_locate(address, xy, count, ...how, room));
        return new Locations(engine.bytes(room, LOCATION_BYTES * count).slice());
      }));
  }

  /** Locate one point: { where, triangle, local, hole, weights }. */
  locateOne(x, y, options) {
    const at = this.locate([x, y], options);
    return {
      where: WHERES[at.where[0]],
      triangle: numberOrNull(at.triangle[0], NONE),
      local: numberOrNull(at.local[0], NO_LOCAL),
      hole: numberOrNull(at.hole[0], NONE),
      weights: Array.from(at.weights),
    };
  }

  /** Values of vertices, interpolated at locations; NaN where there is no triangle. */
  interpolate(values, locations) {
    const { engine, mesh } = this;
    const { length } = locations;
    return engine.withDoubles(values, (from) =>
      engine.withRoom(locations.bytes.length, (places) =>
        engine.withRoom(8 * length, (to) => {
          engine.bytes(places, locations.bytes.length).set(locations.bytes);
          engine.call.web_interpolate(mesh.address, from, places, length, to);
          return engine.doubles(to, length).slice();
        })));
  }

  /** The nearest point of the border; the locator needs { border: true }. */
  nearestBorder(x, y) {
    const { engine, address } = this;
    return engine.withRoom(40, (room) => {
      engine.need(engine.call.web_nearest_border(address, x, y, room));
      const [triangle, edge, distance, atX, atY] = engine.doubles(room, 5);
      return { triangle, edge, distance, point: [atX, atY] };
    });
  }

  /** The pieces of a segment: { from, to, triangle }, with parameters from 0 to 1. */
  segment(a, b) {
    const { engine, address } = this;
    const found = engine.need(engine.call.web_segment_make(address, a[0], a[1], b[0], b[1]));
    const count = engine.call.web_segment_count(found);
    const all = count ? engine.doubles(engine.call.web_segment_pieces(found), 3 * count) : [];
    const pieces = Array.from({ length: count }, (_, i) =>
      ({ from: all[3 * i], to: all[3 * i + 1], triangle: all[3 * i + 2] }));
    engine.call.web_segment_free(found);
    return pieces;
  }

  /** Follow a walk from the triangle that contains `from` to the point `to`. */
  follow(from, to, options = {}) {
    const { walk = "auto", seed = 0 } = options;
    const { engine } = this;
    const kind = this.numberOf("walk", walk);
    const way = engine.need(
      engine.call.web_walk_make(this.address, kind, seed, from[0], from[1], to[0], to[1]));
    const part = (which) => engine.call.web_walk_part(way, which);
    const count = engine.call.web_walk_count(way);
    const line = engine.doubles(part(4), 7);
    const result = {
      triangles: engine.numbers(part(0), count).slice(),
      stages: Array.from(engine.bytes(part(1), count), (stage) => STAGES[stage]),
      location: readLocation(engine, part(2)),
      counters: takeCounters(engine, part(3)),
      line: Array.from({ length: line[6] }, (_, i) => [line[2 * i], line[2 * i + 1]]),
    };
    engine.call.web_walk_free(way);
    return result;
  }
}
