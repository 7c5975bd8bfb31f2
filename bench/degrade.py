#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A copy of a sequence with worse images: noise, and blur along a direction that turns from frame to frame.

  bench/degrade.py FOLDER OUT --noise 10 --blur 7

Everything but the images in rgb/ is linked, not copied.
"""
import argparse
import os

import cv2
import numpy as np


def motion_kernel(length, angle):
    """Box along a direction, `length` pixels long."""
    size = length | 1
    kernel = np.zeros((size, size), np.float32)
    step = np.array([np.cos(angle), np.sin(angle)]) * (length - 1) / 2
    middle = np.full(2, size // 2)
    cv2.line(kernel, tuple(int(v) for v in np.round(middle - step)), tuple(int(v) for v in np.round(middle + step)), 1)
    return kernel / kernel.sum()


def degrade(image, noise, blur, random):
    if blur > 1:
        image = cv2.filter2D(image, -1, motion_kernel(blur, random.uniform(0, np.pi)), borderType=cv2.BORDER_REFLECT)
    return np.clip(image + random.normal(0, noise, image.shape), 0, 255).astype(np.uint8) if noise > 0 else image


def degrade_sequence(folder, out, noise, blur, seed=1):
    random = np.random.default_rng(seed)
    os.makedirs(os.path.join(out, "rgb"))
    for name in os.listdir(folder):
        if name != "rgb":
            os.symlink(os.path.abspath(os.path.join(folder, name)), os.path.join(out, name))
    for name in sorted(os.listdir(os.path.join(folder, "rgb"))):
        image = cv2.imread(os.path.join(folder, "rgb", name))
        if image is None:
            raise SystemExit(f"{folder}/rgb/{name}: no image")
        quality = [cv2.IMWRITE_JPEG_QUALITY, 97] if name.endswith(".jpg") else []
        cv2.imwrite(os.path.join(out, "rgb", name), degrade(image, noise, blur, random), quality)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("out", help="new folder")
    parser.add_argument("--noise", type=float, default=0, help="standard deviation of 8 bit values")
    parser.add_argument("--blur", type=int, default=0, help="length in pixels")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    degrade_sequence(args.folder, args.out, args.noise, args.blur, args.seed)


if __name__ == "__main__":
    main()
