// Decisions on the findings of this recording.
const about = JSON.parse(document.getElementById("decidable").textContent);
const key = keyOf(about.recording, about.subject);
const rowOf = (number) => document.getElementById("finding-" + number);
let existing = [];
function choice(verb, value) { return [verb, value].filter(Boolean).join(" "); }
function lineOf(marker, first, last, verb, value, note) {
  return signed([about.recording, marker, String(first), String(last), verb, value, oneLine(note), about.subject]);
}
// What is about samples takes a line for each marker of a joint finding; other decisions on one of them are about all.
const OF_SAMPLES = ["protect", "missing"];
function linesOf(finding, verb, value, note) {
  const markers = OF_SAMPLES.includes(verb) ? finding.markers : [finding.marker];
  return markers.map((marker) => lineOf(marker, finding.first_frame, finding.last_frame, verb, value, note));
}
function isOn(line, finding) {
  if (line[FIRST] === "" || Number(line[FIRST]) !== finding.first_frame || Number(line[LAST]) !== finding.last_frame) return false;
  if (OF_SAMPLES.includes(line[VERB])) return [finding.marker, ...finding.markers].includes(line[MARKER]);
  return line[MARKER] === finding.marker && (/^(class|method)$/.test(line[VERB]) || line[VALUE] === finding.value);
}
function current(finding) {
  const state = readWaiting(key), withdrawn = new Set(state.withdrawn.map(identity));
  const added = state.added.filter((line) => isOn(line, finding));
  const stay = existing.filter((line) => isOn(line, finding) && !withdrawn.has(identity(line)));
  const [line = null] = [...added, ...stay], alike = [...added, ...stay].filter((other) => other[VERB] === line[VERB]);
  return { line, markers: alike.map((other) => other[MARKER]), waits: added.length > 0 || (!line && existing.some((other) => isOn(other, finding))) };
}
function decide(finding, verb, value, note) {
  const state = readWaiting(key);
  const lines = verb ? linesOf(finding, verb, value, note) : [];
  const among = (list) => (line) => list.some((other) => sameButSigned(other, line));
  const others = (list) => list.filter((line) => !isOn(line, finding));
  const gone = existing.filter((line) => isOn(line, finding) && !among(lines)(line));
  wait({ added: [...others(state.added), ...lines.filter((line) => !among(existing)(line))], withdrawn: [...others(state.withdrawn), ...gone] });
}
// Whether the line is new.
function addLine(line) {
  const { added, withdrawn } = readWaiting(key), same = (other) => sameButSigned(other, line);
  const isThere = existing.some(same);
  if (added.some(same) || (isThere && !withdrawn.some(same))) return false;
  wait(isThere ? { added, withdrawn: withdrawn.filter((other) => !same(other)) } : { added: [...added, line], withdrawn });
  return true;
}
function wait({ added, withdrawn }) {
  writeWaiting(key, { added, withdrawn });
  document.dispatchEvent(new Event("decisions"));
}
function withdraw(line) {
  const state = readWaiting(key), same = (other) => identity(other) === identity(line);
  if (state.added.some(same)) state.added = state.added.filter((other) => !same(other));
  else if (state.withdrawn.some(same)) state.withdrawn = state.withdrawn.filter((other) => !same(other));
  else state.withdrawn.push(line);
  wait(state);
}
function methodsOf(finding) { return [...new Set([...Object.keys(finding.errors), ...finding.classes.flatMap((name) => about.methods[name])])]; }
function choices(finding) {
  const option = (verb, value, text) => element("option", { value: choice(verb, value), textContent: text });
  const methods = methodsOf(finding).map((name) => option("method", name, name + (name in finding.errors ? " (" + finding.errors[name].toFixed(1) + " mm)" : "")));
  const isArtifact = finding.value !== null && finding.value !== "gap";
  const verbs = [...(finding.value === null ? [] : ["accept", "reject"]), "protect", ...(isArtifact ? ["missing"] : [])];
  const classes = isArtifact && finding.markers.length === 1 && finding.markers[0] === finding.marker ? about.classes.filter((name) => name !== finding.value) : [];
  return [option("", "", "none"), ...verbs.map((verb) => option(verb, OF_SAMPLES.includes(verb) ? "" : finding.value, verb)),
    element("optgroup", { label: "method" }, ...methods),
    ...(classes.length ? [element("optgroup", { label: "is of class" }, ...classes.map((name) => option("class", name, name)))] : [])];
}
// Of a joint finding, which of its markers a decision is about that names each.
function extent(finding, line, markers) {
  if (!OF_SAMPLES.includes(line?.[VERB]) || (finding.markers.length === 1 && finding.markers[0] === finding.marker)) return "";
  if (markers.includes("*") || finding.markers.every((name) => markers.includes(name))) return finding.markers[0] === "*" ? ", all markers" : ", all " + finding.markers.length + " markers";
  return finding.markers[0] === "*" ? ", " + markers.join(", ") + " only" : ", " + markers.length + " of " + finding.markers.length + " markers";
}
function show(finding, number, against) {
  const row = rowOf(number), { line, markers, waits } = current(finding), list = row.querySelector("select");
  const wanted = line ? choice(line[VERB], line[VALUE]) : "";
  if (wanted && ![...list.options].some((option) => option.value === wanted)) list.append(element("option", { value: wanted, textContent: wanted }));
  list.value = wanted;
  row.classList.toggle("waits", waits);
  row.querySelector("td.decide").dataset.v = waits ? 2 : line ? 1 : 0;
  const clash = line && against.has(identity(line));
  const told = clash ? "contradicts another" : waits ? "waiting" : line ? "this run" : "";
  row.querySelector(".state").textContent = told + extent(finding, line, markers) + (line?.[BY] ? ", " + signature(line) : "");
  const note = row.nextElementSibling?.querySelector("input.reason");
  if (note && note !== document.activeElement) { note.value = line?.[NOTE] ?? ""; note.disabled = !line; }
}
function listWaiting() {
  const state = readWaiting(key), withdrawn = new Set(state.withdrawn.map(identity));
  document.getElementById("added").parentElement.hidden = state.added.length === 0;
  document.getElementById("added").replaceChildren(...state.added.map((line) =>
    element("li", {}, words(line) + " ", button("Withdraw", () => withdraw(line)))));
  about.decided.forEach((entry, i) => {
    const cell = document.getElementById("decided-" + i);
    const line = existing.find((other) => shared.columns.every((name, j) => [RECORDING, SUBJECT].includes(j) || other[j] === String(entry[name] ?? "")));
    const gone = line && withdrawn.has(identity(line));
    cell.closest("tr").classList.toggle("gone", Boolean(gone));
    cell.replaceChildren(...(line ? [button(gone ? "Keep" : "Withdraw", () => withdraw(line))] : []));
  });
}
function showAll() {
  const against = new Set(contradictions(tableLines(shared.decisions)).flat().map(identity));
  about.findings.forEach((finding, number) => show(finding, number, against));
  listWaiting();
}
function prepare() {
  for (const table of document.querySelectorAll("table.findings")) {
    const heading = table.tHead.rows[0].querySelector("th.decide");
    heading.hidden = false;
  }
  about.findings.forEach((finding, number) => {
    const row = rowOf(number), cell = row.querySelector("td.decide");
    const list = element("select", {}, ...choices(finding));
    list.setAttribute("aria-label", "Decision on finding " + number);
    list.addEventListener("change", () => {
      const [verb, ...value] = list.value.split(" ");
      decide(finding, verb, value.join(" "), current(finding).line?.[NOTE] ?? "");
    });
    cell.replaceChildren(list, element("span", { className: "state" }));
  });
  document.addEventListener("decisions", showAll);
}
if (about.findings.length || about.decided.length) prepare();
loadShared().then(() => {
  existing = shared.decisions.filter((line) => line[RECORDING] === about.recording && (line[SUBJECT] === "" || line[SUBJECT] === about.subject));
  showAll();
  offer();
});
