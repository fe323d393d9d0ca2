// Interactive figures: a drawing with sliders. Each of the other files here
// describes one, for the figure of its name. Without JavaScript, and on paper, the
// still picture stays.
const live = (() => {
  const described = {};
  document.addEventListener("DOMContentLoaded", () => {
    for (const [name, figure] of Object.entries(described)) {
      const panel = document.querySelector(`.figure.live-${name} .panel`);
      if (panel) start(panel, name, figure);
    }
  });

  function start(panel, name, { size, hint, controls, draw, drag }) {
    const values = Object.fromEntries(controls.map((one) => [one.name, one.value]));
    const box = document.createElement("div");
    box.className = "live";
    box.innerHTML = `<svg viewBox="0 0 ${size.join(" ")}" aria-hidden="true"></svg><p class="live-says" role="status"></p>
      <div class="live-controls"></div><p class="live-hint">${hint}</p>`;
    const svg = box.querySelector("svg"), says = box.querySelector(".live-says");
    const inputs = controls.map((one) => control(one, name));

    function control(one) {
      const label = document.createElement("label");
      const input = document.createElement("input");
      if (typeof one.value === "boolean") {
        Object.assign(input, { type: "checkbox", checked: one.value });
        label.append(input, ` ${one.label}`);
      } else {
        Object.assign(input, { type: "range", min: one.min, max: one.max, step: one.step, value: one.value });
        label.append(`${one.label} `, input, document.createElement("output"));
      }
      input.addEventListener("input", () => {
        values[one.name] = input.type === "checkbox" ? input.checked : Number(input.value);
        update();
      });
      box.querySelector(".live-controls").append(label);
      return input;
    }

    function update() {
      const { shapes, text } = draw(values);
      svg.innerHTML = shapes.join("");
      says.innerHTML = text;
      controls.forEach((one, i) => {
        if (inputs[i].type !== "range") return;
        inputs[i].value = values[one.name];
        inputs[i].nextElementSibling.textContent = values[one.name].toFixed(one.digits ?? 2);
      });
    }

    /** A point in the drawing changes values, within the sliders' limits. */
    function dragged(event) {
      if (!event.buttons) return;
      const area = svg.getBoundingClientRect();
      const scale = size[0] / area.width;
      const changed = drag((event.clientX - area.left) * scale, (event.clientY - area.top) * scale, values);
      for (const one of controls) {
        if (!(one.name in changed)) continue;
        values[one.name] = Math.min(one.max, Math.max(one.min, changed[one.name]));
      }
      update();
    }
    svg.addEventListener("pointerdown", (event) => {
      svg.setPointerCapture(event.pointerId);
      dragged(event);
    });
    svg.addEventListener("pointermove", dragged);
    // The arrow keys move sliders, and do not turn the pages.
    box.addEventListener("keydown", (event) => event.stopPropagation());

    panel.prepend(box);
    update();
  }

  return (name, figure) => {
    described[name] = figure;
  };
})();

// The shapes of the drawings.
const shape = {
  line: (x1, y1, x2, y2, kind = "ink", more = "") =>
    `<line x1="${x1}" y1="${y1}" x2="${x2}" y2="${y2}" class="stroke ${kind}" ${more}/>`,
  dashed: (x1, y1, x2, y2, kind = "soft") => shape.line(x1, y1, x2, y2, kind, 'stroke-dasharray="4 4"'),
  area: (x, y, width, height, kind) => `<rect x="${x}" y="${y}" width="${width}" height="${height}" class="fill ${kind}"/>`,
  dot: (x, y, kind = "ink", radius = 4) => `<circle cx="${x}" cy="${y}" r="${radius}" class="fill ${kind}"/>`,
  text: (x, y, words, kind = "ink", anchor = "middle") =>
    `<text x="${x}" y="${y}" text-anchor="${anchor}" class="fill ${kind}">${words}</text>`,
  curve: (points, kind = "ink", more = "") => `<polyline points="${listed(points)}" class="stroke ${kind}" fill="none" ${more}/>`,
  polygon: (points, kind) => `<polygon points="${listed(points)}" class="fill ${kind}"/>`,
  /** From one angle to another, around a point. */
  arc: (x, y, radius, from, to, kind = "soft", more = "") =>
    shape.curve(Array.from({ length: 49 }, (_, i) => polar(x, y, radius, from + ((to - from) * i) / 48)), kind, more),
  arrow(x1, y1, x2, y2, kind) {
    const length = Math.hypot(x2 - x1, y2 - y1), x = (x2 - x1) / length, y = (y2 - y1) / length;
    const side = (sign) => `${x2 - 11 * x + sign * 5 * y},${y2 - 11 * y - sign * 5 * x}`;
    return (
      shape.line(x1, y1, x2 - 6 * x, y2 - 6 * y, kind) +
      `<polygon points="${x2},${y2} ${side(1)} ${side(-1)}" class="fill ${kind}"/>`
    );
  },
};
const listed = (points) => points.map((p) => p.map((c) => c.toFixed(1)).join(",")).join(" ");
const degrees = (radians) => (radians * 180) / Math.PI;
const radians = (angle) => (angle * Math.PI) / 180;
/** A point at an angle in radians: 0 is to the right, and up is positive. */
const polar = (x, y, radius, angle) => [x + radius * Math.cos(angle), y - radius * Math.sin(angle)];
/** A letter with its index, as in the still drawings. */
const indexed = (letter, index) => `${letter}<tspan dy="0.36em" font-size="73%">${index}</tspan>`;
/** A number in [0, 1), always the same for its number. */
function uniform(number) {
  let bits = Math.imul(number + 1, 0x9e3779b1);
  bits = Math.imul(bits ^ (bits >>> 15), 0x85ebca6b);
  bits = Math.imul(bits ^ (bits >>> 13), 0xc2b2ae35);
  return ((bits ^ (bits >>> 16)) >>> 0) / 2 ** 32;
}
