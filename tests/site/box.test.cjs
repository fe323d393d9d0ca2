// The lab's box in the page: its controls, and that its bits are those of the
// native programs.
const assert = require("node:assert/strict");
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const { after, before, test } = require("node:test");
const { build, launch, noBox, root, url, watched } = require("./browser.cjs");

let browser;
before(async () => (browser = await launch()));
after(() => browser?.close());

/** The mouse must find what it was aimed at: nothing moves any more. */
async function settled(page) {
  await page.addStyleTag({ content: "html { scroll-behavior: auto !important }" });
  await page.evaluate(() => document.fonts.ready);
}

/** A figure with the box in it, once it paints. */
async function openedBox(chapter, name, options) {
  const page = await watched(browser, options);
  await page.goto(url(`book/stages/${chapter}.html`));
  await settled(page);
  const figure = page.locator(`#${name}`);
  await figure.locator(".lab-open").press("Enter");
  await figure.locator("canvas").waitFor();
  const samples = () => figure.locator(".lab-layout .lab-says").innerText().then(parseFloat);
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
  assert.match(await figure.locator(".lab-note").innerText(), /each bounce makes pi times the light/);
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
  assert.match(await figure.locator(".lab-note").innerText(), /cannot give back more light than it gets/);
  await page.close();
  const glass = await openedBox("5_fresnel_textures", "fresnel-or-fixed");
  await glass.until(1);
  await glass.figure.getByRole("checkbox", { name: "Fresnel" }).uncheck(); // or ks = kt = 1 is too much
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
  const path = figure.locator(".lab-path");
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
  const floats = bytes.subarray(`PF\n${size} ${size}\n-1.0\n`.length); // the variance follows them
  const at = (row, i) => floats.readFloatLE(4 * (3 * size * (size - 1 - row) + i));
  return Array.from({ length: 3 * size * size }, (_, i) => at(Math.floor(i / (3 * size)), i % (3 * size)));
}

test("the box has the bits of the native programs", { skip: noBox }, async () => {
  const page = await watched(browser);
  await page.goto(url("book/index.html"));
  await page.addScriptTag({ url: url("book/_static/lab-module.js") });
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
      const module = new WebAssembly.Module(bytes);
      const system = {}; // as in worker.js
      for (const { module: from, name } of WebAssembly.Module.imports(module)) (system[from] ??= {})[name] = () => {};
      const box = new WebAssembly.Instance(module, system).exports;
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

test("without JavaScript and on paper the still figure stands alone", { skip: noBox }, async () => {
  const { page, figure } = await openedBox("1_diffuse", "diffuse-bounces");
  assert.equal(await figure.locator(".panel img").first().isVisible(), true);
  await page.emulateMedia({ media: "print" });
  assert.equal(await figure.locator(".panel img").first().isVisible(), true);
  assert.equal(await figure.locator(".lab-stage").isVisible(), false);
  await page.close();
  const still = await watched(browser, { javaScriptEnabled: false });
  await still.goto(url("book/stages/1_diffuse.html"));
  assert.equal(await still.locator(".lab-stage").count(), 0);
  await still.close();
});
