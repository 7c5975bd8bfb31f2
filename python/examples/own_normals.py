#!/usr/bin/env python3
"""Normals by a function of your own: own_normals.py DATASET.

This one makes them of the dataset's depth images; a network's output is handed over in the same way:

    def normals(image):                        # (H, W, 3) uint8, as track() gets it
        output = network(torch.from_numpy(image))
        return output.numpy()                  # (h, w, 3), camera frame, towards the camera
"""

import sys

import numpy as np
from numpy.typing import NDArray

import sslam

Floats = NDArray[np.float64]


def normals_of(depth: Floats, camera: sslam.Camera) -> Floats:
    """(H, W, 3) from depth in metres, by the cross product of neighbours; zero where depth is missing."""
    v, u = np.indices(depth.shape)
    points = np.dstack([(u - camera.cx) / camera.fx * depth, (v - camera.cy) / camera.fy * depth, depth])
    across, down = np.gradient(points, axis=1), np.gradient(points, axis=0)
    normals = np.cross(down, across)
    length = np.linalg.norm(normals, axis=2)
    normals[(depth <= 0) | (length == 0)] = 0
    unit: Floats = normals / np.maximum(length, 1e-12)[..., None]
    return unit


def main() -> int:
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    dataset = sslam.open_dataset(sys.argv[1])
    if not dataset.has_depth:
        print(f"{sys.argv[1]}: has no depth images", file=sys.stderr)
        return 1
    system = sslam.System(dataset.camera, normals="none", normals_sigma_deg=1)
    for frame in dataset:
        own = None
        if frame.depth is not None:
            own = normals_of(frame.depth / dataset.depth_factor, dataset.camera)
        result = system.track(frame.image, frame.stamp, normals=own)
        print(f"{frame.name}: {result.normals} normals, {result.axes_seen} axes, {result.state.name.lower()}")
    system.finish()
    return 0 if len(system.trajectory().stamps) else 1


if __name__ == "__main__":
    sys.exit(main())
