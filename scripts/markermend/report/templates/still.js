// A still picture of a pose, for paper and for browsers that draw nothing in 3-D: as the stick figure at first, seen from far away.
const EYES = { x: [0.4, 1.4, 1.2], y: [1.2, 0.4, 1.4], z: [1.4, 1.2, 0.4] };
function cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
function unit(a) { return a.map((value) => value / Math.hypot(...a)); }
function projection(up) {
  const eye = unit(EYES[up]), right = unit(cross(["x", "y", "z"].map((name) => Number(name === up)), eye)), top = cross(eye, right);
  return (point) => [dot(right, point), -dot(top, point)];
}
function drawing(name, properties, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(properties)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}
function pathOf(places) {
  let pen = false;
  const steps = places.map((place) => { const step = place && (pen ? "L" : "M") + place.map((value) => value.toFixed(1)).join(" "); pen = Boolean(place); return step ?? ""; });
  return steps.join("");
}
function stillPicture(at, marker, span) {
  const data = poses(), project = projection(data.up), seen = (place) => (place ? project(place) : null);
  const states = [["original", data.before.map((places) => seen(places[at]))], ["result", data.after.map((places) => seen(places[at]))]];
  const all = states.flatMap(([, places]) => places).filter(Boolean);
  if (!all.length) return "";
  const [left, top] = [0, 1].map((axis) => Math.min(...all.map((place) => place[axis]))), [right, bottom] = [0, 1].map((axis) => Math.max(...all.map((place) => place[axis])));
  const size = Math.max(right - left, bottom - top, 100), border = 0.06 * size, dots = 0.008 * size;
  const dot2d = ([x, y], r, name) => drawing("circle", { cx: x, cy: y, r, class: name });
  const parts = states.flatMap(([name, places]) => [
    drawing("path", { class: name, d: data.edges.map(([a, b]) => (places[a] && places[b] ? pathOf([places[a], places[b]]) : "")).join("") }),
    ...places.filter(Boolean).map((place) => dot2d(place, dots, "dot " + name)),
  ]);
  for (const [own, name] of marker < 0 ? [] : [[data.before, "flag"], [data.after, "result"]]) {
    parts.push(drawing("path", { class: name + " course", d: pathOf(span.map((i) => seen(own[marker][i]))) }));
    if (own[marker][at]) parts.push(dot2d(seen(own[marker][at]), 2.2 * dots, name === "flag" ? "ring" : "dot result"));
  }
  const box = [left - border - Math.max(0, bottom - top - right + left) / 4, top - border, right - left + 2 * border + Math.max(0, bottom - top - right + left) / 2, bottom - top + 2 * border];
  const text = "Frame " + data.numbers[at] + ", original grey and result blue" + (marker < 0 ? "" : "; " + data.markers[marker] + " is ringed where it was measured");
  const picture = drawing("svg", { viewBox: box.map((value) => value.toFixed(1)).join(" "), role: "img", "aria-label": text }, ...parts);
  return element("figure", { className: "still" }, picture, element("figcaption", { textContent: text + "." }));
}
