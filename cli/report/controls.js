// SPDX-License-Identifier: BSD-3-Clause
// What both pages, of a run and of several, have to click on and to look at.

function swatchOf(ink) { return element("span", { className: "swatch", style: `color: var(--${ink})` }); }

// A name that may be long: what does not fit is cut off at its beginning, since names of runs differ at their end.
function nameOf(text) { return element("span", { className: "label", title: text }, element("bdi", {}, text)); }

function toggleButton(label, set, inkName) {
  const button = element("button", { type: "button", "aria-pressed": "true" });
  if (inkName !== undefined) {
    const swatch = element("span", { className: inkName ? "swatch" : "swatch axes" });
    if (inkName) swatch.style.color = `var(--${inkName})`;
    button.append(swatch);
  }
  button.append(nameOf(label));
  button.addEventListener("click", () => {
    const on = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(on));
    set(on);
  });
  return button;
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  byId("theme").textContent = name === "dark" ? "Light" : "Dark";
  redrawAll();
}

// The theme of the system at first, then the one that the button or T asks for.
function startTheme() {
  setTheme(window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  byId("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
}

// A strip with a colour for the state of each frame; share(row): where in its width a frame begins, by default in the order of the frames.
function drawStates(canvas, of, share = (row) => row / of.frames.count) {
  const cleared = clearedContext(canvas);
  if (!cleared) return;
  const { context, width, height } = cleared;
  for (const span of spansOf(of.frames.count, (row) => of.look(row) || "none")) {
    context.fillStyle = colour(span.key) || colour("none");
    const x = width * share(span.from);
    context.fillRect(x, 0, Math.max(width * share(span.to + 1) - x, 1), height);
  }
}
