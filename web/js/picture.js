// picture.js - a mesh drawn into pixels by the engine.
import { NONE, numberOrNull } from "./numbers.js";

const COLOURS = 256;

const pixelOf = ([r, g, b]) => (0xff000000 | (b << 16) | (g << 8) | r) >>> 0;

/** A picture of one mesh. Release it with free(), before the mesh. */
export class Picture {
  constructor(mesh) {
    this.engine = mesh.engine;
    this.address = this.engine.call.web_picture_make(mesh.address);
    if (!this.address) throw new Error("there is not enough memory to draw this mesh");
    this.values = 0;
    this.width = 0;
    this.height = 0;
  }

  free() {
    this.engine.call.web_picture_free(this.address);
    if (this.values) this.engine.free(this.values);
    this.address = 0;
  }

  resize(width, height) {
    if (width === this.width && height === this.height) return;
    if (!this.engine.call.web_picture_resize(this.address, width, height))
      throw new Error("there is not enough memory for a picture of this size");
    this.width = width;
    this.height = height;
  }

  /** Colours as [red, green, blue] from 0 to 255: 256 of values, of missing ones, of none. */
  setPalette(colours, missing, plain) {
    const address = this.engine.call.web_picture_palette(this.address);
    const all = this.engine.numbers(address, COLOURS + 2);
    [...colours, missing, plain].forEach((colour, i) => { all[i] = pixelOf(colour); });
  }

  /** Colour by values of vertices or triangles; null: by none. */
  setValues(values, ofTriangles, low, high) {
    const { engine } = this;
    if (this.values) engine.free(this.values);
    this.values = 0;
    if (values) {
      const copy = Float64Array.from(values);
      this.values = engine.alloc(8 * copy.length);
      engine.doubles(this.values, copy.length).set(copy);
    }
    engine.call.web_picture_values(this.address, this.values, ofTriangles ? 1 : 0, low, high);
  }

  /** Light from a direction, or none (null); heights are multiplied by `lift`. */
  setLight(direction, inSpace, lift = 1) {
    const [x, y, z] = direction || [0, 0, 1];
    this.engine.call.web_picture_light(this.address, direction ? 1 : 0, inSpace ? 1 : 0, lift,
      x, y, z);
  }

  /** The edges on borders, as links of the mesh tell them: NONE. */
  setBorders(links) {
    const address = this.engine.call.web_picture_borders(this.address);
    const masks = this.engine.bytes(address, Math.floor(links.length / 3)).fill(0);
    links.forEach((link, i) => {
      if (link === NONE) masks[Math.floor(i / 3)] |= 1 << (i % 3);
    });
  }

  /** Draw by a matrix of three rows of four; a copy of the pixels, for ImageData. In space `lines`
   * adds borders, and edges where at most `most` triangles have a part; hidden ones stay hidden. */
  draw(matrix, inSpace, lines = null) {
    const { engine } = this;
    engine.withDoubles(matrix, (address) =>
      engine.call.web_picture_draw(this.address, address, inSpace ? 1 : 0));
    if (inSpace && lines) {
      const { ink, edge = 0, border = 0, alpha = 1, most = Infinity } = lines;
      engine.call.web_picture_edges(this.address, pixelOf(ink), this.visible > most ? 0 : edge,
        border, alpha);
    }
    const count = 4 * this.width * this.height;
    const pixels = engine.bytes(engine.call.web_picture_pixels(this.address), count);
    return new Uint8ClampedArray(pixels);
  }

  /** How many triangles have a part in the last picture. */
  get visible() {
    return this.engine.call.web_picture_visible(this.address);
  }

  /** The numbers of those triangles. */
  list(most) {
    const { engine } = this;
    return engine.withRoom(4 * most, (room) => {
      const count = engine.call.web_picture_list(this.address, room, most);
      return engine.numbers(room, count).slice();
    });
  }

  /** The triangle at a pixel of the last picture; null: none. */
  triangleAt(x, y) {
    if (x < 0 || y < 0 || x >= this.width || y >= this.height) return null;
    const all = this.engine.call.web_picture_numbers(this.address);
    const [number] = this.engine.numbers(all + 4 * (y * this.width + x), 1);
    return numberOrNull(number, NONE);
  }
}
