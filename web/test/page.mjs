// page.mjs BROWSER MESHWALK DATA PAGE: the page of `meshwalk view` in a headless browser. It loads
// without a fault, its clicks give the answers of the command line, a damaged file gives the
// reader's message.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser } from "./browser.mjs";

const [chromium, program, data, emptyPage] = process.argv.slice(2);
const scratch = mkdtempSync(join(tmpdir(), "meshwalk-page-"));
const HOW = { encoding: "utf8", cwd: scratch };
const run = (...words) => execFileSync(program, words, HOW);
const refuse = (...words) => spawnSync(program, words, HOW);
const browser = await Browser.start(chromium);

async function openPage(mesh, ...words) {
  run("view", mesh, "-q", "-o", "page.html", ...words);
  await browser.open(join(scratch, "page.html"));
}

/** Where a point of the mesh lies in the window. */
const screenOf = (point) => browser.value(`(() => {
  const box = document.getElementById("overlay").getBoundingClientRect();
  const at = meshwalkPage.stage.camera.toScreen(${JSON.stringify(point)});
  return [at[0] + box.left, at[1] + box.top];
})()`);

async function clickAt(point) {
  await browser.click(...(await screenOf(point)));
}

// The triangle and the weights under a click are those of `locate`.
async function compareClicks(mesh, points) {
  for (const point of points) {
    await clickAt(point);
    const { point: at, location } = await browser.value(
      "({ point: meshwalkPage.here.point, location: meshwalkPage.here.location })");
    writeFileSync(join(scratch, "one.csv"), `x,y\n${at.join()}\n`);
    const [, , status, triangle, ...weights] =
      run("locate", mesh, "one.csv").trimEnd().split("\n")[1].split(",");
    assert.equal(location.where, status);
    assert.equal(location.triangle === null ? -1 : location.triangle, Number(triangle));
    if (location.triangle !== null) assert.deepEqual(location.weights, weights.map(Number));
    const words = await browser.value("document.getElementById('here').textContent");
    assert.ok(words.includes(status), `${words} tells ${status}`);
  }
}

// Two clicks, and the walk has the triangles that `walk` lists.
async function compareWalk(mesh, name, from, to) {
  await browser.press("[data-tool=walk]");
  await browser.value(`document.getElementById("walk-name").value = "${name}"`);
  await clickAt(from);
  await clickAt(to);
  const walk = await browser.value(`({ from: meshwalkPage.walkPanel.from,
    to: meshwalkPage.walkPanel.to, triangles: Array.from(meshwalkPage.walkPanel.walk.triangles),
    ring: meshwalkPage.walkPanel.ring })`);
  const listed = run("walk", mesh, "--walk", name, "--from", walk.from.join(), "--to",
    walk.to.join()).trimEnd().split("\n").slice(1).map((line) => Number(line.split(",")[1]));
  assert.deepEqual(walk.triangles, listed);
  await browser.press("[data-tool=look]");
  return walk.ring;
}

// A click near a vertex means the vertex, where its triangles are a tie.
async function compareTies() {
  await clickAt([0.562, 0.529]);
  const { point, location, ties } = await browser.value(`({ point: meshwalkPage.here.point,
    location: meshwalkPage.here.location, ties: meshwalkPage.here.ties })`);
  assert.deepEqual(point, [0.562, 0.528]);
  assert.equal(location.where, "vertex");
  assert.equal(Math.min(...ties), location.triangle);
  assert.ok(ties.length > 2);
}

// data/README.md: in the ring every other triangle has two edges that the point lies beyond, and
// one of these would lead to it.
async function compareRing(ring) {
  assert.equal(ring.length, 10);
  const seen = [];
  for (let step = ring.begin; step < ring.begin + ring.length; step++) {
    await browser.value(`meshwalkPage.walkPanel.player.goTo(${step})`);
    seen.push((await browser.value("meshwalkPage.walkPanel.step.beyond")).length);
    assert.match(await browser.value("document.getElementById('walk-why').textContent"),
      /beyond edges? .* leaves over edge/);
  }
  assert.deepEqual(seen.slice().sort(), [1, 1, 1, 1, 1, 2, 2, 2, 2, 2]);
  assert.match(await browser.value("document.getElementById('walk-result').textContent"),
    /ring of 10 triangles.* In 5 triangles of the ring the point lies beyond two edges/);
}

async function compareRace() {
  await browser.press("#walk-race");
  const lanes = await browser.value(`meshwalkPage.race.lanes.map((lane) =>
    [lane.name, Boolean(lane.ring)])`);
  const rings = lanes.filter(([, ring]) => ring).map(([name]) => name);
  assert.deepEqual(rings, ["lawson", "remembering", "barycentric", "direct"]);
  assert.equal(lanes.length, 16);
  await browser.key("Escape");
  assert.equal(await browser.value("document.getElementById('race').hidden"), true);
}

async function testTrap() {
  const mesh = join(data, "trap.off");
  await openPage(mesh, "--points", join(data, "trap.csv"));
  assert.match(await browser.value("document.getElementById('verdict').textContent"),
    /an embedding/);
  await compareClicks(mesh, [[0.5, 0.5], [0.2, 0.7], [1.04, 0.5]]);
  await compareTies();
  const ring = await compareWalk(mesh, "lawson", [0.9, 0.1], [0.5, 0.5]);
  await compareRing(ring);
  assert.equal(await compareWalk(mesh, "celestial", [0.9, 0.1], [0.5, 0.5]), null);
  await compareRace();
  await browser.key("?");
  assert.equal(await browser.value("document.activeElement.textContent"), "Keys and gestures");
  assert.equal(await browser.value("meshwalkPage.points.statuses.length"), 16);
}

/** Give the page a file, as if it were dropped. */
const drop = (name, bytes) => browser.value(`(async () => {
  const bytes = Uint8Array.from(atob("${Buffer.from(bytes).toString("base64")}"),
    (c) => c.charCodeAt(0));
  await openPageFiles([new File([bytes], "${name}")]);
})()`);

async function testFiles(shown) {
  await browser.value("window.openPageFiles = (files) => meshwalkPage.openFiles(files)");
  const damaged = "OFF\n3 1 0\n0 0 0\n1 0 zero\n";
  writeFileSync(join(scratch, "damaged.off"), damaged);
  const { stderr } = refuse("info", "damaged.off");
  await drop("damaged.off", damaged);
  const message = await browser.value("document.getElementById('failure').textContent");
  assert.equal(`meshwalk: ${message}`, stderr.trimEnd().split("\n")[0]);
  assert.equal(await browser.value("document.getElementById('file-name').textContent"), shown);
}

// Columns of points are taken if they are clear, else refused, as `locate` does.
async function testColumns(mesh) {
  for (const [text, axes] of [["id,y,x\n1,.5,.2\n", "x,y"], ["1 2\n3 4\n", "x,y"],
    ["name,Lon,Lat\na,.1,.2\n", "Lon,Lat"], ["a,b\n1,2\n", "a,b"], ["1,2,3,4\n", ""],
    ["lon,lat,x,y\n1,2,3,4\n", ""], ["lat,b\n1,2\n", ""], ["a,b,c,d\n1,2,3,4\n", ""]]) {
    await drop("table.csv", text);
    writeFileSync(join(scratch, "table.csv"), text);
    const found = await browser.value(`document.getElementById("failure").hidden
      ? meshwalkPage.points.axes.join() : ""`);
    assert.equal(found, axes, text);
    assert.equal(refuse("locate", mesh, "table.csv").status === 0, axes !== "", text);
  }
  assert.match(await browser.value("document.getElementById('failure').textContent"),
    /table.csv: which of its columns are x,y\? They are: a, b, c, d/);
}

// A fold is listed, led to, and explained.
async function testDefects() {
  const folded = "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0.4 0.4 0\n3 0 1 2\n3 0 1 3\n3 1 2 3\n";
  await drop("folded.off", folded);
  await browser.until("meshwalkPage.mesh.name === 'folded.off'");
  assert.equal(await browser.value("document.getElementById('failure').hidden"), true);
  writeFileSync(join(scratch, "folded.off"), folded);
  const told = refuse("check", "folded.off").stdout;
  const listed = await browser.value(
    "[...document.querySelectorAll('#defects button')].map((button) => button.textContent)");
  assert.deepEqual(listed, told.trimEnd().split("\n").slice(0, -1));
  await browser.press("#defects button");
  const words = await browser.value("document.getElementById('defect-about').textContent");
  assert.match(words, /fold/i);
}

async function testTerrain() {
  run("triangulate", join(data, "jacksboro.csv"), "-q", "-o", "terrain.ply");
  await openPage("terrain.ply");
  await compareClicks("terrain.ply", [[15000, 16000], [4000, 9000], [29000, 30000]]);
  await compareProfile("terrain.ply", [1000, 1000], [29000, 31000]);
  await compareProfile("terrain.ply", [-1000, 1500], [2000, -2500]); // in and out again
  await compareProfile("terrain.ply", [-1000, 1500], [-2000, 2500]); // outside
  await browser.value("meshwalkPage.setSpace('space')");
  await browser.frame();
  assert.ok(await browser.value("meshwalkPage.stage.picture.visible > 1000"));
}

// What is saved is the table of `profile`, but for the names of places.
async function compareProfile(mesh, from, to) {
  for (const point of [from, to]) await browser.value(`meshwalkPage.profile.click([${point}])`);
  const { name, text } = await browser.save("#profile-save");
  assert.equal(name, `${mesh}-profile.csv`);
  writeFileSync(join(scratch, "line.csv"), `x,y\n${from}\n${to}\n`);
  const table = (lines) => lines.trimEnd().split("\n").map((line) => line.split(","));
  const [head, ...rows] = table(text);
  const [, ...expected] = table(run("profile", mesh, "line.csv"));
  assert.deepEqual(head, ["chainage", "x", "y", "z", "triangle"]);
  assert.equal(rows.length, expected.length);
  rows.forEach((row, i) => row.forEach((cell, k) => {
    const told = expected[i][k + 2];
    assert.ok(cell === told || (cell && told && Math.abs(cell - told) < 1e-7),
      `${row} is ${expected[i]}`);
  }));
  const crossed = rows.filter(([, , , , triangle]) => triangle !== "-1").length;
  assert.match(await browser.value("document.getElementById('profile-about').textContent"),
    crossed ? new RegExp(`^z along [\\d,.]+ through ${crossed} triangles`) : /outside/);
}

// Two rays and a probe: the triangles that `walk` lists in space.
async function testSpace() {
  const text = ["OFF", "6 8 0", "1 0 0", "-1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 -1", "3 0 2 4",
    "3 2 1 4", "3 1 3 4", "3 3 0 4", "3 2 0 5", "3 1 2 5", "3 3 1 5", "3 0 3 5", ""].join("\n");
  writeFileSync(join(scratch, "octahedron.off"), text);
  await openPage("octahedron.off", "--as", "star");
  for (const [tool, clicks] of [["ray", [[0, 0, 1], [0.4, -0.4, 0.2]]], ["probe", [[0, 0, 1]]]]) {
    await browser.press(`[data-tool=${tool}]`);
    for (const point of clicks) await clickAt(point);
    const walk = await browser.value(`({ from: meshwalkPage.walkPanel.from.join(),
      to: meshwalkPage.walkPanel.to.join(), name: document.getElementById("walk-name").value,
      triangles: Array.from(meshwalkPage.walkPanel.walk.triangles) })`);
    const how = tool === "ray" ? ["star", "--walk", walk.name] : ["surface", "--weld"];
    const listed = run("walk", "octahedron.off", "--as", ...how, "--from", walk.from,
      "--to", walk.to);
    assert.deepEqual(walk.triangles,
      listed.trimEnd().split("\n").slice(1).map((line) => Number(line.split(",")[1])), tool);
    if (tool === "ray") await compareSpaceRace("octahedron.off", walk);
  }
  await compareEdges();
}

// Every walk from ray to ray has the triangles that `walk` lists.
async function compareSpaceRace(mesh, { from, to }) {
  await browser.press("#walk-race");
  const lanes = await browser.value(`meshwalkPage.race.lanes.map(({ name, walk }) =>
    ({ name, triangles: Array.from(walk.triangles), tests: walk.counters.orientations }))`);
  assert.deepEqual(lanes.map(({ name }) => name),
    ["stochastic", "forgetful", "barycentric", "orthogonal", "straight"]);
  for (const { name, triangles, tests } of lanes) {
    const listed = run("walk", mesh, "--as", "star", "--walk", name, "--from", from, "--to", to);
    assert.deepEqual(triangles,
      listed.trimEnd().split("\n").slice(1).map((line) => Number(line.split(",")[1])), name);
    assert.ok(tests >= triangles.length - 1, `${name} has ${tests} tests`);
  }
  await browser.press("#race-close");
}

// Edges are dark pixels in front only: fewer colours without them.
async function compareEdges() {
  const shades = async () => {
    await browser.value("meshwalkPage.setSpace('space')");
    await browser.frame();
    return browser.value(`(() => {
      const { width, height } = document.getElementById("picture");
      const { data } = document.getElementById("picture").getContext("2d")
        .getImageData(0, 0, width, height);
      return new Set(new Uint32Array(data.buffer)).size;
    })()`);
  };
  const counts = [];
  await browser.value("document.getElementById('colour-field').value = 'none'");
  await browser.value("meshwalkPage.colours.apply()");
  for (const on of [true, false]) {
    await browser.value(`document.getElementById("edges").checked = ${on}`);
    counts.push(await shades());
  }
  assert.ok(counts[1] <= 9 && counts[0] > 20, `shades with edges, without: ${counts}`);
}

/** Something is drawn in the middle of the picture. */
const drawn = () => browser.value(`(() => {
  const canvas = document.getElementById("picture");
  const [x, y] = [canvas.width >> 1, canvas.height >> 1];
  return canvas.getContext("2d").getImageData(x, y, 1, 1).data[3] === 255;
})()`);

// The page as it is installed holds no mesh: it waits for a file.
async function testEmpty() {
  await browser.open(emptyPage);
  assert.match(await browser.value("document.getElementById('notice').textContent"), /drop it/);
  await testFiles("");
}

try {
  for (const [width, height, mobile] of [[1280, 800, false], [390, 844, true]]) {
    await browser.size(width, height, mobile);
    await testTrap();
    await browser.frame();
    assert.ok(await drawn());
    assert.equal(await browser.value("document.documentElement.scrollWidth"), width);
  }
  await testFiles("trap.off");
  await testColumns(join(data, "trap.off"));
  await testDefects();
  await browser.size(1280, 800);
  await testTerrain();
  await testSpace();
  await testEmpty();
  assert.deepEqual(browser.faults, []);
  console.log("the page answers as the command line does");
} finally {
  await browser.close();
  rmSync(scratch, { recursive: true });
}
