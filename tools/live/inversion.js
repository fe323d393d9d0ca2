// Inversion sampling: a height of the curve, and the angle below it.
live.figures.inversion = (stage) => {
  const svg = live.drawing(stage, 520, 320, "Drag the blue dot up and down.");
  const x0 = 60, y0 = 270, width = 400, height = 220;
  const theta = (xi) => Math.acos(1 - xi);
  const across = (t) => x0 + (width * t) / (Math.PI / 2);
  const up = (xi) => y0 - height * xi;

  // What stands still: ten equal steps, the curve, the axes.
  const heightBand = live.add(svg, "rect", { class: "fill-glass" });
  const angleBand = live.add(svg, "rect", { class: "fill-sand" });
  for (let i = 0; i < 10; ++i) {
    const xi = (i + 0.5) / 10, at = across(theta(xi));
    live.draw(live.line(svg, "faint", 1.2), [x0, up(xi)], [at, up(xi)], [at, y0]);
  }
  live.draw(live.line(svg, "ink", 1.4), [x0, y0 - height], [x0, y0], [x0 + width, y0]);
  const curve = Array.from({ length: 91 }, (_, i) => live.radians(i));
  live.draw(live.line(svg, "ink", 2.2), ...curve.map((t) => [across(t), up(1 - Math.cos(t))]));
  live.text(svg, x0 + 14, y0 - height - 12, "P(θ) = 1 − cos θ", "ink", "start");
  live.text(svg, x0 - 14, y0 - height + 5, "1", "soft", "end");
  live.text(svg, x0, y0 + 26, "0", "soft");
  live.text(svg, x0 + width, y0 + 26, "90°", "soft");

  const level = live.line(svg, "cool", 2), down = live.arrow(svg, "warm");
  const xiName = live.text(svg, x0 - 34, 0, "ξ", "cool", "end");
  const thetaName = live.text(svg, 0, y0 + 26, "θ", "warm");
  const says = live.html(stage, "p", { class: "live-says" });

  const show = (xi) => {
    const at = across(theta(xi));
    const low = live.clamp(xi - 0.05, 0, 0.9), high = low + 0.1;
    const from = theta(low), to = theta(Math.min(high, 1));
    live.set(heightBand, { x: x0, y: up(high), width: across(from) - x0, height: height * 0.1 });
    live.set(angleBand, { x: across(from), y: up(high), width: across(to) - across(from), height: y0 - up(high) });
    live.draw(level, [x0, up(xi)], [at, up(xi)]);
    live.draw(down, [at, up(xi)], [at, y0]);
    live.set(xiName, { y: up(xi) + 5 });
    live.set(thetaName, { x: live.clamp(at, x0 + 16, x0 + width - 34) });
    says.textContent = `ξ = ${xi.toFixed(2)} leads to θ = ${live.degrees(theta(xi)).toFixed(1)}°. ` +
      `The tenth of all heights from ${low.toFixed(2)} to ${high.toFixed(2)} leads to ` +
      `${live.degrees(to - from).toFixed(1)}° of angles.`;
    handle(xi);
  };
  const handle = live.handle(svg, { label: "The random number ξ", color: "cool", min: 0, max: 1, step: 0.01,
    place: (xi) => [x0, up(xi)], at: (x, y) => (y0 - y) / height, moved: show,
    says: (xi) => `ξ ${xi.toFixed(2)}, θ ${live.degrees(theta(xi)).toFixed(1)} degrees` });
  show(0.65);
};
