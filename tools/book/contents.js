// Marks the current section in the sidebar's table of contents. Where a page is too
// narrow for the sidebar its header names the section, opens the same list, and has
// the search.
document.addEventListener("DOMContentLoaded", () => {
  const header = document.querySelector(".mobile-header");
  const list = document.querySelector(".page-contents > ul");
  const search = document.querySelector(".sidebar-search-container");
  if (header && search) addSearch(header, search);
  if (!list) return;
  const menu = document.createElement("details"), name = document.createElement("summary");
  menu.className = "here";
  menu.append(name, list.cloneNode(true));
  header?.querySelector(".header-center").append(menu);
  const close = () => (menu.open = false);
  addEventListener("click", (event) => (event.target.closest(".here summary") ? 0 : close()));
  addEventListener("keydown", (event) => event.key === "Escape" && close());

  const links = [...document.querySelectorAll(":is(.page-contents, .here) a[href^='#']")];
  const places = links
    .map((link) => [link, document.getElementById(decodeURIComponent(link.hash.slice(1)))])
    .filter(([, section]) => section);
  const update = () => {
    const line = innerHeight / 4;
    let current = places[0]?.[1];
    for (const [, section] of places) {
      if (section.getBoundingClientRect().top <= line) current = section;
    }
    for (const [link, section] of places) {
      if (section === current) link.setAttribute("aria-current", "location");
      else link.removeAttribute("aria-current");
      if (section === current) name.textContent = link.textContent;
    }
    const page = document.documentElement;
    header?.style.setProperty("--read", page.scrollTop / Math.max(1, page.scrollHeight - innerHeight));
  };
  addEventListener("scroll", update, { passive: true });
  update();
});

/** The search goes to the header's field while this is what one sees. */
function addSearch(header, search) {
  const copy = search.cloneNode(true);
  copy.classList.add("header-search");
  const field = copy.querySelector("input");
  header.querySelector(".header-right").prepend(copy);
  search.querySelector("input").addEventListener("focus", () => field.offsetParent && field.focus());
}
