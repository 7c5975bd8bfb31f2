#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scores of a checkpoint or an exported model: angle to the plane normals and balanced accuracy of the planar mask.

Every planar pixel of the 320 x 240 images counts the same. `--worlds` also scores folders with 16-bit depth and a
camera.yaml against normals computed from the depth.
"""
import argparse
import glob
import json
import os
import re

import cv2
import numpy as np
import torch

import data as samples
import model as nets
from prepare import UNKNOWN


class TorchPredictor:
    def __init__(self, net):
        self.net = nets.Exportable(net).eval()

    def __call__(self, image):
        """Image at the network's size, RGB 8 bit -> planar (h, w), normal (h, w, 3), confidence (h, w)."""
        with torch.no_grad():
            planar, normal, confidence = self.net(samples.to_tensor(image)[None])
        return planar[0, 0].numpy(), normal[0].permute(1, 2, 0).numpy(), confidence[0, 0].numpy()


class OpenCVPredictor:
    """The exported model as the C++ side runs it."""

    def __init__(self, path):
        self.net = cv2.dnn.readNetFromONNX(path)

    def __call__(self, image):
        self.net.setInput(cv2.dnn.blobFromImage(image, 1 / 127.5, mean=(127.5,) * 3))
        planar, normal, confidence = self.net.forward(["planar", "normal", "confidence"])
        return planar[0, 0], normal[0].transpose(1, 2, 0), confidence[0, 0]


def network_image(image, camera):
    """The image as the network's camera sees it, and the homography from the image's pixels; as NetworkView does it."""
    height, width = image.shape[:2]
    factor = max(1, int(min(camera[0, 0], camera[1, 1]) / samples.FOCAL))
    size = (width // factor, height // factor)
    # averaging over whole pixels first, so that bilinear sampling does not alias
    small = cv2.resize(image, size, interpolation=cv2.INTER_AREA) if factor > 1 else image
    rx, ry = size[0] / width, size[1] / height
    reduce = np.array([[rx, 0, 0.5 * rx - 0.5], [0, ry, 0.5 * ry - 0.5], [0, 0, 1]])
    homography = samples.network_camera() @ np.linalg.inv(camera)
    warped = cv2.warpPerspective(small, homography @ np.linalg.inv(reduce), (samples.WIDTH, samples.HEIGHT),
                                 flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REFLECT_101)
    return warped, homography


def predict(predictor, image, camera):
    """Prediction for any pinhole image: warped to the network's camera and back."""
    net_image, homography = network_image(image, camera)
    back = samples.OUT_FROM_IN @ homography
    size = (image.shape[1], image.shape[0])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    planar, normal, confidence = (cv2.warpPerspective(x, back, size, flags=flags, borderMode=cv2.BORDER_REPLICATE)
                                  for x in predictor(net_image))
    return planar, normal / np.linalg.norm(normal, axis=2, keepdims=True).clip(1e-6), confidence


def angles_deg(a, b):
    return np.degrees(np.arccos(np.clip((a * b).sum(axis=-1), -1, 1)))


def summary(angles):
    return {"mean": float(angles.mean()), "median": float(np.median(angles)),
            **{f"under_{t}": float((angles < t).mean()) for t in (11.25, 22.5, 30)}}


LARGE_PLANE = 0.05  # of the image


def direction_errors_deg(normal, weight, plane_id, planes):
    """Error of the mean normal of each large plane: what its pixels get wrong together."""
    errors = []
    for k, truth in enumerate(planes, start=1):
        on_plane = plane_id == k
        if on_plane.mean() < LARGE_PLANE:
            continue
        mean = (normal[on_plane] * weight[on_plane, None]).sum(axis=0)
        errors.append(float(angles_deg(mean / np.linalg.norm(mean).clip(1e-9), truth)))
    return errors


def rayleigh_sigma(errors_deg):
    """Standard deviation per component of errors on the sphere, by their median: planes of another kind do not count."""
    return float(np.median(errors_deg) / np.sqrt(2 * np.log(2))) if errors_deg else None


def evaluate_planes(predictor, path, split, limit=None):
    archive = np.load(path)
    keep = np.nonzero(archive["split"] == split)[0]
    if limit:
        keep = keep[np.linspace(0, len(keep) - 1, min(limit, len(keep))).astype(int)]
    images, ids, normals = (archive[k][keep] for k in ("images", "ids", "normals"))
    camera = samples.camera_matrix(*archive["camera"])
    angles, hits, totals, confident, directions = [], np.zeros(2), np.zeros(2), [], []
    for image, plane_id, planes in zip(images, ids, normals):
        planar, normal, confidence = predict(predictor, image, camera)
        truth = (plane_id > 0) & (plane_id < UNKNOWN)
        angles.append(angles_deg(normal[truth], planes[plane_id[truth].astype(int) - 1]).astype(np.float32))
        confident.append(confidence[truth])
        directions += direction_errors_deg(normal, planar * confidence, plane_id, planes)
        for k, mask in enumerate((plane_id == 0, truth)):
            hits[k] += ((planar > 0.5) == (k == 1))[mask].sum()
            totals[k] += mask.sum()
    angles, confident = np.concatenate(angles), np.concatenate(confident)
    sure = angles[confident >= np.median(confident)]
    return {"images": len(keep), **summary(angles), "median_of_surer_half": float(np.median(sure)),
            "planar_recall": hits[1] / totals[1], "other_recall": hits[0] / totals[0],
            "balanced_accuracy": float((hits / totals).mean()),
            "planes": len(directions), "plane_sigma_deg": rayleigh_sigma(directions)}


def depth_normals(depth, camera, radius=10):
    """Unit normals towards the camera by least squares over a window in inverse depth; zero where unclear.

    On a plane 1 / z = a u + b v + c exactly, so the normal is that of a linear fit; windows over a depth edge or with
    holes are left out.
    """
    valid = depth > 0
    inverse = np.where(valid, 1.0 / np.where(valid, depth, 1), 0).astype(np.float64)
    size = (2 * radius + 1,) * 2
    box = lambda x: cv2.boxFilter(x.astype(np.float64), -1, size, normalize=False, borderType=cv2.BORDER_CONSTANT)
    n = box(valid)
    u, v = np.meshgrid(np.arange(depth.shape[1], dtype=np.float64), np.arange(depth.shape[0], dtype=np.float64))
    u, v = (u - camera[0, 2]) / camera[0, 0], (v - camera[1, 2]) / camera[1, 1]
    full = n > 0.95 * n.max()
    count = np.where(full, n, 1)
    mu, mv, mw = (box(x * valid) / count for x in (u, v, inverse))
    moment = lambda x, y, mx, my: box(x * y * valid) / count - mx * my
    uu, vv, uv = moment(u, u, mu, mu), moment(v, v, mv, mv), moment(u, v, mu, mv)
    uw, vw, ww = moment(u, inverse, mu, mw), moment(v, inverse, mv, mw), moment(inverse, inverse, mw, mw)
    det = np.where(full, uu * vv - uv * uv, 1)
    a, b = (uw * vv - vw * uv) / det, (vw * uu - uw * uv) / det
    c = mw - a * mu - b * mv
    residual = np.sqrt(np.maximum(ww - a * uw - b * vw, 0)) / np.maximum(mw, 1e-9)  # relative depth error
    normal = -np.stack([a, b, c], axis=-1)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True).clip(1e-12)
    normal[~full | (residual > 0.01)] = 0
    return normal


def read_camera(path):
    text = open(path).read()
    return samples.camera_matrix(*(abs(float(re.search(rf"Camera\.{k}: *([-\d.]+)", text).group(1))) for k in ("fx", "fy", "cx", "cy")))


def frame_pairs(folder):
    """(colour, depth) files: TUM lists by nearest stamp within 20 ms, else files of the same number."""
    if os.path.exists(f"{folder}/depth.txt"):
        lists = [[line.split()[:2] for line in open(f"{folder}/{k}.txt") if line.strip() and line[0] != "#"] for k in ("rgb", "depth")]
        stamps = np.array([float(s) for s, _ in lists[1]])
        for stamp, name in lists[0]:
            j = np.abs(stamps - float(stamp)).argmin()
            if abs(stamps[j] - float(stamp)) < 0.02:
                yield f"{folder}/{name}", f"{folder}/{lists[1][j][1]}"
        return
    stem = lambda p: int(os.path.splitext(os.path.basename(p))[0])
    depth = {stem(p): p for p in glob.glob(f"{folder}/depth/*")}
    for path in sorted(glob.glob(f"{folder}/rgb/*"), key=stem):
        if stem(path) in depth:
            yield path, depth[stem(path)]


def evaluate_world(predictor, folder, every=5):
    camera = read_camera(f"{folder}/camera.yaml")
    angles, in_mask = [], []
    for colour, depth in list(frame_pairs(folder))[::every]:
        image = cv2.cvtColor(cv2.imread(colour), cv2.COLOR_BGR2RGB)
        truth = depth_normals(cv2.imread(depth, cv2.IMREAD_UNCHANGED) / 5000.0, camera)
        planar, normal, _ = predict(predictor, image, camera)
        known = np.abs(truth).sum(axis=2) > 0
        angles.append(angles_deg(normal[known], truth[known])[::7])
        in_mask.append((planar[known] > 0.5)[::7])
    frames, angles, in_mask = len(angles), np.concatenate(angles), np.concatenate(in_mask)
    return {"frames": frames, "all_pixels": summary(angles), "in_planar_mask": summary(angles[in_mask]),
            "share_in_mask": float(in_mask.mean())}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", help="checkpoint (.pt) or exported model (.onnx, run by OpenCV)")
    parser.add_argument("--data", help=".npz of prepare.py")
    parser.add_argument("--split", default="validation", choices=("training", "validation", "test"))
    parser.add_argument("--worlds", nargs="*", default=[], help="folders with rgb, 16-bit depth and camera.yaml")
    parser.add_argument("--every", type=int, default=5, help="take every n-th frame of a world")
    parser.add_argument("--limit", type=int, help="number of images of the split")
    parser.add_argument("--out", help="also write the scores to this JSON file")
    args = parser.parse_args()
    if args.model.endswith(".onnx"):
        predictor = OpenCVPredictor(args.model)
    else:
        predictor = TorchPredictor(nets.load_checkpoint(args.model)[0])
    scores = {}
    if args.data:
        scores[f"nyuv2_{args.split}"] = evaluate_planes(predictor, args.data, args.split, args.limit)
    for world in args.worlds:
        scores[os.path.basename(world.rstrip("/"))] = evaluate_world(predictor, world, args.every)
    text = json.dumps(scores, indent=2)
    print(text)
    if args.out:
        open(args.out, "w").write(text + "\n")


if __name__ == "__main__":
    main()
