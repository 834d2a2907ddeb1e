// walk_panel.js - one walk, from click to click, step by step.

const LISTED = 400;

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

  offer(walks) {
    byId("walk-name").replaceChildren(...walks.map(({ name }) => new Option(name)));
    this.help();
  }

  help() {
    const name = byId("walk-name").value;
    const walk = this.app.meshwalk.walks.find((one) => one.name === name);
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
    this.from = parsePoint(byId("walk-from").value);
    this.to = parsePoint(byId("walk-to").value);
    if (this.from && this.to) return true;
    byId(this.from ? "walk-to" : "walk-from").focus();
    this.app.complain("A walk needs two points, each as: x, y");
    return false;
  }

  follow(name) {
    return this.app.locatorFor(name).follow(this.from, this.to, { walk: name });
  }

  go() {
    if (!this.readEnds()) return;
    const name = byId("walk-name").value;
    this.app.attempt(() => {
      this.walk = this.follow(name);
      this.name = name;
      this.showWalk();
    });
  }

  showWalk() {
    const { walk } = this;
    const { triangles } = walk;
    byId("walk-player").hidden = false;
    byId("walk-hint").hidden = true;
    byId("walk-step").max = Math.max(0, triangles.length - 1);
    byId("walk-result").textContent = tellWalk(this.name, walk);
    byId("walk-command").textContent = `meshwalk walk ${this.app.mesh.name} --walk ${this.name} ` +
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
      if (this.walk.line.length) pen.line(this.walk.line, colour, 1.5, [6, 4]);
      pen.dot(this.to, colour, 6);
      pen.label(this.to, "to", colour);
    }
    if (!this.from) return;
    pen.dot(this.from, colour, 6);
    pen.label(this.from, "from", colour);
  }
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
