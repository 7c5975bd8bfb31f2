#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of what a model sees: image, normals on planar pixels (x, y, z as red, green, blue) and confidence, in a row each."""
import argparse

import cv2
import numpy as np

from evaluate import OpenCVPredictor, predict
from data import camera_matrix


def picture(predictor, path, focal_share):
    image = cv2.cvtColor(cv2.imread(path), cv2.COLOR_BGR2RGB)
    height, width = image.shape[:2]
    focal = focal_share * width
    planar, normal, confidence = predict(predictor, image, camera_matrix(focal, focal, (width - 1) / 2, (height - 1) / 2))
    colours = ((0.5 + 0.5 * normal) * 255).clip(0, 255) * (planar > 0.5)[..., None]
    sure = np.repeat((255 * confidence * planar)[..., None], 3, axis=2)
    row = np.hstack([image, colours.astype(np.uint8), sure.clip(0, 255).astype(np.uint8)])
    return cv2.resize(row, (960, 240), interpolation=cv2.INTER_AREA)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", help="exported model (.onnx)")
    parser.add_argument("images", nargs="+")
    parser.add_argument("--focal", type=float, default=0.811, help="focal length as a share of the image's width")
    parser.add_argument("--out", required=True)
    args = parser.parse_args()
    predictor = OpenCVPredictor(args.model)
    rows = np.vstack([picture(predictor, path, args.focal) for path in args.images])
    cv2.imwrite(args.out, rows[..., ::-1])


if __name__ == "__main__":
    main()
