"""Maps in files."""

from __future__ import annotations

import os
from typing import Union

from . import _check, _sslam
from ._types import Floats, Lines, Planes, Trajectory


class Map:
    """A map from a file, with the methods of System."""

    def __init__(self, loaded: _sslam.Map) -> None:
        self._map = loaded

    def points(self) -> Floats:
        """(N, 3), world"""
        return self._map.points()

    def lines(self) -> Lines:
        return Lines(*self._map.lines())

    def planes(self) -> Planes:
        return Planes(*self._map.planes())

    def keyframes(self) -> Trajectory:
        return Trajectory(*self._map.keyframes())


def load_map(path: Union[str, "os.PathLike[str]"]) -> Map:
    """Reads a map.sslam, of System.save or of a run. Raises sslam.Error."""
    return Map(_sslam.Map.load(_check.path("path", path)))
