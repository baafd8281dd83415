// A form for decisions on any frames of any marker: what they are, that they count as missing, or that they stay as they are. Its lines are those of
// the same table.
function stretchChoices() {
  const option = (verb, value, text) => element("option", { value: choice(verb, value), textContent: text });
  return [
    element("option", { value: "", textContent: "choose what they are" }), option("missing", "", "count as missing"), option("protect", "", "stay as they are (protect)"),
    element("optgroup", { label: "are an artifact" }, ...about.classes.map((name) => option("class", name, "of class " + name)), option("class", "swap:", "of class swap, with")),
  ];
}
function called(name, control) {
  control.setAttribute("aria-label", name);
  return control;
}
function frameField(name, value) {
  const [min, max] = about.frames;
  return called(name, element("input", { type: "number", required: true, min, max, value, className: "frame" }));
}
function markerList(name, markers, chosen) {
  const option = (marker) => element("option", { value: marker, textContent: marker === "*" ? "all markers" : marker, selected: marker === chosen });
  return called(name, element("select", {}, ...markers.map(option)));
}
function stretchForm(finding, plot) {
  const first = frameField("First frame", finding?.first_frame ?? about.frames[0]), last = frameField("Last frame", finding?.last_frame ?? about.frames[0]);
  const marker = markerList("Marker", [...about.markers, "*"], finding?.marker), partner = markerList("Other marker", about.markers);
  const what = called("What these frames are", element("select", { required: true }, ...stretchChoices()));
  const note = called("Note", element("input", { type: "text", placeholder: "why, for the report" }));
  const said = element("output", { className: "soft" });
  const view = button("Take the frames in view", () => {
    const range = plot.layout.xaxis.range.map(Number), [low, high] = about.frames;
    first.value = Math.max(low, Math.ceil(range[0]));
    last.value = Math.min(high, Math.floor(range[1]));
    check();
  });
  const form = element("form", { className: "stretch" }, "Frames ", first, " to ", last, ...(plot ? [" ", view] : []), " of ", marker, " ", what, " ", partner, " ", note, " ",
    element("button", { type: "submit", textContent: "Add" }), " ", said);
  const isSwap = () => what.value === "class swap:";
  function check() {
    partner.hidden = !isSwap();
    last.setCustomValidity(Number(last.value) < Number(first.value) ? "The last frame comes before the first." : "");
    const impossible = isSwap() && (marker.value === "*" || marker.value === partner.value);
    partner.setCustomValidity(impossible ? "A swap is between two markers." : "");
  }
  form.addEventListener("input", () => { said.textContent = ""; check(); });
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const [verb, value = ""] = what.value.split(" "), whole = isSwap() ? value + partner.value : value;
    const line = lineOf(marker.value, Number(first.value), Number(last.value), verb, whole, note.value);
    said.textContent = addLine(line) ? "Added: " + words(line) : "This is decided already.";
  });
  check();
  return form;
}
document.getElementById("stretch").append(stretchForm(null, null));
