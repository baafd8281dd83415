// What is open at first, and printing with all plots.
function asked() { return findingRows.find((row) => "#" + row.id === location.hash); }
async function drawAll() {
  document.documentElement.classList.add("paper");
  findingRows.filter(isOpen).forEach(closeFinding);
  for (const row of findingRows) if (document.getElementById("data-" + row.id)) await openFinding(row, { figures: false });
}
async function printAll() {
  await drawAll();
  window.print();
  findingRows.filter(isOpen).forEach(closeFinding);
  document.documentElement.classList.remove("paper");
}
// What is open is printed in the colours of paper, whatever those of the screen.
window.addEventListener("beforeprint", () => {
  document.documentElement.classList.add("printing");
  redraw();
});
window.addEventListener("afterprint", () => {
  document.documentElement.classList.remove("printing");
  redraw();
});
const printPlace = document.getElementById("print");
if (document.querySelector('script[id^="data-finding-"]')) printPlace.append(button("Print with all plots", printAll));
if (new URLSearchParams(location.search).has("print")) {
  drawAll().then(() => { document.documentElement.dataset.drawn = "all"; });
} else if (asked()) visit(asked(), { focus: false });
else if (findingRows.length && document.getElementById("data-" + findingRows[0].id)) {
  choose(findingRows[0]);
  openFinding(findingRows[0]);
}
window.addEventListener("hashchange", () => { if (asked() && asked() !== chosen) visit(asked()); });
