// The slides as a lecture hall sees them.
const assert = require("node:assert/strict");
const fs = require("node:fs");
const zlib = require("node:zlib");
const { after, before, test } = require("node:test");
const { build, files, launch, root, url, watched } = require("./browser.cjs");

const screen = { width: 1280, height: 720 };
const decks = files("slides", ".html").filter((name) => /\d_\w+\.html/.test(name));

/** A stream's text, or "" where it is none. */
function inflated(bytes) {
  try {
    return zlib.inflateSync(bytes, { finishFlush: zlib.constants.Z_SYNC_FLUSH }).toString("latin1");
  } catch {
    return "";
  }
}

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
          .filter((e) => !e.closest("footer, .links, mjx-assistive-mml, defs"))
          .filter((e) => {
            const box = e.getBoundingClientRect();
            return box.width > 0 && (box.left < edge.left - 1 ||
              box.right > edge.right - 20 || box.bottom > bottom ||
              (e.matches("pre") && e.scrollWidth > e.clientWidth + 1));
          })
          .map((e) => (e.textContent.trim() || e.outerHTML).slice(0, 60));
      }, number);
      assert.deepEqual(outside, [], `slide ${number}`);
    }
    assert.deepEqual(page.complaints, []);
    assert.deepEqual(page.requests, []);
    await page.close();
  });

  test(`${deck}: what stands in a drawing can be read from the last row`, async () => {
    const page = await watched(browser, { viewport: screen });
    await page.goto(url(deck));
    const drawings = await page.evaluate(() =>
      [...document.querySelectorAll("section[id]")].flatMap((slide) =>
        [...slide.querySelectorAll("img[src$='.svg']")].map((image) => ({
          slide: slide.id, name: image.getAttribute("src"),
          width: image.clientWidth, height: image.clientHeight }))));
    for (const { slide, name, width, height } of drawings) {
      const svg = fs.readFileSync(`${build}/slides/${name}`, "utf8");
      const [, w, h] = svg.match(/viewBox="0 0 (\d+) (\d+)"/);
      const sizes = [...svg.matchAll(/<text [^>]*font-size="([\d.]+)/g)];
      const least = Math.min(...sizes.map((size) => +size[1])) * Math.min(width / w, height / h);
      assert.ok(least >= 20, `slide ${slide}: ${name} has letters of ${least.toFixed(1)} px`);
    }
    await page.close();
  });

  test(`${deck}: a listing can be read from the last row`, async () => {
    const page = await watched(browser, { viewport: screen });
    await page.goto(url(deck));
    // 540 points are the height of a slide, however large it is shown.
    const small = await page.evaluate(() =>
      [...document.querySelectorAll("section[id]")].flatMap((slide) =>
        [...slide.querySelectorAll("pre")].map((e) => ({
          slide: slide.id, text: e.textContent.trim().slice(0, 40),
          points: parseFloat(getComputedStyle(e).fontSize) * 540 / slide.offsetHeight }))
          .filter((e) => e.points < 17)));
    assert.deepEqual(small, []);
    await page.close();
  });

  test(`${deck}: a question stands alone before its answer`, async () => {
    const page = await watched(browser, { viewport: screen });
    await page.goto(url(deck));
    const shown = await page.evaluate(() =>
      [...document.querySelectorAll("section.trap")].flatMap((slide) =>
        [...slide.querySelectorAll("li, img, pre, table, mjx-container[display]")]
          .filter((e) => !e.closest("h2, [data-marpit-fragment], [data-bespoke-marp-fragment]"))
          .filter((e) => !e.closest(".figure")?.querySelector("[data-marpit-fragment]"))
          .map((e) => `${slide.id}: ${e.textContent.trim().slice(0, 40) || e.outerHTML.slice(0, 60)}`)));
    assert.deepEqual(shown, []);
    await page.close();
  });

  test(`${deck}: links lead into the book, and keep clear of the footer`, async () => {
    const page = await watched(browser, { viewport: screen });
    await page.goto(url(deck));
    const links = await page.locator("section a[href]").evaluateAll((all) =>
      all.map((a) => a.getAttribute("href")).filter((to) => to.startsWith("../")));
    assert.ok(links.length > 0);
    for (const link of links) {
      const [file, id] = link.split("#");
      const text = fs.readFileSync(`${build}/slides/${file}`, "utf8");
      assert.ok(!id || text.includes(`id="${id}"`), link);
    }
    const crossed = await page.evaluate(() =>
      [...document.querySelectorAll(".links")].filter((line) =>
        line.offsetLeft < line.closest("section").querySelector("footer").offsetLeft + 420)
        .map((line) => line.textContent));
    assert.deepEqual(crossed, []);
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

  for (const ending of [".pdf", "_questions.pdf"]) test(`${deck}: there is a PDF, ${ending}`, () => {
    const pdf = fs.readFileSync(`${build}/${deck.replace(".html", ending)}`);
    assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
    for (const part of pdf.toString("latin1").split(/stream\r?\n/).slice(1)) {
      const said = inflated(Buffer.from(part, "latin1"));
      assert.ok(!said.includes("file://"), "a link to this machine");
    }
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

test("the plans add up to the notes", async () => {
  const page = await watched(browser);
  await page.goto(url("slides/index.html"));
  const minutes = (table) => page.locator(`${table} td:last-child`).allTextContents()
    .then((cells) => cells.map((cell) => parseFloat(cell)));
  const sum = (numbers) => numbers.reduce((a, b) => a + b, 0);
  const [one, two, five] = await page.locator("table.plan").all();
  const takes = async (plan) => sum((await plan.locator("td:last-child").allTextContents()).map(parseFloat));
  const decks = await minutes("main > .wide:first-of-type table");
  const all = sum(decks.slice(0, -2)); // stages 6 and 7 are in none of these plans
  const openings = (await takes(five)) - all; // a minute of each session
  assert.ok(openings >= 0 && openings <= 5, `the five sessions take ${openings} minutes more than the decks`);
  assert.ok((await takes(one)) < (await takes(two)));
  assert.ok((await takes(two)) < all);
  await page.close();
});

test("a session says what its own class has written, and leaves out what is skipped", async () => {
  const page = await watched(browser);
  for (const [name, opening, heading, no] of [
    ["one_session_1", /So far: diffuse surfaces/, /^Recap: Which color/, "What it buys"],
    ["two_sessions_1", /So far: nothing but C\+\+/, /^Which color/, "Random numbers"],
    ["five_sessions_5", /Today: coefficients/, /^What to expect/, "no such slide"],
  ]) {
    await page.goto(url(`slides/${name}.html`));
    const slides = await page.locator("section").evaluateAll((all) => all.map((one) => one.textContent.trim()));
    assert.match(slides[1], /^Before we begin/, name);
    assert.match(slides[1], opening, name);
    const headings = await page.locator("section h1").allTextContents();
    assert.match(headings.find((one) => !/Before we begin/.test(one) && one !== headings[0]), heading, name);
    assert.ok(!headings.includes(no), `${name} has ${no}`);
  }
  await page.close();
});

test("a chapter leads to its deck", async () => {
  const page = await watched(browser);
  for (const deck of decks.slice(1)) {
    await page.goto(url(deck.replace("slides/", "book/stages/")));
    await page.locator("p.deck a").click();
    assert.ok(page.url().endsWith(deck), page.url());
  }
  await page.close();
});
