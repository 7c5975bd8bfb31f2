#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`sslam eval` and evo's programs on the same files of a run, in the formats of TUM and KITTI: the same figures.

Usage: evo_test.py PROGRAM ROOM   (a folder of `sslam synth`)
"""
import importlib.metadata
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

FOLDER = pathlib.Path(sys.executable).parent


def missing():
    try:
        import evo.main_ape, evo.main_rpe, numpy  # noqa: F401
    except ImportError as error:
        return str(error)
    if shutil.which("evo_ape", path=FOLDER) is None:
        return "No program evo_ape"
    return ""


if why := missing():
    print(f"SKIPPED: {why} for {sys.executable}; scripts/install_packages --tests fetches evo")
    sys.exit(0)

import numpy as np

STATISTICS = {"rmse": lambda e: np.sqrt(np.mean(e**2)), "mean": np.mean, "median": np.median, "max": np.max}
PRINTED = 0.5e-4 + 1e-9  # four digits after the point


class Programs:
    def __init__(self, sslam, scratch):
        self.sslam_program, self.scratch = sslam, scratch

    def run(self, *command):
        environment = dict(os.environ, HOME=str(self.scratch))  # where evo keeps its settings
        done = subprocess.run([str(word) for word in command], cwd=self.scratch, env=environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True)
        assert done.returncode == 0, (command, done)
        return done.stdout

    def sslam(self, *arguments):
        return self.run(self.sslam_program, *arguments)

    def eval(self, *arguments):
        """The printed table: figures by the name of their row."""
        rows = re.findall(r"^(\S.*?)((?: +\d+\.\d{4}){4})  (?:m|deg)$", self.sslam("eval", *arguments), re.MULTILINE)
        return {name.strip(): dict(zip(STATISTICS, map(float, values.split()))) for name, values in rows}

    def evo(self, metric, *arguments):
        """The errors, one a pose or a step."""
        file = self.scratch / "errors.zip"
        file.unlink(missing_ok=True)
        self.run(FOLDER / f"evo_{metric}", *arguments, "--save_results", file, "--no_warnings")
        with zipfile.ZipFile(file) as archive, archive.open("error_array.npy") as errors:
            return np.load(errors)


def same(printed, errors, name):
    assert len(errors) > 10 and printed[name]["rmse"] > 0, name
    for statistic, of in STATISTICS.items():
        assert abs(of(errors) - printed[name][statistic]) <= PRINTED, (name, statistic, of(errors), printed[name])


TRANSLATION, ROTATION = ("-r", "trans_part"), ("-r", "angle_deg")


def compare_tum(programs, truth):
    files = ("tum", truth, "run/trajectory.txt")
    printed = programs.eval(*files[1:], "--delta", "1f", "10f")
    same(printed, programs.evo("ape", *files, "-as", *TRANSLATION), "position (ATE)")
    same(printed, programs.evo("ape", *files, "-as", *ROTATION), "rotation")
    # evo counts the step that ends at the last pose as well.
    same(printed, programs.evo("rpe", *files, "-as", *TRANSLATION)[:-1], "RPE 1 frame, translation")
    same(printed, programs.evo("rpe", *files, "-as", *ROTATION)[:-1], "RPE 1 frame, rotation")
    same(printed, programs.evo("rpe", *files, "-as", *TRANSLATION, "--delta", 10, "--all_pairs")[:-1], "RPE 10 frames, translation")
    fixed = programs.eval(*files[1:], "--align", "se3")
    same(fixed, programs.evo("ape", *files, "-a", *TRANSLATION), "position (ATE)")


def compare_kitti(programs, truth):
    programs.sslam("export", "run", "--format", "kitti")
    # Rows of KITTI have no stamps: the truth is brought to the run's rows.
    programs.run(FOLDER / "evo_traj", "tum", truth, "--ref", "run/trajectory.txt", "--sync", "--save_as_kitti", "--no_warnings")
    files = ("kitti", "groundtruth.kitti", "run/kitti/poses.txt")
    printed = programs.eval(truth, files[2])
    same(printed, programs.evo("ape", *files, "-as", *TRANSLATION), "position (ATE)")
    same(printed, programs.evo("rpe", *files, "-as", *ROTATION)[:-1], "RPE 1 frame, rotation")


def main(sslam, room):
    with tempfile.TemporaryDirectory(prefix="sslam_evo_") as folder:
        programs = Programs(sslam, pathlib.Path(folder))
        programs.sslam("run", room, "--normals", "none", "--out", "run", "--quiet", "--no-report")
        truth = pathlib.Path(room) / "groundtruth.txt"
        compare_tum(programs, truth)
        compare_kitti(programs, truth)
    print("evo", importlib.metadata.version("evo"), "gives the same figures")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
