#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`sslam fetch` from a server on this machine: resuming, verifying, unpacking. SSLAM_COMMAND names the program."""
import http.server
import io
import os
import pathlib
import re
import shutil
import subprocess
import tarfile
import tempfile
import threading
import unittest

PROGRAM = os.environ["SSLAM_COMMAND"]
TUM = "rgbd_dataset_freiburg3_structure_notexture_far"
ICL = "living_room_traj1_frei_png"


def sslam(*arguments):
    environment = {**os.environ, "no_proxy": "127.0.0.1"}
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, env=environment)


class Handler(http.server.BaseHTTPRequestHandler):
    """Serves server.files, from a byte on where asked to; server.cut ends the first answer after so many bytes; with
    server.redirects, each answer leads on to another place."""

    def do_GET(self):
        server = self.server
        wanted = self.headers.get("Range")
        server.ranges.append(wanted)
        data = server.files.get(self.path.lstrip("/"))
        if server.redirects:
            self.send_response(302)
            self.send_header("Location", self.path + "x")
            return self.end_headers()
        if data is None:
            return self.send_error(404)
        start = int(re.match(r"bytes=(\d+)-", wanted).group(1)) if wanted and server.resumes else 0
        if start >= len(data):
            return self.send_error(416)
        self.send_response(206 if start else 200)
        if start:
            self.send_header("Content-Range", f"bytes {start}-{len(data) - 1}/{len(data)}")
        self.send_header("Content-Length", str(len(data) - start))
        self.end_headers()
        end = start + server.cut if server.cut else len(data)
        server.cut = 0
        self.wfile.write(data[start:end])

    def log_message(self, *_):
        pass


class Fetch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="sslam_fetch_")
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.room = cls.folder / "room"
        made = sslam("synth", cls.room, "--frames", 4, "--size", "160x120", "--image-format", "png", "--quiet")
        assert made.returncode == 0, made.stderr
        cls.icl = cls.folder / "icl"
        (cls.icl / "rgb").mkdir(parents=True)
        poses = [line for line in (cls.room / "groundtruth.txt").read_text().splitlines() if not line.startswith("#")]
        truth = []
        for i, image in enumerate(sorted((cls.room / "rgb").iterdir()), 1):
            shutil.copy(image, cls.icl / f"rgb/{i}.png")
            truth.append(" ".join([str(i), *poses[i - 1].split()[1:]]))
        (cls.icl / "livingRoom1.gt.freiburg").write_text("\n".join(truth) + "\n")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def setUp(self):
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.server.files, self.server.ranges, self.server.cut, self.server.resumes = {}, [], 0, True
        self.server.redirects = False
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.out = self.folder / self.id().split(".")[-1]
        self.files = self.server.files

    def tearDown(self):
        self.server.shutdown()
        self.server.server_close()

    def pack(self, folder, inside):
        buffer = io.BytesIO()
        with tarfile.open(fileobj=buffer, mode="w:gz") as tar:
            tar.add(folder, arcname=inside)
        return buffer.getvalue()

    def fetch(self, *arguments, code=0):
        address = f"http://127.0.0.1:{self.server.server_port}"
        done = sslam("fetch", *arguments, "--mirror", address, "--out", self.out, "--quiet")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        if code:
            self.assertRegex(done.stderr, r"^sslam: error: [^\n]*\n$")
        return done

    def test_both_layouts_are_unpacked_and_opened(self):
        self.files[TUM + ".tgz"] = self.pack(self.room, TUM)
        self.files[ICL + ".tar.gz"] = self.pack(self.icl, ".")
        done = self.fetch("s-not-far", "lr-kt1")
        self.assertRegex(done.stdout, rf"s-not-far +[^\n]*/{TUM}: 4 frames, TUM RGB-D, with ground truth")
        self.assertRegex(done.stdout, rf"lr-kt1 +[^\n]*/{ICL}: 4 frames, ICL-NUIM, with ground truth")
        self.assertEqual(sorted(path.name for path in self.out.iterdir()), sorted([TUM, ICL]))
        self.assertEqual((self.out / TUM / "rgb.txt").read_text(), (self.room / "rgb.txt").read_text())
        asked = len(self.server.ranges)
        self.fetch("s-not-far", "lr-kt1")
        self.assertEqual(len(self.server.ranges), asked, "fetched again what is there")

    def test_a_lost_connection_is_resumed(self):
        data = self.files[TUM + ".tgz"] = self.pack(self.room, TUM)
        self.server.cut = len(data) // 3
        done = self.fetch("s-not-far", code=1)
        self.assertIn("the same command continues the download", done.stderr)
        part = self.out / (TUM + ".tgz.part")
        self.assertEqual(part.stat().st_size, len(data) // 3)
        self.fetch("s-not-far", "--keep-archive")
        self.assertEqual(self.server.ranges, [None, f"bytes={len(data) // 3}-"])
        self.assertEqual((self.out / (TUM + ".tgz")).read_bytes(), data)

    def test_a_server_that_cannot_resume(self):
        data = self.files[TUM + ".tgz"] = self.pack(self.room, TUM)
        self.server.cut, self.server.resumes = 1000, False
        self.fetch("s-not-far", code=1)
        self.fetch("s-not-far", "--keep-archive")
        self.assertEqual((self.out / (TUM + ".tgz")).read_bytes(), data)

    def test_a_rest_of_something_longer_is_thrown_away(self):
        data = self.files[TUM + ".tgz"] = self.pack(self.room, TUM)
        self.out.mkdir()
        (self.out / (TUM + ".tgz.part")).write_bytes(data + b"more")
        self.fetch("s-not-far", "--keep-archive")
        self.assertEqual((self.out / (TUM + ".tgz")).read_bytes(), data)

    def refused(self, data, what):
        self.files[TUM + ".tgz"] = data
        self.assertIn(what, self.fetch("s-not-far", code=1).stderr)
        self.assertEqual(list(self.out.iterdir()), [])

    def test_a_damaged_archive_is_removed(self):
        data = bytearray(self.pack(self.room, TUM))
        data[len(data) // 2] ^= 0xFF
        self.refused(bytes(data), "is damaged (")

    def test_a_page_instead_of_an_archive(self):
        self.refused(b"<html>log in first</html>" * 100, "is damaged (")

    def test_an_archive_of_something_else(self):
        self.refused(self.pack(self.room / "camera.yaml", TUM + "/camera.yaml"), "does not hold the sequence (")

    def test_an_archive_that_leads_out_of_its_folder(self):
        self.refused(self.pack(self.room / "camera.yaml", "../../evil.yaml"), "which leads out of its folder")
        self.assertFalse((self.folder / "evil.yaml").exists())

    def test_what_is_not_there(self):
        self.assertRegex(self.fetch("s-not-far", code=1).stderr, "404.*check the network and the address")
        self.assertIn("'lr-kt9' is not a sequence that can be fetched; known: lr-kt1, ", self.fetch("lr-kt9", code=1).stderr)

    def test_redirects_without_an_end(self):
        self.server.redirects = True
        self.assertIn("redirects", self.fetch("s-not-far", code=1).stderr)

    def test_a_server_that_does_not_answer(self):
        done = sslam("fetch", "s-not-far", "--mirror", "http://127.0.0.1:1", "--out", self.out)
        self.assertEqual(done.returncode, 1)
        self.assertIn("check the network", done.stderr)
        done = sslam("fetch", "s-not-far", "--mirror", "file://" + str(self.folder), "--out", self.out)
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
