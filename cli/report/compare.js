// SPDX-License-Identifier: BSD-3-Clause
// Several runs on one page: figures, paths, curves, states, and what is set differently. comparison.cpp is its other end.

const kInks = 8;  // of runs, in style.css
const kNone = "–";  // where a run lacks a setting

// As runs of data.js, and what comparison.cpp has added. Seconds count from the first frame of all runs.
function runsOf(list) {
  const runs = list.map((raw, i) => ({ ...makeRun(raw), ink: `run${i % kInks}`, beyondInks: i >= kInks }));
  const first = Math.min(...runs.filter((one) => one.frames.count > 0).map((one) => one.frames.all("stamp")[0]));
  for (const one of runs) {
    const stamps = one.frames.all("stamp"), perStamp = Number(one.settings.seconds_per_stamp) || 1;
    one.times = Array.from(stamps, (stamp) => (stamp - first) * perStamp);
    one.timeOf = (stamp) => (stamp - first) * perStamp;
  }
  return runs;
}

const { runs: listedRuns, ...rest } = JSON.parse(document.getElementById("data").textContent);
const comparison = unpack(rest), runs = runsOf(listedRuns);
const kEnd = Math.max(0, ...runs.flatMap((one) => one.times.slice(-1)));

// The shown moment, in seconds.
const moment = {
  seconds: kEnd / 2,
  listeners: [],
  set(seconds) {
    this.seconds = Math.min(Math.max(seconds, 0), kEnd);
    for (const listen of this.listeners) listen();
  },
  listen(listener) { this.listeners.push(listener); },
};

// That of the increasing times which is nearest to the shown moment; null where it is more than a second away.
function indexAt(times) {
  if (times.length === 0) return null;
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= moment.seconds) low = middle;
    else high = middle;
  }
  const best = Math.abs(times[low] - moment.seconds) <= Math.abs(times[high] - moment.seconds) ? low : high;
  return Math.abs(times[best] - moment.seconds) <= 1 ? best : null;
}

class TimeChart extends Plot {
  constructor(title, series, options) {
    super(title, series, options);
    moment.listen(() => this.markShown());
  }
  share({ times }, i) { return this.shareOfTime(times[i]); }
  shareOfTime(seconds) { return kEnd > 0 ? seconds / kEnd : 0; }
  duration() { return kEnd; }
  pointed(share) { moment.set(share * kEnd); }
  drawBehind() {}
  markShown() {
    this.mark(this.shareOfTime(moment.seconds), this.series.map((s) => {
      const at = indexAt(s.times);
      return at === null ? NaN : s.values()[at];
    }));
  }
}

// Columns of the table: a figure of each run, and which is the better end (1: much, -1: little, 0: neither).
function columnsOfFigures() {
  const { unit } = comparison;
  const of = (key, what) => (one) => one.figures?.[key]?.[what];
  const errors = comparison.reference === "truth"
    ? [[`ATE, ${unit}`, of("position", "rmse"), -1], [`largest, ${unit}`, of("position", "max"), -1], ["rotation, °", of("rotation", "rmse"), -1]]
    : [[`apart, ${unit}`, of("position", "rmse"), 0], [`largest, ${unit}`, of("position", "max"), 0], ["rotation, °", of("rotation", "rmse"), 0]];
  return [
    ["tracked, %", (one) => 100 * one.metrics.share_tracked, 1],
    ["live, %", (one) => 100 * one.metrics.tracked_live / one.metrics.frames, 1],
    ...errors,
    ["frames/s", (one) => one.metrics.times?.frames_per_second, 1],
    ["processor, s", (one) => one.metrics.times?.processor_seconds, -1],
    ["keyframes", (one) => one.metrics.keyframes, 0],
    ["points", (one) => one.metrics.points, 0],
    ["lines", (one) => one.metrics.lines, 0],
  ];
}

function showRuns() {
  const columns = columnsOfFigures().filter(([, value]) => runs.some((one) => Number.isFinite(value(one))));
  const head = element("tr", {}, element("th", {}, "run"), ...columns.map(([name]) => element("th", { className: "number" }, name)));
  const best = columns.map(([, value, good]) => {
    const there = runs.map(value).filter(Number.isFinite);
    return good === 0 || new Set(there).size < 2 ? NaN : good > 0 ? Math.max(...there) : Math.min(...there);
  });
  const rows = runs.map((one) => {
    const href = one.link && one.link.split("/").map(encodeURIComponent).join("/");
    const name = href ? element("a", { href }, nameOf(one.label)) : nameOf(one.label);
    const cells = columns.map(([, value], c) => element("td", { className: value(one) === best[c] ? "number best" : "number" }, figure(value(one))));
    return element("tr", {}, element("td", { className: "name" }, swatchOf(one.ink), name), ...cells);
  });
  byId("runs").append(element("table", {}, head, ...rows));
}

// What has to be known beside the figures.
function showNotes() {
  const note = (text, ink = "fallback") => byId("notes").append(element("li", {}, element("i", { style: `background: var(--${ink})` }), element("span", {}, text)));
  for (const one of runs) {
    if (one.note) note(`${one.label}: ${one.note}`, "lost");
    for (const problem of one.problems) note(`${one.label}: ${problem}`, "lost");
  }
  if (runs.some((one) => one.beyondInks)) note(`More than ${kInks} runs: colours come again.`, "none");
}

function showPaths() {
  const paths = [];
  if (comparison.truth) {
    const times = Array.from(comparison.truth.stamps, (stamp) => runs[0].timeOf(stamp));
    paths.push({ label: "Ground truth", ink: "truth", dashed: true, positions: comparison.truth.positions, at: () => indexAt(times) });
  }
  for (const one of runs)
    if (one.path) paths.push({ label: one.label, ink: one.ink, positions: one.path, at: () => indexAt(one.times) });
  const view = new PathView(byId("canvas"), paths, comparison.up, comparison.unit);
  if (!view.there) return byId("canvas").closest("section").remove();
  byId("layers").append(...paths.map((path) => toggleButton(path.label, (on) => view.show(path, on), path.ink)));
  const from = (name, text) => element("button", { type: "button", onclick: () => view.seeFrom(name) }, text);
  byId("tools").append(from("oblique", "Reset"), from("above", "From above"), from("side", "From the side"),
    element("button", { type: "button", title: "Save this picture as PNG", onclick: () => savePaths(view) }, "PNG"),
    element("button", { type: "button", title: "Save the aligned paths and the errors as CSV", onclick: () => offerFile("paths.csv", new Blob([pathsAsCsv()], { type: "text/csv" })) }, "CSV"));
  moment.listen(() => view.draw());
  window.pathView = view;
}

function savePaths(view) { view.canvas.toBlob((blob) => { if (blob) offerFile("paths.png", blob); }, "image/png"); }

// A row for each frame of each run: the place on the aligned path, and the errors where they are known.
function pathsAsCsv() {
  const rows = [["run", "stamp", "x", "y", "z", "position_error", "rotation_error_deg"]];
  for (const one of runs) {
    const stamps = one.frames.all("stamp");
    for (let row = 0; row < one.frames.count; ++row) {
      const place = [0, 1, 2].map((k) => csvNumber(one.path?.[3 * row + k]));
      rows.push([csvText(one.label), stamps[row], ...place, csvNumber(one.errors?.position_m[row]), csvNumber(one.errors?.rotation_deg[row])]);
    }
  }
  return `${rows.map((cells) => cells.join(",")).join("\n")}\n`;
}

function showCurves() {
  const { reference, unit } = comparison;
  const curves = (title, there, values, options) => {
    const series = runs.filter((one) => one.frames.count > 1 && there(one)).map((one) => ({ label: one.label, ink: one.ink, times: one.times, values: () => values(one), unit: options.unit }));
    if (series.length > 0) new TimeChart(title, series, options);
  };
  const [position, rotation] = reference === "truth" ? ["Position error", "Rotation error"] : ["Distance apart", "Rotation apart"];
  curves(position, (one) => one.errors, (one) => one.errors.position_m, { unit });
  curves(rotation, (one) => one.errors, (one) => one.errors.rotation_deg, { unit: "°" });
  curves("Frame time", (one) => one.frames.has("frame_ms"), (one) => one.frames.all("frame_ms"), { unit: "ms" });
  curves("Points seen again", (one) => one.frames.has("point_inliers"), (one) => one.frames.all("point_inliers"), { counts: true });
}

function showStates() {
  byId("states-legend").append(...Object.entries(kStateWords).flatMap(([state, words]) => [" ", element("span", { className: "entry" }, swatchOf(state), words)]));
  for (const one of runs) {
    if (one.frames.count === 0) continue;
    const strip = element("canvas", { "aria-label": `States of ${one.label}` });
    const step = one.frames.count > 1 ? (one.times[one.frames.count - 1] - one.times[0]) / (one.frames.count - 1) : 1;
    const share = (row) => (one.times[row] ?? one.times[one.frames.count - 1] + step) / (kEnd + step);
    byId("states").append(element("span", { className: "name" }, swatchOf(one.ink), nameOf(one.label)), strip);
    redraws.push(() => drawStates(strip, one, share));
  }
}

// Where a preset leaves out a stage, its parameters are one row: [name, text of each run]. lacks(name): in some run.
function foldedRows(names, lacks, texts) {
  const stageOf = (name) => name.slice(0, name.indexOf("."));
  const same = (name) => new Set(texts(name).filter((text) => text !== kNone)).size === 1;
  const folds = (name) => name.includes(".") && lacks(name) && same(name);
  const rows = [];
  for (const name of names) {
    const pattern = texts(name).map((text) => text === kNone).join();
    const before = rows.find((row) => row.stage === stageOf(name) && row.pattern === pattern);
    if (folds(name) && before) before.names.push(name);
    else rows.push({ names: [name], ...(folds(name) ? { stage: stageOf(name), pattern } : {}) });
  }
  return rows.map(({ names: [first, ...more], stage }) => (more.length === 0 ? [first, texts(first)]
    : [`${stage}.*`, texts(first).map((text) => (text === kNone ? kNone : countOf(more.length + 1, "parameter")))]));
}

// Settings and parameters that not all runs have the same.
function showDifferences() {
  const flat = runs.map(({ settings: { parameters, ...settings } }) => ({ ...settings, ...(parameters ?? {}) }));
  const text = (value) => (typeof value === "number" ? String(Number(value.toPrecision(6))) : value === undefined ? kNone : typeof value === "string" ? value : JSON.stringify(value));
  const names = [...new Set(flat.flatMap(Object.keys))].filter((name) => new Set(flat.map((one) => text(one[name]))).size > 1);
  if (names.length === 0) return byId("differences").append(element("p", { className: "quiet" }, "Nothing: all settings and parameters are the same."));
  byId("differences").append(element("table", {}, element("tr", {}, element("th", {}, "setting"), ...runs.map((one) => element("th", {}, swatchOf(one.ink), nameOf(one.label)))),
    ...foldedRows(names, (name) => flat.some((one) => !(name in one)), (name) => flat.map((one) => text(one[name])))
      .map(([name, texts]) => element("tr", {}, element("th", {}, name.replaceAll("_", " ")), ...texts.map((cell) => element("td", { className: "name" }, cell))))));
}

function main() {
  const dataset = String(runs.map((one) => one.settings.dataset).find((name) => typeof name === "string" && name) ?? "");
  byId("title").textContent = dataset.split("/").filter(Boolean).pop() ?? "Runs";
  document.title = `${byId("title").textContent} · sslam comparison`;
  const how = { truth: "paths aligned to the ground truth, each with a scale of its own", run: `paths aligned to ${comparison.reference_label}, each with a scale of its own; there is no ground truth`, none: "no run has a path" }[comparison.reference];
  byId("subtitle").textContent = `${countOf(runs.length, "run")}; ${how} · ${runs[0].program}`;
  startTheme();
  for (const show of [showRuns, showNotes, showPaths, showCurves, showStates, showDifferences]) show();
  document.addEventListener("keydown", (event) => { if ("tT".includes(event.key) && !event.ctrlKey && !event.metaKey && !event.altKey) byId("theme").click(); });
  window.addEventListener("resize", redrawAll);
  redrawAll();
  moment.set(moment.seconds);
  document.documentElement.dataset.ready = "yes";
}

main();
