"""A run for the viewers of other packages, read back with these packages where they are installed."""

import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import sslam
from sslam import _viewers
from room import ROOM, needs_room, run


# Two rectangles of planes, for a run whose map has none: its walk is too short.
CORNERS = np.array([[[0, 0, 1], [2, 0, 1], [2, 3, 1], [0, 3, 1]], [[0, 0, 1], [0, 3, 1], [0, 3, 5], [0, 0, 5]]], np.float64)
COLOURS = np.array([[214, 69, 65], [38, 166, 91]])


def add_planes(folder):
    head, _, body = (folder / "map.ply").read_text().partition("end_header\n")
    count = int(re.search(r"element vertex (\d+)", head)[1])
    rows = body.splitlines()
    vertices = [" ".join(map(str, (*place, *colour))) for corners, colour in zip(CORNERS, COLOURS) for place in corners]
    faces = [" ".join(map(str, (4, *range(count + 4 * i, count + 4 * i + 4), *colour))) for i, colour in enumerate(COLOURS)]
    head = head.replace(f"element vertex {count}", f"element vertex {count + 8}").replace("element face 0", "element face 2")
    rows = [*rows[:count], *vertices, *rows[count:], *faces]
    (folder / "map.ply").write_text("\n".join([head + "end_header", *rows, ""]))


def needs(module):
    return unittest.skipUnless(importlib.util.find_spec(module), f"skipped: no {module}")


@needs_room
class Viewers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = pathlib.Path(cls.scratch.name) / "run"
        run("run", ROOM, "--end", 40, "--normals", "none", "--dense", "--no-report", "--out", cls.folder)
        add_planes(cls.folder)
        cls.map = sslam.load_map(cls.folder / "map.sslam")
        cls.trajectory = sslam.read_trajectory(cls.folder)

    @needs("rerun")
    def test_a_recording_of_rerun_holds_the_run(self):
        from rerun.chunk import RrdReader

        path = self.folder / "run.rrd"
        sslam.to_rerun(self.folder, path)
        rows = {}
        for chunk in RrdReader(path).stream():
            batch = chunk.to_record_batch()
            for name in batch.schema.names:
                rows.setdefault((chunk.entity_path, name), []).extend(batch.column(name))

        def numbers(entity, component):
            return [np.array(row.as_py(), np.float64) for row in rows[entity, component]]

        (points,) = numbers("/world/points", "Points3D:positions")
        np.testing.assert_allclose(points, self.map.points(), atol=1e-5)
        (colours,) = numbers("/world/points", "Points3D:colors")
        self.assertEqual(len(colours), len(points))
        self.assertGreater(len(set(colours)), len(points) / 4)
        (lines,) = numbers("/world/lines", "LineStrips3D:strips")
        np.testing.assert_allclose(lines, self.map.lines().ends, atol=1e-5)
        (corners,) = numbers("/world/planes", "Mesh3D:vertex_positions")
        (triangles,) = numbers("/world/planes", "Mesh3D:triangle_indices")
        np.testing.assert_allclose(corners.reshape(-1, 4, 3), CORNERS)
        (plane_colours,) = rows["/world/planes", "Mesh3D:vertex_colors"]
        seen = [[value >> 24, value >> 16 & 255, value >> 8 & 255] for value in plane_colours.as_py()]
        np.testing.assert_array_equal(seen, np.repeat(COLOURS, 4, axis=0))
        a, b, c = np.moveaxis(corners[triangles.astype(int)], 1, 0)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1).reshape(-1, 2).sum(axis=1) / 2
        np.testing.assert_allclose(areas, [6, 12])  # both halves of each
        ((opacity,),) = numbers("/world/planes", "Mesh3D:albedo_factor")
        self.assertEqual(int(opacity) & 255, 70)
        ((model,),) = (row.as_py() for row in rows["/world/model", "Asset3D:blob"])
        self.assertEqual(bytes(model), _viewers._model_in_map(self.folder / "model.glb"))
        (path_seen,) = numbers("/world/path", "LineStrips3D:strips")
        np.testing.assert_allclose(path_seen[0], self.trajectory.positions, atol=1e-5)
        places = np.stack(numbers("/world/camera", "Transform3D:translation")).reshape(-1, 3)
        np.testing.assert_allclose(places, self.trajectory.positions, atol=1e-5)
        turns = np.stack(numbers("/world/camera", "Transform3D:mat3x3")).reshape(-1, 3, 3)  # by columns
        np.testing.assert_allclose(turns.transpose(0, 2, 1), self.trajectory.poses[:, :3, :3], atol=1e-5)
        times = [row.value for row in rows["/world/camera", "time"]]
        np.testing.assert_allclose(np.array(times) / 1e9, self.trajectory.stamps, atol=1e-6)
        images = rows["/world/camera/image", "EncodedImage:blob"]
        self.assertEqual(len(images), 40)
        self.assertTrue(bytes(images[0].as_py()[0]).startswith(b"\xff\xd8"))

    def test_the_model_is_turned_back_into_the_map(self):
        def parts(glb):
            self.assertEqual((glb[:4], int.from_bytes(glb[8:12], "little"), len(glb) % 4), (b"glTF", len(glb), 0))
            end = 20 + int.from_bytes(glb[12:16], "little")
            return json.loads(glb[20:end]), glb[end:]

        written, bytes_written = parts((self.folder / "model.glb").read_bytes())
        turned_back, bytes_sent = parts(_viewers._model_in_map(self.folder / "model.glb"))
        self.assertEqual(bytes_sent, bytes_written)
        self.assertIn("rotation", written["nodes"][0])
        del written["nodes"][0]["rotation"]
        self.assertEqual(turned_back, written)
        # Its vertices are around the map's points.
        box = [np.array(written["accessors"][0][side]) for side in ("min", "max")]
        points = self.map.points()
        inside = ((box[0] - 0.5 < points) & (points < box[1] + 0.5)).all(axis=1)
        self.assertGreater(inside.mean(), 0.9)

    def test_a_model_that_is_none_is_refused_by_its_name(self):
        path = pathlib.Path(self.scratch.name) / "model.glb"
        for content in (b"", b"glTF", b"glTF" + bytes(12) + b"JSON", b"glTF" + bytes(8) + b"\4\0\0\0JSON[[]]"):
            path.write_bytes(content)
            with self.assertRaisesRegex(sslam.Error, "model.glb: is no model.glb of"):
                _viewers._model_in_map(path)

    @needs("open3d")
    def test_geometries_of_open3d_hold_the_run(self):
        scene = sslam.to_open3d(self.folder)
        np.testing.assert_allclose(np.asarray(scene.points.points), self.map.points(), atol=1e-5)
        colours = np.asarray(scene.points.colors)
        self.assertTrue(((0 <= colours) & (colours <= 1)).all())
        self.assertGreater(len(np.unique(colours, axis=0)), len(colours) / 4)
        ends = np.asarray(scene.lines.points)[np.asarray(scene.lines.lines)]
        np.testing.assert_allclose(ends, self.map.lines().ends, atol=1e-5)
        self.assertEqual(len(scene.lines.colors), len(ends))
        np.testing.assert_allclose(np.asarray(scene.path.points), self.trajectory.positions)
        self.assertEqual(len(scene.path.lines), len(self.trajectory.stamps) - 1)

    @needs("trimesh")
    def test_the_run_s_files_are_read_by_trimesh(self):
        import trimesh

        cloud = trimesh.load(self.folder / "map.ply", process=False)
        np.testing.assert_allclose(cloud.vertices[: len(self.map.points())], self.map.points(), atol=1e-4)
        dense = trimesh.load(self.folder / "model.glb", process=False)
        coloured = trimesh.load(self.folder / "model.ply", process=False)  # the same surfaces in small triangles
        self.assertGreater(dense.area, 1)
        self.assertAlmostEqual(coloured.area / dense.area, 1, delta=0.05)
        low, high = dense.bounds
        (node,) = dense.graph.nodes_geometry
        turn = dense.graph[node][0][:3, :3]  # of the map, so that y is up
        self.assertLess(turn[1, 1], -0.9)
        points = self.map.points() @ turn.T
        inside = ((low - 0.5 < points) & (points < high + 0.5)).all(axis=1)
        self.assertGreater(inside.mean(), 0.9)
        run("export", self.folder, "--format", "glb", "--out", self.folder / "glb")
        self.assertGreater(len(trimesh.load(self.folder / "glb" / "model.glb").geometry), 0)

    def test_packages_are_imported_late_and_named_where_they_are_missing(self):
        late = "import sys, sslam; sys.exit(any(name in sys.modules for name in ('rerun', 'open3d')))"
        self.assertEqual(subprocess.run([sys.executable, "-c", late]).returncode, 0)
        hidden = f"import sys; sys.modules['open3d'] = None; import sslam; sslam.to_open3d({str(self.folder)!r})"
        done = subprocess.run([sys.executable, "-c", hidden], capture_output=True, text=True)
        self.assertIn("ImportError: open3d: is not installed; pip install open3d", done.stderr)

    def test_what_is_no_run_is_refused_by_its_name(self):
        empty = pathlib.Path(self.scratch.name) / "empty"
        empty.mkdir()
        for write in (sslam.to_open3d, lambda folder: sslam.to_rerun(folder, empty / "out.rrd")):
            with self.assertRaisesRegex(sslam.Error, f"{empty}: has no frames.csv"):
                write(empty)
        (empty / "frames.csv").write_text("index\n")
        (empty / "map.ply").write_text("ply\nelement vertex 3\nend_header\n0 0 0\n")
        with self.assertRaisesRegex(sslam.Error, "map.ply: is no map.ply of"):
            sslam.to_open3d(empty)
        with self.assertRaisesRegex(TypeError, "run: expected a path"):
            sslam.to_open3d(5)


if __name__ == "__main__":
    unittest.main()
