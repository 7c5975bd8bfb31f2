// SPDX-License-Identifier: BSD-3-Clause
// Summary figures, times of the stages, settings, parameters, versions.

function tile(value, unit, label, bad = false) {
  byId("summary").append(element("div", { className: bad ? "tile bad" : "tile" },
    element("b", {}, value, ...(unit ? [element("small", {}, ` ${unit}`)] : [])), element("span", {}, label)));
}

function showSummary() {
  const { metrics } = run;
  if (metrics.frames !== undefined) {
    const share = Number(metrics.share_tracked);
    const later = metrics.tracked - metrics.tracked_live;
    tile(`${figure(100 * share)} %`, "", later > 0 ? `of ${metrics.frames} frames: ${metrics.tracked_live} live, ${later} afterwards` : `${metrics.tracked} of ${metrics.frames} frames tracked`, share < 0.9);
  }
  const errors = metrics.trajectory;
  if (errors) {
    tile(figure(errors.ate_m?.rmse), "m", `position error (ATE, rmse) over ${figure(errors.path_m)} m`);
    tile(`${figure(errors.rotation_own_offset_deg?.rmse)}°`, "", "rotation error (rmse), after a constant offset");
  }
  if (metrics.times) tile(figure(metrics.times.frames_per_second), "frames/s", `median ${figure(metrics.times.frame_ms?.median)} ms a frame`);
  if (metrics.keyframes !== undefined) tile(String(metrics.keyframes), "", "keyframes");
  if (metrics.points !== undefined) tile(String(metrics.points), "", `points and ${metrics.lines} lines in the map`);
  if (metrics.dense?.planes?.length > 0) tile(figure(metrics.dense.area * run.scale ** 2), run.unit === "m" ? "m\u00b2" : "square map units", `of ${countOf(metrics.dense.planes.length, "surface")}`);
}

const kSums = ["extraction_ms", "tracking_ms", "frame_ms"];  // of the stages above each of them

function showTimings() {
  const { frames } = run;
  const names = Object.keys(frames.columns).filter((name) => name.endsWith("_ms"));
  if (frames.count === 0 || names.length === 0) return;
  const number = (value) => element("td", { className: "number" }, figure(value));
  const heads = ["median, ms", "95 %", "slowest", "mean"].map((text) => element("th", { className: "number" }, text));
  const table = element("table", {}, element("tr", {}, element("th", {}, "stage"), ...heads, element("th", {})));
  const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const whole = Math.max(mean(frames.all("frame_ms")), 1e-9);
  for (const name of names) {
    const values = frames.all(name);
    const bar = element("div", { style: `width: ${Math.min(100, 100 * mean(values) / whole)}%` });
    table.append(element("tr", { className: kSums.includes(name) ? "sum" : "" }, element("th", {}, name.replace(/_ms$/, "")), number(quantile(values, 0.5)), number(quantile(values, 0.95)),
      number(quantile(values, 1)), number(mean(values)), element("td", { className: "share" }, bar)));
  }
  byId("timings").append(table, element("p", { className: "quiet" },
    "Extraction is points and normals beside lines; tracking is rotation to mapping; a frame is both. Extraction runs ahead of tracking, so frames pass faster than one by one."));
}

function list(target, entries) {
  for (const [name, value] of entries)
    byId(target).append(element("dl", {}, element("dt", {}, name), element("dd", {}, typeof value === "number" ? String(Number(value.toPrecision(6))) : String(value))));
}

function showSettings() {
  const { parameters, ...settings } = run.settings;
  const words = Object.entries(settings).filter(([, value]) => value !== "" && value !== null)
    .map(([name, value]) => [name.replaceAll("_", " "), Array.isArray(value) ? value.map((x) => Number(Number(x).toPrecision(6))).join(", ") : value]);
  const versions = Object.entries(run.metrics.versions ?? {}).map(([name, value]) => [`version of ${name === "compiler" ? "the compiler" : name}`, value]);
  list("settings", [...words, ...versions]);
  list("parameters", Object.entries(parameters ?? {}));
  byId("metrics").textContent = JSON.stringify(run.metrics, null, 2);
}
