// The controls of the lab's box: each writes its value into `chosen`, and reports
// the change.
lab.boxControls = (parent, chosen, changed) => {
  const controls = {};
  const row = (label) => {
    const made = lab.html(parent, "label", { class: "lab-row" });
    lab.html(made, "span", {}, label);
    return made;
  };
  /** A list of [value, words] to choose from. */
  controls.choice = (name, label, options) => {
    const made = row(label);
    const select = lab.html(made, "select");
    made.refill = (list) => {
      select.replaceChildren();
      for (const [value, words] of list) lab.html(select, "option", { value }, words);
      if (!list.some(([value]) => value === chosen[name])) chosen[name] = list[0][0];
      select.value = String(chosen[name]);
      made.hidden = list.length < 2;
    };
    made.refill(options);
    select.addEventListener("change", () => {
      chosen[name] = typeof chosen[name] === "number" ? +select.value : select.value;
      changed(name);
    });
    return made;
  };
  /** A number on a slider; `words` turns it into text. */
  controls.range = (name, label, [min, max, step], words = (x) => x.toFixed(2)) => {
    const made = row(label);
    const slider = lab.html(made, "input", { type: "range", min, max, step });
    const output = lab.html(made, "output");
    made.show = () => {
      slider.value = chosen[name];
      output.textContent = words(chosen[name]);
      slider.setAttribute("aria-valuetext", words(chosen[name]));
    };
    made.limit = (most) => {
      slider.max = most;
      chosen[name] = Math.min(chosen[name], most);
      made.show();
    };
    slider.addEventListener("input", () => {
      chosen[name] = +slider.value;
      changed(name);
      made.show();
    });
    made.show();
    return made;
  };
  controls.check = (name, label) => {
    const made = row(label);
    const box = lab.html(made, "input", { type: "checkbox" });
    box.checked = chosen[name];
    box.addEventListener("change", () => {
      chosen[name] = box.checked;
      changed(name);
    });
    return made;
  };
  controls.button = (words, press) => {
    const made = lab.html(parent, "button", { type: "button" }, words);
    made.addEventListener("click", press);
    return made;
  };
  return controls;
};

/** Keeps the ball from reflecting more light than it receives: if `name` grows,
 * the others shrink. With Fresnel's equations (`shared`) the larger of ks and kt
 * counts. */
lab.keepEnergy = (ball, name, shared) => {
  const before = { ...ball };
  const mirrored = shared ? Math.max(ball.ks, ball.kt) : ball.ks + ball.kt;
  if (ball.kd + mirrored <= 1 + 1e-9) return "";
  if (shared && name === "kd") {
    for (const k of ["ks", "kt"]) ball[k] = Math.min(ball[k], 1 - ball.kd);
  } else if (shared) {
    ball.kd = 1 - mirrored;
  } else {
    const others = ["kd", "ks", "kt"].filter((k) => k !== name);
    const sum = others.reduce((total, k) => total + ball[k], 0);
    const room = others.length < 3 ? 1 - ball[name] : 1;
    for (const k of others) ball[k] *= room / sum;
  }
  const less = ["kd", "ks", "kt"].filter((k) => ball[k] < before[k]);
  // Rounds down, so that rounding does not add light.
  for (const k of less) ball[k] = Math.floor(ball[k] * 100 + 1e-6) / 100;
  return `A surface cannot give back more light than it gets, so ${less.join(" and ")} went down.`;
};
