// Snell's law: omega_o in glass or in air, and where the light comes from.
live.figures.snell = (stage) => {
  const svg = live.drawing(stage, 520, 320, "Drag the blue arrow, also across the surface.");
  const x = 260, y = 160, reach = 130, eta = 1.5;
  live.add(svg, "path", { d: `M20 ${y}H500V310H20z`, class: "fill-glass" });
  live.draw(live.line(svg, "cool", 2), [20, y], [500, y]);
  live.draw(live.line(svg, "soft", 1.2, "5 4"), [x, 12], [x, 308]);
  live.text(svg, 26, y - 10, "air, η = 1", "soft", "start");
  live.text(svg, 26, y + 22, "glass, η = 1.5", "soft", "start");
  // The three angles of the caption.
  for (const angle of [25, 41.81, 60]) {
    live.draw(live.line(svg, "soft", 1.4), live.polar(x, y, 180 + angle, reach + 18), live.polar(x, y, 180 + angle, reach + 26));
  }
  const mirrored = live.arrow(svg, "soft", 1.4), through = live.arrow(svg, "warm", 2.4), out = live.arrow(svg, "cool", 2.4);
  const outName = live.text(svg, 0, 0, "w_o", "cool"), throughName = live.text(svg, 0, 0, "w_t", "warm");
  live.set(live.dot(svg, "ink"), { cx: x, cy: y });
  const says = live.html(stage, "p", { class: "live-says" });

  const put = (label, angle, r, side) => {
    const [px, py] = live.polar(x, y, angle + side, r);
    live.set(label, { x: px, y: py + 5 });
  };
  // `turn` is 0 straight down in the glass, 90 in the surface, 180 straight up.
  const facts = (turn) => {
    const inside = turn < 90, angle = inside ? turn : 180 - turn;
    const sine = (inside ? eta : 1 / eta) * Math.sin(live.radians(angle));
    return { inside, angle, sine, refracted: sine < 1 ? live.degrees(Math.asin(sine)) : null };
  };
  const sentence = (turn) => {
    const { inside, angle, sine, refracted } = facts(turn);
    const law = `${inside ? "1.5" : "1/1.5"} · sin ${angle.toFixed(1)}° = ${sine.toFixed(3)}`;
    if (refracted === null) return `In glass at ${angle.toFixed(1)}°: ${law} is no sine. No ray leaves, all is reflected.`;
    return `In ${inside ? "glass" : "air"} at ${angle.toFixed(1)}°: ${law}, so w_t is at ${refracted.toFixed(1)}° in ${inside ? "air" : "glass"}.`;
  };
  const show = (turn) => {
    const { inside, refracted } = facts(turn);
    const total = refracted === null;
    live.draw(out, [x, y], live.polar(x, y, 180 + turn, reach));
    put(outName, 180 + turn, reach * 0.62, inside ? 13 : -13);
    const mirror = live.polar(x, y, 180 - turn, total ? reach : reach * 0.75);
    live.draw(mirrored, [x, y], mirror);
    live.set(mirrored, { visibility: total ? "hidden" : "visible" });
    const towards = total ? 180 - turn : inside ? refracted : 180 - refracted;
    live.draw(through, [x, y], live.polar(x, y, towards, reach));
    live.write(throughName, total ? "all reflected" : "w_t");
    live.set(throughName, { "text-anchor": total ? "start" : "middle" });
    if (total) {
      const [px, py] = mirror;
      live.set(throughName, { x: Math.min(px + 8, 396), y: Math.max(py + 20, y + 24) });
    } else put(throughName, towards, reach + 15, 0);
    if (!total && Math.abs(towards - 90) < 6) live.set(throughName, { x: x + reach + 16, y: inside ? y - 12 : y + 22 });
    live.write(says, sentence(turn));
    handle(turn);
  };
  const handle = live.handle(svg, { label: "The direction w_o", color: "cool", min: 0, max: 180, step: 0.2,
    place: (turn) => live.polar(x, y, 180 + turn, reach + 8), moved: show, says: sentence,
    at: (px, py) => (px > x ? (py > y ? 0 : 180) : live.degrees(Math.atan2(x - px, py - y))) });
  show(25);
};
