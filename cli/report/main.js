// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together: title, view, layers, timeline, keys, theme.

const run = makeRun(JSON.parse(document.getElementById("data").textContent));

const kKinds = { run: "run report", live: "run in progress", map: "map" };

function showTitle() {
  const dataset = String(run.settings.dataset ?? run.folder);
  const name = dataset.split("/").filter(Boolean).pop() ?? dataset;
  byId("title").textContent = name;
  document.title = `${name} · sslam ${kKinds[run.kind]}`;
  byId("kind").textContent = kKinds[run.kind];
  const parts = [run.settings.preset && `preset ${run.settings.preset}`, run.settings.normals && `normals ${run.settings.normals}`,
    run.settings.seed !== undefined && `seed ${run.settings.seed}`, run.folder !== name && `in ${run.folder}`, run.program];
  byId("subtitle").textContent = parts.filter(Boolean).join(" · ");
}

// The 3D view where the browser can, else the map from above.
function makeView() {
  const canvas = byId("canvas");
  const nothing = run.points.length + run.lines.axes.length === 0 && !run.trajectoryThere && !run.surfaces;
  if (nothing && run.kind === "map") notice("This map is empty.");
  if (nothing && run.kind === "run") {
    canvas.closest(".stage").hidden = true;
    canvas.closest(".stage-row").classList.add("pictures-alone");
  }
  const webgl = webglContext(canvas);
  if (webgl) return new Scene3D(canvas, webgl);
  byId("view").classList.add("flat");
  canvas.setAttribute("aria-label", "Map from above");
  notice(typeof THREE === "undefined"
    ? "This sslam was built without npm, so without the 3D view: the map is seen from above."
    : "This browser has no WebGL: the map is seen from above.");
  return new TopView(canvas);
}

function notice(text) {
  byId("notice").hidden = false;
  byId("notice").append(element("div", {}, text));
}

function showLayers(view) {
  const buttons = kLayers.map((layer) => {
    const button = toggleButton(layer.label, (on) => view.setLayer(layer.name, on), layer.ink);
    button.dataset.layer = layer.name;
    return button;
  });
  byId("layers").append(...buttons);
  if (!(view instanceof Scene3D)) return;
  const follow = toggleButton("Follow", (on) => view.viewpoint.setFollow(on));
  follow.id = "follow";
  follow.classList.add("mode");
  follow.setAttribute("aria-pressed", "false");
  byId("tools").append(follow, element("button", { type: "button", id: "reset", onclick: () => view.viewpoint.reset() }, "Reset"));
}

// A list of words to choose from, with what each does.
function chooser(label, words, choose) {
  const select = element("select", { "aria-label": label, title: label, onchange: () => choose(select.value) },
    ...words.map(([value, text]) => element("option", { value }, text)));
  return select;
}

// What can be done with the view.
function showTools(view) {
  const button = (label, title, onclick) => element("button", { type: "button", title, onclick }, label);
  const tools = byId("tools");
  if (view instanceof Scene3D) {
    const size = element("input", { type: "range", id: "point-size", min: 1, max: 10, step: 0.5, value: kPointSize, title: "Size of the points", oninput: () => view.setPointSize(Number(size.value)) });
    tools.append(element("label", {}, "Size ", size));
    if (run.coloured || run.kind === "live") tools.append(chooser("Colour of points and lines", [["seen", "Colours as seen"], ["axes", "Colours by axis"]], (value) => view.setSeenColours(value === "seen")));
    if (run.frames.count > 0 || run.kind === "live") {
      const words = [["state", "Path by state"], ...(run.errors ? [["error", "Path by error"]] : []), ["time", "Path by time"]];
      tools.append(chooser("Colour of the path", words, (value) => view.setPathColours(value)));
    }
    window.picker = new Picker(view);
    const measure = toggleButton("Measure", (on) => picker.setMeasures(on));
    measure.id = "measure";
    measure.classList.add("mode");
    measure.setAttribute("aria-pressed", "false");
    tools.append(measure);
  }
  tools.append(button("PNG", "Save this picture as PNG", () => savePicture(view)));
  if (run.frames.count > 0) tools.append(button("CSV", "Save the frames with their poses and errors as CSV", saveCsv), button("Link", "Put the shown frame into this page's address, and copy that", linkToFrame));
  if (document.fullscreenEnabled)
    tools.append(button("Full screen", "Full screen, or back", () => (document.fullscreenElement ? document.exitFullscreen() : document.querySelector(".stage").requestFullscreen())));
}

function showFrameText(row) {
  const { frames } = run;
  if (frames.count === 0) return;
  const [index, image, state, reason] = ["index", "image", "state", "reason"].map((name) => frames.text(name, row));
  byId("frame-name").textContent = `${index} · ${image}`;
  const words = (kStateWords[run.look(row)] ?? state) + (reason && !(reason === "no Manhattan evidence" && !run.manhattanSeen) ? `: ${kReasonWords[reason] ?? reason}` : "");
  byId("frame-state").replaceChildren(element("span", { className: "swatch", style: `color: var(--${run.look(row)})` }),
    [words, frames.number("keyframe", row) ? "keyframe" : ""].filter(Boolean).join(" · "));
  byId("clock").replaceChildren(clock(row), element("span", { className: "long" }, ` · ${row + 1} of ${frames.count}`));
  byId("slider").value = row;
  byId("slider").setAttribute("aria-valuetext", `frame ${index}, ${state}`);
}

// Plays in real time, by the stamps.
const player = {
  on: false,
  toggle() {
    this.on = !this.on && run.frames.count > 1;
    byId("play").textContent = this.on ? "\u23f8" : "\u25b6";
    byId("play").setAttribute("aria-label", this.on ? "Pause" : "Play");
    if (!this.on) return;
    if (shown.row === run.frames.count - 1) shown.set(0);
    this.offset = performance.now() / 1000 - run.seconds(shown.row);
    requestAnimationFrame(() => this.step());
  },
  step() {
    if (!this.on) return;
    const now = performance.now() / 1000 - this.offset;
    let row = shown.row;
    while (row < run.frames.count - 1 && run.seconds(row + 1) <= now) ++row;
    if (row !== shown.row) shown.set(row);
    if (row === run.frames.count - 1) this.toggle();
    else requestAnimationFrame(() => this.step());
  },
};

const kKeys = [
  { keys: [" "], name: "Space", does: "play or pause", act: () => player.toggle() },
  { keys: ["ArrowRight"], name: "Right, left", does: "a frame on or back; ten with Shift", act: (event) => shown.set(shown.row + (event.shiftKey ? 10 : 1)) },
  { keys: ["ArrowLeft"], act: (event) => shown.set(shown.row - (event.shiftKey ? 10 : 1)) },
  { keys: ["Home"], name: "Home, End", does: "first or last frame", act: () => shown.set(0) },
  { keys: ["End"], act: () => shown.set(run.frames.count - 1) },
  { keys: ["f", "F"], name: "F", does: "follow the camera", act: () => byId("follow")?.click() },
  { keys: ["r", "R"], name: "R", does: "reset the view", act: () => byId("reset")?.click() },
  { keys: ["t", "T"], name: "T", does: "light or dark", act: () => byId("theme").click() },
  { keys: ["Escape"], name: "Escape", does: "close what a click has told", act: () => window.picker?.clear() },
  { keys: ["1", "2", "3", "4", "5", "6", "7", "8"], name: "1 to 8", does: "show or hide a layer", act: (event) => document.querySelectorAll("#layers [data-layer]:not([hidden])")[Number(event.key) - 1]?.click() },
];

function listenToKeys() {
  list("keys", [...kKeys.filter((key) => key.name).map((key) => [key.name, key.does]), ["in the 3D view: arrows, + and -", "orbit and zoom"],
    ["mouse: left, right, wheel", "orbit, move, zoom"], ["a click in the 3D view", "tells what lies there"]]);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.("summary, a, select, #point-size")) return;
    if (event.key === " " && event.target.closest?.("button")) return;
    const key = kKeys.find((entry) => entry.keys.includes(event.key));
    if (!key) return;
    event.preventDefault();
    key.act(event);
  });
}

// A part of the page that fails, for figures that are of another kind than expected, leaves the others alone.
function part(name, make) {
  try {
    make();
  } catch (error) {
    const text = `The ${name} cannot be shown: ${error.message}.`;
    byId("story").append(element("li", {}, element("i", { style: "background: var(--lost)" }), element("span", {}, text)));
  }
}

// What changes while a run goes on.
function showFigures() {
  for (const id of ["summary", "story", "timings"]) byId(id).replaceChildren();
  part("summary", showSummary);
  part("story", showStory);
  part("curves", showCharts);
  part("times of the stages", showTimings);
}

// Buttons for what is not there, or not yet; folds with nothing in them.
function hideMissing() {
  for (const layer of kLayers) document.querySelector(`#layers [data-layer=${layer.name}]`).hidden = !layer.there();
  if (byId("follow")) byId("follow").hidden = !run.trajectoryThere;
  document.querySelectorAll("details").forEach((details) => { details.hidden = details.querySelector("pre, div").textContent === ""; });
}

// The stage reaches down to the time bar, which covers nothing of it.
function fitStage() {
  const above = document.querySelector(".stage-row").getBoundingClientRect().top + scrollY;
  document.documentElement.style.setProperty("--around", `${Math.ceil(above + document.querySelector(".timeline").offsetHeight + 12)}px`);
}

function main() {
  document.documentElement.dataset.kind = run.kind;
  redraws.push(fitStage);
  startTheme();
  showFigures();
  part("title", showTitle);
  part("settings", showSettings);
  byId("slider").max = Math.max(run.frames.count - 1, 0);
  byId("slider").addEventListener("input", (event) => shown.set(Number(event.target.value)));
  byId("play").addEventListener("click", () => player.toggle());
  shown.listen(showFrameText);
  redraws.push(() => drawStates(byId("strip"), run));
  const view = makeView();
  showLayers(view);
  showTools(view);
  listenToKeys();
  hideMissing();
  window.addEventListener("resize", redrawAll);
  document.addEventListener("DOMContentLoaded", () => {
    part("pictures", () => {
      window.views = new Views();
      if (view instanceof Scene3D) view.renew();
      hideMissing();
    });
    redrawAll();
    document.documentElement.dataset.ready = "yes";
    if (run.kind === "live") followRun();
  });
  shown.set(run.kind === "live" ? run.frames.count - 1 : firstRow());
  window.addEventListener("hashchange", () => { if (rowOfAddress() >= 0) shown.set(rowOfAddress()); });
  redrawAll();
  window.view3d = view;
}

main();
