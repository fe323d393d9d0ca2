// Inversion sampling of the angle theta: from a height to the curve, and down.
live("inversion", {
  size: [520, 320],
  hint: "Drag up and down, or move the slider.",
  controls: [
    { name: "xi", label: "ξ", min: 0, max: 1, step: 0.005, value: 0.3, digits: 3 },
    { name: "cosine", label: "in proportion to the cosine", value: false },
  ],
  draw({ xi, cosine }) {
    const x = 60, y = 270, width = 400, height = 230;
    const p = (theta) => (cosine ? Math.sin(theta) ** 2 : 1 - Math.cos(theta));
    const inverse = (u) => (cosine ? Math.asin(Math.sqrt(u)) : Math.acos(1 - u));
    const place = (theta) => x + (width * theta) / (Math.PI / 2);
    const shapes = [shape.line(x, y, x + width, y, "soft"), shape.line(x, y, x, y - height, "soft")];
    for (let i = 1; i < 10; ++i) {
      shapes.push(shape.line(place(inverse(i / 10)), y, place(inverse(i / 10)), y - 8, "soft"));
    }
    const points = Array.from({ length: 91 }, (_, i) => [place(radians(i)), y - height * p(radians(i))]);
    const theta = inverse(xi), px = place(theta), py = y - height * xi;
    shapes.push(
      shape.curve(points),
      shape.arrow(x, py, Math.max(px, x + 1), py, "cool"),
      shape.arrow(px, Math.min(py, y - 1), px, y, "warm"),
      shape.dot(px, py),
      shape.text(x - 10, py + 5, "ξ", "cool", "end"),
      shape.text(px, y + 22, "θ", "warm"),
      shape.text(x + width - 4, y - height - 8, cosine ? "P(θ) = sin²θ" : "P(θ) = 1 − cos θ", "ink", "end"),
    );
    // The ends of the axes, where they leave room.
    if (xi > 0.08) shapes.push(shape.text(x - 10, y + 5, "0", "soft", "end"));
    if (xi < 0.92) shapes.push(shape.text(x - 10, y - height + 6, "1", "soft", "end"));
    if (px < x + width - 26) shapes.push(shape.text(x + width, y + 22, "90°", "soft"));
    const density = cosine ? 2 * Math.sin(theta) * Math.cos(theta) : Math.sin(theta);
    const text =
      `ξ = ${xi.toFixed(3)} leads to θ = ${degrees(theta).toFixed(1)}°, cos θ = ${Math.abs(Math.cos(theta)).toFixed(3)}. ` +
      `The curve has the slope p(θ) = ${Math.abs(density).toFixed(3)} there. The small marks are ten equal steps of ξ.`;
    return { shapes, text };
  },
  drag: (px, py) => ({ xi: (270 - py) / 230 }),
});
