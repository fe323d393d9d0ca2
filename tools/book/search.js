// Finds words in the text and in the code of all pages, in `sections`, which
// sections.js has: {page, anchor, title, chapter, text}. Works from file://.
(() => {
  const wanted = (new URLSearchParams(location.search).get("q") ?? "").trim();
  const field = document.querySelector(".sidebar-search");
  if (field) field.value = wanted;
  const summary = document.getElementById("search-summary");
  if (!wanted) {
    summary.textContent = "Type a word into the field: prose, code and formulas are searched.";
    return;
  }

  // Names in code are one word, and also each of their parts.
  const words = (text) =>
    (text.match(/[\p{L}\p{N}_]+/gu) ?? []).flatMap((word) => {
      const parts = word.split("_").filter(Boolean);
      return parts.length > 1 ? [word, ...parts] : [word];
    });
  const index = new MiniSearch({ idField: "number", fields: ["title", "text"], tokenize: words });
  index.addAll(sections.map((section, number) => ({ ...section, number })));
  const options = {
    prefix: (word) => word.length > 2,
    boost: { title: 4 },
    boostDocument: (number) => weight(sections[number].page),
  };
  let found = index.search(wanted, { ...options, combineWith: "AND" });
  if (!found.length) found = index.search(wanted, { ...options, fuzzy: 0.2 });

  function weight(page) {
    if (page.startsWith("stages/")) return 2;
    return page === "mistakes.html" ? 0.3 : 1;
  }

  const shown = found.slice(0, 40);
  summary.textContent = found.length
    ? `“${wanted}” is in ${found.length} section${found.length > 1 ? "s" : ""}` +
      (found.length > shown.length ? `; the first ${shown.length}:` : ":")
    : `“${wanted}” is on no page.`;
  const list = document.getElementById("search-found");
  for (const one of shown) list.append(entry(sections[one.id], one.terms));

  function entry(section, terms) {
    const item = document.createElement("li");
    const link = document.createElement("a");
    link.href = section.page + section.anchor;
    link.textContent = section.title;
    const where = document.createElement("span");
    where.className = "chapter";
    where.textContent = section.chapter === section.title ? "" : section.chapter;
    const text = document.createElement("p");
    text.append(...excerpt(section.text, terms));
    item.append(link, " ", where, text);
    return item;
  }

  /** The text where most of the words are close together, marked. */
  function excerpt(text, terms) {
    const pattern = new RegExp(`(?<![\\p{L}\\p{N}])(${terms.join("|")})`, "giu");
    let at = 0, most = 0;
    for (const match of text.matchAll(pattern)) {
      const near = text.slice(match.index, match.index + 160).match(pattern);
      const different = new Set(near.map((word) => word.toLowerCase())).size;
      if (different > most) [at, most] = [match.index, different];
    }
    const begin = at < 80 ? 0 : text.indexOf(" ", at - 80) + 1;
    const piece = text.slice(begin, begin + 240);
    const parts = piece.split(pattern).map((part, i) => {
      if (i % 2 === 0) return part;
      const mark = document.createElement("mark");
      mark.textContent = part;
      return mark;
    });
    return [begin > 0 ? "… " : "", ...parts, begin + 240 < text.length ? " …" : ""];
  }
})();
