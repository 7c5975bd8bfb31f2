# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of `sslam batch` share: a rendered room, and a suite of it. SSLAM_COMMAND names the program."""
import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["SSLAM_COMMAND"]
FRAMES = 30
SUITE = """
name = "Small & rooms"
seeds = [1, 2]
[[sequence]]
name = "room_a"
path = "room"
[[sequence]]
name = "half of it"
path = "room"
end = 20
[[method]]
normals = ["none", "depth"]
"""


def sslam(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


class BatchCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="sslam_batch_")
        cls.folder = pathlib.Path(cls.scratch.name)
        made = sslam("synth", cls.folder / "room", "--frames", FRAMES, "--size", "320x240", "--seed", 3, "--quiet")
        assert made.returncode == 0, made.stderr

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def suite(self, text, name="suite.toml"):
        (self.folder / name).write_text(text)
        return self.folder / name

    def batch(self, *arguments, code=0):
        done = sslam("batch", *arguments)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def runs(self, out):
        with open(out / "runs.csv", newline="") as file:
            return list(csv.DictReader(file))


def marks(out):
    """When each run of a batch was done."""
    return {str(mark.parent.relative_to(out)): mark.stat().st_mtime_ns for mark in out.rglob("run.json")}
