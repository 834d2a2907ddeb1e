// step_words.js - why a walk leaves a triangle as it does: beyond which edges its end lies.

/** The edges of a triangle that a point lies beyond, exactly, and the one to the next triangle. */
function edgesBeyond({ meshwalk, topology }, triangle, next, point) {
  const corners = topology.corners(triangle);
  const turn = meshwalk.orient2d(...corners);
  const beyond = [0, 1, 2].filter((k) =>
    turn * meshwalk.orient2d(corners[k], corners[(k + 1) % 3], point) < 0);
  const leaves = [0, 1, 2].find((k) => topology.links[3 * triangle + k] >>> 2 === next);
  return { beyond, leaves: next === undefined ? undefined : leaves };
}

function listed(edges) {
  if (edges.length < 2) return `edge ${edges[0]}`;
  return `edges ${edges.slice(0, -1).join(", ")} and ${edges[edges.length - 1]}`;
}

/** What a step sees, in words. */
function tellStep({ beyond, leaves }, next) {
  const seen = beyond.length ? `The point lies beyond ${listed(beyond)} of it.`
    : "The point lies beyond none of its edges.";
  if (leaves === undefined) return next === undefined ? `${seen} Here the walk ends.` : seen;
  const why = beyond.length > 1 && beyond.includes(leaves) ? ", its choice of these," : "";
  return `${seen} The walk leaves over edge ${leaves}${why} into triangle ${next}.`;
}

/** Why a ring is one: in how many of its triangles the walk had a choice; "" without a ring. */
function tellRing(app, { triangles }, point) {
  const ring = findRing(triangles);
  if (!ring) return "";
  const once = Array.from(triangles.subarray(ring.begin, ring.begin + ring.length));
  const choices = once.filter((triangle) => edgesBeyond(app, triangle, undefined, point)
    .beyond.length > 1).length;
  return choices ? ` In ${plural(choices, "triangle")} of the ring the point lies beyond two ` +
    "edges, and this walk chooses the same one each time." : "";
}

/** Mark the edges beyond which the point lies, and the one that the walk takes. */
function drawStep(pen, triangle, { beyond, leaves }) {
  const { topology } = pen;
  const colour = styleText("--ink");
  const ends = (k) => [topology.at(topology.corner(triangle, k)),
    topology.at(topology.corner(triangle, k + 1))];
  for (const k of beyond) pen.line(ends(k), colour, 2.5, [5, 4]);
  if (leaves !== undefined) pen.line(ends(leaves), colour, 4);
}
