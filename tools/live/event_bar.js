// The bar of events: where a random number falls, and what that costs.
live.figures["event-bar"] = (stage) => {
  const svg = live.drawing(stage, 520, 150, "Drag ξ, or the ends of the pieces.");
  const x0 = 20, width = 480, top = 62, tall = 44;
  const names = ["diffuse", "specular", "refraction", "absorbed"];
  const colors = ["warm", "cool", "green", "gray"];
  const ends = [0.33, 0.56, 0.81, 1];
  let xi = 0.52;
  const across = (p) => x0 + width * p;

  const pieces = names.map((_, i) => live.add(svg, "rect", { y: top, height: tall, class: `fill-${colors[i]}` }));
  const frame = live.add(svg, "rect", { y: top - 1, height: tall + 2, class: "line-ink", "stroke-width": 3 });
  const labels = names.map(() => live.text(svg, 0, top + tall / 2 + 5, "", "paper"));
  const arrow = live.arrow(svg, "ink");
  const name = live.text(svg, 0, 22, "ξ");
  live.text(svg, x0, top + tall + 34, "0", "soft");
  live.text(svg, x0 + width, top + tall + 34, "1", "soft");
  const says = live.html(stage, "p", { class: "live-says" });

  const start = (i) => (i ? ends[i - 1] : 0);
  const size = (i) => ends[i] - start(i);
  const picked = () => ends.findIndex((end) => xi < end);
  const sentence = () => {
    const i = picked(), p = size(i);
    const fell = `ξ = ${xi.toFixed(2)} falls on “${names[i]}”, from ${start(i).toFixed(2)} to ${ends[i].toFixed(2)}.`;
    if (i === 3) return `${fell} The path ends.`;
    return `${fell} This happens with the probability ${p.toFixed(2)}, so the weight is divided by ${p.toFixed(2)}: ` +
      `times ${(1 / p).toFixed(2)}.`;
  };
  const show = () => {
    names.forEach((words, i) => {
      const wide = width * size(i);
      live.set(pieces[i], { x: across(start(i)), width: wide });
      live.set(labels[i], { x: across(start(i)) + wide / 2 });
      live.write(labels[i], wide > 86 ? words : wide > 30 && i < 3 ? `p_${"dst"[i]}` : "");
    });
    live.set(frame, { x: across(start(picked())), width: width * size(picked()) });
    live.draw(arrow, [across(xi), 34], [across(xi), top - 1]);
    live.set(name, { x: across(xi) + 18 });
    says.textContent = sentence();
    numberHandle(xi);
    handles.forEach((handle, i) => handle(ends[i]));
  };
  const at = (x) => (x - x0) / width;
  const handles = [0, 1, 2].map((i) =>
    live.handle(svg, { label: `The end of ${names[i]}`, color: colors[i], min: 0, max: 1, step: 0.01, at,
      place: (p) => [across(p), top + tall + 12], says: (p) => `${names[i]} ends at ${p.toFixed(2)}`,
      moved: (p) => {
        ends[i] = p;
        for (let j = 0; j < 3; ++j) if (j < i ? ends[j] > p : ends[j] < p) ends[j] = p;
        show();
      } }));
  const numberHandle = live.handle(svg, { label: "The random number ξ", color: "ink", min: 0, max: 0.99, step: 0.01,
    at, place: (p) => [across(p), 26], says: sentence, moved: (p) => ((xi = p), show()) });
  show();
};
