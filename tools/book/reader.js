// What a reader keeps in the browser: whether code that is an exercise is hidden,
// which exercises are done, and which chapters are read. Without JavaScript, and on
// paper, all code is there.
document.addEventListener("DOMContentLoaded", () => {
  const kept = (() => {
    try {
      return JSON.parse(localStorage.getItem("lightwalk")) ?? {};
    } catch {
      return {};
    }
  })();
  kept.pages ??= {};
  const keep = () => {
    try {
      localStorage.setItem("lightwalk", JSON.stringify(kept));
    } catch {} // the browser keeps nothing for this page
    showProgress();
  };
  const pageOf = (address) => new URL(address, location).pathname.split("/").slice(-2).join("/");
  const exercises = [...document.querySelectorAll(".admonition.exercise")];
  const here = (kept.pages[pageOf(location)] ??= {});
  here.done ??= [];
  here.all = exercises.length;

  /** In the sidebar, beside each chapter that was visited. */
  function showProgress() {
    for (const link of document.querySelectorAll(".sidebar-tree:not(.page-contents) a.reference.internal")) {
      const page = kept.pages[pageOf(link.href)];
      const done = page?.all ? `${page.done.length}/${page.all}` : "";
      const read = page?.read ? "✓" : "";
      link.querySelector(".progress")?.remove();
      if (!done && !read) continue;
      const mark = document.createElement("span");
      mark.className = "progress";
      mark.textContent = ` ${done} ${read}`;
      mark.title = [done && `${done} exercises done`, read && "read"].filter(Boolean).join(", ");
      link.append(mark);
    }
  }

  if (exercises.length) {
    addSwitch();
    exercises.forEach(addTick);
    document.querySelectorAll(".exercise-body").forEach(addCover);
    addEventListener("hashchange", uncoverTarget);
    uncoverTarget();
  }
  const end = document.querySelector("article section:last-of-type > :last-child");
  if (end && /stages\/|core\//.test(location.pathname)) {
    new IntersectionObserver(([{ isIntersecting }], observer) => {
      if (!isIntersecting || scrollY === 0) return;
      here.read = true;
      observer.disconnect();
      keep();
    }).observe(end);
  }
  showProgress();

  function labeled(checked, words, changed) {
    const label = document.createElement("label"), box = document.createElement("input");
    Object.assign(box, { type: "checkbox", checked });
    box.addEventListener("change", () => {
      changed(box.checked);
      keep();
    });
    label.append(box, ` ${words}`);
    return label;
  }

  function addSwitch() {
    const hide = (hidden) => document.body.classList.toggle("hides", hidden);
    hide(!kept.shows);
    const label = labeled(!kept.shows, "Hide the code that I am to write", (hidden) => {
      kept.shows = !hidden;
      hide(hidden);
    });
    label.className = "hide-switch";
    document.querySelector("article h1").after(label);
  }

  function addTick(exercise) {
    const { id } = exercise;
    const label = labeled(here.done.includes(id), "done", (done) => {
      here.done = here.done.filter((one) => one !== id);
      if (done) here.done.push(id);
    });
    label.className = "tick";
    exercise.querySelector(".admonition-title").append(label);
  }

  function addCover(body) {
    const cover = document.createElement("button");
    cover.type = "button";
    cover.className = "cover";
    const lines = body.querySelectorAll(".linenos").length;
    cover.textContent = `Yours to write: ${lines} ${lines === 1 ? "line" : "lines"} here. Show this code`;
    cover.addEventListener("click", () => body.classList.add("shown"));
    body.append(cover);
  }

  /** A link to a line shows it. */
  function uncoverTarget() {
    document.getElementById(location.hash.slice(1))?.closest(".exercise-body")?.classList.add("shown");
  }
});
