// SPDX-License-Identifier: BSD-3-Clause
// In a corner of the 3D view: what the colours of the path mean, and how wide the squares of the floor grid are.

class Legend {
  constructor(parent) {
    this.box = element("div", { className: "legend" });
    parent.append(this.box);
  }

  // by: "state", "error" or "time"; worst: the error of the last colour; square: of the grid, in the unit of the run.
  show({ by, worst, square }) {
    const entries = run.trajectoryThere ? { state: () => this.states(), error: () => this.ramp("error", `${withUnit(worst, "m")} or more`), time: () => this.ramp("time", withUnit(run.seconds(run.frames.count - 1), "s")) }[by]() : [];
    this.box.replaceChildren(...entries, element("span", {}, `squares of ${withUnit(square, run.unit)}`));
  }

  // Those that the path has.
  states() {
    const there = new Set(Array.from({ length: run.frames.count }, (_, row) => row).filter((row) => run.hasPose(row)).map((row) => run.look(row)));
    return Object.keys(kStateWords).filter((state) => there.has(state)).map((state) => element("span", {}, swatchOf(state), kStateWords[state]));
  }

  ramp(name, high) {
    const strip = element("i", { style: `background: linear-gradient(90deg, ${kRamp.map((rgb) => `rgb(${rgb.join(" ")})`).join(", ")})` });
    return [element("span", {}, `${name}: 0 `, strip, ` ${high}`)];
  }
}
