#!/usr/bin/env python3
"""Tracks a webcam until Ctrl-C: webcam.py CAMERA.yaml [NUMBER]. Needs OpenCV's Python module (python3-opencv).

Mapping runs beside the tracking. The stamp of an image is the moment at which it came.
"""

import sys
import time

import cv2

import sslam


def main() -> int:
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    camera = sslam.Camera.from_file(sys.argv[1])
    source = cv2.VideoCapture(int(sys.argv[2]) if len(sys.argv) > 2 else 0)
    source.set(cv2.CAP_PROP_FRAME_WIDTH, camera.width)
    source.set(cv2.CAP_PROP_FRAME_HEIGHT, camera.height)
    system = sslam.System(camera, live=True)
    begin = time.monotonic()
    try:
        while True:
            there, image = source.read()
            if not there:
                print("the camera gives no more images", file=sys.stderr)
                break
            result = system.track(image, time.monotonic() - begin)
            where = "" if result.pose is None else "at {:.2f} {:.2f} {:.2f}".format(*result.pose[:3, 3])
            print(f"{result.stamp:7.2f} s  {result.state.name.lower()} {where}")
    except KeyboardInterrupt:
        pass
    system.finish()
    system.save("map.sslam")
    return 0


if __name__ == "__main__":
    sys.exit(main())
