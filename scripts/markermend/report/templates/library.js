// Scripts beside the page are loaded by this one, which the policy of the page allows.
const loaded = new Map();
function loadLibrary(path, missing) {
  if (!loaded.has(path)) {
    loaded.set(path, new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.src = path;
      script.onload = resolve;
      script.onerror = () => reject(new Error(missing));
      document.head.append(script);
    }));
  }
  return loaded.get(path);
}
