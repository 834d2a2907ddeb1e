// site.mjs CHROMIUM FOLDER: the site as a reader opens it, from a folder: its search finds pages
// without a server, no page is wider than a phone, and dark mode is dark.
import assert from "node:assert/strict";
import { join } from "node:path";
import { Browser } from "./browser.mjs";

const [chromium, folder] = process.argv.slice(2); // the whole path of each
const browser = await Browser.start(chromium);

async function open(page) {
  await browser.send("Page.navigate", { url: `file://${join(folder, page)}` });
  await browser.until(`location.pathname.endsWith("${page.replace(/\?.*/, "")}") &&
    document.readyState === "complete"`);
}

// Words of a how-to page, of each language's reference, of a manual page and of a proof.
async function testSearch() {
  for (const [words, page] of [["celestial", "docs/choosing.html"],
    ["mw_locate_batch", "reference/c/locate.html"],
    ["nearest_border", "reference/python/locator.html"],
    ["readMesh", "reference/javascript.html"], ["nodata", "reference/program/meshwalk-raster.html"],
    ["stochastic probability", "docs/proofs/walks.html"], ["bay islands", "gallery/index.html"]]) {
    await open(`search.html?q=${encodeURIComponent(words)}`);
    await browser.until("/found/.test(document.querySelector('#search-results')?.textContent)");
    await browser.until(`[...document.querySelectorAll("#search-results li a")]
      .some((link) => link.href.includes("${page}"))`);
  }
}

async function testSizes() {
  for (const [width, height, mobile] of [[1280, 800, false], [390, 844, true]]) {
    await browser.size(width, height, mobile);
    for (const page of ["index.html", "docs/glossary.html", "docs/measurements/location.html",
      "gallery/index.html", "playground/index.html", "reference/c/io.html",
      "reference/python/locator.html", "reference/javascript.html",
      "reference/program/meshwalk-locate.html"]) {
      await open(page);
      assert.equal(await browser.value("document.documentElement.scrollWidth"), width, page);
    }
  }
}

/** How bright the page is, from 0 to 255. */
const brightness = () => browser.value(`Number(getComputedStyle(document.body).backgroundColor
  .match(/\\d+/)[0])`);

async function testColours() {
  for (const value of ["light", "dark"]) {
    await browser.send("Emulation.setEmulatedMedia",
      { features: [{ name: "prefers-color-scheme", value }] });
    await open("index.html");
    assert.equal(await brightness() > 128, value === "light");
  }
}

// The page that a card leads to has its mesh.
async function testPlayground() {
  await open("playground/index.html");
  assert.equal(await browser.value("document.querySelectorAll('a.card').length"), 6);
  await browser.open(join(folder, "playground/broken.html"));
  assert.match(await browser.value("document.body.textContent"), /overlap/);
}

try {
  await testSearch();
  await testSizes();
  await testColours();
  await testPlayground();
  assert.deepEqual(browser.faults, []);
  console.log("the site reads well");
} finally {
  await browser.close();
}
