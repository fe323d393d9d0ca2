// Renders the lab's box in a worker, one sample of each pixel at a time. Receives
// the module once, then orders; sends pictures, and the requested paths.
"use strict";
let box, job, samples, spent, running, queued, shownAt;
const turn = new MessageChannel(); // faster than setTimeout, and messages still arrive
const next = () => {
  if (!queued) turn.port2.postMessage(0);
  queued = true;
};

const show = () => {
  const at = box.show(job.exposure);
  const rgba = new Uint8ClampedArray(box.memory.buffer, at, 4 * job.size * job.size).slice();
  const rate = (samples * job.size * job.size) / Math.max(spent, 1); // per millisecond
  postMessage({ rgba, samples, rate, done: samples >= job.most }, [rgba.buffer]);
  shownAt = performance.now();
};

const begin = () => {
  const { kd, ks, kt, eta, fresnel } = job.ball;
  box.set_ball(kd, ks, kt, eta, fresnel);
  box.begin(job.size, job.light, job.diffuse, job.bounces, job.uniform, job.seed);
  samples = spent = 0;
};

const work = () => {
  queued = false;
  if (!running || samples >= job.most) return;
  const before = performance.now();
  samples = box.add_pass(job.variant);
  spent += performance.now() - before;
  if (samples < 4 || samples >= job.most || performance.now() - shownAt > 80) show();
  next();
};
turn.port1.onmessage = work;

/** What a C library may ask of a system, such as a place for an abort's last words:
 * the box asks nothing, so to call one is an error. */
const nothing = (module) => {
  const system = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    (system[from] ??= {})[name] = () => {
      throw new Error(`the box has called ${name}`);
    };
  }
  return system;
};

const orders = {
  start: ({ bytes }) => {
    const module = new WebAssembly.Module(bytes);
    box = new WebAssembly.Instance(module, nothing(module)).exports;
    box._initialize();
  },
  paint: (asked) => {
    job = asked;
    begin();
    orders.go();
  },
  expose: ({ exposure }) => {
    job.exposure = exposure;
    show();
  },
  go: () => {
    running = true;
    next();
  },
  follow: ({ column, row, sample }) => {
    const count = box.follow(job.variant, column, row, sample);
    const path = new Float32Array(box.memory.buffer, box.path(), 3 + 16 * count).slice();
    postMessage({ path, column, row, sample });
  },
  pause: () => {
    running = false;
    show();
  },
};
onmessage = ({ data }) => orders[data.order](data);
