"""The examples do what their first lines say, on the rendered room."""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import sslam
from room import ROOM, needs_room

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"


@needs_room
class Examples(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_example(self, name, *arguments):
        done = subprocess.run([sys.executable, EXAMPLES / name, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_a_folder(self):
        self.assertRegex(self.run_example("folder.py", ROOM), r"\n(5\d|60) poses in trajectory.txt, \d{2,} points in map.sslam\n$")
        self.assertGreater(len(sslam.load_map(self.folder / "map.sslam").points()), 20)

    def test_own_normals(self):
        told = self.run_example("own_normals.py", ROOM)
        self.assertGreater(len(re.findall(r": \d{3,} normals, 3 axes, ", told)), 50)

    def test_own_rotation(self):
        # The truth, turned by the world of an IMU, with the noise of one.
        truth = np.loadtxt(ROOM / "groundtruth.txt")
        x, y, z, w = truth[:, 4:].T
        s, c = np.sin(0.4), np.cos(0.4)  # half of the turn about y
        turned = np.stack([c * x + s * z, c * y + s * w, c * z - s * x, c * w - s * y], axis=1)
        turned += np.random.default_rng(1).normal(0, 0.002, turned.shape)
        turned /= np.linalg.norm(turned, axis=1, keepdims=True)
        np.savetxt(self.folder / "imu.txt", np.column_stack([truth[:, 0], turned]))
        told = self.run_example("own_rotation.py", ROOM, "imu.txt", 0.5)
        used = int(re.search(r"; (\d+) of 60 rotations used", told)[1])
        self.assertGreater(used, 50)
        found = sslam.read_trajectory(self.folder / "trajectory.txt")
        known = sslam.read_trajectory(ROOM / "groundtruth.txt")
        known = known.poses[np.searchsorted(known.stamps, found.stamps - 1e-3), :3, :3]
        self.assertGreater(len(known), 50)
        turned = [poses[0].T @ poses for poses in (found.poses[:, :3, :3], known)]
        cosine = (np.einsum("nij,nij->n", *turned) - 1) / 2
        self.assertLess(np.degrees(np.sqrt(np.mean(np.arccos(np.clip(cosine, -1, 1)) ** 2))), 0.5)

    @unittest.skipUnless(importlib.util.find_spec("onnxruntime"), "skipped: no onnxruntime")
    def test_own_network(self):
        from sslam._settings import shipped_network

        if shipped_network() is None:
            self.skipTest("skipped: no shipped network")
        told = self.run_example("own_network.py", ROOM, pathlib.Path(shipped_network()).with_suffix(".onnx"))
        self.assertGreater(len(re.findall(r": \d{3,} normals, ok, ", told)), 30)

    def test_usage(self):
        for example in ("folder.py", "own_normals.py", "own_rotation.py"):
            done = subprocess.run([sys.executable, EXAMPLES / example], capture_output=True, text=True, env=dict(os.environ))
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(example, done.stderr)


if __name__ == "__main__":
    unittest.main()
