// Fresnel's equations: what a surface of glass reflects at each angle.
live("fresnel-curves", {
  size: [520, 320],
  hint: "Drag left and right, or move the sliders.",
  controls: [
    { name: "angle", label: "θₒ in degrees", min: 0, max: 90, step: 0.5, value: 45, digits: 1 },
    { name: "eta", label: "η of the glass", min: 1.01, max: 2.5, step: 0.01, value: 1.5 },
    { name: "inside", label: "seen from inside", value: false },
  ],
  draw({ angle, eta, inside }) {
    const x = 60, y = 270, width = 400, height = 230;
    const ratio = inside ? eta : 1 / eta;
    const reflected = (theta) => {
      const o = Math.cos(radians(theta)), sine2 = ratio ** 2 * (1 - o * o);
      if (sine2 >= 1) return [1, 1, 1];
      const i = Math.sqrt(1 - sine2);
      const s = ((ratio * o - i) / (ratio * o + i)) ** 2, p = ((o - ratio * i) / (o + ratio * i)) ** 2;
      return [(s + p) / 2, s, p];
    };
    const place = (theta) => x + (width * theta) / 90;
    const shapes = [shape.line(x, y, x + width, y, "soft"), shape.line(x, y, x, y - height, "soft")];
    const steps = Array.from({ length: 361 }, (_, i) => i / 4);
    [["ink", ""], ["warm", 'stroke-dasharray="7 4"'], ["cool", 'stroke-dasharray="2 3"']].forEach(([kind, dash], n) => {
      shapes.push(shape.curve(steps.map((theta) => [place(theta), y - height * reflected(theta)[n]]), kind, dash));
    });
    const [f, s, p] = reflected(angle);
    shapes.push(
      shape.dashed(place(angle), y, place(angle), y - height),
      shape.dot(place(angle), y - height * f),
      shape.text(x - 10, y + 5, "0", "soft", "end"),
      shape.text(x - 10, y - height + 6, "1", "soft", "end"),
      shape.text(x + width, y + 22, "90°", "soft"),
      shape.text(x + 12, y - height + 4, "F", "ink", "start"),
      shape.text(x + 40, y - height + 4, "rs²", "warm", "start"),
      shape.text(x + 80, y - height + 4, "rp²", "cool", "start"),
    );
    const brewster = degrees(Math.atan(1 / ratio));
    let text = `At ${angle.toFixed(1)}°: F = ${f.toFixed(3)}, the mean of rs² = ${s.toFixed(3)} and rp² = ${p.toFixed(3)}. Brewster's angle is ${brewster.toFixed(1)}°`;
    text += inside ? `, and beyond ${degrees(Math.asin(1 / ratio)).toFixed(1)}° all is reflected.` : ".";
    return { shapes, text };
  },
  drag: (px) => ({ angle: Math.round((2 * 90 * (px - 60)) / 400) / 2 }),
});
