# SPDX-License-Identifier: BSD-3-Clause
"""Commands that faults.py interrupts: what each replaces, and how to tell whose files stand there afterwards."""
import csv
import json
import pathlib
import re
import shutil
import subprocess

PLAIN = ("--no-depth", "--no-normals", "--texture", "poor", "--quiet")
SMALL = ("--frames", "14", "--fps", "8", "--size", "240x180", *PLAIN)
FOREIGN = "is not the file that belongs to metrics.json"
READY, STAGE, CHECKPOINT = ".sslam-ready", ".sslam-new", ".sslam-checkpoint"  # docs/run.md says what they are
MODEL = pathlib.Path(__file__).parents[2] / "opencv" / "fixtures" / "tiny_normals.onnx"


class Mixture(Exception):
    """Files of two sets, or a set that is not whole."""


def demand(holds, what):
    if not holds:
        raise Mixture(what)


def content(folder):
    """Every file below a folder, but what stands beside it on its way to its name."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted(folder.rglob("*"))
            if file.is_file() and not {READY, STAGE, CHECKPOINT} & set(file.relative_to(folder).parts) and file.suffix != ".part"}


def fnv1a(data):
    value = 0xCBF29CE484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"


def demand_whole_run(files):
    """By the checksums in metrics.json: each file is of this run, and none is missing or of another."""
    metrics = json.loads(files["metrics.json"])
    wanted = metrics["files"]
    there = set(files) - {"metrics.json", "report.html", "log.txt", "run.json"}
    demand(there == set(wanted), f"files {sorted(there ^ set(wanted))}")
    for name in wanted:
        demand(fnv1a(files[name]) == wanted[name], f"{name} is of another run")


class Scene:
    """One command that writes into `out`, over what stands in `old`."""
    watched = False  # whether the stage appears when the writing begins

    def __init__(self, world):
        self.world = world
        self.home = world.scratch / self.name
        self.old, self.out = self.home / "old", self.home / "out"
        self.home.mkdir()

    def restore(self):
        shutil.rmtree(self.out, ignore_errors=True)
        shutil.copytree(self.old, self.out)

    def look(self):
        """A copy to look at, so that looking changes nothing."""
        copy = self.world.scratch / "looked" / "out"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(self.out, copy)
        return copy


class Run(Scene):
    name = "run"
    watched = True

    def __init__(self, world):
        super().__init__(world)
        shutil.copytree(world.old_run, self.old)
        self.arguments = ["run", world.room, "--normals", "none", "--quiet", "--out", self.out]

    def judge(self, code):
        if not (self.out / READY).exists() and content(self.out) == content(self.old):
            demand(code not in (0, 130), "the new results are missing")
            return "old"
        copy = self.look()
        page = copy / READY / "report.html"
        page = (page if page.exists() else copy / "report.html").read_bytes()
        looked = self.world.sslam("report", copy)
        demand(looked.returncode == 0 and FOREIGN not in looked.stderr, looked.stderr)
        demand(not (copy / READY).exists(), "the set was not brought to its names")
        files = content(copy)
        demand_whole_run(files)
        demand(files["report.html"] == page, "report.html is of another run")
        return "new"


class Export(Scene):
    name = "export"
    watched = True

    def __init__(self, world):
        super().__init__(world)
        world.must("export", world.old_run, "--format", "colmap", "--out", self.old)
        self.arguments = ["export", world.new_run, "--format", "colmap", "--out", self.out]
        self.new = world.new_files(self)

    def judge(self, code):
        if (self.out / READY).exists():
            self.world.must(*self.arguments)
        files = content(self.out)
        if files == content(self.old):
            demand(code != 0, "the new files are missing")
            return "old"
        demand(files == self.new, f"{sorted(files)} are neither the old set nor the new one")
        return "new"


class Report(Export):
    name = "report"
    watched = False

    def __init__(self, world):
        Scene.__init__(self, world)
        shutil.copytree(world.new_run, self.old)
        (self.old / "report.html").write_bytes((world.old_run / "report.html").read_bytes())
        self.arguments = ["report", self.out]
        self.new = world.new_files(self)


class Batch(Scene):
    name = "batch"
    tables = ("tables.md", "tables.tex", "tables.html", "table.csv", "common_frames.csv", "runs.csv")

    def __init__(self, world):
        super().__init__(world)
        for name in ("old", "new"):
            (self.home / f"{name}.toml").write_text(
                f'seeds = [1, 2]\n[[sequence]]\npath = "{world.room}"\n[[method]]\nname = "{name}-method"\nnormals = "none"\n')
        world.must("batch", self.home / "old.toml", "--out", self.old, "--quiet")
        self.arguments = ["batch", self.home / "new.toml", "--out", self.out, "--quiet"]

    def whose(self):
        """Every table names its method."""
        names = {name for table in self.tables for name in re.findall(r"(old|new)-method", (self.out / table).read_text())}
        demand(len(names) == 1, "tables of two batches")
        (name,) = names
        with open(self.out / "runs.csv", newline="") as file:
            waiting = [run["state"] for run in csv.DictReader(file)].count("not done")
        said = re.search(r"Not done yet: (\d+)", (self.out / "tables.md").read_text())
        demand(waiting == (int(said[1]) if said else 0), "tables of two moments")
        return name

    def judge(self, code):
        for mark in self.out.rglob("run.json"):
            demand_whole_run(content(mark.parent))
        found = "new" if (self.out / READY).exists() else self.whose()
        demand(found == "new" or code not in (0, 130), "the new tables are missing")
        self.world.must(*self.arguments)  # goes on from there
        demand(self.whose() == "new" and "not done" not in (self.out / "runs.csv").read_text(), "no going on")
        return found


class Synth(Scene):
    name = "synth"

    def __init__(self, world):
        super().__init__(world)
        world.must("synth", self.old, *SMALL, "--seed", "4")
        self.arguments = ["synth", self.out, *SMALL, "--seed", "5"]
        self.new = world.new_files(self)

    def judge(self, code):
        folder = self.out
        if (self.out / READY).exists():
            folder = self.look()
            self.world.must("eval", folder, folder / "groundtruth.txt")  # reads the dataset
        files = content(folder)
        if files == content(self.old):
            demand(code != 0, "the new images are missing")
            return "old"
        demand(code != 0 or files == self.new, "not all of the new images")
        rows = {files[name].count(b"\n") for name in ("rgb.txt", "groundtruth.txt")}
        demand(len(rows) == 1, "lists of two lengths")
        for name, data in files.items():
            listed = name in ("rgb.txt", "groundtruth.txt")
            demand(self.new[name].startswith(data) if listed else data == self.new[name] or name == "synth.toml", name)
        for line in files["rgb.txt"].decode().splitlines()[1:]:
            demand(line.split()[1] in files, f"{line}: the image is missing")
        return "new"


class Normals(Scene):
    """No set: each file by itself is the old one or the new one, and whole."""
    name = "normals"

    def __init__(self, world):
        super().__init__(world)
        before = self.home / "room"
        world.must("synth", before, *SMALL, "--seed", "4")
        world.must("normals", before, "--model", MODEL, "--quiet", "--out", self.old)
        self.arguments = ["normals", world.room, "--model", MODEL, "--quiet", "--out", self.out]
        self.new = world.new_files(self)

    def judge(self, code):
        files, old = content(self.out), content(self.old)
        demand(set(files) == set(old), f"files {sorted(set(files) ^ set(old))}")
        for name, data in files.items():
            demand(data == self.new[name] or (code != 0 and data == old[name]), f"{name} is neither the old file nor the new one")
        return "old" if files == old else "new" if files == self.new else "old and new files"


class World:
    """What all scenes begin with: a room, and two runs through it."""

    def __init__(self, program, scratch):
        self.program, self.scratch = program, pathlib.Path(scratch)
        self.room, self.old_run, self.new_run = (self.scratch / name for name in ("room", "old_run", "new_run"))
        self.must("synth", self.room, *SMALL, "--seed", "3")
        self.must("run", self.room, "--normals", "none", "--quiet", "--end", "13", "--out", self.old_run)
        self.must("run", self.room, "--normals", "none", "--quiet", "--out", self.new_run)

    def sslam(self, *arguments):
        return subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True)

    def must(self, *arguments):
        done = self.sslam(*arguments)
        demand(done.returncode == 0, f"{' '.join(map(str, arguments))}: {done.returncode}: {done.stderr}")

    def new_files(self, scene):
        scene.restore()
        self.must(*scene.arguments)
        return content(scene.out)
