#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Rendered rooms of `sslam synth` as training data: the same .npz as prepare.py writes, all of it for training.

Reads folders with rgb/, normals/ and camera.yaml. Every surface is flat there, so no pixel teaches "not planar";
slivers thinner than a few pixels and what shows no surface are "unknown".
"""
import argparse
import glob
import os

import cv2
import numpy as np

from evaluate import read_camera
from prepare import UNKNOWN

SIZE = (320, 240)
MAX_PLANES = 254
MIN_PIXELS = 12


def surfaces(code):
    """Ids by direction and the directions: (H, W) and (n, 3). Normals of `sslam synth`: x, y, z = 2 v / 255 - 1 of R, G, B."""
    packed = code[..., 0].astype(np.int32) | code[..., 1].astype(np.int32) << 8 | code[..., 2].astype(np.int32) << 16
    values, inverse, counts = np.unique(packed, return_inverse=True, return_counts=True)
    order = [k for k in np.argsort(-counts) if values[k] != 0 and counts[k] >= MIN_PIXELS][:MAX_PLANES]
    table = np.full(len(values), UNKNOWN, np.uint8)
    table[order] = np.arange(1, len(order) + 1)
    blue, green, red = values[order] & 255, values[order] >> 8 & 255, values[order] >> 16
    normals = 2 * np.stack([red, green, blue], axis=1) / 255 - 1
    return table[inverse].reshape(packed.shape), normals / np.linalg.norm(normals, axis=1, keepdims=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", help="data sets of 320 x 240 pixels, all of one camera")
    parser.add_argument("--out", required=True)
    args = parser.parse_args()
    images, ids, normals, camera = [], [], [], None
    for folder in args.folders:
        this = read_camera(f"{folder}/camera.yaml")
        if camera is not None and not np.allclose(this, camera):
            raise SystemExit(f"{folder}/camera.yaml: another camera than in {args.folders[0]}")
        camera = this
        for path in sorted(glob.glob(f"{folder}/normals/*.png")):
            stem = os.path.splitext(os.path.basename(path))[0]
            colour = cv2.imread(glob.glob(f"{folder}/rgb/{stem}.*")[0])
            code = cv2.imread(path)
            if colour.shape[1::-1] != SIZE or code.shape[1::-1] != SIZE:
                raise SystemExit(f"{path}: not {SIZE[0]} x {SIZE[1]} pixels")
            plane_ids, directions = surfaces(code)
            rows = np.zeros((MAX_PLANES, 3), np.float32)
            rows[:len(directions)] = directions
            images.append(cv2.cvtColor(colour, cv2.COLOR_BGR2RGB))
            ids.append(plane_ids)
            normals.append(rows)
    count = len(images)
    np.savez(args.out, index=np.arange(count), images=np.array(images), ids=np.array(ids), normals=np.array(normals),
             split=np.array(["training"] * count), camera=np.array([camera[0, 0], camera[1, 1], camera[0, 2], camera[1, 2]]))
    print(f"{count} images, planar {np.mean([(x != UNKNOWN).mean() for x in ids]):.3f}")


if __name__ == "__main__":
    main()
