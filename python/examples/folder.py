#!/usr/bin/env python3
"""Tracks a folder of images, or a video, and writes where the camera was: folder.py PATH [CAMERA.yaml]."""

import sys

import sslam


def main() -> int:
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    dataset = sslam.open_dataset(sys.argv[1], camera=sys.argv[2] if len(sys.argv) > 2 else None)
    system = sslam.System(dataset.camera, depth_factor=dataset.depth_factor or 5000)
    system.on("keyframe_made", lambda result: print(f"{result.stamp:.3f} s: a keyframe, {result.inliers} inliers"))
    for frame in dataset:
        result = system.track(frame.image, frame.stamp, frame.depth, name=frame.name)
        if result.pose is None:
            print(f"{frame.name}: {result.state.name.lower()}, {result.reason.name.lower()}")
    system.finish()
    system.save_trajectory("trajectory.txt")
    system.save("map.sslam")
    print(f"{len(system.trajectory().stamps)} poses in trajectory.txt, {len(system.points())} points in map.sslam")
    return 0 if len(system.trajectory().stamps) else 1


if __name__ == "__main__":
    sys.exit(main())
