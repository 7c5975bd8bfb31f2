# SPDX-License-Identifier: BSD-3-Clause
"""The cases of stream.py in which a camera in the network sends, falls silent, or goes."""
import json
import os
import subprocess
import threading

from cameras import HEAD, Camera, RtspCamera, part
from runs import FRAMES, Run, figures, make_room, rows, same_tracking


def check_network(program, scratch):
    room, images = make_room(program, scratch)
    camera_file = ("--camera", room / "camera.yaml")
    wanted = threading.Semaphore(1)  # a frame is sent when the one before has been tracked

    def in_step(number, send):
        send(HEAD)
        for image in images:
            wanted.acquire()
            send(part(image))

    with Camera(in_step) as camera:
        run = Run(program, camera.address, *camera_file, "--retry", 0, "--out", scratch / "steps", "--record", scratch / "kept")
        while run.event("frame"):
            wanted.release()
        wanted.release()
        assert run.process.wait() == 0
    found = figures(scratch / "steps")
    assert (found["frames"], found["frames_dropped"]) == (FRAMES, 0), found
    assert any("the stream broke off after frame %d" % (FRAMES - 1) in text for text in run.texts("warning")), run.events
    stamps = [float(row["stamp"]) for row in rows(scratch / "steps")]
    assert stamps[0] == 0 and all(a < b for a, b in zip(stamps, stamps[1:])), stamps
    run = Run(program, scratch / "kept", "--out", scratch / "again")
    assert run.end() == 0
    same_tracking(scratch / "steps", scratch / "again")

    # All at once: the newest frames are tracked, and the others counted.
    with Camera(lambda number, send: send(HEAD + b"".join(part(image) for image in images * 3))) as camera:
        run = Run(program, camera.address, *camera_file, "--retry", 0, "--live", "--out", scratch / "flood")
        run.end()
    found = figures(scratch / "flood")
    assert found["frames_dropped"] > 0 and found["frames"] + found["frames_dropped"] == 3 * FRAMES, found
    assert int(rows(scratch / "flood")[-1]["index"]) == 3 * FRAMES - 1


def check_rtsp(program, scratch):
    room, images = make_room(program, scratch)
    wanted = threading.Semaphore(1)

    def in_step(number, send):
        for i, image in enumerate(images):
            wanted.acquire()
            send(b"".join(camera.packets(image, i / 20)))

    with RtspCamera(in_step) as camera:
        run = Run(program, camera.address.replace("//", "//user:secret@"), "--camera", room / "camera.yaml", "--retry", 0,
                  "--out", scratch / "out")
        while run.event("frame"):
            wanted.release()
        wanted.release()
        assert run.process.wait() == 0, run.events
    found = figures(scratch / "out")
    assert (found["frames"], found["frames_dropped"]) == (FRAMES, 0), found
    # The times at which frames were taken, whenever they came.
    assert [float(row["stamp"]) for row in rows(scratch / "out")] == [i / 20 for i in range(FRAMES)]
    assert found["tracked"] > 0.8 * FRAMES, found["tracked"]
    told = json.dumps(run.events) + "".join(path.read_text(errors="ignore") for path in (scratch / "out").iterdir())
    assert "secret" not in told and "user:...@127.0.0.1" in told, [event for event in run.events if "text" in event]


def check_lost(program, scratch):
    room, images = make_room(program, scratch)
    wanted = threading.Semaphore(1)
    over = threading.Event()

    def play(number, send):
        send(HEAD)
        for image in images[:20] if number == 0 else images[20:]:
            wanted.acquire()
            send(part(image))
        if number > 0:
            over.wait()

    with Camera(play) as camera:
        run = Run(program, camera.address, "--camera", room / "camera.yaml", "--retry", 60, "--out", scratch / "out")
        for _ in range(FRAMES):
            assert run.event("frame"), run.events
            wanted.release()
        assert run.interrupt() == 130
        over.set()
    assert any("lost after frame 19 (the connection ended); trying again for 60 s" in text for text in run.texts("warning")), run.events
    found = figures(scratch / "out")
    assert (found["frames"], found["stream_losses"]) == (FRAMES, 1), found
    stamps = [float(row["stamp"]) for row in rows(scratch / "out")]
    assert all(a < b for a, b in zip(stamps, stamps[1:])), stamps

    # One that never comes back: the run ends by itself.
    def once(number, send):
        if number == 0:
            send(HEAD + part(images[0]))

    with Camera(once) as camera:
        run = Run(program, camera.address, "--camera", room / "camera.yaml", "--retry", 0.5, "--out", scratch / "gone")
        assert run.end() == 1  # one frame makes no map
    assert any("did not come back within 0.5 s" in text for text in run.texts("warning")), run.events
    assert figures(scratch / "gone")["frames"] == 1


def check_silent(program, scratch):
    room, images = make_room(program, scratch)
    options = ("--camera", room / "camera.yaml", "--out")
    os.mkfifo(scratch / "fifo")
    over = threading.Event()

    def play(number, send):
        if number > 0:
            send(HEAD)
        over.wait()

    with Camera(play) as camera:
        for name in (camera.address, camera.address, scratch / "fifo", "-"):
            run = Run(program, name, *options, scratch / "none", stdin=subprocess.PIPE)
            assert run.event("note", "waiting for the first frame"), run.events
            assert run.interrupt() == 130, run.events
            assert any("interrupted before the first frame" in text for text in run.texts("warning")), run.events
            run.process.stdin.close()
        over.set()

    over.clear()

    def stop_after_ten(number, send):
        send(HEAD + b"".join(part(image) for image in images[:10]))
        over.wait()

    with Camera(stop_after_ten) as camera:
        run = Run(program, camera.address, *options, scratch / "ten")
        while run.event("frame")["index"] < 9:
            pass
        assert run.interrupt() == 130
        over.set()
    found = figures(scratch / "ten")
    assert found["interrupted"] and found["frames"] + found["frames_dropped"] == 10, found
