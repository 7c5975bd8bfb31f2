#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bench/vslamlab, on a rendered room in the form of VSLAM-LAB's sequences.

Usage: vslamlab_test.py SSLAM ROOM WRAPPER_FOLDER
"""
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import types

try:
    import yaml  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}; Debian's python3-yaml has it")
    sys.exit(0)


def main(sslam, room, wrapper):
    room, wrapper = pathlib.Path(room).resolve(), pathlib.Path(wrapper).resolve()
    with tempfile.TemporaryDirectory(prefix="sslam_vslamlab_") as folder:
        sequence = pathlib.Path(folder)
        (sequence / "rgb_0").symlink_to(room / "rgb")
        rows = [line.split() for line in (room / "rgb.txt").read_text().splitlines() if line[:1] != "#"]
        offset = 1_600_000_000_123_456_789  # more digits than a double has
        stamps = {int(offset + round(float(stamp) * 1e9)): stamp for stamp, _ in rows}
        with open(sequence / "rgb.csv", "w", newline="") as file:
            csv.writer(file).writerows([["ts_rgb_0 (ns)", "path_rgb_0"], *([t, path.replace("rgb/", "rgb_0/")] for t, (_, path) in zip(stamps, rows))])
        camera = {key: float(value) for key, value in re.findall(r"Camera\.(\w+): ([-+.\de]+)", (room / "camera.yaml").read_text())}
        (sequence / "calibration.yaml").write_text(
            "%YAML 1.2\n---\ncameras:\n\n  - {cam_name: rgb_0,\n     cam_type: rgb,\n     cam_model: pinhole,\n     distortion_type: radtan4,\n"
            f"     focal_length: [{camera['fx']}, {camera['fy']}],\n     principal_point: [{camera['cx']}, {camera['cy']}],\n"
            f"     distortion_coefficients: [0.0, 0.0, 0.0, 0.0],\n     image_dimension: [{camera['width']:.0f}, {camera['height']:.0f}],\n"
            "     fps: 30.0}\n")
        subprocess.run([sys.executable, wrapper / "sslam_mono.py", "--sequence_path", sequence, "--calibration_yaml", sequence / "calibration.yaml",
                        "--rgb_csv", sequence / "rgb.csv", "--exp_folder", sequence, "--exp_it", "3", "--settings_yaml", "none", "--verbose", "1",
                        "--mode", "mono", "--sslam_options", "normals=none quiet", "--program", sslam], check=True)
        with open(sequence / "00003_KeyFrameTrajectory.csv", newline="") as file:
            head, *poses = csv.reader(file)
        assert head == ["ts (ns)", "tx (m)", "ty (m)", "tz (m)", "qx", "qy", "qz", "qw"], head
        assert len(poses) > 50 and {int(pose[0]) for pose in poses} <= set(stamps), len(poses)
        (sequence / "estimate.txt").write_text("".join(" ".join([stamps[int(pose[0])], *pose[1:]]) + "\n" for pose in poses))
        subprocess.run([sslam, "eval", room / "groundtruth.txt", sequence / "estimate.txt", "--json", sequence / "error.json"], check=True,
                       stdout=subprocess.DEVNULL)
        error = json.loads((sequence / "error.json").read_text())
        assert error["ate_m"]["rmse"] < 0.02, error
    check_class(wrapper)


def check_class(wrapper):
    """The class, on a base with the interface of VSLAM-LAB's."""
    class BaselineVSLAMLAB:
        def __init__(self, baseline_name, baseline_folder, default_parameters=None):
            self.baseline_path = pathlib.Path("Baselines") / baseline_folder
            self.default_parameters = default_parameters
    sys.modules["Baselines"] = types.ModuleType("Baselines")
    sys.modules["Baselines.BaselineVSLAMLAB"] = types.SimpleNamespace(BaselineVSLAMLAB=BaselineVSLAMLAB)
    sys.path.insert(0, str(wrapper))
    from baseline_sslam import SSLAM_baseline
    baseline = SSLAM_baseline()
    assert baseline.modes == ["mono"] == [baseline.default_parameters["mode"]]
    assert baseline.is_installed()[0] is False


if __name__ == "__main__":
    main(*sys.argv[1:])
