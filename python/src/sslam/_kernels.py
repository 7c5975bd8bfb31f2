"""Kernels on arrays. Pixels are those of the camera's images, with their distortion; sigmas are standard deviations.
They return a status, and raise only for invalid arguments: a wrong shape, a matrix that is not a rotation."""

from __future__ import annotations

import math
import os
from typing import Any, Optional, Union

import numpy as np

from . import _check, _sslam
from ._settings import as_camera
from ._sslam import Camera, Status
from ._types import ManhattanRotation, RefinedPose, RelativePose, Translation

CameraOrPath = Union[Camera, str, "os.PathLike[str]"]


def _matches(pixels0: Any, pixels1: Any) -> Any:
    a = _check.numbers("pixels0", pixels0, ("N", 2))
    b = _check.numbers("pixels1", pixels1, ("N", 2))
    if len(a) != len(b):
        raise ValueError(f"pixels1: has {len(b)} rows, and pixels0 {len(a)}: a row is a match")
    return a, b


def manhattan_rotation(
    normals: Any = None,
    segments: Any = None,
    prior: Any = None,
    *,
    camera: Optional[CameraOrPath] = None,
    weights: Any = None,
    sigma: float = 1.0,
    prior_sigma_deg: float = 10.0,
    normals_sigma_deg: float = 0.0,
    seed: int = 1,
) -> ManhattanRotation:
    """The rotation of the room's three axes in the camera frame, from surface normals, line segments or both.

    normals: (N, 3), unit, in the camera frame (x right, y down, z forward), towards the camera.
    segments: (M, 4), ends u0 v0 u1 v1 in pixels of `camera`; sigma: of an end across the segment, pixels.
    prior: (3, 3), the prediction, such as the rotation of the last frame: the result is near it, with the same names
        of the axes; prior_sigma_deg: its standard deviation. Without a prior, all of SO(3) is searched, and the axes
        are named so that the rotation is closest to the identity.
    weights: (N,), 0 to 1, of the normals.
    normals_sigma_deg: common error of the normals of one plane, degrees.
    """
    votes = _check.numbers("normals", np.empty((0, 3)) if normals is None else normals, ("N", 3), np.float32)
    ends = _check.numbers("segments", np.empty((0, 4)) if segments is None else segments, ("M", 4))
    lens = None if camera is None else as_camera("camera", camera)
    if len(ends) and lens is None:
        raise ValueError("camera: is needed, since segments are in its pixels")
    if weights is not None:
        weights = _check.numbers("weights", weights, ("N",), np.float32)
        if len(weights) != len(votes):
            raise ValueError(f"weights: has {len(weights)} numbers for {len(votes)} normals")
    if prior is not None:
        prior = _check.numbers("prior", prior, (3, 3))
    floor = _check.real("normals_sigma_deg", normals_sigma_deg)
    if not 0 <= floor < 90:
        raise ValueError(f"normals_sigma_deg: {floor:g} is out of range: 0 to 90")
    return ManhattanRotation(
        *_sslam.manhattan_rotation(
            votes,
            weights,
            ends,
            lens,
            _check.positive("sigma", sigma),
            prior,
            math.radians(_check.positive("prior_sigma_deg", prior_sigma_deg)),
            math.radians(floor),
            _check.whole("seed", seed, 0, 2**64 - 1),
        )
    )


def relative_pose(
    pixels0: Any, pixels1: Any, camera: CameraOrPath, *, start: Any = None, sigma: float = 1.0, seed: int = 1
) -> RelativePose:
    """The motion between two views, up to its length, from matches. Some of them may be wrong.

    pixels0, pixels1: (N, 2), matches in both images, pixels; sigma: of each coordinate, pixels.
    start: (4, 4), camera 0 to camera 1: an estimate to refine. Without it, the motion is searched for, with turns up
        to about 10 degrees.
    """
    a, b = _matches(pixels0, pixels1)
    if start is not None:
        start = _check.numbers("start", start, (4, 4))
    lens, noise = as_camera("camera", camera), _check.positive("sigma", sigma)
    return RelativePose(*_sslam.relative_pose(a, b, lens, noise, start, _check.whole("seed", seed, 0, 2**64 - 1)))


def translation_from_rotation(
    pixels0: Any,
    pixels1: Any,
    rotation: Any,
    camera: CameraOrPath,
    *,
    sigma: float = 1.0,
    rotation_sigma_deg: float = 0.0,
    seed: int = 1,
) -> Translation:
    """The direction of the motion between two views whose rotation is known.

    rotation: (3, 3), camera 0 to camera 1; rotation_sigma_deg: its standard deviation about each axis, degrees.
    pixels0, pixels1, sigma: as in relative_pose.
    """
    a, b = _matches(pixels0, pixels1)
    turn = _check.real("rotation_sigma_deg", rotation_sigma_deg)
    if not 0 <= turn < 90:
        raise ValueError(f"rotation_sigma_deg: {turn:g} is out of range: 0 to 90")
    return Translation(
        *_sslam.translation_from_rotation(
            a,
            b,
            _check.numbers("rotation", rotation, (3, 3)),
            as_camera("camera", camera),
            _check.positive("sigma", sigma),
            math.radians(turn),
            _check.whole("seed", seed, 0, 2**64 - 1),
        )
    )


def refine_pose(
    points: Any,
    pixels: Any,
    camera: CameraOrPath,
    pose: Any,
    *,
    lines: Any = None,
    segments: Any = None,
    sigma: float = 1.0,
) -> RefinedPose:
    """A camera's pose from points and lines of a map that it sees. Some of them may be wrong.

    points, pixels: (N, 3) in the world, and (N, 2) in the image; sigma: of each coordinate, pixels.
    lines, segments: (M, 2, 3), two points on each line in the world, and (M, 4), ends u0 v0 u1 v1 of what the image
        shows of it, pixels.
    pose: (4, 4), camera to world, to start from.
    """
    places = _check.numbers("points", points, ("N", 3))
    seen = _check.numbers("pixels", pixels, ("N", 2))
    if len(places) != len(seen):
        raise ValueError(f"pixels: has {len(seen)} rows for {len(places)} points")
    edges = _check.numbers("lines", np.empty((0, 2, 3)) if lines is None else lines, ("M", 2, 3))
    ends = _check.numbers("segments", np.empty((0, 4)) if segments is None else segments, ("M", 4))
    if len(edges) != len(ends):
        raise ValueError(f"segments: has {len(ends)} rows for {len(edges)} lines")
    return RefinedPose(
        *_sslam.refine_pose(
            places,
            seen,
            edges,
            ends,
            as_camera("camera", camera),
            _check.numbers("pose", pose, (4, 4)),
            _check.positive("sigma", sigma),
        )
    )


__all__ = [
    "Status",
    "manhattan_rotation",
    "refine_pose",
    "relative_pose",
    "translation_from_rotation",
]
