// A page loads little before it shows its first words, and live figures are small.
// Times depend on the machine: the test prints them, but does not check them.
const assert = require("node:assert/strict");
const fs = require("node:fs");
const { after, before, test } = require("node:test");
const { fileURLToPath } = require("node:url");
const { build, files, launch, url, watched } = require("./browser.cjs");

const KB = 1024;
const limits = { styles: 200 * KB, fonts: 300 * KB, scripts: 1 * KB, page: 550 * KB };
const live = 1000 * KB;

const bytes = (address) => fs.statSync(fileURLToPath(address.split(/[?#]/)[0])).size;
const sum = (numbers) => numbers.reduce((a, b) => a + b, 0);
const list = (found) => found.map(([size, name]) => `${inKB(size)} ${name}`).join("\n");
const inKB = (number) => `${Math.ceil(number / KB)} KB`;

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** The scripts that stand before the end of what is read, and are waited for. */
function waitedFor() {
  const read = document.querySelector("article, main, section");
  return [...document.scripts].filter((script) => !script.defer && !script.async && script.type !== "module" &&
    /^(|text\/javascript)$/.test(script.type) &&
    !(read.compareDocumentPosition(script) & Node.DOCUMENT_POSITION_FOLLOWING &&
      !read.contains(script)))
    .map((script) => ({ src: script.src, length: script.src ? 0 : script.text.length }));
}

const firstWords = () => new Promise((done) => new PerformanceObserver((list) => {
  for (const { name, startTime } of list.getEntries()) if (name === "first-contentful-paint") done(startTime);
}).observe({ type: "paint", buffered: true }));

test("a page loads little before it shows its first words", async (context) => {
  const page = await watched(browser, { viewport: { width: 1600, height: 900 } });
  const times = [], most = {};
  let asked;
  page.on("request", (request) => asked.push(request));
  for (const name of [...files("book", ".html"), ...files("slides", ".html")]) {
    asked = [];
    await page.goto(url(name));
    times.push([await page.evaluate(firstWords), name]);
    const kind = (type) => [...new Set(asked.filter((one) => one.resourceType() === type).map((one) => one.url()))];
    const scripts = await page.evaluate(waitedFor);
    const sized = (all) => all.map((address) => [bytes(address), address.split("/").pop()]);
    const found = {
      page: sized([url(name)]),
      styles: sized(kind("stylesheet")),
      fonts: sized(kind("font")),
      scripts: scripts.map(({ src, length }) => (src ? sized([src])[0] : [length, "within the page"])),
    };
    const session = /_session/.test(name); // several decks
    for (const [what, limit] of Object.entries(session ? { ...limits, page: 1024 * KB } : limits)) {
      const size = sum(found[what].map(([one]) => one));
      most[what] = Math.max(most[what] ?? 0, size);
      assert.ok(size <= limit, `${name}: ${inKB(size)} of ${what}, at most ${inKB(limit)} are expected\n${list(found[what])}`);
    }
  }
  await page.close();
  times.sort(([a], [b]) => b - a);
  context.diagnostic(`at most ${Object.entries(most).map(([what, size]) => `${inKB(size)} of ${what}`).join(", ")}`);
  context.diagnostic(`first words after ${times.slice(0, 3).map(([ms, name]) => `${Math.round(ms)} ms (${name})`).join(", ")}; ` +
    `half of the pages within ${Math.round(times[times.length >> 1][0])} ms`);
});

test("the files of live figures are under a megabyte together", (context) => {
  const found = ["live.js", "live.css", "lab.js", "lab.css", "lab-module.js"]
    .map((name) => `${build}/book/_static/${name}`).filter(fs.existsSync)
    .map((name) => [fs.statSync(name).size, name.split("/").pop()]);
  const all = sum(found.map(([size]) => size));
  assert.ok(found.length >= 3, "no script of a live figure is there");
  assert.ok(all < live, `${inKB(all)}, less than ${inKB(live)} are expected\n${list(found)}`);
  context.diagnostic(list(found).replaceAll("\n", ", "));
});
