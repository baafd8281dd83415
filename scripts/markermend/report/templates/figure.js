// The stick figure: before and after overlaid, the lines of the mesh, and a slider over the poses that the page holds.
const MAX_FIGURES = 4;
const NOT_SOLID = "This browser draws nothing in 3-D (WebGL is off), so the figure cannot be turned.";
const live = [];
let figureData = null;
function poses() {
  if (figureData) return figureData;
  const data = JSON.parse(document.getElementById("figure-data").textContent);
  let frame = 0;
  data.numbers = data.frames.map((step) => (frame += step));
  const unpacked = (series) => {
    const places = new Array(data.numbers.length).fill(null);
    for (const [offset, ...columns] of series) {
      const sums = [0, 0, 0];
      columns[0].forEach((_, i) => {
        columns.forEach((column, axis) => { sums[axis] += column[i]; });
        places[offset + i] = [...sums];
      });
    }
    return places;
  };
  data.before = data.before.map(unpacked);
  data.after = data.after.map(unpacked).map((changed, m) => {
    const result = data.before[m].map((place, i) => changed[i] ?? place);
    for (const [start, stop] of data.taken[m]) result.fill(null, start, stop);
    return result;
  });
  figureData = data;
  return data;
}
function split(points) { return Object.fromEntries(["x", "y", "z"].map((axis, i) => [axis, points.map((point) => (point ? point[i] : null))])); }
function figureTraces(data, at, marker, span) {
  const states = [["original", data.before, colour("original"), 3, 3.2], ["result", data.after, colour("result"), 5, 4]];
  const traces = states.flatMap(([name, own, ink, width, size]) => {
    const ends = data.edges.flatMap(([a, b]) => [own[a][at], own[a][at] && own[b][at] ? own[b][at] : null, null]);
    const common = { type: "scatter3d", name, legendgroup: name, connectgaps: false };
    return [
      { ...common, mode: "lines", ...split(ends), line: { color: ink, width }, hoverinfo: "skip", showlegend: false },
      { ...common, mode: "markers", ...split(own.map((places) => places[at])), marker: { color: ink, size, opacity: 1 }, text: data.markers,
        hovertemplate: "%{text}<br>%{x:.0f}, %{y:.0f}, %{z:.0f} mm<extra>" + name + "</extra>" },
    ];
  });
  if (marker < 0) return traces;
  const path = (places) => split(span.map((i) => places[i]));
  const flag = (name, own, ink, symbol) => [
    { type: "scatter3d", mode: "lines", name, legendgroup: name, showlegend: false, ...path(own[marker]), line: { color: ink, width: 2 }, hoverinfo: "skip" },
    { type: "scatter3d", mode: "markers", name, legendgroup: name, ...split([own[marker][at]]), text: [data.markers[marker]],
      marker: { color: ink, size: 7, symbol, line: { color: ink, width: 2 } }, hovertemplate: "%{text}<br>%{x:.0f}, %{y:.0f}, %{z:.0f} mm<extra>" + name + "</extra>" },
  ];
  return [...traces, ...flag(data.markers[marker] + ", original", data.before, colour("orange"), "circle-open"), ...flag(data.markers[marker] + ", result", data.after, colour("result"), "circle")];
}
// A cube about the middle of the pose, of the same size in all poses, so that a subject who walks stays in the figure.
function cube(data, shown) {
  const middles = shown.map((i) => [0, 1, 2].map((axis) => {
    const values = data.before.map((places, m) => (places[i] ?? data.after[m][i])?.[axis]).filter((value) => value !== undefined).sort((a, b) => a - b);
    return values.length ? [values[0], values[values.length - 1]] : [0, 0];
  }));
  const half = Math.max(100, ...middles.flatMap((pose) => pose.map(([low, high]) => 0.55 * (high - low))));
  return (k) => middles[k].map(([low, high]) => [(low + high) / 2 - half, (low + high) / 2 + half]);
}
function figureLayout(data, ranges) {
  const camera = EYES[data.up];
  const axis = (name, i) => ({ title: { text: name }, range: ranges[i], gridcolor: colour("line"), zeroline: false, showbackground: false, showticklabels: false, nticks: 5,
    color: colour("soft"), showspikes: false });
  return {
    margin: { l: 0, r: 0, t: 30, b: 0 }, paper_bgcolor: "rgba(0,0,0,0)", uirevision: "kept",
    font: { family: getComputedStyle(document.body).fontFamily, size: 11, color: colour("ink") },
    legend: { orientation: "h", x: 0, y: 1, yanchor: "bottom" },
    scene: {
      aspectmode: "cube", xaxis: axis("x", 0), yaxis: axis("y", 1), zaxis: axis("z", 2), dragmode: "turntable", uirevision: "kept",
      camera: { up: Object.fromEntries(["x", "y", "z"].map((name) => [name, Number(name === data.up)])), eye: { x: camera[0], y: camera[1], z: camera[2] } },
    },
    modebar: { bgcolor: "rgba(0,0,0,0)", color: colour("soft"), activecolor: colour("ink") },
  };
}
// Asked once, since a browser counts every context that it gives.
let solid = null;
function canDraw3d() {
  solid ??= ["webgl2", "webgl"].some((kind) => {
    const context = document.createElement("canvas").getContext(kind);
    context?.getExtension("WEBGL_lose_context")?.loseContext();
    return context !== null;
  });
  return solid;
}
// Draw the poses of which the numbers are given; a browser has few 3-D contexts, so that the figure that was drawn first goes.
async function drawFigure(place, shown, start, marker = -1) {
  const data = poses();
  const view = element("div", { className: "view" }), label = element("output", { className: "soft" });
  const slider = element("input", { type: "range", min: 0, max: shown.length - 1, value: start });
  slider.setAttribute("aria-label", "Frame");
  place.replaceChildren(view, element("div", { className: "slider" }, slider, label));
  const ranges = cube(data, shown);
  const draw = () => {
    const k = Number(slider.value), number = data.numbers[shown[k]];
    label.textContent = "frame " + number + ", " + ((number - data.origin) / data.rate).toFixed(2) + " s";
    slider.setAttribute("aria-valuetext", label.textContent);
    if (!canDraw3d()) return view.replaceChildren(stillPicture(shown[k], marker, shown), NOT_SOLID);
    return Plotly.react(view, figureTraces(data, shown[k], marker, shown), figureLayout(data, ranges(k)), { displaylogo: false, responsive: true });
  };
  if (canDraw3d()) live.push(place);
  while (live.length > MAX_FIGURES) release(live[0]);
  await draw();
  slider.addEventListener("input", draw);
}
function release(place) {
  const at = live.indexOf(place);
  if (at < 0) return;
  live.splice(at, 1);
  Plotly.purge(place.querySelector(".view"));
  place.replaceChildren(button("Show the figure", () => place.dispatchEvent(new Event("again"))));
}
async function recordingFigure(event) {
  const place = event.target.closest(".figure");
  const again = () => drawFigure(place, poses().numbers.map((_, i) => i).filter((i) => (poses().numbers[i] - poses().origin) % poses().regular === 0), 0);
  place.addEventListener("again", again);
  try {
    await loadLibrary(results + "report/plotly.min.js", NO_PLOTTING_SCRIPT);
    await again();
  } catch (error) { place.className = "note bad"; place.textContent = error.message; }
}
document.getElementById("figure-place")?.append(button("Show the figure", recordingFigure));
