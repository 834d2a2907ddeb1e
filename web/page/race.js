// race.js - all walks side by side, one triangle at a time, with their counters.

const LANE_EDGES = 4000; // triangles whose edges a lane draws

/** One walk of the race in its own little picture. */
class Lane {
  constructor(name, walk, race) {
    this.name = name;
    this.walk = walk;
    this.race = race;
    this.ring = findRing(walk.triangles);
    this.element = document.createElement("figure");
    this.element.className = "lane";
    this.canvas = document.createElement("canvas");
    this.words = document.createElement("figcaption");
    this.element.append(this.canvas, this.words);
    this.element.tabIndex = 0;
    this.element.setAttribute("role", "button");
    this.element.addEventListener("click", () => race.choose(name));
    this.element.addEventListener("keydown", ({ key }) => {
      if (key === "Enter" || key === " ") race.choose(name);
    });
  }

  get count() {
    return this.walk.triangles.length;
  }

  /** The last step that a lane shows: a ring is shown as long as the race lasts. */
  shown(step) {
    return Math.min(step, this.count - 1);
  }

  draw(step) {
    const at = this.shown(step);
    const { camera, background, ratio } = this.race.view;
    const context = this.canvas.getContext("2d");
    this.canvas.width = background.width;
    this.canvas.height = background.height;
    context.drawImage(background, 0, 0);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const pen = new Pen(context, camera, this.race.app.topology);
    drawVisited(pen, this.walk, at);
    for (const point of [this.race.from, this.race.to]) pen.dot(point, styleText("--way"), 3.5);
    this.tell(step);
  }

  tell(step) {
    const done = step >= this.count - 1;
    const { counters } = this.walk;
    const tests = counters.orientations + counters.implicit + counters.comparisons;
    const circling = this.ring && step >= this.ring.begin + this.ring.length;
    this.element.className = `lane${circling ? " ring" : done ? " done" : ""}`;
    const triangles = plural(this.shown(step) + 1, "triangle");
    const end = done ? `, ${plural(tests, "test")}` : "";
    const mark = circling ? "in a ring" : done ? this.race.placeOf(this) : "";
    this.words.innerHTML = "<strong></strong><span class=place></span><br><span></span>";
    const [name, place, words] = this.words.querySelectorAll("strong, span");
    name.textContent = this.name;
    place.textContent = mark;
    words.textContent = `${triangles}${end}`;
  }
}

class Race {
  constructor(app) {
    this.app = app;
    this.player = new Player(() => this.changed());
    byId("race-close").addEventListener("click", () => this.close());
    byId("race-again").addEventListener("click", () => this.run(this.from, this.to));
  }

  close() {
    this.player.stop();
    byId("race").hidden = true;
  }

  run(from, to) {
    this.from = from;
    this.to = to;
    this.inSpace = from.length === 3;
    this.lanes = this.app.walkPanel.walks.map(({ name }) =>
      new Lane(name, this.app.walkPanel.follow(name, from, to), this));
    byId("race-lanes").replaceChildren(...this.lanes.map((lane) => lane.element));
    byId("race").hidden = false;
    this.makeView();
    this.player.start(this.length());
  }

  /** As many steps as the longest walk without a ring takes, and some rounds of those with one. */
  length() {
    const ends = this.lanes.map((lane) =>
      (lane.ring ? lane.ring.begin + 3 * lane.ring.length : lane.count));
    return Math.max(...ends);
  }

  /** Places of those that end, by triangles visited; equal ones share a place. */
  placeOf(lane) {
    const faster = this.lanes.filter((other) => !other.ring && other.count < lane.count).length;
    return ["1st", "2nd", "3rd"][faster] || `${faster + 1}th`;
  }

  /** The part of the mesh that all walks visit, drawn once for all lanes. */
  makeView() {
    const { stage } = this.app;
    const { ratio } = stage;
    const width = this.lanes[0].element.clientWidth - 16;
    const camera = stage.camera.copy();
    camera.size = [Math.max(120, width), Math.max(120, width) / 1.25];
    const background = document.createElement("canvas");
    [background.width, background.height] = camera.size.map((side) => Math.round(side * ratio));
    const context = background.getContext("2d");
    const { low, high } = this.box();
    if (this.inSpace) {
      camera.face(this.direction());
      camera.fit(low, high);
      context.putImageData(stage.shoot(camera, background.width, background.height), 0, 0);
    } else {
      camera.fit(low, high);
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      new Pen(context, camera, this.app.topology).triangles(this.near(low, high),
        { stroke: styleText("--soft"), width: 0.5, alpha: 0.6 });
    }
    this.view = { camera, background, ratio };
  }

  /** From the centre between the two rays: what the walks visit is seen from there. */
  direction() {
    const centre = this.app.walkPanel.centre();
    const ways = [this.from, this.to].map((point) => {
      const way = point.map((value, k) => value - centre[k]);
      const length = Math.hypot(...way) || 1;
      return way.map((part) => part / length);
    });
    return ways[0].map((part, k) => part + ways[1][k]);
  }

  box() {
    const { topology } = this.app;
    const visited = new Set(this.lanes.flatMap((lane) => Array.from(lane.walk.triangles)));
    const { low, high } = topology.box([...visited]);
    for (const point of [this.from, this.to])
      for (let k = 0; k < point.length && !this.inSpace; k++) {
        low[k] = Math.min(low[k], point[k]);
        high[k] = Math.max(high[k], point[k]);
      }
    return { low, high };
  }

  /** Triangles with a corner in a box; none if they are too many to be seen. */
  near(low, high) {
    const { topology, mesh } = this.app;
    const inside = (v) => {
      const [x, y] = topology.at(v);
      return x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1];
    };
    const found = [];
    for (let t = 0; t < mesh.triangleCount && found.length <= LANE_EDGES; t++)
      if ([0, 1, 2].some((k) => inside(topology.corner(t, k)))) found.push(t);
    return found.length <= LANE_EDGES ? found : [];
  }

  changed() {
    for (const lane of this.lanes) lane.draw(this.player.step);
  }

  /** Show one of them large. */
  choose(name) {
    this.close();
    byId("walk-name").value = name;
    this.app.walkPanel.help();
    this.app.walkPanel.go();
  }
}
