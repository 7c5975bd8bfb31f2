"""The lines of docs/python.md do what they say, and the stubs are those of the module."""

import ast
import contextlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import sslam
from room import ROOM, needs_room

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def blocks(path):
    return re.findall(r"^```python\n(.*?)^```", (SOURCE / path).read_text(), re.S | re.M)


class Documents(unittest.TestCase):
    @needs_room
    def test_the_tutorial_tracks_a_room(self):
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                os.symlink(ROOM, "room")
                told = io.StringIO()
                with contextlib.redirect_stdout(told):
                    for block in blocks("docs/python.md"):
                        exec(compile(block, "docs/python.md", "exec"), {})
                self.assertTrue(pathlib.Path("map.sslam").exists())
            finally:
                os.chdir(before)
        self.assertRegex(told.getvalue(), r"(?m)^tracked (5\d|60) of 60 frames$")
        error = float(re.search(r"error (\S+) m", told.getvalue()).group(1))
        self.assertLess(error, 0.02)
        self.assertRegex(told.getvalue(), r"(?m)^OK [23] axes from \d{2,} segments$")

    def test_the_readme_shows_the_tutorial(self):
        self.assertIn(blocks("docs/python.md")[0], blocks("README.md"))

    def test_every_name_is_in_the_reference(self):
        reference = (SOURCE / "docs/python.md").read_text()
        missing = [name for name in sslam.__all__ if not re.search(rf"`(sslam\.)?{re.escape(name)}\b", reference)]
        self.assertEqual(missing, [])

    def test_import_loads_no_more_than_it_needs(self):
        def loaded(code, *modules):
            code = f"import sys, sslam\n{code}\nprint([m for m in {modules} if m in sys.modules])"
            return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip()

        self.assertEqual(loaded("", "numpy", "sslam._sslam"), "[]")
        self.assertEqual(loaded("sslam.System", "cv2", "matplotlib", "open3d", "rerun", "scipy", "torch"), "[]")

    def test_names_are_there_from_the_start(self):
        code = "import sslam; assert {*sslam.__all__} <= {*dir(sslam)}; from sslam import *; System, to_open3d, __version__"
        subprocess.run([sys.executable, "-c", code], check=True)
        with self.assertRaisesRegex(AttributeError, "'sslam' has no attribute 'sytem'"):
            sslam.sytem

    def test_the_stubs_have_what_the_module_has(self):
        stub = {}
        for node in ast.parse((SOURCE / "python/src/sslam/_sslam.pyi").read_text()).body:
            if isinstance(node, ast.FunctionDef):
                stub[node.name] = None
            elif isinstance(node, ast.ClassDef):
                members = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
                members |= {t.id for n in node.body if isinstance(n, ast.Assign) for t in n.targets}
                stub[node.name] = {m for m in members if not m.startswith("__")}
        module = {}
        for name, value in vars(sslam._sslam).items():
            if isinstance(value, type):
                module[name] = {m for m in vars(value) if not m.startswith("_")}
            elif not name.startswith("__"):
                module[name] = None
        self.assertEqual(stub, module, "make them anew: python/tests/make_stub")


if __name__ == "__main__":
    unittest.main()
