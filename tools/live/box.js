// The lab's box, painted by the stages themselves while the reader looks.
const most = 4096, unbounded = 4096;
const presets = {
  "front": { stage: 5, light: 0, bounces: 9, ks: 1, kt: 1, fresnel: true, size: 320, front: true },
  "diffuse-bounces": { stage: 1, light: 0 },
  "counted": { stage: 2, light: 1 },
  "glass-bounces": { stage: 3, light: 2, bounces: 6, exposure: 1 },
  "roulette-mistakes": { stage: 4, light: 0, bounces: 9 },
  "fresnel-or-fixed": { stage: 5, light: 0, bounces: 9, ks: 1, kt: 1, fresnel: true },
};
const lights = ["the whole ceiling", "a small glowing ball", "a point"];
const here = document.currentScript.src;

/** The button below the still pictures; on the front page there is none. */
lab.offer = (figure, preset) => {
  const stage = document.createElement("div");
  stage.className = "lab-stage";
  figure.insertBefore(stage, figure.querySelector(".caption"));
  if (preset.front) return load(() => lab.startBox(stage, preset));
  const open = lab.html(stage, "button", { type: "button", class: "lab-open" }, "Paint this box here, and change it");
  const start = () => {
    open.remove();
    lab.startBox(stage, preset);
  };
  open.addEventListener("click", () => {
    open.disabled = true;
    load(start);
  });
};

const load = (start) => {
  if (window.lightwalkBox) return start();
  lab.html(document.head, "script", { src: new URL("lab-module.js", here) }).addEventListener("load", start);
};

lab.startBox = (stage, preset) => {
  const { wasm, worker: program, variants } = window.lightwalkBox;
  const last = preset.stage, { size = 160, front } = preset;
  const chosen = { bounces: 8, exposure: 0, sampling: "cosine", variant: "", kd: 0, ks: 0.1, kt: 0.9, eta: 1.5, fresnel: false, ...preset };
  const task = lab.html(stage, "p", { class: "lab-task" }, "Change anything, and click a pixel to see one of its paths.");
  task.hidden = Boolean(front);
  const layout = lab.html(stage, "div", { class: "lab-layout" });
  const picture = lab.html(layout, "div", { class: "lab-picture" });
  const canvas = lab.html(picture, "canvas", { width: size, height: size, role: "img", tabindex: 0 });
  const says = lab.html(picture, "p", { class: "lab-says" });
  const panel = lab.html(layout, "div", { class: "lab-controls" });
  if (front) {
    stage.classList.add("lab-front");
    panel.hidden = true;
    const more = lab.html(picture, "button", { type: "button" }, "Change this box");
    more.addEventListener("click", () => {
      more.remove();
      panel.hidden = task.hidden = false;
    });
  }
  const note = lab.html(stage, "p", { class: "lab-says lab-note", role: "status" });

  const worker = new Worker(URL.createObjectURL(new Blob([program], { type: "text/javascript" })));
  const screen = canvas.getContext("2d");
  let samples = 0, rate = 0, done = false, paused = false;
  const report = () => {
    const speed = rate ? `, ${(rate / 1000).toPrecision(2)} million samples/s` : "";
    const count = `${samples} ${samples === 1 ? "sample" : "samples"} per pixel${speed}`;
    says.textContent = done ? `${count}, done` : paused ? `${count}, paused` : count;
    pause.textContent = paused ? "Continue" : "Pause";
    pause.disabled = done;
  };
  const ofStage = () => variants.map((v, i) => ({ ...v, i })).filter((v) => v.stage === chosen.stage);
  const current = () => ofStage().find((v) => v.name === chosen.variant);
  const order = (what, more = {}) => worker.postMessage({ order: what, ...more });
  const isShared = () => chosen.fresnel && chosen.stage > 4;

  const paint = () => {
    const { kd, ks, kt, eta, light, exposure } = chosen;
    done = paused = false;
    canvas.setAttribute("aria-label", `The box by stage ${chosen.stage}, lit by ${lights[light]}`);
    order("paint", { size, most, seed: 1, variant: current().i, light, exposure, diffuse: chosen.stage < 3,
      bounces: chosen.bounces > 8 ? unbounded : chosen.bounces, uniform: chosen.sampling === "uniform",
      ball: { kd, ks, kt, eta, fresnel: isShared() } });
    inspector.again();
  };
  const fit = () => {
    const { stage: n } = chosen;
    variant.refill(ofStage().map((v) => [v.name, v.label]));
    light.refill(lights.map((words, i) => [i, words]).filter(([i]) => n > 1 || i < 2)); // stage 1 finds no point
    bounces.limit(n > 3 ? 9 : 8);
    for (const control of Object.values(ball)) control.hidden = n < 3;
    if (ball.fresnel) ball.fresnel.hidden = n < 5;
  };
  const changed = (name) => {
    if (name === "exposure") return order("expose", { exposure: chosen.exposure });
    if (name === "variant" && /uniform/.test(chosen.variant)) {
      chosen.sampling = "uniform";
      sampling.refill(ways);
    }
    if (name === "stage") fit();
    const words = lab.keepEnergy(chosen, name, isShared());
    for (const k of ["kd", "ks", "kt"]) ball[k]?.show();
    note.textContent = words || current().sentence;
    paint();
  };

  const controls = lab.boxControls(panel, chosen, changed);
  const ways = [["cosine", "by the cosine"], ["uniform", "uniform"]];
  controls.choice("stage", "stage", variants.filter((v) => !v.name && v.stage <= last).map((v) => [v.stage, `${v.stage}`]));
  const variant = controls.choice("variant", "program", ofStage().map((v) => [v.name, v.label]));
  const light = controls.choice("light", "light", lights.map((words, i) => [i, words]));
  const sampling = controls.choice("sampling", "directions", ways);
  const bounces = controls.range("bounces", "most bounces", [0, 9, 1], (x) => (x > 8 ? "no bound" : `${x}`));
  const ball = {};
  if (last > 2) {
    ball.title = lab.html(panel, "p", {}, "The right ball:");
    for (const k of ["kd", "ks", "kt"]) ball[k] = controls.range(k, k, [0, 1, 0.01]);
    ball.eta = controls.range("eta", "η", [1, 2.5, 0.05]);
  }
  if (last > 4) ball.fresnel = controls.check("fresnel", "Fresnel");
  controls.range("exposure", "exposure", [-4, 4, 0.5], (x) => `× ${+(2 ** x).toPrecision(2)}`);
  const buttons = lab.html(panel, "div", { class: "lab-row" });
  const pause = lab.html(buttons, "button", { type: "button" }, "Pause");
  pause.addEventListener("click", () => {
    paused = !paused;
    order(paused ? "pause" : "go");
    report();
  });
  lab.html(buttons, "button", { type: "button" }, "Restart").addEventListener("click", () => paint());
  const inspector = lab.pathInspector(stage, canvas, size, chosen, order);

  worker.onmessage = ({ data }) => {
    if (data.path) return inspector.show(data);
    screen.putImageData(new ImageData(data.rgba, size, size), 0, 0);
    ({ samples, rate, done } = data);
    if (front) stage.closest(".figure").classList.add("painted"); // and the still picture goes
    report();
  };
  worker.onerror = () => (task.textContent = "This browser cannot paint the box: it lacks WebAssembly with SIMD.");
  order("start", { bytes: Uint8Array.from(atob(wasm), (c) => c.charCodeAt(0)).buffer });
  fit();
  paint();
  // Pauses while the picture is not on the screen.
  new IntersectionObserver(([{ isIntersecting }]) => paused || order(isIntersecting ? "go" : "pause")).observe(picture);
  if (!front) canvas.focus({ preventScroll: true });
};

document.addEventListener("DOMContentLoaded", () => {
  for (const [name, preset] of Object.entries(presets)) {
    const figure = document.querySelector(`.figure.live-${name}`);
    if (figure) lab.offer(figure, preset);
  }
});
