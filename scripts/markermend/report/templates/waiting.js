// The number of decisions that wait, their download, and what is wrong with them: beside the text of the page that is about decisions.
const NOT_KEPT = "This browser keeps nothing for this page (its storage is refused or full): download the decisions before you close it. Links between the pages carry them along.";
let shared = { columns: [], decisions: [], recordings: [] };
let incomplete = "";
let unsaved = false;
async function loadShared() {
  try { shared = await dataSet(); settle(shared.decisions); } catch (error) { incomplete = error.message; }
}
function plural(count, word) { return count + " " + word + (count === 1 ? "" : "s"); }
function offer() {
  const place = document.getElementById("waiting");
  const { decisions, recordings } = countWaiting();
  const wrong = contradictions(tableLines(shared.decisions));
  const count = decisions ? plural(decisions, "decision") + " waiting in " + plural(recordings, "recording") : "No decision waiting";
  const saving = button("Download decisions.tsv", () => { unsaved = false; download(shared.columns, shared.decisions); },
    { disabled: Boolean(wrong.length || incomplete), className: decisions ? "main" : "" });
  const drop = button("Discard", discard, { hidden: decisions === 0 });
  const state = element("output", { textContent: count });
  place.replaceChildren(state, " ", saving, " ", drop);
  const short = document.getElementById("waiting-count");
  if (short) short.textContent = decisions ? " (" + decisions + " waiting)" : "";
  const notes = [];
  if (incomplete) notes.push(incomplete + "; without it the table cannot be completed.");
  for (const [one, other] of wrong.slice(0, 10)) notes.push("These contradict each other, and a run would refuse the table: " + [one, other].map(words).join(" and ") + " (" + one[RECORDING] + ").");
  if (!keeps) notes.push(NOT_KEPT);
  const list = document.getElementById("waiting-notes");
  list.hidden = notes.length === 0;
  list.replaceChildren(...notes.map((text) => element("p", { textContent: text })));
}
function discard() {
  if (!window.confirm("Discard all decisions that wait, in all recordings of this report? Those of the last run stay.")) return;
  for (const key of allWaiting().keys()) writeWaiting(key, { added: [], withdrawn: [] });
  document.dispatchEvent(new Event("decisions"));
}
// Firefox keeps a storage for each page that is opened from a folder.
document.getElementById("apart").hidden = location.protocol !== "file:" || !navigator.userAgent.includes("Firefox");
const own = document.getElementById("person");
own.value = person;
own.addEventListener("change", () => {
  introduce(own.value);
  document.dispatchEvent(new Event("decisions"));
});
document.addEventListener("decisions", () => { unsaved = countWaiting().decisions > 0; offer(); });
window.addEventListener("storage", () => {
  own.value = person = store?.getItem(NAME) ?? person;
  document.dispatchEvent(new Event("decisions"));
});
window.addEventListener("beforeunload", (event) => { if (unsaved && !keeps && !carrying) event.preventDefault(); });
