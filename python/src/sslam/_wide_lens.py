"""Lenses that are too wide for a pinhole."""

from __future__ import annotations

import os
import warnings
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _check, _sslam
from ._errors import SslamWarning
from ._sslam import Camera

Path = Union[str, "os.PathLike[str]"]


def view_angle(name: str, degrees: Optional[float]) -> float:
    """0: the usual."""
    if degrees is None:
        return 0.0
    value = _check.real(name, degrees)
    if not 30 <= value <= 140:
        raise ValueError(f"{name}: {value:g} degrees are out of range: 30 to 140")
    return value


class WideLens:
    """A lens that is too wide for a pinhole, with the pinhole view that its images are undistorted to.

    path: a camera file with such a lens, and with the size of its images.
    fov: horizontal angle of the view in degrees, 30 to 140; default 110, or less if the lens sees less.

    Raises sslam.Error if the file has no such lens, or the lens sees less than `fov`.
    """

    def __init__(self, path: Path, fov: Optional[float] = None) -> None:
        self._lens = _sslam.Lens(_check.path("path", path), view_angle("fov", fov))
        for line in self._lens.warnings:
            warnings.warn(line, SslamWarning, stacklevel=2)

    @property
    def camera(self) -> Camera:
        """The camera of the view."""
        return self._lens.camera

    @property
    def fov(self) -> float:
        """Horizontal angle of the view, degrees."""
        return self._lens.fov

    def image(self, image: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Undistorts an image of the lens to the view: uint8, (H, W), (H, W, 3) or (H, W, 4)."""
        return self._lens.image(_check.pixels("image", image, (np.uint8,), (1, 3, 4)))

    def mask(self, mask: Optional[NDArray[Any]] = None) -> Optional[NDArray[np.uint8]]:
        """The mask of the view for an image of the lens with this mask (uint8 or bool, (H, W)); None: all pixels."""
        if mask is not None:
            mask = _check.pixels("mask", mask, (np.uint8, np.bool_), (1,)).view(np.uint8)
        return self._lens.mask(mask)
