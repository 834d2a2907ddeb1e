// compare.mjs MODULE MESHWALK DATA: the engine in WebAssembly answers as the program does, bit for
// bit, and reads the same files.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { constants, gzipSync } from "node:zlib";
import { loadMeshwalk, Locations, MeshwalkError } from "../js/meshwalk.js";

const [modulePath, program, data] = process.argv.slice(2);
const COUNT = 1000000; // answers
const NONE = 0xffffffff;
const scratch = mkdtempSync(join(tmpdir(), "meshwalk-web-"));
const meshwalk = await loadMeshwalk(readFileSync(modulePath));

const OUTPUT = { encoding: "latin1", maxBuffer: 1 << 30, stdio: ["ignore", "pipe", "pipe"] };
const run = (...words) => execFileSync(program, words, OUTPUT);
const inScratch = (name) => join(scratch, name);

// Positions in and round a box, and some vertices and middles of edges, where ties are.
function positions(mesh, count) {
  const { low, high } = mesh.describe();
  const { points } = mesh;
  const xy = new Float64Array(2 * count);
  let state = 12345;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 4294967296;
  for (let i = 0; i < count; i++) {
    const a = 3 * Math.floor(random() * mesh.vertexCount);
    const b = 3 * Math.floor(random() * mesh.vertexCount);
    for (let k = 0; k < 2; k++) {
      if (i % 10 === 0) xy[2 * i + k] = points[a + k];
      else if (i % 10 === 1) xy[2 * i + k] = (points[a + k] + points[b + k]) / 2;
      else xy[2 * i + k] = low[k] + (random() * 1.02 - 0.01) * (high[k] - low[k]);
    }
  }
  return xy;
}

function writePositions(path, xy) {
  const rows = ["x,y"];
  for (let i = 0; i < xy.length; i += 2) rows.push(`${xy[i]},${xy[i + 1]}`);
  writeFileSync(path, rows.join("\n") + "\n");
}

function compareRow(row, at, i) {
  const [status, triangle, ...weights] = row;
  assert.equal(Locations.names[at.where[i]], status, `status of point ${i}`);
  const number = at.triangle[i] === NONE ? -1 : at.triangle[i];
  assert.equal(number, Number(triangle), `triangle of point ${i}`);
  weights.forEach((weight, k) => {
    const expected = weight === "" ? NaN : Number(weight);
    assert.ok(Object.is(at.weights[3 * i + k], expected), `weight ${k} of point ${i}`);
  });
}

function compareAnswers(mesh, path, count) {
  const xy = positions(mesh, count);
  writePositions(inScratch("positions.csv"), xy);
  const lines = run("locate", path, inScratch("positions.csv")).trimEnd().split("\n").slice(1);
  const locator = meshwalk.createLocator(mesh);
  const at = locator.locate(xy);
  assert.equal(lines.length, count);
  lines.forEach((line, i) => compareRow(line.split(",").slice(2), at, i));
  locator.free();
  return count;
}

// A walk from one point to another has the triangles that the program lists.
function compareWalks(mesh, path, from, to) {
  for (const { name } of meshwalk.walks) {
    const fill = name === "border" ? "open" : "filled";
    const locator = meshwalk.createLocator(mesh, { fill });
    const walk = locator.follow(from, to, { walk: name });
    const listed = run("walk", path, "--walk", name, "--from", from.join(), "--to", to.join())
      .trimEnd().split("\n").slice(1).map((line) => Number(line.split(",")[1]));
    assert.deepEqual(Array.from(walk.triangles), listed, `walk ${name}`);
    locator.free();
  }
}

// Walks of probes and of rays have the triangles that the program lists.
function compareSpace(path, from, to) {
  const mesh = meshwalk.readMesh("octahedron.off", readFileSync(path));
  const surface = meshwalk.createSurface(mesh, { weld: true });
  const motion = to.map((value, k) => value - from[k]);
  const listed = (...words) => run("walk", path, "--from", from.join(), "--to", to.join(), ...words)
    .trimEnd().split("\n").slice(1).map((line) => line.split(",").map(Number));
  const probe = surface.probe(from, motion);
  const told = listed("--as", "surface", "--weld");
  assert.deepEqual(Array.from(probe.triangles), told.map(([, triangle]) => triangle));
  assert.deepEqual(Array.from(probe.iterations), told.map(([, , iteration]) => iteration));
  assert.equal(surface.probe(from, motion, { certain: true }).state, "hit");
  surface.setCentre([0, 0, 0]);
  for (const [as, centre] of [["star", "0,0,0"], ["star", "0,0,5"], ["surface", null]]) {
    const how = centre ? ["--as", as, "--centre", centre] : ["--as", as];
    const { stdout } = spawnSync(program, ["check", "--json", ...how, path], OUTPUT);
    const own = mesh.check(as, centre ? centre.split(",").map(Number) : undefined);
    assert.deepEqual(own.defects.map((defect) => [defect.kind, defect.text]),
      JSON.parse(stdout).defects.map((defect) => [defect.kind, defect.text]));
  }
  for (const { name } of meshwalk.starWalks) {
    const way = surface.followRay(from, to, { walk: name });
    assert.deepEqual(Array.from(way.triangles),
      listed("--as", "star", "--walk", name).map(([, triangle]) => triangle), `star walk ${name}`);
  }
  surface.free();
  mesh.free();
}

const OCTAHEDRON = `OFF
6 8 0
1 0 0
-1 0 0
0 1 0
0 -1 0
0 0 1
0 0 -1
3 0 2 4
3 2 1 4
3 1 3 4
3 3 0 4
3 2 0 5
3 1 2 5
3 3 1 5
3 0 3 5
`;

function compareDefects(bytes, name, path) {
  const mesh = meshwalk.readMesh(name, bytes);
  let json = "";
  try {
    json = run("check", "--json", path);
  } catch (failure) {
    json = failure.stdout;
  }
  const { defects } = JSON.parse(json);
  assert.deepEqual(mesh.check().defects.map((defect) => defect.text),
    defects.map((defect) => defect.text));
  mesh.free();
  return defects.length;
}

// The reader's message, as the program prints it behind its name.
function compareMessage(name, text) {
  writeFileSync(inScratch(name), text);
  let message = "";
  try {
    run("info", inScratch(name));
  } catch (failure) {
    message = failure.stderr;
  }
  assert.ok(message, `${name} is refused`);
  assert.throws(() => meshwalk.readMesh(name, Buffer.from(text)), (error) => {
    assert.ok(error instanceof MeshwalkError);
    assert.ok(message.includes(error.message), `${message} has no: ${error.message}`);
    return true;
  });
}

// Every way to pack, and what damage there is: cut off, a wrong sum, a wrong bit.
function comparePacked(bytes) {
  const { triangleCount } = meshwalk.readMesh("plain.off", bytes);
  const ways = [{ level: 0 }, { strategy: constants.Z_FIXED }, { level: 9 }, { level: 1 }];
  for (const way of ways) {
    const packed = gzipSync(bytes, way);
    assert.equal(meshwalk.readMesh("packed.off", packed).triangleCount, triangleCount);
    compareMessage("cut.off.gz", packed.subarray(0, packed.length - 9));
    const wrong = Buffer.from(packed);
    wrong[wrong.length - 6] ^= 1;
    compareMessage("sum.off.gz", wrong);
  }
}

// The program in docs/web.md prints what stands there.
function compareDocumentation() {
  const page = readFileSync(new URL("../../docs/web.md", import.meta.url), "utf8");
  const [, block, output] = page.match(/```js\n([^]*?)```\n\n```output\n([^]*?)```/);
  const source = fileURLToPath(new URL("../..", import.meta.url));
  const text = block.replace("build/release/web/meshwalk.wasm", modulePath)
    .replace("./web/js/", new URL("../js/", import.meta.url).href);
  writeFileSync(inScratch("documentation.mjs"), text);
  assert.equal(execFileSync(process.execPath, [inScratch("documentation.mjs")],
    { encoding: "utf8", cwd: source }), output);
}

// Every class and method of meshwalk.d.ts is there, and the other way round.
async function compareDeclarations() {
  const text = readFileSync(new URL("../js/meshwalk.d.ts", import.meta.url), "utf8");
  const interfaces = await import("../js/meshwalk.js");
  const declared = [...text.matchAll(/^export (?:class|function|const) (\w+)/gm)];
  assert.deepEqual(declared.map(([, name]) => name).sort(), Object.keys(interfaces).sort());
  for (const [, name, body] of text.matchAll(/^export class (\w+)[^{]*\{\n([^]*?)^\}/gm))
    for (const [, method] of body.matchAll(/^ {2}(\w+)\(/gm))
      if (method !== "constructor")
        assert.equal(typeof interfaces[name].prototype[method], "function", `${name}.${method}`);
}

function compareNetcdf() {
  const file = Buffer.concat([Buffer.from("CDF\x01"), Buffer.alloc(64)]);
  assert.throws(() => meshwalk.readMesh("ocean.nc", file), /netCDF files cannot be read here/);
}

function compareTerrain() {
  const path = inScratch("terrain.ply");
  run("triangulate", join(data, "jacksboro.csv"), "-q", "-o", path);
  const bytes = readFileSync(path);
  const mesh = meshwalk.readMesh("terrain.ply", bytes);
  const packed = meshwalk.readMesh("terrain.ply.gz", gzipSync(bytes));
  assert.deepEqual(packed.points, mesh.points);
  const answers = compareAnswers(mesh, path, COUNT);
  compareWalks(mesh, path, [1000, 1000], [20000, 25000]);
  packed.free();
  mesh.free();
  return answers;
}

const FORMATS = ["off", "obj", "node", "vtk", "vtu", "fort.14", "gr3", "2dm", "msh"];

// What the program writes, the engine reads: every format that keeps a plane mesh.
function compareFormats() {
  const trap = join(data, "trap.off");
  const expected = meshwalk.readMesh("trap.off", readFileSync(trap));
  for (const format of FORMATS) {
    const name = format === "fort.14" ? "trap.14" : `trap.${format}`;
    run("convert", trap, "-q", "-o", inScratch(name));
    const beside = format === "node" ? { "trap.ele": readFileSync(inScratch("trap.ele")) } : {};
    const mesh = meshwalk.readMesh(name, readFileSync(inScratch(name)), beside);
    assert.deepEqual(mesh.triangles, expected.triangles, name);
    assert.equal(mesh.vertexCount, expected.vertexCount, name);
    mesh.free();
  }
  expected.free();
}

try {
  const answers = compareTerrain();
  compareFormats();
  const trap = join(data, "trap.off");
  const mesh = meshwalk.readMesh("trap.off", readFileSync(trap));
  compareWalks(mesh, trap, [0.9, 0.1], [0.5, 0.5]);
  const folded = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0.4 0.4 0\n3 0 1 2\n3 0 1 3\n3 1 2 3\n";
  writeFileSync(inScratch("folded.off"), folded);
  assert.ok(compareDefects(Buffer.from(folded), "folded.off", inScratch("folded.off")) > 0);
  compareMessage("damaged.off", "OFF\n3 1 0\n0 0 0\n1 0 zero\n");
  compareMessage("short.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
  writeFileSync(inScratch("octahedron.off"), OCTAHEDRON);
  compareSpace(inScratch("octahedron.off"), [0.3, 0.2, 2], [-0.4, -0.5, -0.6]);
  compareDocumentation();
  await compareDeclarations();
  compareNetcdf();
  comparePacked(readFileSync(trap));
  console.log(`${answers} answers are equal, bit for bit`);
} finally {
  rmSync(scratch, { recursive: true });
}
