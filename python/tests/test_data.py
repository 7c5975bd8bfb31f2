"""Datasets, trajectories and evaluation give the command line's numbers."""

import json
import pathlib
import shutil
import tempfile
import unittest
import warnings

import numpy as np

import sslam
from room import ROOM, frames, needs_room, run


def circle(count=50, scale=1.0):
    angles = np.linspace(0, 2, count)
    poses = np.tile(np.eye(4), (count, 1, 1))
    poses[:, 0, 3], poses[:, 2, 3] = scale * np.cos(angles), scale * np.sin(angles)
    return sslam.Trajectory(angles, poses)


class Trajectories(unittest.TestCase):
    def test_what_is_written_is_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "circle.txt"
            sslam.write_trajectory(path, circle())
            read = sslam.read_trajectory(path)
            np.testing.assert_array_equal(read.stamps, circle().stamps)
            np.testing.assert_allclose(read.poses, circle().poses, atol=1e-9)
            with self.assertRaisesRegex(sslam.Error, "nowhere"):
                sslam.read_trajectory(pathlib.Path(folder) / "nowhere.txt")

    def test_evaluation_finds_scale_and_errors(self):
        found = sslam.evaluate(circle(), circle(scale=0.5))
        self.assertAlmostEqual(found.scale, 2)
        self.assertLess(found.position.rmse, 1e-9)
        self.assertEqual(found.position_errors.shape, (50,))
        self.assertEqual(found.pairs, 50)
        self.assertGreater(sslam.evaluate(circle(), circle(scale=0.5), align="se3").position.rmse, 0.1)

    def test_trajectories_that_are_none_are_refused_by_their_name(self):
        good = circle()
        for bad, kind, name in (
            (5, TypeError, "estimate:"),
            ((good.stamps, good.poses[:3]), ValueError, "estimate:"),
            ((good.stamps, good.poses[:, :3]), ValueError, "estimate.poses:"),
            ((good.stamps * np.nan, good.poses), ValueError, "estimate.stamps:"),
            ((good.stamps[::-1], good.poses), ValueError, "estimate.stamps:"),
            ((good.stamps, good.poses * 2), ValueError, "estimate[0]:"),
            ((good.stamps, good.poses + np.diag([0, 0, 0, 1])), ValueError, "estimate[0]: the last row"),
        ):
            with self.assertRaises(kind) as caught:
                sslam.evaluate(good, bad)
            self.assertTrue(str(caught.exception).startswith(name), str(caught.exception))
        with self.assertRaisesRegex(sslam.Error, "no overlap"):
            sslam.evaluate(good, (good.stamps + 100, good.poses))
        with self.assertRaisesRegex(ValueError, "^align: "):
            sslam.evaluate(good, good, align="sim2")


@needs_room
class Datasets(unittest.TestCase):
    def test_a_dataset_lists_its_frames(self):
        dataset = sslam.open_dataset(ROOM, start=2, end=12, stride=3)
        self.assertEqual(len(dataset), 4)
        self.assertEqual(dataset.layout, "TUM RGB-D")
        listed = list(dataset)
        self.assertEqual([f.index for f in listed], [2, 5, 8, 11])
        np.testing.assert_array_equal([f.stamp for f in listed], dataset.stamps)
        self.assertEqual(listed[0].image.shape, (240, 320, 3))
        self.assertEqual(listed[0].image.dtype, np.uint8)
        self.assertEqual((dataset.camera.width, dataset.camera.height), (320, 240))
        np.testing.assert_allclose(dataset.ground_truth.poses[2], listed[0].pose)
        self.assertEqual([f.name for f in dataset], [f.name for f in listed])

    def test_an_image_that_cannot_be_read_is_left_out_with_a_warning(self):
        with tempfile.TemporaryDirectory() as folder:
            images = pathlib.Path(folder) / "images"
            images.mkdir()
            for path in sorted((ROOM / "rgb").iterdir())[:4]:
                shutil.copy(path, images)
            second = sorted(images.iterdir())[1]
            second.write_bytes(second.read_bytes()[:500])
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                dataset = sslam.open_dataset(images)
                self.assertEqual(len(list(dataset)), 3)
            self.assertTrue(all(issubclass(w.category, sslam.SslamWarning) for w in told))
            text = [str(w.message) for w in told]
            self.assertTrue(any("ASSUMING a field of view" in t for t in text), text)
            self.assertTrue(any(second.name in t and "skipped" in t for t in text), text)

    def test_a_scan_has_poses_and_depth_by_the_numbers_of_its_frames(self):
        with tempfile.TemporaryDirectory() as folder:
            scan = pathlib.Path(folder)
            images = sorted((ROOM / "rgb").iterdir())[:4]
            (scan / "rgb.mp4").write_bytes(b"".join(path.read_bytes() for path in images))  # bare MJPEG
            (scan / "camera_matrix.csv").write_text("240.0,0.0,159.5\n0.0,240.0,119.5\n0.0,0.0,1.0\n")
            (scan / "odometry.csv").write_text("timestamp, frame, x, y, z, qx, qy, qz, qw\n" + "".join(
                f"{100 + 0.1 * i}, {i:06}, {i}, 0, 0, 0, 0, 0, 1\n" for i in (0, 1, 3)))
            (scan / "depth").mkdir()
            shutil.copy(images[0], scan / "depth" / "000001.png")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                dataset = sslam.open_dataset(scan)
                listed = list(dataset)
            self.assertEqual((len(listed), dataset.has_depth, dataset.depth_factor), (4, True, 1000))
            self.assertEqual((dataset.camera.fx, dataset.camera.cx), (240, 159.5))
            self.assertEqual([None if f.pose is None else f.pose[0, 3] for f in listed], [0, 1, None, 3])

    def test_a_wide_lens_is_looked_through(self):
        text = "".join(f"Camera.{key}: {value}\n" for key, value in (
            ("type", "KannalaBrandt8"), ("fx", 100), ("fy", 100), ("cx", 159.5), ("cy", 119.5), ("width", 320), ("height", 240),
            ("k1", 0), ("k2", 0), ("k3", 0), ("k4", 0)))
        with tempfile.TemporaryDirectory() as folder:
            camera = pathlib.Path(folder) / "wide.yaml"
            camera.write_text(text)
            lens = sslam.WideLens(camera, 90)
            self.assertAlmostEqual(lens.camera.fx, 160)
            plain = frames()[0].image
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                dataset = sslam.open_dataset(ROOM, camera=camera, undistort_fov=90, end=2)
            self.assertAlmostEqual(dataset.camera.fx, 160)
            first = next(iter(dataset))
            np.testing.assert_array_equal(first.image, lens.image(plain))
            self.assertGreater(np.abs(first.image.astype(int) - plain).mean(), 5)
            self.assertEqual((first.depth, first.mask, dataset.has_depth), (None, None, False))
            self.assertEqual(int(lens.mask(np.zeros((240, 320), np.uint8)).max()), 0)
            system = sslam.System(camera, normals="none")
            self.assertAlmostEqual(system.camera.fx, sslam.WideLens(camera).camera.fx)
            self.assertGreater(system.track(plain, 0.0).points, 20)
            with self.assertRaisesRegex(ValueError, "^depth: "):
                system.track(plain, 1.0, depth=np.ones((240, 320), np.float32))
            with self.assertRaisesRegex(ValueError, "^image: has 160x120 pixels; the lens's images have 320x240"):
                lens.image(plain[::2, ::2])
            with self.assertRaisesRegex(sslam.Error, "not too wide"):
                sslam.WideLens(ROOM / "camera.yaml")
            with self.assertRaisesRegex(ValueError, "^undistort_fov: "):
                sslam.open_dataset(ROOM, undistort_fov=170)

    def test_topics_are_those_of_bags(self):
        with self.assertRaisesRegex(sslam.Error, "is no bag, so it has no topics"):
            sslam.open_dataset(ROOM, topic="/camera/image_raw")
        with self.assertRaisesRegex(TypeError, "^depth_topic: "):
            sslam.open_dataset(ROOM, depth_topic=3)

    def test_what_is_no_dataset_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(sslam.Error, "the folder is empty"):
                sslam.open_dataset(folder)
        with self.assertRaisesRegex(sslam.Error, "no such file"):
            sslam.open_dataset("/nowhere")
        with self.assertRaisesRegex(ValueError, "^stride: "):
            sslam.open_dataset(ROOM, stride=0)
        with self.assertRaisesRegex(sslam.Error, "no frame from"):
            sslam.open_dataset(ROOM, start=1000)

    def test_figures_are_those_of_the_command_line(self):
        truth = ROOM / "groundtruth.txt"
        with tempfile.TemporaryDirectory() as folder:
            estimate, figures = pathlib.Path(folder) / "estimate.txt", pathlib.Path(folder) / "figures.json"
            poses = sslam.read_trajectory(truth)
            noisy = poses.poses.copy()
            noisy[:, :3, 3] += np.random.default_rng(1).normal(0, 0.01, (len(noisy), 3))
            sslam.write_trajectory(estimate, sslam.Trajectory(poses.stamps, noisy))
            run("eval", truth, estimate, "--json", figures)
            expected = json.loads(figures.read_text())
            for source in (truth, ROOM, sslam.open_dataset(ROOM)):
                found = sslam.evaluate(source, estimate)
                self.assertGreater(found.position.rmse, 0.005)
                self.assertAlmostEqual(found.position.rmse, expected["ate_m"]["rmse"], 12)
                self.assertEqual(found.frames, len(frames()))


if __name__ == "__main__":
    unittest.main()
