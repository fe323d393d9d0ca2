// The density estimate: the k nearest photons on a wall that is bright on the left
// and dim on the right, and what the power in their disk says of the light.
live("photon-disk", {
  size: [520, 300],
  hint: "Drag the point, or move the sliders.",
  controls: [
    { name: "x", label: "x in meters", min: 0.05, max: 1.95, step: 0.01, value: 0.6 },
    { name: "y", label: "y in meters", min: 0.05, max: 0.95, step: 0.01, value: 0.5 },
    { name: "k", label: "k", min: 2, max: 200, step: 1, value: 20, digits: 0 },
    { name: "n", label: "photons", min: 200, max: 3000, step: 100, value: 800, digits: 0 },
    { name: "cone", label: "cone filter", value: false },
  ],
  draw({ x, y, k, n, cone }) {
    const meter = 250, left = 10, top = 10;
    // Three of four photons fall on the left square meter, of 2 W in all.
    let state = 1;
    const uniform = () => (state = (Math.imul(1664525, state) + 1013904223) >>> 0) / 2 ** 32;
    const photons = Array.from({ length: n }, () => {
      const side = uniform() < 0.75 ? 0 : 1, u = uniform();
      return [side + u, uniform()];
    });
    const away = photons.map(([px, py]) => Math.hypot(px - x, py - y));
    const r = [...away].sort((a, b) => a - b)[k - 1];
    const weight = (distance) => (cone ? 3 * (1 - distance / r) : 1);
    const power = away.reduce((sum, one) => (one < r ? sum + (2 / n) * weight(one) : sum), 0);
    const estimate = power / (Math.PI * r * r), truth = x < 1 ? 1.5 : 0.5;
    const shapes = [shape.area(left, top, meter, meter, "glow"), shape.area(left + meter, top, meter, meter, "sand")];
    shapes.push(`<circle cx="${left + meter * x}" cy="${top + meter * y}" r="${meter * r}" class="stroke cool" fill="none"/>`);
    photons.forEach(([px, py], i) => {
      shapes.push(shape.dot(left + meter * px, top + meter * py, away[i] < r ? "warm" : "soft", away[i] < r ? 2.6 : 1.4));
    });
    shapes.push(
      `<rect x="${left}" y="${top}" width="${2 * meter}" height="${meter}" class="stroke ink" fill="none"/>`,
      shape.dot(left + meter * x, top + meter * y, "ink", 4),
      shape.text(left + meter / 2, 285, "1.5 W/m²"),
      shape.text(left + 1.5 * meter, 285, "0.5 W/m²"),
    );
    const text =
      `The disk up to photon ${k} has r = ${r.toFixed(3)} m. The other ${k - 1} say ${estimate.toFixed(2)} W/m², and the light is ${truth} W/m². ` +
      `Noise of the box: ${k > 2 ? ((100 / Math.sqrt(k - 2)).toFixed(0) + " %") : "without bound"}.`;
    return { shapes, text };
  },
  drag: (px, py) => ({ x: Math.round((100 * (px - 10)) / 250) / 100, y: Math.round((100 * (py - 10)) / 250) / 100 }),
});
