// One finding, opened below its line: its plot, its figure, and why a person decided as they did.
const NO_PLOTTING_SCRIPT = "report/plotly.min.js is missing: finish the run, or keep the report folder next to the subjects' folders";
const numberOf = (row) => Number(row.id.slice("finding-".length));
function framesOf(finding) {
  const data = poses(), plot = document.getElementById("data-finding-" + finding.number);
  const excerpt = plot ? JSON.parse(plot.textContent) : null;
  const first = excerpt ? excerpt.first : finding.first_frame, last = excerpt ? excerpt.first + excerpt.frames * excerpt.step : finding.last_frame;
  return data.numbers.map((number, i) => (first <= number && number <= last ? i : -1)).filter((i) => i >= 0);
}
function reasonField(finding) {
  const field = element("input", { type: "text", className: "reason", placeholder: "why, for the report" });
  const { line } = current(finding);
  field.value = line?.[NOTE] ?? "";
  field.disabled = !line;
  field.addEventListener("change", () => {
    const own = current(finding).line;
    if (own) decide(finding, own[VERB], own[VALUE], field.value);
  });
  return element("label", {}, "Note to the decision ", field);
}
function tried(finding) {
  const methods = Object.entries(finding.errors).map(([name, error]) => name + " " + error.toFixed(1) + " mm");
  return methods.length ? "Methods that were tried, with their expected errors (68 %): " + methods.join(", ") + "." : "";
}
function detailsOf(row) {
  const finding = { ...about.findings[numberOf(row)], number: numberOf(row) };
  const plot = document.getElementById("data-" + row.id), place = element("div", { className: "plot" }), figure = element("div", { className: "figure" });
  const left = plot ? place : element("p", { className: "soft", textContent: "No plot: gaps that were left have none, and of the others the worst (option qc: plots)." });
  const cell = element("td", { colSpan: row.cells.length },
    element("div", { className: "opened" }, element("div", { className: "sheet" }, left, figure), element("p", {}, reasonField(finding), " ", element("span", { className: "soft", textContent: tried(finding) })),
      element("details", { className: "other screen" }, element("summary", { textContent: "Decide on other frames, or state what they are" }), stretchForm(finding, plot ? place : null))));
  return { finding, plot, place, figure, below: element("tr", { className: "drawn" }, cell) };
}
function state(row, open) {
  const see = row.querySelector("button.see");
  see.textContent = open ? "Hide" : "Show";
  see.setAttribute("aria-expanded", String(open));
  see.setAttribute("aria-label", see.textContent + " finding " + numberOf(row));
}
async function openFinding(row, { figures = true } = {}) {
  state(row, true);
  const { finding, plot, place, figure, below } = detailsOf(row);
  row.after(below);
  try {
    await loadLibrary(results + "report/plotly.min.js", NO_PLOTTING_SCRIPT);
    if (!below.isConnected) return;
    const shown = framesOf(finding);
    const middle = (finding.first_frame + finding.last_frame) / 2;
    const start = shown.reduce((best, i, k) => (Math.abs(poses().numbers[i] - middle) < Math.abs(poses().numbers[shown[best]] - middle) ? k : best), 0);
    const marker = poses().markers.indexOf(finding.marker), still = shown.length ? stillPicture(shown[start], marker, shown) : "";
    figure.after(still);
    if (plot) draw(place, JSON.parse(plot.textContent));
    if (!figures || !shown.length) { figure.remove(); return; }
    const again = () => drawFigure(figure, shown, start, marker);
    figure.addEventListener("again", again);
    await again();
  } catch (error) { place.className = "note bad"; place.textContent = error.message; figure.remove(); }
}
function closeFinding(row) {
  state(row, false);
  const below = row.nextElementSibling;
  if (window.Plotly) {
    below.querySelectorAll(".figure").forEach(release);
    below.querySelectorAll(".plot").forEach(undraw);
  }
  below.remove();
}
function isOpen(row) { return row.querySelector("button.see").getAttribute("aria-expanded") === "true"; }
const findingRows = [...document.querySelectorAll("table.findings > tbody > tr")];
for (const row of findingRows) {
  const see = button("Show", () => (isOpen(row) ? closeFinding(row) : openFinding(row)), { className: "see" });
  row.cells[0].prepend(see);
  state(row, false);
}
// On a narrow screen each line is a card, in which every value has the heading of its column.
for (const table of document.querySelectorAll("table.stacked")) {
  const heads = [...table.tHead.rows[table.tHead.rows.length - 1].cells].map((cell) => cell.textContent);
  for (const row of table.tBodies[0].rows) [...row.cells].forEach((cell, i) => { if (heads[i]) cell.dataset.label = heads[i]; });
}
