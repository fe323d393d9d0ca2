// Opens a figure's pictures large. The reader can compare two of them: one lies
// over the other up to an edge that can be dragged, or their difference is shown.
document.addEventListener("DOMContentLoaded", () => {
  const figures = [...document.querySelectorAll(".figure")].filter((figure) => pictures(figure).length);
  if (!figures.length || !window.HTMLDialogElement) return;

  const dialog = document.createElement("dialog");
  dialog.className = "viewer";
  dialog.setAttribute("aria-label", "Figure");
  dialog.innerHTML = `
    <div class="viewer-stage"><img class="under" alt=""><img class="over" alt=""><span class="edge"></span></div>
    <div class="viewer-bar">
      <label>left <select class="first"></select></label>
      <label>right <select class="second"></select></label>
      <label class="slide">edge <input type="range" min="0" max="100" value="50" step="1"></label>
      <label class="apart"><input type="checkbox"> difference, 4 times as bright</label>
      <button type="button">Close</button>
    </div>
    <p class="viewer-caption"></p>`;
  const find = (selector) => dialog.querySelector(selector);
  const stage = find(".viewer-stage");
  const under = find(".under"), over = find(".over");
  const first = find(".first"), second = find(".second");
  const edge = find("input[type=range]"), apart = find("input[type=checkbox]");
  let shown = [];

  for (const figure of figures) {
    const all = pictures(figure);
    for (const picture of all) openable(picture, () => open(figure, all, all.indexOf(picture)));
    if (comparable(all).length < 2) continue;
    const button = document.createElement("button");
    button.type = "button";
    button.className = "compare-button";
    button.textContent = "Compare";
    button.addEventListener("click", () => {
      // The first with the last of the same scene, if there is one.
      const pair = comparable(all), scene = pair.map((one) => one.closest(".panel").className);
      open(figure, pair, 0, scene.lastIndexOf(scene[0]) || pair.length - 1);
    });
    figure.querySelector(".caption")?.append(button);
  }

  /** The pictures of a figure, one of each drawing. */
  function pictures(figure) {
    return [...figure.querySelectorAll(".panel img:not(.only-dark)")];
  }
  function comparable(all) {
    return all.filter((picture) => !/\.svg$|^data:image\/svg/.test(picture.src));
  }
  function label(picture) {
    return picture.closest(".panel").innerText.trim() || picture.alt;
  }

  function openable(picture, action) {
    const panel = picture.closest(".panel");
    for (const image of panel.querySelectorAll("img")) {
      image.tabIndex = 0;
      image.setAttribute("role", "button");
      image.setAttribute("aria-label", `${image.alt}: open large`);
      image.addEventListener("click", action);
      image.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        action();
      });
    }
  }

  function open(figure, all, left, right = left) {
    shown = all;
    const pair = comparable(all).length > 1;
    for (const list of [first, second]) {
      list.replaceChildren(...all.map((picture, i) => new Option(label(picture), i)));
    }
    first.value = left;
    second.value = right;
    dialog.classList.toggle("alone", !pair);
    apart.checked = false;
    edge.value = 50;
    const caption = figure.querySelector(".caption p");
    find(".viewer-caption").replaceChildren(...(caption ? caption.cloneNode(true).childNodes : []));
    update();
    document.body.append(dialog); // the first time
    dialog.showModal();
    if (pair) edge.focus();
  }

  function update() {
    const a = shown[first.value], b = shown[second.value];
    const dark = getComputedStyle(a).display === "none";
    const source = (picture) =>
      dark ? picture.closest(".panel").querySelector(".only-dark")?.src ?? picture.src : picture.src;
    under.src = source(b);
    over.src = source(a);
    under.alt = label(b);
    over.alt = label(a);
    const same = first.value === second.value;
    stage.classList.toggle("same", same);
    stage.classList.toggle("apart", apart.checked && !same);
    stage.style.setProperty("--edge", `${edge.value}%`);
    edge.disabled = same || apart.checked;
    edge.setAttribute("aria-valuetext", `${label(a)} fills ${edge.value} percent`);
  }
  for (const control of [first, second, edge, apart]) control.addEventListener("input", update);

  const drag = (event) => {
    if (!event.buttons || edge.disabled) return;
    const box = stage.getBoundingClientRect();
    edge.value = (100 * (event.clientX - box.left)) / box.width;
    update();
  };
  stage.addEventListener("pointerdown", (event) => {
    stage.setPointerCapture(event.pointerId);
    drag(event);
  });
  stage.addEventListener("pointermove", drag);
  find("button").addEventListener("click", () => dialog.close());
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
});
