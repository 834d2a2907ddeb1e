// files.js - files in memory, as WASI's functions: what the engine's readers open.

const OK = 0;
const BAD_DESCRIPTOR = 8;
const NOT_FOUND = 44;
const NOT_SUPPORTED = 58;
const ROOT = 3;
const DIRECTORY = 3;
const REGULAR = 4;

/** A little file system without folders. `memory` gives the engine's memory. */
export class Files {
  constructor(memory) {
    this.memory = memory;
    this.contents = new Map(); // name: Uint8Array
    this.open = new Map(); // descriptor: { bytes, at }
    this.next = ROOT + 1;
    this.clock = () => (typeof performance === "undefined" ? Date.now() : performance.now());
  }

  /** Make a file known under a name. */
  add(name, bytes) {
    this.contents.set(name, bytes);
  }

  clear() {
    this.contents.clear();
  }

  view() {
    return new DataView(this.memory().buffer);
  }

  text(address, length) {
    return new TextDecoder().decode(new Uint8Array(this.memory().buffer, address, length));
  }

  /** The functions that the engine imports; those that it never calls for reading refuse. */
  imports() {
    const names = ["fd_close", "fd_fdstat_get", "fd_filestat_get", "fd_prestat_get", "fd_read",
      "fd_prestat_dir_name", "fd_seek", "fd_tell", "fd_write", "path_filestat_get", "path_open",
      "clock_time_get", "environ_get", "environ_sizes_get", "proc_exit"];
    const functions = {};
    for (const name of names) functions[name] = this[name].bind(this);
    const refuse = () => NOT_SUPPORTED;
    return new Proxy(functions, { get: (all, name) => all[name] || refuse });
  }

  environ_get() {
    return OK;
  }

  environ_sizes_get(count, size) {
    this.view().setUint32(count, 0, true);
    this.view().setUint32(size, 0, true);
    return OK;
  }

  clock_time_get(clock, precision, result) {
    this.view().setBigUint64(result, BigInt(Math.round(this.clock() * 1e6)), true);
    return OK;
  }

  proc_exit(code) {
    throw new Error(`the engine ended with ${code}`);
  }

  fd_prestat_get(descriptor, result) {
    if (descriptor !== ROOT) return BAD_DESCRIPTOR;
    this.view().setUint32(result, 0, true);
    this.view().setUint32(result + 4, 1, true);
    return OK;
  }

  fd_prestat_dir_name(descriptor, name) {
    this.view().setUint8(name, "/".charCodeAt(0));
    return OK;
  }

  fd_fdstat_get(descriptor, result) {
    const view = this.view();
    if (descriptor !== ROOT && !this.open.has(descriptor)) return BAD_DESCRIPTOR;
    for (let i = 0; i < 24; i++) view.setUint8(result + i, 0);
    view.setUint8(result, descriptor === ROOT ? DIRECTORY : REGULAR);
    view.setBigUint64(result + 8, 0x1fffffffn, true);
    view.setBigUint64(result + 16, 0x1fffffffn, true);
    return OK;
  }

  tellStatus(bytes, result) {
    const view = this.view();
    for (let i = 0; i < 64; i++) view.setUint8(result + i, 0);
    view.setUint8(result + 16, bytes ? REGULAR : DIRECTORY);
    view.setBigUint64(result + 24, 1n, true);
    view.setBigUint64(result + 32, BigInt(bytes ? bytes.length : 0), true);
    return OK;
  }

  fd_filestat_get(descriptor, result) {
    if (descriptor === ROOT) return this.tellStatus(null, result);
    const file = this.open.get(descriptor);
    return file ? this.tellStatus(file.bytes, result) : BAD_DESCRIPTOR;
  }

  path_filestat_get(descriptor, flags, path, length, result) {
    const bytes = this.contents.get(this.text(path, length));
    return bytes ? this.tellStatus(bytes, result) : NOT_FOUND;
  }

  path_open(descriptor, lookup, path, length, flags, rights, inheriting, how, result) {
    const bytes = this.contents.get(this.text(path, length));
    if (!bytes) return NOT_FOUND;
    this.open.set(this.next, { bytes, at: 0 });
    this.view().setUint32(result, this.next++, true);
    return OK;
  }

  fd_close(descriptor) {
    return this.open.delete(descriptor) ? OK : BAD_DESCRIPTOR;
  }

  fd_read(descriptor, buffers, count, result) {
    const file = this.open.get(descriptor);
    const view = this.view();
    let total = 0;
    if (!file) return BAD_DESCRIPTOR;
    for (let i = 0; i < count; i++) {
      const address = view.getUint32(buffers + 8 * i, true);
      const room = view.getUint32(buffers + 8 * i + 4, true);
      const part = file.bytes.subarray(file.at, file.at + room);
      new Uint8Array(view.buffer, address, room).set(part);
      file.at += part.length;
      total += part.length;
    }
    view.setUint32(result, total, true);
    return OK;
  }

  fd_seek(descriptor, offset, whence, result) {
    const file = this.open.get(descriptor);
    if (!file) return BAD_DESCRIPTOR;
    const begin = [0, file.at, file.bytes.length][whence];
    file.at = Math.max(0, begin + Number(offset));
    this.view().setBigUint64(result, BigInt(file.at), true);
    return OK;
  }

  fd_tell(descriptor, result) {
    return this.fd_seek(descriptor, 0, 1, result);
  }

  fd_write() {
    return NOT_SUPPORTED;
  }
}
