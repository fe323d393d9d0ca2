// "/" goes to the search, "Escape" leaves it.
document.addEventListener("keydown", (event) => {
  const field = document.querySelector(".sidebar-search");
  const typing = /^(input|textarea)$/i.test(event.target.tagName);
  if (!field || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "/" && !typing) {
    event.preventDefault();
    field.focus();
  }
  if (event.key === "Escape" && event.target === field) field.blur();
});
