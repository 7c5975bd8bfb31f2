#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Signals in the middle of the program's commands: whatever comes, a folder holds the old set of files or the new one.

Usage: faults.py PROGRAM [--faults N] [--seed S]
"""
import argparse
import collections
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

import run_scenes
import scenes

# The signals of one fault, in turn: Ctrl-C, kill, a closed terminal, kill -9, an impatient Ctrl-C.
KINDS = {"INT": [signal.SIGINT], "TERM": [signal.SIGTERM], "HUP": [signal.SIGHUP], "KILL": [signal.SIGKILL],
         "INT twice": [signal.SIGINT, signal.SIGINT]}


# Of all faults, how many strike which command.
SHARES = {scenes.Run: 6, scenes.Export: 2, scenes.Report: 2, scenes.Batch: 3, scenes.Synth: 2, scenes.Normals: 2,
          run_scenes.Live: 2, run_scenes.Checkpoints: 4, run_scenes.Resume: 3}


def start(scene):
    return subprocess.Popen([scene.world.program, *map(str, scene.arguments)], stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, text=True)


def wait_for_stage(scene, process):
    while process.poll() is None and not (scene.out / scenes.STAGE).exists():
        time.sleep(0.0002)


def measure(scene):
    """How long the command takes, and its writing."""
    scene.restore()
    begin = time.monotonic()
    process = start(scene)
    writing = begin
    if scene.watched:
        wait_for_stage(scene, process)
        writing = time.monotonic()
    _, said = process.communicate()
    scenes.demand(process.returncode == 0, said)
    end = time.monotonic()
    return end - begin, end - writing


def strike(scene, kind, moment, in_writing):
    """One fault; the exit code, and which set is there."""
    scene.restore()
    process = start(scene)
    if in_writing:
        wait_for_stage(scene, process)
    time.sleep(moment)
    for number in KINDS[kind]:
        process.send_signal(number)
    _, said = process.communicate()
    code = process.returncode
    allowed = {0, 130, *(-number for number in KINDS[kind])}
    if kind == "KILL" or scene.name in ("export", "report"):
        allowed -= {130}  # which says that something was kept
    scenes.demand(code in allowed, f"exit code {code}: {said}")
    scenes.demand("error" not in said, said)
    found = scene.judge(code)
    soft = len(KINDS[kind]) == 1 and kind != "KILL"
    scenes.demand(not (soft and in_writing and isinstance(scene, scenes.Run)) or found.startswith("new"), "one signal cost the results")
    return code, found


def strike_all(scene, count, rng):
    whole, writing = measure(scene)
    kinds = list(KINDS)
    tally = collections.Counter()
    for i in range(count):
        if i % len(kinds) == 0:
            rng.shuffle(kinds)
        kind = kinds[i % len(kinds)]
        in_writing = scene.watched and i % 2 == 1  # a short moment that chance alone seldom hits
        moment = (i + rng.random()) / count * (writing if in_writing else whole)
        try:
            code, found = strike(scene, kind, moment, in_writing)
        except (scenes.Mixture, OSError, KeyError, ValueError) as problem:
            since = "the writing began" if in_writing else "the start"
            sys.exit(f"{scene.name}: SIG{kind} {moment:.4f} s after {since}: {type(problem).__name__}: {problem}")
        tally[found] += 1
        tally["code " + str(code)] += 1
    counts = ", ".join(f"{what} {tally[what]}" for what in sorted(tally))
    print(f"{scene.name}: {count} faults: {counts}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--faults", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    rng = random.Random(options.seed)
    parts = sum(SHARES.values())
    with tempfile.TemporaryDirectory(prefix="sslam_faults_") as scratch:
        world = scenes.World(options.program.resolve(), scratch)
        for scene, share in SHARES.items():
            strike_all(scene(world), max(1, options.faults * share // parts), rng)


if __name__ == "__main__":
    main()
