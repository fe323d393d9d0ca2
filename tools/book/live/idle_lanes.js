// Sixteen lanes, step after step: how many have a path to work on.
live("idle-lanes", {
  size: [520, 250],
  hint: "Drag over the lanes, or move the sliders.",
  controls: [
    { name: "step", label: "steps", min: 1, max: 42, step: 1, value: 30, digits: 0 },
    { name: "chance", label: "chance to end", min: 0.05, max: 0.5, step: 0.05, value: 0.2 },
    { name: "refill", label: "refill each lane at once", value: false },
  ],
  draw({ step, chance, refill }) {
    const lanes = 16, x = 8, y = 8, wide = 12, high = 13;
    const until = Array(lanes).fill(0); // the step at which the lane's path has ended
    const shapes = [`<rect x="${x}" y="${y}" width="${42 * wide}" height="${lanes * high}" class="stroke soft" fill="none"/>`];
    let begun = 0, worked = 0, working;
    for (let now = 0; now < step; ++now) {
      const all = until.every((end) => end <= now);
      for (let lane = 0; lane < lanes; ++lane) {
        if (until[lane] > now || !(refill || all)) continue;
        until[lane] = now + pathLength(begun, chance);
        const shown = Math.min(until[lane], step) - now;
        shapes.push(shape.area(x + wide * now, y + high * lane + 1, wide * shown - 1, high - 2, ["glass", "sand", "glow"][begun++ % 3]));
      }
      working = until.filter((end) => end > now).length;
      worked += working;
    }
    const right = x + wide * step;
    shapes.push(
      `<rect x="${right - wide}" y="${y}" width="${wide}" height="${lanes * high}" class="stroke warm" fill="none"/>`,
      shape.text(Math.max(right - wide / 2, 36), y + lanes * high + 20, `step ${step}`, "warm", step > 39 ? "end" : "middle"),
    );
    const share = (100 * worked) / (lanes * step);
    const text = `In step ${step}, ${working} of ${lanes} lanes work. In all steps so far ${share.toFixed(0)} % of the lanes had work, ` +
      `and ${begun - until.filter((end) => end > step).length} paths have ended.`;
    return { shapes, text };
  },
  drag: (px) => ({ step: Math.ceil((px - 8) / 12) }),
});

/** The number of steps of a path that ends with this chance at each: always the same for its number. */
function pathLength(number, chance) {
  return 1 + Math.floor(Math.log(1 - uniform(number)) / Math.log(1 - chance));
}
