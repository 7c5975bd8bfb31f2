"""Kernels for several views with known poses. As in _kernels, pixels have distortion and the result has a status."""

from __future__ import annotations

import math
from typing import Any, Optional

import numpy as np

from . import _check, _sslam
from ._kernels import CameraOrPath
from ._settings import as_camera
from ._types import BundleAdjustment, Points, TriangulatedLines


def _seen(name: str, value: Any, views: Any, size: int, count: Optional[int] = None) -> Any:
    """What each view sees of each thing, (N, V, size)."""
    seen = _check.numbers(name, value, ("N", "V", size))
    if seen.shape[1] != len(views) or count not in (None, len(seen)):
        things = "N" if count is None else count
        raise ValueError(f"{name}: has shape {seen.shape}; expected ({things}, {len(views)}, {size}) for {len(views)} poses")
    return seen


def triangulate_points(
    poses: Any, pixels: Any, camera: CameraOrPath, *, sigma: float = 1.0, min_parallax_deg: float = 1.0
) -> Points:
    """Points from two or more views of known poses.

    poses: (V, 4, 4), camera to world.
    pixels: (N, V, 2), where each view sees each point; NaN where it does not; sigma: of each coordinate, pixels.
    min_parallax_deg: least parallax, the largest angle between two of the rays; below it the status is LOW_PARALLAX.
    """
    views = _check.numbers("poses", poses, ("V", 4, 4))
    seen = _seen("pixels", pixels, views, 2)
    return Points(
        *_sslam.triangulate_points(
            views,
            seen,
            as_camera("camera", camera),
            _check.positive("sigma", sigma),
            math.radians(_check.positive("min_parallax_deg", min_parallax_deg)),
        )
    )


def triangulate_lines(
    poses: Any,
    segments: Any,
    camera: CameraOrPath,
    *,
    directions: Any = None,
    sigma: float = 1.0,
    min_parallax_deg: float = 2.0,
) -> TriangulatedLines:
    """Lines from two or more views of known poses.

    poses: (V, 4, 4), camera to world.
    segments: (N, V, 4), the observed part of each line in each view, ends u0 v0 u1 v1 in pixels; NaN where there is
        none. The ends need not be the same points of the line. sigma: of an end across the segment, pixels.
    directions: (N, 3), of each line in the world, such as a Manhattan axis; NaN where not known.
    min_parallax_deg: least parallax, the largest angle between two of the planes through a camera and its segment;
        below it the status is LOW_PARALLAX. Half of it is enough where the direction is known.
    """
    views = _check.numbers("poses", poses, ("V", 4, 4))
    seen = _seen("segments", segments, views, 4)
    along = _check.numbers("directions", np.full((len(seen), 3), np.nan) if directions is None else directions, ("N", 3))
    if len(along) != len(seen):
        raise ValueError(f"directions: has {len(along)} rows for {len(seen)} lines")
    return TriangulatedLines(
        *_sslam.triangulate_lines(
            views,
            seen,
            along,
            as_camera("camera", camera),
            _check.positive("sigma", sigma),
            math.radians(_check.positive("min_parallax_deg", min_parallax_deg)),
        )
    )


def bundle_adjust(
    poses: Any,
    points: Any,
    pixels: Any,
    camera: CameraOrPath,
    *,
    lines: Any = None,
    segments: Any = None,
    held: Any = None,
    sigma: float = 1.0,
    max_iterations: int = 50,
) -> BundleAdjustment:
    """Poses, points and lines that fit the observations best. Wrong observations get less weight (Cauchy's loss).

    poses: (V, 4, 4), camera to world, to start from.
    points, pixels: (N, 3) in the world, to start from, and (N, V, 2), where each view sees each point; NaN where it does
        not. sigma: of each coordinate, and of a segment's end across it, pixels.
    lines, segments: (M, 2, 3), two points on each line, and (M, V, 4), ends u0 v0 u1 v1 of what each view shows of it.
    held: (V,), True for poses that are fixed; at least one. Default: the first. If only one is fixed, its distance to
        the farthest other camera is fixed as well, since pixels do not determine the scale.

    Points and lines seen by fewer than two views are not changed, nor are poses of views that see none of the others.
    """
    views = _check.numbers("poses", poses, ("V", 4, 4))
    places = _check.numbers("points", points, ("N", 3))
    edges = _check.numbers("lines", np.empty((0, 2, 3)) if lines is None else lines, ("M", 2, 3))
    nothing = np.empty((0, len(views), 4))
    if held is None:
        held = np.arange(len(views)) == 0
    stays = _check.numbers("held", held, (len(views),), np.bool_)
    if len(views) and not stays.any():
        raise ValueError("held: no pose is fixed; at least one must be, since pixels do not determine the world's frame")
    return BundleAdjustment(
        *_sslam.bundle_adjust(
            views,
            places,
            _seen("pixels", pixels, views, 2, len(places)),
            edges,
            _seen("segments", nothing if segments is None else segments, views, 4, len(edges)),
            as_camera("camera", camera),
            stays,
            _check.positive("sigma", sigma),
            _check.whole("max_iterations", max_iterations, 1),
        )
    )


__all__ = ["bundle_adjust", "triangulate_lines", "triangulate_points"]
