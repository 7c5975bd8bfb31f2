"""Kernels on images: line segments, and the normals that a network sees."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _check, _sslam
from ._errors import Error
from ._settings import as_camera, parameter_values, shipped_network
from ._sslam import Camera
from ._types import ImageNormals, LineSegments

Path = Union[str, "os.PathLike[str]"]


def line_segments(
    image: NDArray[np.uint8],
    *,
    colours: str = "bgr",
    parameters: Optional[Mapping[str, float]] = None,
    **words: float,
) -> LineSegments:
    """The line segments of an image, as System finds them, longest first.

    image: uint8, (H, W), (H, W, 3) or (H, W, 4), at least 32 pixels high and wide; colours: "bgr" or "rgb".
    parameters: those named "lines." in sslam.parameters(), such as {"lines.max_lines": 50}, or lines__max_lines=50.

    System shrinks images that are larger than its longest_side before that; this function does not.
    """
    return LineSegments(
        *_sslam.line_segments(
            _check.pixels("image", image, (np.uint8,), (1, 3, 4)),
            _check.is_rgb(colours),
            parameter_values("line_segments", parameters, words),
        )
    )


class NormalNetwork:
    """A network of surface normals.

    model: an ONNX file with its manifest beside it (docs/normals.md), or the manifest; default the network that comes
        with sslam.

    Raises sslam.Error if the file is missing or does not fit its manifest.
    """

    def __init__(self, model: Optional[Path] = None) -> None:
        found = shipped_network() if model is None else _check.path("model", model)
        if found is None:
            raise Error("model: the network that comes with sslam is not installed; name one")
        self._network = _sslam.Network(found)

    def __call__(self, image: NDArray[np.uint8], camera: Union[Camera, Path], *, colours: str = "bgr") -> ImageNormals:
        """The normals of an image: uint8, (H, W), (H, W, 3) or (H, W, 4), of the camera's size."""
        pixels = _check.pixels("image", image, (np.uint8,), (1, 3, 4))
        lens = as_camera("camera", camera)
        _check.size("image", pixels, lens.width, lens.height)
        status, normals, planar, grid = self._network.normals(pixels, _check.is_rgb(colours), lens)
        return ImageNormals(status, normals, planar, grid)
