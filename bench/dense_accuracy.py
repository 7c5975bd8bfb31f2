#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How far the model of `sslam run --dense` is from the depth images of its dataset, and how much of them it has.

  sslam run DATASET --dense --scale depth --no-report --out RUN
  bench/dense_accuracy.py DATASET RUN [DATASET RUN]... [--truth]

The depth images of the keyframes are placed by the keyframes' poses of the run. With --truth they are placed by the poses of
groundtruth.txt, and the model by the similarity that brings the keyframes there: then errors of the trajectory count as well.

Printed: the number of depth images; the median and the 90 % quantile of the distances from the model to the surface, over
squares of the model that a keyframe sees and that have depth there; completeness, the share of the surface's area within 5 cm
of the model, of all that was measured up to --far, and of its planes of at least --plane square metres; and how many of these
planes the model has (half of their area within 5 cm), and misses.

Needs numpy, scipy and OpenCV.
"""
import argparse
import csv
import json
import pathlib
import re

import cv2
import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

WITHIN = 0.05  # metres, of completeness
VOXEL = 0.02  # metres, of the measured surface
FLAT = 0.02  # metres, of a measured plane to either side


def rows_of(path):
    lines = (line.split() for line in path.read_text().splitlines() if line and not line.startswith("#"))
    return [row for row in lines if row]


def poses_of(path):
    """Stamps, and the matrices world from camera."""
    rows = np.array([row[:8] for row in rows_of(path)], dtype=float)
    poses = np.tile(np.eye(4), (len(rows), 1, 1))
    poses[:, :3, :3] = Rotation.from_quat(rows[:, 4:8]).as_matrix()
    poses[:, :3, 3] = rows[:, 1:4]
    return rows[:, 0], poses


def squares_of(path):
    """Corners of the model's squares, (squares, 4, 3)."""
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    vertices, faces = (int(re.search(rb"element %s (\d+)" % kind, head).group(1)) for kind in (b"vertex", b"face"))
    vertex = np.dtype([("place", "<f4", 3), ("colour", "u1", 3)])
    places = np.frombuffer(body, vertex, vertices)["place"].astype(float)
    square = np.dtype([("count", "u1"), ("corner", "<i4", 4)])
    return places[np.frombuffer(body, square, faces, vertices * vertex.itemsize)["corner"]]


def samples_of(squares):
    """Places on the squares, (squares, 9, 3): the fifth is the middle."""
    share = np.array([1, 3, 5]) / 6
    a, b, c, d = (squares[:, None, None, i] for i in range(4))
    s, t = share[:, None, None], share[None, :, None]
    places = (1 - s) * ((1 - t) * a + t * d) + s * ((1 - t) * b + t * c)
    return places.reshape(len(squares), 9, 3)


class Lens:
    def __init__(self, settings):
        fx, fy, cx, cy = settings["pinhole"]
        self.matrix = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]])
        self.bend = np.array(settings["distortion"], dtype=float)
        self.size = tuple(settings["image_size"])

    def rays(self, step):
        """Of every step-th pixel, z = 1, and the pixels."""
        u, v = np.meshgrid(np.arange(step // 2, self.size[0], step), np.arange(step // 2, self.size[1], step))
        pixels = np.stack([u.ravel(), v.ravel()], 1)
        straight = cv2.undistortPoints(pixels[:, None].astype(float), self.matrix, self.bend)[:, 0]
        return np.column_stack([straight, np.ones(len(straight))]), pixels

    def pixels(self, in_camera):
        flat = cv2.projectPoints(in_camera, np.zeros(3), np.zeros(3), self.matrix, self.bend)[0][:, 0]
        return np.rint(flat).astype(int)


def depth_files(dataset, run):
    """By the stamp of the keyframe: of depth.txt, or the file of the same name in the folder depth."""
    files = {}
    stamps, _ = poses_of(run / "keyframes.txt")
    if (dataset / "depth.txt").exists():
        rows = rows_of(dataset / "depth.txt")
        known = np.array([float(row[0]) for row in rows])
        for stamp in stamps:
            at = int(np.argmin(np.abs(known - stamp)))
            if abs(known[at] - stamp) < 0.02:
                files[stamp] = dataset / rows[at][1]
    else:
        with open(run / "frames.csv", newline="") as table:
            images = {float(row["stamp"]): row["image"] for row in csv.DictReader(table)}
        for stamp in stamps:
            file = dataset / "depth" / (pathlib.Path(images.get(stamp, "none")).stem + ".png")
            if file.exists():
                files[stamp] = file
    return files


def factor_of(dataset):
    file = dataset / "camera.yaml"
    found = re.search(r"DepthMapFactor:\s*([0-9.]+)", file.read_text()) if file.exists() else None
    return float(found.group(1)) if found else 1000.0


def similarity(source, target):
    """Scale, rotation and shift that bring places to others (Umeyama 1991)."""
    a, b = source - source.mean(0), target - target.mean(0)
    u, d, v = np.linalg.svd(b.T @ a)
    sign = np.diag([1, 1, np.sign(np.linalg.det(u @ v))])
    rotation = u @ sign @ v
    scale = (d * np.diag(sign)).sum() / (a ** 2).sum()
    return scale, rotation, target.mean(0) - scale * rotation @ source.mean(0)


def thinned(places):
    _, first = np.unique(np.floor(places / VOXEL).astype(np.int64), axis=0, return_index=True)
    return places[np.sort(first)]


def surface_distances(places, surface):
    """From the plane through the measured places around the nearest one."""
    tree = cKDTree(surface)
    nearest, ids = tree.query(places, k=12)
    around = surface[ids]
    middle = around.mean(1)
    offsets = around - middle[:, None]
    _, vectors = np.linalg.eigh(np.einsum("nki,nkj->nij", offsets, offsets))
    flat = np.abs(np.einsum("ni,ni->n", places - middle, vectors[:, :, 0]))
    far = nearest[:, 0] > 3 * VOXEL
    return np.where(far, nearest[:, 0], flat)


def planes_of(surface, least_area):
    """Of the measured surface, the largest first, as lists of places: random triples, connected to a fifth of a metre."""
    random = np.random.default_rng(1)
    left, planes = np.arange(len(surface)), []
    least = int(least_area / VOXEL ** 2 / 2)  # a voxel's surface is a square of its side at least; depth has holes
    while len(left) >= least and len(planes) < 40:
        among = surface[left]
        few = among[:: max(1, len(among) // 10000)]
        tree = cKDTree(few)
        most, best = 0, np.array([], dtype=int)
        for _ in range(300):
            a = few[random.integers(len(few))]
            near = tree.query_ball_point(a, 0.4)
            if len(near) < 3:
                continue
            b, c = few[random.choice(near, 2, replace=False)]
            normal = np.cross(b - a, c - a)
            length = np.linalg.norm(normal)
            if length < 0.01:
                continue
            on = np.flatnonzero(np.abs((few - a) @ (normal / length)) < FLAT)
            if len(on) > most:
                most = len(on)
                best = np.flatnonzero(np.abs((among - a) @ (normal / length)) < FLAT)
        for _ in range(3 if most else 0):
            middle = among[best].mean(0)
            normal = np.linalg.eigh(np.cov((among[best] - middle).T))[1][:, 0]
            best = np.flatnonzero(np.abs((among - middle) @ normal) < FLAT)
        if len(best) < least:
            break
        parts = connected(among[best])
        planes += [among[best[part]] for part in parts if len(part) >= least]
        left = np.delete(left, best)
    return planes


def connected(places):
    """Lists of the places of each part, by cubes of a fifth of a metre that touch."""
    cubes, of = np.unique(np.floor(places / 0.2).astype(np.int64), axis=0, return_inverse=True)
    number = {tuple(c): i for i, c in enumerate(cubes)}
    part = -np.ones(len(cubes), dtype=int)
    steps = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
    count = 0
    for seed in range(len(cubes)):
        if part[seed] >= 0:
            continue
        stack = [seed]
        part[seed] = count
        while stack:
            x, y, z = cubes[stack.pop()]
            for dx, dy, dz in steps:
                other = number.get((x + dx, y + dy, z + dz))
                if other is not None and part[other] < 0:
                    part[other] = count
                    stack.append(other)
        count += 1
    return [np.flatnonzero(part[of.ravel()] == k) for k in range(count)]


def judge(dataset, run, options):
    metrics = json.loads((run / "metrics.json").read_text())
    lens = Lens(metrics["settings"])
    factor = options.depth_factor or factor_of(dataset)
    stamps, own = poses_of(run / "keyframes.txt")
    samples = samples_of(squares_of(run / "model.ply"))
    poses = dict(zip(stamps, own))
    if options.truth:
        true_stamps, true_poses = poses_of(dataset / "groundtruth.txt")
        order = np.argsort(true_stamps)
        at = [order[np.argmin(np.abs(true_stamps[order] - stamp))] for stamp in stamps]
        poses = {s: true_poses[k] for s, k in zip(stamps, at) if abs(true_stamps[k] - s) < 0.02}
        both = [i for i, s in enumerate(stamps) if s in poses]
        scale, rotation, shift = similarity(own[both][:, :3, 3], np.array([poses[stamps[i]] for i in both])[:, :3, 3])
        samples = scale * samples @ rotation.T + shift

    rays, pixels = lens.rays(options.step)
    images, measured = [], []
    for stamp, file in sorted(depth_files(dataset, run).items()):
        if stamp not in poses:
            continue
        image = cv2.imread(str(file), cv2.IMREAD_UNCHANGED).astype(float) / factor
        image = cv2.resize(image, lens.size, interpolation=cv2.INTER_NEAREST)
        image[image > options.far] = 0
        depth = image[pixels[:, 1], pixels[:, 0]]
        pose = poses[stamp]
        measured.append((rays[depth > 0] * depth[depth > 0, None]) @ pose[:3, :3].T + pose[:3, 3])
        images.append((pose, image))
    surface = thinned(np.concatenate(measured))

    # Squares whose middle a keyframe sees with depth there, not far behind it: what is hidden was not measured.
    middles = samples[:, 4]
    seen = np.zeros(len(middles), dtype=bool)
    for pose, image in images:
        in_camera = (middles - pose[:3, 3]) @ pose[:3, :3]
        front = np.flatnonzero(in_camera[:, 2] > 0.1)
        at = lens.pixels(in_camera[front])
        inside = (at >= 0).all(1) & (at < lens.size).all(1)
        front, at = front[inside], at[inside]
        depth = image[at[:, 1], at[:, 0]]
        seen[front[(depth > 0) & (in_camera[front, 2] < 1.5 * depth)]] = True
    off = surface_distances(middles[seen], surface)

    reached, _ = cKDTree(samples.reshape(-1, 3)).query(surface, distance_upper_bound=WITHIN)
    complete = np.isfinite(reached)
    planes = planes_of(surface, options.plane)
    tree = cKDTree(surface)
    shares = [complete[tree.query(plane)[1]].mean() for plane in planes]
    area = sum(len(plane) for plane in planes)
    on_planes = sum(share * len(plane) for share, plane in zip(shares, planes)) / max(area, 1)
    return {
        "images": len(images), "planes": len(metrics["dense"]["planes"]), "median": np.median(off),
        "most": np.quantile(off, 0.9), "unmeasured": 1 - seen.mean(), "complete": complete.mean(), "on_planes": on_planes,
        "planar": area / len(surface), "found": sum(share >= 0.5 for share in shares), "all": len(planes),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pairs", nargs="+", type=pathlib.Path, metavar="DATASET RUN")
    parser.add_argument("--truth", action="store_true", help="depth stands at the true poses")
    parser.add_argument("--far", type=float, default=5, help="metres: depth beyond is not used")
    parser.add_argument("--plane", type=float, default=0.5, help="square metres: measured planes from there on")
    parser.add_argument("--depth-factor", type=float, help="units a metre; else that of camera.yaml, else 1000")
    parser.add_argument("--step", type=int, default=4, help="pixels between those that are used")
    options = parser.parse_args()
    if len(options.pairs) % 2:
        parser.error("give each DATASET with its RUN")
    print("| dataset | depth images | planes | median | 90 % | of the model unmeasured | complete | planar part, of all "
          "| complete there | planes found |")
    print("|---" * 10 + "|")
    for dataset, run in zip(options.pairs[::2], options.pairs[1::2]):
        f = judge(dataset, run, options)
        print(f"| `{dataset.name}` | {f['images']} | {f['planes']} | {100 * f['median']:.1f} cm | {100 * f['most']:.1f} cm "
              f"| {100 * f['unmeasured']:.0f} % | {100 * f['complete']:.0f} % | {100 * f['planar']:.0f} % "
              f"| {100 * f['on_planes']:.0f} % | {f['found']} of {f['all']} |", flush=True)


if __name__ == "__main__":
    main()
