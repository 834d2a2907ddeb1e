// engine.js - the WebAssembly module: memory, texts, errors.
import { Files } from "./files.js";

const STATUSES = ["ok", "argument", "input", "memory", "limit", "system", "cancelled"];

/** What a call of the engine refused, and where. */
export class MeshwalkError extends Error {
  constructor(message, status, place) {
    super(message);
    this.name = "MeshwalkError";
    this.status = status; // "argument", "input", "memory", "limit", "system"
    this.triangle = place.triangle; // numbers, or null
    this.vertex = place.vertex;
    this.line = place.line;
  }
}

/** An instance of the engine. Addresses are numbers; what is allocated is released by free. */
export class Engine {
  constructor(instance, files) {
    this.call = instance.exports;
    this.files = files;
  }

  static async create(source) {
    const engine = new Engine({ exports: {} }, null);
    engine.files = new Files(() => engine.call.memory);
    const imports = { wasi_snapshot_preview1: engine.files.imports() };
    const made = await WebAssembly.instantiate(source, imports);
    engine.call = (made.instance || made).exports;
    engine.call._initialize();
    return engine;
  }

  doubles(address, count) {
    return new Float64Array(this.call.memory.buffer, address, count);
  }

  numbers(address, count) {
    return new Uint32Array(this.call.memory.buffer, address, count);
  }

  bytes(address, count) {
    return new Uint8Array(this.call.memory.buffer, address, count);
  }

  view(address, count) {
    return new DataView(this.call.memory.buffer, address, count);
  }

  /** A text of the engine; null for the address 0. */
  text(address) {
    if (!address) return null;
    const all = new Uint8Array(this.call.memory.buffer, address);
    return new TextDecoder().decode(all.subarray(0, all.indexOf(0)));
  }

  alloc(size) {
    const address = this.call.web_alloc(size);
    if (!address) throw new MeshwalkError("there is not enough memory", "memory", {});
    return address;
  }

  free(address) {
    this.call.web_free(address);
  }

  /** Call work(address) with room that is released afterwards. */
  withRoom(size, work) {
    const address = this.alloc(size);
    try {
      return work(address);
    } finally {
      this.free(address);
    }
  }

  /** Bytes that zlib packed: { size, packed } with base64. */
  unpack({ size, packed }) {
    const text = atob(packed);
    const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
    return this.withRoom(bytes.length, (from) => this.withRoom(size, (to) => {
      this.bytes(from, bytes.length).set(bytes);
      if (size && !this.call.web_unpack(from, bytes.length, to, size))
        throw new MeshwalkError("the page is damaged", "input", {});
      return this.bytes(to, size).slice();
    }));
  }

  withText(text, work) {
    const bytes = new TextEncoder().encode(text + "\0");
    return this.withRoom(bytes.length, (address) => {
      this.bytes(address, bytes.length).set(bytes);
      return work(address);
    });
  }

  withDoubles(values, work) {
    return this.withRoom(8 * values.length, (address) => {
      this.doubles(address, values.length).set(values);
      return work(address);
    });
  }

  /** The result of a call, or the engine's error where it is 0. */
  need(result) {
    if (result) return result;
    const place = (what) => {
      const number = this.call.web_error_place(what);
      return number < 0 ? null : number;
    };
    const status = STATUSES[this.call.web_error_status()];
    const message = this.text(this.call.web_error_message());
    throw new MeshwalkError(message, status,
      { triangle: place(0), vertex: place(1), line: place(2) });
  }

  /** Call work with files present; { name: bytes }. */
  withFiles(files, work) {
    for (const [name, bytes] of Object.entries(files)) this.files.add(name, bytes);
    try {
      return work();
    } finally {
      this.files.clear();
    }
  }
}
