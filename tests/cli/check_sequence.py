#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs sslam on a recording and demands a share of tracked frames and an accuracy.

Usage: check_sequence.py PROGRAM RECORDING NORMALS SHARE ATE

RECORDING is a folder in the one that SSLAM_DATA names, or beside the source tree (as in tests/io/shared_data.hpp). Ends with
77, which stands for skipped, where it is not there.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77
BESIDE = pathlib.Path(__file__).resolve().parents[3] / "shared/data"


def main():
    program, name, normals, share, ate = sys.argv[1:]
    recording = pathlib.Path(os.environ.get("SSLAM_DATA", BESIDE)) / name
    if not recording.is_dir():
        print(f"skipped: no {recording} (set SSLAM_DATA)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as out:
        command = [program, "run", recording, "--quiet", "--normals", normals, "--out", out]
        code = subprocess.run(command).returncode
        metrics = json.loads((pathlib.Path(out) / "metrics.json").read_text())
    tracked, reached = metrics["share_tracked"], metrics["trajectory"]["ate_m"]["rmse"]
    print(f"tracked {100 * tracked:.1f} % (at least {100 * float(share):.0f}), ATE {reached:.4f} m (at most {ate})")
    return code or int(not (tracked >= float(share) and reached <= float(ate)))


if __name__ == "__main__":
    sys.exit(main())
