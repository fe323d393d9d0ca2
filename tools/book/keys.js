// "Escape" leaves the search; Sphinx itself goes there at "/".
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape" && event.target.matches(".sidebar-search")) {
    event.target.blur();
  }
});
