#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How often a pose is off by more than its covariance claims.

Each frame is compared with one a few frames later. Both poses are relative to the same map, so most of the map's drift
cancels, and their covariances add up. The squared error over that sum is a chi-square of three degrees of freedom, for
the rotation and for the place; 1 % of them should exceed 11.34. The scale is that of the second around.

The truth must be exact to a tenth of a degree and a millimetre: rendered images, not motion capture.

  PYTHONPATH=build-test/python bench/pose_claims.py DATASET... [--gap 1] [--start 0]
"""
import argparse

import numpy as np

import sslam

BEYOND = 11.34  # chi-square of three degrees of freedom at 99 %
AROUND = 15  # frames on either side that tell the scale


def log(rotation):
    angle = np.arccos(np.clip((np.trace(rotation) - 1) / 2, -1, 1))
    axis = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]) / 2
    return axis if angle < 1e-8 else axis * angle / np.sin(angle)


def track(dataset, start):
    """(true pose, estimated pose, covariance) of the frames that have all three."""
    truth = dataset.ground_truth
    system = sslam.System(dataset.camera, normals="none", final_pass=False)
    seen = []
    for i, frame in enumerate(dataset):
        if i < start:
            continue
        result = system.track(frame.image, frame.stamp)
        at = np.argmin(np.abs(truth.stamps - frame.stamp))
        if result.pose is not None and result.covariance is not None and abs(truth.stamps[at] - frame.stamp) < 0.01:
            seen.append((truth.poses[at], result.pose, result.covariance))
    return seen


def spread(poses):
    places = np.array(poses)[:, :3, 3]
    return np.linalg.norm(places - places.mean(0))


def scale_around(seen, i):
    true, found, _ = zip(*seen[max(0, i - AROUND):i + AROUND])
    return spread(found) / spread(true)


def squared_errors(seen, gap):
    """Of rotation and place, over their covariances: (N, 2)."""
    errors = []
    for i, (a, b) in enumerate(zip(seen, seen[gap:])):
        true, found = (np.linalg.inv(a[k]) @ b[k] for k in (0, 1))
        covariance = a[2] + b[2]
        turned = log(true[:3, :3].T @ found[:3, :3])
        moved = true[:3, :3].T @ (found[:3, 3] - scale_around(seen, i) * true[:3, 3])
        errors.append([turned @ np.linalg.solve(covariance[:3, :3], turned), moved @ np.linalg.solve(covariance[3:, 3:], moved)])
    return np.array(errors)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("datasets", nargs="+")
    parser.add_argument("--gap", type=int, default=1, help="frames between the two")
    parser.add_argument("--start", type=int, default=0, help="first frame")
    options = parser.parse_args()
    print("| dataset | pairs | rotation beyond 99 % | place beyond 99 % | median chi-square (2.37), rotation | place |")
    print("|---" * 6 + "|")
    for path in options.datasets:
        errors = squared_errors(track(sslam.open_dataset(path), options.start), options.gap)
        beyond, middle = 100 * np.mean(errors > BEYOND, axis=0), np.median(errors, axis=0)
        print(f"| {path} | {len(errors)} | {beyond[0]:.1f} % | {beyond[1]:.1f} % | {middle[0]:.2f} | {middle[1]:.2f} |")


if __name__ == "__main__":
    main()
