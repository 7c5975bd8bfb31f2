"""
The compiled part of sslam: use the package `sslam`, which checks arguments.
"""

from collections.abc import Mapping
import enum
import os
from typing import Annotated, Any

import numpy
import numpy.typing
from numpy.typing import NDArray


class Status(enum.IntEnum):
    """
    The result code of a kernel: one for success, and one for each kind of failure.
    """

    OK = 0
    """the result may be used"""

    TOO_FEW = 1
    """fewer observations than unknowns, or than the minimum"""

    DEGENERATE = 2
    """the observations do not determine the result in some direction"""

    LOW_PARALLAX = 3
    """the views are too close together for a depth"""

    BEHIND = 4
    """the result lies behind a camera"""

    NO_CONSENSUS = 5
    """no model agrees with enough of the observations"""

    NOT_CONVERGED = 6
    """the iterations ran out; the best state so far is returned"""

    NOT_FINITE = 7
    """an input was NaN or infinite"""

class Camera:
    """
    A pinhole camera with radial-tangential distortion, OpenCV's model. Focal lengths fx, fy and the
    principal point cx, cy are in pixels; the middle of the top left pixel is (0, 0). width and height
    are those of its images, pixels.
    """

    def __init__(self, fx: float, fy: float, cx: float, cy: float, width: int, height: int, k1: float = 0.0, k2: float = 0.0, p1: float = 0.0, p2: float = 0.0, k3: float = 0.0) -> None: ...

    @staticmethod
    def from_file(path: str | os.PathLike[str]) -> Camera:
        """
        Reads a camera file in any format that docs/inputs.md lists. Raises sslam.Error.
        """

    @property
    def fx(self) -> float: ...

    @property
    def fy(self) -> float: ...

    @property
    def cx(self) -> float: ...

    @property
    def cy(self) -> float: ...

    @property
    def k1(self) -> float: ...

    @property
    def k2(self) -> float: ...

    @property
    def p1(self) -> float: ...

    @property
    def p2(self) -> float: ...

    @property
    def k3(self) -> float: ...

    @property
    def width(self) -> int:
        """pixels"""

    @property
    def height(self) -> int:
        """pixels"""

    @property
    def matrix(self) -> NDArray[numpy.float64]:
        """K, (3, 3)"""

    def __eq__(self, other: object) -> bool: ...

    def __hash__(self) -> int: ...

    def __reduce__(self) -> tuple[Any, ...]: ...

    def __repr__(self) -> str: ...

class Lens:
    def __init__(self, path: str | os.PathLike[str], fov: float) -> None: ...

    @property
    def camera(self) -> Camera: ...

    @property
    def fov(self) -> float: ...

    @property
    def warnings(self) -> list[str]: ...

    def image(self, image: numpy.typing.NDArray[numpy.uint8]) -> numpy.typing.NDArray[numpy.uint8]: ...

    def mask(self, mask: numpy.typing.NDArray[numpy.uint8] | None) -> numpy.typing.NDArray[numpy.uint8]: ...

def is_wide(path: str | os.PathLike[str]) -> bool: ...

class Map:
    """A map that was read from a file."""

    @staticmethod
    def load(arg: str | os.PathLike[str], /) -> Map: ...

    def points(self) -> NDArray[numpy.float64]: ...

    def lines(self) -> tuple[Any, ...]: ...

    def planes(self) -> tuple[Any, ...]: ...

    def keyframes(self) -> tuple[Any, ...]: ...

class State(enum.IntEnum):
    """State of tracking."""

    INITIALISING = 0
    """no map yet"""

    MANHATTAN = 1
    """rotation from the Manhattan frame, translation from points and lines"""

    FALLBACK = 2
    """full pose from points and lines"""

    UNCERTAIN = 3
    """a pose too uncertain to build the map on"""

    LOST = 4
    """no pose"""

class Reason(enum.IntEnum):
    """Why a frame has its state."""

    FINE = 0
    """no reason"""

    TOO_FEW_FEATURES = 1
    """the image shows too little"""

    TOO_FEW_MATCHES = 2
    """too few features of the reference frame, or of the map, are matched"""

    LOW_PARALLAX = 3
    """the camera has only turned or stood still: no depth yet"""

    NO_CONSENSUS = 4
    """the matches do not agree on one motion"""

    NO_MANHATTAN_FRAME = 5
    """no Manhattan evidence in this image"""

    MANHATTAN_REJECTED = 6
    """the Manhattan pose disagrees with the map"""

    UNCERTAIN_POSE = 7
    """enough matches, but the pose is too uncertain"""

    RELOCALISED = 8
    """found again after a loss"""

class Result:
    """The result of System.track for one frame."""

    @property
    def pose(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        camera to world, (4, 4), in units of the map; None if the frame has no pose
        """

    @property
    def covariance(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        (6, 6), of xi in pose @ Exp(xi), in the camera's axes: rotation first, rad^2, then the position, units of the map squared. The map counts as exact. None if the pose was not refined against the map: there is no pose, the frame began the map, or the preset is 'odometry'
        """

    @property
    def index(self) -> int:
        """number of the frame, from 0"""

    @property
    def stamp(self) -> float:
        """seconds"""

    @property
    def state(self) -> State: ...

    @property
    def reason(self) -> Reason: ...

    @property
    def world(self) -> int:
        """
        number of the map that the pose is in; each new map has its own until maps are joined
        """

    @property
    def inliers(self) -> int:
        """features that agree with the pose"""

    @property
    def point_inliers(self) -> int: ...

    @property
    def line_inliers(self) -> int: ...

    @property
    def points(self) -> int:
        """point features found in the image"""

    @property
    def lines(self) -> int:
        """line features found in the image"""

    @property
    def normals(self) -> int:
        """surface normals found in the image"""

    @property
    def normals_asked(self) -> str:
        """why normals were computed; empty: they were not"""

    @property
    def normals_status(self) -> str:
        """'ok', or why there are no normals"""

    @property
    def axes_seen(self) -> int:
        """Manhattan axes with support, 0 to 3"""

    @property
    def structure(self) -> bool:
        """the Manhattan rotation took part in the pose, and agrees with it"""

    @property
    def image_fixed(self) -> int:
        """number of features left out because they never move in the image"""

    @property
    def keyframe(self) -> bool:
        """the frame became a keyframe of the map"""

    @property
    def loop_closed(self) -> bool:
        """a loop was closed: a place was recognised, and the map has changed"""

    @property
    def maps_joined(self) -> bool:
        """two maps were joined: this one and one that had been left"""

    @property
    def map_changed(self) -> bool:
        """the map changed: one of the events above, or another map began"""

    @property
    def warnings(self) -> list[str]:
        """a line each"""

    @property
    def timings(self) -> dict[str, float]:
        """
        milliseconds of wall clock by name; 'frame' is 'extraction' and 'tracking' together
        """

    def __repr__(self) -> str: ...

class Tracking:
    """The implementation of sslam.System."""

    def __init__(self, arg0: Camera, arg1: str, arg2: str, arg3: Mapping[str, float], arg4: int, arg5: bool, arg6: int, arg7: bool, arg8: float, arg9: float, /) -> None: ...

    def track(self, image: Annotated[NDArray[Any], dict(device='cpu', writable=False)], stamp: float, depth: Annotated[NDArray[Any], dict(device='cpu', writable=False)] | None, mask: Annotated[NDArray[Any], dict(device='cpu', writable=False)] | None, normals: Annotated[NDArray[Any], dict(device='cpu', writable=False)] | None, name: str, rgb: bool) -> Result: ...

    def finish(self) -> bool: ...

    def load(self, arg: str | os.PathLike[str], /) -> None: ...

    def localise_only(self, arg: bool, /) -> None: ...

    def save(self, arg: str | os.PathLike[str], /) -> None: ...

    def save_trajectory(self, arg: str | os.PathLike[str], /) -> None: ...

    def trajectory(self) -> tuple[Any, ...]: ...

    def bridged(self) -> NDArray[numpy.float64]: ...

    def points(self) -> NDArray[numpy.float64]: ...

    def cloud(self) -> tuple[Any, ...]: ...

    def lines(self) -> tuple[Any, ...]: ...

    def planes(self) -> tuple[Any, ...]: ...

    def keyframes(self) -> tuple[Any, ...]: ...

    def latest(self) -> tuple[Any, ...]: ...

    def parameters(self) -> list[Any]: ...

    @property
    def camera(self) -> Camera: ...

    @property
    def reads_depth(self) -> bool: ...

    @property
    def read_out(self) -> float: ...

    @property
    def frames(self) -> int: ...

def presets() -> list[Any]: ...

def preset_parameters(arg: str, /) -> list[Any]: ...

def manhattan_rotation(normals: Annotated[NDArray[numpy.float32], dict(order='C', device='cpu', writable=False)], weights: Annotated[NDArray[numpy.float32], dict(order='C', device='cpu', writable=False)] | None, segments: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], camera: Camera | None, sigma: float, prior: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)] | None, prior_sigma: float, plane_sigma: float, seed: int) -> tuple[Any, ...]: ...

def relative_pose(pixels0: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], pixels1: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], camera: Camera, sigma: float, start: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)] | None, seed: int) -> tuple[Any, ...]: ...

def translation_from_rotation(arg0: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg2: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg3: Camera, arg4: float, arg5: float, arg6: int, /) -> tuple[Any, ...]: ...

def refine_pose(arg0: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg2: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg3: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg4: Camera, arg5: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg6: float, /) -> tuple[Any, ...]: ...

class NormalStatus(enum.IntEnum):
    """Whether an image has normals, or why not."""

    OK = 0

    NO_INPUT = 1
    """no depth image, or no file of normals"""

    UNREADABLE = 2
    """a file that cannot be decoded"""

    WRONG_SIZE = 3
    """the shape does not fit the camera's images"""

    WRONG_TYPE = 4
    """the wrong type of pixels"""

    FACES_AWAY = 5
    """most normals point away from the camera"""

    TOO_SMALL = 6
    """the image has too few pixels for the network"""

    BAD_OUTPUT = 7
    """
    the network's values are not finite, not of unit length or not in their range
    """

    OUT_OF_RANGE = 8
    """hardly any depth is in the range that is used"""

    NO_EVIDENCE = 9
    """too few pixels are planar, or their normals disagree"""

def line_segments(arg0: Annotated[NDArray[Any], dict(device='cpu', writable=False)], arg1: bool, arg2: Mapping[str, float], /) -> tuple[Any, ...]: ...

class Network:
    def __init__(self, arg: str | os.PathLike[str], /) -> None: ...

    def normals(self, arg0: Annotated[NDArray[Any], dict(device='cpu', writable=False)], arg1: bool, arg2: Camera, /) -> tuple[Any, ...]: ...

def triangulate_points(arg0: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg2: Camera, arg3: float, arg4: float, /) -> tuple[Any, ...]: ...

def triangulate_lines(arg0: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg2: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg3: Camera, arg4: float, arg5: float, /) -> tuple[Any, ...]: ...

def bundle_adjust(arg0: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg2: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg3: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg4: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg5: Camera, arg6: Annotated[NDArray[numpy.bool_], dict(order='C', device='cpu', writable=False)], arg7: float, arg8: int, /) -> tuple[Any, ...]: ...

class Recording:
    @property
    def camera(self) -> Camera: ...

    @property
    def camera_source(self) -> str: ...

    @property
    def depth_factor(self) -> float: ...

    @property
    def layout(self) -> str: ...

    @property
    def messages(self) -> list[str]: ...

    @property
    def seconds_per_stamp(self) -> float: ...

    @property
    def has_depth(self) -> bool: ...

    def __len__(self) -> int: ...

    def stamps(self) -> NDArray[numpy.float64]: ...

    def ground_truth(self) -> tuple[Any, ...]: ...

def open_recording(path: str | os.PathLike[str], topic: str, depth_topic: str, camera: str, focal: float, fov: float, undistort_fov: float, frame_rate: float, start: int, end: int, stride: int) -> Recording: ...

class Frames:
    def __init__(self, arg: Recording, /) -> None: ...

    def next(self, with_depth: bool) -> tuple[Any, ...] | None: ...

class Statistics:
    """Summary of a list of errors; if count is 0, so is everything else."""

    @property
    def count(self) -> int: ...

    @property
    def rmse(self) -> float: ...

    @property
    def mean(self) -> float: ...

    @property
    def median(self) -> float: ...

    @property
    def deviation(self) -> float:
        """standard deviation of the population"""

    @property
    def min(self) -> float: ...

    @property
    def max(self) -> float: ...

    def __repr__(self) -> str: ...

class RelativeError:
    """Errors of the motion over a step of time."""

    @property
    def step(self) -> float: ...

    @property
    def unit(self) -> str: ...

    @property
    def translation(self) -> Statistics:
        """metres"""

    @property
    def rotation(self) -> Statistics:
        """radians"""

class Evaluation:
    """
    How good a trajectory is, as the tools of the TUM RGB-D benchmark define it.
    """

    @property
    def position(self) -> Statistics:
        """absolute trajectory error: distances after alignment, metres"""

    @property
    def rotation(self) -> Statistics:
        """angles after the same alignment, radians"""

    @property
    def relative(self) -> list[RelativeError]:
        """over one frame, and over one second"""

    @property
    def scale(self) -> float:
        """of the alignment"""

    @property
    def transform(self) -> NDArray[numpy.float64]:
        """ground truth from estimate, (4, 4), with the scale"""

    @property
    def poses(self) -> int:
        """in the estimate"""

    @property
    def pairs(self) -> int:
        """number of estimated poses that have a true pose"""

    @property
    def frames(self) -> int:
        """number of frames that could have been tracked; 0: not known"""

    @property
    def tracked(self) -> int:
        """number of those frames that have a pose"""

    @property
    def notes(self) -> list[str]:
        """reasons to doubt the figures, one line each"""

    @property
    def stamps(self) -> object:
        """of the pairs, seconds, (N,)"""

    @property
    def position_errors(self) -> object:
        """of the pairs, metres, (N,)"""

    @property
    def rotation_errors(self) -> object:
        """of the pairs, radians, (N,)"""

def read_trajectory(arg: str | os.PathLike[str], /) -> tuple[Any, ...]: ...

def read_truth(arg: str | os.PathLike[str], /) -> tuple[Any, ...]: ...

def evaluate(arg0: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg1: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg2: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg3: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg4: str, arg5: float, arg6: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg7: int, arg8: float, /) -> Evaluation: ...

def write_trajectory(arg0: str | os.PathLike[str], arg1: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], arg2: Annotated[NDArray[numpy.float64], dict(order='C', device='cpu', writable=False)], /) -> None: ...

__version__: str
