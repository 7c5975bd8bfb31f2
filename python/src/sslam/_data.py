"""Recordings, trajectories and their evaluation."""

from __future__ import annotations

import os
import warnings
from typing import Any, Iterable, Iterator, Optional, Sequence, Tuple, Union

import numpy as np

from . import _check, _sslam
from ._errors import Error, SslamWarning
from ._sslam import Camera, Evaluation
from ._types import Floats, Frame, Trajectory
from ._wide_lens import view_angle

Path = Union[str, "os.PathLike[str]"]


def _tell(messages: Iterable[str], level: int = 3) -> None:
    for line in messages:
        warnings.warn(line, SslamWarning, stacklevel=level)


class Dataset:
    """A recording: iterate over it for its frames. A frame whose image cannot be read is left out with a warning."""

    def __init__(self, recording: _sslam.Recording) -> None:
        self._recording = recording

    def __len__(self) -> int:
        """Number of listed frames."""
        return len(self._recording)

    def __iter__(self) -> Iterator[Frame]:
        frames = _sslam.Frames(self._recording)
        while True:
            found: Optional[Tuple[Any, ...]] = frames.next(True)
            if found is None:
                return
            image, why, stamp, depth, name, index, pose, mask = found
            if why:
                _tell([f"{why}; frame skipped" if image is None else why])
            if image is not None:
                yield Frame(image, stamp, depth, name, index, pose, mask)

    @property
    def camera(self) -> Camera:
        return self._recording.camera

    @property
    def camera_source(self) -> str:
        """Where the camera comes from: a file, a name, or how it was guessed."""
        return self._recording.camera_source

    @property
    def depth_factor(self) -> float:
        """Value of one metre in its uint16 depth images; 0: not known."""
        return self._recording.depth_factor

    @property
    def has_depth(self) -> bool:
        return self._recording.has_depth

    @property
    def layout(self) -> str:
        """Such as 'TUM RGB-D' or 'folder of images'."""
        return self._recording.layout

    @property
    def seconds_per_stamp(self) -> float:
        """1, except in the layout of ICL-NUIM, whose stamps count frames."""
        return self._recording.seconds_per_stamp

    @property
    def stamps(self) -> Floats:
        """(N,)"""
        return self._recording.stamps()

    @property
    def ground_truth(self) -> Optional[Trajectory]:
        truth = Trajectory(*self._recording.ground_truth())
        return truth if len(truth.stamps) else None


def open_dataset(
    path: Path,
    *,
    topic: Optional[str] = None,
    depth_topic: Optional[str] = None,
    camera: Optional[Path] = None,
    focal: float = 0.0,
    fov: float = 0.0,
    undistort_fov: Optional[float] = None,
    frame_rate: float = 30.0,
    start: int = 0,
    end: Optional[int] = None,
    stride: int = 1,
) -> Dataset:
    """Opens any recorded input of `sslam run`: a folder in a known layout (docs/run.md), a folder or a glob of
    images, a video, or a ROS bag.

    topic, depth_topic: topics of a bag's images and of their depth; not needed if there is only one.
    camera: a camera file or the name of a built-in calibration; else focal (pixels) or fov (horizontal, degrees); else
        the camera of the dataset, or a guess with a warning.
    undistort_fov: horizontal angle in degrees, 30 to 140, of the pinhole view that images of a wide lens are
        undistorted to; default 110, or less if the lens sees less. The dataset's camera and images are those of the
        view.
    frame_rate: frames a second, for images whose names are not stamps.
    start, end, stride: part of the recording.

    Raises sslam.Error if the input cannot be opened.
    """
    for name, value in (("focal", focal), ("fov", fov)):
        if not 0 <= _check.real(name, value) < float("inf"):
            raise ValueError(f"{name}: {value} is not a finite number from 0 on")
    if fov >= 180:
        raise ValueError(f"fov: {fov:g} degrees are out of range: below 180")
    for name, topic_name in (("topic", topic), ("depth_topic", depth_topic)):
        if topic_name is not None:
            _check.text(name, topic_name)
    most = 2**62
    last = -1 if end is None else _check.whole("end", end, 1, most)
    recording = _sslam.open_recording(
        _check.path("path", path),
        topic or "",
        depth_topic or "",
        "" if camera is None else _check.path("camera", camera),
        float(focal),
        float(fov),
        view_angle("undistort_fov", undistort_fov),
        _check.positive("frame_rate", frame_rate),
        _check.whole("start", start, 0, most),
        last,
        _check.whole("stride", stride, 1, most),
    )
    _tell(recording.messages)
    return Dataset(recording)


def read_trajectory(path: Path) -> Trajectory:
    """Reads poses, camera to world, from a file in the format of TUM, EuRoC, KITTI or 4x4 matrices, or from the folder of
    a run. Poses without stamps are numbered from 0. Raises sslam.Error."""
    stamps, poses, _, messages = _sslam.read_trajectory(_check.path("path", path))
    _tell(messages)
    return Trajectory(stamps, poses)


def _trajectory(name: str, value: Union[Trajectory, Sequence[Any]]) -> Trajectory:
    try:
        stamps, poses = value
    except (TypeError, ValueError):
        raise TypeError(f"{name}: expected a path, or stamps (N,) and poses (N, 4, 4)") from None
    times = _check.numbers(f"{name}.stamps", stamps, ("N",))
    matrices = _check.numbers(f"{name}.poses", poses, ("N", 4, 4))
    if len(times) != len(matrices):
        raise ValueError(f"{name}: has {len(times)} stamps for {len(matrices)} poses")
    if not np.isfinite(times).all():
        raise ValueError(f"{name}.stamps: are not all finite")
    if (np.diff(times) <= 0).any():
        raise ValueError(f"{name}.stamps: do not increase")
    return Trajectory(times, matrices)


def write_trajectory(path: Path, trajectory: Trajectory) -> None:
    """Writes poses in the format of TUM, `stamp tx ty tz qx qy qz qw`, camera to world. Raises sslam.Error."""
    checked = _trajectory("trajectory", trajectory)
    _sslam.write_trajectory(_check.path("path", path), *checked)


def _truth(truth: Any) -> Tuple[Trajectory, bool, float, Floats]:
    nothing = np.empty(0)
    if isinstance(truth, Dataset):
        poses = truth.ground_truth
        if poses is None:
            raise Error("truth: this dataset has no ground truth")
        return poses, False, truth.seconds_per_stamp, truth.stamps
    if isinstance(truth, (str, bytes, os.PathLike)):
        stamps, matrices, counted, seconds, frames, messages = _sslam.read_truth(_check.path("truth", truth))
        _tell(messages, 4)
        return Trajectory(stamps, matrices), counted, seconds, frames
    return _trajectory("truth", truth), False, 1.0, nothing


def evaluate(
    truth: Union[Path, Trajectory, Dataset],
    estimate: Union[Path, Trajectory],
    *,
    align: str = "sim3",
    max_difference: float = 0.02,
    frames: int = 0,
) -> Evaluation:
    """Compares a trajectory with ground truth, as `sslam eval` does.

    truth: a Trajectory, a Dataset, or a path: of a file of poses, of a dataset, or of a run.
    estimate: a Trajectory, or the path of a file of poses or of a run.
    align: "sim3" (rotation, translation and scale), "se3" (no scale) or "none".
    max_difference: largest difference between the stamps of a pair.
    frames: number of images of the sequence; not needed if the dataset is known.

    Raises sslam.Error if the two do not overlap or cannot be aligned.
    """
    if align not in ("sim3", "se3", "none"):
        raise ValueError(f"align: {align!r} is not known; use 'sim3', 'se3' or 'none'")
    reference, truth_counted, seconds, frame_stamps = _truth(truth)
    if isinstance(estimate, (str, bytes, os.PathLike)):
        stamps, poses, counted, messages = _sslam.read_trajectory(_check.path("estimate", estimate))
        _tell(messages)
        found = Trajectory(stamps, poses)
    else:
        counted, found = truth_counted, _trajectory("estimate", estimate)
    if counted != truth_counted:
        which = "truth" if truth_counted else "estimate"
        raise Error(f"{which}: its poses have no stamps; put their times into times.txt beside it")
    number = _check.whole("frames", frames, 0, 2**62)
    return _sslam.evaluate(
        *reference,
        *found,
        align,
        _check.positive("max_difference", max_difference),
        np.empty(0) if number else frame_stamps,
        number,
        seconds,
    )
