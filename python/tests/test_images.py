"""Kernels on images: line segments and normals are those of the system and of the command line."""

import pathlib
import tempfile
import unittest

import numpy as np

import sslam
from room import ROOM, frames, needs_room, run, system


class Segments(unittest.TestCase):
    def test_the_sides_of_a_square_are_found_where_they_are(self):
        image = np.zeros((240, 320), np.uint8)
        image[60:180, 80:240] = 200
        found = sslam.line_segments(image)
        self.assertEqual(found.segments.shape, (4, 4))
        self.assertEqual(found.sigma.shape, (4,))
        u, v = found.segments.reshape(-1, 2, 2).transpose(2, 0, 1)
        across = [(np.abs(u - at).max(axis=1) < 0.3).sum() for at in (79.5, 239.5)]
        down = [(np.abs(v - at).max(axis=1) < 0.3).sum() for at in (59.5, 179.5)]
        self.assertEqual((across, down), ([1, 1], [1, 1]))
        coloured = np.dstack([np.zeros_like(image), np.zeros_like(image), image])  # red, as OpenCV has it
        weak = sslam.line_segments(coloured, colours="rgb")  # taken for blue, which is darker
        np.testing.assert_allclose(sslam.line_segments(coloured).segments, found.segments, atol=0.2)
        self.assertEqual(len(weak.segments), 4)
        self.assertEqual(len(sslam.line_segments(image, lines__max_lines=2).segments), 2)
        self.assertEqual(sslam.line_segments(np.zeros((240, 320), np.uint8)).segments.shape, (0, 4))

    @needs_room
    def test_they_are_those_of_the_system(self):
        for frame in frames()[::20]:
            self.assertEqual(len(sslam.line_segments(frame.image).segments), system().track(frame.image, 0.0).lines)

    def test_what_is_no_input_is_refused_by_its_name(self):
        image = np.zeros((240, 320), np.uint8)
        for kind, start, arguments, words in (
            (TypeError, "image: ", (image.astype(float),), {}),
            (TypeError, "image: ", (None,), {}),
            (ValueError, "colours: ", (image,), {"colours": "bgra"}),
            (TypeError, "line_segments: no argument max_lines", (image,), {"max_lines": 3}),
            (sslam.SettingsError, "parameters: keyframes.max_turn", (image,), {"keyframes__max_turn": 3}),
            (sslam.SettingsError, "parameters: lines.max_lines", (image,), {"lines__max_lines": -1}),
        ):
            with self.assertRaises(kind) as caught:
                sslam.line_segments(*arguments, **words)
            self.assertTrue(str(caught.exception).startswith(start), str(caught.exception))


@needs_room
class Normals(unittest.TestCase):
    def setUp(self):
        try:
            self.network = sslam.NormalNetwork()
        except sslam.Error as missing:
            self.skipTest(f"skipped: {missing}")

    def test_they_are_those_of_the_command_line(self):
        camera = sslam.Camera.from_file(ROOM / "camera.yaml")
        found = self.network(frames()[0].image, camera)
        self.assertEqual(found.status, sslam.NormalStatus.OK)
        size = (found.camera.height, found.camera.width)
        self.assertEqual((found.normals.shape, found.planar.shape), ((*size, 3), size))
        length = np.linalg.norm(found.normals, axis=2)
        self.assertTrue(((np.abs(length - 1) < 1e-5) | (length == 0)).all())
        seen = found.normals[found.planar > 0.5]
        self.assertGreater(len(seen), 0.3 * found.planar.size)
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            image = sorted((ROOM / "rgb").iterdir())[0]
            run("normals", image, "--camera", ROOM / "camera.yaml", "--out", out / "normals")
            given = sslam.System(camera, normals=f"files:{out / 'normals'}")
            rotation = sslam.manhattan_rotation(seen[::7])
            self.assertEqual(rotation.status, sslam.Status.OK)
            self.assertEqual(given.track(frames()[0].image, 0.0, name=image.stem).normals_status, "ok")
        rgb = self.network(frames()[0].image[:, :, ::-1], camera, colours="rgb")
        np.testing.assert_array_equal(rgb.normals, found.normals)

    def test_what_is_no_input_is_refused_by_its_name(self):
        camera = sslam.Camera.from_file(ROOM / "camera.yaml")
        with self.assertRaisesRegex(ValueError, "^image: has 160x120 pixels; the camera's images have 320x240"):
            self.network(frames()[0].image[::2, ::2], camera)
        with self.assertRaisesRegex(TypeError, "^camera: "):
            self.network(frames()[0].image, None)
        with self.assertRaisesRegex(sslam.Error, "nowhere"):
            sslam.NormalNetwork("/nowhere/net.onnx")
        small = sslam.Camera(60, 60, 39.5, 29.5, 80, 60)
        found = self.network(np.zeros((60, 80), np.uint8), small)
        self.assertEqual((found.status, found.normals), (sslam.NormalStatus.TOO_SMALL, None))


if __name__ == "__main__":
    unittest.main()
