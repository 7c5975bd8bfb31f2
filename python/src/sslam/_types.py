"""The results of the package, as named tuples of numpy arrays. All arrays are copies: they do not change when the
system continues."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from ._sslam import Camera, NormalStatus, State, Status

Floats = NDArray[np.float64]


class Trajectory(NamedTuple):
    """Poses by increasing stamp."""

    stamps: Floats
    """(N,), seconds"""
    poses: Floats
    """(N, 4, 4), camera to world"""

    @property
    def positions(self) -> Floats:
        """(N, 3), positions of the camera in the world"""
        return self.poses[:, :3, 3]


class Cloud(NamedTuple):
    points: Floats
    """(N, 3), world"""
    colours: NDArray[np.uint8]
    """(N, 3), red, green, blue, as the keyframes' images show each point; 128 each where none does"""


class Lines(NamedTuple):
    ends: Floats
    """(N, 2, 3), both ends of the observed part of each line, world"""
    axis: NDArray[np.int8]
    """(N,), number of the Manhattan axis that each follows; -1: none"""


class Planes(NamedTuple):
    normals: Floats
    """(N, 3), unit, world: the plane holds the points X with normal . X = distance"""
    distances: Floats
    """(N,)"""
    corners: Floats
    """(N, 4, 3), of the rectangle that is covered with points and lines, in order around it, world"""
    axis: NDArray[np.int8]
    """(N,), number of the Manhattan axis that each is normal to; -1: none"""


class Latest(NamedTuple):
    """The latest pose."""

    stamp: float
    """seconds"""
    state: State
    pose: Optional[Floats]
    """(4, 4), camera to world; None: there is none"""
    world: int
    """number of the map that the pose is in; different maps have different coordinates and units"""


class Parameter(NamedTuple):
    name: str
    value: float
    """in `unit`"""
    unit: str
    """share, count, pixels, degrees, seconds; empty: a ratio or a factor"""
    least: float
    most: float
    """infinite if there is no upper limit"""
    meaning: str


class Preset(NamedTuple):
    name: str
    meaning: str
    uses_normals: bool
    can_be_live: bool


@dataclass(frozen=True)
class Frame:
    """A frame of a dataset."""

    image: NDArray[np.uint8]
    """(H, W, 3), blue, green, red, as System.track takes it"""
    stamp: float
    """seconds; in the layout of ICL-NUIM the number of the frame"""
    depth: Optional[NDArray[Any]]
    """(H, W), uint16 in the dataset's unit (Dataset.depth_factor) or float32 in metres; None: there is none"""
    name: str
    """of the image file, without folder and extension"""
    index: int
    """position in the whole recording"""
    pose: Optional[Floats]
    """(4, 4), camera to world, true; None: not known"""
    mask: Optional[NDArray[np.uint8]] = None
    """(H, W), for System.track: 0 where the wide lens that took the image sees nothing; None: no mask is needed"""


class ManhattanRotation(NamedTuple):
    status: Status
    rotation: Floats
    """(3, 3), the axes of the room in the camera frame as columns; to be used where status is OK"""
    covariance: Floats
    """(3, 3), rad^2, of the left perturbation in the camera frame"""
    axes_seen: int
    """number of axes with support, 0 to 3"""
    deviation: float
    """radians: standard deviation about the worst observed axis, by the votes alone"""
    ambiguity: float
    """without a prior: likelihood of the second best Manhattan frame as a share of the best; 0: there is none"""
    axis_of: NDArray[np.int8]
    """(M,), axis 0, 1 or 2 that each segment follows; -1: none"""


class RelativePose(NamedTuple):
    status: Status
    pose: Floats
    """(4, 4), camera 0 to camera 1, its translation of length 1; to be used where status is OK"""
    rotation_covariance: Floats
    """(3, 3), rad^2, of the left perturbation"""
    translation_covariance: Floats
    """(3, 3), rad^2, of rank 2"""
    parallax: float
    """radians, median of the inliers"""
    inliers: NDArray[np.bool_]
    """(N,)"""


class Translation(NamedTuple):
    status: Status
    translation: Floats
    """(3,), of length 1: x1 ~ R x0 + translation / depth0; to be used where status is OK"""
    covariance: Floats
    """(3, 3), rad^2, of rank 2"""
    parallax: float
    """radians, median of the inliers"""
    inliers: NDArray[np.bool_]
    """(N,)"""


class LineSegments(NamedTuple):
    segments: Floats
    """(N, 4), ends u0 v0 u1 v1 in pixels of the image, longest first; the brighter side is on the left of the way"""
    sigma: Floats
    """(N,), pixels: standard deviation of an end across its segment"""


class ImageNormals(NamedTuple):
    """The other fields are None unless the status is OK."""

    status: NormalStatus
    normals: Optional[NDArray[np.float32]]
    """(h, w, 3), unit, in the camera frame, towards the camera; zero where there is none"""
    planar: Optional[NDArray[np.float32]]
    """(h, w), probability of lying on a plane; None if the network has no such output"""
    camera: Optional[Camera]
    """of these pixels, without distortion"""


class Points(NamedTuple):
    status: NDArray[np.uint8]
    """(N,), values of sslam.Status: points[status == sslam.Status.OK] are those to be used"""
    points: Floats
    """(N, 3), world"""
    covariance: Floats
    """(N, 3, 3)"""
    parallax: Floats
    """(N,), radians: largest angle between two of the rays"""
    max_error: Floats
    """(N,), largest reprojection error of a view, standard deviations"""


class TriangulatedLines(NamedTuple):
    status: NDArray[np.uint8]
    """(N,), values of sslam.Status: ends[status == sslam.Status.OK] are those to be used"""
    ends: Floats
    """(N, 2, 3), world: both ends of everything that the views show of each line"""
    covariance: Floats
    """(N, 3, 3), of the middle, across the line"""
    parallax: Floats
    """(N,), radians: largest angle between two of the planes through a camera and its segment"""
    max_error: Floats
    """(N,), largest distance of a segment's end from the line in its image, standard deviations"""
    overlap: Floats
    """(N,), the part that all views show, over the shortest part that one of them shows"""


class BundleAdjustment(NamedTuple):
    status: Status
    """OK or NOT_CONVERGED: the values below are the best state found; otherwise they are the input"""
    poses: Floats
    """(V, 4, 4), camera to world"""
    points: Floats
    """(N, 3), world"""
    lines: Floats
    """(M, 2, 3), world: the points of each line nearest to those that were given"""
    initial_cost: float
    """half the sum of the robust squared errors, in standard deviations"""
    final_cost: float
    iterations: int


class RefinedPose(NamedTuple):
    status: Status
    pose: Floats
    """(4, 4), camera to world; the input unless status is OK"""
    information: Floats
    """(6, 6), inverse covariance of the left perturbation of world to camera, rotation first"""
    point_inliers: NDArray[np.bool_]
    """(N,)"""
    line_inliers: NDArray[np.bool_]
    """(M,)"""
