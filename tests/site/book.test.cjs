// The book, as its readers meet it.
const assert = require("node:assert/strict");
const { after, before, test } = require("node:test");
const { files, launch, url, watched } = require("./browser.cjs");

const phone = { width: 390, height: 844 };
const paper = { width: 657, height: 979 }; // A4 within its margins

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** Every page in turn, once its formulas are set. */
async function onEveryPage(options, check) {
  const page = await watched(browser, options);
  for (const name of files("book", ".html")) {
    await page.goto(url(name));
    if (await page.locator("script[src*=mathjax]").count()) {
      await page.waitForFunction(() => window.MathJax?.startup?.promise);
      await page.evaluate(() => window.MathJax.startup.promise);
    }
    await check(page, name);
  }
  await page.close();
}

test("every page is whole, complains of nothing, asks nobody", () =>
  onEveryPage({}, async (page, name) => {
    assert.deepEqual(page.complaints, [], name);
    assert.deepEqual(page.requests, [], name);
    const found = await page.evaluate(() => ({
      formulas: document.querySelectorAll(".math").length,
      set: document.querySelectorAll(".math mjx-container").length,
      errors: document.querySelectorAll("[data-mml-node=merror]").length,
      missing: [...document.images].filter((i) => !i.naturalWidth).length,
    }));
    assert.equal(found.set, found.formulas, `${name}: formulas not set`);
    assert.equal(found.errors, 0, `${name}: broken formulas`);
    assert.equal(found.missing, 0, `${name}: missing pictures`);
  }));

test("the search finds a word", async () => {
  const page = await watched(browser);
  await page.goto(url("book/index.html"));
  await page.keyboard.press("/");
  await page.keyboard.type("roulette");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#search-results li a");
  const found = await page.locator("#search-results li a").allTextContents();
  assert.ok(found.some((title) => /Russian roulette/.test(title)), `${found}`);
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests, []);
  await page.close();
});

test("arrow keys turn the pages", async () => {
  const page = await watched(browser);
  await page.goto(url("book/stages/1_diffuse.html"));
  await page.keyboard.press("ArrowRight");
  await page.waitForURL(/2_next_event/);
  await page.keyboard.press("ArrowLeft");
  await page.waitForURL(/1_diffuse/);
  await page.close();
});

test("links and the search field can be reached with Tab", async () => {
  const page = await watched(browser);
  await page.goto(url("book/index.html"));
  const reached = new Set();
  for (let presses = 0; presses < 40; ++presses) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.tagName));
  }
  assert.ok(reached.has("A") && reached.has("INPUT"), [...reached].join());
  await page.close();
});

test("dark mode is dark, and letters stand out in both", async () => {
  for (const scheme of ["light", "dark"]) {
    const page = await watched(browser, { colorScheme: scheme });
    await page.goto(url("book/stages/1_diffuse.html"));
    const [ground, ink] = await page.evaluate(() => {
      const light = (color) => {
        const [r, g, b] = color.match(/[\d.]+/g).map(Number);
        return (0.2126 * r + 0.7152 * g + 0.0722 * b) / 255;
      };
      const style = getComputedStyle(document.body);
      return [light(style.backgroundColor), light(style.color)];
    });
    assert.equal(ground < 0.3, scheme === "dark", `${scheme}: ground ${ground}`);
    assert.ok(Math.abs(ground - ink) > 0.5, `${scheme}: ${ground}, ${ink}`);
    await page.close();
  }
});

test("the button changes the mode", async () => {
  const page = await watched(browser);
  await page.goto(url("book/index.html"));
  const mode = () => page.evaluate(() => document.body.dataset.theme);
  const first = await mode();
  await page.locator(".theme-toggle:visible").first().click();
  assert.notEqual(await mode(), first);
  await page.close();
});

test("on a phone no page is wider than the screen", () =>
  onEveryPage({ viewport: phone }, async (page, name) => {
    const width = await page.evaluate(
      () => document.documentElement.scrollWidth
    );
    assert.ok(width <= phone.width, `${name} is ${width} wide`);
  }));

test("on paper no code and no formula is cut off", () =>
  onEveryPage({ viewport: paper }, async (page, name) => {
    await page.emulateMedia({ media: "print" });
    const cut = await page.evaluate((width) => {
      const within = (e) => e.getBoundingClientRect().right <= width + 1;
      const shown = (e) => e.getClientRects().length > 0;
      return [...document.querySelectorAll("pre, mjx-container, img, table")]
        .filter(shown)
        .filter((e) => !within(e) || (e.matches("pre") &&
          e.scrollWidth > e.clientWidth + 1))
        .map((e) => e.textContent.trim().slice(0, 60) || e.outerHTML);
    }, paper.width);
    assert.deepEqual(cut, [], name);
  }));

test("a chapter prints to PDF", async () => {
  const page = await watched(browser);
  await page.goto(url("book/stages/3_specular_refraction.html"));
  const pdf = await page.pdf({ preferCSSPageSize: true });
  assert.ok(pdf.length > 50_000, `only ${pdf.length} bytes`);
  await page.close();
});
