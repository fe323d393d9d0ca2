// The book as its readers use it.
const assert = require("node:assert/strict");
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const { after, before, test } = require("node:test");
const { build, files, launch, root, url, watched, wrongLabels } = require("./browser.cjs");

const phone = { width: 390, height: 844 };
const paper = { width: 657, height: 979 }; // A4 within its margins

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** Every page in turn. */
async function onEveryPage(options, check) {
  const page = await watched(browser, options);
  for (const name of files("book", ".html")) {
    await page.goto(url(name));
    await check(page, name);
  }
  await page.close();
}

test("every page is complete, without complaints or requests to other servers", () =>
  onEveryPage({}, async (page, name) => {
    assert.deepEqual(page.complaints, [], name);
    assert.deepEqual(page.requests, [], name);
    const found = await page.evaluate(() => ({
      formulas: document.querySelectorAll(".math").length,
      set: document.querySelectorAll(".math mjx-container").length,
      errors: document.querySelectorAll("[data-mml-node=merror]").length,
      missing: [...document.images].filter((i) => !i.naturalWidth).length,
      raw: [...document.querySelectorAll("article :is(p, li, td, h1, h2, h3, figcaption)")]
        .flatMap((e) => [...e.childNodes])
        .filter((node) => node.nodeType === Node.TEXT_NODE && /\$\S|\\[a-zA-Z]{2}/.test(node.data))
        .map((node) => node.data.trim().slice(0, 60)),
    }));
    assert.deepEqual(found.raw, [], `${name}: formulas that nobody set`);
    assert.equal(found.set, found.formulas, `${name}: formulas not set`);
    assert.equal(found.errors, 0, `${name}: broken formulas`);
    assert.equal(found.missing, 0, `${name}: missing pictures`);
  }));

test("asides are quieter than the text on a wide page, and like it on a narrow one", async () => {
  for (const [width, quiet] of [[1366, true], [390, false]]) {
    const page = await watched(browser, { viewport: { width, height: 844 } });
    await page.goto(url("book/stages/2_next_event.html"));
    const sizes = await page.$$eval(".prose blockquote", (all) => all.map((aside) =>
      [aside, aside.closest(".prose")].map((e) => parseFloat(getComputedStyle(e).fontSize))));
    assert.equal(sizes.length, 4);
    for (const [aside, text] of sizes) assert.equal(aside < text, quiet, `${width}: ${aside} px beside ${text}`);
    await page.close();
  }
});

test("the search finds words of prose and of code, without requests to other servers", async () => {
  const page = await watched(browser);
  const find = async (words) => {
    await page.goto(url("book/index.html"));
    await page.keyboard.press("/");
    await page.keyboard.type(words);
    await page.keyboard.press("Enter");
    await page.waitForSelector("#search-results .search-summary");
    await page.waitForFunction(() => !/Searching|Preparing/.test(document.querySelector("#search-results").innerText));
    return page.$$eval("#search-results li a", (links) => links.map((link) => link.href));
  };
  const finds = async (words, place) => {
    const found = await find(words);
    assert.ok(found.some((href) => place.test(href)), `${words}: ${found.join("\n")}`);
  };
  await finds("critical angle", /stages\/3_specular_refraction\.html/);
  await finds("Russian roulette", /stages\/4_russian_roulette\.html/);
  await finds("lobe_probabilities", /stages\/4_russian_roulette\.html/);
  await finds("bounding volume hierarchy", /core\//);
  assert.deepEqual(await find("qwertyuiop"), []);
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

test("a listing that is wider than a phone is moved by arrow keys, which turn no page", async () => {
  const page = await watched(browser, { viewport: phone });
  await page.goto(url("book/stages/1_diffuse.html"));
  assert.ok(await page.locator("pre[tabindex='0']").count() > 0, "no listing can be reached with Tab");
  await page.locator("pre[tabindex='0']").first().focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.activeElement.scrollLeft > 0);
  assert.match(page.url(), /1_diffuse/);
  await page.setViewportSize({ width: 1600, height: 900 });
  await page.waitForFunction(() => ![...document.querySelectorAll(".code pre[tabindex]")]
    .some((one) => !one.closest("details")));
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

const themes = ["light", "dark"];

test("a drawing is there for each theme, and only one of the two is seen", async () => {
  for (const scheme of themes) {
    const page = await watched(browser, { colorScheme: scheme });
    await page.goto(url("book/stages/3_specular_refraction.html"));
    const seen = await page.evaluate(() =>
      [...document.images].filter((i) => i.src.endsWith(".svg") && i.checkVisibility())
        .map((i) => i.src.endsWith("-dark.svg")));
    assert.ok(seen.length > 0, "chapter 3 has no drawing");
    assert.ok(seen.every((dark) => dark === (scheme === "dark")), `${scheme}: ${seen}`);
    await page.close();
  }
});

test("labels of drawings are as large as the text, inside, and apart", async () => {
  const page = await watched(browser);
  const drawings = files("book", ".svg").filter((name) =>
    /_images/.test(name) && fs.existsSync(`${build}/${name.replace(/(-dark)?\.svg$/, "-dark.svg")}`));
  assert.ok(drawings.length > 0, "the book has no drawing");
  for (const name of drawings) {
    await page.goto(url(name));
    // A drawing fills 541 pixels, and the text has 16.
    const wrong = await page.evaluate(`(${wrongLabels})(document.documentElement, 541 / document.documentElement.viewBox.baseVal.width)`);
    assert.deepEqual(wrong, [], name);
  }
  await page.close();
});

test("labels of drawings stand out 4.5 to 1 from what they stand on", async () => {
  const page = await watched(browser);
  for (const name of [...files("book/_images", ".svg"), ...files("slides/figures", ".svg")]) {
    await page.goto(url(name));
    const paper = name.endsWith("-dark.svg") ? [19, 20, 22] : [253, 252, 249];
    const pale = await page.evaluate((paper) => {
      const light = (color) => {
        const [r, g, b] = color.map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
      };
      const parts = (color) => color.match(/[\d.]+/g).map(Number);
      // The filled shapes below the label's middle, in the order of drawing.
      const shapes = [...document.querySelectorAll("rect, circle, ellipse, polygon, path, text")];
      const under = (label, { x, y, width, height }) => {
        const middle = new DOMPoint(x + width / 2, y + height / 2);
        let color = paper;
        for (const shape of shapes.slice(0, shapes.indexOf(label))) {
          const { fill, fillOpacity } = getComputedStyle(shape);
          if (shape.matches("text, marker *") || fill === "none" || !shape.isPointInFill(middle)) continue;
          color = parts(fill).map((c, i) => fillOpacity * c + (1 - fillOpacity) * color[i]);
        }
        return color;
      };
      return [...document.querySelectorAll("text")].filter((label) => label.textContent.trim()).map((label) => {
        const [ink, ground] = [parts(getComputedStyle(label).fill), under(label, label.getBBox())];
        const [a, b] = [light(ink), light(ground)];
        return { ratio: Math.max(a, b) / Math.min(a, b), says: `${label.textContent}: (${ink}) on (${ground})` };
      }).filter(({ ratio }) => ratio < 4.5).map(({ ratio, says }) => `${says} is ${ratio.toFixed(2)}`);
    }, paper);
    assert.deepEqual(pale, [], name);
  }
  await page.close();
});

test("at 1280 pixels no listing of a chapter is cut off", () =>
  onEveryPage({ viewport: { width: 1280, height: 900 } }, async (page, name) => {
    if (!name.startsWith("book/stages/")) return;
    const cut = await page.evaluate(() =>
      [...document.querySelectorAll(".code pre")]
        .filter((e) => e.checkVisibility() && !e.closest("details") &&
          e.scrollWidth > e.clientWidth + 1)
        .map((e) => e.textContent.trim().slice(0, 60)));
    assert.deepEqual(cut, [], name);
  }));

test("an exercise's badge leads to its task, whose hints are folded", async () => {
  const page = await watched(browser, { viewport: { width: 1280, height: 900 } });
  await page.goto(url("book/stages/3_specular_refraction.html"));
  const hint = page.locator("#exercise-3-1 details").first();
  assert.equal(await hint.getAttribute("open"), null);
  await page.locator(".exercise-body a").first().click();
  await page.waitForURL(/#exercise-3-1$/);
  await hint.locator("summary").click();
  assert.equal(await hint.locator("p").first().isVisible(), true);
  const text = await page.locator("article").innerText();
  assert.doesNotMatch(text, /#region|#endregion|#stub/);
  const folded = page.locator(".question details");
  assert.equal(await folded.count(), 3);
  assert.equal(await page.locator(".question details[open]").count(), 0);
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.locator("#exercise-3-1").isVisible(), true);
  for (const one of await page.locator("details").all()) {
    assert.equal(await one.isVisible(), false);
  }
  await page.close();
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
    // Nothing sticks out that one cannot scroll to.
    const cut = await page.evaluate((edge) => {
      const scrolled = (e) => e.closest("pre, .table-wrapper, .math-wrapper, svg, mjx-assistive-mml, .lab-path");
      return [...document.querySelectorAll("article *")]
        .filter((e) => e.checkVisibility() && !scrolled(e) && e.getBoundingClientRect().right > edge + 1)
        .map((e) => `${e.tagName}.${e.className}: ${e.textContent.trim().slice(0, 40)}`);
    }, phone.width);
    assert.deepEqual(cut, [], name);
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

test("the whole book prints to one PDF, with an outline and no address of this machine", () => {
  execFileSync(`${build}/site-venv/bin/python`, ["-B", "-m", "tools.book.pdf"], { cwd: root });
  const pdf = fs.readFileSync(`${build}/book/lightwalk.pdf`).toString("latin1");
  assert.ok((pdf.match(/\/Type \/Page\b/g) ?? []).length > 60, "pages are missing");
  assert.match(pdf, /\/Outlines/);
  assert.ok(!/file:\/\//.test(pdf), "a link to this machine");
});

test("a chapter prints to PDF", async () => {
  const page = await watched(browser);
  await page.goto(url("book/stages/3_specular_refraction.html"));
  const pdf = await page.pdf({ preferCSSPageSize: true });
  assert.ok(pdf.length > 50_000, `only ${pdf.length} bytes`);
  await page.close();
});

test("a name in a listing leads to the line that defines it", async () => {
  const page = await watched(browser);
  await page.goto(url("book/stages/4_russian_roulette.html"));
  const links = await page.$$eval(".highlight a.n", (all) => all.map((link) => [link.innerText, link.href]));
  const place = Object.fromEntries(links);
  assert.match(place.direct_light, /2_next_event\.html#L\d+/);
  assert.match(place.spawn_ray, /core\/geometry\/ray\.html#L\d+/);
  for (const [name, href] of links) {
    await page.goto(href);
    const line = await page.evaluate(() => {
      const number = document.getElementById(location.hash.slice(1));
      let text = "";
      for (let node = number?.nextSibling; node && !/\n/.test(text); node = node.nextSibling) text += node.textContent;
      return text;
    });
    assert.match(line, new RegExp(`\\b${name}\\b`), href);
  }
  await page.close();
});

test("formulas are there without JavaScript", async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(url("book/stages/2_next_event.html"));
  const sizes = await page.locator(".math svg").evaluateAll((all) => all.map((one) => one.getBoundingClientRect().width))
    .catch(() => null);
  const count = sizes ? sizes.filter((width) => width > 3).length : await page.locator(".math svg").count();
  assert.ok(count > 100, `${count} formulas`);
  await context.close();
});

test("a figure opens large, and two of its pictures are compared", async () => {
  const page = await watched(browser, { viewport: { width: 1280, height: 900 } });
  await page.goto(url("book/stages/2_next_event.html"));
  const figure = page.locator(".figure", { has: page.locator(".compare-button") }).first();
  await figure.locator(".compare-button").focus();
  await page.keyboard.press("Enter");
  const dialog = page.locator("dialog.viewer");
  assert.ok(await dialog.isVisible());
  const shown = () => page.$eval(".viewer-stage", (stage) => getComputedStyle(stage.querySelector(".over")).clipPath);
  const before = await shown();
  await page.keyboard.press("ArrowRight"); // the edge has the focus
  assert.notEqual(await shown(), before);
  await dialog.locator("input[type=checkbox]").check();
  assert.equal(await page.$eval(".viewer .over", (image) => getComputedStyle(image).mixBlendMode), "difference");
  const [left, right] = await page.$$eval(".viewer-stage img", (images) => images.map((image) => image.src));
  assert.notEqual(left, right);
  await page.keyboard.press("Escape");
  assert.ok(!(await dialog.isVisible()));
  await figure.locator(".panel img").first().click();
  assert.ok(await dialog.isVisible());
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("the fonts are the book's own", async () => {
  const page = await watched(browser);
  await page.goto(url("book/stages/1_diffuse.html"));
  await page.evaluate(() => document.fonts.ready);
  const loaded = await page.evaluate(() =>
    [...document.fonts].filter((font) => font.status === "loaded").map((font) => font.family.replace(/"/g, "")));
  for (const family of ["Source Serif 4 Variable", "JetBrains Mono Variable"]) assert.ok(loaded.includes(family), `${loaded}`);
  assert.equal(await page.$eval(".highlight pre", (pre) => getComputedStyle(pre).fontSize), "14px");
  await page.close();
});
