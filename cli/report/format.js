// SPDX-License-Identifier: BSD-3-Clause
// Small tools of the pages: elements, numbers in words, the theme's colours, and which frame is shown.

function byId(id) { return document.getElementById(id); }

// element("p", {className: "quiet"}, "text", child, ...): text is text, never markup.
function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("aria-")) made.setAttribute(name, value);
    else made[name] = value;
  }
  made.append(...children);
  return made;
}

// Three significant digits, without an exponent where people do not expect one.
function figure(value) {
  if (value === null || value === undefined || !Number.isFinite(Number(value))) return "–";
  const number = Number(value);
  if (number === 0) return "0";
  const size = Math.abs(number);
  if (size >= 100) return String(Math.round(number));
  if (size < 1e-4) return number.toExponential(1);
  return String(Number(number.toPrecision(3)));
}

function withUnit(value, unit) {
  if (unit === "°") return `${figure(value)}°`;
  return `${figure(value)} ${value === 1 && unit === "map units" ? "map unit" : unit}`;
}

function clock(row) { return `${run.seconds(row).toFixed(2)} s`; }

function countOf(number, noun) { return `${number} ${noun}${number === 1 ? "" : "s"}`; }

function colour(name) { return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim(); }

function quantile(values, share) {
  const sorted = Float64Array.from(values).sort();
  return sorted[Math.round(share * (sorted.length - 1))];
}

function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
function cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }

// The states of frames, in words; style.css has a colour for each.
const kStateWords = {
  manhattan: "Manhattan rotation", fallback: "six degrees of freedom", uncertain: "uncertain pose", lost: "lost", initialising: "no map yet",
};

// What kept a frame from the usual way, in words; frames.csv has the short names.
const kReasonWords = {
  "too few features": "too few features in the image",
  "too few matches": "too few matches",
  "low parallax": "the camera has not moved sideways far enough",
  "no consensus": "the matches do not agree on one motion",
  "no Manhattan evidence": "no Manhattan frame was recognised in the image",
  "Manhattan pose rejected": "the pose with the Manhattan rotation does not fit the map",
  "uncertain pose": "the pose is too uncertain to be used",
  relocalised: "found again in the map",
};

const kAxes = ["x", "y", "z"];
function axisName(axis) { return kAxes[axis] ?? "none"; }

// The shown frame; everything that depends on it listens.
const shown = {
  row: 0,
  listeners: [],
  set(row) {
    const last = Math.max(run.frames.count - 1, 0);
    this.row = Math.min(Math.max(Math.round(row), 0), last);
    for (const listen of this.listeners) listen(this.row);
  },
  listen(listener) { this.listeners.push(listener); },
};

// Called when colours or sizes have changed.
const redraws = [];
function redrawAll() { for (const redraw of redraws) redraw(); }

// A canvas's context in CSS pixels, cleared; null while it has no size.
function clearedContext(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  if (width === 0 || height === 0) return null;
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height };
}
