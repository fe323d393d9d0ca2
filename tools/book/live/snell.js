// Snell's law at a surface of glass, from outside or from inside.
live("snell", {
  size: [520, 300],
  hint: "Drag the blue arrow, or move the sliders.",
  controls: [
    { name: "angle", label: "θₒ in degrees", min: 0, max: 89.5, step: 0.5, value: 30, digits: 1 },
    { name: "eta", label: "η of the glass", min: 1, max: 2.5, step: 0.01, value: 1.5 },
    { name: "inside", label: "ωₒ is in the glass", value: true },
  ],
  draw({ angle, eta, inside }) {
    const x = 260, y = 150, length = 125;
    const down = inside ? 1 : -1; // the side of wo, on the page
    const at = (degree, side) => [x + length * Math.sin(radians(degree)), y + side * length * Math.cos(radians(degree))];
    const ratio = inside ? eta : 1 / eta;
    const sine = ratio * Math.sin(radians(angle));
    const shapes = [
      shape.area(60, y, 400, 140, "glass"),
      shape.line(60, y, 460, y, "cool"),
      shape.dashed(x, 12, x, 288),
      shape.text(66, 24, "air, η = 1", "soft", "start"),
      shape.text(66, 282, `glass, η = ${eta.toFixed(2)}`, "soft", "start"),
    ];
    const wo = at(-angle, down), mirrored = at(angle, down);
    let text = `ηₒ/ηᵢ = ${ratio.toFixed(3)}, sin θₒ = ${Math.sin(radians(angle)).toFixed(3)}. `;
    if (sine < 1) {
      const out = degrees(Math.asin(sine));
      shapes.push(shape.arrow(x, y, ...mirrored, "soft"), shape.arrow(x, y, ...at(out, -down), "warm"));
      const [tx, ty] = at(out, -down);
      shapes.push(shape.text(tx + 16, ty - 6 * down, "ωₜ", "warm"));
      text += `sin θᵢ = ${sine.toFixed(3)}, so θᵢ = ${out.toFixed(1)}°.`;
    } else {
      shapes.push(shape.arrow(x, y, ...mirrored, "warm"));
      text += `sin θᵢ would be ${sine.toFixed(3)}: no such direction, all is reflected.`;
    }
    if (inside && eta > 1) text += ` The critical angle is ${degrees(Math.asin(1 / eta)).toFixed(1)}°.`;
    shapes.push(shape.arrow(x, y, ...wo, "cool"), shape.text(wo[0] - 16, wo[1] + 20 * Math.sin(radians(angle)) ** 2 * down, "ωₒ", "cool"), shape.dot(x, y));
    return { shapes, text };
  },
  drag(px, py, { inside }) {
    const along = inside ? py - 150 : 150 - py;
    return { angle: along > 0 ? Math.round(2 * degrees(Math.atan2(Math.abs(px - 260), along))) / 2 : 89.5 };
  },
});
