#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`sslam run` on recordings of ROS 1 and 2 that other programs have written, and `sslam export --format mcap` read back by them.

Usage: bag.py PROGRAM CASE   (ros1, ros2, sqlite, mcap, depth, refusals, export)
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
    import bags
    import exported
    import rosbags.rosbag1  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing} in {sys.executable}; scripts/install_packages --tests fetches it")
    sys.exit(0)

FRAMES = 20


class Sslam:
    def __init__(self, program, scratch):
        self.program, self.scratch = program, scratch
        self.run_program("synth", scratch / "room", "--quiet", "--frames", FRAMES, "--seed", 3, "--size", "320x240", "--image-format",
                         "png")
        self.room = bags.Room(scratch / "room", FRAMES)

    def run_program(self, *arguments, code=0):
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == code, (arguments, done)
        return done

    def run(self, dataset, name, *options, code=0):
        out = self.scratch / name
        done = self.run_program("run", dataset, "--out", out, "--quiet", "--no-report", "--calibration", "fixed", "--normals", "none",
                                *options, code=code)
        return out, done.stderr

    def same_as_folder(self, path, *options):
        """The same poses and map to the bit, and the same truth."""
        if not (self.scratch / "folder").exists():
            self.run(self.room.folder, "folder", *options)
        out, said = self.run(path, pathlib.Path(path).name + "_out", *options)
        for name in ("trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply"):
            assert (out / name).read_bytes() == (self.scratch / "folder" / name).read_bytes(), (path, name)
        truth = [np.loadtxt(folder / "groundtruth.txt") for folder in (out, self.scratch / "folder")]
        assert np.allclose(*truth, rtol=0, atol=1e-8)  # a bag counts nanoseconds
        with open(out / "frames.csv", newline="") as file:
            assert len(list(csv.DictReader(file))) == FRAMES
        return said


def ros1(sslam):
    for compression in (None, "LZ4", "BZ2"):
        path = sslam.scratch / f"{compression}.bag"
        bags.write_ros1(path, sslam.room.messages(depth=None), compression)
        said = sslam.same_as_folder(path)
        assert "the camera is that of" in said and "/camera/camera_info" in said, said
    # Its recorder was killed.
    data = (sslam.scratch / "LZ4.bag").read_bytes()
    (sslam.scratch / "cut.bag").write_bytes(data[:len(data) * 9 // 10])
    _, said = sslam.run(sslam.scratch / "cut.bag", "cut")
    assert "what stands before is used" in said, said


def ros2(sslam):
    path = sslam.scratch / "recording"
    bags.write_ros2(path, sslam.room.messages(packed=True, depth=None))
    sslam.same_as_folder(path)
    (metadata := path / "metadata.yaml").write_text(metadata.read_text().replace("  relative_file_paths:\n", "  relative_file_paths:\n  - gone_1.mcap\n"))
    assert "lists gone_1.mcap, not there" in sslam.run(path, "part", "--end", 5, code=1)[1]
    sslam.run_program("export", sslam.scratch / "recording_out", "--format", "colmap")
    assert "recording_000000.png" in (sslam.scratch / "recording_out" / "colmap" / "images.txt").read_text()
    assert "has no topics" in sslam.run(sslam.room.folder, "none", "--topic", "/camera/image_raw", code=1)[1]


def sqlite(sslam):
    """ROS 2's other storage: as rosbags writes it, and by the tables' documentation as recorders leave it."""
    messages = list(sslam.room.messages(depth=None))
    path = sslam.scratch / "recording"
    bags.write_ros2(path, messages, "SQLITE3")
    assert "the camera is that of" in sslam.same_as_folder(path)
    # Each message packed, and no metadata: the recorder was killed.
    path = sslam.scratch / "packed"
    bags.write_ros2(path, messages, "SQLITE3", per_message=True)
    (path / "metadata.yaml").unlink()
    sslam.same_as_folder(path)
    # In two files, whose tables number the topics in another order. A name may have what a URI has.
    path = sslam.scratch / "two parts?mode=x&%41#"
    path.mkdir()
    images = [m for m in messages if "Image" in m[1]]
    others = [m for m in messages if "Image" not in m[1]]
    bags.write_sqlite(path / "part_0.db3", images[:9] + others).close()
    bags.write_sqlite(path / "part_1.db3", images[9:]).close()
    sslam.same_as_folder(path)
    # What its recorder had not yet put into the file stands in a log beside it.
    live = bags.write_sqlite(sslam.scratch / "live.db3", messages, journal="WAL")
    (sslam.scratch / "copy").mkdir()
    for name in ("live.db3", "live.db3-wal"):
        (sslam.scratch / "copy" / name).write_bytes((sslam.scratch / name).read_bytes())
    live.close()
    assert (sslam.scratch / "copy" / "live.db3").stat().st_size < 100_000
    sslam.same_as_folder(sslam.scratch / "copy" / "live.db3")
    # Spoilt on the way, and cut off.
    whole = bytearray(next((sslam.scratch / "recording").glob("*.db3")).read_bytes())
    (sslam.scratch / "cut.db3").write_bytes(whole[:len(whole) // 2])
    assert ".recover" in sslam.run(sslam.scratch / "cut.db3", "cut", code=1)[1]
    whole[len(whole) * 3 // 4:len(whole) * 3 // 4 + 8192] = b"\xff" * 8192
    (sslam.scratch / "spoilt.db3").write_bytes(whole)
    _, said = sslam.run(sslam.scratch / "spoilt.db3", "spoilt")
    assert "after message" in said and "what stands before is used" in said, said


def mcap_files(sslam):
    messages = list(sslam.room.messages(depth=None))
    for compression in ("NONE", "LZ4", "ZSTD"):
        path = sslam.scratch / f"{compression}.mcap"
        bags.write_mcap(path, messages, compression)
        sslam.same_as_folder(path)
    path = sslam.scratch / "plain.mcap"
    bags.write_mcap(path, messages, "NONE", use_chunking=False)
    sslam.same_as_folder(path)


def depth(sslam):
    """Depth images are paired with the images, and mean what they say."""
    for encoding in ("16UC1", "32FC1"):
        path = sslam.scratch / f"{encoding}.mcap"
        bags.write_mcap(path, sslam.room.messages(packed=True, depth=encoding))
        done = sslam.run_program("run", path, "--out", sslam.scratch / encoding, "--no-report", "--quiet", "--normals", "depth")
        assert "lines alone" not in done.stderr, done.stderr
    # Metres as floats are those of 16 bit: the same normals, so the same poses but for rounding, until the final pass, which
    # takes a feature's place or leaves it.
    poses = [np.loadtxt(sslam.scratch / encoding / "trajectory_live.txt") for encoding in ("16UC1", "32FC1")]
    assert poses[0].shape == poses[1].shape and np.abs(poses[0] - poses[1]).max() < 1e-6


def refusals(sslam):
    def said(path, *options):
        text = sslam.run(path, "refused", *options, code=1)[1].strip()
        assert "\n" not in text.split("error: ", 1)[1], text
        return text

    one = list(sslam.room.messages(packed=True, depth=None, camera=False))[:4]
    two = [(topic.replace("/camera/", "/right/"), *rest) for topic, *rest in one]
    bags.write_mcap(sslam.scratch / "two.mcap", one + two)
    text = said(sslam.scratch / "two.mcap")
    assert "2 topics with images" in text and "/right/image_raw/compressed" in text, text
    assert "names no topic" in said(sslam.scratch / "two.mcap", "--topic", "/nowhere")
    # Other commands take the same topics.
    named = (sslam.scratch / "two.mcap", "--topic", "/right/image_raw/compressed", "--quiet")
    done = sslam.run_program("normals", *named, "--fov", 60, "--out", sslam.scratch / "normals")
    assert "images           4 of 4" in done.stdout, done.stdout
    assert "in any of 4 images" in sslam.run_program("calibrate", *named, code=1).stderr
    sslam.scratch.joinpath("suite.toml").write_text('[[sequence]]\npath = "two.mcap"\nfov = 60\ntopic = "/right/image_raw/compressed"\n')
    sslam.run_program("batch", sslam.scratch / "suite.toml", "--list")
    bags.write_ros2(sslam.scratch / "sqlite", two, "SQLITE3")
    (part,) = (sslam.scratch / "sqlite").glob("*.db3")
    bags.write_mcap(sslam.scratch / "sqlite" / "sqlite.mcap", two)
    assert "both .mcap and .db3" in said(sslam.scratch / "sqlite")
    part.rename(part.with_suffix(".db3.zstd"))
    assert "zstd -d" in said(sslam.scratch / "sqlite")
    part.with_suffix(".db3.zstd").rename(part)
    spoilt_databases(part, said)
    bags.write_ros1(sslam.scratch / "poses.bag", [m for m in sslam.room.messages(packed=True, depth=None) if "Pose" in m[1] or
                                                  "Transform" in m[1]])
    assert "holds no images" in said(sslam.scratch / "poses.bag")
    (sslam.scratch / "text.bag").write_text("hello")
    assert "neither a ROS 1 bag" in said(sslam.scratch / "text.bag")


def spoilt_databases(part, said):
    """Databases that are no bags, or mean harm."""
    import sqlite3
    endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i AS id, 1 AS topic_id, 1 AS timestamp, x'' AS data FROM n"
    for name, statements in {
            "empty": [],
            "columns": ["CREATE TABLE topics(id INTEGER)"],
            "view": ["ALTER TABLE messages RENAME TO m", f"CREATE VIEW messages AS {endless}"],
            "generated": ["DROP TABLE messages", "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, "
                          "data AS (zeroblob(900000000)))", "INSERT INTO messages VALUES (1, 1, 1)"],
            "module": ["DROP TABLE messages", "CREATE VIRTUAL TABLE messages USING fts4(topic_id, timestamp, data)"],
            "keyed": ["DROP TABLE messages", "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data) WITHOUT ROWID"],
    }.items():
        path = part.with_name(f"{name}.db3")
        if name not in ("empty", "columns"):
            path.write_bytes(part.read_bytes())
        with sqlite3.connect(path) as database:
            for statement in statements or ["CREATE TABLE t(x)"]:
                database.execute(statement)
        database.close()
        assert "no bag of ROS 2: it has no table" in said(path), name
    # The root of messages leads back to itself.
    page = int.from_bytes(part.read_bytes()[16:18], "big")
    database = sqlite3.connect(part)
    database.execute("INSERT INTO messages(topic_id, timestamp, data) WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n "
                     "WHERE i < 2000) SELECT 99, i, x'00' FROM n")
    database.commit()
    (root,) = database.execute("SELECT rootpage FROM sqlite_schema WHERE name = 'messages'").fetchone()
    database.close()
    data = bytearray(part.read_bytes())
    assert data[(root - 1) * page] == 5  # of the inner kind
    data[(root - 1) * page + 8:(root - 1) * page + 12] = root.to_bytes(4, "big")
    first = int.from_bytes(data[(root - 1) * page + 12:(root - 1) * page + 14], "big")
    data[(root - 1) * page + first:(root - 1) * page + first + 4] = root.to_bytes(4, "big")
    path = part.with_name("circle.db3")
    path.write_bytes(data)
    assert ".recover" in said(path)


CASES = {"ros1": ros1, "ros2": ros2, "sqlite": sqlite, "mcap": mcap_files, "depth": depth, "refusals": refusals, "export": exported.check}

if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="sslam_bag_") as folder:
        CASES[sys.argv[2]](Sslam(sys.argv[1], pathlib.Path(folder)))
