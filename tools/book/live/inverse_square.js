// The inverse square law: one cone of light, and the areas that it covers.
live("inverse-square", {
  size: [520, 250],
  hint: "Drag the nearer area, or move the slider.",
  controls: [{ name: "d", label: "d in meters", min: 0.5, max: 1.5, step: 0.01, value: 1 }],
  draw({ d }) {
    const x = 36, y = 122, meter = 134;
    const solidAngle = 0.1, edge = Math.acos(1 - solidAngle / (2 * Math.PI));
    const near = d * meter, far = 2 * near;
    const shapes = [shape.polygon([[x, y], ...[-1, -0.5, 0, 0.5, 1].map((i) => polar(x, y, far, i * edge))], "glow")];
    for (let i = -3; i <= 3; ++i) shapes.push(shape.line(x, y, ...polar(x, y, far, (i / 3) * edge), "soft"));
    for (const [reach, name, row] of [[near, "area A, I/d²", 44], [far, "area 4A, I/(4d²)", 20]]) {
      const [, top] = polar(x, y, reach, edge);
      shapes.push(
        shape.arc(x, y, reach, -edge, edge, "warm thick"),
        shape.dashed(x + reach, row + 6, x + reach, top - 4),
        shape.text(x + reach, row, name, "warm"),
      );
    }
    shapes.push(
      shape.arrow(x, 216, x + near, 216, "soft"),
      shape.text(x + near / 2, 210, "d"),
      shape.arrow(x, 240, x + far, 240, "soft"),
      shape.text(x + 0.75 * far, 234, "2d"),
      shape.dot(x, y, "lamp", 6),
      shape.text(x, y + 28, "I", "warm"),
    );
    const covered = (distance) => (solidAngle * distance ** 2).toFixed(3);
    const weight = (distance) => (1 / distance ** 2).toFixed(3);
    const text =
      `With I = 1 W/sr the cone of ${solidAngle} sr contains 0.1 W. At d = ${d.toFixed(2)} the area is ${covered(d)} m², and the weight I/d² is ${weight(d)} W/m². ` +
      `At 2d = ${(2 * d).toFixed(2)} they are ${covered(2 * d)} m² and ${weight(2 * d)} W/m².`;
    return { shapes, text };
  },
  drag: (px) => ({ d: Math.round((100 * (px - 36)) / 134) / 100 }),
});
