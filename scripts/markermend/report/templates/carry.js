// Some browsers share no storage among pages that are opened from a folder, and some keep none: links between the pages carry what waits.
const CARRIED = "#waiting=";
let carrying = false;
function carried() {
  const states = [...allWaiting()].filter(([, state]) => state.at);
  return location.protocol === "file:" && (states.length || person) ? CARRIED + encodeURIComponent(JSON.stringify({ person, states })) : "";
}
function leave(address) {
  carrying = true;
  location.href = address + carried();
}
function takeCarried() {
  if (!location.hash.startsWith(CARRIED)) return;
  try {
    const brought = JSON.parse(decodeURIComponent(location.hash.slice(CARRIED.length)));
    if (brought.person) introduce(String(brought.person));
    for (const [key, state] of brought.states) {
      const { added, withdrawn, at } = understood(JSON.stringify(state));
      if (key.startsWith(PREFIX) && at > readWaiting(key).at) writeWaiting(key, { added, withdrawn, at });
    }
  } catch { /* not of our making */ }
  history.replaceState(null, "", location.href.split("#")[0]);
}
// The link to another page that an event is about, with what waits.
function laden(event) {
  const link = event.target.closest?.("a[href]");
  const address = link?.href.split("#")[0];
  if (!address?.endsWith(".html") || !address.startsWith(results) || address === location.href.split("#")[0]) return null;
  link.href = address + carried();
  return link;
}
// Also for a middle click and the menu of a link, which open it elsewhere.
document.addEventListener("pointerdown", laden);
document.addEventListener("click", (event) => { if (laden(event)) carrying = !event.defaultPrevented; });
takeCarried();
