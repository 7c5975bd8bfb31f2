# SPDX-License-Identifier: BSD-3-Clause
"""`sslam run` as a process, and what it left in its folder."""
import contextlib
import csv
import json
import signal
import subprocess

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
