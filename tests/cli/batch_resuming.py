# SPDX-License-Identifier: BSD-3-Clause
"""What of `sslam batch` survives a kill and an interrupt: cases of batch_test.py."""
import contextlib
import os
import pathlib
import select
import signal
import subprocess
import time

from batch_case import PROGRAM, SUITE, BatchCase, marks


class Resuming(BatchCase):
    def kill_in_the_middle(self, suite, out):
        """Ends a batch by SIGKILL when it has done a run and is at another; returns when that run has ended too."""
        with subprocess.Popen([PROGRAM, "batch", suite, "--out", out, "--jobs", "1"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as batch:
            while batch.poll() is None:
                children = pathlib.Path(f"/proc/{batch.pid}/task/{batch.pid}/children").read_text().split()
                if marks(out) and children:
                    with contextlib.suppress(ProcessLookupError):  # it was over just now
                        child = os.pidfd_open(int(children[0]))
                        batch.kill()
                        select.select([child], [], [])  # a run that goes on without its batch holds up this test for good
                        os.close(child)
                        return
                time.sleep(0.002)
        self.fail("the batch was done before it could be killed")

    def test_kill_loses_the_run_in_progress_alone(self):
        suite, out, whole = self.suite(SUITE), self.folder / "killed", self.folder / "whole"
        self.kill_in_the_middle(suite, out)
        before = marks(out)
        begun = len(list(out.rglob("log.txt")))
        self.assertIn(begun - len(before), (0, 1))
        done = self.batch(suite, "--out", out)
        after = marks(out)
        self.assertEqual(len(after), 8)
        self.assertEqual({run: after[run] for run in before}, before)
        self.assertIn(f"{len(before)} runs were already finished and are kept", done.stderr)
        self.batch(suite, "--out", whole)
        self.assertEqual((out / "table.csv").read_text(), (whole / "table.csv").read_text())

    def test_half_a_run_and_other_settings_are_done_again(self):
        suite, out = self.suite(SUITE, "again.toml"), self.folder / "again"
        self.batch(suite, "--out", out)
        before = marks(out)
        stale = out / "runs/room_a/structure-none/seed-1"
        (stale / "run.json").unlink()
        (stale / "left_over.txt").write_text("of a run that was killed")
        (out / "runs/room_a/structure-none/seed-2/trajectory.txt").unlink()
        (out / "runs/room_a/structure-depth/seed-1/run.json").write_text('{"end": "tra')
        self.batch(suite, "--out", out)
        after = marks(out)
        changed = {run for run in before if before[run] != after[run]}
        self.assertEqual(changed, {f"runs/room_a/{run}" for run in
                                   ("structure-none/seed-1", "structure-none/seed-2", "structure-depth/seed-1")})
        self.assertFalse((stale / "left_over.txt").exists())
        self.suite(SUITE.replace("end = 20", "end = 19"), "again.toml")
        self.batch(suite, "--out", out)
        changed = {run.split("/")[1] for run, when in marks(out).items() if when != after[run]}
        self.assertEqual(changed, {"half-of-it"})

    def test_interrupt_keeps_what_is_done(self):
        suite, out = self.suite(SUITE, "int.toml"), self.folder / "interrupted"
        with subprocess.Popen([PROGRAM, "batch", suite, "--out", out, "--jobs", "1"], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as batch:
            while batch.poll() is None and not marks(out):
                time.sleep(0.002)
            batch.send_signal(signal.SIGINT)
            said = batch.communicate()
        self.assertEqual(batch.returncode, 130, said)
        self.assertIn("interrupted; finished runs are kept", said[1])
        self.assertIn("Not done yet: ", said[0])
        before = marks(out)
        self.batch(suite, "--out", out)
        self.assertEqual({run: marks(out)[run] for run in before}, before)

    def test_one_batch_at_a_time(self):
        suite, out = self.suite(SUITE, "two.toml"), self.folder / "two"
        with subprocess.Popen([PROGRAM, "batch", suite, "--out", out], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as batch:
            while batch.poll() is None and not (out / "batch.json").exists():
                time.sleep(0.002)
            second = self.batch(suite, "--out", out, code=1)
            batch.terminate()
        self.assertIn("another sslam batch is writing there", second.stderr)
