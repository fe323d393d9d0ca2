// One path of a pixel: drawn in the box, and described as by `--pixel`.
const planes = ["left wall", "right wall", "floor", "back wall", "ceiling"];
const spheres = ["left ball", "right ball", "glowing ball"];
const isTiny = (x) => Math.abs(x) < 0.0005;
const rgb = (v) => `(${v.map((x) => (x && isTiny(x) ? x.toExponential(0) : +x.toFixed(3))).join(", ")})`;
const mostRows = 12;

lab.pathInspector = (stage, canvas, size, chosen, order) => {
  const place = lab.html(stage, "div", { class: "lab-path", hidden: "" });
  const mark = lab.html(canvas.parentElement, "span", { class: "lab-mark", hidden: "" });
  const over = lab.add(canvas.parentElement, "svg", { viewBox: "0 0 1000 1000", class: "lab-over", "aria-hidden": "true" });
  let asked = null;

  /** Asks for a path; with `glance` it is drawn over the picture alone. */
  const ask = (column, row, sample = 0, glance = false) => {
    asked = { column: clamp(column, 0, size - 1), row: clamp(row, 0, size - 1), sample, glance };
    mark.hidden = false;
    mark.style.left = `${((asked.column + 0.5) / size) * canvas.clientWidth}px`;
    mark.style.top = `${((asked.row + 0.5) / size) * canvas.clientHeight}px`;
    order("follow", asked);
  };
  const pixel = (event) => [event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight].map((x) => Math.floor(x * size));
  canvas.addEventListener("click", (event) => ask(...pixel(event)));
  canvas.addEventListener("pointermove", (event) => {
    if (event.pointerType === "mouse" && (place.hidden || asked.glance)) ask(...pixel(event), 0, true);
  });
  canvas.addEventListener("pointerleave", () => {
    if (asked?.glance) forget();
  });
  const forget = () => {
    asked = null;
    mark.hidden = true;
    over.replaceChildren();
  };
  const steps = { ArrowLeft: [-4, 0], ArrowRight: [4, 0], ArrowUp: [0, -4], ArrowDown: [0, 4], Enter: [0, 0] };
  canvas.addEventListener("keydown", (event) => {
    if (!(event.key in steps) || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    const [right, down] = steps[event.key], { column, row } = asked ?? { column: size / 2, row: size / 2 };
    ask(column + right, row + down);
  });

  /** The pieces of a path; the numbers are box.cpp's. */
  const pieces = (path) => Array.from({ length: (path.length - 3) / 16 }, (_, i) => {
    const at = (k, n = 3) => [...path.slice(3 + 16 * i + k, 3 + 16 * i + k + n)];
    const [kind, bounce, type, index] = at(0, 4);
    return { kind, bounce, where: (type ? spheres : planes)[index], from: at(4), to: at(7), throughput: at(10), sum: at(13) };
  });

  /** How a path ends; a tree of stage 3 ends in many places. */
  const end = (all) => {
    const last = all.at(-1);
    if (!last || chosen.stage === 3) return "";
    if (last.kind === 3) return "Then the ray leaves the room.";
    if (last.where === "glowing ball" || (last.where === "ceiling" && chosen.light === 0)) return "It ends at the lamp.";
    return last.bounce === chosen.bounces ? "It ends at the bound." : "Roulette ends it.";
  };

  const show = ({ path, column, row, sample }) => {
    if (!asked || asked.column !== column || asked.row !== row || asked.sample !== sample) return;
    const all = pieces(path);
    lab.drawOver(over, all);
    if (asked.glance) return;
    place.hidden = false;
    place.replaceChildren();
    const vertices = all.filter((p) => p.kind === 0), radiance = [...path.slice(0, 3)];
    lab.drawPath(place, all, chosen.light);
    const words = lab.html(place, "div");
    lab.html(words, "p", {}, `Pixel ${column},${row}, path ${sample}. It brings ${rgb(radiance)}.`);
    const table = lab.html(words, "table");
    const head = lab.html(lab.html(table, "thead"), "tr");
    for (const name of ["", "where", "throughput", "adds"]) lab.html(head, "th", { scope: "col" }, name);
    const body = lab.html(table, "tbody");
    vertices.slice(0, mostRows).forEach((vertex, i) => {
      const after = vertices[i + 1]?.sum ?? radiance;
      const adds = after.map((x, c) => x - vertex.sum[c]);
      const line = lab.html(body, "tr");
      const cells = [vertex.bounce, vertex.where, rgb(vertex.throughput), adds.every(isTiny) ? "0" : rgb(adds)];
      for (const cell of cells) lab.html(line, "td", {}, `${cell}`);
    });
    if (vertices.length > mostRows) lab.html(words, "p", {}, `… and ${vertices.length - mostRows} more vertices`);
    lab.html(words, "p", {}, end(all));
    const more = lab.html(words, "button", { type: "button" }, "Another path of this pixel");
    more.addEventListener("click", () => ask(column, row, sample + 1));
    if (sample) more.focus({ preventScroll: true });
  };
  return { show, again: () => asked && ask(asked.column, asked.row, asked.sample, asked.glance) };
};

const colors = ["warm", "cool", "soft", "warm"];

/** The path as the camera sees it, in a square of side 1000. What is behind the camera
 * is cut off. */
lab.drawOver = (svg, pieces) => {
  svg.replaceChildren();
  const near = -3.3;
  const seen = ([x, y, z]) => [500 + (1500 * x) / (z + 3.5), 500 - (1500 * y) / (z + 3.5)];
  const cut = (a, b) => (a[2] >= near ? a : a.map((x, i) => x + ((near - a[2]) / (b[2] - a[2])) * (b[i] - x)));
  for (const { kind, bounce, from, to } of pieces) {
    if ((kind === 0 && bounce === 0) || Math.max(from[2], to[2]) < near) continue; // the camera's ray is a point
    lab.line(svg, seen(cut(from, to)), seen(cut(to, from)), colors[kind], kind ? 4 : 7, kind ? "12 10" : "none");
  }
  for (const { kind, to } of pieces) {
    if (!kind && to[2] > near) lab.dot(svg, seen(to), "warm", 9);
  }
};

/** The room with the path, in parallel projection from the upper left. Its walls
 * are infinite in front; they are drawn as far as the camera. */
lab.drawPath = (parent, pieces, light) => {
  const svg = lab.add(parent, "svg", { viewBox: "0 0 300 210", role: "img", "aria-label": "The path in the box" });
  const yaw = (55 * Math.PI) / 180, pitch = (20 * Math.PI) / 180, scale = 56;
  const at = ([x, y, z]) => {
    const right = x * Math.cos(yaw) - z * Math.sin(yaw), deep = x * Math.sin(yaw) + z * Math.cos(yaw);
    return [84 + scale * right, 92 - scale * (y * Math.cos(pitch) + deep * Math.sin(pitch))];
  };
  const corners = [-1, 1];
  for (const a of corners) for (const b of corners) {
    const z = b > 0 ? 1 : -3.5;
    for (const ends of [[[-1, a, z], [1, a, z]], [[a, -1, z], [a, 1, z]], [[a, b, -3.5], [a, b, 1]]]) {
      lab.line(svg, ...ends.map(at), "soft", 1);
    }
  }
  for (const [center, r] of [[[-0.5, -0.7, 0.25], 0.3], [[0.5, -0.7, -0.25], 0.3], [[0, 0.5, 0], [0, 0.1, 0.03][light]]]) {
    const [cx, cy] = at(center);
    if (r) lab.add(svg, "circle", { cx, cy, r: scale * r, class: "line-soft", "stroke-width": 1 });
  }
  for (const { kind, from, to } of pieces) {
    lab.line(svg, at(from), at(to), colors[kind], kind ? 1.2 : 1.8, kind ? "4 3" : "none");
  }
  for (const { kind, to } of pieces) {
    if (!kind) lab.dot(svg, at(to), "warm", 3);
  }
  const [x, y] = at([0, 0, -3.5]);
  lab.dot(svg, [x, y], "ink", 4);
  lab.add(svg, "text", { x: x - 2, y: y - 9, class: "fill-ink", "text-anchor": "end" }).textContent = "camera";
};
