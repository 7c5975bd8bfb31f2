#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`sslam run` on streams: pipes, a camera in the network that this script plays, and cameras that are not there.

Usage: stream.py PROGRAM CASE FAKE_CAMERA   (pipe, broken_pipe, video, network, rtsp, device, lost, silent, refusals)
"""
import contextlib
import csv
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import threading

FRAMES = 40
FILES = ("trajectory.txt", "trajectory_live.txt", "keyframes.txt", "frames.csv", "metrics.json", "report.html", "map.ply")


def make_room(program, scratch):
    room = scratch / "room"
    subprocess.run([program, "synth", room, "--quiet", "--frames", str(FRAMES), "--seed", "3", "--size", "320x240"], check=True)
    return room, [path.read_bytes() for path in sorted((room / "rgb").iterdir())]


class Run:
    """A run whose progress is JSON: nothing else may stand on standard error."""

    def __init__(self, program, *arguments, stdin=subprocess.DEVNULL, env=None):
        self.process = subprocess.Popen([program, "run", *map(str, arguments), "--normals", "none", "--json-progress"], stdin=stdin,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=env)
        self.events = []

    def event(self, kind, words=""):
        """The next one of this kind with these words; None at the end of all progress."""
        for line in self.process.stderr:
            self.events.append(json.loads(line))
            if self.events[-1]["event"] == kind and words in self.events[-1].get("text", ""):
                return self.events[-1]
        return None

    def end(self):
        while self.event("frame"):
            pass
        return self.process.wait()

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)
        return self.end()

    def texts(self, kind):
        return [event["text"] for event in self.events if event["event"] == kind]


def figures(out):
    for name in FILES:
        assert (out / name).exists(), name
    return json.loads((out / "metrics.json").read_text())


def rows(out):
    with open(out / "frames.csv", newline="") as file:
        return list(csv.DictReader(file))


def same_tracking(a, b, stamps=True):
    """Bit for bit."""
    def cells(out):
        return [[value for key, value in row.items() if not key.endswith("_ms") and key != "image" and (stamps or key != "stamp")]
                for row in rows(out)]
    assert cells(a) == cells(b)
    if stamps:
        for name in ("trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply"):
            assert (a / name).read_bytes() == (b / name).read_bytes(), name


def feed(pipe, images):
    with contextlib.suppress(BrokenPipeError), pipe:
        for image in images:
            pipe.write(image)


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
    # OpenCV writes MP4 with its index at the end, where a stream does not get in time.
    with Camera(lambda number, send: send(answers["mp4"])) as camera:
        run = Run(program, camera.address, *options, "--out", scratch / "none")
        assert run.end() == 1 and "index behind the pictures" in run.texts("error")[0], run.events


class Camera:
    """A camera in the network: `play(number, send)` is called for each connection."""

    def __init__(self, play):
        self.server = socket.create_server(("127.0.0.1", 0))
        self.address = "http://127.0.0.1:%d/video" % self.server.getsockname()[1]
        self.connections = []
        self.play = play
        self.thread = threading.Thread(target=self.serve)

    def serve(self):
        players = []
        with contextlib.suppress(OSError):
            while True:
                connection, _ = self.server.accept()
                self.connections.append(connection)
                players.append(threading.Thread(target=self.answer, args=(len(self.connections) - 1, connection)))
                players[-1].start()
        for player in players:
            player.join()

    def answer(self, number, connection):
        with contextlib.suppress(OSError):
            request = b""
            while b"\r\n\r\n" not in request:
                got = connection.recv(4096)
                if not got:
                    return
                request += got
            self.play(number, connection.sendall)
            connection.shutdown(socket.SHUT_RDWR)

    def close(self):
        for connection in [self.server, *self.connections]:
            with contextlib.suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)
            connection.close()

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.close()
        self.thread.join()


class RtspCamera(Camera):
    """The same in the words of RTSP (RFC 2326), with frames as RTP has JPEG (RFC 2435), all by one connection."""

    SDP = b"v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=camera\r\nc=IN IP4 0.0.0.0\r\nt=0 0\r\nm=video 0 RTP/AVP 26\r\na=control:track\r\n"

    def __init__(self, play):
        super().__init__(play)
        self.address = self.address.replace("http", "rtsp")
        self.sequence = 0

    def answer(self, number, connection):
        lines = connection.makefile("rb")
        with contextlib.suppress(OSError):
            while True:
                request = list(iter(lambda: lines.readline().strip(), b""))
                if not request:
                    return
                sent = dict(line.split(b": ", 1) for line in request[1:])
                method = request[0].split()[0]
                head, body = b"", b""
                if method == b"DESCRIBE":
                    head, body = b"Content-Type: application/sdp\r\nContent-Length: %d\r\n" % len(self.SDP), self.SDP
                if method == b"SETUP":
                    assert b"TCP" in sent[b"Transport"], sent
                    head = b"Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\nSession: 1\r\n"
                connection.sendall(b"RTSP/1.0 200 OK\r\nCSeq: %s\r\n%s\r\n%s" % (sent[b"CSeq"], head, body))
                if method == b"PLAY":
                    self.play(number, connection.sendall)
                    connection.shutdown(socket.SHUT_RDWR)
                    return

    def packets(self, jpeg, seconds):
        """An image as RTP packets: its tables and its scan, without its headers."""
        at, tables = 2, b""
        while True:
            code, length = jpeg[at + 1], int.from_bytes(jpeg[at + 2:at + 4], "big")
            segment = jpeg[at + 4:at + 2 + length]
            at += 2 + length
            if code == 0xDB:
                for i in range(0, len(segment), 65):
                    tables += segment[i + 1:i + 65]
            if code == 0xC0:
                height, width = (int.from_bytes(segment[i:i + 2], "big") for i in (1, 3))
                half = segment[7] == 0x22  # rows of colour, too
            if code == 0xDA:
                break
        scan, piece = jpeg[at:-2], 1200
        for start in range(0, len(scan), piece):
            last = start + piece >= len(scan)
            payload = bytes([0]) + start.to_bytes(3, "big") + bytes([1 if half else 0, 255, width // 8, height // 8])
            if start == 0:
                payload += bytes([0, 0]) + len(tables).to_bytes(2, "big") + tables
            payload += scan[start:start + piece]
            packet = bytes([0x80, 26 | (0x80 if last else 0)]) + self.sequence.to_bytes(2, "big")
            packet += (round(90000 * seconds) + 12345).to_bytes(4, "big") + bytes([0, 0, 0, 7]) + payload
            self.sequence = (self.sequence + 1) % 65536
            yield b"$\0" + len(packet).to_bytes(2, "big") + packet


HEAD = b"HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n"


def part(image):
    return b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %d\r\n\r\n" % len(image) + image + b"\r\n"


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
    assert any("lost after frame 19; trying again for 60 s" in text for text in run.texts("warning")), run.events
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
    refused("nonsense://here", words="nonsense://here: cannot be opened: Protocol not found")
    page = b"<html>" + b"a page, and no camera " * 500
    answer = b"HTTP/1.1 200 OK\r\nContent-Type: text/html\r\n\r\n" + page
    with Camera(lambda number, send: send(answer)) as camera:
        refused(camera.address, words="broke off before anything of use came")
    with Camera(lambda number, send: send(b"HTTP/1.1 404 Not Found\r\n\r\n")) as camera:
        refused(camera.address, words="404 Not Found")
    (scratch / "there").mkdir()
    (scratch / "there/file").touch()
    room, images = make_room(program, scratch)
    refused("-", "--camera", room / "camera.yaml", "--record", scratch / "there", given=images[0], words="is there already; name a new folder")
    refused("-", "--retry", "soon", words="--retry", code=2)
    # A folder that is called by a number is a folder.
    room.rename(scratch / "0")
    done = subprocess.run([program, "run", "0", "--normals", "none", "--quiet", "--out", "out"], cwd=scratch, stdout=subprocess.DEVNULL)
    assert done.returncode == 0


def main():
    program, case = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as scratch:
        globals()[f"check_{case}"](program, pathlib.Path(scratch))


if __name__ == "__main__":
    main()
