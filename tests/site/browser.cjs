// What the tests of the book and the slides share: Chromium, and pages that
// record their requests and complaints.
const fs = require("node:fs");
const path = require("node:path");
const { pathToFileURL } = require("node:url");

const root = path.resolve(__dirname, "../..");
const build = path.resolve(process.env.LIGHTWALK_BUILD ?? `${root}/build`);
const { chromium } = require(`${build}/node/node_modules/playwright-core`);

function executable() {
  const names = ["chromium", "google-chrome", "chromium-browser"];
  for (const folder of process.env.PATH.split(":")) {
    for (const name of names) {
      if (fs.existsSync(`${folder}/${name}`)) return `${folder}/${name}`;
    }
  }
  for (const name of ["Chromium", "Google Chrome"]) {
    const program = `/Applications/${name}.app/Contents/MacOS/${name}`;
    if (fs.existsSync(program)) return program;
  }
  throw new Error("no chromium nor google-chrome on the PATH");
}

function launch() {
  return chromium.launch({
    executablePath: process.env.CHROME_PATH ?? executable(),
    args: process.getuid?.() === 0 ? ["--no-sandbox"] : [],
  });
}

/** A page whose `complaints` and `requests` elsewhere are collected. */
async function watched(browser, options = {}) {
  const page = await browser.newPage(options);
  page.complaints = [];
  page.requests = [];
  page.on("console", (message) => {
    if (message.type() === "error") page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("requestfailed", (request) => {
    const why = request.failure()?.errorText;
    if (why !== "net::ERR_ABORTED") {
      page.complaints.push(`${why}: ${request.url()}`);
    }
  });
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) {
      page.requests.push(request.url());
    }
  });
  return page;
}

/** Files under a folder of the build, by their suffix. */
function files(folder, suffix) {
  return fs
    .readdirSync(`${build}/${folder}`, { recursive: true })
    .filter((name) => name.endsWith(suffix))
    .map((name) => `${folder}/${name}`)
    .sort();
}

/** The reason to skip tests of the live box, or false. */
const noBox = fs.existsSync(`${build}/book/_static/lab-module.js`) ? false : "NOT TESTED: tools/setup.sh site";

/** What is wrong with a drawing's labels: smaller than the text, outside, or on each
 * other. Runs in a page; `scale` is the drawing's on pages. */
function wrongLabels(svg, scale) {
  const { width, height } = svg.viewBox.baseVal;
  const labels = [...svg.querySelectorAll("text")].map((e) => ({
    text: e.textContent, size: scale * parseFloat(getComputedStyle(e).fontSize), box: e.getBBox(),
  }));
  const overlap = (a, b) =>
    Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x) > 1 &&
    Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y) > 5;
  return labels.flatMap(({ text, size, box }, i) => [
    ...(box.x < 0 || box.y < 0 || box.x + box.width > width || box.y + box.height > height ? [`outside: ${text}`] : []),
    ...(size < 15.99 ? [`small: ${text}`] : []),
    ...labels.slice(0, i).filter((other) => overlap(box, other.box)).map((other) => `on each other: ${text}, ${other.text}`),
  ]);
}

const url = (name) => pathToFileURL(`${build}/${name}`).href;

module.exports = { build, files, launch, noBox, root, url, watched, wrongLabels };
