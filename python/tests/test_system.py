"""System: the command line's own bits, whatever the arrays look like."""

import pathlib
import tempfile
import unittest

import numpy as np

import sslam
from room import ROOM, frames, needs_room, poses_of, run, system, track_all


@needs_room
class Tracking(unittest.TestCase):
    def test_trajectory_and_map_are_those_of_the_command_line_to_the_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            run("run", ROOM, "--normals", "none", "--no-report", "--set", "keyframes.max_turn=10", "--out", out / "run")
            tracker = system(parameters={"keyframes.max_turn": 10})
            results = track_all(tracker)
            tracker.finish()
            self.assertEqual(tracker.read_out, 0)  # a rendered global shutter
            tracker.save_trajectory(out / "trajectory.txt")
            tracker.save(out / "map.sslam")
            for name in ("trajectory.txt", "map.sslam"):
                self.assertEqual((out / name).read_bytes(), (out / "run" / name).read_bytes(), name)
            posed = [r for r in results if r.pose is not None]
            self.assertGreater(len(posed), len(results) / 2)
            trajectory = tracker.trajectory()
            self.assertEqual(trajectory.poses.shape, (len(trajectory.stamps), 4, 4))
            truth = sslam.open_dataset(ROOM).ground_truth
            self.assertLess(sslam.evaluate(truth, trajectory).position.rmse, 0.02)
            read = sslam.read_trajectory(out / "run")
            np.testing.assert_allclose(read.poses, trajectory.poses, atol=1e-8)
            np.testing.assert_array_equal(read.stamps, trajectory.stamps)
            written = sslam.load_map(out / "map.sslam")
            np.testing.assert_array_equal(written.points(), tracker.points())
            np.testing.assert_array_equal(written.lines().ends, tracker.lines().ends)
            np.testing.assert_array_equal(written.planes().corners, tracker.planes().corners)
            np.testing.assert_allclose(written.keyframes().poses, tracker.keyframes().poses, atol=1e-12)

    def test_the_shipped_network_gives_the_bits_of_the_command_line(self):
        from sslam._settings import shipped_network

        if shipped_network() is None:
            self.skipTest("skipped: no shipped network")
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            run("run", ROOM, "--end", 20, "--no-report", "--out", out / "run")
            tracker = sslam.System(ROOM / "camera.yaml")
            results = track_all(tracker, count=20)
            self.assertGreater(max(r.normals for r in results), 100)
            tracker.finish()
            tracker.save_trajectory(out / "trajectory.txt")
            self.assertEqual((out / "trajectory.txt").read_bytes(), (out / "run" / "trajectory.txt").read_bytes())

    def test_arrays_of_any_layout_and_order_of_colours_give_the_same_poses(self):
        straight = poses_of(track_all(system(), count=30))
        self.assertTrue(any(straight))

        def cropped(image):  # rows with gaps between them: taken as they are
            wide = np.zeros((240, 400, 3), np.uint8)
            wide[:, 40:360] = image
            return wide[:, 40:360]

        self.assertEqual(straight, poses_of(track_all(system(), cropped, 30)))
        self.assertEqual(straight, poses_of(track_all(system(), np.asfortranarray, 30)))
        with_alpha = lambda image: np.dstack([image, np.full((240, 320), 9, np.uint8)])  # noqa: E731
        self.assertEqual(straight, poses_of(track_all(system(), with_alpha, 30)))
        rgb = system(colours="rgb")
        self.assertEqual(straight, poses_of(track_all(rgb, lambda image: image[:, :, ::-1], 30)))

    def test_images_are_read_in_place_and_left_as_they_are(self):
        image = frames()[0].image.copy()
        image.setflags(write=False)
        before = image.tobytes()
        tracker = system()
        tracker.track(image, 0.0)
        self.assertEqual(image.tobytes(), before)

    def test_poses_come_with_a_covariance_that_the_truth_bears_out(self):
        results = [r for r in track_all(system()) if r.pose is not None]
        self.assertIsNone(results[0].covariance)  # it began the map
        known = [r for r in results if r.covariance is not None]
        self.assertEqual(len(known), len(results) - 1)
        truth = sslam.open_dataset(ROOM).ground_truth
        scale = sslam.evaluate(truth, sslam.Trajectory([r.stamp for r in results], [r.pose for r in results])).scale
        turned, moved = [], []
        for before, after in zip(known, known[1:]):
            for r in (before, after):
                np.testing.assert_allclose(r.covariance, r.covariance.T, atol=1e-15)
                self.assertGreater(np.linalg.eigvalsh(r.covariance).min(), 0)
            step = np.linalg.inv(before.pose) @ after.pose
            right = np.linalg.inv(truth.poses[before.index]) @ truth.poses[after.index]
            off = right[:3, :3].T @ step[:3, :3]
            sigma = np.sqrt(np.diag(before.covariance) + np.diag(after.covariance))
            turned.append(np.array([off[2, 1], off[0, 2], off[1, 0]]) / sigma[:3])
            moved.append((scale * step[:3, 3] - right[:3, 3]) / (scale * sigma[3:]))
        for errors in (turned, moved):  # of consecutive frames, in standard deviations
            self.assertLess(np.median(np.abs(errors)), 2)
            self.assertGreater(np.median(np.abs(errors)), 0.2)
        odometry = [r for r in track_all(system(preset="odometry"), count=30) if r.pose is not None]
        self.assertTrue(odometry)
        self.assertTrue(all(r.covariance is None for r in odometry))

    def test_points_come_with_the_colours_of_the_images(self):
        tracker = system(colours="rgb")
        red = lambda image: np.dstack([image[:, :, 1], image[:, :, 1] // 2, image[:, :, 1] // 4])  # noqa: E731
        track_all(tracker, red)
        tracker.finish()
        cloud = tracker.cloud()
        np.testing.assert_array_equal(cloud.points, tracker.points())
        self.assertEqual((cloud.colours.shape, cloud.colours.dtype), (cloud.points.shape, np.uint8))
        known = cloud.colours[(cloud.colours != 128).any(axis=1)].astype(int)
        self.assertGreater(len(known), 0.9 * len(cloud.points))
        self.assertGreater(known[:, 0].std(), 5)
        np.testing.assert_allclose(known[:, 1], known[:, 0] / 2, atol=3)
        np.testing.assert_allclose(known[:, 2], known[:, 0] / 4, atol=3)
        self.assertEqual(system().cloud().colours.shape, (0, 3))

    def test_bridged_poses_are_named(self):
        tracker = system()
        grey = np.full((240, 320), 128, np.uint8)
        for i, frame in enumerate(frames()):
            tracker.track(grey if 40 <= i < 43 else frame.image, frame.stamp)
        tracker.finish()
        poses, bridged = tracker.trajectory().stamps, tracker.bridged()
        self.assertTrue(set(bridged) <= set(poses))
        self.assertEqual(bridged.dtype, np.float64)

    def test_a_mask_leaves_features_out(self):
        everything = system().track(frames()[0].image, 0.0)
        mask = np.ones((240, 320), bool)
        mask[:, :160] = False
        half = system().track(frames()[0].image, 0.0, mask=mask)
        self.assertLess(half.points, 0.8 * everything.points)
        self.assertEqual(system().track(frames()[0].image, 0.0, mask=mask.astype(np.uint8)).points, half.points)

    def test_depth_serves_the_normals(self):
        camera = sslam.Camera(260.0, 260.0, 159.5, 119.5, 320, 240)
        flat = np.full((240, 320), 2.0, np.float32)
        tracker = sslam.System(camera, normals="depth", depth_factor=1000)
        self.assertGreater(tracker.track(frames()[0].image, 0.0, depth=flat).normals, 100)
        millimetres = (1000 * flat).astype(np.uint16)
        self.assertGreater(tracker.track(frames()[1].image, 1.0, depth=millimetres).normals, 100)
        none = tracker.track(frames()[2].image, 2.0)
        self.assertEqual(none.normals, 0)
        self.assertNotEqual(none.normals_status, "ok")

    def test_own_normals_come_with_the_image_or_from_a_function(self):
        ahead = np.zeros((60, 80, 3))
        ahead[..., 2] = -1
        given = system().track(frames()[0].image, 0.0, normals=ahead)
        self.assertEqual(given.normals_status, "ok")
        self.assertGreater(given.normals, 100)
        seen = []

        def source(image):
            seen.append(image)
            return ahead if len(seen) == 1 else None

        tracker = system(normals=source)
        self.assertEqual(tracker.track(frames()[0].image, 0.0).normals, given.normals)
        self.assertEqual(tracker.track(frames()[1].image, 1.0).normals, 0)
        self.assertIs(seen[1], frames()[1].image)
        self.assertIn("away", system().track(frames()[0].image, 0.0, normals=-ahead).normals_status)
        self.assertIn("not finite", system().track(frames()[0].image, 0.0, normals=np.nan * ahead).normals_status)
        nowhere = np.dstack([ahead, np.zeros((60, 80))])  # the probability of a plane
        self.assertEqual(system().track(frames()[0].image, 0.0, normals=nowhere).normals, 0)

    def test_a_saved_map_is_gone_on_in(self):
        first = system()
        track_all(first)
        first.finish()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "map.sslam"
            first.save(path)
            second = system()
            second.load(path)
            second.localise_only()
            keyframes = len(second.keyframes().stamps)
            results = track_all(second, count=20)
            self.assertTrue(any(r.pose is not None for r in results))
            self.assertEqual(len(second.keyframes().stamps), keyframes)

    def test_live_mode_tracks(self):
        tracker = system(live=True)
        self.assertIsNone(tracker.latest().pose)
        results = track_all(tracker)
        latest = tracker.latest()
        self.assertEqual(latest.stamp, frames()[-1].stamp)
        self.assertEqual(latest.state, results[-1].state)
        tracker.finish()
        self.assertGreater(len(tracker.trajectory().stamps), 30)

    def test_empty_maps_are_empty_arrays(self):
        tracker = system()
        self.assertEqual(tracker.points().shape, (0, 3))
        self.assertEqual(tracker.lines().ends.shape, (0, 2, 3))
        self.assertEqual(tracker.planes().corners.shape, (0, 4, 3))
        self.assertEqual(tracker.trajectory().poses.shape, (0, 4, 4))
        self.assertEqual(tracker.frames, 0)

    def test_arrays_outlive_their_system(self):
        tracker = system()
        track_all(tracker, count=30)
        points, latest = tracker.points(), tracker.latest()
        copy = points.copy()
        del tracker
        np.testing.assert_array_equal(points, copy)
        self.assertEqual(latest.pose.shape, (4, 4))


if __name__ == "__main__":
    unittest.main()
