#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What VSLAM-LAB starts for a sequence: runs `sslam run` on it, and leaves the trajectory where VSLAM-LAB looks for it.

In: rgb.csv (`ts_rgb_0 (ns)`, `path_rgb_0`), calibration.yaml (its camera `rgb_0`: pinhole, none or radial-tangential lens).
Out: EXP_FOLDER/NNNNN_KeyFrameTrajectory.csv (`ts (ns),tx (m),...,qw`, camera to world; the unit is the map's own), every
tracked frame; the folder of the run, EXP_FOLDER/NNNNN_sslam.
"""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

import yaml

HEADER = ["ts (ns)", "tx (m)", "ty (m)", "tz (m)", "qx", "qy", "qz", "qw"]
LENS = ("k1", "k2", "p1", "p2", "k3")
MODELS = {"radtan4": 4, "radtan5": 5}


def read_frames(path):
    """(nanoseconds, path of the image below the sequence)"""
    with open(path, newline="") as file:
        return [(int(row["ts_rgb_0 (ns)"]), row["path_rgb_0"]) for row in csv.DictReader(file)]


def read_camera(path, name):
    """The lines of a camera file of sslam's."""
    text = "\n".join(line for line in pathlib.Path(path).read_text().splitlines() if not line.startswith("%"))
    cameras = {camera["cam_name"]: camera for camera in yaml.safe_load(text)["cameras"]}
    camera = cameras[name]
    kind = camera.get("distortion_type") or "none"
    if camera["cam_model"] != "pinhole" or kind not in ("none", *MODELS):
        sys.exit(f"{path}: {name} is {camera['cam_model']} with {kind}; sslam's wrapper takes pinhole with none, {' or '.join(MODELS)}")
    lens = camera["distortion_coefficients"][:MODELS[kind]] if kind in MODELS else []
    values = dict(zip(("width", "height"), camera["image_dimension"])) | dict(zip(("fx", "fy"), camera["focal_length"]))
    values |= dict(zip(("cx", "cy"), camera["principal_point"])) | dict(zip(LENS, lens))
    return [f"Camera.{key}: {value}" for key, value in values.items()]


def run(options):
    frames = read_frames(options.rgb_csv)
    begin = frames[0][0]
    out = pathlib.Path(options.exp_folder) / f"{int(options.exp_it):05d}_sslam"
    with tempfile.TemporaryDirectory() as folder:
        dataset = pathlib.Path(folder)
        (dataset / "images").symlink_to(pathlib.Path(options.sequence_path).resolve())
        # Stamps from the first frame on keep their nanoseconds as decimals.
        (dataset / "rgb.txt").write_text("".join(f"{seconds(t - begin)} images/{path}\n" for t, path in frames))
        (dataset / "camera.yaml").write_text("\n".join(["%YAML:1.0", *read_camera(options.calibration_yaml, options.camera), ""]))
        subprocess.run([options.program, "run", dataset, "--out", out, "--no-report", *(f"--{word}" for word in options.sslam_options.split())],
                       check=True)
    times = {seconds(t - begin): t for t, _ in frames}
    rows = [line.split() for line in (out / "trajectory.txt").read_text().splitlines() if line[:1] != "#"]
    target = pathlib.Path(options.exp_folder) / f"{int(options.exp_it):05d}_KeyFrameTrajectory.csv"
    with open(target, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(HEADER)
        writer.writerows([times[f"{float(row[0]):.9f}"], *row[1:]] for row in rows)


def seconds(nanoseconds):
    return f"{nanoseconds / 1e9:.9f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("sequence_path", "calibration_yaml", "rgb_csv", "exp_folder", "exp_it"):
        parser.add_argument(f"--{name}", required=True)
    parser.add_argument("--camera", default="rgb_0")
    parser.add_argument("--sslam_options", default="", help="for sslam run, without dashes: 'normals=none live'")
    parser.add_argument("--program", default=os.environ.get("SSLAM", "sslam"))
    options, _ = parser.parse_known_args()  # VSLAM-LAB gives more to all: mode, verbose, settings_yaml
    run(options)


if __name__ == "__main__":
    main()
