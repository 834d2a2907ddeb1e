// overlay.js - lines and marks above the picture: edges, borders, walks, defects, points.

const POINTS_DRAWN = 100000;
const BORDER_DRAWN = 150000; // edges
const EDGE = 0.7; // pixels
const BORDER = 1.8;

/** Draws in the pixels of the style. */
class Pen {
  constructor(context, camera, topology) {
    this.context = context;
    this.camera = camera;
    this.topology = topology;
  }

  path(vertices) {
    vertices.forEach((v, i) => {
      const [x, y] = this.camera.toScreen(this.topology.at(v));
      if (i) this.context.lineTo(x, y);
      else this.context.moveTo(x, y);
    });
  }

  trianglePath(triangle) {
    this.path([0, 1, 2].map((k) => this.topology.corner(triangle, k)));
    this.context.closePath();
  }

  triangles(list, { fill, stroke, width = 1, alpha = 1 }) {
    const { context } = this;
    context.save();
    context.beginPath();
    for (const triangle of list) this.trianglePath(triangle);
    context.globalAlpha = alpha;
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (stroke) {
      context.strokeStyle = stroke;
      context.lineWidth = width;
      context.lineJoin = "round";
      context.stroke();
    }
    context.restore();
  }

  /** Pairs of vertices. */
  edges(pairs, stroke, width) {
    const { context } = this;
    context.beginPath();
    for (let i = 0; i < pairs.length; i += 2) this.path([pairs[i], pairs[i + 1]]);
    context.strokeStyle = stroke;
    context.lineWidth = width;
    context.stroke();
  }

  line(points, stroke, width, dash = []) {
    const { context } = this;
    context.save();
    context.beginPath();
    points.forEach((point, i) => {
      const [x, y] = this.camera.toScreen(point);
      if (i) context.lineTo(x, y);
      else context.moveTo(x, y);
    });
    context.setLineDash(dash);
    context.strokeStyle = stroke;
    context.lineWidth = width;
    context.stroke();
    context.restore();
  }

  dot(point, colour, radius = 5) {
    const { context } = this;
    const [x, y] = this.camera.toScreen(point);
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
    context.lineWidth = 1.5;
    context.strokeStyle = styleText("--panel");
    context.stroke();
  }

  label(point, text, colour) {
    const { context } = this;
    const [x, y] = this.camera.toScreen(point);
    context.font = "600 13px system-ui, sans-serif";
    context.lineWidth = 4;
    context.strokeStyle = styleText("--panel");
    context.strokeText(text, x + 9, y - 7);
    context.fillStyle = colour;
    context.fillText(text, x + 9, y - 7);
  }

  /** Points x, y by status; returns how many are drawn. */
  points(xy, statuses) {
    const { context } = this;
    const count = xy.length / 2;
    const step = Math.ceil(count / POINTS_DRAWN);
    const side = count > 20000 ? 2 : 5;
    for (let i = 0; i < count; i += step) {
      const [x, y] = this.camera.toScreen([xy[2 * i], xy[2 * i + 1]]);
      context.fillStyle = STATUS_COLOURS[statuses[i]];
      context.fillRect(x - side / 2, y - side / 2, side, side);
    }
    return Math.ceil(count / step);
  }
}

/** Edges and borders in space, which the engine draws, so that hidden ones stay hidden. */
function spaceLines({ stage: { ratio } }) {
  return { ink: styleColour("--ink"), edge: byId("edges").checked ? EDGE * ratio : 0,
    border: byId("borders").checked ? BORDER * ratio : 0, alpha: 0.45, most: EDGES };
}

/** What belongs to the picture and changes with it only: edges and borders. */
function drawLines(app, context, camera) {
  const pen = new Pen(context, camera, app.topology);
  const ink = styleText("--ink");
  app.lineNotes = [];
  if (byId("edges").checked) app.lineNotes.push(drawEdges(app, pen, ink));
  if (byId("borders").checked) app.lineNotes.push(drawBorders(app, pen, ink));
}

/** Everything above the picture, from the lowest to the highest. */
function drawAll(app, context, camera) {
  if (!app.topology) return;
  const pen = new Pen(context, camera, app.topology);
  const notes = [app.hint, ...app.lineNotes];
  app.loopPanel.draw(pen);
  app.profile.draw(pen);
  app.points.draw(pen, notes);
  app.walkPanel.draw(pen);
  app.defects.draw(pen);
  app.here.draw(pen);
  if (app.stage.keyboard) drawCross(context, camera.size, styleText("--accent"));
  byId("notice").textContent = notes.filter(Boolean).join(" · ");
}

function drawEdges(app, pen, ink) {
  const list = app.stage.edgeTriangles();
  if (list && app.stage.space === "space") return "";
  if (!list)
    return `${readable(app.stage.picture.visible)} triangles in sight: edges appear as you zoom in`;
  pen.triangles(list, { stroke: ink, width: EDGE, alpha: list.length > 4000 ? 0.25 : 0.45 });
  return "";
}

function drawBorders(app, pen, ink) {
  if (app.stage.space === "space") return "";
  const { border } = app.topology;
  const step = Math.ceil(border.length / 2 / BORDER_DRAWN);
  const drawn = step > 1 ? border.filter((_, i) => (i >> 1) % step === 0) : border;
  pen.edges(drawn, ink, BORDER);
  return step > 1 ? `one border edge of ${step} is drawn` : "";
}

function drawCross(context, [width, height], colour) {
  context.beginPath();
  context.moveTo(width / 2 - 12, height / 2);
  context.lineTo(width / 2 + 12, height / 2);
  context.moveTo(width / 2, height / 2 - 12);
  context.lineTo(width / 2, height / 2 + 12);
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.stroke();
}
