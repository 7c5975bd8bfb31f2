# SPDX-License-Identifier: BSD-3-Clause
"""Runs that faults.py interrupts: live ones, those that keep checkpoints, and those that go on from one."""
import json
import subprocess

import scenes
from scenes import demand

EACH_FRAME = ("--checkpoint", "1e-6")
# Long enough for a map that a run can go on in: it begins at the 17th frame.
FRAMES, WITH_MAP = 32, 24


class Live(scenes.Run):
    """Frames at the pace of a camera, and mapping in a thread of its own."""
    name = "live"

    def __init__(self, world):
        super().__init__(world)
        images = world.room / "rgb" / "*.jpg"
        self.arguments = ["run", images, "--camera", world.room / "camera.yaml", "--fps", "60", "--live", "--calibration", "fixed",
                          "--normals", "none", "--quiet", "--out", self.out]


class Checkpoints(scenes.Run):
    """Whatever stopped it, it goes on to complete results; or there is nothing to go on from, and that is said."""
    name = "checkpoints"

    def __init__(self, world):
        super().__init__(world)
        room = self.home / "room"
        world.must("synth", room, "--frames", FRAMES, "--fps", "15", "--size", "320x240", *scenes.PLAIN, "--seed", "3")
        self.arguments = ["run", room, "--normals", "none", "--quiet", *EACH_FRAME, "--out", self.out]

    def judge(self, code):
        found = super().judge(code)
        going_on = self.world.sslam("run", "--resume", self.out, "--quiet")
        if "holds no checkpoint" not in going_on.stderr:
            self.demand_complete(going_on)
            return found + ", gone on"
        demand(going_on.returncode == 1 and going_on.stderr.count("\n") == 1, going_on.stderr)
        if found == "old":
            return "old, nothing to go on from"
        files = scenes.content(self.out)
        empty = files["frames.csv"].count(b"\n") == 1
        demand(empty or not json.loads(files["metrics.json"])["interrupted"], "the checkpoint is missing")
        return "new, complete"

    def demand_complete(self, going_on):
        files = scenes.content(self.out)
        scenes.demand_whole_run(files)
        metrics = json.loads(files["metrics.json"])
        demand(going_on.returncode == (0 if metrics["tracked"] else 1), going_on.stderr)
        rows = files["frames.csv"].count(b"\n") - 1
        demand(rows == metrics["frames"] == FRAMES and not metrics["interrupted"], f"{rows} frames")
        demand(not list(self.out.glob(scenes.CHECKPOINT + "*")), "the checkpoint is still there")


class Resume(Checkpoints):
    """A run that goes on is struck itself."""
    name = "resume"

    def __init__(self, world):
        super().__init__(world)
        command = [world.program, "run", self.home / "room", "--normals", "none", *EACH_FRAME, "--json-progress", "--out", self.old]
        with subprocess.Popen([*map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            for line in process.stderr:
                if f'"done":{WITH_MAP},' in line:
                    process.kill()
        demand((self.old / scenes.CHECKPOINT).exists(), "no checkpoint to begin with")
        self.arguments = ["run", "--resume", self.out, "--quiet"]
