// The plot of a finding, from data that the page holds compactly.
function colour(name) { return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim(); }
// Each run is [offset, differences of x, of y, of z, ...] in hundredths of a mm; runs are separated by null.
function unpack(runs, finding) {
  const columns = runs.length ? runs[0].length : 4;
  const frames = [];
  const values = Array.from({ length: columns - 1 }, () => []);
  for (const run of runs) {
    for (let i = 0; i < run[1].length; i++) frames.push(finding.first + (run[0] + i) * finding.step);
    frames.push(null);
    for (let c = 1; c < columns; c++) {
      let sum = 0;
      for (const difference of run[c]) { sum += difference; values[c - 1].push(sum / 100); }
      values[c - 1].push(null);
    }
  }
  return { frames, values };
}
function band(after, axis, radius) {
  const x = [], y = [];
  let from = 0;
  for (let i = 0; i < after.frames.length; i++) {
    if (after.frames[i] !== null) continue;
    const run = Array.from({ length: i - from }, (_, k) => from + k);
    for (const k of run) { x.push(after.frames[k]); y.push(after.values[axis][k] + after.values[radius][k]); }
    for (const k of run.reverse()) { x.push(after.frames[k]); y.push(after.values[axis][k] - after.values[radius][k]); }
    x.push(null); y.push(null);
    from = i + 1;
  }
  return { x, y };
}
function roundStep(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= length);
}
function ticks(low, high, finding, wanted) {
  const step = Math.max(1, roundStep((high - low) / wanted));
  const at = [];
  for (let frame = Math.ceil(low / step) * step; frame <= high; frame += step) at.push(frame);
  const text = at.map((frame) => frame + "<br>" + ((frame - finding.origin) / finding.rate).toFixed(2) + " s");
  return { tickvals: at, ticktext: text };
}
function traces(finding) {
  const before = unpack(finding.before, finding), after = unpack(finding.after, finding);
  const partner = finding.partner ? unpack(finding.partner, finding) : null;
  const list = [];
  const add = (axis, name, shown, more) => list.push({
    type: "scatter", mode: "lines", name, legendgroup: name, showlegend: shown && axis === 0, xaxis: "x",
    yaxis: "y" + (axis ? axis + 1 : ""), ...more,
  });
  const hover = (name, axis) => ({ hovertemplate: "xyz"[axis] + " %{y:.2f} mm<extra>" + name + "</extra>" });
  for (let axis = 0; axis < 3; axis++) {
    if (finding.after.length) {
      for (const [radius, alpha, name] of [[4, 0.16, "expected error, 95 %"], [3, 0.3, "expected error, 68 %"]]) {
        add(axis, name, true, { ...band(after, axis, radius), fill: "toself", hoverinfo: "skip", line: { width: 0 },
          fillcolor: "rgba(" + colour("band") + "," + alpha + ")" });
      }
    }
    if (partner) add(axis, "partner of the swap or unlabelled, original", true, { x: partner.frames, y: partner.values[axis],
      line: { color: colour("partner"), width: 1.5, dash: "dot" }, ...hover("partner of the swap or unlabelled, original", axis) });
    add(axis, "original", true, { x: before.frames, y: before.values[axis], mode: before.frames.length < 400 ? "lines+markers" : "lines",
      line: { color: colour("original"), width: 1.4 }, marker: { size: 3 }, ...hover("original", axis) });
    if (finding.after.length) add(axis, "repaired or filled", true, { x: after.frames, y: after.values[axis],
      line: { color: colour("result"), width: 2.4 }, ...hover("repaired or filled", axis) });
  }
  if (finding.after.length) differences(before, after, add);
  return list;
}
// The measured minus the cleaned trajectory, and the expected error.
function differences(before, after, add) {
  const measured = new Map(before.frames.map((frame, i) => [frame, i]));
  const flat = { frames: after.frames, values: [after.frames.map((frame) => (frame === null ? null : 0)), ...after.values.slice(3)] };
  for (const [radius, alpha] of [[2, 0.16], [1, 0.3]]) {
    add(3, "expected error", false, { ...band(flat, 0, radius), fill: "toself", hoverinfo: "skip", line: { width: 0 },
      fillcolor: "rgba(" + colour("band") + "," + alpha + ")" });
  }
  for (let axis = 0; axis < 3; axis++) {
    const y = after.frames.map((frame, i) => {
      if (frame === null || !measured.has(frame)) return null;
      return before.values[axis][measured.get(frame)] - after.values[axis][i];
    });
    const name = "change in " + "xyz"[axis];
    add(3, name, true, { x: after.frames, y, showlegend: y.some((value) => value), line: { color: colour("xyz"[axis]), width: 1.6 },
      hovertemplate: "measured " + "xyz"[axis] + " differed by %{y:+.2f} mm<extra></extra>" });
  }
}
function layout(finding, width) {
  const low = finding.first, high = finding.first + (finding.frames - 1) * finding.step;
  const grid = { gridcolor: colour("line"), zeroline: false, exponentformat: "none", nticks: 5 };
  const half = 0.5 * finding.step;
  const changed = finding.after.length > 0;
  const top = changed ? [[0.77, 1], [0.515, 0.745], [0.26, 0.49]] : [[0.69, 1], [0.345, 0.655], [0, 0.31]];
  return {
    margin: { l: 74, r: 14, t: 62, b: 62 }, height: 610, hovermode: "x", paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: getComputedStyle(document.body).fontFamily, size: 12, color: colour("ink") },
    legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom" },
    xaxis: { anchor: changed ? "y4" : "y3", range: [low - half, high + half], gridcolor: colour("line"), zeroline: false,
      title: { text: "frame (capture program's number) and time", standoff: 8 }, ...ticks(low, high, finding, width / 90) },
    yaxis: { domain: top[0], title: { text: "x (mm)" }, ...grid },
    yaxis2: { domain: top[1], title: { text: "y (mm)" }, ...grid },
    yaxis3: { domain: top[2], title: { text: "z (mm)" }, ...grid },
    ...(changed ? { yaxis4: { domain: [0, 0.2], title: { text: "change (mm)" }, ...grid, zeroline: true, zerolinecolor: colour("soft") } } : {}),
    modebar: { bgcolor: "rgba(0,0,0,0)", color: colour("soft"), activecolor: colour("ink") },
    shapes: [{ type: "rect", xref: "x", yref: "paper", x0: finding.span[0] - 0.5, x1: finding.span[1] - 0.5, y0: 0, y1: 1,
      layer: "below", fillcolor: "rgba(" + colour("span") + ",0.17)", line: { width: 1, color: "rgba(" + colour("span") + ",0.8)" } }],
  };
}
const drawn = new Map();
function draw(place, finding) {
  drawn.set(place, finding);
  Plotly.newPlot(place, traces(finding), layout(finding, place.clientWidth), { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["select2d", "lasso2d"] });
  place.on("plotly_relayout", (change) => {
    if ("xaxis.tickvals" in change) return;
    const [low, high] = place.layout.xaxis.range;
    const fresh = ticks(low, high, finding, place.clientWidth / 90);
    Plotly.relayout(place, { "xaxis.tickvals": fresh.tickvals, "xaxis.ticktext": fresh.ticktext });
  });
}
function undraw(place) {
  drawn.delete(place);
  Plotly.purge(place);
}
// After the colours of the page changed, or its width for paper.
function redraw() {
  const printing = document.documentElement.classList.contains("printing");
  for (const [place, finding] of drawn) {
    Plotly.react(place, traces(finding), { ...layout(finding, place.clientWidth), ...(printing ? { width: place.clientWidth } : { autosize: true }) });
  }
}
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
