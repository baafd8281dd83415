// Charts are drawn when they come near the window, or when the page is printed, in the colours of the page.
function themed(layout) {
  const style = getComputedStyle(document.documentElement);
  const own = (name) => style.getPropertyValue(name).trim();
  const axis = { gridcolor: own("--line"), linecolor: own("--line"), zerolinecolor: own("--line"), automargin: true };
  const narrow = window.innerWidth < 600;
  return {
    ...layout,
    xaxis: { ...axis, ...layout.xaxis },
    yaxis: { ...axis, ...layout.yaxis },
    margin: { l: 56, r: 12, t: 8, b: 44 },
    font: { color: own("--ink"), size: narrow ? 11 : 12 },
    legend: { orientation: "h", yanchor: "top", y: -0.24, x: 0 },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
  };
}
function draw(place) {
  if (place.dataset.drawn) return;
  place.dataset.drawn = "yes";
  const figure = figures[Number(place.dataset.figure)];
  Plotly.newPlot(place, figure.data, themed(figure.layout), { displaylogo: false, displayModeBar: false, responsive: true });
}
const figures = JSON.parse(document.getElementById("figures").textContent);
const places = [...document.querySelectorAll(".chart")];
function watch() {
  const near = new IntersectionObserver((entries) => {
    entries.filter((entry) => entry.isIntersecting).forEach((entry) => draw(entry.target));
  }, { rootMargin: "800px" });
  places.forEach((place) => near.observe(place));
  window.addEventListener("beforeprint", () => places.forEach(draw));
}
loadLibrary("../plotly.min.js", "plotly.min.js is missing: keep the folders of the papers together").then(watch, (error) => {
  places.forEach((place) => { place.textContent = error.message; });
});
