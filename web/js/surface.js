// surface.js - surfaces in space: what a probe touches, and rays from a centre.
import { NONE, numberOrNull } from "./numbers.js";
import { Locations, takeCounters } from "./locator.js";

const STATES = ["hit", "none", "limit", "bad"];
const NOWHERE = 255;

/** Copy a trace of the engine: triangles visited and the answer. */
function takeTrace(engine, trace, counted) {
  const count = engine.call.web_trace_count(trace);
  const part = (which) => engine.call.web_trace_part(trace, which);
  const [state, triangle, where, local, a, b, c, distance] = engine.doubles(part(2), 8);
  const result = {
    triangles: engine.numbers(part(0), count).slice(),
    iterations: engine.numbers(part(1), count).slice(),
    state: STATES[state],
    triangle: numberOrNull(triangle, NONE),
    where: Locations.names[where],
    local: numberOrNull(local, NOWHERE),
    weights: [a, b, c],
    distance,
  };
  if (counted) result.counters = takeCounters(engine, part(3));
  engine.call.web_trace_free(trace);
  return result;
}

/** A mesh taken as a surface in space. Release it with free(), before its mesh. */
export class Surface {
  constructor(engine, mesh, walkNames, { weld = false } = {}) {
    this.engine = engine;
    this.walkNames = walkNames;
    this.address = engine.need(engine.call.web_surface_make(mesh.address, weld ? 1 : 0));
  }

  free() {
    this.engine.call.web_surface_free(this.address);
    this.address = 0;
  }

  /** Probe from a point along a motion; `certain`: complete, by boxes. */
  probe(point, motion, { certain = false, seed = 0 } = {}) {
    const { engine, address } = this;
    engine.need(engine.call.web_surface_prepare_probes(address));
    return engine.withDoubles([...point, ...motion], (room) => takeTrace(engine,
      engine.need(engine.call.web_probe(address, room, room + 24, certain ? 1 : 0, seed))));
  }

  /** Say where rays come from; an error tells why the surface is not star-shaped about it. */
  setCentre([x, y, z]) {
    this.engine.need(this.engine.call.web_surface_prepare_rays(this.address, x, y, z));
  }

  /** Walk from the ray through one point to that through another. */
  followRay(from, to, { walk = "auto", seed = 0 } = {}) {
    const { engine, address } = this;
    const kind = this.walkNames.indexOf(walk);
    if (kind < 0) throw new RangeError(`there is no walk '${walk}' on a star`);
    return engine.withDoubles([...from, ...to], (room) => takeTrace(engine,
      engine.need(engine.call.web_ray_walk(address, kind, seed, room, room + 24)), true));
  }
}
