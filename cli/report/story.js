// SPDX-License-Identifier: BSD-3-Clause
// What went wrong and where, in words.

const kWarnings = 5;  // in full
const kWithoutManhattan = { features: "The preset features uses no Manhattan frame" };
const kJitter = 1.25;  // times as long as its truth is a path that is mentioned

// What helps while there is no map, by the reason.
const kAdvice = {
  "low parallax": "Begin with a slow movement to the side.",
  "too few features": "Point the camera at edges and corners, and avoid blur and darkness.",
  "too few matches": "Move more slowly, and use every frame.",
  "no consensus": "Check the calibration of the camera.",
};

// [reason, number of frames]: the most frequent first.
function countedReasons(span) {
  const counts = new Map();
  for (let row = span.from; row <= span.to; ++row) {
    const reason = run.reason(row);
    if (reason) counts.set(reason, (counts.get(reason) ?? 0) + 1);
  }
  return [...counts].sort((a, b) => b[1] - a[1]);
}

// A sentence to come after others, or nothing.
function adviceFor(span) {
  const advice = kAdvice[countedReasons(span)[0]?.[0]];
  return advice ? ` ${advice}` : "";
}

// "too few matches with the map (10 frames), ..."
function reasonsIn(span) {
  const sorted = countedReasons(span);
  const words = (reason) => kReasonWords[reason] ?? reason;
  if (sorted.length === 1) return words(sorted[0][0]);
  return sorted.map(([reason, count]) => `${words(reason)} (${countOf(count, "frame")})`).join(", ");
}

function whereOf(span) {
  if (span.from === span.to) return `frame ${run.frames.text("index", span.from)}, at ${clock(span.from)}`;
  return `frames ${run.frames.text("index", span.from)} to ${run.frames.text("index", span.to)}, ` +
    `${clock(span.from)} to ${clock(span.to)}`;
}

function because(span) {
  const reasons = reasonsIn(span);
  return reasons ? `: ${reasons}` : "";
}

function spanStory(span, first) {
  const length = span.to - span.from + 1;
  const next = span.to + 1 < run.frames.count ? run.state(span.to + 1) : "";
  if (span.key === "lost") {
    let after = `; not found again ${run.kind === "live" ? "yet" : "before the end"}. Return to a view that the map shows`;
    if (next === "initialising") after = "; a new map was begun";
    else if (next) after = `; found again at frame ${run.frames.text("index", span.to + 1)}`;
    return { state: "lost", text: `Lost for ${countOf(length, "frame")} (${whereOf(span)})${because(span)}${after}.`, row: span.from, length };
  }
  if (span.key === "uncertain") {
    return {
      state: "uncertain", row: span.from, length,
      text: `The pose of ${countOf(length, "frame")} (${whereOf(span)}) is uncertain${because(span)}. The map was not built on ${length === 1 ? "it" : "them"}.`,
    };
  }
  if (span.key === "fallback") {
    return {
      state: "fallback", row: span.from, length,
      text: `${countOf(length, "frame")} without the Manhattan rotation (${whereOf(span)})${because(span)}. Points and lines alone gave all six degrees of freedom.`,
    };
  }
  const late = length > 30 || length > 0.1 * run.frames.count;
  const what = next ? `The ${first ? "first" : "next"} map was made after ${countOf(length, "frame")}` : `There was no map yet after ${countOf(length, "frame")}`;
  return { state: late ? "lost" : "initialising", text: `${what} (${whereOf(span)})${because(span)}.${late ? adviceFor(span) : ""}`, row: span.from, length };
}

// The longest in full, then a count.
function longest(items, atMost, noun) {
  if (items.length <= atMost) return items;
  const kept = [...items].sort((a, b) => b.length - a.length).slice(0, atMost);
  const rest = items.filter((item) => !kept.includes(item));
  const frames = rest.reduce((sum, item) => sum + item.length, 0);
  return [...kept.sort((a, b) => a.row - b.row),
    { state: items[0].state, text: `And ${countOf(rest.length, "shorter span")} ${noun}, ${countOf(frames, "frame")} in all.` }];
}

function greatest(values) {
  let best = -1;
  for (let row = 0; row < values.length; ++row)
    if (!Number.isNaN(values[row]) && (best < 0 || values[row] > values[best])) best = row;
  return best;
}

function tellStory() {
  const items = [];
  const { metrics, frames } = run;
  const nothing = metrics.tracked === 0 && run.kind !== "live";
  for (const problem of run.problems) items.push({ state: "lost", text: problem });
  if (frames.count > 0 && nothing) {
    const all = { from: 0, to: frames.count - 1 };
    items.push({ state: "lost", text: `No frame was tracked${because(all)}.${adviceFor(all)}` });
  }
  if (frames.count === 0 && run.kind === "run") items.push({ state: "lost", text: "frames.csv holds no frame: nothing is shown over time." });
  if (metrics.interrupted) items.push({ state: "lost", text: `The run was interrupted after ${countOf(frames.count, "frame")}.` });
  if (frames.has("state")) {
    // A frame that is found again says so where the loss is told.
    const noted = (row) => ["lost", "uncertain", "fallback", "initialising"].includes(run.look(row)) && run.reason(row) !== "relocalised";
    const spans = spansOf(frames.count, (row) => (noted(row) ? run.look(row) : null));
    const told = (key) => spans.filter((s) => s.key === key).map((s) => spanStory(s, s.from === 0));
    items.push(...(nothing ? [] : told("initialising")), ...longest(told("lost"), 12, "without a pose"), ...longest(told("uncertain"), 4, "of the same"));
    if (run.manhattanSeen) items.push(...longest(told("fallback"), 4, "of the same"));
    else if (spans.some((span) => span.key === "fallback")) items.push({ state: "none", text: `${kWithoutManhattan[run.settings.preset] ?? "No Manhattan frame was found"}: points and lines gave all six degrees of freedom.` });
  }
  const marked = (column) => frames.has(column) ? Array.from({ length: frames.count }, (_, row) => row).filter((row) => frames.number(column, row) === 1) : [];
  for (const row of marked("loop_closed"))
    items.push({ state: "manhattan", row, length: 1, text: `A loop was closed: a known place was recognised (${whereOf({ from: row, to: row })}).` });
  for (const row of marked("maps_joined"))
    items.push({ state: "manhattan", row, length: 1, text: `Two maps were joined: a place of an earlier map was recognised (${whereOf({ from: row, to: row })}).` });
  if (metrics.maps_apart > 0)
    items.push({ state: "lost", text: `${countOf(metrics.maps_apart, "other map")}, with ${countOf(metrics.frames_apart, "frame")}, could not be joined with this one: no place was recognised in both. Those frames have no pose in the trajectory. Film the way between them again, and look around in a part that both show.` });
  const asked = metrics.normals_asked;
  if (run.settings?.normals?.startsWith("on-demand") && asked && !nothing) {
    const why = Object.entries(asked.reasons).map(([reason, count]) => `${reason} (${count})`).join(", ");
    items.push({ state: "manhattan", text: asked.frames > 0 ? `Surface normals were computed for ${countOf(asked.frames, "frame")}: ${why}. Lines gave the rotation in the others.` : "Lines gave the rotation in every frame: no surface normals were computed." });
  }
  const unseen = metrics.frames_without_normal_evidence;
  if (unseen > 0) items.push({ state: "fallback", text: `In ${countOf(unseen, "frame")} the normals showed no Manhattan axis: too few planes were in view. Lines alone gave the axes there.` });
  const worst = run.errors ? greatest(run.errors.position_m) : -1;
  if (worst >= 0) items.push({ state: "manhattan", text: `The largest position error is ${figure(run.errors.position_m[worst])} m (${whereOf({ from: worst, to: worst })}).`, row: worst });
  const { path_m: truly, estimate_path_m: estimated, notes } = metrics.trajectory ?? {};
  if (estimated > kJitter * truly)
    items.push({ state: "fallback", text: `The estimated path is ${figure(estimated)} m long, the true one ${figure(truly)} m: the estimate jitters from frame to frame.` });
  for (const note of Array.isArray(notes) ? notes : []) items.push({ state: "fallback", text: String(note) });
  const slowest = frames.has("frame_ms") ? greatest(frames.all("frame_ms")) : -1;
  if (slowest >= 0) items.push({ state: "manhattan", text: `The slowest frame took ${figure(frames.number("frame_ms", slowest))} ms (${whereOf({ from: slowest, to: slowest })}).`, row: slowest });
  if (run.textureLeft?.quality > 0) {
    const size = run.textureLeft.share < 1 ? `has ${Math.round(100 * run.textureLeft.share)} % of the width and height that it has in model.glb` : "is compressed more than in model.glb";
    items.push({ state: "none", text: `The texture of the surfaces ${size}, so that this page stays small.` });
  }
  const warnings = metrics.warnings ?? [];
  for (const warning of warnings.slice(0, kWarnings)) items.push({ state: "fallback", text: String(warning) });
  if (warnings.length > kWarnings) items.push({ state: "fallback", text: `And ${countOf(warnings.length - kWarnings, "more warning")}, in metrics.json.` });
  return items;
}

function headline() {
  const rows = (state) => Array.from({ length: run.frames.count }, (_, row) => run.look(row)).filter((s) => s === state).length;
  const lost = rows("lost"), uncertain = rows("uncertain"), fallback = rows("fallback");
  if (run.kind === "live") return `The run goes on: ${run.total > 0 ? `${run.frames.count} of ${countOf(run.total, "frame")}` : countOf(run.frames.count, "frame")} so far.`;
  if (run.frames.count === 0) return "";
  if (run.metrics.tracked === 0) return "No frame was tracked. The list below says why.";
  const parts = [lost === 0 ? "Never lost" : `Lost in ${countOf(lost, "frame")}`];
  if (uncertain > 0) parts.push(`${countOf(uncertain, "frame")} with an uncertain pose`);
  if (!run.manhattanSeen) parts.push("no Manhattan frame: points and lines gave all six degrees of freedom");
  else parts.push(fallback === 0 ? `the Manhattan rotation is in the pose of every ${uncertain > 0 ? "other " : ""}frame with a map` : `${countOf(fallback, "frame")} without the Manhattan rotation`);
  return `${parts.join("; ")}.`;
}

// The frame, and the part of the page that shows it.
function showAt(row) {
  shown.set(row);
  document.querySelector(".stage-row").scrollIntoView({ block: "nearest" });
}

function showStory() {
  byId("headline").textContent = headline();
  for (const item of tellStory()) {
    const line = element("li", {}, element("i", { style: `background: var(--${item.state})` }), element("span", {}, item.text));
    if (item.row !== undefined && run.frames.count > 0)
      line.append(element("button", { type: "button", onclick: () => showAt(item.row) }, "Show"));
    byId("story").append(line);
  }
}
