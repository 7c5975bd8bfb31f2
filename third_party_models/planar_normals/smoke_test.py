#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the whole chain on generated rooms: prepare, a few training steps, resume, evaluate, export, load in OpenCV.

Ends with 77 (skipped) where PyTorch, OpenCV or onnx is missing.
"""
import glob
import json
import os
import subprocess
import sys
import tempfile

SKIPPED = 77
HERE = os.path.dirname(os.path.abspath(__file__))
try:
    import cv2
    import numpy as np
    import onnx  # noqa: F401
    import torch
except ImportError as error:
    print(f"SKIPPED: {error}")
    sys.exit(SKIPPED)
sys.path.insert(0, HERE)

import data as samples  # noqa: E402
import prepare  # noqa: E402


def room(rng):
    """A box room seen by a turned camera: colour, depth in metres, label and normal of every pixel."""
    turn = samples.rotation(*rng.normal(0, 0.15, 2), rng.uniform(-1, 1))
    v, u = np.mgrid[0:240, 0:320].astype(float)
    rays = np.stack([(u - prepare.CX) / prepare.FX, (v - prepare.CY) / prepare.FY, np.ones_like(u)], axis=-1)
    depth, label, normal = np.full(u.shape, np.inf), np.zeros(u.shape, np.uint8), np.zeros(u.shape + (3,))
    for k, (axis, sign) in enumerate(((2, -1), (1, -1), (1, 1), (0, -1), (0, 1))):
        n = turn[:, axis] * sign
        z = -rng.uniform(1.2, 3.5) / np.minimum(rays @ n, -1e-9)
        z[rays @ n > -1e-3] = np.inf
        nearer = z < depth
        depth[nearer], label[nearer], normal[nearer] = z[nearer], k, n
    shade = (0.5 + 0.5 * normal) * 200 + rng.normal(0, 8, normal.shape)
    return shade.clip(0, 255).astype(np.uint8), depth, label, normal


def write_rooms(folder, count):
    truth = []
    for name in ("rgb", "depth", "labels"):
        os.makedirs(f"{folder}/{name}")
    rng = np.random.default_rng(0)
    for i in range(count):
        image, depth, label, normal = room(rng)
        cv2.imwrite(f"{folder}/rgb/{i:04d}.png", image[..., ::-1])
        cv2.imwrite(f"{folder}/depth/{i:04d}.png", np.round(depth * prepare.DEPTH_PER_METRE).clip(0, 255).astype(np.uint8))
        cv2.imwrite(f"{folder}/labels/{i:04d}.png", label)
        truth.append(normal)
    return np.array(truth)


def run(script, *args):
    command = [sys.executable, os.path.join(HERE, script), *map(str, args)]
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        print(result.stdout, result.stderr)
        raise SystemExit(f"FAILED: {script} ended with {result.returncode}")
    return result.stdout


def check(condition, what):
    if not condition:
        raise SystemExit(f"FAILED: {what}")
    print(f"ok: {what}")


def check_turning():
    """Normals of an augmented sample against a plane through the rotated points."""
    rng = np.random.default_rng(3)
    camera = samples.camera_matrix(prepare.FX, prepare.FY, prepare.CX, prepare.CY)
    homography, turn = samples.random_view(camera, rng)
    normal = np.array([0.2, -0.9, -0.3])
    pixels = rng.uniform(0, 200, (5, 2))
    rays = np.linalg.inv(camera) @ np.c_[pixels, np.ones(5)].T
    points = rays / -(normal @ rays)  # on the plane n . X = -1
    moved = homography @ np.c_[pixels, np.ones(5)].T
    zoom = homography @ camera @ turn.T  # the new camera matrix
    again = np.linalg.inv(zoom) @ moved
    turned = turn @ points
    check(np.allclose(again / again[2], turned / turned[2]), "a turned image shows the turned points")
    check(np.allclose((turn @ normal) @ turned, -1), "normals turn with the points")


def main():
    torch.manual_seed(0)
    check_turning()
    with tempfile.TemporaryDirectory() as folder:
        truth = write_rooms(f"{folder}/rooms", 98)  # 96 and on: validation
        print(run("prepare.py", "--data", f"{folder}/rooms", "--out", f"{folder}/rooms.npz"), end="")
        archive = np.load(f"{folder}/rooms.npz")
        ids, planes = archive["ids"], archive["normals"]
        planar = (ids > 0) & (ids < prepare.UNKNOWN)
        found = np.take_along_axis(planes, (ids.astype(int).reshape(len(ids), -1) - 1).clip(0, 253)[..., None].repeat(3, 2), 1)
        cosine = (found.reshape(truth.shape) * truth).sum(-1)[planar]
        error = np.degrees(np.median(np.arccos(cosine.clip(-1, 1))))
        check(planar.mean() > 0.7 and error < 1.0, f"planes of coarse depth are right ({error:.2f} degrees, {planar.mean():.2f} of the pixels)")
        common = ("--data", f"{folder}/rooms.npz", "--out", f"{folder}/run", "--batch", 2, "--minutes", 30, "--channels", 16,
                  "--validate-images", 2, "--device", "cpu")
        run("train.py", *common, "--steps", 3)
        output = run("train.py", *common, "--steps", 5)
        check("resuming at step 3" in output and os.path.exists(f"{folder}/run/scores.csv"), "training resumes")
        run("export.py", f"{folder}/run/last.pt", "--out", f"{folder}/tiny.onnx")
        described = json.load(open(f"{folder}/tiny.json"))
        net = cv2.dnn.readNetFromONNX(f"{folder}/tiny.onnx")
        shape = (1, 3, described["input"]["height"], described["input"]["width"])
        net.setInput(np.random.default_rng(0).uniform(-1, 1, shape).astype(np.float32))
        normal = net.forward("normal")
        norm = np.linalg.norm(normal, axis=1)
        check(np.allclose(norm, 1, atol=1e-3), f"the exported model gives unit normals in OpenCV ({norm.min():.4f} to {norm.max():.4f})")
        scores = json.loads(run("evaluate.py", f"{folder}/tiny.onnx", "--data", f"{folder}/rooms.npz"))
        check(scores["nyuv2_validation"]["images"] == 2, "the exported model is evaluated")
        check(not glob.glob(f"{folder}/*.tmp"), "nothing is left behind")
    print("smoke test passed")


if __name__ == "__main__":
    main()
