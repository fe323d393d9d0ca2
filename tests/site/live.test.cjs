// Figures that live: handles that are dragged or moved with arrow keys, and the
// lab's box, whose bits are those of the native programs.
const assert = require("node:assert/strict");
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const { after, before, test } = require("node:test");
const { build, launch, root, url, watched } = require("./browser.cjs");

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

const chapters = {
  "inversion": "1_diffuse",
  "snell": "3_specular_refraction",
  "event-bar": "4_russian_roulette",
  "fresnel-curves": "5_fresnel_textures",
};

/** The mouse must find what it was aimed at: nothing moves any more. */
async function settled(page) {
  await page.addStyleTag({ content: "html { scroll-behavior: auto !important }" });
  await page.waitForFunction(() => window.MathJax?.startup?.promise);
  await page.evaluate(() => window.MathJax.startup.promise);
}

async function opened(name, options = {}) {
  const page = await watched(browser, options);
  await page.goto(url(`book/stages/${chapters[name]}.html`));
  if (options.javaScriptEnabled !== false) await settled(page);
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

const noBox = fs.existsSync(`${build}/book/_static/live-box.js`) ? false : "NOT TESTED: tools/setup.sh live";

/** A figure with the box in it, once it paints. */
async function openedBox(chapter, name, options) {
  const page = await watched(browser, options);
  await page.goto(url(`book/stages/${chapter}.html`));
  await settled(page);
  const figure = page.locator(`#${name}`);
  await figure.locator(".live-open").press("Enter");
  await figure.locator("canvas").waitFor();
  const samples = () => figure.locator(".live-lab .live-says").innerText().then(parseFloat);
  const until = async (enough) => {
    for (let i = 0; i < 200 && !((await samples()) >= enough); ++i) await page.waitForTimeout(50);
    assert.ok((await samples()) >= enough, `${name}: only ${await samples()} samples`);
  };
  /** The mean of the picture's bytes. */
  const brightness = () => figure.locator("canvas").evaluate((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((sum, byte, i) => (i % 4 < 3 ? sum + byte : sum), 0) / (data.length * 0.75);
  });
  return { page, figure, samples, until, brightness };
}

test("the box paints, pauses, and begins anew", { skip: noBox }, async () => {
  const { page, figure, samples, until, brightness } = await openedBox("1_diffuse", "diffuse-bounces");
  await until(3);
  const right = await brightness();
  assert.ok(right > 60, `mean byte ${right}`);
  await figure.getByRole("button", { name: "Pause" }).press("Enter");
  await page.waitForTimeout(300);
  const paused = await samples();
  await page.waitForTimeout(300);
  assert.equal(await samples(), paused, "it paints while it is paused");
  await figure.getByRole("button", { name: "Continue" }).press("Enter");
  await until(paused + 1);
  await page.evaluate(() => window.scrollTo(0, 0));
  await page.waitForTimeout(400);
  const away = await samples();
  await page.waitForTimeout(300);
  assert.equal(await samples(), away, "it paints while nobody sees it");
  await figure.locator("canvas").scrollIntoViewIfNeeded();
  await until(away + 1);
  await figure.getByLabel("program").selectOption("pi-of-the-brdf-forgotten");
  await page.waitForTimeout(200);
  await until(3);
  assert.ok((await brightness()) > right + 20, "a pi too much is no brighter");
  assert.match(await figure.locator(".live-note").innerText(), /each bounce makes pi times the light/);
  await figure.getByLabel("program").selectOption("");
  await figure.getByLabel("most bounces").press("Home");
  await page.waitForTimeout(200);
  await until(3);
  assert.ok((await brightness()) < right - 20, "no bounce is as bright as eight");
  assert.match(page.url(), /1_diffuse/, "a key turned the page");
  assert.deepEqual([page.complaints, page.requests], [[], []]);
  await page.close();
});

test("the ball makes no light", { skip: noBox }, async () => {
  const { page, figure, until } = await openedBox("4_russian_roulette", "roulette-mistakes");
  await until(1);
  await figure.getByLabel("kd").fill("0.6");
  const value = (name) => figure.getByLabel(name).inputValue().then(Number);
  const sum = (await value("kd")) + (await value("ks")) + (await value("kt"));
  assert.equal(await value("kd"), 0.6);
  assert.ok(sum <= 1 && sum > 0.97, `kd + ks + kt = ${sum}`);
  assert.match(await figure.locator(".live-note").innerText(), /cannot give back more light than it gets/);
  await page.close();
  const glass = await openedBox("5_fresnel_textures", "fresnel-or-fixed");
  await glass.until(1);
  await glass.figure.getByLabel("Fresnel").uncheck(); // ks = kt = 1 then are too much
  assert.equal(await glass.figure.getByLabel("ks").inputValue(), "0.5");
  assert.equal(await glass.figure.getByLabel("kt").inputValue(), "0.5");
  await glass.page.close();
});

test("a pixel tells its path as --pixel does", { skip: noBox }, async () => {
  const { page, figure, until } = await openedBox("1_diffuse", "diffuse-bounces");
  await until(1);
  const canvas = figure.locator("canvas");
  const side = (await canvas.boundingBox()).width;
  await canvas.click({ position: { x: (side * 44.5) / 160, y: (side * 150.5) / 160 } });
  const path = figure.locator(".live-path");
  for (let sample = 0; sample < 6; ++sample) {
    await path.getByText(`Pixel 44,150, path ${sample}.`).waitFor();
    const said = execFileSync(`${build}/stage1`, [`${root}/scenes/cornell_box_ceiling_diffuse.toml`, "--size", "160x160",
      "--pixel", "44,150", "--sample", `${sample}`], { encoding: "utf8" });
    const numbers = said.match(/radiance of this sample = \((.*)\)/)[1].split(",").map((x) => +(+x).toFixed(3));
    assert.match(await path.innerText(), new RegExp(`It brings \\(${numbers.join(", ")}\\)`));
    assert.equal(await path.locator("tbody tr").count(), said.match(/^vertex /gm).length, said);
    await path.getByRole("button", { name: "Another path" }).press("Enter");
  }
  await canvas.press("ArrowRight");
  await path.getByText("Pixel 48,150, path 0.").waitFor();
  assert.deepEqual(page.complaints, []);
  await page.close();
});

/** A .pfm's numbers, row by row from the top. */
function pixels(file, size) {
  const bytes = fs.readFileSync(file);
  const floats = bytes.subarray(bytes.length - 12 * size * size);
  const at = (row, i) => floats.readFloatLE(4 * (3 * size * (size - 1 - row) + i));
  return Array.from({ length: 3 * size * size }, (_, i) => at(Math.floor(i / (3 * size)), i % (3 * size)));
}

test("the box has the bits of the native programs", { skip: noBox }, async () => {
  const page = await watched(browser);
  await page.goto(url("book/index.html"));
  await page.addScriptTag({ url: url("book/_static/live-box.js") });
  const variants = await page.evaluate(() => window.lightwalkBox.variants);
  const [size, spp, all] = [40, 6, 4096];
  const glass = [0, 0.1, 0.9, 1.5, 0];
  for (const [stage, mistake, scene, light, bounces, uniform] of [
    [1, "", "cornell_box_ceiling_diffuse", 0, 8, 0], [1, "", "cornell_box_ceiling_diffuse", 0, 3, 1],
    [2, "", "cornell_box_sphere_lamp_diffuse", 1, 8, 0], [2, "", "cornell_box_point_diffuse", 2, 8, 1],
    [3, "", "cornell_box_point", 2, 6, 0], [4, "", "cornell_box_ceiling", 0, all, 0], [5, "", "cornell_box_point", 2, all, 0],
    [1, "pi-of-the-brdf-forgotten", "cornell_box_ceiling_diffuse", 0, 4, 0],
    [2, "lamps-counted-twice", "cornell_box_sphere_lamp_diffuse", 1, 8, 0],
    [3, "eta-inverted", "cornell_box_ceiling", 0, 6, 0],
    [4, "not-divided-by-the-probability", "cornell_box_ceiling", 0, all, 0],
  ]) {
    const file = `${build}/live/native.pfm`;
    const program = mistake ? ["python3", "-m", "tools.weave.mistaken", `${stage}/${mistake}`] : [`${build}/stage${stage}`];
    execFileSync(program[0], [...program.slice(1), `scenes/${scene}.toml`, "-q", "-o", file, "--size", `${size}x${size}`,
      "--spp", `${spp}`, "--max-bounces", `${bounces}`, "--sampling", uniform ? "uniform" : "cosine"],
    { cwd: root, env: { ...process.env, LIGHTWALK_BUILD: build } });
    const variant = variants.findIndex((v) => v.stage === stage && v.name === mistake);
    const live = await page.evaluate(([job, ball, spp, size, variant]) => {
      const bytes = Uint8Array.from(atob(window.lightwalkBox.wasm), (c) => c.charCodeAt(0));
      const box = new WebAssembly.Instance(new WebAssembly.Module(bytes), {}).exports;
      box._initialize();
      box.set_ball(...ball);
      box.begin(...job);
      for (let i = 0; i < spp; ++i) box.add_pass(variant);
      const numbers = [];
      for (let i = 0; i < size * size; ++i) {
        numbers.push(...new Float32Array(box.memory.buffer, box.mean_of(i % size, Math.floor(i / size)), 3));
      }
      return numbers;
    }, [[size, light, stage < 3 ? 1 : 0, bounces, uniform, 1], glass, spp, size, variant]);
    const native = pixels(file, size);
    assert.ok(native.some((x) => x > 0), `${scene} is black`);
    const first = native.findIndex((x, i) => !Object.is(x, live[i]));
    const place = `${first / 3 % size | 0},${first / 3 / size | 0}`;
    assert.equal(first, -1, `stage ${stage} ${mistake} ${scene}, pixel ${place}: ${live[first]} in the browser, ${native[first]} natively`);
  }
  await page.close();
});
