// A spherical lamp: the cone that it fills, one direction in it, and its first point.
live("lamp-cone", {
  size: [520, 310],
  hint: "Drag the sphere, or move the sliders.",
  controls: [
    { name: "d", label: "d", min: 2.2, max: 4, step: 0.01, value: 3.4 },
    { name: "r", label: "r", min: 0.6, max: 1.1, step: 0.01, value: 1.1 },
    { name: "xi", label: "ξ₁", min: 0, max: 1, step: 0.005, value: 0.3, digits: 3 },
  ],
  draw({ d, r, xi }) {
    const x = 46, y = 150, unit = 88, cx = x + d * unit;
    const edge = Math.asin(r / d), cosEdge = Math.cos(edge);
    const cosine = 1 - xi * (1 - cosEdge), theta = Math.acos(cosine);
    const nearest = d * cosine;
    const halfChord = Math.sqrt(Math.max(0, r * r - (d * Math.sin(theta)) ** 2));
    const first = nearest - halfChord;
    const along = (distance, angle = theta) => polar(x, y, unit * distance, angle);
    const touch = d * cosEdge;
    const shapes = [
      shape.dot(cx, y, "sand", r * unit),
      shape.arc(cx, y, r * unit, 0, 2 * Math.PI),
      shape.line(x, y, ...along(touch, edge), "soft"),
      shape.line(x, y, ...along(touch, -edge), "soft"),
      shape.dashed(x, y, cx, y),
      shape.line(...along(touch, -edge), cx, y),
      shape.dashed(...along(first), ...along(nearest), "warm"),
      shape.dashed(...along(nearest), ...along(nearest + halfChord)),
      shape.line(...along(nearest), cx, y, "cool"),
      shape.arrow(x, y, ...along(first), "warm"),
      shape.dot(...along(first), "warm"),
      shape.arc(x, y, 44, 0, edge),
    ];
    // Outside of the cone, as far from its edge as the word is long.
    const [tx, ty] = polar(...polar(x, y, 44, edge), 15 + 15 * Math.sin(edge), edge + Math.PI / 2);
    shapes.push(shape.text(tx, ty + 5, indexed("θ", "max"), "soft"));
    // Where the angle has room for the letter, if it has.
    const room = Math.max(70, 20 / Math.tan(theta));
    if (room < first * unit - 14) {
      const [, half] = polar(x, y, room, theta / 2);
      shapes.push(shape.arc(x, y, room - 10, 0, theta, "warm"), shape.text(x + room, half + 5, "θ", "warm"));
    }
    const [rx, ry] = polar(cx, y, (r * unit) / 2, -Math.PI / 2 - edge);
    shapes.push(
      shape.text(rx + 10, ry + 6, "r", "ink", "start"),
      shape.line(260, 19, 284, 19, "cool"),
      shape.text(292, 24, "d sin θ", "cool", "start"),
      shape.dashed(390, 19, 414, 19, "warm"),
      shape.text(422, 24, "half chord", "warm", "start"),
      shape.arrow(x, 284, cx, 284, "soft"),
      shape.text((x + cx) / 2, 276, "d"),
      shape.dot(x, y),
      shape.text(x - 20, y + 5, "x"),
      shape.dot(cx, y),
    );
    const text =
      `sin θ<sub>max</sub> = r/d = ${(r / d).toFixed(3)}, so θ<sub>max</sub> = ${degrees(edge).toFixed(1)}° and Ω<sub>c</sub> = ${(2 * Math.PI * (1 - cosEdge)).toFixed(3)} sr. ` +
      `cos θ = 1 − ${xi.toFixed(3)} (1 − ${cosEdge.toFixed(3)}) = ${cosine.toFixed(3)}, so θ = ${degrees(theta).toFixed(1)}°. ` +
      `The first point is at d cos θ − √(r² − d² sin² θ) = ${nearest.toFixed(3)} − ${halfChord.toFixed(3)} = ${first.toFixed(3)}.`;
    return { shapes, text };
  },
  drag: (px) => ({ d: Math.round((100 * (px - 46)) / 88) / 100 }),
});
