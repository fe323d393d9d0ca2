// The slides, as a lecture hall meets them.
const assert = require("node:assert/strict");
const fs = require("node:fs");
const { after, before, test } = require("node:test");
const { build, files, launch, root, url, watched } = require("./browser.cjs");

const screen = { width: 1280, height: 720 };
const decks = files("slides", ".html").filter((name) => /\d_\w+\.html/.test(name));

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

test("there is a deck for the recap and for each stage", () => {
  const stages = fs.readdirSync(`${root}/stages`).filter((n) => /^\d_/.test(n));
  assert.equal(decks.length, stages.length + 1);
});

for (const deck of decks) {
  test(`${deck}: nothing sticks out of its slide`, async () => {
    const page = await watched(browser, { viewport: screen });
    await page.goto(url(deck));
    const count = await page.locator("section[id]").count();
    for (let number = 1; number <= count; ++number) {
      await page.evaluate((n) => (location.hash = `#${n}`), number);
      await page.waitForFunction(
        (n) => document.querySelectorAll("svg[data-marpit-svg]")[n - 1]
          .classList.contains("bespoke-marp-active"), number);
      const outside = await page.evaluate((n) => {
        const slide = document.querySelectorAll("section[id]")[n - 1];
        const edge = slide.getBoundingClientRect();
        const top = slide.querySelector("footer").getBoundingClientRect().top;
        const bottom = top > 0 ? top + 1 : edge.bottom - 20;
        return [...slide.querySelectorAll("*")]
          .filter((e) => !e.closest("footer, mjx-assistive-mml, defs"))
          .filter((e) => {
            const box = e.getBoundingClientRect();
            return box.width > 0 && (box.left < edge.left - 1 ||
              box.right > edge.right - 20 || box.bottom > bottom ||
              (e.matches("pre") && e.scrollWidth > e.clientWidth + 1));
          })
          .map((e) => e.textContent.trim().slice(0, 40) || e.outerHTML);
      }, number);
      assert.deepEqual(outside, [], `slide ${number}`);
    }
    assert.deepEqual(page.complaints, []);
    assert.deepEqual(page.requests, []);
    await page.close();
  });

  test(`${deck}: every slide has notes with a time`, async () => {
    const page = await watched(browser);
    await page.goto(url(deck));
    const notes = await page.evaluate(() =>
      [...document.querySelectorAll("section[id]")].map(
        (_, i) => document.querySelector(
          `.bespoke-marp-note[data-index="${i}"]`)?.textContent ?? ""));
    notes.forEach((text, i) =>
      assert.match(text, /^\s*[\d.]+ min\b/, `slide ${i + 1}`));
    await page.close();
  });

  test(`${deck}: every picture is there, every formula is set`, async () => {
    const page = await watched(browser);
    await page.goto(url(deck));
    const found = await page.evaluate(() => ({
      missing: [...document.images].filter((i) => !i.naturalWidth).length,
      errors: document.querySelectorAll("[data-mml-node=merror]").length,
      raw: [...document.querySelectorAll("section p, section li")].filter(
        (e) => /\$[^$]+\$|^:::|\{figure\}/.test(e.textContent)).length,
    }));
    assert.deepEqual(found, { missing: 0, errors: 0, raw: 0 });
    await page.close();
  });

  test(`${deck}: there is a PDF`, () => {
    const pdf = fs.readFileSync(`${build}/${deck.replace("html", "pdf")}`);
    assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
  });
}

test("arrow keys build a slide up and go on", async () => {
  const page = await watched(browser, { viewport: screen });
  await page.goto(`${url("slides/3_specular_refraction.html")}#2`);
  await page.keyboard.press("ArrowRight");
  await page.waitForURL(/#3$/);
  const hidden = () => page.locator(
    ".bespoke-marp-active [data-bespoke-marp-fragment=inactive]").count();
  const first = await hidden();
  assert.ok(first > 0, "slide 3 has nothing to build up");
  await page.keyboard.press("ArrowRight");
  assert.equal(await hidden(), first - 1);
  await page.close();
});

test("the list of decks leads to each of them", async () => {
  const page = await watched(browser);
  await page.goto(url("slides/index.html"));
  const links = await page.locator("a").evaluateAll((all) =>
    all.map((a) => a.getAttribute("href").split("#")[0]));
  for (const link of links) {
    assert.ok(fs.existsSync(`${build}/slides/${link}`), link);
  }
  for (const deck of decks) assert.ok(links.includes(deck.slice(7)), deck);
  await page.close();
});
