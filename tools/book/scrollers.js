// Tab reaches elements that are wider than their place; the arrow keys then scroll
// them and do not turn the page.
document.addEventListener("DOMContentLoaded", () => {
  const all = document.querySelectorAll("pre, .math-wrapper, .table-wrapper");
  const update = () => {
    const wide = [...all].map((one) => one.scrollWidth > one.clientWidth);
    all.forEach((one, i) => {
      if (wide[i]) one.tabIndex = 0;
      else one.removeAttribute("tabindex");
    });
  };
  for (const one of all) {
    one.addEventListener("keydown", (event) => {
      if (event.key === "ArrowLeft" || event.key === "ArrowRight") event.stopPropagation();
    });
  }
  document.addEventListener("toggle", update, true);
  addEventListener("resize", update);
  document.fonts.ready.then(update);
  update();
});
