// Decisions on the findings of this recording.
const about = JSON.parse(document.getElementById("decidable").textContent);
const key = keyOf(about.recording, about.subject);
const rowOf = (number) => document.getElementById("finding-" + number);
let existing = [];
function choice(verb, value) { return [verb, value].filter(Boolean).join(" "); }
function lineOf(finding, verb, value, note) {
  return signed([about.recording, finding.marker, String(finding.first_frame), String(finding.last_frame), verb, value, oneLine(note), about.subject]);
}
function isOn(line, finding) {
  return line[MARKER] === finding.marker && Number(line[FIRST]) === finding.first_frame && Number(line[LAST]) === finding.last_frame &&
    line[FIRST] !== "" && (line[VERB] === "protect" || line[VERB] === "method" || (/^(accept|reject)$/.test(line[VERB]) && line[VALUE] === finding.value));
}
function current(finding) {
  const state = readWaiting(key), withdrawn = new Set(state.withdrawn.map(identity));
  const added = state.added.find((line) => isOn(line, finding));
  if (added) return { line: added, waits: true };
  const stays = existing.find((line) => isOn(line, finding) && !withdrawn.has(identity(line)));
  if (stays) return { line: stays, waits: false };
  return { line: null, waits: existing.some((line) => isOn(line, finding)) };
}
function decide(finding, verb, value, note) {
  const state = readWaiting(key);
  const added = state.added.filter((line) => !isOn(line, finding));
  const own = existing.filter((line) => isOn(line, finding));
  const line = verb ? lineOf(finding, verb, value, note) : null;
  const kept = line && own.find((other) => sameButSigned(other, line));
  const withdrawn = state.withdrawn.filter((other) => !isOn(other, finding)).concat(own.filter((other) => other !== kept));
  writeWaiting(key, { added: line && !kept ? [...added, line] : added, withdrawn });
  document.dispatchEvent(new Event("decisions"));
}
function withdraw(line) {
  const state = readWaiting(key), same = (other) => identity(other) === identity(line);
  if (state.added.some(same)) state.added = state.added.filter((other) => !same(other));
  else if (state.withdrawn.some(same)) state.withdrawn = state.withdrawn.filter((other) => !same(other));
  else state.withdrawn.push(line);
  writeWaiting(key, state);
  document.dispatchEvent(new Event("decisions"));
}
function methodsOf(finding) { return [...new Set([...Object.keys(finding.errors), ...finding.classes.flatMap((name) => about.methods[name])])]; }
function choices(finding) {
  const option = (verb, value, text) => element("option", { value: choice(verb, value), textContent: text });
  const methods = methodsOf(finding).map((name) => option("method", name, name + (name in finding.errors ? " (" + finding.errors[name].toFixed(1) + " mm)" : "")));
  const verbs = finding.value === null ? ["protect"] : ["accept", "reject", "protect"];
  return [option("", "", "none"), ...verbs.map((verb) => option(verb, verb === "protect" ? "" : finding.value, verb)),
    element("optgroup", { label: "method" }, ...methods)];
}
function show(finding, number, against) {
  const row = rowOf(number), { line, waits } = current(finding), list = row.querySelector("select");
  const wanted = line ? choice(line[VERB], line[VALUE]) : "";
  if (wanted && ![...list.options].some((option) => option.value === wanted)) list.append(element("option", { value: wanted, textContent: wanted }));
  list.value = wanted;
  row.classList.toggle("waits", waits);
  row.querySelector("td.decide").dataset.v = waits ? 2 : line ? 1 : 0;
  const clash = line && against.has(identity(line));
  const told = clash ? "contradicts another" : waits ? "waiting" : line ? "this run" : "";
  row.querySelector(".state").textContent = told + (line?.[BY] ? ", " + signature(line) : "");
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
