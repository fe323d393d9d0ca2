// axe finds nothing serious or critical on any page of the book or any slide, in
// light and in dark, on a phone and on a wide screen.
const assert = require("node:assert/strict");
const fs = require("node:fs");
const { after, before, test } = require("node:test");
const { build, files, launch, url, watched } = require("./browser.cjs");

const axe = fs.readFileSync(`${build}/node/node_modules/axe-core/axe.min.js`, "utf8");
const widths = [390, 1600];
const themes = ["light", "dark"];
// The first view checks every rule. A theme changes colors and which of a
// drawing's two pictures is visible, a width changes colors and what is too wide.
const colors = ["color-contrast", "link-in-text-block"];
const rules = {
  "light 390": null,
  "dark 390": [...colors, "image-alt", "role-img-alt", "svg-img-alt"],
  "light 1600": [...colors, "scrollable-region-focusable"],
  "dark 1600": colors,
};

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** Opens what is folded, stops what moves, and takes out what axe would only
    count: the strokes of formulas, and all words of a listing but one of each
    class. */
function simplify() {
  for (const folded of document.querySelectorAll("details")) folded.open = true;
  document.head.insertAdjacentHTML("beforeend",
    "<style>*, ::before, ::after { transition: none !important; animation: none !important; }</style>");
  for (const formula of document.querySelectorAll("mjx-container > svg")) formula.replaceChildren();
  const kept = new Set();
  for (const word of document.querySelectorAll("pre :is(span, ins, del)")) {
    let kind = "";
    for (let e = word; e && !e.matches("article"); e = e.parentElement) kind += `${e.tagName}.${e.className} `;
    if (kept.has(kind) && !word.firstElementChild) word.replaceWith(word.textContent);
    kept.add(kind);
  }
}

/** Until the page's scripts have seen its new size. */
const drawn = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));

/** What is serious on the page as it is. A chapter has thousands of words, and
    only a few ways to color one: axe measures one word of each, and none of
    those that are known from other pages. */
async function serious({ only, known, colors }) {
  const ways = new Set(known), chosen = new Set();
  const look = new Map();
  const lookOf = (element) => {
    if (!element) return "";
    if (!look.has(element)) {
      const style = getComputedStyle(element);
      const own = [style.backgroundColor, style.backgroundImage, style.opacity, style.filter].join();
      look.set(element, own === "rgba(0, 0, 0, 0),none,1,none" ? lookOf(element.parentElement)
        : `${lookOf(element.parentElement)} ${own}`);
    }
    return look.get(element);
  };
  for (const element of document.body.querySelectorAll("*")) {
    const says = element.matches("input, select, textarea") ||
      [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim());
    if (!says || !element.checkVisibility({ visibilityProperty: true })) continue;
    const style = getComputedStyle(element);
    const around = getComputedStyle(element.parentElement);
    const way = [element.tagName, style.color, style.fontSize, style.fontWeight, style.position,
      style.textDecorationLine, around.color, lookOf(element)].join();
    if (!ways.has(way)) chosen.add(element);
    ways.add(way);
  }
  // If all colors are known, there may be nothing to check.
  if (only && !chosen.size) only = only.filter((id) => !colors.includes(id));
  if (only && !only.length) return { wrong: [], known };
  window.axesOwn ??= Object.fromEntries(axe._audit.rules.map(({ id, matches }) => [id, matches]));
  axe.configure({ rules: colors.map((id) => ({
    id, matches: (node, ...more) => chosen.has(node) && axesOwn[id](node, ...more) })) });
  const found = await axe.run(document, {
    resultTypes: ["violations"], preload: false, iframes: false,
    ...(only && { runOnly: { type: "rule", values: only } }),
  });
  const wrong = found.violations.filter(({ impact }) => /serious|critical/.test(impact))
    .flatMap(({ id, nodes }) => nodes.map((node) =>
      `${id}: ${node.target.join(" ")}: ${node.failureSummary.split("\n")[1].trim()}`));
  return { wrong, known: [...ways] };
}

/** Says what axe finds on a page, in each theme and at each width. */
async function audit(page, name, media, known) {
  const wrong = [];
  for (const width of widths) {
    await page.setViewportSize({ width, height: 900 });
    await page.evaluate(drawn);
    for (const theme of themes) {
      await page.emulateMedia({ colorScheme: theme, media });
      const view = `${media} ${theme} ${width}`;
      const found = await page.evaluate(serious, { only: rules[`${theme} ${width}`], known: known[view], colors });
      known[view] = found.known;
      wrong.push(...found.wrong.map((what) => `${name}, ${theme}, ${width} px: ${what}`));
    }
  }
  return wrong;
}

async function open(page, name) {
  await page.emulateMedia({ media: "screen" });
  await page.goto(url(name), { waitUntil: "domcontentloaded" });
  await page.setViewportSize({ width: widths[0], height: 900 });
  await page.evaluate(axe);
  await page.evaluate(simplify);
}

const none = (wrong) => assert.ok(!wrong.length,
  `${wrong.length} found:\n${wrong.slice(0, 20).join("\n")}${wrong.length > 20 ? "\n..." : ""}`);

test("axe finds nothing serious on any page of the book, nor in the list of decks", async () => {
  const page = await watched(browser);
  const wrong = [], known = {};
  for (const name of [...files("book", ".html"), "slides/index.html"]) {
    await open(page, name);
    wrong.push(...await audit(page, name, "screen", known));
  }
  await page.close();
  none(wrong);
});

test("axe finds nothing serious on any slide", async () => {
  const page = await watched(browser);
  const wrong = [], known = {};
  for (const name of files("slides", ".html").filter((one) => /\/\d_/.test(one))) {
    await open(page, name);
    wrong.push(...await audit(page, `${name}, on the screen`, "screen", known));
    // On paper all slides are visible, with all their steps.
    await page.$$eval("[data-marpit-svg]", (all) => all.forEach((slide) => slide.removeAttribute("aria-hidden")));
    wrong.push(...await audit(page, `${name}, all slides`, "print", known));
  }
  await page.close();
  none(wrong);
});
