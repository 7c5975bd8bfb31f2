#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs sslam over sequences and sources of normals and prints the table of docs/benchmarks.md.

Usage: bench/sequences.py PROGRAM DATA [--repeat N] [--normals none,depth,...] [--preset NAME] [--set KEY=VALUE]...

DATA holds the recordings; two rooms are rendered beside the results. Runs are interleaved: every configuration once, then
all again. Accuracy must not change between repeats, and the script says so if it does; times are medians.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

RECORDINGS = {
    "tum_fr3_structure_notexture_far": ["none", "depth", "onnx"],
    "icl_nuim_of_kt0": ["none", "depth", "onnx"],
    "office_kt2": ["none", "onnx"],
}
ROOMS = {"synth rich": ["--texture", "rich"], "synth poor": ["--texture", "poor"]}


def render_rooms(program, folder):
    rooms = {}
    for name, options in ROOMS.items():
        path = folder / name.replace(" ", "_")
        subprocess.run([program, "synth", path, "--quiet", "--frames", "300", "--seed", "3", *options], check=True)
        rooms[name] = path
    return rooms


def run(program, dataset, out, normals, extra):
    command = [program, "run", dataset, "--quiet", "--out", out, "--normals", normals, *extra]
    answer = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    metrics = out / "metrics.json"
    if not metrics.exists():
        print(answer.stderr, file=sys.stderr)
        return None
    return json.loads(metrics.read_text())


def row(name, normals, runs):
    last = runs[-1]
    if "trajectory" not in last:
        return f"| {name} | {normals} | {100 * last['share_tracked']:.1f} | - | - | - | - | - | - |"
    ates = {r["trajectory"]["ate_m"]["rmse"] for r in runs}
    if len(ates) > 1:
        print(f"{name}, {normals}: runs differ: {sorted(ates)}", file=sys.stderr)
    rate = statistics.median(r["times"]["frames_per_second"] for r in runs)
    median = statistics.median(r["times"]["frame_ms"]["median"] for r in runs)
    p95 = statistics.median(r["times"]["frame_ms"]["p95"] for r in runs)
    trajectory = last["trajectory"]
    return (f"| {name} | {normals} | {100 * last['share_tracked']:.1f} | {100 * last['tracked_live'] / last['frames']:.1f} "
            f"| {trajectory['ate_m']['rmse']:.4f} | {trajectory['rotation_own_offset_deg']['rmse']:.2f} "
            f"| {rate:.0f} | {median:.1f} | {p95:.1f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--normals", help="only these sources, separated by commas")
    parser.add_argument("--preset", default="structure")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--stride", default="1")
    parser.add_argument("--noise", type=float, default=0, help="added to the images, see degrade.py")
    parser.add_argument("--blur", type=int, default=0, help="the same")
    a = parser.parse_args()
    extra = ["--preset", a.preset, "--stride", a.stride] + [x for s in a.set for x in ("--set", s)]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        cases = [(n, a.data / n, s) for n, sources in RECORDINGS.items() if (a.data / n).is_dir() for s in sources]
        for name, path in render_rooms(a.program, folder).items():
            cases += [(name, path, s) for s in ["none", "depth", f"files:{path}/normals", "onnx"]]
        if a.noise or a.blur:
            from degrade import degrade_sequence  # needs OpenCV
            worse = {path: folder / f"worse_{name.replace(' ', '_')}" for name, path, _ in cases}
            for path, copy in worse.items():
                degrade_sequence(path, copy, a.noise, a.blur)
            cases = [(name, worse[path], source) for name, path, source in cases]
        if a.normals:
            cases = [c for c in cases if c[2].split(":")[0] in a.normals.split(",")]
        results = {}
        for _ in range(a.repeat):
            for i, (name, path, normals) in enumerate(cases):
                metrics = run(a.program, path, folder / f"out{i}", normals, extra)
                if metrics:
                    results.setdefault((name, normals.split(":")[0]), []).append(metrics)
    print("| sequence | normals | tracked % | live % | ATE m | rotation deg | frames/s | frame ms | p95 ms |")
    print("|---|---|---|---|---|---|---|---|---|")
    for (name, normals), runs in results.items():
        print(row(name, normals, runs))


if __name__ == "__main__":
    main()
