// app.js - the page: a mesh, its locators, and the panels about it.

const TOOL_SPACES = { walk: "plane", profile: "plane", ray: "space", probe: "space" };

const VERDICTS = {
  plane: ["an embedding: every promise holds", "in the plane"],
  surface: ["a sound surface", "as a surface"],
  star: ["star-shaped about the centre", "as a star"],
};

class App {
  constructor(meshwalk) {
    this.meshwalk = meshwalk;
    this.tool = "look";
    this.hint = "";
    this.lineNotes = [];
    this.stage = new Stage({ spaceLines: () => spaceLines(this),
      lines: (context, camera) => drawLines(this, context, camera),
      above: (context, camera) => drawAll(this, context, camera) },
    { click: (at) => this.click(at), hover: (at) => this.hover(at) });
    this.here = new HerePanel(this);
    this.loopPanel = new LoopPanel(this);
    this.colours = new ColourPanel(this);
    this.defects = new DefectPanel(this);
    this.walkPanel = new WalkPanel(this);
    this.race = new Race(this);
    this.points = new PointPanel(this);
    this.profile = new ProfilePanel(this);
    this.locators = new Map();
    this.listen();
    byId("version").textContent = `meshwalk ${meshwalk.version}`;
  }

  // --- the mesh ---

  /** Show a mesh; what was shown before goes. */
  open(mesh, as = null, centre = [0, 0, 0]) {
    const topology = new Topology(mesh);
    this.close();
    this.mesh = mesh;
    this.topology = topology;
    byId("file-name").textContent = mesh.name.split("/").pop();
    document.title = `${mesh.name.split("/").pop()} · meshwalk`;
    this.makeLocator();
    byId("walk-centre").value = centre.join(", ");
    this.stage.space = "plane";
    this.stage.show(mesh, topology);
    this.colours.show();
    this.loopPanel.show(this.describe());
    this.as = as === "star" ? "star" : "surface";
    this.checks = { plane: mesh.check(),
      space: mesh.hasHeights ? mesh.check(this.as, centre) : null };
    this.setSpace(as && as !== "plane" ? "space" : this.likelySpace());
  }

  close() {
    for (const locator of this.locators.values()) locator.free();
    this.locators.clear();
    if (this.taken) this.taken.free();
    this.taken = null;
    this.starCentre = null;
    this.locator = null;
    this.race.close();
    for (const panel of [this.walkPanel, this.points, this.profile, this.here]) panel.clear();
    if (!this.mesh) return;
    this.stage.picture.free();
    this.stage.picture = null;
    this.mesh.free();
  }

  /** What is closed, or folds all over in the plane but not in space, is meant to be a surface. A
   * terrain with a few faults stays in the plane, where these show. */
  likelySpace() {
    const { plane, space } = this.checks;
    if (!space || plane.valid) return "plane";
    const count = (check) => check.defects.filter(({ kind }) => kind !== "flat").length;
    const all = count(plane) > 20 && count(plane) > 0.02 * this.mesh.triangleCount;
    const closed = this.topology.border.length === 0;
    return closed || (all && 4 * count(space) < count(plane)) ? "space" : "plane";
  }

  setSpace(space) {
    byId("space").value = space;
    for (const [tool, where] of Object.entries(TOOL_SPACES))
      document.querySelector(`[data-tool=${tool}]`).hidden = where !== space;
    byId("here-form").hidden = space === "space";
    this.setTool("look");
    this.walkPanel.offer(space);
    this.here.clear();
    const check = this.checks[space] || this.checks.plane;
    const voided = space === "plane" && this.locator ? this.locator.voidPromise : null;
    this.showVerdict(this.defects.show(check, space, voided), check, space);
    this.stage.setSpace(space);
  }

  describe() {
    try {
      return this.mesh.describe();
    } catch {
      return null; // the list of defects says why
    }
  }

  showVerdict(count, { valid, defects }, space) {
    const verdict = byId("verdict");
    const [good, bad] = VERDICTS[space === "space" ? this.as : "plane"];
    const flat = valid && defects.length >= this.mesh.triangleCount; // valid ones are flat only
    verdict.textContent = flat ? "⚠ no triangle with an area: nothing to locate in"
      : valid ? `✓ ${good}` : `⚠ ${plural(count, "defect")} ${bad}`;
    verdict.className = valid && !flat ? "good" : "bad";
  }

  makeLocator() {
    try {
      this.locator = this.locatorFor("auto");
    } catch {
      this.locator = null; // arrays that no walk can use: the list of defects says why
    }
  }

  /** The border walk wants pockets and holes open, all others filled. */
  locatorFor(walk) {
    const fill = walk === "border" ? "open" : "filled";
    if (!this.locators.has(fill))
      this.locators.set(fill, this.meshwalk.createLocator(this.mesh, { fill, any: true }));
    return this.locators.get(fill);
  }

  /** The mesh taken as a surface. */
  surface() {
    if (!this.taken) this.taken = this.meshwalk.createSurface(this.mesh, { weld: true });
    return this.taken;
  }

  /** The mesh taken as a polyhedron that is star-shaped about a centre. */
  star(centre) {
    const surface = this.surface();
    if (this.starCentre === centre.join()) return surface;
    this.starCentre = null;
    surface.setCentre(centre);
    this.starCentre = centre.join();
    return surface;
  }

  /** Where a point lies; null if that has no answer. */
  locate([x, y]) {
    return this.locator && this.locator.locateOne(x, y);
  }

  // --- what people do ---

  listen() {
    for (const button of document.querySelectorAll("[data-tool]"))
      button.addEventListener("click", () => this.setTool(button.dataset.tool));
    byId("theme").addEventListener("click", () => this.setTheme(this.theme() === "dark"
      ? "light" : "dark"));
    document.addEventListener("keydown", (event) => this.key(event));
    byId("open-files").addEventListener("change", (event) => this.openFiles(event.target.files));
    const target = document.body;
    target.addEventListener("dragover", (event) => {
      event.preventDefault();
      byId("drop-hint").hidden = false;
    });
    target.addEventListener("dragleave", (event) => {
      if (!event.relatedTarget) byId("drop-hint").hidden = true;
    });
    target.addEventListener("drop", (event) => {
      event.preventDefault();
      byId("drop-hint").hidden = true;
      this.openFiles(event.dataTransfer.files);
    });
  }

  /** Keys that mean the same everywhere; those of the picture are the stage's. */
  key({ key, target }) {
    if (key === "?" && target.tagName !== "INPUT") {
      byId("keys-panel").open = true;
      byId("keys-panel").scrollIntoView();
      byId("keys-panel").querySelector("summary").focus();
    }
    if (key === "Escape" && !byId("race").hidden) {
      this.race.close();
      byId("walk-race").focus();
    }
  }

  theme() {
    return document.documentElement.dataset.theme;
  }

  setTheme(theme) {
    document.documentElement.dataset.theme = theme;
    if (this.mesh) this.colours.apply();
  }

  /** What is to be done next, in the corner of the picture. */
  setHint(text) {
    this.hint = text;
    this.stage.drawOverlay();
  }

  setTool(tool) {
    this.tool = tool;
    for (const button of document.querySelectorAll("[data-tool]"))
      button.setAttribute("aria-checked", button.dataset.tool === tool);
  }

  click(screen) {
    if (!this.mesh) return;
    if (this.tool === "look") {
      this.here.show(screen, true);
      return;
    }
    if (this.stage.space === "space") {
      this.clickInSpace(screen);
      return;
    }
    const point = this.rounded(this.stage.camera.toMesh(screen));
    if (this.tool === "walk") this.walkPanel.click(point);
    else this.profile.click(point);
  }

  /** A line of sight: the probe moves along it; a ray goes through what is seen there. */
  clickInSpace(screen) {
    const { point, away } = this.stage.camera.sight(screen);
    const { low, high } = this.topology.extent();
    const reach = Math.hypot(...[0, 1, 2].map((k) => high[k] - low[k])) || 1;
    const along = (length) => this.rounded(point.map((value, k) => value + length * away[k]));
    if (this.tool === "probe") {
      this.walkPanel.probe(along(-reach), along(reach));
      return;
    }
    const seen = this.seenAt(screen, point, away);
    if (seen) this.walkPanel.click(this.rounded(seen));
  }

  /** The point of the surface that is seen at a place of the screen; null: none. */
  seenAt(screen, point, away) {
    const { picture, ratio } = this.stage;
    const triangle = picture.triangleAt(...screen.map((value) => Math.floor(value * ratio)));
    if (triangle === null) return null;
    const [a] = this.topology.corners(triangle);
    const normal = this.topology.outward(triangle, [0, 0, 0]);
    const along = (vector) => normal.reduce((sum, part, k) => sum + part * vector[k], 0);
    const part = along(point.map((value, k) => a[k] - value)) / along(away);
    return point.map((value, k) => value + part * away[k]);
  }

  /** As many digits as the screen can tell, so that commands stay short. */
  rounded(point) {
    const digits = Math.ceil(Math.log10(this.stage.camera.scale)) + 1;
    return point.map((value) => (digits >= 0 && digits < 15 ? Number(value.toFixed(digits))
      : Number(value.toPrecision(15))));
  }

  hover(screen) {
    if (!this.mesh) return;
    if (screen) this.here.show(screen, false);
    else this.here.leave();
  }

  async openFiles(files) {
    this.complain("");
    try {
      if (files.length) await openFiles(this, files);
    } catch (error) {
      this.fail(error);
    }
  }

  // --- what goes wrong ---

  complain(message) {
    byId("failure").hidden = !message;
    byId("failure").textContent = message;
  }

  fail(error) {
    this.complain(error.message);
    if (error.name !== "MeshwalkError") console.warn(error);
  }

  /** Do something that the engine may refuse. */
  attempt(act) {
    this.complain("");
    try {
      act();
    } catch (error) {
      this.fail(error);
    }
  }
}

async function main() {
  const dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  await new Promise((resolve) => setTimeout(resolve, 20)); // the page is seen before the work
  const bytes = Uint8Array.from(atob(byId("engine").textContent), (c) => c.charCodeAt(0));
  const meshwalk = await loadMeshwalk(bytes);
  const app = new App(meshwalk);
  const content = readContent(meshwalk, byId("content").textContent);
  byId("content").textContent = "";
  byId("notice").textContent = content ? "" : "Open a file, or drop it here";
  if (content) {
    app.open(content.mesh, content.as, content.centre);
    if (content.query) app.points.show(content.query.name, content.query.xy);
  }
  window.meshwalkPage = app; // for tests, and for the curious
  document.documentElement.dataset.ready = "true";
}

main().catch((error) => {
  byId("failure").hidden = false;
  byId("failure").textContent = `This browser cannot show the page: ${error.message}`;
});
