"""The system: images in, poses and a map out."""

from __future__ import annotations

from typing import Any, Callable, List, Mapping, NoReturn, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _check, _sslam
from ._callbacks import Callback, Callbacks, warn
from ._errors import SettingsError
from ._settings import Path, as_camera, parameter_values, presets, shipped_network, wide_lens
from ._sslam import Camera, Result
from ._types import Cloud, Floats, Latest, Lines, Parameter, Planes, Trajectory
from ._wide_lens import WideLens

NormalsCallback = Callable[[NDArray[np.uint8]], Optional[NDArray[Any]]]


class System:
    """Tracks a camera and builds a map.

    camera: an sslam.Camera, an sslam.WideLens, or the path of a camera file. Images of a wide lens are undistorted to its
        view; poses, map and given normals refer to the view.
    preset: one of sslam.presets().
    normals: source of surface normals: "onnx" (the network that comes with sslam), "onnx:FILE" (another one), "depth"
        (registered depth images), "files:DIR", "none" (lines alone), or a function that is called with each image of
        track() and returns normals as for track(normals=...), or None. "on-demand:SOURCE" uses a source only where the
        lines of a frame do not determine its rotation. The default is "on-demand", with the network of sslam, or
        "none" if it is not installed or the preset does not use normals.
    parameters: values that differ from their defaults, by the names of sslam.parameters(), in their units; or
        as keywords with two underscores for each dot: keyframes__max_turn=10.
    colours: order of the channels of images with three or four: "bgr" (as OpenCV reads them, no copy), or "rgb".
    live: mapping and loop closing have their own thread, and tracking never waits for them; no two runs are equal.
        Otherwise the same images give the same results, bit for bit.
    seed: seed of all random samples.
    longest_side: longest side of an image in pixels: larger images are shrunk; 0: no limit.
    final_pass: finish() adjusts the whole map and tracks every frame again in it; 100 kB of memory a frame.
    depth_factor: value of one metre in a uint16 depth image.
    normals_sigma_deg: common error of the normals of one plane, degrees, for normals of track() or of a function.

    Methods may be called from any thread; calls are serialised. Callbacks are called in the thread that calls track(),
    after the frame and without a lock: they may call the system.
    """

    def __reduce__(self) -> NoReturn:
        raise TypeError("System: cannot be copied or pickled; save() writes its map")

    def __init__(
        self,
        camera: Union[Camera, WideLens, Path],
        preset: str = "structure",
        normals: Union[None, str, NormalsCallback] = None,
        *,
        parameters: Optional[Mapping[str, float]] = None,
        colours: str = "bgr",
        live: bool = False,
        seed: int = 1,
        longest_side: int = 960,
        final_pass: bool = True,
        depth_factor: float = 5000.0,
        normals_sigma_deg: float = 5.0,
        **words: float,
    ) -> None:
        values = parameter_values("System", parameters, words)
        _check.text("preset", preset)
        sigma = _check.real("normals_sigma_deg", normals_sigma_deg)
        if not 0 <= sigma < 90:
            raise ValueError(f"normals_sigma_deg: {sigma:g} is out of range: 0 to 90")
        self._rgb = _check.is_rgb(colours)
        self._callbacks = Callbacks()
        self._normals_of: Optional[NormalsCallback] = None
        self._lens = wide_lens(camera)
        self._tracking = _sslam.Tracking(
            as_camera("camera", camera) if self._lens is None else self._lens.camera,
            preset,
            self._source_of(normals, preset),
            values,
            _check.whole("seed", seed, 0, 2**64 - 1),
            _check.flag("live", live),
            _check.whole("longest_side", longest_side, 0),
            _check.flag("final_pass", final_pass),
            _check.positive("depth_factor", depth_factor),
            sigma,
        )

    def _source_of(self, normals: Union[None, str, NormalsCallback], preset: str) -> str:
        if callable(normals):
            self._normals_of = normals
            return "none"
        if normals is not None and not isinstance(normals, str):
            raise TypeError(f"normals: expected a str, a function or None, not {type(normals).__name__}")
        if normals not in (None, "onnx", "on-demand"):
            return _check.text("normals", normals)
        wanted = normals is not None or any(p.uses_normals for p in presets() if p.name == preset)
        shipped = shipped_network()
        if wanted and shipped is not None:
            return ("onnx:" if normals == "onnx" else "on-demand:onnx:") + shipped
        if normals is not None:
            raise SettingsError("normals: the network that comes with sslam is not installed; name one with onnx:FILE")
        if wanted:
            warn("the normal network that comes with sslam is not installed: the axes come from lines alone", 4)
        return "none"

    def track(
        self,
        image: NDArray[np.uint8],
        stamp: float,
        depth: Optional[NDArray[Any]] = None,
        mask: Optional[NDArray[np.uint8]] = None,
        *,
        normals: Optional[NDArray[Any]] = None,
        name: str = "",
    ) -> Result:
        """Tracks the next image.

        image: uint8, (H, W), (H, W, 3) or (H, W, 4), of the camera's size.
        stamp: seconds; later than that of the previous frame.
        depth: registered to the image, (H, W): uint16 in depth_factor, or float32 in metres; 0: unknown. Only for
            normals="depth".
        mask: uint8 or bool, (H, W); 0: no features are detected there.
        normals: float, (h, w, 3) or (h, w, 4), in the shape of the image but of any size: unit vectors in the camera
            frame (x right, y down, z forward) that point towards the camera, zero where there is none; the fourth
            channel is the probability of lying on a plane.
        name: name of the image file, without folder and extension; it selects the normals of "files:DIR".

        Pixels are read in place, without a copy, if those of a row are contiguous; they must not change during the
        call. Raises TypeError for a wrong dtype, ValueError for a wrong shape or stamp, FinishedError after
        finish(), and any exception of a callback: then the frame counts as tracked, unless a function of normals
        raised.
        """
        pixels = _check.pixels("image", image, (np.uint8,), (1, 3, 4))
        when = _check.real("stamp", stamp)
        _check.text("name", name)
        if depth is not None:
            depth = _check.pixels("depth", depth, (np.uint16, np.float32), (1,))
            if depth.shape != pixels.shape[:2]:
                raise ValueError(f"depth: has shape {depth.shape}; expected that of the image, {pixels.shape[:2]}")
        if mask is not None:
            mask = _check.pixels("mask", mask, (np.uint8, np.bool_), (1,)).view(np.uint8)
            if mask.shape != pixels.shape[:2]:
                raise ValueError(f"mask: has shape {mask.shape}; expected that of the image, {pixels.shape[:2]}")
        if self._lens is not None:
            if depth is not None:
                raise ValueError("depth: is that of a wide lens's image, which is undistorted; leave it out")
            image = pixels = self._lens.image(pixels)
            mask = self._lens.mask(mask)
        if normals is None and self._normals_of is not None:
            normals = self._normals_of(image)
        if normals is not None:
            normals = self._normals_array(normals, pixels)
        result = self._tracking.track(pixels, when, depth, mask, normals, name, self._rgb)
        self._callbacks.tell(result)
        return result

    @staticmethod
    def _normals_array(normals: Any, image: NDArray[Any]) -> NDArray[Any]:
        if isinstance(normals, np.ndarray) and normals.dtype in (np.float16, np.float64):
            normals = normals.astype(np.float32)
        found = _check.pixels("normals", normals, (np.float32,), (3, 4))
        shape = (found.shape[1] / image.shape[1]) / (found.shape[0] / image.shape[0])
        if abs(shape - 1) > 0.02:
            raise ValueError(f"normals: have shape {found.shape}; expected the shape of the image, {image.shape[:2]}")
        return found

    def on(self, event: str, callback: Callback) -> Callback:
        """Calls callback(result) after each frame with this event of sslam.EVENTS. For "warning" it is callback(line);
        without such a callback, warnings go to Python's `warnings`."""
        return self._callbacks.add(event, callback)

    def off(self, event: str, callback: Callable[[Any], Any]) -> None:
        """Removes a callback of on(event, callback)."""
        self._callbacks.remove(event, callback)

    def finish(self) -> bool:
        """Ends the input: waits for mapping and runs the final pass. True if that closed a loop. A second call does
        nothing."""
        return self._tracking.finish()

    def points(self) -> Floats:
        """The points of the map, (N, 3), world."""
        return self._tracking.points()

    def cloud(self) -> Cloud:
        """The points with their colours."""
        return Cloud(*self._tracking.cloud())

    def lines(self) -> Lines:
        return Lines(*self._tracking.lines())

    def planes(self) -> Planes:
        return Planes(*self._tracking.planes())

    def keyframes(self) -> Trajectory:
        """In the order in which they were made."""
        return Trajectory(*self._tracking.keyframes())

    def trajectory(self) -> Trajectory:
        """The poses of all tracked frames in the current map."""
        return Trajectory(*self._tracking.trajectory())

    def bridged(self) -> Floats:
        """(N,), seconds: stamps of those poses of trajectory() that finish() bridged: their rotation was measured from
        frame to frame, their position is interpolated."""
        return self._tracking.bridged()

    def latest(self) -> Latest:
        """The latest pose; never waits for a frame that is being tracked."""
        return Latest(*self._tracking.latest())

    def save(self, path: Path) -> None:
        """Writes the map to a file."""
        self._tracking.save(_check.path("path", path))

    def load(self, path: Path) -> None:
        """Continues in the map of a file: frames are lost until one is recognised in it."""
        self._tracking.load(_check.path("path", path))

    def save_trajectory(self, path: Path) -> None:
        """trajectory() in the format of TUM, digit for digit as `sslam run` writes it."""
        self._tracking.save_trajectory(_check.path("path", path))

    def localise_only(self, on: bool = True) -> None:
        """True: the map does not change: no keyframe is made and no map begun. False: it grows again."""
        self._tracking.localise_only(_check.flag("on", on))

    def parameters(self) -> List[Parameter]:
        """Every parameter with its current value."""
        return [Parameter(*values) for values in self._tracking.parameters()]

    @property
    def camera(self) -> Camera:
        """The camera of the images of track()."""
        return self._tracking.camera

    @property
    def read_out(self) -> float:
        """Read-out time of a rolling shutter in seconds, first row to last, estimated by finish(). 0: a global
        shutter, or not known."""
        return self._tracking.read_out

    @property
    def frames(self) -> int:
        """Number of frames so far."""
        return self._tracking.frames
