// Fresnel's reflectance from both sides of a surface, at one angle.
live.figures["fresnel-curves"] = (stage) => {
  const svg = live.drawing(stage, 520, 300, "Drag the dot along the curve, and change the glass.");
  const y0 = 245, width = 196, height = 190;
  let angle = 60, eta = 1.5;

  const fresnel = (degrees, ratio) => {
    const cosine = Math.cos(live.radians(degrees)), sine2 = ratio * ratio * (1 - cosine * cosine);
    if (sine2 >= 1) return [1, 1, 1];
    const other = Math.sqrt(1 - sine2);
    const rs = (ratio * cosine - other) / (ratio * cosine + other), rp = (cosine - ratio * other) / (cosine + ratio * other);
    return [(rs * rs + rp * rp) / 2, rs * rs, rp * rp];
  };
  const sides = [{ x0: 40, words: "from outside", ratio: () => 1 / eta }, { x0: 302, words: "from inside", ratio: () => eta }];
  const says = (side) => {
    const [f, s, p] = fresnel(angle, side.ratio());
    return f === 1 && side.ratio() > 1 ? `${side.words}, F = 1: all is reflected`
      : `${side.words}, F = ${f.toFixed(3)}, the mean of ${s.toFixed(3)} and ${p.toFixed(3)}`;
  };
  for (const side of sides) {
    side.across = (degrees) => side.x0 + (width * degrees) / 90;
    side.point = (degrees, i) => [side.across(degrees), y0 - height * fresnel(degrees, side.ratio())[i]];
    live.draw(live.line(svg, "ink", 1.4), [side.x0, y0 - height], [side.x0, y0], [side.x0 + width, y0]);
    live.text(svg, side.x0 - 8, y0 + 5, "0", "soft", "end");
    live.text(svg, side.x0 - 8, y0 - height + 6, "1", "soft", "end");
    live.text(svg, side.x0 + width, y0 + 22, "90°", "soft");
    live.text(svg, side.x0 + width / 2, 28, side.words);
    side.special = live.line(svg, "soft", 1, "3 3");
    side.specialName = live.text(svg, 0, y0 + 22, "", "soft");
    side.brewster = live.line(svg, "soft", 1, "3 3");
    side.brewsterName = live.text(svg, 0, y0 - height * 0.4 + 12, "", "soft", "end");
    side.curves = [["cool", "2 3"], ["warm", "6 3"], ["ink", ""]].map(([color, dash]) => live.line(svg, color, color === "ink" ? 2 : 1.8, dash));
    side.now = live.line(svg, "soft", 1.4);
    side.handle = live.handle(svg, { label: `The angle t_o, ${side.words}`, color: "ink", min: 0, max: 90, step: 0.5,
      place: (degrees) => side.point(degrees, 0), at: (x) => ((x - side.x0) / width) * 90,
      says: (degrees) => `${degrees.toFixed(1)} degrees ${says(side)}`, moved: (degrees) => ((angle = degrees), show()) });
  }
  for (const [x, color, words] of [[150, "ink", "F"], [250, "warm", "r_s squared"], [380, "cool", "r_p squared"]]) {
    live.text(svg, x, 292, words, color);
  }
  const row = live.html(stage, "label", { class: "live-row" }, "η of the glass ");
  const slider = live.html(row, "input", { type: "range", min: 1.05, max: 2.5, step: 0.05, value: eta });
  const value = live.html(row, "output");
  const text = live.html(stage, "p", { class: "live-says" });

  const show = () => {
    for (const side of sides) {
      side.curves.forEach((curve, i) => {
        // Half degrees, and finer where the curve is steepest.
        const steps = Array.from({ length: 361 }, (_, k) => side.point(k / 4, [2, 1, 0][i]));
        live.draw(curve, ...steps);
      });
      const special = live.degrees(side.ratio() > 1 ? Math.asin(1 / eta) : Math.atan(eta));
      live.draw(side.special, [side.across(special), y0], [side.across(special), y0 - height]);
      live.write(side.specialName, `${special.toFixed(1)}°`);
      live.set(side.specialName, { x: Math.min(side.across(special), side.x0 + width - 42) });
      if (side.ratio() > 1) {
        const at = side.across(live.degrees(Math.atan(1 / eta)));
        live.draw(side.brewster, [at, y0], [at, y0 - height * 0.4]);
        live.write(side.brewsterName, `${live.degrees(Math.atan(1 / eta)).toFixed(1)}°`);
        live.set(side.brewsterName, { x: at - 5 });
      }
      live.draw(side.now, [side.across(angle), y0], side.point(angle, 0));
      side.handle(angle);
    }
    value.textContent = eta.toFixed(2);
    live.write(text, `t_o = ${angle.toFixed(1)}°: ${sides.map(says).join("; ")}.`);
  };
  slider.addEventListener("input", () => ((eta = +slider.value), show()));
  show();
};
