// What live figures share: shapes, labels, and handles that are dragged or
// moved with the arrow keys. Angles are degrees from straight up.
"use strict";
const live = { figures: {} };

live.clamp = (x, low, high) => Math.min(Math.max(x, low), high);
live.radians = (degrees) => (degrees * Math.PI) / 180;
live.degrees = (radians) => (radians * 180) / Math.PI;
live.polar = (x, y, angle, r) => [
  x + r * Math.sin(live.radians(angle)),
  y - r * Math.cos(live.radians(angle)),
];

/** A new SVG element within `parent`. */
live.add = (parent, name, attributes = {}) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  live.set(made, attributes);
  return parent.appendChild(made);
};
live.set = (element, attributes) => {
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, typeof value === "number" ? +value.toFixed(2) : value);
  }
  return element;
};

/** A new HTML element within `parent`. */
live.html = (parent, name, attributes = {}, text = "") => {
  const made = parent.appendChild(document.createElement(name));
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
};

/** The drawing in a figure's stage, what to do with it, and what it says. */
live.drawing = (stage, width, height, task) => {
  live.html(stage, "p", { class: "live-task" }, task);
  const svg = live.add(stage, "svg", { viewBox: `0 0 ${width} ${height}`, role: "group" });
  svg.setAttribute("aria-label", task);
  const heads = live.add(svg, "defs");
  for (const color of ["ink", "soft", "warm", "cool"]) {
    const head = live.add(heads, "marker", { id: `${stage.id}-${color}`, viewBox: "0 0 8 8", refX: 7,
      refY: 4, markerWidth: 7, markerHeight: 7, orient: "auto" });
    live.add(head, "path", { d: "M0 .8 8 4 0 7.2z", class: `fill-${color}` });
  }
  return svg;
};

live.line = (svg, color, width = 1.6, dash = "") =>
  live.add(svg, "path", { class: `line-${color}`, "stroke-width": width, "stroke-dasharray": dash || "none" });
live.arrow = (svg, color, width = 2) => {
  const stage = svg.parentElement.id;
  return live.set(live.line(svg, color, width), { "marker-end": `url(#${stage}-${color})` });
};
live.draw = (line, ...points) =>
  live.set(line, { d: points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`).join("") });
live.dot = (svg, color, r = 3.5) => live.add(svg, "circle", { class: `fill-${color}`, r });

/** Words, whose `w_o` is set as omega with a lower o. */
live.text = (svg, x, y, words = "", color = "ink", anchor = "middle") => {
  const made = live.add(svg, "text", { x, y, class: `fill-${color}`, "text-anchor": anchor });
  live.write(made, words);
  return made;
};
live.write = (element, words) => {
  element.replaceChildren();
  const greek = { w: "ω", t: "θ", e: "η" };
  for (const part of words.split(/\b([A-Za-z]_[A-Za-z0-9])/)) {
    if (!/^[A-Za-z]_/.test(part)) {
      element.append(part);
      continue;
    }
    element.append(greek[part[0]] ?? part[0]);
    if (!element.ownerSVGElement) {
      live.html(element, "sub", {}, part[2]);
      continue;
    }
    live.add(element, "tspan", { dy: "0.36em", "font-size": "73%" }).textContent = part[2];
    live.add(element, "tspan", { dy: "-0.27em" }).textContent = "\u200b";
  }
};

/** The same for a screen reader. */
live.spoken = (words) => words.replace(/\bw_/g, "ω").replace(/\bt_/g, "θ").replace(/_/g, "");

/** A handle: `place` says where a value stands, `at` which value a place has.
 * It is a slider to the keyboard and to screen readers. */
live.handle = (svg, { label, color, min, max, step, place, at, says, moved }) => {
  const knob = live.add(svg, "g", { class: `handle fill-${color}`, role: "slider", tabindex: 0,
    "aria-label": live.spoken(label), "aria-valuemin": min, "aria-valuemax": max });
  live.add(knob, "circle", { r: 24, class: "reach" });
  live.add(knob, "circle", { r: 8, class: "knob" });
  let value = min;
  const move = (to) => {
    value = live.clamp(Math.round(to / step) * step, min, max);
    moved(value);
  };
  knob.addEventListener("pointerdown", (event) => {
    knob.setPointerCapture(event.pointerId);
    knob.focus();
    event.preventDefault();
  });
  knob.addEventListener("pointermove", (event) => {
    if (!knob.hasPointerCapture(event.pointerId)) return;
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    move(at(point.x, point.y));
  });
  const keys = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10,
    Home: -Infinity, End: Infinity };
  knob.addEventListener("keydown", (event) => {
    if (!(event.key in keys) || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation(); // arrow keys turn the book's pages
    move(live.clamp(value + step * keys[event.key], min, max));
  });
  /** Shows a value, which may have come from elsewhere. */
  return (now) => {
    value = now;
    const [x, y] = place(now);
    live.set(knob, { transform: `translate(${x.toFixed(2)} ${y.toFixed(2)})`,
      "aria-valuenow": +now.toFixed(3), "aria-valuetext": live.spoken(says(now)) });
  };
};

document.addEventListener("DOMContentLoaded", () => {
  for (const [name, start] of Object.entries(live.figures)) {
    for (const figure of document.querySelectorAll(`.live-${name}`)) {
      const stage = document.createElement("div");
      stage.className = "live-stage";
      stage.id = `live-${name}-${figure.id || "figure"}`;
      figure.insertBefore(stage, figure.querySelector(".caption"));
      if (start(stage, figure) !== false) figure.classList.add("is-live");
    }
  }
});
