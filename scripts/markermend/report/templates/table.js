"use strict";
document.documentElement.classList.add("scripted");
// A click on a heading sorts its table; a table shows the rows that match what is typed and chosen above it.
function cellValue(row, column) {
  const cell = row.cells[column];
  const text = cell.dataset.v ?? cell.textContent.trim();
  const number = Number(text);
  return text === "" || text === "–" ? null : Number.isNaN(number) ? text : number;
}
function compare(one, other) {
  if (typeof one === "number" && typeof other === "number") return one - other;
  return String(one).localeCompare(String(other), undefined, { numeric: true });
}
function closeDetails(table) {
  table.querySelectorAll('button.see[aria-expanded="true"]').forEach((button) => button.click());
}
function sortBy(table, heading) {
  closeDetails(table);
  const up = heading.getAttribute("aria-sort") === "descending" || (heading.getAttribute("aria-sort") === "none" && !heading.classList.contains("n"));
  table.querySelectorAll("th[aria-sort]").forEach((other) => other.setAttribute("aria-sort", "none"));
  heading.setAttribute("aria-sort", up ? "ascending" : "descending");
  const rows = [...table.tBodies[0].rows].map((row) => [cellValue(row, heading.cellIndex), row]);
  rows.sort(([one], [other]) => {
    if (one === null || other === null) return (one === null) - (other === null);
    return up ? compare(one, other) : compare(other, one);
  });
  table.tBodies[0].append(...rows.map(([, row]) => row));
}
function filter(table, tools) {
  closeDetails(table);
  const wanted = tools.querySelector("input").value.toLowerCase().split(" ").filter(Boolean);
  const kind = tools.querySelector("select").value;
  let shown = 0;
  for (const row of table.tBodies[0].rows) {
    const text = row.textContent.toLowerCase();
    row.hidden = !(wanted.every((word) => text.includes(word)) && (kind === "" || row.dataset.kind === kind));
    shown += !row.hidden;
  }
  tools.querySelector("output").textContent = shown + " of " + table.tBodies[0].rows.length + " rows";
}
document.querySelectorAll("th[aria-sort]").forEach((heading) => {
  const button = document.createElement("button");
  button.type = "button";
  button.append(...heading.childNodes);
  heading.append(button);
  button.addEventListener("click", () => sortBy(heading.closest("table"), heading));
});
document.querySelectorAll(".tools").forEach((tools) => {
  const table = document.getElementById(tools.dataset.for);
  tools.addEventListener("input", () => filter(table, tools));
});
window.addEventListener("beforeprint", () => {
  document.querySelectorAll("details").forEach((part) => { part.open = true; });
});
