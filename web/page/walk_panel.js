// walk_panel.js - one walk, from click to click, step by step.

const LISTED = 400;
const PLANE_HINT = "Choose “Walk” on the picture, click where it begins, then where it is " +
  "to end.";
const SPACE_HINT = "Choose “Rays” and click two places: a walk goes from one ray out of the " +
  "centre to the other. Or choose “Probe” and click: a probe moves along your line of sight.";

class WalkPanel {
  constructor(app) {
    this.app = app;
    this.player = new Player(() => this.changed());
    this.listen();
    this.clear();
  }

  listen() {
    byId("walk-form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.go();
    });
    byId("walk-race").addEventListener("click", () => this.race());
    byId("walk-name").addEventListener("change", () => {
      this.help();
      if (this.from && this.to) this.go();
    });
    byId("walk-play").addEventListener("click", () => this.player.toggle());
    byId("walk-back").addEventListener("click", () => this.player.goTo(this.player.step - 1));
    byId("walk-forward").addEventListener("click", () => this.player.goTo(this.player.step + 1));
    byId("walk-step").addEventListener("input", () =>
      this.player.goTo(Number(byId("walk-step").value)));
  }

  /** Offer the walks of the plane, or those from ray to ray in space. */
  offer(space) {
    const inSpace = space === "space";
    this.walks = inSpace ? this.app.meshwalk.starWalks : this.app.meshwalk.walks;
    this.dimension = inSpace ? 3 : 2;
    byId("walk-name").replaceChildren(...this.walks.map(({ name }) => new Option(name)));
    byId("walk-centre-row").hidden = !inSpace;
    for (const id of ["walk-from", "walk-to"])
      byId(id).placeholder = inSpace ? "x, y, z" : "x, y";
    byId("walk-hint").textContent = inSpace ? SPACE_HINT : PLANE_HINT;
    this.clear();
    this.help();
  }

  help() {
    const name = byId("walk-name").value;
    const walk = this.walks.find((one) => one.name === name);
    byId("walk-help").textContent = `${walk.help} [${walk.source}]`;
  }

  clear() {
    this.player.stop();
    this.walk = this.from = this.to = null;
    byId("walk-player").hidden = true;
    byId("walk-hint").hidden = false;
    byId("walk-from").value = byId("walk-to").value = "";
  }

  /** A click: the first is where the walk begins, the second where it is to end. */
  click(point) {
    const text = point.join(", ");
    byId("walk-panel").open = true;
    if (!this.from || this.to) {
      this.clear();
      this.from = point;
      byId("walk-from").value = text;
      this.app.setHint("Now click where the walk is to end");
    } else {
      byId("walk-to").value = text;
      this.app.setHint("");
      this.go();
    }
  }

  /** The ends as the fields say them; false after a complaint. */
  readEnds() {
    this.from = parsePoint(byId("walk-from").value, this.dimension);
    this.to = parsePoint(byId("walk-to").value, this.dimension);
    if (this.from && this.to) return true;
    byId(this.from ? "walk-to" : "walk-from").focus();
    this.app.complain(`A walk needs two points, each as: ${byId("walk-to").placeholder}`);
    return false;
  }

  go() {
    if (!this.readEnds()) return;
    const name = byId("walk-name").value;
    this.app.attempt(() => (this.dimension === 3 ? this.goByRays(name) : this.goInPlane(name)));
  }

  /** The walk of a name between two points, or between the rays through them. */
  follow(name, from, to) {
    if (this.dimension === 2) return this.app.locatorFor(name).follow(from, to, { walk: name });
    return this.asWalk(this.app.star(this.centre()).followRay(from, to, { walk: name }));
  }

  /** Where rays come from. */
  centre() {
    return parsePoint(byId("walk-centre").value, 3) || [0, 0, 0];
  }

  goInPlane(name) {
    const walk = this.follow(name, this.from, this.to);
    const words = `${tellWalk(name, walk)}${tellRing(this.app, walk, this.to)}`;
    this.show(walk, words, `--walk ${name}`);
  }

  goByRays(name) {
    const walk = this.follow(name, this.from, this.to);
    this.show(walk, `The ${name} walk comes from ray to ray in ` +
      `${plural(walk.triangles.length, "facet")}, to facet ${walk.location.triangle}.`,
    `--as star --centre ${this.centre().join()} --walk ${name}`);
  }

  /** A probe at one point that moves towards another. */
  probe(from, to) {
    const motion = to.map((value, k) => value - from[k]);
    this.clear();
    this.from = from;
    this.to = to;
    this.app.attempt(() => {
      const surface = this.app.surface();
      const touch = surface.probe(from, motion);
      const certain = surface.probe(from, motion, { certain: true });
      this.show(this.asWalk(touch), tellProbe(touch, certain), "--as surface --weld");
    });
  }

  /** A trace in space in the form of a walk in the plane. */
  asWalk({ triangles, triangle, counters }) {
    return { triangles, stages: Array(triangles.length).fill("walk"), line: [],
      location: { triangle }, counters };
  }

  /** Play a walk; `words` tell it, `options` repeat it on the command line. */
  show(walk, words, options) {
    this.walk = walk;
    const { triangles } = walk;
    byId("walk-player").hidden = false;
    byId("walk-hint").hidden = true;
    byId("walk-step").max = Math.max(0, triangles.length - 1);
    byId("walk-result").textContent = words;
    byId("walk-command").textContent = `meshwalk walk ${this.app.mesh.name} ${options} ` +
      `--from ${this.from.join()} --to ${this.to.join()}`;
    const more = triangles.length - LISTED;
    byId("walk-list").textContent = Array.from(triangles.subarray(0, LISTED)).join(", ") +
      (more > 0 ? ` and ${more} more` : "");
    this.ring = findRing(triangles);
    this.player.start(triangles.length, this.ring);
  }

  changed() {
    const { step, playing } = this.player;
    const { triangles, stages } = this.walk;
    byId("walk-step").value = step;
    byId("walk-play").textContent = playing ? "Pause" : "Play";
    const ring = this.ring && step >= this.ring.begin && step < ringEnd(triangles, this.ring);
    const next = triangles[step + 1];
    this.step = this.dimension === 2 && triangles.length
      ? edgesBeyond(this.app, triangles[step], next, this.to) : null;
    byId("walk-why").textContent = this.step ? tellStep(this.step, next) : "";
    byId("walk-now").textContent = `Step ${step + 1} of ${triangles.length}: ` +
      `triangle ${triangles[step]} (${stageWords(stages[step])})${ring ? ", in a ring" : ""}`;
    this.app.stage.drawOverlay();
  }

  race() {
    if (!this.readEnds()) return;
    this.app.attempt(() => this.app.race.run(this.from, this.to));
  }

  draw(pen) {
    const colour = styleText("--way");
    if (this.walk) {
      drawVisited(pen, this.walk, this.player.step);
      if (this.step) drawStep(pen, this.walk.triangles[this.player.step], this.step);
      if (this.walk.line.length) pen.line(this.walk.line, colour, 1.5, [6, 4]);
      pen.dot(this.to, colour, 6);
      pen.label(this.to, "to", colour);
    }
    if (!this.from) return;
    pen.dot(this.from, colour, 6);
    pen.label(this.from, "from", colour);
  }
}

/** What a probe touched by its walks, and for certain. */
function tellProbe(touch, certain) {
  const walks = touch.triangles.length ? touch.iterations[touch.iterations.length - 1] + 1 : 0;
  const found = touch.state === "hit" ? `touches triangle ${touch.triangle}` : "touches nothing";
  const sure = certain.state === "hit" ? `triangle ${certain.triangle}` : "nothing";
  return `The probe ${found}, after ${plural(touch.triangles.length, "triangle")} in ` +
    `${plural(walks, "walk")}. For certain, by boxes, the nearest is ${sure}.`;
}

function stageWords(stage) {
  return { init: "turning round the first vertex", walk: "the walk", final: "the final location",
    border: "along a border" }[stage];
}

/** The triangles up to a step, the last one stronger, and the way through their middles. */
function drawVisited(pen, walk, step) {
  const colour = styleText("--way");
  const visited = Array.from(walk.triangles.subarray(0, step + 1));
  const once = [...new Set(visited)];
  pen.triangles(once, { fill: colour, alpha: 0.35 });
  pen.triangles(once, { stroke: colour, width: 1.2, alpha: 0.8 });
  pen.triangles(visited.slice(-1), { fill: colour, alpha: 0.75 });
  pen.line(visited.slice(-300).map((t) => middleOf(pen.topology, t)), styleText("--ink"), 1.5);
}

function middleOf(topology, triangle) {
  const corners = topology.corners(triangle);
  return [0, 1, 2].map((k) => (corners[0][k] + corners[1][k] + corners[2][k]) / 3);
}
