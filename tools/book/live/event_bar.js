// The bar of events: the event that a random number picks, and its probability.
live("event-bar", {
  size: [520, 170],
  hint: "Drag along the bar, or move the sliders.",
  controls: [
    { name: "xi", label: "ξ", min: 0, max: 0.999, step: 0.001, value: 0.62, digits: 3 },
    { name: "kd", label: "kd", min: 0, max: 1, step: 0.01, value: 0.5 },
    { name: "ks", label: "ks", min: 0, max: 1, step: 0.01, value: 0.25 },
    { name: "kt", label: "kt", min: 0, max: 1, step: 0.01, value: 0.1 },
    { name: "late", label: "bounce 16 or later", value: false },
  ],
  draw({ xi, kd, ks, kt, late }) {
    const x = 20, width = 480, y = 70, height = 44;
    const limit = late ? 0.95 : 1, sum = kd + ks + kt;
    const scale = sum > limit ? limit / sum : 1;
    const events = [
      ["diffuse", kd, "sand"],
      ["specular", ks, "glass"],
      ["refraction", kt, "glow"],
    ];
    const shapes = [];
    let from = 0, picked = null;
    for (const [name, k, kind] of events) {
      const p = scale * k;
      shapes.push(shape.area(x + width * from, y, width * p, height, kind));
      if (width * p > 9 * name.length) shapes.push(shape.text(x + width * (from + p / 2), y + 28, name));
      if (p > 0.05) shapes.push(shape.text(x + width * (from + p / 2), y + height + 20, p.toFixed(2), "soft"));
      if (!picked && xi < from + p) picked = [name, k, p];
      from += p;
      shapes.push(shape.line(x + width * from, y, x + width * from, y + height, "soft"));
    }
    if (1 - from > 0.18) shapes.push(shape.text(x + width * (from + 1) / 2, y + 28, "absorbed", "soft"));
    shapes.push(`<rect x="${x}" y="${y}" width="${width}" height="${height}" class="stroke ink" fill="none"/>`);
    shapes.push(shape.arrow(x + width * xi, 23, x + width * xi, y - 2, "warm"), shape.text(x + width * xi, 17, "ξ", "warm"));
    let text = picked
      ? `ξ = ${xi.toFixed(3)} picks the ${picked[0]} event. Its probability is ${picked[2].toFixed(3)}, and k/p = ${(picked[1] / picked[2]).toFixed(3)}.`
      : `ξ = ${xi.toFixed(3)} picks absorption: the path ends. Its probability is ${(1 - from).toFixed(3)}.`;
    if (scale < 1) text += ` The three add to ${sum.toFixed(2)}, and are scaled to ${limit}.`;
    return { shapes, text };
  },
  drag: (px) => ({ xi: (px - 20) / 480 }),
});
