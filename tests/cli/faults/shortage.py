#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the program does when something runs short or goes away: room on the disk, memory, permission, its readers, its
folder, its images. One line, an exit code that says so, and what was there, or was computed, stays whole.

Usage: shortage.py PROGRAM [CASE...]
"""
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

import scenes


class Shortage:
    def __init__(self, program, scratch):
        self.world = scenes.World(program, scratch)
        self.scratch = self.world.scratch
        self.run, self.export = scenes.Run(self.world), scenes.Export(self.world)

    def start(self, arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, before=None, **more):
        return subprocess.run([self.world.program, *map(str, arguments)], stdout=stdout, stderr=stderr, text=True,
                              errors="replace", preexec_fn=before, **more)

    def demand_refused(self, done, what):
        lines = done.stderr.splitlines()
        errors = [line for line in lines if line.startswith("sslam: error: ")]
        scenes.demand(done.returncode == 1 and len(errors) == 1 and lines[-1] == errors[0], f"{done}")
        scenes.demand(re.search(what, errors[0]), f"{errors[0]}: expected {what}")

    def demand_old(self, scene):
        scenes.demand(scenes.content(scene.out) == scenes.content(scene.old), "the old files have changed")
        left = [name for name in (scenes.STAGE, scenes.READY) if (scene.out / name).exists()]
        scenes.demand(not left, f"{left} are left")

    def demand_new(self, scene, code):
        scenes.demand(scene.judge(code) == "new", "the new files are missing")

    def check_full_disk(self):
        """A limit of a file's size looks the same to a program, and needs no disk to fill."""
        made = [self.run, self.export, scenes.Report(self.world), scenes.Synth(self.world)]
        for scene, size in zip([*made, self.run], (3000, 300, 3000, 2000, 20000)):
            scene.restore()
            full = self.start(scene.arguments, before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
            self.demand_refused(full, "cannot write")
            self.demand_old(scene)

    def check_full_output(self):
        """What cannot be printed is told, and costs nothing else."""
        for scene in (self.run, self.export):
            scene.restore()
            with open("/dev/full", "w") as full:
                self.demand_refused(self.start(scene.arguments, stdout=full), "standard output: cannot write: No space left")
            self.demand_new(scene, 1)

    def check_closed_streams(self):
        """Nobody reads any more."""
        read, write = os.pipe()
        os.close(read)
        self.run.restore()
        arguments = [word for word in self.run.arguments if word != "--quiet"] + ["--verbose"]
        done = self.start(arguments, stderr=write)
        scenes.demand(done.returncode == 0, f"{done}")
        self.demand_new(self.run, 0)
        self.run.restore()
        done = self.start(self.run.arguments, stdout=write)
        scenes.demand(done.returncode == -signal.SIGPIPE and done.stderr == "", f"{done}")
        self.demand_new(self.run, done.returncode)
        os.close(write)

    def check_read_only(self):
        """Root may write everywhere: as somebody else."""
        def nobody():
            if os.geteuid() == 0:
                os.setgroups([])
                os.setgid(65534)
                os.setuid(65534)
        self.run.restore()
        os.chmod(self.scratch, 0o755)
        os.chmod(self.run.out, 0o555)
        try:
            done = self.start(self.run.arguments, before=nobody)
        except PermissionError:
            return print("skipped: another user may not start the program")
        finally:
            os.chmod(self.run.out, 0o755)
        self.demand_refused(done, "run/out.*: cannot write: Permission denied")
        self.demand_old(self.run)

    def check_lost_folder(self):
        """The folder of the results goes while the run is on its way, and is made again."""
        self.start_and_spoil(self.run, lambda: shutil.rmtree(self.run.out))
        files = scenes.content(self.run.out)
        scenes.demand_whole_run(files)
        self.demand_new(self.run, 0)

    def check_lost_images(self):
        """The images go while the run is on its way: the frames until then count."""
        room = self.scratch / "room"
        kept = self.scratch / "kept"
        shutil.copytree(room, kept)
        code, said = self.start_and_spoil(self.run, lambda: shutil.rmtree(room / "rgb"))
        shutil.rmtree(room)
        kept.rename(room)
        scenes.demand(code in (0, 1), said)
        lines = [line for line in said.splitlines() if line.startswith("sslam: ")]
        scenes.demand(code == 0 or "no frame was tracked" in lines[-1], said)
        scenes.demand_whole_run(scenes.content(self.run.out))

    def start_and_spoil(self, scene, spoil):
        scene.restore()
        arguments = [word for word in scene.arguments if word != "--quiet"] + ["--verbose"]
        with subprocess.Popen([self.world.program, *map(str, arguments)], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True) as process:
            said = process.stderr.readline()  # of the first frame
            spoil()
            said += process.stderr.read()
        return process.returncode, said

    def check_memory(self):
        """Less and less of it. What the loader of libraries says is not ours."""
        for mib in (420, 400, 380, 360, 340):
            self.run.restore()
            done = self.start(self.run.arguments,
                              before=lambda: resource.setrlimit(resource.RLIMIT_AS, (mib << 20, mib << 20)))
            if done.returncode == 0:
                self.demand_new(self.run, 0)
                continue
            if done.returncode != 127:
                self.demand_refused(done, "memory|Resource temporarily unavailable")
            self.demand_old(self.run)

    def check_surroundings(self):
        """No temporary folder, a comma for a point, and names that shells stumble over."""
        out = self.scratch / 'a "b"\n\'c\' \u00fc $d;' / "out"
        locale = self.scratch / "de_DE.UTF-8"
        if subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", locale], capture_output=True).returncode != 0:
            print("without a comma: there is no localedef, or no de_DE")
        done = self.start(["export", self.world.new_run, "--format", "colmap", "--out", out],
                          env={**os.environ, "TMPDIR": "/nowhere", "LC_ALL": locale.name, "LOCPATH": str(self.scratch)})
        scenes.demand(done.returncode == 0, f"{done}")
        scenes.demand(scenes.content(out) == self.export.new, "other files than usual")


def main():
    cases = sys.argv[2:] or [name[len("check_"):] for name in dir(Shortage) if name.startswith("check_")]
    with tempfile.TemporaryDirectory(prefix="sslam_shortage_") as scratch:
        shortage = Shortage(pathlib.Path(sys.argv[1]).resolve(), scratch)
        for case in cases:
            getattr(shortage, "check_" + case)()
            print(f"{case}: held", flush=True)


if __name__ == "__main__":
    main()
