// The plotting script is loaded by this one, which the policy of the page allows.
let library = null;
function loadLibrary(path, missing) {
  library ??= new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = path;
    script.onload = resolve;
    script.onerror = () => reject(new Error(missing));
    document.head.append(script);
  });
  return library;
}
