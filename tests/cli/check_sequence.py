#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs sslam on a recording and demands a share of tracked frames and an accuracy.

Usage: check_sequence.py PROGRAM RECORDING NORMALS SHARE ATE     ends with 77 (skipped) where there is no recording
"""
import json
import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77


def main():
    program, recording, normals, share, ate = sys.argv[1:]
    if not pathlib.Path(recording).is_dir():
        print(f"skipped: there is no recording {recording}")
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
