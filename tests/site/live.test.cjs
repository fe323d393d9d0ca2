// Live figures: they show the values of the formulas, by pointer and by keyboard,
// and without scripts the still picture is there.
const assert = require("node:assert/strict");
const { after, before, test } = require("node:test");
const { launch, url, watched } = require("./browser.cjs");

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

const figures = {
  snell: "3_specular_refraction",
  "event-bar": "4_russian_roulette",
  inversion: "1_diffuse",
  "fresnel-curves": "5_fresnel_textures",
};

async function figure(name) {
  const page = await watched(browser, { viewport: { width: 1280, height: 900 } });
  await page.goto(url(`book/stages/${figures[name]}.html`));
  const live = page.locator(`.figure.live-${name} .live`);
  const slider = (label) => live.locator(".live-controls").getByLabel(label);
  const says = () => live.locator(".live-says").innerText();
  // In the middle of the window, where neither the page's head nor a smooth scroll catches the click.
  await live.evaluate((element) => element.scrollIntoView({ block: "center", behavior: "instant" }));
  return { page, live, slider, says };
}

async function close(page) {
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests, []);
  await page.close();
}

test("Snell's law: the sines, and no direction beyond the critical angle", async () => {
  const { page, slider, says } = await figure("snell");
  assert.match(await says(), /sin θᵢ = 0\.750, so θᵢ = 48\.6°/); // 1.5 sin 30
  await slider("θₒ").fill("45");
  assert.match(await says(), /would be 1\.061: no such direction.*41\.8°/);
  await slider("ωₒ is in the glass").uncheck();
  assert.match(await says(), /ηₒ\/ηᵢ = 0\.667.*θᵢ = 28\.1°/);
  await slider("η of").fill("2");
  assert.match(await says(), /θᵢ = 20\.7°/);
  await close(page);
});

test("the event bar: which event, its probability, and what is scaled", async () => {
  const { page, slider, says } = await figure("event-bar");
  assert.match(await says(), /specular event.*0\.250, and k\/p = 1\.000/);
  await slider("ξ").fill("0.9");
  assert.match(await says(), /absorption.*0\.150/);
  await slider("kd").fill("0.9");
  await slider("ks").fill("0.9");
  await slider("kt").fill("0");
  assert.match(await says(), /specular event.*0\.500, and k\/p = 1\.800.*add to 1\.80, and are scaled to 1/);
  await slider("bounce 16").check();
  assert.match(await says(), /scaled to 0\.95/);
  await close(page);
});

test("inversion: arccos(1 - xi), and arcsin of its root for the cosine", async () => {
  const { page, slider, says } = await figure("inversion");
  await slider("ξ").fill("0.5");
  assert.match(await says(), /θ = 60\.0°/);
  await slider("cosine").check();
  assert.match(await says(), /θ = 45\.0°.*slope p\(θ\) = 1\.000/);
  await close(page);
});

test("Fresnel: 4 % straight on, Brewster's angle, and all beyond the critical angle", async () => {
  const { page, slider, says } = await figure("fresnel-curves");
  await slider("θₒ").fill("0");
  assert.match(await says(), /F = 0\.040.*Brewster's angle is 56\.3°/);
  await slider("seen from inside").check();
  await slider("θₒ").fill("50");
  assert.match(await says(), /F = 1\.000.*33\.7°, and beyond 41\.8°/);
  await close(page);
});

test("each is moved by the arrow keys, which turn no page, and by dragging", async () => {
  for (const name of Object.keys(figures)) {
    const { page, live, says } = await figure(name);
    const first = await says();
    await live.locator("input[type=range]").first().focus();
    await page.keyboard.press("ArrowRight");
    const second = await says();
    assert.notEqual(second, first, name);
    assert.match(page.url(), new RegExp(figures[name]));
    const drawing = live.locator("svg");
    await drawing.scrollIntoViewIfNeeded();
    const area = await drawing.boundingBox();
    await page.mouse.move(area.x + area.width * 0.4, area.y + area.height * 0.7);
    await page.mouse.down();
    await page.mouse.move(area.x + area.width * 0.3, area.y + area.height * 0.6);
    await page.mouse.up();
    assert.notEqual(await says(), second, name);
    await close(page);
  }
});

test("without scripts the still pictures are there", async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  for (const [name, chapter] of Object.entries(figures)) {
    await page.goto(url(`book/stages/${chapter}.html`));
    assert.ok(await page.locator(`.figure.live-${name} img`).first().isVisible(), name);
  }
  await context.close();
});
