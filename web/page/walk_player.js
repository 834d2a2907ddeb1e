// walk_player.js - the steps of a walk in time: how fast they go, and where a ring begins.

const LONGEST = 9000; // milliseconds of a whole walk
const BRIEFEST = 60; // milliseconds of a step
const SLOWEST = 550;

/** Milliseconds from one triangle to the next. */
function stepTime(count) {
  return Math.max(BRIEFEST / 4, Math.min(SLOWEST, LONGEST / Math.max(count, 1)));
}

/** The ring in which a walk goes round at least twice: { begin, length }; null: none. */
function findRing(triangles) {
  const seen = new Map();
  for (let i = 0; i < triangles.length; i++) {
    const before = seen.get(triangles[i]);
    if (before !== undefined && ringRepeats(triangles, before, i - before))
      return { begin: before, length: i - before };
    seen.set(triangles[i], i);
  }
  return null;
}

function ringRepeats(triangles, begin, length) {
  if (begin + 2 * length > triangles.length) return false;
  for (let k = 0; k < length; k++)
    if (triangles[begin + k] !== triangles[begin + length + k]) return false;
  return true;
}

/** Where the walk in its ring is given up: the steps behind it are those of the walk that ends. */
function ringEnd(triangles, { begin, length }) {
  let end = begin + length;
  while (end < triangles.length && triangles[end] === triangles[end - length]) end++;
  return end;
}

/** What happened, in a sentence. */
function tellWalk(name, walk) {
  const { location, counters, triangles } = walk;
  const ring = findRing(triangles);
  const at = location.triangle === null ? location.where : `triangle ${location.triangle}`;
  const tests = counters.orientations + counters.implicit + counters.comparisons;
  const sum = `${plural(triangles.length, "triangle")}, ${plural(tests, "test")}`;
  if (!ring) return `The ${name} walk ends: ${at}, after ${sum}.`;
  const rounds = Math.floor((ringEnd(triangles, ring) - ring.begin) / ring.length);
  return `The ${name} walk goes round in a ring of ${ring.length} triangles, ` +
    `${plural(rounds, "time")}, until it is given up; a walk with a proof that it ends ` +
    `finds ${at}. In all ${sum}.`;
}

const ROUNDS = 3; // of a ring, until playing stops

/** Counts steps in time; `changed` hears of each. */
class Player {
  constructor(changed) {
    this.changed = changed;
    this.count = 0;
    this.step = 0;
    this.playing = false;
  }

  /** Play `count` steps; of a ring, some rounds. */
  start(count, ring = null) {
    this.count = count;
    this.last = ring ? Math.min(count - 1, ring.begin + ROUNDS * ring.length) : count - 1;
    const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.step = still ? this.last : 0;
    this.begin = performance.now();
    this.playing = !still;
    this.tick();
  }

  toggle() {
    if (this.playing) {
      this.playing = false;
      this.changed();
      return;
    }
    if (this.step >= this.last) this.step = 0;
    this.begin = performance.now() - this.step * stepTime(this.last);
    this.playing = true;
    this.tick();
  }

  goTo(step) {
    this.playing = false;
    this.step = Math.max(0, Math.min(this.count - 1, step));
    this.changed();
  }

  tick() {
    if (this.playing) {
      const passed = performance.now() - this.begin;
      this.step = Math.min(this.last, Math.floor(passed / stepTime(this.last)));
      this.playing = this.step < this.last;
    }
    this.changed();
    if (this.playing) requestAnimationFrame(() => this.playing && this.tick());
  }

  stop() {
    this.playing = false;
  }
}
