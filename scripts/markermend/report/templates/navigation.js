// Keys and buttons for the next and the previous finding and recording; a link to page.html#finding-12 opens that finding.
let chosen = null;
const visible = () => [...document.querySelectorAll("table.findings > tbody > tr[id]")].filter((row) => !row.hidden);
function choose(row) {
  chosen?.classList.remove("chosen");
  chosen = row;
  row.classList.add("chosen");
}
function visit(row, { focus = true } = {}) {
  if (chosen && chosen !== row && isOpen(chosen)) closeFinding(chosen);
  choose(row);
  if (!isOpen(row)) openFinding(row);
  history.replaceState(null, "", "#" + row.id);
  if (focus) row.querySelector("button.see").focus({ preventScroll: true });
  row.scrollIntoView({ block: "start" });
}
function stepFinding(step) {
  const rows = visible(), at = rows.indexOf(chosen);
  const row = rows[at < 0 ? 0 : at + step];
  if (row) visit(row);
}
async function stepRecording(step) {
  const { recordings } = await dataSet();
  const own = recordings.findIndex(([page]) => addressOf(page) === location.href.split(/[?#]/)[0]);
  const next = recordings[own + step];
  if (own >= 0 && next) leave(addressOf(next[0]));
}
function addressOf(page) { return new URL(results + page.split("/").map(encodeURIComponent).join("/")).href; }
function pick(name) {
  const list = chosen?.querySelector("select");
  const option = [...(list?.options ?? [])].find((one) => one.value.split(" ")[0] === name);
  if (!option) return;
  list.value = option.value;
  list.dispatchEvent(new Event("change"));
}
function stateFrames() {
  if (!chosen) return;
  if (!isOpen(chosen)) openFinding(chosen);
  const form = chosen.nextElementSibling.querySelector("details.other");
  form.open = true;
  form.querySelector("input").focus();
}
const KEYS = {
  j: () => stepFinding(1), k: () => stepFinding(-1), J: () => stepRecording(1), K: () => stepRecording(-1),
  a: () => pick("accept"), r: () => pick("reject"), p: () => pick("protect"), u: () => pick(""), m: () => chosen?.querySelector("select")?.focus(), f: stateFrames,
};
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
  if (KEYS[event.key]) { event.preventDefault(); KEYS[event.key](); }
});
async function addSteps() {
  const place = document.getElementById("steps");
  if (visible().length) place.append(button("‹ Finding", () => stepFinding(-1), { title: "Previous finding (k)" }), button("Finding ›", () => stepFinding(1), { title: "Next finding (j)" }));
  try {
    const { recordings } = await dataSet();
    const own = recordings.findIndex(([page]) => addressOf(page) === location.href.split(/[?#]/)[0]);
    const step = (text, to, title) => button(text, () => stepRecording(to), { title, disabled: own < 0 || !recordings[own + to] });
    place.append(step("‹ Recording", -1, "Previous recording (K)"), step("Recording ›", 1, "Next recording (J)"));
  } catch { /* the page says elsewhere what is missing */ }
}
addSteps();
