// The solid angle of a patch of a lamp: the cosine, and the square of the distance.
live("area-to-angle", {
  size: [520, 330],
  hint: "Drag around the patch to turn it, or move the sliders.",
  controls: [
    { name: "tilt", label: "θ′ in degrees", min: 0, max: 120, step: 0.5, value: 40, digits: 1 },
    { name: "d", label: "d", min: 2.5, max: 4.5, step: 0.01, value: 4 },
  ],
  draw({ tilt, d }) {
    const x = 150, y = 285, unit = 72, half = 33;
    const toward = radians(37), back = toward + Math.PI, reach = d * unit;
    const [px, py] = polar(x, y, reach, toward);
    const cosine = Math.cos(radians(tilt)), front = tilt < 90;
    /** A point seen from the patch, at an angle from the line back to x. */
    const at = (angle, radius) => polar(px, py, radius, back + radians(angle));
    const [a, b] = [at(tilt - 90, half), at(tilt + 90, half)];
    const seen = ([ex, ey]) => Math.atan2(y - ey, ex - x);
    const shapes = [];
    if (front) shapes.push(shape.polygon([[x, y], a, b], "glow"));
    shapes.push(
      shape.line(20, y, 340, y),
      shape.arc(x, y, unit, 0, Math.PI, "soft", 'stroke-dasharray="4 4"'),
      shape.dashed(x, y, x, y - 130),
      shape.dashed(x, y, px, py),
    );
    if (front) {
      const [label, up] = polar(x, y, unit + 16, Math.max(seen(a), seen(b)) + 0.16);
      shapes.push(shape.arc(x, y, unit, seen(a), seen(b), "cool thick"), shape.text(label, up + 5, "dω", "cool"));
    }
    shapes.push(shape.line(...a, ...b, "warm thick"));
    if (front) {
      const end = at(-90, half + 12);
      shapes.push(
        shape.line(...at(-90, half * cosine), ...at(90, half * cosine), "green", 'stroke-dasharray="6 4"'),
        shape.text(end[0], end[1], "cos θ′ dA", "green", "end"),
      );
    }
    const centered = ([cx, cy], words, kind) => shape.text(cx, cy + 5, words, kind);
    const middle = polar(x, y, (unit + reach - 60) / 2, toward);
    shapes.push(
      shape.arrow(px, py, ...at(tilt, 50), "warm"),
      shape.arc(px, py, 34, back, back + radians(tilt), "warm"),
      centered(at(tilt + 14, 60), "n′", "warm"),
      // Within the angle, if there is room.
      centered(tilt < 40 ? at(-20, 40) : at(tilt / 2, 48), "θ′", "warm"),
      centered(at(tilt + 90, half + 18), "dA", "warm"),
      shape.text(middle[0] + 11, middle[1] + 16, "d"),
      shape.text(x - 14, y - 116, "n"),
      shape.text(...polar(x, y, unit + 12, radians(138)), "radius 1", "soft", "end"),
      shape.dot(x, y),
      shape.text(x, y + 30, "x"),
    );
    const text = front
      ? `dω = cos θ′ dA/d² = ${cosine.toFixed(3)}/${(d * d).toFixed(2)} dA = ${(cosine / d ** 2).toFixed(4)} dA. The drawing is a cut: in it a small patch ` +
        `becomes cos θ′/d = ${(cosine / d).toFixed(3)} times as long, and across it 1/d = ${(1 / d).toFixed(3)} times.`
      : `cos θ′ = ${cosine.toFixed(3).replace("-", "−")}: the front does not face x, and the back of the lamp is black. So 0 is used for the cosine, and the weight is 0.`;
    return { shapes, text };
  },
  drag(px, py, { d }) {
    const toward = radians(37), [cx, cy] = polar(150, 285, 72 * d, toward);
    const turned = degrees(Math.atan2(cy - py, px - cx) - toward - Math.PI);
    // From -180 to 180.
    return { tilt: Math.round(2 * (turned - 360 * Math.round(turned / 360))) / 2 };
  },
});
