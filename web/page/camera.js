// camera.js - from the mesh to pixels and back, in the plane and in space.

const SMALLEST = 1e-12;

/** Looks down on the plane. Sizes are in pixels of the style. */
class PlaneCamera {
  constructor() {
    this.centre = [0, 0];
    this.scale = 1;
    this.size = [1, 1];
  }

  fit(low, high) {
    const extent = [0, 1].map((k) => Math.max(high[k] - low[k], SMALLEST));
    this.centre = [0, 1].map((k) => (low[k] + high[k]) / 2);
    this.scale = 0.88 * Math.min(this.size[0] / extent[0], this.size[1] / extent[1]);
  }

  copy() {
    return Object.assign(new PlaneCamera(), this);
  }

  toScreen([x, y]) {
    return [this.size[0] / 2 + this.scale * (x - this.centre[0]),
      this.size[1] / 2 - this.scale * (y - this.centre[1])];
  }

  toMesh([x, y]) {
    return [this.centre[0] + (x - this.size[0] / 2) / this.scale,
      this.centre[1] - (y - this.size[1] / 2) / this.scale];
  }

  move(dx, dy) {
    this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale];
  }

  zoom(factor, at = [this.size[0] / 2, this.size[1] / 2]) {
    const fixed = this.toMesh(at);
    this.scale *= factor;
    const now = this.toMesh(at);
    this.centre = [0, 1].map((k) => this.centre[k] + fixed[k] - now[k]);
  }

  /** The matrix of a picture with `ratio` pixels per pixel of the style. */
  matrix(ratio) {
    const s = this.scale * ratio;
    const [width, height] = this.size;
    return [s, 0, 0, (ratio * width) / 2 - s * this.centre[0],
      0, -s, 0, (ratio * height) / 2 + s * this.centre[1], 0, 0, 0, 0];
  }
}

/** Turns round a middle in space, without perspective. */
class SpaceCamera {
  constructor() {
    this.middle = [0, 0, 0];
    this.yaw = 0.6;
    this.pitch = 0.7;
    this.scale = 1;
    this.shift = [0, 0];
    this.size = [1, 1];
  }

  fit(low, high) {
    const extent = Math.hypot(...[0, 1, 2].map((k) => high[k] - low[k]));
    this.middle = [0, 1, 2].map((k) => (low[k] + high[k]) / 2);
    this.scale = (0.95 * Math.min(...this.size)) / Math.max(extent, SMALLEST);
    this.shift = [0, 0];
  }

  copy() {
    return Object.assign(new SpaceCamera(), this);
  }

  axes() {
    const [sy, cy] = [Math.sin(this.yaw), Math.cos(this.yaw)];
    const [sp, cp] = [Math.sin(this.pitch), Math.cos(this.pitch)];
    const right = [cy, sy, 0];
    const up = [-sy * sp, cy * sp, cp];
    const away = [-sy * cp, cy * cp, -sp];
    return [right, up, away];
  }

  toScreen(point) {
    const [right, up] = this.axes();
    const along = (axis) => axis.reduce((sum, a, k) => sum + a * (point[k] - this.middle[k]), 0);
    return [this.size[0] / 2 + this.shift[0] + this.scale * along(right),
      this.size[1] / 2 + this.shift[1] - this.scale * along(up)];
  }

  /** Look against a direction, so that what faces it is seen. */
  face([x, y, z]) {
    const length = Math.hypot(x, y, z);
    if (!(length > 0)) return;
    this.yaw = Math.atan2(x, -y);
    this.pitch = Math.asin(z / length);
  }

  /** The line of sight through a place of the screen: a point of it, and its direction. */
  sight([x, y]) {
    const [right, up, away] = this.axes();
    const across = (x - this.size[0] / 2 - this.shift[0]) / this.scale;
    const above = -(y - this.size[1] / 2 - this.shift[1]) / this.scale;
    const point = [0, 1, 2].map((k) => this.middle[k] + across * right[k] + above * up[k]);
    return { point, away };
  }

  move(dx, dy) {
    this.yaw -= dx * 0.01;
    this.pitch = Math.max(-1.57, Math.min(1.57, this.pitch + dy * 0.01));
  }

  zoom(factor) {
    this.scale *= factor;
    this.shift = this.shift.map((part) => part * factor);
  }

  matrix(ratio) {
    const [right, up, away] = this.axes();
    const s = this.scale * ratio;
    const row = (axis, factor, begin) => {
      const dot = axis.reduce((sum, a, k) => sum + a * this.middle[k], 0);
      return [...axis.map((a) => a * factor), begin - factor * dot];
    };
    return [...row(right, s, ratio * (this.size[0] / 2 + this.shift[0])),
      ...row(up, -s, ratio * (this.size[1] / 2 + this.shift[1])), ...row(away, s, 0)];
  }
}
