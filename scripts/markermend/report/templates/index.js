// The first page: how many decisions wait in each recording, and keys to move between recordings.
const links = () => [...document.querySelectorAll("#table tbody tr")].filter((row) => !row.hidden).map((row) => row.querySelector("a"));
function showCounts() {
  for (const row of document.querySelectorAll("#table tbody tr")) {
    const state = readWaiting(keyOf(row.dataset.recording, row.dataset.subject));
    const count = state.added.length + state.withdrawn.length;
    const cell = row.querySelector("td.decisions");
    cell.replaceChildren(row.dataset.decisions, ...(count ? [" + ", element("b", { textContent: count, title: "waiting" })] : []));
    cell.dataset.v = Number(row.dataset.decisions) + count;
  }
}
document.addEventListener("decisions", showCounts);
document.addEventListener("keydown", (event) => {
  const step = { j: 1, k: -1 }[event.key];
  if (!step || event.ctrlKey || event.altKey || event.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
  const all = links(), at = all.indexOf(document.activeElement);
  all[Math.max(0, Math.min(all.length - 1, at < 0 ? 0 : at + step))]?.focus();
});
loadShared().then(() => { showCounts(); offer(); });
