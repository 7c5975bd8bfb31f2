#!/usr/bin/env python3
"""Rotations by an IMU of your own: own_rotation.py DATASET ORIENTATIONS.txt [SIGMA].

ORIENTATIONS.txt has rows `stamp qx qy qz qw`: the camera's orientation in the IMU's world, which an orientation filter
gives. SIGMA is its standard deviation, degrees; default 1.

A rotation goes in as what it says about the room: the normals of three walls. Lines vote for the axes of the room, and the
IMU's world may be turned against these, so the turn between the two is taken from the first image that shows the room's axes.
"""

import sys
from typing import Optional

import numpy as np
from numpy.typing import NDArray

import sslam

Floats = NDArray[np.float64]


def matrix(x: float, y: float, z: float, w: float) -> Floats:
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def normals_of(axes: Floats, camera: sslam.Camera) -> Floats:
    """Normals that say where the axes are, (3, 3), columns in the camera frame: a band of pixels for each, every normal
    towards the camera."""
    columns = 48
    rows = 3 * round(columns * camera.height / camera.width / 3)
    u = (np.arange(columns) + 0.5) * camera.width / columns - 0.5
    v = (np.arange(rows) + 0.5) * camera.height / rows - 0.5
    x, y = np.meshgrid((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy)
    rays = np.dstack([x, y, np.ones_like(x)])
    normals = axes.T[np.arange(rows) * 3 // rows][:, None, :].repeat(columns, axis=1)
    towards = -np.sign(np.sum(normals * rays, axis=2, keepdims=True))
    facing: Floats = normals * towards
    return facing


def main() -> int:
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    dataset = sslam.open_dataset(sys.argv[1])
    table = np.loadtxt(sys.argv[2], ndmin=2)
    camera = dataset.camera
    sigma = float(sys.argv[3]) if len(sys.argv) > 3 else 1.0
    system = sslam.System(camera, normals="none", normals_sigma_deg=sigma)
    imu_from_room: Optional[Floats] = None
    used = 0
    for frame in dataset:
        nearest = int(np.argmin(np.abs(table[:, 0] - frame.stamp)))
        normals = None
        if abs(table[nearest, 0] - frame.stamp) < 0.02:
            imu_from_cam = matrix(*table[nearest, 1:5])
            if imu_from_room is None:
                seen = sslam.manhattan_rotation(segments=sslam.line_segments(frame.image).segments, camera=camera)
                if seen.status == sslam.Status.OK and seen.axes_seen >= 2:
                    imu_from_room = imu_from_cam @ seen.rotation
            if imu_from_room is not None:
                normals = normals_of(imu_from_cam.T @ imu_from_room, camera)
        result = system.track(frame.image, frame.stamp, normals=normals)
        used += result.normals > 0
    system.finish()
    system.save_trajectory("trajectory.txt")
    print(f"{len(system.trajectory().stamps)} poses in trajectory.txt; {used} of {len(dataset)} rotations used")
    return 0 if len(system.trajectory().stamps) else 1


if __name__ == "__main__":
    sys.exit(main())
