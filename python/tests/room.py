"""A rendered room for the tests, and the command line that they compare with."""

import functools
import os
import pathlib
import subprocess
import unittest

import sslam

COMMAND = os.environ.get("SSLAM_COMMAND", "")
ROOM = pathlib.Path(os.environ.get("SSLAM_ROOM", ""))  # sslam synth --frames 60 --size 320x240

needs_room = unittest.skipUnless(COMMAND and os.environ.get("SSLAM_ROOM"), "skipped: no SSLAM_COMMAND and SSLAM_ROOM")


def run(*arguments):
    subprocess.run([COMMAND, *map(str, arguments)], check=True, capture_output=True)


@functools.lru_cache(maxsize=None)
def frames():
    return tuple(sslam.open_dataset(ROOM))


def system(**settings):
    return sslam.System(ROOM / "camera.yaml", **{"normals": "none", **settings})


def track_all(tracker, turn=lambda image: image, count=None):
    return [tracker.track(turn(frame.image), frame.stamp) for frame in frames()[:count]]


def poses_of(results):
    return [None if r.pose is None else r.pose.tobytes() for r in results]
