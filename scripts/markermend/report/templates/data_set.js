// What all pages share: the recordings in order, and the decisions of the last run (report/data_set.js).
const results = new URL(document.body.dataset.results, location.href).href;
const NO_DATA_SET = "report/data_set.js is missing: finish the run, or keep the report folder next to the subjects' folders";
async function dataSet() {
  await loadLibrary(results + "report/data_set.js", NO_DATA_SET);
  return markermendDataSet;
}
function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}
function button(text, does, properties = {}) {
  const made = element("button", { type: "button", textContent: text, ...properties });
  made.addEventListener("click", does);
  return made;
}
