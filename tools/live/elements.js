// Makes the elements of the box in the page, HTML and SVG.
"use strict";
const lab = {};
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/** A new HTML element within `parent`. */
lab.html = (parent, name, attributes = {}, text = "") => {
  const made = parent.appendChild(document.createElement(name));
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.textContent = text;
  return made;
};

/** A new SVG element within `parent`. */
lab.add = (parent, name, attributes = {}) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, typeof value === "number" ? +value.toFixed(2) : value);
  }
  return parent.appendChild(made);
};
lab.line = (svg, [x1, y1], [x2, y2], color, width, dash = "none") =>
  lab.add(svg, "line", { x1, y1, x2, y2, class: `line-${color}`, "stroke-width": width, "stroke-dasharray": dash });
lab.dot = (svg, [cx, cy], color, r) => lab.add(svg, "circle", { cx, cy, r, class: `fill-${color}` });
