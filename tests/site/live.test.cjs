// Figures that live: handles that are dragged, and moved with arrow keys.
const assert = require("node:assert/strict");
const { after, before, test } = require("node:test");
const { launch, url, watched } = require("./browser.cjs");

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

const chapters = {
  "inversion": "1_diffuse",
  "snell": "3_specular_refraction",
  "event-bar": "4_russian_roulette",
  "fresnel-curves": "5_fresnel_textures",
};

async function opened(name, options = {}) {
  const page = await watched(browser, options);
  await page.goto(url(`book/stages/${chapters[name]}.html`));
  const figure = page.locator(`.live-${name}`);
  const says = () => figure.locator(".live-says").innerText();
  return { page, figure, says, handle: figure.getByRole("slider").first() };
}

/** Drags a handle by so many pixels. */
async function drag(page, handle, right, down) {
  await handle.scrollIntoViewIfNeeded();
  const box = await handle.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + right, y + down, { steps: 4 });
  await page.mouse.up();
}

test("handles follow the mouse and the arrow keys, and say their value", async () => {
  for (const [name, [right, down]] of Object.entries({
    "inversion": [0, -40], "snell": [-60, -20], "event-bar": [60, 0], "fresnel-curves": [30, 0],
  })) {
    const { page, figure, says, handle } = await opened(name);
    const value = () => handle.getAttribute("aria-valuenow").then(Number);
    const [first, words] = [await value(), await says()];
    await drag(page, handle, right, down);
    assert.ok((await value()) > first, `${name}: dragged, and still ${first}`);
    assert.notEqual(await says(), words, name);
    assert.ok(await handle.getAttribute("aria-label"), name);
    assert.ok(await handle.getAttribute("aria-valuetext"), name);
    const dragged = await value();
    await handle.press("ArrowRight");
    assert.ok((await value()) > dragged, `${name}: the arrow key moves nothing`);
    assert.match(page.url(), new RegExp(chapters[name]), "the arrow key turned the page");
    await handle.press("Home");
    assert.equal(await value(), Number(await handle.getAttribute("aria-valuemin")), name);
    assert.equal(await figure.locator(".panel img").first().isVisible(), false, name);
    assert.deepEqual(page.complaints, []);
    await page.close();
  }
});

test("a finger drags, too", async () => {
  const { page, handle } = await opened("inversion", { hasTouch: true, viewport: { width: 390, height: 844 } });
  assert.equal(await handle.evaluate((e) => getComputedStyle(e).touchAction), "none");
  await drag(page, handle, 0, 30);
  assert.ok(Number(await handle.getAttribute("aria-valuenow")) < 0.65);
  await page.close();
});

/** Presses a key until the figure says it; what it said on the way. */
async function until(handle, says, key, pattern) {
  for (let presses = 0; presses < 400; ++presses) {
    const words = await says();
    if (pattern.test(words)) return words;
    await handle.press(key);
  }
  assert.fail(`never said: ${pattern}`);
}

test("the numbers are right", async () => {
  const inversion = await opened("inversion");
  assert.match(await inversion.says(), /ξ = 0\.65 leads to θ = 69\.5°.* 6\.1° of angles/); // acos 0.35
  await inversion.page.close();

  const snell = await opened("snell");
  assert.match(await snell.says(), /39\.3° in air/); // asin(1.5 sin 25)
  const last = await until(snell.handle, snell.says, "ArrowUp", /all is reflected/);
  assert.match(last, /41\.[89]|42\.0/); // asin(1 / 1.5) = 41.81
  await snell.handle.press("End");
  for (let presses = 0; presses < 15; ++presses) await snell.handle.press("PageDown");
  assert.match(await snell.says(), /In air at 30\.0°.* 19\.5° in glass/); // asin(sin 30 / 1.5)
  await snell.page.close();

  const bar = await opened("event-bar");
  assert.match(await bar.says(), /“specular”, from 0\.33 to 0\.56.*divided by 0\.23: times 4\.35/);
  const number = bar.figure.getByRole("slider", { name: "random number" });
  await number.press("End");
  assert.match(await bar.says(), /“absorbed”.*The path ends/);
  await bar.page.close();

  const fresnel = await opened("fresnel-curves");
  assert.match(await fresnel.says(), /outside, F = 0\.089, .*inside, F = 1: all/);
  await fresnel.handle.press("Home"); // ((1.5 - 1) / (1.5 + 1))^2 = 0.04
  assert.match(await fresnel.says(), /outside, F = 0\.040,.*inside, F = 0\.040/);
  await fresnel.figure.getByRole("slider", { name: "η" }).press("End");
  assert.match(await fresnel.says(), /outside, F = 0\.184/); // (1.5 / 3.5)^2
  await fresnel.page.close();
});

test("labels stay in the drawing, whatever is dragged", async () => {
  for (const name of Object.keys(chapters)) {
    const { page, figure, handle } = await opened(name);
    for (let press = 0; press < 45; ++press) {
      await handle.press(press ? "PageUp" : "Home");
      const out = await figure.evaluate((e) => {
        const sheet = e.querySelector("svg").getBoundingClientRect();
        return [...e.querySelectorAll("svg text")].filter((text) => {
          const box = text.getBoundingClientRect();
          return box.width && (box.left < sheet.left || box.right > sheet.right || box.top < sheet.top || box.bottom > sheet.bottom);
        }).map((text) => text.textContent);
      });
      assert.deepEqual(out, [], `${name} after ${press} presses`);
    }
    await page.close();
  }
});

test("without JavaScript and on paper the still figure stands there", async () => {
  const still = await opened("snell", { javaScriptEnabled: false });
  assert.equal(await still.figure.locator(".panel img.only-light").isVisible(), true);
  await still.page.close();
  const { page, figure } = await opened("snell");
  await page.emulateMedia({ media: "print" });
  assert.equal(await figure.locator(".panel img.only-light").isVisible(), true);
  assert.equal(await figure.locator(".live-stage").isVisible(), false);
  await page.close();
});
