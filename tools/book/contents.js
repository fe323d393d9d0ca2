// Marks the current section in the sidebar's table of contents.
document.addEventListener("DOMContentLoaded", () => {
  const links = [...document.querySelectorAll(".page-contents a[href^='#']")];
  const places = links
    .map((link) => [link, document.getElementById(decodeURIComponent(link.hash.slice(1)))])
    .filter(([, section]) => section);
  if (!places.length) return;
  const update = () => {
    const line = innerHeight / 4;
    let current = places[0][0];
    for (const [link, section] of places) {
      if (section.getBoundingClientRect().top <= line) current = link;
    }
    for (const [link] of places) {
      if (link === current) link.setAttribute("aria-current", "location");
      else link.removeAttribute("aria-current");
    }
  };
  addEventListener("scroll", update, { passive: true });
  update();
});
