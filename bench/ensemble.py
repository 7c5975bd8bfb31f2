#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Judges a version of sslam by many runs instead of one, and compares two versions.

One run says little: the first map depends on where it starts, and another first frame may change the error by a factor of
two. So each recording and each rendered room is tracked from several first frames, and the spread is shown.

  bench/ensemble.py run PROGRAM --csv new.csv     (recordings of the folder SSLAM_DATA, or --data)
  bench/ensemble.py compare old.csv new.csv
  bench/ensemble.py show new.csv
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

RECORDINGS = ["tum_fr3_structure_notexture_far", "tum_fr1_rpy_first", "hololens_000", "realsense_office",
              "icl_nuim_of_kt0", "office_kt2"]
ROOMS = {"room_rich": ["--texture", "rich"], "room_poor": ["--texture", "poor"]}
ROOM_OPTIONS = ["--frames", "200", "--seed", "3", "--no-depth"]
COLUMNS = ["sequence", "start", "stride", "normals", "frames", "tracked", "ate", "rotation", "structure", "inliers", "seconds"]
SHOWN = [("runs", "%d"), ("tracked %, least", "%.1f"), ("median", "%.1f"), ("ATE m, mean", "%.4f"), ("worst", "%.4f"),
         ("rotation deg", "%.2f"), ("structure %", "%.0f"), ("inliers", "%.0f"), ("CPU s", "%.0f")]


def render_rooms(program, folder, names):
    """The rooms, rendered once: their folder is kept from one call to the next."""
    for name in set(names) & set(ROOMS):
        path = folder / name
        if not (path / "rgb.txt").exists():
            subprocess.run([program, "synth", path, "--quiet", *ROOM_OPTIONS, *ROOMS[name]], check=True)


def frame_figures(path):
    """Share of the poses that structure had a part in, and the median number of inliers of a pose."""
    with open(path, newline="") as file:
        posed = [row for row in csv.DictReader(file) if row["state"] in ("manhattan", "fallback", "uncertain")]
    if not posed:
        return 0, 0
    marked = [int(row["structure"]) if "structure" in row else row["state"] == "manhattan" for row in posed]
    return sum(marked) / len(posed), statistics.median(int(r["point_inliers"]) + int(r["line_inliers"]) for r in posed)


def run_one(program, dataset, case, extra):
    """One run as a row of the table. Processor time, since the wall clock depends on what else goes on."""
    sequence, start, stride, normals = case
    source = f"files:{dataset / 'normals'}" if normals == "files" else normals
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch)
        command = [program, "run", dataset, "--quiet", "--no-report", "--out", out, "--start", start, "--stride", stride,
                   "--normals", source, *extra]
        with open(out / "log", "w") as log:
            child = subprocess.Popen([str(c) for c in command], stdout=log, stderr=log)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
        metrics = out / "metrics.json"
        if child.returncode not in (0, 1) or not metrics.exists():
            raise RuntimeError(f"{' '.join(map(str, command))}\n{(out / 'log').read_text()}")
        found = json.loads(metrics.read_text())
        structure, inliers = frame_figures(out / "frames.csv")
    errors = found.get("trajectory")
    return {"sequence": sequence, "start": start, "stride": stride, "normals": normals, "frames": found["frames"],
            "tracked": found["share_tracked"], "ate": errors["ate_m"]["rmse"] if errors else "",
            "rotation": errors["rotation_own_offset_deg"]["rmse"] if errors else "",
            "structure": structure, "inliers": inliers, "seconds": usage.ru_utime + usage.ru_stime}


def figures(rows):
    """What is shown of a group of runs. Lengths are compared by their ratio, so their mean is the geometric one."""
    tracked = [100 * float(r["tracked"]) for r in rows]
    errors = [float(r["ate"]) for r in rows if r["ate"] != ""]
    turns = [float(r["rotation"]) for r in rows if r["rotation"] != ""]
    mean = math.exp(statistics.mean(math.log(max(e, 1e-9)) for e in errors)) if errors else math.nan
    return [len(rows), min(tracked), statistics.median(tracked), mean, max(errors, default=math.nan),
            statistics.mean(turns) if turns else math.nan, 100 * statistics.mean(float(r["structure"]) for r in rows),
            statistics.median(float(r["inliers"]) for r in rows), sum(float(r["seconds"]) for r in rows)]


def groups_of(rows):
    """Runs by sequence, stride and normals, in order, and all of them last."""
    groups = {}
    for row in rows:
        name = row["sequence"]
        if str(row["stride"]) != "1":
            name += f", every {row['stride']}"
        groups.setdefault(f"{name}, {row['normals']}", []).append(row)
    return {**groups, "all": rows}


def print_table(tables):
    print("| runs of | " + " | ".join(name for name, _ in SHOWN) + " |")
    print("|---" * (len(SHOWN) + 1) + "|")
    for name in tables[0]:
        if not all(name in table for table in tables):
            continue
        columns = zip(*(figures(table[name]) for table in tables))
        cells = [" -> ".join("-" if math.isnan(v) else form % v for v in values) for values, (_, form) in zip(columns, SHOWN)]
        print(f"| {name} | " + " | ".join(cells) + " |")


def load(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def same_runs(a, b):
    """The runs that both tables have, in the order of the first: a mean over other runs is no comparison."""
    key = lambda row: tuple(str(row[k]) for k in COLUMNS[:4])
    other = {key(row): row for row in b}
    both = [row for row in a if key(row) in other]
    return both, [other[key(row)] for row in both]


def run(a):
    rooms = pathlib.Path(a.rooms)
    data = pathlib.Path(a.data)
    render_rooms(a.program, rooms, a.sequences)
    folders = {name: (rooms if name in ROOMS else data) / name for name in a.sequences}
    for name in [n for n in a.sequences if not folders[n].is_dir()]:
        print(f"{folders.pop(name)}: not there, left out", file=sys.stderr)
    cases = [(name, start, stride, normals) for name in folders for normals in a.normals for stride in a.strides
             for start in a.starts]
    extra = ["--preset", a.preset] + [word for s in a.set for word in ("--set", s)]
    extra += ["--no-final-pass"] if a.no_final_pass else []
    rows = []
    with open(a.csv, "w", newline="") as file, concurrent.futures.ThreadPoolExecutor(a.jobs) as pool:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        for row in pool.map(lambda case: run_one(a.program, folders[case[0]], case, extra), cases):
            writer.writerow(row)
            file.flush()  # who stops the rest keeps what is done
            rows.append(row)
    print_table([groups_of(rows)])


def main():
    def names(text):
        return text.split(",")

    def numbers(text):
        return [int(n) for n in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("run", help="track all, and write a row for each run")
    one.add_argument("program")
    one.add_argument("--csv", required=True)
    one.add_argument("--data", default=os.environ.get("SSLAM_DATA", "."), help="folder of the recordings")
    one.add_argument("--rooms", default=os.path.join(tempfile.gettempdir(), "sslam_ensemble"), help="folder for rendered rooms")
    one.add_argument("--sequences", type=names, default=RECORDINGS + list(ROOMS))
    one.add_argument("--starts", type=numbers, default=[0, 5, 10, 15, 20, 25])
    one.add_argument("--strides", type=numbers, default=[1])
    one.add_argument("--normals", type=names, default=["none"], help="none, on-demand, onnx, depth, files (rendered rooms)")
    one.add_argument("--preset", default="structure")
    one.add_argument("--set", action="append", default=[])
    one.add_argument("--no-final-pass", action="store_true")
    one.add_argument("--jobs", type=int, default=1)
    two = commands.add_parser("compare", help="old -> new, over the runs that both have")
    two.add_argument("old")
    two.add_argument("new")
    three = commands.add_parser("show", help="the table of one file")
    three.add_argument("file")
    a = parser.parse_args()
    if a.command == "run":
        run(a)
    elif a.command == "compare":
        print_table([groups_of(rows) for rows in same_runs(load(a.old), load(a.new))])
    else:
        print_table([groups_of(load(a.file))])


if __name__ == "__main__":
    main()
