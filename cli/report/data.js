// SPDX-License-Identifier: BSD-3-Clause
// A run, as report_data.cpp wrote it, with its arrays unpacked.

const kArrayTypes = { f32: Float32Array, f64: Float64Array, u32: Uint32Array, i32: Int32Array, u16: Uint16Array, u8: Uint8Array, i8: Int8Array };

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function unpack(value) {
  if (value === null || typeof value !== "object" || Array.isArray(value)) return value;
  if (typeof value.base64 === "string") return new kArrayTypes[value.type](bytesOf(value.base64).buffer);
  return Object.fromEntries(Object.entries(value).map(([key, inner]) => [key, unpack(inner)]));
}

// The columns of frames.csv by name; what a file that is cut off lacks reads as zeros and blanks.
class FrameTable {
  constructor(frames) {
    this.count = frames.count;
    this.columns = frames.columns;
  }
  has(name) { return name in this.columns; }
  number(name, row) {
    const column = this.columns[name];
    return ArrayBuffer.isView(column) ? column[row] : 0;
  }
  text(name, row) {
    const column = this.columns[name];
    if (!column) return "";
    return column.names ? column.names[column.codes[row]] : String(column[row]);
  }
  all(name) {
    const column = this.columns[name];
    return ArrayBuffer.isView(column) ? column : new Float32Array(this.count);
  }
}

// The numbers of a list that has `count` of them; else `otherwise`.
function numbersOr(otherwise, values, count) {
  const good = Array.isArray(values) && values.length === count && values.every((value) => Number.isFinite(value) && value > 0);
  return good ? values : otherwise;
}

// What map_data.cpp calls witnesses, with the list of each landmark's keyframes cut out of the common one.
function withWitnesses({ counts, listed, keyframes, planes }) {
  const from = new Uint32Array(listed.length + 1);
  listed.forEach((count, i) => { from[i + 1] = from[i] + count; });
  return { counts, planes, keyframesOf: (i) => [...keyframes.subarray(from[i], from[i + 1])] };
}

// Where down is in the map, a unit vector; y where nothing is known, or it would be turned over.
function downOf(up) {
  const down = (up ?? [0, -1, 0]).map((value) => -value);
  return down[1] > -0.99 ? down : [0, 1, 0];
}

// From the map to axes of the same kind (x right, y down, z ahead) with y downwards: the smallest turn that does it.
function levellingOf(down) {
  const axis = cross(down, [0, 1, 0]);
  return (x, y, z) => {
    const once = cross(axis, [x, y, z]), twice = cross(axis, once);
    return [x, y, z].map((value, k) => value + once[k] + twice[k] / (1 + down[1]));
  };
}

function makeRun(raw) {
  const metrics = raw.metrics;  // as it was written: it may have a member called base64
  delete raw.metrics;
  const data = unpack(raw);
  const frames = new FrameTable(data.frames);
  const settings = metrics.settings ?? {};
  const secondsPerStamp = Number(settings.seconds_per_stamp) || 1;
  const stamps = frames.all("stamp"), down = downOf(data.up);
  return {
    kind: "run",  // "live": one that goes on; "map": the map alone
    ...data,
    metrics,
    settings,
    frames,
    pinhole: numbersOr([1, 1, 0.5, 0.5], settings.pinhole, 4),
    imageSize: numbersOr([1, 1], settings.image_size, 2),
    scale: data.metres_per_unit ?? 1,
    down,
    levelled: levellingOf(down),
    unit: data.metres_per_unit ? "m" : "map units",
    secondsOfStamp: (stamp) => (stamp - (stamps[0] ?? 0)) * secondsPerStamp,
    seconds: (row) => (stamps[row] - (stamps[0] ?? 0)) * secondsPerStamp,
    trajectoryThere: data.poses.some((value) => !Number.isNaN(value)),
    hasPose: (row) => !Number.isNaN(data.poses[7 * row]),
    state: (row) => frames.text("state", row),
    // The state by which a frame is coloured: a pose that has the Manhattan rotation in it is the structure's, also
    // where six degrees of freedom were searched.
    look: (row) => (frames.text("state", row) === "fallback" && frames.number("structure", row) === 1 ? "manhattan" : frames.text("state", row)),
    surfaces: data.surfaces ? new Surfaces(data.surfaces) : null,
    textureLeft: data.surfaces ? { share: data.surfaces.share, quality: data.surfaces.quality } : null,
    pointWitnesses: withWitnesses(data.point_witnesses),
    lineWitnesses: withWitnesses(data.lines.witnesses),
    reason: (row) => frames.text("reason", row),
    // Whether any frame has seen the room's axes, or is tracked by them; the preset `features` never does.
    manhattanSeen: frames.all("axes_seen").some((axes) => axes > 0) || frames.all("structure").some((held) => held > 0),
  };
}

// Runs of rows for which same(row) gives equal, not null, answers.
function spansOf(count, same) {
  const spans = [];
  for (let row = 0; row < count; ++row) {
    const key = same(row);
    const last = spans[spans.length - 1];
    if (key === null) continue;
    if (last && last.to === row - 1 && last.key === key) last.to = row;
    else spans.push({ key, from: row, to: row });
  }
  return spans;
}
