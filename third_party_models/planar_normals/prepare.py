#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Planar masks and plane normals for the NYU Depth v2 images, from planes fitted to labelled regions.

The 8-bit depth has steps of 3.9 cm, so that differentiating it gives noise, but a plane through thousands of pixels is
good to about a degree. Every connected region of one label gets planes by sequential RANSAC, least squares and merging.
Writes one .npz: images (N, 240, 320, 3, RGB), ids (N, 240, 320: 0 not planar, 255 unknown, else a plane of that image),
normals (N, 254, 3; row id - 1; camera frame, unit, towards the camera).
"""
import argparse
import multiprocessing
import os
import time

import cv2
import numpy as np

FX, FY, CX, CY = 259.43, 259.74, 162.79, 126.87  # NYUv2 at 320 x 240
UNKNOWN = 255
THRESHOLD = 0.04       # metres from the plane, about one depth step ...
THRESHOLD_Z2 = 0.003   # ... and this times depth^2 where that is more (beyond 3.7 m): the sensor's own noise
MIN_PIXELS = 300
MIN_EXTENT = 0.06      # metres: standard deviation of the points along the plane's shorter direction
MAX_PLANES_PER_REGION = 4
FRAME = 5              # pixels of white frame around the published images
DEPTH_PER_METRE = 25.5


def split_of(i):
    block = (i // 24) % 6
    return "test" if block == 5 else "validation" if block == 4 else "training"


def close_to(points, plane, factor=1.0):
    limit = factor * np.maximum(THRESHOLD, THRESHOLD_Z2 * points[:, 2] ** 2)
    return np.abs(points @ plane[0] - plane[1]) < limit


def fit(points):
    """Least squares: unit normal towards the camera, offset d of n . X = d, extent along the shorter direction."""
    centre = points.mean(axis=0)
    values, vectors = np.linalg.eigh(np.cov((points - centre).T))
    normal = vectors[:, 0]
    if normal @ centre > 0:
        normal = -normal
    return normal, normal @ centre, np.sqrt(max(values[1], 0)), np.sqrt(max(values[0], 0))


def ransac(points, rng, hypotheses=120, sample=1500):
    pick = points[rng.integers(0, len(points), sample)] if len(points) > sample else points
    a, b, c = (points[rng.integers(0, len(points), hypotheses)] for _ in range(3))
    normals = np.cross(b - a, c - a)
    length = np.linalg.norm(normals, axis=1)
    good = length > 1e-4
    if not good.any():
        return None
    normals = normals[good] / length[good, None]
    offsets = np.einsum("ij,ij->i", normals, a[good])
    limit = np.maximum(THRESHOLD, THRESHOLD_Z2 * pick[:, 2:] ** 2)
    votes = (np.abs(pick @ normals.T - offsets) < limit).sum(axis=0)
    best = votes.argmax()
    return normals[best], offsets[best]


def refine(points, plane):
    for _ in range(3):
        inlier = close_to(points, plane)
        if inlier.sum() < MIN_PIXELS // 2:
            return None
        plane = fit(points[inlier])
    return plane


def coherent(mask):
    """Closes speckles and keeps the connected parts that are large enough."""
    mask = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    mask = cv2.morphologyEx(mask, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    count, parts, stats, _ = cv2.connectedComponentsWithStats(mask, connectivity=4)
    keep = [i for i in range(1, count) if stats[i, cv2.CC_STAT_AREA] >= MIN_PIXELS]
    return np.isin(parts, keep) if keep else np.zeros(mask.shape, bool)


def planes_of_region(region, cloud, rng):
    """Sequential RANSAC inside one connected region: list of (mask, plane), and where a plane is too small for a normal."""
    found, left, unsure = [], region.copy(), np.zeros(region.shape, bool)
    for _ in range(MAX_PLANES_PER_REGION):
        ys, xs = np.nonzero(left)
        if len(ys) < MIN_PIXELS:
            break
        points = cloud[ys, xs]
        plane = ransac(points, rng)
        plane = plane and refine(points, plane)
        if plane is None:
            break
        inlier = np.zeros(region.shape, np.uint8)
        close = close_to(points, plane, 1.25)
        inlier[ys[close], xs[close]] = 1
        mask = coherent(inlier) & left
        if mask.sum() < MIN_PIXELS:
            break
        left &= ~mask
        normal, offset, extent, thickness = plane = fit(cloud[mask])
        if extent < MIN_EXTENT:
            unsure |= mask
        elif thickness < 0.25 * extent:
            found.append((mask, plane))
    return found, unsure


def merge(planes, cloud):
    """Joins planes of neighbouring regions (a wall and its pictures) when one plane explains both."""
    planes = sorted(planes, key=lambda p: -p[0].sum())
    out = []
    for mask, plane in planes:
        for k, (other, o) in enumerate(out):
            centre = cloud[mask].mean(axis=0)
            if plane[0] @ o[0] > np.cos(np.radians(8)) and abs(o[0] @ centre - o[1]) < 0.03:
                both = other | mask
                joint = fit(cloud[both])
                if joint[3] < 0.03:
                    out[k] = (both, joint)
                    break
        else:
            out.append((mask, plane))
    return out


def without_frame(image):
    """The frame would tell a network how an augmented image was turned: filled by reflection."""
    return cv2.copyMakeBorder(image[FRAME:-FRAME, FRAME:-FRAME], *(FRAME,) * 4, cv2.BORDER_REFLECT_101)


def process(args):
    root, i = args
    name = f"{i:04d}.png"
    rgb_path = next(p for p in (f"{root}/rgb/{i:04d}{e}" for e in (".jpg", ".png", ".jpeg")) if os.path.exists(p))
    image = without_frame(cv2.cvtColor(cv2.imread(rgb_path), cv2.COLOR_BGR2RGB))
    depth = cv2.imread(f"{root}/depth/{name}", cv2.IMREAD_UNCHANGED).astype(np.float32) / DEPTH_PER_METRE
    labels = cv2.imread(f"{root}/labels/{name}", cv2.IMREAD_UNCHANGED)
    rng = np.random.default_rng(i)
    v, u = np.mgrid[0:depth.shape[0], 0:depth.shape[1]].astype(np.float32)
    cloud = np.stack([(u - CX) / FX * depth, (v - CY) / FY * depth, depth], axis=-1)
    valid = (depth > 0.3) & (depth < 254 / DEPTH_PER_METRE)
    ids = np.full(depth.shape, UNKNOWN, np.uint8)
    planes = []
    for label in np.unique(labels):
        count, parts, stats, _ = cv2.connectedComponentsWithStats(((labels == label) & valid).astype(np.uint8), connectivity=4)
        for part in range(1, count):
            if stats[part, cv2.CC_STAT_AREA] < MIN_PIXELS:
                continue
            region = parts == part
            found, unsure = planes_of_region(region, cloud, rng)
            planes += found
            ids[region & ~unsure] = 0
    planes = merge(planes, cloud)[:254]
    normals = np.zeros((254, 3), np.float32)
    for k, (mask, plane) in enumerate(planes):
        ids[mask] = k + 1
        normals[k] = plane[0]
    # a border between a plane and the rest is not known to the pixel
    rest = (ids == 0).astype(np.uint8)
    core = cv2.erode(rest, np.ones((5, 5), np.uint8), borderValue=1)
    ids[(rest == 1) & (core == 0)] = UNKNOWN
    ids[:FRAME], ids[-FRAME:], ids[:, :FRAME], ids[:, -FRAME:] = (UNKNOWN,) * 4
    return i, image, ids, normals


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", required=True, help="folder of NYUv2 with rgb/, depth/, labels/")
    parser.add_argument("--out", required=True, help="the .npz to write (about 500 MB; keep it out of the repository)")
    parser.add_argument("--every", type=int, default=1, help="take every n-th image only")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    args = parser.parse_args()
    cv2.setNumThreads(1)
    count = len(os.listdir(f"{args.data}/depth"))
    start = time.time()
    with multiprocessing.Pool(args.jobs) as pool:
        rows = pool.map(process, [(args.data, i) for i in range(0, count, args.every)], chunksize=8)
    index, images, ids, normals = (np.array(x) for x in zip(*rows))
    np.savez(args.out, index=index, images=images, ids=ids, normals=normals,
             split=np.array([split_of(i) for i in index]), camera=np.array([FX, FY, CX, CY]))
    planar = ((ids > 0) & (ids < UNKNOWN)).mean()
    print(f"{len(index)} images in {time.time() - start:.0f} s, planar {planar:.3f}, not planar {(ids == 0).mean():.3f}, "
          f"unknown {(ids == UNKNOWN).mean():.3f}")


if __name__ == "__main__":
    main()
