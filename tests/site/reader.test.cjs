// What a reader meets first: the box that paints itself, the section in the header of
// a laptop's page, and exercises whose code is theirs to write.
const assert = require("node:assert/strict");
const { after, before, test } = require("node:test");
const { launch, noBox, url, watched } = require("./browser.cjs");

const laptop = { viewport: { width: 1366, height: 768 } };
const chapter = "book/stages/2_next_event.html";
let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

test("the front page paints the box, and shows the path under the pointer", { skip: noBox }, async () => {
  const page = await watched(browser, laptop);
  await page.goto(url("book/index.html"));
  const says = page.locator(".lab-layout .lab-says");
  await page.waitForFunction(() => parseFloat(document.querySelector(".lab-layout .lab-says")?.textContent) >= 2);
  assert.match(await says.innerText(), /samples per pixel, [\d.]+ million samples\/s/);
  assert.equal(await page.locator(".live-front .panel img").isVisible(), false, "the still picture is still there");
  const area = await page.locator("canvas").boundingBox();
  assert.ok(area.y + area.height / 2 < 768, "the box is below the first screen");
  const drawn = () => page.locator(".lab-over line").count();
  let most = 0;
  for (let i = 0; i < 5; ++i) {
    await page.mouse.move(area.x + area.width * (0.3 + 0.1 * i), area.y + area.height * 0.8);
    await page.waitForTimeout(200);
    most = Math.max(most, await drawn());
  }
  assert.ok(most > 0, "no path is drawn over the picture");
  await page.mouse.move(5, 5);
  assert.equal(await drawn(), 0, "the path stays when the pointer has left");
  assert.deepEqual([page.complaints, page.requests], [[], []]);
  await page.close();
  const still = await watched(browser, { javaScriptEnabled: false });
  await still.goto(url("book/index.html"));
  const picture = still.locator(".live-front .panel img");
  assert.equal(await picture.evaluate((image) => image.naturalWidth), 800);
  await still.close();
});

test("a laptop's page names its section, lists all, and has the search", async () => {
  const page = await watched(browser, laptop);
  await page.goto(url(chapter));
  const name = page.locator(".here summary");
  await page.locator("#a-sphere-that-shines").evaluate((one) => one.scrollIntoView({ behavior: "instant" }));
  await page.waitForFunction(() => document.querySelector(".here summary").textContent === "A sphere that shines");
  await name.press("Enter");
  await page.locator(".here").getByText("Direct light", { exact: true }).click();
  await page.waitForFunction(() => document.querySelector(".here summary").textContent === "Direct light");
  assert.equal(await page.locator(".here").evaluate((one) => one.open), false);
  await page.keyboard.press("/");
  assert.ok(await page.evaluate(() => document.activeElement.matches(".header-search input")), "/ goes elsewhere");
  await page.close();
});

test("an exercise's code is hidden until it is asked for, and what is done is kept", async () => {
  const page = await watched(browser, laptop);
  await page.goto(url(chapter));
  const bodies = page.locator(".exercise-body"), code = bodies.locator(".highlight");
  assert.ok((await code.count()) > 3);
  for (const one of await code.all()) assert.equal(await one.isVisible(), false);
  await page.getByRole("button", { name: /Yours to write: \d+ lines/ }).first().click();
  assert.equal(await code.first().isVisible(), true);
  assert.equal(await code.nth(1).isVisible(), false);
  await page.emulateMedia({ media: "print" });
  assert.equal(await code.nth(1).isVisible(), true, "on paper code is missing");
  await page.emulateMedia({ media: "screen" });
  await page.locator("#exercise-2-1").getByLabel("done").check();
  assert.match(await page.locator(".sidebar-tree .progress").first().textContent(), /1\/\d/);
  await page.getByLabel("Hide the code").uncheck();
  await page.reload();
  assert.equal(await code.nth(1).isVisible(), true, "the switch is forgotten");
  assert.ok(await page.locator("#exercise-2-1").getByLabel("done").isChecked(), "the tick is forgotten");
  await page.getByLabel("Hide the code").check();
  const line = await bodies.last().locator(".linenos[id]").first().getAttribute("id").catch(() => null);
  if (line) {
    await page.goto(`${url(chapter)}#${line}`);
    assert.equal(await code.last().isVisible(), true, "a link to a line leads to nothing");
  }
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("the first two pictures that are compared show one scene", async () => {
  const page = await watched(browser, laptop);
  await page.goto(url(chapter));
  await page.locator(".compare-button").first().click();
  const chosen = (list) => page.locator(`.viewer ${list} option:checked`).textContent();
  assert.equal(await chosen(".first"), "stage 1, rectangle");
  assert.equal(await chosen(".second"), "stage 2, rectangle");
  await page.close();
});
