// The page of mistakes: a field that filters the tables while the reader types.
// Without JavaScript all rows are visible.
function searchMistakes() {
  const table = document.querySelector("table.mistakes");
  if (!table) return;
  const rows = [...document.querySelectorAll("table.mistakes tbody tr")].map((row) => ({
    row, stage: row.cells[0].textContent, text: row.textContent.toLowerCase(),
  }));
  const form = document.createElement("form");
  form.className = "search-mistakes";
  form.setAttribute("role", "search");
  form.innerHTML = `<label>Search the mistakes<input type="search" autocomplete="off"></label>
    <label>Stage<select><option value="">all</option></select></label>
    <span role="status"></span>`;
  const [field, stage, count] = ["input", "select", "[role=status]"].map((s) => form.querySelector(s));
  for (const one of new Set(rows.map((r) => r.stage))) stage.add(new Option(one, one));

  function filter() {
    const words = field.value.toLowerCase().replaceAll("'", "’").split(/\s+/);
    const found = rows.filter(({ row, stage: its, text }) => {
      const shown = (!stage.value || its === stage.value) && words.every((w) => text.includes(w));
      row.hidden = !shown;
      return shown;
    });
    count.textContent = `${found.length} of ${rows.length}`;
  }

  // A link to a mistake ends the search, and opens the mistake with its lines.
  function showTarget() {
    const row = document.getElementById(decodeURIComponent(location.hash.slice(1)))?.closest("table.mistakes tr");
    if (!row) return;
    form.reset();
    filter();
    row.querySelector("details").open = true;
    row.scrollIntoView({ block: "center" });
  }

  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    field.value = "";
    filter();
  });
  table.before(form);
  filter();
  showTarget();
  window.addEventListener("hashchange", showTarget);
}
document.addEventListener("DOMContentLoaded", searchMistakes);
