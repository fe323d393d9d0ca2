// The density estimate: photons on a floor with a bright strip, the disk around a
// point up to the k-th photon, and what it says along a line, beside the truth.
live("density-estimate", {
  size: [520, 350],
  hint: "Drag the point along the line, or move the sliders.",
  controls: [
    { name: "photons", label: "photons per m²", min: 100, max: 1000, step: 50, value: 400, digits: 0 },
    { name: "k", label: "neighbors k", min: 3, max: 100, step: 1, value: 20, digits: 0 },
    { name: "u", label: "x in meters", min: 0.1, max: 1.9, step: 0.01, value: 0.5 },
    { name: "cone", label: "cone filter", value: false },
  ],
  draw({ photons, k, u, cone }) {
    const x = 10, meter = 250, middle = 0.5, floor = 338, watt = 26; // middle: the line, in meters from the top
    const all = photonsOnTheFloor(photons);
    const at = estimateAt(all, u, middle, k, cone, photons);
    const shapes = [];
    for (const [a, b] of all) {
      if (a < 0 || a > 2 || b < 0 || b > 0.88) continue;
      const inside = Math.hypot(a - u, b - middle) < at.radius;
      shapes.push(shape.dot((x + meter * a).toFixed(1), (meter * b).toFixed(1), inside ? "warm" : "soft", inside ? 2.4 : 1.6));
    }
    const px = x + meter * u, py = meter * middle;
    shapes.push(
      shape.dashed(x, py, x + 2 * meter, py),
      // No farther down than the floor is shown.
      `<clipPath id="shown-floor"><rect x="0" y="0" width="520" height="222"/></clipPath>`,
      `<circle cx="${px}" cy="${py}" r="${(meter * at.radius).toFixed(1)}" class="stroke cool" fill="none" clip-path="url(#shown-floor)"/>`,
      shape.dot(px, py, "cool", 4),
    );
    // Below: the truth and the estimate along the line.
    const places = Array.from({ length: 91 }, (_, i) => 0.1 + 0.02 * i);
    const height = (value) => floor - watt * Math.min(value, 3.9);
    const says = places.map((place) => estimateAt(all, place, middle, k, cone, photons).value);
    shapes.push(
      shape.line(x, floor, x + 2 * meter, floor, "soft"),
      shape.curve(places.map((place, i) => [x + meter * place, height(says[i])]), "warm"),
      shape.curve(places.map((place) => [x + meter * place, height(trueIrradiance(place))]), "ink", 'stroke-dasharray="7 4"'),
      shape.dot(px, height(at.value), "warm"),
      shape.text(x + 8, 250, "truth (dashed)", "ink", "start"),
      shape.text(x + 132, 250, "estimate", "warm", "start"),
    );
    const error = Math.sqrt(places.reduce((sum, place, i) => sum + (says[i] - trueIrradiance(place)) ** 2, 0) / places.length);
    const text =
      `The disk around x = ${u.toFixed(2)} has r = ${at.radius.toFixed(3)} m, up to photon ${k}. The ${k - 1} before it, of 1/${photons} W each, ` +
      `give ${at.value.toFixed(2)} W/m²; the truth is ${trueIrradiance(u).toFixed(2)}. Along the line the error is ${error.toFixed(2)} W/m² (root mean square).`;
    return { shapes, text };
  },
  drag: (px) => ({ u: Math.round((px - 10) / 2.5) / 100 }),
});

/** Irradiance in W/m²: a bright strip on an evenly lit floor. */
function trueIrradiance(u) {
  return 0.5 + 2 * Math.exp(-(((u - 1.2) / 0.15) ** 2));
}

/** [u, v] of the photons, farther than is shown. More photons are the same ones, and others. */
function photonsOnTheFloor(perSquareMeter) {
  const left = -0.8, wide = 3.6, top = -0.4, high = 1.8, most = 2.5, found = [];
  for (let i = 0; i < perSquareMeter * most * wide * high; ++i) {
    const u = left + wide * uniform(3 * i);
    if (most * uniform(3 * i + 1) < trueIrradiance(u)) found.push([u, top + high * uniform(3 * i + 2)]);
  }
  return found;
}

/** The irradiance by the k - 1 photons that are nearer than the k-th. */
function estimateAt(all, u, v, k, cone, perSquareMeter) {
  let near = [];
  // Wherever light is darkest, k photons fill a disk of this squared radius, more or less.
  for (let limit = k / (0.5 * perSquareMeter * Math.PI); near.length < k; limit *= 2) {
    near = all.map(([a, b]) => (a - u) ** 2 + (b - v) ** 2).filter((square) => square < limit);
  }
  const squares = Float64Array.from(near).sort();
  const radius = Math.sqrt(squares[k - 1]);
  let sum = 0;
  for (let i = 0; i < k - 1; ++i) sum += cone ? 3 * (1 - Math.sqrt(squares[i]) / radius) : 1;
  return { radius, value: sum / perSquareMeter / (Math.PI * radius * radius) };
}
