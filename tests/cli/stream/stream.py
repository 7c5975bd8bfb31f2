#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`sslam run` on streams: pipes, a camera in the network that this script plays, and cameras that are not there.

Usage: stream.py PROGRAM CASE FAKE_CAMERA   (pipe, broken_pipe, video, network, rtsp, device, lost, silent, refusals)
"""
import contextlib
import os
import pathlib
import socket
import subprocess
import sys
import tempfile

from cameras import Camera, RtspCamera
from network_cases import check_lost, check_network, check_rtsp, check_silent
from runs import FRAMES, Run, feed, figures, make_room, rows, same_tracking


def check_pipe(program, scratch):
    room, images = make_room(program, scratch)
    camera = ("--camera", room / "camera.yaml")
    from_files = Run(program, room, "--out", scratch / "files")
    assert from_files.end() == 0
    run = Run(program, "-", *camera, "--out", scratch / "stdin", "--record", scratch / "kept", stdin=subprocess.PIPE)
    feed(run.process.stdin.buffer, images)
    assert run.end() == 0, run.events
    found = figures(scratch / "stdin")
    # A pipe waits: nothing is dropped, however slow the tracker is.
    assert (found["frames"], found["frames_dropped"]) == (FRAMES, 0), found
    assert found["tracked"] > 0.8 * FRAMES, found["tracked"]
    same_tracking(scratch / "stdin", scratch / "files")

    # What was kept is the same again, without any word about the camera.
    assert [path.read_bytes() for path in sorted((scratch / "kept/rgb").iterdir())] == images
    again = Run(program, scratch / "kept", "--out", scratch / "again")
    assert again.end() == 0 and not again.texts("warning"), again.events
    same_tracking(scratch / "stdin", scratch / "again")

    os.mkfifo(scratch / "fifo")
    run = Run(program, scratch / "fifo", *camera, "--out", scratch / "named", "--start", 5, "--end", 35, "--stride", 2)
    feed(open(scratch / "fifo", "wb"), images)
    assert run.end() == 0
    assert [int(row["index"]) for row in rows(scratch / "named")] == list(range(5, 35, 2))

    # What is no stream is kept as well.
    run = Run(program, room, "--out", scratch / "plain", "--record", scratch / "copy", "--end", 20)
    assert run.end() == 0
    run = Run(program, scratch / "copy", "--out", scratch / "replayed")
    assert run.end() == 0
    same_tracking(scratch / "plain", scratch / "replayed")


def check_broken_pipe(program, scratch):
    room, images = make_room(program, scratch)
    camera = ("--camera", room / "camera.yaml")
    spoilt = list(images)
    spoilt[20] = images[20][:2000]
    spoilt[25] = b"\n--noise between images--\n" + images[25]
    spoilt[-1] = images[-1][:1000]
    run = Run(program, "-", *camera, "--out", scratch / "out", stdin=subprocess.PIPE)
    feed(run.process.stdin.buffer, spoilt)
    assert run.end() == 0
    assert [text for text in run.texts("warning") if "standard input frame 20: truncated image; frame skipped" in text], run.events
    # The last one never ended.
    assert [int(row["index"]) for row in rows(scratch / "out")] == [i for i in range(FRAMES - 1) if i != 20]

    # A pipe that falls silent: the files are written all the same, and the recording is a dataset.
    run = Run(program, "-", *camera, "--out", scratch / "silent", "--record", scratch / "kept", stdin=subprocess.PIPE)
    for image in images[:20]:
        run.process.stdin.buffer.write(image)
    run.process.stdin.buffer.flush()
    while run.event("frame")["index"] < 19:
        pass
    assert run.interrupt() == 130
    found = figures(scratch / "silent")
    assert found["interrupted"] and found["frames"] == 20, found
    run = Run(program, scratch / "kept", "--out", scratch / "again")
    assert run.end() == 0
    same_tracking(scratch / "silent", scratch / "again")


def check_video(program, scratch):
    """A whole video, through a pipe and by HTTP, is what it is as a file."""
    room, _ = make_room(program, scratch)
    videos = {}
    for kind in ("avi", "mp4"):
        file = scratch / f"look.{kind}"
        subprocess.run([program, "run", room, "--normals", "none", "--quiet", "--out", scratch / "first", "--video", file],
                       check=True, stdout=subprocess.DEVNULL)
        videos[kind] = file.read_bytes()
    answers = {kind: b"HTTP/1.1 200 OK\r\nContent-Type: video/x\r\nContent-Length: %d\r\n\r\n" % len(video) + video
               for kind, video in videos.items()}
    options = ("--fov", 60)
    run = Run(program, scratch / "look.avi", *options, "--out", scratch / "file")
    assert run.end() == 0, run.events
    with Camera(lambda number, send: send(answers["avi"])) as camera:
        run = Run(program, camera.address, *options, "--out", scratch / "http")
        assert run.end() == 0, run.events
    run = Run(program, "-", *options, "--out", scratch / "piped", stdin=subprocess.PIPE)
    feed(run.process.stdin.buffer, [videos["avi"]])
    assert run.end() == 0, run.events
    for name in ("http", "piped"):
        found = figures(scratch / name)
        assert (found["frames"], found["frames_dropped"]) == (FRAMES, 0), found
        # But for the stamps, which a stream has in whole microseconds.
        same_tracking(scratch / name, scratch / "file", stamps=False)
    # Cut off in the middle: what came is tracked, and that something is missing is told.
    with Camera(lambda number, send: send(answers["avi"][: 2 * len(answers["avi"]) // 3])) as camera:
        run = Run(program, camera.address, *options, "--out", scratch / "cut")
        run.end()
    assert 0 < figures(scratch / "cut")["frames"] < FRAMES, run.events
    assert any("the video broke off after frame" in text and "the rest is missing" in text for text in run.texts("warning")), run.events
    # OpenCV writes MP4 with its index at the end, where a stream does not get in time.
    with Camera(lambda number, send: send(answers["mp4"])) as camera:
        run = Run(program, camera.address, *options, "--out", scratch / "none")
        assert run.end() == 1 and "index after the pictures" in run.texts("error")[0], run.events


def check_device(program, scratch):
    """A driver played by a library: fake_camera.cpp."""
    room, _ = make_room(program, scratch)
    trigger = scratch / "trigger"
    os.mkfifo(trigger)
    pipe = os.open(trigger, os.O_RDWR)
    env = dict(os.environ, LD_PRELOAD=sys.argv[3], FAKE_CAMERA="/dev/video63", FAKE_CAMERA_TRIGGER=str(trigger),
               FAKE_CAMERA_IMAGES=str(room / "rgb"))

    def start(name, *options):
        return Run(program, name, "--camera", room / "camera.yaml", "--live", *options, env=env)

    run = start(63, "--out", scratch / "out", "--record", scratch / "kept")
    os.write(pipe, b".")  # OpenCV leaves the first one out
    for _ in range(1, FRAMES):
        os.write(pipe, b".")
        assert run.event("frame"), run.events
    # It gives nothing more, and is asked for it.
    assert run.interrupt() == 130
    found = figures(scratch / "out")
    assert (found["frames"], found["frames_dropped"]) == (FRAMES - 1, 0), found
    # The driver's times.
    assert [float(row["stamp"]) for row in rows(scratch / "out")] == [i / 20 for i in range(FRAMES - 1)]
    assert found["tracked"] > 0.8 * FRAMES, found["tracked"]
    assert len(list((scratch / "kept/rgb").iterdir())) == FRAMES - 1

    run = start("/dev/video63", "--out", scratch / "none")
    assert run.event("note", "/dev/video63: waiting for the first frame"), run.events
    assert run.interrupt() == 130
    os.close(pipe)


def check_refusals(program, scratch):
    def refused(*arguments, words, code=1, given=b""):
        done = subprocess.run([program, "run", *map(str, arguments), "--out", scratch / "out", "--normals", "none"], input=given,
                              capture_output=True)
        text = done.stderr.decode()
        assert done.returncode == code and not done.stdout, (arguments, done)
        assert text.startswith("sslam: error: ") and text.count("\n") == 1 and words in text, (words, text)

    refused(63, words="63: no camera /dev/video63 (No such file or directory); there is ")
    refused("/dev/video63", words="no camera /dev/video63")
    refused("/dev/null", words="/dev/null")
    refused("-", words="standard input: ended before the first image")
    refused("-", given=b"no image at all, and none to come\n" * 1000, words="standard input: sends nothing that is a video or an image")
    refused("-", given=b"\xff\xd8\xff\xe0" + bytes(4000), words="standard input: ended before the first image")
    with contextlib.closing(socket.create_server(("127.0.0.1", 0))) as free:
        port = free.getsockname()[1]
    refused(f"http://127.0.0.1:{port}/x", words="Connection refused")
    refused(f"rtsp://127.0.0.1:{port}/x", words="Connection refused")
    refused("nonsense://here", words="nonsense://here: 'nonsense' is no protocol that is read here; expected http, https, rtsp")
    refused("ftp://127.0.0.1/x", words="'ftp' is no protocol that is read here")
    # A name that RFC 2606 gives to nobody.
    refused("http://camera.invalid/x", words="there is no host 'camera.invalid'")
    refused("rtsp://user:secret@camera.invalid:554/x", words="user:...@camera.invalid:554/x: there is no host 'camera.invalid'")
    page = b"<html>" + b"a page, and no camera " * 500
    answer = b"HTTP/1.1 200 OK\r\nContent-Type: text/html\r\n\r\n" + page
    with Camera(lambda number, send: send(answer)) as camera:
        refused(camera.address, words="is a web page; expected the address of the stream itself")
    with Camera(lambda number, send: send(b"HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n\r\n{}")) as camera:
        refused(camera.address, words="sends 'application/json', and no video or images")
    with Camera(lambda number, send: send(b"HTTP/1.1 200 OK\r\n\r\n")) as camera:
        refused(camera.address, words="answers, but sends nothing")
    with Camera(lambda number, send: None) as camera:
        refused(camera.address, words="closes the connection without an answer")
    with Camera(lambda number, send: send(b"HTTP/1.1 401 Unauthorized\r\n\r\n")) as camera:
        refused(camera.address, words="needs a user name and a password, or refuses those given (401 Unauthorized); expected http://USER:PASSWORD@127.0.0.1/")
    for challenge in (b'WWW-Authenticate: Digest realm="camera", nonce="1"', b'WWW-Authenticate: Basic realm="camera"'):
        with RtspCamera(None, challenge) as camera:
            for user in ("", "user:secret@"):
                refused(camera.address.replace("//", "//" + user),
                        words="(401 Unauthorized); expected rtsp://USER:PASSWORD@127.0.0.1/")
            assert len(camera.connections) == 2  # not tried again
    with Camera(lambda number, send: send(b"HTTP/1.1 503 Busy\r\n\r\n")) as camera:
        refused(camera.address, words="the server has failed")
    with Camera(lambda number, send: send(b"HTTP/1.1 404 Not Found\r\n\r\n")) as camera:
        refused(camera.address, words="404 Not Found")
    (scratch / "there").mkdir()
    (scratch / "there/file").touch()
    room, images = make_room(program, scratch)
    refused("-", "--camera", room / "camera.yaml", "--record", scratch / "there", given=images[0], words="already exists; choose a new folder")
    refused("-", "--retry", "soon", words="--retry", code=2)
    # A folder that is called by a number is a folder.
    room.rename(scratch / "0")
    done = subprocess.run([program, "run", "0", "--normals", "none", "--quiet", "--out", "out"], cwd=scratch, stdout=subprocess.DEVNULL)
    assert done.returncode == 0


CASES = {"pipe": check_pipe, "broken_pipe": check_broken_pipe, "video": check_video, "network": check_network, "rtsp": check_rtsp,
         "device": check_device, "lost": check_lost, "silent": check_silent, "refusals": check_refusals}


def main():
    program, case = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as scratch:
        CASES[case](program, pathlib.Path(scratch))


if __name__ == "__main__":
    main()
