#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The node for ROS 1 under a master of its own, on loopback: it gets the images of a room, and tells the poses of `sslam run`.

Usage: ros1.py SSLAM NODE PLAYER ROSMASTER ROOM
"""
import contextlib
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cli" / "foxglove"))
from foxglove import near, nanoseconds_of, poses  # noqa: E402

SET = ("lines.max_lines", 150)


def call(*words, code=0, **options):
    done = subprocess.run(["setpriv", "--pdeathsig", "KILL", *map(str, words)], capture_output=True, text=True, **options)
    assert done.returncode == code, done
    return done.stdout + done.stderr


@contextlib.contextmanager
def running(*words, number, **options):
    process = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *map(str, words)], **options)
    try:
        yield process
    finally:
        process.send_signal(number)
        process.wait()


def tell(tracking, *words, **options):
    """What the player prints; it would wait for ever for a node that has ended."""
    with running(*words, number=signal.SIGKILL, stdout=subprocess.PIPE, text=True, **options) as playing:
        watch = threading.Thread(target=lambda: (tracking.wait(), playing.kill()), daemon=True)
        watch.start()
        told, _ = playing.communicate()
        assert playing.returncode == 0, "the node has ended"
    return told


def free_port():
    with contextlib.closing(socket.socket()) as any_one:
        any_one.bind(("127.0.0.1", 0))
        return any_one.getsockname()[1]


def main(sslam, node, player, rosmaster, room):
    room = pathlib.Path(room)
    with tempfile.TemporaryDirectory(prefix="sslam_ros1_") as folder:
        scratch, port = pathlib.Path(folder), free_port()
        call(sslam, "run", room, "--quiet", "--no-report", "--calibration", "fixed", "--normals", "none", "--no-final-pass",
             "--set", "=".join(map(str, SET)), "--out", scratch / "run")
        world = {**os.environ, "ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_IP": "127.0.0.1", "ROS_HOME": folder,
                 "ROS_LOG_DIR": folder}
        camera = {key: value for key, value in re.findall(r"Camera\.(\w+): ([-+.\de]+)", (room / "camera.yaml").read_text())}
        rows = [line.split() for line in (room / "rgb.txt").read_text().splitlines() if line[:1] != "#"]
        (scratch / "list").write_text("".join(f"{nanoseconds_of(row[0])} {room / row[1]}\n" for row in rows))
        with running(rosmaster, "--core", "-p", port, number=signal.SIGTERM, env=world, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL):
            # Settings that mean nothing are refused in one line. They stay with the master, under the node's name.
            said = call(node, "__name:=misspelt", "_set/lines/max_linse:=7", env=world, code=1)
            assert "max_linse" in said and "max_lines" in said, said
            said = call(node, "__name:=wrong", "_preset:=none", env=world, code=1)
            assert "none: no such preset" in said, said
            said = call(node, "__name:=mapless", f"_load:={scratch / 'no.sslam'}", env=world, code=1)
            assert "no.sslam" in said, said
            words = ("_live:=false", f"_save:={scratch / 'map.sslam'}", f"_set/{SET[0].replace('.', '/')}:={SET[1]}")
            with running(node, *words, number=signal.SIGINT, env=world) as tracking:
                told = tell(tracking, player, *(camera[key] for key in ("width", "height", "fx", "fy", "cx", "cy")), scratch / "list", env=world)
        check([line.split(" ", 1) for line in told.splitlines()], list(poses(scratch / "run" / "trajectory_live.txt")), len(rows))
        # The map that it left is one.
        call(sslam, "run", room, "--quiet", "--no-report", "--map", scratch / "map.sslam", "--end", 5, "--out", scratch / "again")


def check(told, wanted, frames):
    by_kind = {}
    for kind, rest in told:
        by_kind.setdefault(kind, []).append(rest)
    assert len(by_kind["state"]) == frames
    assert len(by_kind["pose"]) == len(by_kind["tf"]) == len(wanted) > frames // 2, (len(by_kind["pose"]), len(wanted))
    for pose, tf, (stamp, position, rotation) in zip(by_kind["pose"], by_kind["tf"], wanted):
        told_stamp, frame, *numbers = pose.split()
        assert int(told_stamp) == stamp and frame == "map"
        assert tf.split() == ["map", "optical", *numbers]
        numbers = [float(number) for number in numbers]
        near(numbers[:3], position)
        sign = 1 if sum(p * q for p, q in zip(numbers[3:], rotation)) > 0 else -1
        near([sign * number for number in numbers[3:]], rotation)
    paths = [int(count) for count in by_kind["path"]]
    assert paths == sorted(paths) and paths[-1] > frames // 2, paths
    assert int(by_kind["points"][-1]) > 50


if __name__ == "__main__":
    main(*sys.argv[1:])
