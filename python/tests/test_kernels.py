"""The kernels answer with C++'s numbers, and refuse what is no input by its name."""

import os
import subprocess
import unittest

import numpy as np

import sslam
from scene import CAMERA, SCENE, moved, turn

def by_cpp(kernel, *inputs):
    c = CAMERA
    parts = [kernel, *(repr(x) for x in (c.fx, c.fy, c.cx, c.cy, c.k1, c.k2))]
    for value in inputs:
        parts += [repr(float(x)) for x in np.asarray(value, dtype=np.float64).ravel()]
    out = subprocess.run([os.environ["SSLAM_KERNEL_NUMBERS"]], input=" ".join(parts), capture_output=True, text=True, check=True)
    return np.array([float(x) for x in out.stdout.split()])


def flat(*values):
    return np.concatenate([np.asarray(v, dtype=np.float64).ravel() for v in values])


@unittest.skipUnless("SSLAM_KERNEL_NUMBERS" in os.environ, "skipped: no SSLAM_KERNEL_NUMBERS")
class SameNumbers(unittest.TestCase):
    def same(self, answer, expected):
        np.testing.assert_array_equal(answer, expected)

    def test_manhattan_rotation_from_nothing(self):
        normals = SCENE.normals.astype(np.float32)
        found = sslam.manhattan_rotation(normals, SCENE.segments, camera=CAMERA)
        self.assertEqual(found.status, sslam.Status.OK)
        self.same(
            flat(found.status, found.rotation, found.covariance, found.axis_of),
            by_cpp("manhattan", len(normals), normals, len(SCENE.segments), SCENE.segments),
        )

    def test_manhattan_rotation_near_a_prior(self):
        normals = SCENE.normals.astype(np.float32)
        prior = turn(0.05, -0.2, 0.1)
        found = sslam.manhattan_rotation(normals, SCENE.segments, prior, camera=CAMERA)
        self.assertEqual(found.status, sslam.Status.OK)
        self.assertEqual(found.axes_seen, 3)
        np.testing.assert_allclose(found.rotation, SCENE.room, atol=0.02)
        self.same(
            flat(found.status, found.rotation, found.covariance, found.axis_of),
            by_cpp("manhattan_near", len(normals), normals, len(SCENE.segments), SCENE.segments, prior),
        )

    def test_relative_pose(self):
        a, b = SCENE.pixels[:, 0], SCENE.pixels[:, 1]
        found = sslam.relative_pose(a, b, CAMERA)
        self.assertEqual(found.status, sslam.Status.OK)
        truth = np.linalg.inv(SCENE.poses[1])
        np.testing.assert_allclose(found.pose[:3, 3], truth[:3, 3] / np.linalg.norm(truth[:3, 3]), atol=0.05)
        self.assertEqual(found.inliers.dtype, np.bool_)
        self.assertGreater(found.inliers.sum(), 70)
        numbers = flat(len(a), np.hstack([a, b]))
        self.same(
            flat(found.status, found.pose[:3, :3], found.pose[:3, 3], found.rotation_covariance),
            by_cpp("relative_pose", numbers),
        )
        near = sslam.relative_pose(a, b, CAMERA, start=moved(truth[:3, :3], truth[:3, 3]))
        self.same(
            flat(near.status, near.pose[:3, :3], near.pose[:3, 3], near.rotation_covariance),
            by_cpp("refined_relative_pose", numbers, truth),
        )

    def test_translation_from_rotation(self):
        a, b = SCENE.pixels[:, 0], SCENE.pixels[:, 1]
        rotation = SCENE.poses[1][:3, :3].T
        found = sslam.translation_from_rotation(a, b, rotation, CAMERA)
        self.assertEqual(found.status, sslam.Status.OK)
        self.same(flat(found.status, found.translation), by_cpp("translation", len(a), np.hstack([a, b]), rotation))

    def test_triangulate_points(self):
        found = sslam.triangulate_points(SCENE.poses, SCENE.pixels, CAMERA)
        good = found.status == sslam.Status.OK
        self.assertGreater(good.sum(), 70)
        np.testing.assert_allclose(found.points[good], SCENE.points[good], atol=0.3)
        expected = by_cpp("triangulate", 3, SCENE.poses, len(SCENE.points), SCENE.pixels).reshape(-1, 13)
        self.same(np.column_stack([found.status, found.points, found.covariance.reshape(-1, 9)]), expected)

    def test_triangulate_lines(self):
        segments = SCENE.views_of_lines.copy()
        segments[:5, 1] = np.nan  # two views of three
        directions = np.full((30, 3), np.nan)
        directions[20:] = SCENE.room.T[np.arange(20, 30) % 3]
        found = sslam.triangulate_lines(SCENE.poses, segments, CAMERA, directions=directions)
        good = found.status == sslam.Status.OK
        self.assertGreater(good[:20].sum(), 5)
        self.assertGreater(good[20:].sum(), 5)
        along = SCENE.lines[:, 1] - SCENE.lines[:, 0]
        off = np.cross(found.ends - SCENE.lines[:, :1], along[:, None] / np.linalg.norm(along, axis=1)[:, None, None])
        self.assertLess(np.median(np.linalg.norm(off[good], axis=2)), 0.1)
        numbers = [flat(d, s) for d, s in zip(directions, segments)]
        expected = by_cpp("triangulate_lines", 3, SCENE.poses, len(segments), flat(*numbers)).reshape(-1, 16)
        self.same(np.column_stack([found.status, found.ends.reshape(-1, 6), found.covariance.reshape(-1, 9)]), expected)

    def start_of_adjustment(self):
        random = np.random.default_rng(3)
        poses = SCENE.poses.copy()
        poses[1] = poses[1] @ moved(turn(0.01, 0, 0.01), [0.05, 0, 0])
        upright = slice(1, None, 3)  # across the motion, which shows where they are
        lines = SCENE.lines[upright] + random.normal(0, 0.02, (10, 2, 3))
        return poses, SCENE.points + random.normal(0, 0.05, SCENE.points.shape), lines, SCENE.views_of_lines[upright]

    def test_bundle_adjust(self):
        poses, points, lines, segments = self.start_of_adjustment()
        found = sslam.bundle_adjust(poses, points, SCENE.pixels, CAMERA, lines=lines, segments=segments)
        self.assertEqual(found.status, sslam.Status.OK)
        self.assertLess(found.final_cost, found.initial_cost / 10)
        np.testing.assert_array_equal(found.poses[0], poses[0])
        np.testing.assert_allclose(found.poses, SCENE.poses, atol=0.02)
        self.assertLess(np.median(np.abs(found.points - SCENE.points)), 0.02)
        numbers = [flat(p, s) for p, s in zip(points, SCENE.pixels)], [flat(p, s) for p, s in zip(lines, segments)]
        self.same(
            flat(found.status, *(flat(p[:3, :3], p[:3, 3]) for p in found.poses), found.points, found.lines, *found[4:]),
            by_cpp("bundle_adjust", 3, poses, len(points), flat(*numbers[0]), len(lines), flat(*numbers[1])),
        )

    def test_bundle_adjust_moves_nothing_that_is_held_or_unseen(self):
        poses, points, lines, segments = self.start_of_adjustment()
        pixels, segments = SCENE.pixels.copy(), segments.copy()
        pixels[0, 1:] = segments[0, 1:] = np.nan
        held = [True, False, True]
        found = sslam.bundle_adjust(poses, points, pixels, CAMERA, lines=lines, segments=segments, held=held)
        self.assertEqual(found.status, sslam.Status.OK)
        np.testing.assert_array_equal(found.poses[held], poses[held])
        np.testing.assert_allclose(found.poses[1], SCENE.poses[1], atol=0.01)
        np.testing.assert_array_equal(found.points[0], points[0])
        np.testing.assert_allclose(found.lines[0], lines[0], atol=1e-9)
        blind = sslam.bundle_adjust(poses, points, np.full_like(pixels, np.nan), CAMERA)
        self.assertEqual(blind.status, sslam.Status.TOO_FEW)
        np.testing.assert_array_equal(blind.points, points)

    def test_refine_pose(self):
        start = SCENE.poses[1] @ moved(turn(0.01, 0, 0.01), [0.05, 0, 0])
        found = sslam.refine_pose(SCENE.points, SCENE.pixels[:, 1], CAMERA, start)
        self.assertEqual(found.status, sslam.Status.OK)
        np.testing.assert_allclose(found.pose, SCENE.poses[1], atol=0.02)
        self.same(
            flat(found.status, found.pose[:3, :3], found.pose[:3, 3]),
            by_cpp("refine_pose", len(SCENE.points), np.hstack([SCENE.points, SCENE.pixels[:, 1]]), start),
        )


class Refusals(unittest.TestCase):
    def refuses(self, kind, name, function, *args, **keywords):
        with self.assertRaises(kind) as caught:
            function(*args, **keywords)
        self.assertTrue(str(caught.exception).startswith(name), str(caught.exception))

    def test_what_is_no_input_is_refused_by_its_name(self):
        a, b = SCENE.pixels[:, 0], SCENE.pixels[:, 1]
        self.refuses(ValueError, "pixels0:", sslam.relative_pose, a[:, :1], b, CAMERA)
        self.refuses(ValueError, "pixels1:", sslam.relative_pose, a, b[:-1], CAMERA)
        self.refuses(TypeError, "pixels0:", sslam.relative_pose, [["a", "b"]], b, CAMERA)
        self.refuses(TypeError, "pixels0:", sslam.relative_pose, [[1, 2], [3]], b, CAMERA)
        self.refuses(TypeError, "camera:", sslam.relative_pose, a, b, 5)
        self.refuses(ValueError, "sigma:", sslam.relative_pose, a, b, CAMERA, sigma=float("nan"))
        self.refuses(ValueError, "seed:", sslam.relative_pose, a, b, CAMERA, seed=-1)
        self.refuses(ValueError, "start:", sslam.relative_pose, a, b, CAMERA, start=np.diag([1, 1, -1, 1.0]))
        self.refuses(ValueError, "poses[1]:", sslam.triangulate_points, [np.eye(4), 2 * np.eye(4)], np.zeros((1, 2, 2)), CAMERA)
        self.refuses(ValueError, "pixels:", sslam.triangulate_points, SCENE.poses, SCENE.pixels[:, :2], CAMERA)
        self.refuses(ValueError, "segments:", sslam.triangulate_lines, SCENE.poses, SCENE.segments[:, None], CAMERA)
        self.refuses(
            ValueError, "directions:", sslam.triangulate_lines, SCENE.poses, SCENE.views_of_lines, CAMERA, directions=[[1, 0, 0]]
        )
        adjust = (sslam.bundle_adjust, SCENE.poses, SCENE.points)
        self.refuses(ValueError, "pixels:", *adjust, SCENE.pixels[1:], CAMERA)
        self.refuses(ValueError, "segments:", *adjust, SCENE.pixels, CAMERA, lines=SCENE.lines)
        self.refuses(ValueError, "held:", *adjust, SCENE.pixels, CAMERA, held=[True])
        self.refuses(ValueError, "held:", *adjust, SCENE.pixels, CAMERA, held=[False] * 3)
        self.refuses(ValueError, "max_iterations:", *adjust, SCENE.pixels, CAMERA, max_iterations=0)
        self.refuses(ValueError, "camera:", sslam.manhattan_rotation, segments=SCENE.segments)
        self.refuses(ValueError, "prior:", sslam.manhattan_rotation, SCENE.normals, prior=np.zeros((3, 3)))
        self.refuses(ValueError, "weights:", sslam.manhattan_rotation, SCENE.normals, weights=[1.0])
        self.refuses(ValueError, "pose:", sslam.refine_pose, SCENE.points, b, CAMERA, np.full((4, 4), np.nan))
        self.refuses(ValueError, "lines:", sslam.refine_pose, SCENE.points, b, CAMERA, np.eye(4), lines=np.zeros((2, 3)))

    def test_bad_numbers_and_too_few_are_told_by_the_status(self):
        nothing = np.empty((0, 2))
        self.assertEqual(sslam.relative_pose(nothing, nothing, CAMERA).status, sslam.Status.TOO_FEW)
        self.assertEqual(sslam.manhattan_rotation().status, sslam.Status.TOO_FEW)
        normals = np.full((9, 3), np.nan)
        self.assertEqual(sslam.manhattan_rotation(normals).status, sslam.Status.NOT_FINITE)
        infinite = SCENE.pixels[:, 0].copy()
        infinite[3] = np.inf
        self.assertEqual(sslam.relative_pose(infinite, SCENE.pixels[:, 1], CAMERA).status, sslam.Status.NOT_FINITE)
        self.assertEqual(sslam.triangulate_points(np.empty((0, 4, 4)), np.empty((0, 0, 2)), CAMERA).points.shape, (0, 3))
        self.assertEqual(sslam.triangulate_lines(np.empty((0, 4, 4)), np.empty((0, 0, 4)), CAMERA).ends.shape, (0, 2, 3))
        self.assertEqual(
            sslam.bundle_adjust(SCENE.poses, SCENE.points * np.nan, SCENE.pixels, CAMERA).status, sslam.Status.NOT_FINITE
        )
        unseen = SCENE.pixels.copy()
        unseen[0, 1:] = np.nan
        self.assertEqual(sslam.triangulate_points(SCENE.poses, unseen, CAMERA).status[0], sslam.Status.TOO_FEW)

    def test_other_layouts_and_types_give_the_same_answer(self):
        a, b = SCENE.pixels[:, 0], SCENE.pixels[:, 1]
        straight = sslam.relative_pose(a, b, CAMERA)
        turned = sslam.relative_pose(np.asfortranarray(a), b[::-1].copy()[::-1], CAMERA)
        np.testing.assert_array_equal(straight.pose, turned.pose)
        listed = sslam.relative_pose(a.tolist(), b.tolist(), CAMERA)
        np.testing.assert_array_equal(straight.pose, listed.pose)


if __name__ == "__main__":
    unittest.main()
