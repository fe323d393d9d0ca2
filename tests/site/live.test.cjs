// Live figures: they show the values of the formulas, by pointer and by keyboard,
// and without scripts the still picture is there.
const assert = require("node:assert/strict");
const { after, before, test } = require("node:test");
const { launch, url, watched, wrongLabels } = require("./browser.cjs");

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
  "inverse-square": "2_next_event",
  "area-to-angle": "2_next_event",
  "lamp-cone": "2_next_event",
  "idle-lanes": "6_many_paths",
  "density-estimate": "7_photon_mapping",
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

test("the inverse square: four times the area, a quarter of the weight", async () => {
  const { page, slider, says } = await figure("inverse-square");
  assert.match(await says(), /d = 1\.00 the area is 0\.100 m².*is 1\.000 W.*2d = 2\.00 they are 0\.400 m² and 0\.250 W/);
  await slider("d").fill("1.5");
  assert.match(await says(), /d = 1\.50 the area is 0\.225 m².*is 0\.444 W.*2d = 3\.00 they are 0\.900 m² and 0\.111 W/);
  await close(page);
});

test("area to angle: cos θ′/d² of the area, cos θ′/d of a line, and 0 from behind", async () => {
  const { page, live, slider, says } = await figure("area-to-angle");
  assert.match(await says(), /0\.766\/16\.00 dA = 0\.0479 dA.*0\.192 times as long.*0\.250 times/);
  await slider("θ′").fill("60");
  await slider(/^d /).fill("3");
  assert.match(await says(), /0\.500\/9\.00 dA = 0\.0556 dA.*a cut.*0\.167 times as long.*0\.333 times/);
  // The drawing has the lengths that the words have, nearly: its patch is not small.
  const [patch, turned, piece] = await live.evaluate((box) => [".warm.thick", ".green", ".cool.thick"]
    .map((kind) => box.querySelector(`svg .stroke${kind}`).getTotalLength()));
  assert.ok(Math.abs(turned / patch - 0.5) < 1e-3, `cos θ′: ${turned / patch}`);
  assert.ok(Math.abs(piece / patch - 0.167) < 0.01, `cos θ′/d: ${piece / patch}`);
  await slider("θ′").fill("120");
  assert.match(await says(), /cos θ′ = −0\.500.*the weight is 0/);
  assert.equal(await live.locator("svg .cool").count(), 0);
  await close(page);
});

test("the lamp's cone: its angle, the direction, and the first point on the sphere", async () => {
  const { page, live, slider, says } = await figure("lamp-cone");
  await slider("d").fill("4");
  await slider("r").fill("1");
  await slider("ξ").fill("0.5");
  // 1 - cos(arcsin(1/4)) = 0.0318, half of it is 0.0159; 4 sin θ = 0.710, whose half chord is 0.704.
  assert.match(await says(), /r\/d = 0\.250, so θmax = 14\.5° and Ωc = 0\.200 sr/);
  assert.match(await says(), /= 0\.984, so θ = 10\.2°.* = 3\.936 − 0\.704 = 3\.232\./);
  const far = await live.evaluate((box) => {
    const at = (one) => [one.cx.baseVal.value, one.cy.baseVal.value];
    const away = ([a, b], [c, d]) => Math.hypot(a - c, b - d);
    const [first] = [...box.querySelectorAll("svg circle.warm")].map(at), [x, center] = [...box.querySelectorAll("svg circle.ink")].map(at);
    return [away(first, center), away(first, x)].map((length) => (4 * length) / away(x, center));
  });
  assert.deepEqual(far.map((length) => length.toFixed(3)), ["1.000", "3.232"]);
  await slider("ξ").fill("1");
  assert.match(await says(), /θ = 14\.5°.* − 0\.000 = 3\.873/);
  await close(page);
});

test("lanes: without a refill all wait for the longest path, and with it all work", async () => {
  const { page, live, slider, says } = await figure("idle-lanes");
  /** The paths that are drawn, as [first step, steps]. */
  const paths = () => live.evaluate((box) => [...box.querySelectorAll("svg rect.fill")].map((e) =>
    [(e.x.baseVal.value - 8) / 12, Math.round((e.width.baseVal.value + 1) / 12)]));
  const sum = (all) => all.reduce((a, [, steps]) => a + steps, 0);
  await slider("steps").fill("42");
  const alone = await paths();
  for (const [first] of alone) assert.equal(alone.filter(([other]) => other === first).length, 16, `${first}`);
  const share = Math.round((100 * sum(alone)) / (16 * 42));
  assert.ok(share > 25 && share < 40, `${share} %`); // 1/0.2 steps of H(16)/0.223 + 1/2, that is 32 %
  assert.match(await says(), new RegExp(`so far ${share} % of the lanes`));
  await slider("refill").check();
  assert.match(await says(), /In step 42, 16 of 16 lanes work.*so far 100 % of the lanes/);
  assert.equal(sum(await paths()), 16 * 42);
  await slider("refill").uncheck();
  await slider("steps").fill("1");
  assert.match(await says(), /In step 1, 16 of 16 lanes work.*100 %/);
  // As many end at the first step as are not there at the second: about a half.
  await slider("chance").fill("0.5");
  const [, ended] = (await says()).match(/(\d+) paths have ended/);
  await slider("steps").fill("2");
  assert.match(await says(), new RegExp(`In step 2, ${16 - ended} of 16`));
  assert.ok(ended > 3 && ended < 13, ended);
  await close(page);
});

test("the density estimate: k - 1 photons over the disk; many neighbors blur, few are noisy", async () => {
  const { page, slider, says } = await figure("density-estimate");
  const said = async () => {
    const text = await says();
    const numbers = /r = ([\d.]+) m, up to photon (\d+)\. The (\d+) before it, of 1\/(\d+) W.*give ([\d.]+) W.*truth is ([\d.]+)\..*error is ([\d.]+)/s;
    const [r, k, counted, photons, estimate, truth, error] = text.match(numbers).slice(1).map(Number);
    return { r, k, counted, photons, estimate, truth, error };
  };
  const first = await said();
  assert.equal(first.counted, first.k - 1);
  const expected = first.counted / first.photons / (Math.PI * first.r ** 2);
  assert.ok(Math.abs(first.estimate - expected) < 0.02, `${first.estimate} is not ${expected}`);
  // In the middle of the strip a large disk takes in what is dark around it.
  await slider("x in").fill("1.2");
  await slider("neighbors").fill("100");
  const large = await said();
  assert.equal(large.truth, 2.5);
  assert.ok(large.estimate < 2, `${large.estimate}`);
  // With more photons it does so less, and along the line the error is smaller.
  await slider("photons").fill("1000");
  const many = await said();
  assert.ok(many.estimate > large.estimate && many.error < large.error, `${many.estimate}, ${many.error}`);
  await slider("neighbors").fill("3");
  assert.ok((await said()).error > 2 * many.error);
  // The cone's weights have the mean 1, too: where light is even both say about the same.
  await slider("neighbors").fill("100");
  await slider("x in").fill("0.5");
  const box = await said();
  await slider("cone").check();
  const cone = await said();
  for (const one of [box, cone]) assert.ok(Math.abs(one.estimate - 0.5) < 0.15, `${one.estimate}`);
  assert.notEqual(cone.error, box.error);
  await close(page);
});

test("labels are as large as the text, inside, and apart, wherever the sliders are", async () => {
  for (const name of Object.keys(figures)) {
    const { page, live } = await figure(name);
    await page.evaluate(`window.wrongLabels = ${wrongLabels}`);
    const wrong = await live.evaluate((box) => {
      const svg = box.querySelector("svg");
      const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
      const inputs = [...box.querySelectorAll("input")];
      const found = new Map();
      const look = () => {
        const where = inputs.map((input) => (input.type === "checkbox" ? input.checked : input.value)).join(" ");
        for (const what of window.wrongLabels(svg, scale)) found.set(what, where);
      };
      // The fewer the sliders, the closer are the places that are tried.
      const steps = [40, 16, 6, 4][inputs.filter((input) => input.type === "range").length - 1];
      const each = (i) => {
        if (i === inputs.length) return look();
        const input = inputs[i], { min, max } = input;
        const places = input.type === "checkbox" ? [false, true] : Array.from({ length: steps + 1 }, (_, k) => +min + ((max - min) * k) / steps);
        for (const place of places) {
          if (input.type === "checkbox") input.checked = place;
          else input.value = place;
          input.dispatchEvent(new Event("input"));
          each(i + 1);
        }
      };
      each(0);
      return [...found].map(([what, where]) => `${what} (at ${where})`);
    });
    assert.deepEqual(wrong, [], name);
    await close(page);
  }
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

test("what is dragged goes to the pointer", async () => {
  for (const [name, label, [px, py], value] of [
    ["inverse-square", "d", [36 + 134 * 0.75, 120], 0.75],
    ["area-to-angle", "θ′", [150 + 288 * Math.cos((37 * Math.PI) / 180), 250], 53], // straight down: 90 - 37
    ["lamp-cone", /^d /, [46 + 88 * 3, 150], 3],
  ]) {
    const { page, live, slider } = await figure(name);
    const area = await live.locator("svg").boundingBox();
    const scale = area.width / 520;
    await page.mouse.move(area.x + scale * px, area.y + scale * py);
    await page.mouse.down();
    await page.mouse.up();
    assert.ok(Math.abs(Number(await slider(label).inputValue()) - value) <= 0.02 * value, `${name}: ${await slider(label).inputValue()}`);
    await close(page);
  }
});

test("without scripts, and on paper, the still pictures are there", async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  for (const [name, chapter] of Object.entries(figures)) {
    await page.goto(url(`book/stages/${chapter}.html`));
    assert.ok(await page.locator(`.figure.live-${name} img`).first().isVisible(), name);
  }
  await context.close();
  for (const name of Object.keys(figures)) {
    const { page, live } = await figure(name);
    const seen = () => Promise.all([live, page.locator(`.figure.live-${name} img`).first()].map((one) => one.isVisible()));
    assert.deepEqual(await seen(), [true, false], name);
    await page.emulateMedia({ media: "print" });
    assert.deepEqual(await seen(), [false, true], `${name} on paper`);
    await close(page);
  }
});
