"""Converts the folder of a run for viewers of other packages, which are imported on demand."""

from __future__ import annotations

import csv
import importlib
import json
import os
import pathlib
import warnings
from typing import Any, Dict, Iterator, List, NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _check
from ._data import _tell, open_dataset, read_trajectory
from ._errors import Error
from ._types import Floats, Frame, Trajectory

Path = Union[str, "os.PathLike[str]"]


def _package(name: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as missing:
        if missing.name != name:
            raise
        raise ImportError(f"{name}: is not installed; pip install {package}") from None


class _Cloud(NamedTuple):
    """What map.ply of a run holds, colours from 0 to 255."""

    points: Floats
    point_colours: NDArray[np.uint8]
    ends: Floats
    line_colours: NDArray[np.uint8]
    corners: Floats
    """of planes, four each, in order around them"""
    plane_colours: NDArray[np.uint8]


def _read_cloud(path: pathlib.Path) -> _Cloud:
    """Points stand first, then two ends of each line and four corners of each plane, as the file's own comment tells."""
    try:
        text = path.read_text(encoding="ascii")
        head, _, body = text.partition("end_header\n")
        count = {row[1]: int(row[2]) for row in map(str.split, head.splitlines()) if row[0] == "element"}
        rows = body.splitlines()[: count["vertex"]]
        vertices = np.array([row.split() for row in rows], np.float64).reshape(count["vertex"], 6)
    except OSError as error:
        raise Error(f"{path}: cannot open: {error.strerror}") from None
    except (ValueError, KeyError, IndexError):
        raise Error(f"{path}: is no map.ply of `sslam run`") from None
    lines, planes = count.get("edge", 0), count.get("face", 0)
    points = len(vertices) - 2 * lines - 4 * planes
    places, colours = vertices[:, :3], vertices[:, 3:].astype(np.uint8)
    of_lines, of_planes = slice(points, points + 2 * lines), slice(points + 2 * lines, None)
    return _Cloud(
        places[:points],
        colours[:points],
        places[of_lines].reshape(-1, 2, 3),
        colours[of_lines][::2],
        places[of_planes].reshape(-1, 4, 3),
        colours[of_planes][::4],
    )


def _model_in_map(path: pathlib.Path) -> bytes:
    """A model.glb of `sslam run --dense`, without the turn of its node that makes y point up: in the map's coordinates."""
    try:
        glb = path.read_bytes()
        if glb[:4] != b"glTF" or glb[16:20] != b"JSON":
            raise ValueError
        end = 20 + int.from_bytes(glb[12:16], "little")
        scene = json.loads(glb[20:end])
        for node in scene["nodes"]:
            node.pop("rotation", None)
        text = json.dumps(scene, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
    except OSError as error:
        raise Error(f"{path}: cannot open: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, AttributeError):
        raise Error(f"{path}: is no model.glb of `sslam run --dense`") from None
    rest = glb[end:]
    sizes = (number.to_bytes(4, "little") for number in (20 + len(text) + len(rest), len(text)))
    return glb[:8] + next(sizes) + next(sizes) + b"JSON" + text + rest


class _Run:
    def __init__(self, folder: Path) -> None:
        self.folder = pathlib.Path(_check.path("run", folder))
        if not (self.folder / "frames.csv").is_file():
            raise Error(f"{self.folder}: has no frames.csv; expected the folder that `sslam run --out` has written to")
        self.cloud = _read_cloud(self.folder / "map.ply")
        self.trajectory: Trajectory = read_trajectory(self.folder)

    def frames(self) -> List[Dict[str, str]]:
        with open(self.folder / "frames.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def metrics(self) -> Dict[str, Any]:
        path = self.folder / "metrics.json"
        try:
            found: Dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
            return found
        except (OSError, ValueError) as error:
            raise Error(f"{path}: cannot be read: {error}") from None


def _images(run: _Run, settings: Dict[str, Any]) -> Iterator[Frame]:
    """The run's images if its dataset still exists; else a warning."""
    wanted = {int(row["index"]) for row in run.frames()}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what the run itself has told
            dataset = open_dataset(settings["dataset"])
    except Error as error:
        _tell([f"{error}; the recording has no images"], 4)
        return
    for frame in dataset:
        if frame.index in wanted:
            yield frame


def to_rerun(run: Path, out: Path, *, images: bool = True) -> None:
    """Writes a run as a recording for the Rerun viewer (`rerun out.rrd`). Needs the package rerun-sdk.

    run: the folder that `sslam run --out` has written to.
    out: the file, *.rrd. An older one is overwritten.
    images: adds the images of the run's dataset as JPEG; a warning if it no longer exists.

    world/points and world/lines have their observed colours, world/planes are the map's planes (translucent),
    world/model is the textured model of `--dense` if the run has one. world/path is the camera's path, world/camera its
    pose over time, world/camera/image the camera and its images, inliers the number of features that agree with each
    frame's pose.

    Raises sslam.Error for a folder that is not a run, and ImportError without the package.
    """
    source = _Run(run)
    rr = _package("rerun", "rerun-sdk")
    target = pathlib.Path(_check.path("out", out))
    if not target.parent.is_dir():
        raise Error(f"out: {target.parent} is no folder")
    settings = source.metrics().get("settings", {})
    glb = source.folder / "model.glb"
    model = _model_in_map(glb) if glb.is_file() else None
    rec = rr.RecordingStream("sslam")
    rec.save(target)
    rec.log("world", rr.ViewCoordinates.RDF, static=True)
    cloud = source.cloud
    rec.log("world/points", rr.Points3D(cloud.points, colors=cloud.point_colours), static=True)
    rec.log("world/lines", rr.LineStrips3D(cloud.ends, colors=cloud.line_colours), static=True)
    if len(cloud.corners):
        faces = np.arange(4 * len(cloud.corners), dtype=np.uint32).reshape(-1, 4)
        planes = rr.Mesh3D(
            vertex_positions=cloud.corners.reshape(-1, 3),
            triangle_indices=faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3),
            vertex_colors=np.repeat(cloud.plane_colours, 4, axis=0),
            albedo_factor=[255, 255, 255, 70],
        )
        rec.log("world/planes", planes, static=True)
    if model is not None:
        rec.log("world/model", rr.Asset3D(contents=model, media_type="model/gltf-binary"), static=True)
    rec.log("world/path", rr.LineStrips3D([source.trajectory.positions]), static=True)
    if "pinhole" in settings and "image_size" in settings:
        fx, fy, cx, cy = settings["pinhole"]
        camera = rr.Pinhole(focal_length=[fx, fy], principal_point=[cx + 0.5, cy + 0.5], resolution=settings["image_size"])
        rec.log("world/camera/image", camera, static=True)

    seconds_per_stamp = settings.get("seconds_per_stamp", 1.0)

    def at(stamp: float) -> None:
        seconds = stamp * seconds_per_stamp
        since_1970 = seconds > 1e8
        rec.set_time("time", **{"timestamp" if since_1970 else "duration": seconds})

    for stamp, pose in zip(*source.trajectory):
        at(stamp)
        rec.log("world/camera", rr.Transform3D(translation=pose[:3, 3], mat3x3=pose[:3, :3]))
    for row in source.frames():
        at(float(row["stamp"]))
        rec.log("inliers", rr.Scalars(int(row["point_inliers"]) + int(row["line_inliers"])))
    if images:
        for frame in _images(source, settings):
            at(frame.stamp)
            rec.log("world/camera/image", rr.Image(frame.image, color_model="BGR").compress(jpeg_quality=80))
    rec.flush()
    rec.disconnect()


class Open3dScene(NamedTuple):
    """Geometries of Open3D, in the coordinates of the run's map: open3d.visualization.draw_geometries(list(scene))."""

    points: Any
    """PointCloud, in the colours that were seen"""
    lines: Any
    """LineSet, likewise"""
    path: Any
    """LineSet, from pose to pose of the camera"""


def to_open3d(run: Path) -> Open3dScene:
    """The map and the path of a run as Open3D's geometries. Needs the package open3d.

    run: the folder that `sslam run --out` has written to.

    Raises sslam.Error for a folder that is not a run, and ImportError without the package.
    """
    source = _Run(run)
    o3d = _package("open3d", "open3d")
    cloud = source.cloud

    def line_set(places: Floats, pairs: NDArray[np.int32], colours: Any) -> Any:
        lines = o3d.geometry.LineSet(o3d.utility.Vector3dVector(places), o3d.utility.Vector2iVector(pairs))
        lines.colors = o3d.utility.Vector3dVector(np.array(np.broadcast_to(colours, (len(pairs), 3))))
        return lines

    points = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(cloud.points))
    points.colors = o3d.utility.Vector3dVector(cloud.point_colours / 255)
    positions = source.trajectory.positions
    ends = np.arange(2 * len(cloud.ends), dtype=np.int32).reshape(-1, 2)
    steps = np.stack([np.arange(len(positions) - 1), np.arange(1, len(positions))], axis=1).astype(np.int32)
    return Open3dScene(
        points,
        line_set(cloud.ends.reshape(-1, 3), ends, cloud.line_colours / 255),
        line_set(positions, steps, (1.0, 0.5, 0.0)),
    )
