#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The bill of materials of `scripts/sbom`: JSON that names all that the program is made of.

Usage: sbom_test.py SCRIPT BUILD
"""
import hashlib
import json
import pathlib
import re
import shutil
import subprocess
import sys

script, build = map(pathlib.Path, sys.argv[1:])
if shutil.which("dpkg-query") is None or not (build / "build.ninja").exists():
    print("skipped: no Debian, or no build by ninja")
    sys.exit(77)


def bill():
    return subprocess.run([script, build], capture_output=True, text=True, check=True).stdout


text = bill()
parsed = json.loads(text)
assert (parsed["bomFormat"], parsed["specVersion"]) == ("CycloneDX", "1.5"), parsed
components = [parsed["metadata"]["component"], *parsed["components"]]
for component in components:
    assert component["type"] in ("application", "library", "machine-learning-model"), component
    assert component["name"] and component["version"], component
    assert component["licenses"] and all(entry["license"]["name"] for entry in component["licenses"]), component
references = [component["bom-ref"] for component in components]
assert len(set(references)) == len(references), references

# Each library that the program itself asks for is somebody's.
needed = set(re.findall(r"NEEDED.*\[(.*)\]", subprocess.run(
    ["readelf", "-d", build / "cli/sslam"], capture_output=True, text=True, check=True).stdout))
linked = {entry["value"] for component in components for entry in component.get("properties", [])
          if entry["name"] == "sslam:linked"}
assert needed and needed == linked, needed ^ linked

# And what LICENSES/README.md names beside our own.
names = {component["name"]: component for component in components}
for name in ("sslam", "three", "libcli11-dev", "nlohmann-json3-dev", "libtomlplusplus-dev", "libeigen3-dev",
             "planar_normals.onnx"):
    assert name in names, name
model = script.parent.parent / "third_party_models/planar_normals/planar_normals.onnx"
digest = hashlib.sha256(model.read_bytes()).hexdigest()
assert names["planar_normals.onnx"]["hashes"] == [{"alg": "SHA-256", "content": digest}]

refused = subprocess.run([script, build / "nowhere"], capture_output=True, text=True)
assert refused.returncode == 1 and refused.stdout == "" and refused.stderr.count("\n") == 1, refused
assert "nowhere: holds no cli/sslam" in refused.stderr, refused
