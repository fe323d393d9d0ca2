// The pages of mistakes: the pictures, the tables and their filter.
const assert = require("node:assert/strict");
const fs = require("node:fs");
const path = require("node:path");
const { after, before, test } = require("node:test");
const { build, launch, url, watched } = require("./browser.cjs");

const gallery = "book/mistakes.html", tables = "book/known_mistakes.html";

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

async function opened(address, hash = "") {
  const page = await watched(browser);
  await page.goto(url(address) + hash);
  return page;
}

const shown = (page) => page.locator("table.mistakes tbody tr:visible").count();
const said = (page) => page.locator(".search-mistakes [role=status]").innerText();

test("twenty-four pairs, right and wrong, unlike each other, and each can be chosen by its look", async () => {
  const page = await opened(gallery);
  const pairs = await page.evaluate(() =>
    [...document.querySelectorAll(".mistake .figure.compare")].map((pair) => ({
      labels: [...pair.querySelectorAll(".panel > p:last-child")].map((p) => p.textContent),
      sources: [...pair.querySelectorAll(".panel img")].map((i) => i.getAttribute("src")),
      sizes: [...pair.querySelectorAll(".panel img")].map((i) => i.naturalWidth),
    })));
  assert.equal(pairs.length, 24);
  for (const { labels, sources, sizes } of pairs) {
    assert.deepEqual(labels, ["right", "wrong"]);
    assert.deepEqual(sizes, [256, 256]);
    const [right, wrong] = sources.map((s) => fs.readFileSync(`${build}/book/${s}`));
    assert.ok(!right.equals(wrong), `${sources}`);
  }
  const links = page.locator(".contact-sheet a");
  assert.equal(await links.count(), 24);
  await links.nth(4).click();
  const [title, target] = await Promise.all([
    links.nth(4).innerText(),
    page.evaluate(() => document.querySelector(":target h4, h4:target, :target + h4")?.firstChild.data),
  ]);
  assert.equal(title.trim().replace(/[’']/g, ""), target.trim().replace(/[’']/g, ""));
  await page.close();
});

for (const address of [gallery, tables]) test(`${address} is light, no name stands there twice, and every link leads somewhere`, async () => {
  const size = fs.statSync(`${build}/${address}`).size;
  assert.ok(size < 600_000, `${size} bytes`);
  const page = await opened(address);
  const { names, links } = await page.evaluate(() => ({
    names: [...document.querySelectorAll("[id]")].map((e) => e.id),
    links: [...document.querySelectorAll("article a[href]")].map((a) => a.getAttribute("href")),
  }));
  assert.deepEqual(names.filter((name, i) => names.indexOf(name) < i), []);
  const texts = {};
  for (const link of new Set(links)) {
    const [file, name] = link.split("#");
    const target = path.join(path.dirname(`${build}/${address}`), file || path.basename(address));
    texts[target] ??= fs.readFileSync(target, "utf8");
    assert.ok(!name || texts[target].includes(`id="${name}"`), link);
  }
  await page.close();
});

test("words and the stage filter the rows as one types, and Escape shows all", async () => {
  const page = await opened(tables);
  const all = await page.locator("table.mistakes tbody tr").count();
  assert.equal(await said(page), `${all} of ${all}`);
  // Two words of one row; as typed, the apostrophe of one is straight.
  const [word] = (await page.locator("table.mistakes tbody").first().innerText()).match(/[a-z]+’s/);
  await page.getByLabel("Search the mistakes").focus();
  await page.keyboard.type(`the ${word.replace("’", "'")}`);
  const some = await shown(page);
  assert.ok(some > 0 && some < all, `${some} of ${all}`);
  assert.equal(await said(page), `${some} of ${all}`);
  await page.keyboard.press("Escape");
  assert.equal(await shown(page), all);
  await page.locator("form select").selectOption("3");
  const stages = await page.locator("table.mistakes tbody tr:visible td:first-child").allInnerTexts();
  assert.deepEqual([...new Set(stages)], ["3"]);
  await page.getByLabel("Search the mistakes").fill("no such words");
  assert.equal(await said(page), `0 of ${all}`);
  assert.equal(await shown(page), 0);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("the arrow keys in the field turn no page", async () => {
  const page = await opened(tables);
  await page.getByLabel("Search the mistakes").fill("pi");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowLeft");
  await page.locator("form select").focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForTimeout(300);
  assert.match(page.url(), /mistakes\.html$/);
  await page.close();
});

test("a link to a mistake shows it with its lines, whatever was searched for", async () => {
  const page = await opened(tables, "#lamp-shines-on-both-sides");
  const row = page.locator("#stage1-lamp-shines-on-both-sides");
  assert.equal(await row.locator("pre").isVisible(), true);
  await page.getByLabel("Search the mistakes").fill("roulette");
  assert.equal(await row.isVisible(), false);
  await page.evaluate(() => (location.hash = "#stage1-kd-twice"));
  await page.waitForFunction(() => document.querySelector("#stage1-kd-twice").checkVisibility());
  assert.equal(await page.locator("#stage1-kd-twice pre").isVisible(), true);
  await page.close();
});

test("without JavaScript the whole table stands there", async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(url(tables));
  assert.ok((await shown(page)) > 200);
  assert.equal(await page.locator(".search-mistakes").count(), 0);
  await page.locator("table.mistakes summary").first().click();
  assert.equal(await page.locator("table.mistakes pre").first().isVisible(), true);
  await context.close();
});
