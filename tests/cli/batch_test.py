#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`sslam batch` on small rendered rooms: its tables, and what survives a kill. SSLAM_COMMAND names the program.

Usage: batch_test.py [CASE...]
"""
import csv
import html.parser
import json
import re
import shutil
import unittest

from batch_case import FRAMES, SUITE, BatchCase, marks, sslam
from batch_resuming import Resuming  # noqa: F401


class TagCheck(html.parser.HTMLParser):
    """Refuses tags that are not closed in order; counts the others."""

    def __init__(self):
        super().__init__()
        self.open, self.count = [], {}

    def handle_starttag(self, tag, attrs):
        self.count[tag] = self.count.get(tag, 0) + 1
        if tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open.pop() == tag, tag


class Tables(BatchCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        truth = (cls.folder / "room/groundtruth.txt").read_text().splitlines()
        poses = [line for line in truth if not line.startswith("#")]
        (cls.folder / "other.txt").write_text("\n".join(poses[5:25]) + "\n")
        (cls.folder / "suite.toml").write_text(
            SUITE + '[[reference]]\nname = "Other_system"\nmin_tracked = 0.6\ntrajectories = {room_a = "other.txt"}\n')
        cls.out = cls.folder / "out"
        cls.done = sslam("batch", cls.folder / "suite.toml", "--out", cls.out)

    def test_all_is_tracked(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertEqual({run["state"] for run in self.runs(self.out)}, {"tracked"})
        self.assertEqual(len(self.runs(self.out)), 2 * 2 * 2 + 1)
        self.assertFalse((self.out / "runs/room_a/structure-none/seed-1/report.html").exists())

    def test_figures_are_those_of_eval(self):
        for place, name in ((self.out / "runs/room_a/structure-depth/seed-2/trajectory.txt", "room_a, structure, depth, seed 2"),
                            (self.folder / "other.txt", "room_a, Other_system, room_a-1.txt")):
            figures = self.folder / "eval.json"
            self.assertEqual(sslam("eval", self.folder / "room", place, "--json", figures).returncode, 0)
            wanted = json.loads(figures.read_text())
            (row,) = [run for run in self.runs(self.out) if run["run"] == name]
            self.assertAlmostEqual(float(row["ate_rmse_m"]), wanted["ate_m"]["rmse"], places=5)
            self.assertAlmostEqual(float(row["share_tracked"]), wanted["share_tracked"], places=5)
            self.assertAlmostEqual(float(row["rotation_rmse_deg"]), wanted["rotation_own_offset_deg"]["rmse"], places=5)
        metrics = json.loads((self.out / "runs/room_a/structure-none/seed-1/metrics.json").read_text())
        (row,) = [run for run in self.runs(self.out) if run["run"] == "room_a, structure, none, seed 1"]
        self.assertAlmostEqual(float(row["frames_per_second"]), metrics["times"]["frames_per_second"], places=5)
        self.assertRegex((self.out / "tables.md").read_text(), r"\| room\\_a \| \d+\.\d\d deg, \d+\.\d / s \|")

    def test_csv_has_medians_and_shares(self):
        with open(self.out / "table.csv", newline="") as file:
            first, second = csv.DictReader(file)
        self.assertEqual((first["sequence"], second["sequence"]), ("room_a", "half of it"))
        for method in ("structure, none", "structure, depth"):
            errors = [float(run["ate_rmse_m"]) for run in self.runs(self.out)
                      if (run["sequence"], run["method"]) == ("room_a", method)]
            self.assertAlmostEqual(float(first[method + ": ATE RMSE (m)"]), sum(errors) / 2, places=5)
            self.assertEqual(float(first[method + ": share tracked"]), 1)
        self.assertAlmostEqual(float(first["Other_system: share tracked"]), 20 / FRAMES, places=5)
        self.assertEqual(second["Other_system: ATE RMSE (m)"], "")

    def test_common_frames_are_those_of_all(self):
        text = (self.out / "tables.md").read_text()
        self.assertIn(f"(20 of {FRAMES} frames)", text)
        self.assertIn("(20 of 20 frames)", text)
        (row,) = [run for run in self.runs(self.out) if run["run"] == "room_a, structure, none, seed 1"]
        estimate = (self.out / "runs/room_a/structure-none/seed-1/trajectory.txt").read_text().splitlines()
        cut = self.folder / "cut.txt"
        cut.write_text("\n".join(estimate[1:][5:25]) + "\n")
        sslam("eval", self.folder / "room", cut, "--json", self.folder / "cut.json")
        wanted = json.loads((self.folder / "cut.json").read_text())["ate_m"]["rmse"]
        self.assertAlmostEqual(float(row["ate_rmse_common_frames_m"]), wanted, places=5)

    def test_markdown(self):
        lines = [line for line in (self.out / "tables.md").read_text().splitlines() if line.startswith("|")]
        self.assertEqual(len(lines), 3 * 4)
        self.assertEqual({len(re.findall(r"(?<!\\)\|", line)) for line in lines}, {3 + 2})
        self.assertIn("room\\_a", lines[2])
        self.assertRegex(lines[2], r"\*\*0\.0000 \(67 %\)\*\*")
        self.assertIn(lines[3], self.done.stdout)

    def test_latex(self):
        text = (self.out / "tables.tex").read_text()
        depth = 0
        for char in re.sub(r"\\[{}%&#_$]|(?m:^%.*$)", "", text):
            depth += {"{": 1, "}": -1}.get(char, 0)
            self.assertGreaterEqual(depth, 0)
        self.assertEqual(depth, 0)
        rows = [line for line in text.splitlines() if line.endswith(r"\\")]
        self.assertEqual(len(rows), 3 * 3)
        self.assertEqual({len(re.findall(r"(?<!\\)&", row)) for row in rows}, {3})
        self.assertEqual(text.count(r"\begin{tabular}{lccc}"), 3)
        self.assertIn(r"\textbf{0.0000 (67 \%)}", text)

    def test_html(self):
        text = (self.out / "tables.html").read_text()
        check = TagCheck()
        check.feed(text)
        self.assertEqual(check.open, [])
        self.assertEqual((check.count["table"], check.count["tr"], check.count["td"]), (3, 9, 18))
        self.assertIn("<title>Small &amp; rooms</title>", text)

    def test_an_ensemble_of_starts_shows_its_spread(self):
        """Also: options of `sslam run` in a suite, and links to reports."""
        (self.folder / "mask.pgm").write_bytes(b"P5 320 240 255\n" + bytes([255]) * 320 * 240)
        suite = self.suite('report = true\nstarts = [0, 4]\n[[sequence]]\npath = "room"\nend = 16\nmask = "mask.pgm"\n'
                           'scale = "known=1.5"\n[[method]]\nname = "quick"\nnormals = "none"\nno-final-pass = true\n'
                           'calibration = "fixed"\n', "starts.toml")
        out = self.folder / "starts"
        done = self.batch(suite, "--out", out)
        place = out / "runs/room/quick/start-4-seed-1"
        settings = json.loads((place / "metrics.json").read_text())["settings"]
        self.assertEqual((settings["start"], settings["final_pass"], settings["scale"]), (4, False, "known=1.5"))
        first, second = self.runs(out)
        self.assertEqual((first["run"], second["run"]), ("room, quick, start 0, seed 1", "room, quick, start 4, seed 1"))
        poses = [line for line in (place / "trajectory.txt").read_text().splitlines() if line[0] != "#"]
        self.assertAlmostEqual(float(second["share_tracked"]), len(poses) / 12, places=5)
        with open(out / "table.csv", newline="") as file:
            (row,) = csv.DictReader(file)
        errors, shares = ([float(run[name]) for run in (first, second)] for name in ("ate_rmse_m", "share_tracked"))
        self.assertAlmostEqual(float(row["quick: ATE RMSE (m)"]), sum(errors) / 2, places=5)
        self.assertAlmostEqual(float(row["quick: worst ATE RMSE (m)"]), max(errors), places=5)
        self.assertAlmostEqual(float(row["quick: least share tracked"]), min(shares), places=5)
        self.assertRegex(done.stdout, r"\| room \| \*\*\d\.\d{4} / \d\.\d{4} \(\d+ / \d+ %\)\*\* \|")
        self.assertIn(" of 28 frames)", (out / "tables.md").read_text())
        for link in re.findall(r'href="([^"]+)"', (out / "tables.html").read_text()):
            self.assertTrue((out / link).is_file(), link)
        self.assertIn("](runs/room/quick/start-4-seed-1/report.html)", (out / "tables.md").read_text())

    def test_an_earlier_batch_stands_beside(self):
        again = self.batch(self.folder / "suite.toml", "--out", self.out, "--against", self.out)
        self.assertIn("8 runs were already finished and are kept", again.stderr)
        self.assertIn("structure, none (out)", again.stdout)
        self.batch(self.folder / "suite.toml", "--out", self.out)


class Shards(BatchCase):
    def test_merged_shards_are_the_whole(self):
        suite, out = self.suite(SUITE), self.folder / "sharded"
        for shard in ("1/3", "2/3", "3/3"):
            self.batch(suite, "--out", out, "--shard", shard)
        shards = sorted(out.glob("shard-*-of-3"))
        self.assertEqual([len(marks(shard)) for shard in shards], [3, 3, 2])
        merged, whole = self.folder / "merged", self.folder / "whole"
        self.batch("merge", *shards, "--out", merged)
        self.batch(suite, "--out", whole)
        for name in ("table.csv", "common_frames.csv", "tables.md", "tables.tex", "tables.html"):
            same, wanted = ((folder / name).read_text().split("Rotation error")[0] for folder in (merged, whole))
            self.assertEqual(same, wanted)
        beside = self.batch(suite, "--out", whole, "--against", merged)
        self.assertIn("structure, none (merged)", beside.stdout)
        self.assertIn("is one of the folders to merge", self.batch("merge", *shards, "--out", shards[0], code=1).stderr)
        lacking = self.batch("merge", *shards[:2], "--out", self.folder / "lacking", code=1)
        self.assertIn("2 of 8 runs are in none of these folders", lacking.stderr)
        self.assertIn("Not done yet: 2 runs", lacking.stdout)
        other = self.folder / "other"
        self.batch(self.suite(SUITE.replace("end = 20", "end = 15"), "other.toml"), "--out", other)
        self.assertIn("is not a shard of the same suite as", self.batch("merge", shards[0], other, code=1).stderr)


class Failures(BatchCase):
    def test_they_stand_in_the_table_and_stop_nobody(self):
        shutil.copytree(self.folder / "room", self.folder / "broken")
        shutil.copytree(self.folder / "room", self.folder / "still")
        for image in (self.folder / "broken/rgb").iterdir():
            image.write_bytes(b"no image")
        frames = sorted((self.folder / "still/rgb").iterdir())
        for image in frames[1:]:
            shutil.copy(frames[0], image)
        suite = self.suite('[[sequence]]\npath = "broken"\n[[sequence]]\npath = "still"\n[[sequence]]\npath = "room"\n'
                           '[[method]]\nnormals = "none"\n')
        out = self.folder / "out"
        done = self.batch(suite, "--out", out, code=1)
        self.assertRegex(done.stderr, r"sslam: error: 1 of 3 runs failed unexpectedly; [^\n]*tables.md says why[^\n]*\n$")
        self.assertEqual([run["state"] for run in self.runs(out)], ["failed", "lost", "tracked"])
        text = (out / "tables.md").read_text()
        self.assertRegex(text, r"\| broken \| failed \|")
        self.assertRegex(text, "\\| still \\| \u00d7 \\(0 %\\) \\|")
        self.assertRegex(text, r"- Failed unexpectedly: broken, structure, none, seed 1: [^\n]*no image could be read")
        self.assertRegex(text, r"- Lost: still, structure, none, seed 1: ")
        self.assertIn("$\\times$", (out / "tables.tex").read_text())
        # A failure may have had a cause that is gone: it is tried again, and the others are kept.
        before = marks(out)
        shutil.rmtree(self.folder / "broken")
        shutil.copytree(self.folder / "room", self.folder / "broken")
        self.batch(suite, "--out", out)
        changed = {run.split("/")[1] for run, when in marks(out).items() if when != before[run]}
        self.assertEqual(changed, {"broken"})

    def test_too_little_tracked_is_lost(self):
        suite = self.suite('min_tracked = 1.0\n[[sequence]]\npath = "room"\n[[method]]\nnormals = "none"\n'
                           '[[reference]]\nname = "Sparse"\ntrajectories = {room = "sparse.txt"}\n', "strict.toml")
        truth = (self.folder / "room/groundtruth.txt").read_text().splitlines()
        (self.folder / "sparse.txt").write_text("\n".join(truth[::3]) + "\n")
        done = self.batch(suite, "--out", self.folder / "strict")
        self.assertRegex(done.stdout, "Lost: room, Sparse, room-1.txt: tracked [0-9.]+ % of the frames, less than 100.0 %")


if __name__ == "__main__":
    unittest.main(verbosity=2)
