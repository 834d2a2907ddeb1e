// browser.mjs - a headless Chromium that tests drive, by the DevTools protocol over a pipe.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const WAIT = 60000; // milliseconds

/** A browser with one page. */
export class Browser {
  static async start(program) {
    const browser = new Browser();
    browser.home = mkdtempSync(join(tmpdir(), "meshwalk-browser-"));
    const words = ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
      "--no-first-run", "--disable-dev-shm-usage", "--remote-debugging-pipe",
      `--user-data-dir=${browser.home}`, "about:blank"];
    browser.process = spawn(program, words,
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.waiting = new Map();
    browser.next = 1;
    browser.text = "";
    browser.faults = []; // errors in the console, exceptions
    browser.process.stdio[4].on("data", (part) => browser.read(part));
    await browser.attach();
    return browser;
  }

  read(part) {
    const messages = (this.text + part).split("\0");
    this.text = messages.pop();
    for (const message of messages) this.hear(JSON.parse(message));
  }

  hear(message) {
    if (message.id) {
      const { resolve, reject } = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      if (message.error) reject(new Error(message.error.message));
      else resolve(message.result);
    } else if (message.method === "Runtime.exceptionThrown") {
      const { exception, text } = message.params.exceptionDetails;
      this.faults.push((exception && exception.description) || text);
    } else if (message.method === "Log.entryAdded" && message.params.entry.level === "error") {
      this.faults.push(message.params.entry.text);
    } else if (message.method === "Runtime.consoleAPICalled" && message.params.type === "error") {
      this.faults.push(message.params.args.map((arg) => arg.value).join(" "));
    }
  }

  send(method, params = {}) {
    const id = this.next++;
    const message = JSON.stringify({ id, method, params, sessionId: this.session });
    this.process.stdio[3].write(`${message}\0`);
    return new Promise((resolve, reject) => {
      const late = setTimeout(() => reject(new Error(`${method}: no answer`)), WAIT);
      const done = (act) => (value) => {
        clearTimeout(late);
        act(value);
      };
      this.waiting.set(id, { resolve: done(resolve), reject: done(reject) });
    });
  }

  async attach() {
    const { targetInfos } = await this.send("Target.getTargets");
    const { targetId } = targetInfos.find(({ type }) => type === "page");
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    this.session = sessionId;
    for (const domain of ["Page", "Runtime", "Log"]) await this.send(`${domain}.enable`);
  }

  async size(width, height, mobile = false) {
    const deviceScaleFactor = mobile ? 2 : 1;
    await this.send("Emulation.setDeviceMetricsOverride",
      { width, height, deviceScaleFactor, mobile });
  }

  async open(path) {
    await this.send("Page.navigate", { url: `file://${path}` });
    await this.until("document.querySelector('html[data-ready]') !== null");
  }

  /** The value of an expression in the page. */
  async value(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate",
      { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception.description);
    return result.value;
  }

  async until(expression) {
    const end = Date.now() + WAIT;
    while (!(await this.value(expression))) {
      if (Date.now() > end) throw new Error(`never true: ${expression}`);
      await new Promise((resolve) => setTimeout(resolve, 30));
    }
  }

  async click(x, y) {
    for (const type of ["mouseMoved", "mousePressed", "mouseReleased"])
      await this.send("Input.dispatchMouseEvent",
        { type, x, y, button: type === "mouseMoved" ? "none" : "left", clickCount: 1 });
  }

  async key(key) {
    for (const type of ["keyDown", "keyUp"])
      await this.send("Input.dispatchKeyEvent", { type, key });
  }

  async press(selector) {
    await this.value(`document.querySelector(${JSON.stringify(selector)}).click()`);
  }

  /** Press what saves a file; returns its text. */
  async save(selector) {
    const folder = join(this.home, "saved");
    await this.send("Page.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
    await this.press(selector);
    const end = Date.now() + WAIT;
    const saved = () => (existsSync(folder) ? readdirSync(folder) : []);
    while (!saved().length || saved().some((name) => name.endsWith(".crdownload"))) {
      if (Date.now() > end) throw new Error("nothing is saved");
      await new Promise((resolve) => setTimeout(resolve, 30));
    }
    const [name] = saved();
    const text = readFileSync(join(folder, name), "utf8");
    rmSync(folder, { recursive: true });
    return { name, text };
  }

  /** Two frames: what was asked for is drawn. */
  async frame() {
    await this.value("new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(r)))");
  }

  async picture() {
    await this.frame();
    const { data } = await this.send("Page.captureScreenshot", { format: "png" });
    return Buffer.from(data, "base64");
  }

  async close() {
    const ended = new Promise((resolve) => this.process.on("exit", resolve));
    await this.send("Browser.close").catch(() => this.process.kill());
    await ended;
    rmSync(this.home, { recursive: true, force: true, maxRetries: 5 });
  }
}
