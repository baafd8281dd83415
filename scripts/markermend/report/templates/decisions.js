// Decisions are lines of the table that the config names as `decisions`: lists of cells, in the order of its columns. Those that a person
// makes on these pages wait in the browser, by data set and recording, until a run has followed them.
const RECORDING = 0, MARKER = 1, FIRST = 2, LAST = 3, VERB = 4, VALUE = 5, NOTE = 6, SUBJECT = 7, BY = 8, DATE = 9;
const PREFIX = "markermend decisions " + results + " ";

function identity(line) { return JSON.stringify(line); }
// All but by whom and when.
function sameButSigned(one, other) { return identity(one.slice(0, BY)) === identity(other.slice(0, BY)); }
function signature(line) { return [line[BY], line[DATE]].filter(Boolean).join(", "); }
function words(line) {
  const remarks = [line[NOTE], signature(line)].filter(Boolean).join("; ");
  return line[MARKER] + (line[FIRST] === "" ? "" : ", frames " + line[FIRST] + "–" + line[LAST]) + ": " +
    [line[VERB], line[VALUE]].filter(Boolean).join(" ") + (remarks ? " (" + remarks + ")" : "");
}
function oneLine(text) { return text.trim().replace(/\s+/g, " "); }

// What waits: for each recording the lines that were added, and those of the run that were withdrawn.
const memory = new Map();
let keeps = true;
function storage() {
  try {
    const test = PREFIX + "test";
    window.localStorage.setItem(test, "1");
    window.localStorage.removeItem(test);
    return window.localStorage;
  } catch { keeps = false; return null; }
}
const store = storage();
function keyOf(recording, subject) { return PREFIX + JSON.stringify([subject, recording]); }
function understood(text) {
  try {
    const state = JSON.parse(text);
    const isLine = (line) => Array.isArray(line) && [BY, DATE + 1].includes(line.length) && line.every((cell) => typeof cell === "string");
    const areLines = (list) => Array.isArray(list) && list.every(isLine);
    // Earlier versions wrote neither names nor dates.
    const whole = (line) => [...line, "", ""].slice(0, DATE + 1);
    if (areLines(state.added) && areLines(state.withdrawn)) return { added: state.added.map(whole), withdrawn: state.withdrawn.map(whole), at: Number(state.at) || 0 };
  } catch { /* what somebody else wrote */ }
  return { added: [], withdrawn: [], at: 0 };
}
function readWaiting(key) { return understood(memory.get(key) ?? store?.getItem(key) ?? "{}"); }
function writeWaiting(key, { added, withdrawn, at = Date.now() }) {
  const text = JSON.stringify({ added, withdrawn, at });
  try { store?.setItem(key, text); memory.delete(key); } catch { keeps = false; }
  if (!store || !keeps) memory.set(key, text);
}
function allWaiting() {
  const keys = new Set(memory.keys());
  for (let i = 0; i < (store?.length ?? 0); i++) if (store.key(i).startsWith(PREFIX)) keys.add(store.key(i));
  return new Map([...keys].sort().map((key) => [key, readWaiting(key)]));
}
// Who decides here, and the day, which are written beside each decision. Those that wait without a name get it when it is given.
const NAME = "markermend name";
let person = store?.getItem(NAME) ?? "";
function today() {
  const now = new Date();
  return [now.getFullYear(), now.getMonth() + 1, now.getDate()].map((part) => String(part).padStart(2, "0")).join("-");
}
function signed(line) { return [...line.slice(0, BY), person, today()]; }
function introduce(text) {
  person = oneLine(text);
  try { store?.setItem(NAME, person); } catch { keeps = false; }
  for (const [key, state] of allWaiting()) {
    const added = state.added.map((line) => line.map((cell, i) => (i === BY && !cell ? person : cell)));
    if (added.some((line, i) => line[BY] !== state.added[i][BY])) writeWaiting(key, { added, withdrawn: state.withdrawn });
  }
}
// What the last run has followed waits no longer.
function settle(existing) {
  const known = new Set(existing.map(identity));
  for (const [key, state] of allWaiting()) {
    const added = state.added.filter((line) => !known.has(identity(line))), withdrawn = state.withdrawn.filter((line) => known.has(identity(line)));
    if (added.length + withdrawn.length < state.added.length + state.withdrawn.length) writeWaiting(key, { added, withdrawn });
  }
}
function countWaiting() {
  const states = [...allWaiting().values()].filter((state) => state.added.length + state.withdrawn.length);
  return { recordings: states.length, decisions: states.reduce((sum, state) => sum + state.added.length + state.withdrawn.length, 0) };
}
// The whole table: the lines of the run without those that were withdrawn, and then those that were added.
function tableLines(existing) {
  const states = [...allWaiting().values()];
  const withdrawn = new Set(states.flatMap((state) => state.withdrawn).map(identity));
  return [...existing.filter((line) => !withdrawn.has(identity(line))), ...states.flatMap((state) => state.added)];
}

// As markermend.storage.tab_separated writes tables.
const FORMULA = /^'*[=+\-@\t\r\n\uff1d\uff0b\uff0d\uff20]/;
const NUMBER = /^([+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?(inf|nan))$/;
function cellText(value) {
  const text = FORMULA.test(value) && !NUMBER.test(value) ? "'" + value : value;
  return /[\t\r\n"]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text;
}
function tableText(columns, lines) {
  return [columns, ...lines].map((line) => line.map(cellText).join("\t") + "\n").join("");
}

// As markermend.planning.contradictions finds lines that cannot both be followed, which a run refuses.
function patternsOverlap(one, other) {
  if (!one && !other) return true;
  if (other.startsWith("*") && !one.startsWith("*")) [one, other] = [other, one];
  if (one.startsWith("*")) return patternsOverlap(one.slice(1), other) || (other !== "" && patternsOverlap(one, other.slice(1)));
  const fits = one !== "" && other !== "" && (one[0] === other[0] || one[0] === "?" || other[0] === "?");
  return fits && patternsOverlap(one.slice(1), other.slice(1));
}
function excludeEachOther(one, other) {
  const verbs = new Set([one[VERB], other[VERB]]);
  if (verbs.has("protect")) return false;
  if (verbs.size === 1) return (verbs.has("class") || verbs.has("method")) && one[VALUE] !== other[VALUE];
  if (verbs.has("method")) return [one[VALUE], other[VALUE]].includes("leave") && (verbs.has("accept") || verbs.has("class"));
  const kinds = [one, other].map((line) => line[VALUE].split(":")[0]);
  if (kinds[0] === kinds[1]) return true;
  return kinds.includes("") && !kinds.includes("gap");
}
function contradict(one, other) {
  const start = (line) => (line[FIRST] === "" ? -Infinity : Number(line[FIRST]));
  const stop = (line) => (line[LAST] === "" ? Infinity : Number(line[LAST]));
  const same = one[RECORDING] === other[RECORDING] && (one[SUBJECT] === "" || other[SUBJECT] === "" || one[SUBJECT] === other[SUBJECT]);
  return same && start(one) <= stop(other) && start(other) <= stop(one) && excludeEachOther(one, other) && patternsOverlap(one[MARKER], other[MARKER]);
}
function contradictions(lines) {
  const byRecording = new Map();
  for (const line of lines) byRecording.set(line[RECORDING], [...(byRecording.get(line[RECORDING]) ?? []), line]);
  return [...byRecording.values()].flatMap((own) => own.flatMap((one, i) => own.slice(i + 1).filter((other) => contradict(one, other)).map((other) => [one, other])));
}

function download(columns, existing) {
  const address = URL.createObjectURL(new Blob([tableText(columns, tableLines(existing))], { type: "text/tab-separated-values" }));
  element("a", { href: address, download: "decisions.tsv" }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}
