// stage.js - the picture of the mesh: drawn by the engine, moved by mouse, fingers and keys.

const SLOW = 45; // milliseconds that a picture may take while it moves
const IDLE = 90; // milliseconds after the last movement
const CLICK = 5; // pixels that a finger may slip
const EDGES = 12000; // triangles whose edges are drawn
const SUN = [-0.5, 0.5, 0.7071]; // from the north-west, 45 degrees high

/** The picture with its camera. */
class Stage {
  /** `layers`: spaceLines() are the lines that the engine draws in space, lines() draws those into
   * the picture in the plane, above() what lies above the picture. */
  constructor(layers, acts) {
    this.canvas = byId("picture");
    this.overlay = byId("overlay");
    this.layers = layers;
    this.acts = acts; // click(point), hover(point)
    this.cameras = { plane: new PlaneCamera(), space: new SpaceCamera() };
    this.space = "plane";
    this.took = 0;
    this.pointers = new Map();
    this.listen();
  }

  get camera() {
    return this.cameras[this.space];
  }

  show(mesh, topology) {
    if (this.picture) this.picture.free();
    this.picture = new Picture(mesh);
    this.picture.setBorders(topology.links);
    this.topology = topology;
    this.shot = null;
    this.resize();
    this.fit();
  }

  resize() {
    const { clientWidth, clientHeight } = byId("stage");
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.ratio = ratio;
    for (const canvas of [this.canvas, this.overlay]) {
      canvas.width = Math.max(1, Math.round(clientWidth * ratio));
      canvas.height = Math.max(1, Math.round(clientHeight * ratio));
    }
    for (const camera of Object.values(this.cameras)) camera.size = [clientWidth, clientHeight];
    if (this.picture) this.picture.resize(this.canvas.width, this.canvas.height);
    this.shot = null;
    this.redraw();
  }

  fit(box = this.topology && this.topology.extent()) {
    if (!box) return;
    this.camera.fit(box.low, box.high);
    this.redraw();
  }

  /** Show a place of the mesh with some of what lies round it. */
  goTo({ low, high }) {
    const size = Math.max(...[0, 1, 2].map((k) => high[k] - low[k]));
    const margin = size > 0 ? 1.2 * size : 1;
    this.fit({ low: low.map((v) => v - margin), high: high.map((v) => v + margin) });
  }

  setLight(on) {
    this.lit = on;
    if (!this.picture) return;
    this.picture.setLight(on ? SUN : null, this.space === "space");
    this.redraw();
  }

  setSpace(space) {
    this.space = space;
    this.shot = null;
    this.setLight(this.lit);
    this.fit();
  }

  /** Draw soon. While a slow picture moves, the last one is moved instead. */
  redraw() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = 0;
      if (this.picture) this.drawNow();
    });
  }

  drawNow() {
    clearTimeout(this.idle);
    if (this.shot && this.took > SLOW && this.space === "plane" && this.moving) {
      this.drawShot();
      this.idle = setTimeout(() => this.drawFull(), IDLE);
    } else {
      this.drawFull();
    }
  }

  drawFull() {
    const begin = performance.now();
    const { width, height } = this.canvas;
    const pixels = this.picture.draw(this.camera.matrix(this.ratio), this.space === "space",
      this.layers.spaceLines());
    const image = new ImageData(pixels, width, height);
    const context = this.canvas.getContext("2d");
    context.putImageData(image, 0, 0);
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    this.layers.lines(context, this.camera);
    context.resetTransform();
    this.took = performance.now() - begin;
    this.keepShot();
    this.moving = false;
    this.drawOverlay();
  }

  /** The mesh in space as another camera sees it: ImageData of a size. */
  shoot(camera, width, height) {
    this.picture.resize(width, height);
    const pixels = this.picture.draw(camera.matrix(this.ratio), true, this.layers.spaceLines());
    this.picture.resize(this.canvas.width, this.canvas.height);
    this.redraw();
    return new ImageData(pixels, width, height);
  }

  keepShot() {
    if (this.took <= SLOW || this.space !== "plane") {
      this.shot = null;
      return;
    }
    const copy = document.createElement("canvas");
    copy.width = this.canvas.width;
    copy.height = this.canvas.height;
    copy.getContext("2d").drawImage(this.canvas, 0, 0);
    this.shot = { copy, centre: this.camera.centre.slice(), scale: this.camera.scale };
  }

  drawShot() {
    const { copy, centre, scale } = this.shot;
    const context = this.canvas.getContext("2d");
    const factor = this.camera.scale / scale;
    const [x, y] = this.camera.toScreen(centre).map((value) => value * this.ratio);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(copy, x - (factor * copy.width) / 2, y - (factor * copy.height) / 2,
      factor * copy.width, factor * copy.height);
    this.drawOverlay();
  }

  drawOverlay() {
    const context = this.overlay.getContext("2d");
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.clearRect(0, 0, this.overlay.width, this.overlay.height);
    this.layers.above(context, this.camera);
  }

  /** The triangles whose edges are worth drawing; null: too many. */
  edgeTriangles() {
    if (this.picture.visible > EDGES) return null;
    return this.picture.list(EDGES);
  }

  // --- mouse, fingers, keys ---

  listen() {
    const on = (name, act, options) => this.overlay.addEventListener(name, act, options);
    on("pointerdown", (event) => this.pointerDown(event));
    on("pointermove", (event) => this.pointerMove(event));
    on("pointerup", (event) => this.pointerUp(event));
    on("pointercancel", (event) => this.pointers.delete(event.pointerId));
    on("pointerleave", () => this.acts.hover(null));
    on("wheel", (event) => this.wheel(event), { passive: false });
    on("keydown", (event) => this.key(event));
    byId("zoom-in").addEventListener("click", () => this.zoom(1.5));
    byId("zoom-out").addEventListener("click", () => this.zoom(1 / 1.5));
    byId("zoom-fit").addEventListener("click", () => this.fit());
    new ResizeObserver(() => this.resize()).observe(byId("stage"));
  }

  place(event) {
    const box = this.overlay.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  pointerDown(event) {
    this.overlay.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, this.place(event));
    this.slipped = this.pointers.size > 1 ? Infinity : 0;
  }

  pointerMove(event) {
    const now = this.place(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      this.acts.hover(now);
      return;
    }
    if (this.pointers.size > 1) this.pinch(event.pointerId, before, now);
    else this.drag(before, now);
    this.pointers.set(event.pointerId, now);
  }

  drag(before, now) {
    const by = [now[0] - before[0], now[1] - before[1]];
    this.slipped += Math.hypot(...by);
    if (this.slipped > CLICK) this.move(...by);
  }

  /** Two fingers: the other one stays. */
  pinch(id, before, now) {
    const [, other] = [...this.pointers].find(([key]) => key !== id);
    const length = (at) => Math.max(1, Math.hypot(at[0] - other[0], at[1] - other[1]));
    this.zoom(length(now) / length(before), other);
  }

  pointerUp(event) {
    const at = this.place(event);
    this.pointers.delete(event.pointerId);
    if (this.slipped <= CLICK) this.acts.click(at);
  }

  wheel(event) {
    event.preventDefault();
    const step = event.deltaMode === 1 ? 30 * event.deltaY : event.deltaY;
    this.zoom(Math.exp(-0.0016 * step), this.place(event));
  }

  move(dx, dy) {
    this.camera.move(dx, dy);
    this.moving = true;
    this.redraw();
  }

  zoom(factor, at) {
    this.camera.zoom(factor, at);
    this.moving = true;
    this.redraw();
  }

  key(event) {
    const ways = {
      ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40],
    };
    const middle = this.camera.size.map((side) => side / 2);
    if (ways[event.key]) this.move(...ways[event.key]);
    else if (event.key === "+" || event.key === "=") this.zoom(1.3);
    else if (event.key === "-") this.zoom(1 / 1.3);
    else if (event.key === "0") this.fit();
    else if (event.key === "Enter" || event.key === " ") this.acts.click(middle);
    else return;
    this.keyboard = true;
    event.preventDefault();
  }
}
