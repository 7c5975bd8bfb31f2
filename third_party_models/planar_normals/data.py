# SPDX-License-Identifier: BSD-3-Clause
"""Samples for training and evaluation: images brought to the network's camera, with the normals turned along."""
import cv2
import numpy as np
import torch

from prepare import UNKNOWN

WIDTH, HEIGHT, STRIDE = 256, 192, 4
FOCAL = 0.811 * WIDTH  # the network's camera: this focal length, principal point in the middle of the image
MEAN_COLOUR = 127.5


def network_camera(width=WIDTH, height=HEIGHT, focal=FOCAL):
    return np.array([[focal, 0, (width - 1) / 2], [0, focal, (height - 1) / 2], [0, 0, 1]])


def camera_matrix(fx, fy, cx, cy):
    return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]])


def rotation(roll, pitch, yaw):
    """Turns points of the old camera frame into the new one; radians."""
    vectors = ((0, 0, roll), (pitch, 0, 0), (0, yaw, 0))
    rz, rx, ry = (cv2.Rodrigues(np.array(v, float))[0] for v in vectors)
    return rz @ rx @ ry


def to_tensor(image):
    """H x W x 3 RGB, 8 bit -> 3 x H x W in [-1, 1]."""
    return torch.from_numpy(np.ascontiguousarray(image.transpose(2, 0, 1))).float().div_(127.5).sub_(1.0)


OUT_FROM_IN = np.array([[1 / STRIDE, 0, 0.5 / STRIDE - 0.5], [0, 1 / STRIDE, 0.5 / STRIDE - 0.5], [0, 0, 1]])


def warp(image, ids, homography, mode=cv2.BORDER_CONSTANT, border=(0, 0, 0)):
    """Image at the network's size, ids at the output's size."""
    warped = cv2.warpPerspective(image, homography, (WIDTH, HEIGHT), flags=cv2.INTER_LINEAR, borderMode=mode, borderValue=border)
    ids = cv2.warpPerspective(ids, OUT_FROM_IN @ homography, (WIDTH // STRIDE, HEIGHT // STRIDE),
                              flags=cv2.INTER_NEAREST, borderValue=UNKNOWN)
    return warped, ids


def random_border(rng):
    """What lies outside a turned image: mostly its mirror image, so that the cut does not give the turn away."""
    if rng.random() < 0.6:
        return cv2.BORDER_REFLECT_101, (0, 0, 0)
    if rng.random() < 0.3:
        return cv2.BORDER_REPLICATE, (0, 0, 0)
    return cv2.BORDER_CONSTANT, (0, 0, 0) if rng.random() < 0.5 else tuple(float(c) for c in rng.integers(0, 256, 3))


def cut_off(image, ids, border, rng):
    """Cuts the edges along random lines, so that a tilted cut says nothing about the camera."""
    angle, shift = rng.normal(0, 0.12), rng.normal(0, 12, 2)
    turn = cv2.getRotationMatrix2D((WIDTH / 2 + shift[0], HEIGHT / 2 + shift[1]), np.degrees(angle), rng.uniform(0.9, 1.1))
    turn[:, 2] += shift
    inside = cv2.warpAffine(np.ones((HEIGHT, WIDTH), np.uint8), turn, (WIDTH, HEIGHT))
    small = cv2.resize(inside, (WIDTH // STRIDE, HEIGHT // STRIDE), interpolation=cv2.INTER_NEAREST)
    image = np.where(inside[..., None] > 0, image, np.array(border, np.uint8))
    return image, np.where(small > 0, ids, UNKNOWN).astype(np.uint8)


def colour(image, rng):
    x = image.astype(np.float32) / 255
    if rng.random() < 0.8:
        x = x ** np.exp(rng.normal(0, 0.3))
        x = x * np.exp(rng.normal(0, 0.15, 3).astype(np.float32) * (1 if rng.random() < 0.5 else 0.3))
        x = (x - 0.5) * np.exp(rng.normal(0, 0.2)) + 0.5 + rng.normal(0, 0.08)
    grey = x.mean(axis=2, keepdims=True)
    saturation = 0.0 if rng.random() < 0.08 else np.exp(rng.normal(0, 0.3))
    x = grey + (x - grey) * saturation
    if rng.random() < 0.2:
        x = cv2.GaussianBlur(x, (0, 0), rng.uniform(0.4, 1.5))
    if rng.random() < 0.15:  # motion blur
        length = int(rng.integers(3, 8))
        kernel = np.zeros((length, length), np.float32)
        t = np.linspace(-0.5, 0.5, 4 * length) * (length - 1)
        a = rng.uniform(0, np.pi)
        kernel[np.round(t * np.sin(a) + (length - 1) / 2).astype(int), np.round(t * np.cos(a) + (length - 1) / 2).astype(int)] = 1
        x = cv2.filter2D(x, -1, kernel / kernel.sum())
    if rng.random() < 0.5:
        x = x + rng.normal(0, rng.uniform(0, 0.04), x.shape).astype(np.float32)
    return np.clip(x * 255, 0, 255).astype(np.uint8)


def random_view(camera, rng):
    """Homography of a random small turn of the camera and change of focal length, and the turn."""
    sigma = np.radians(9.0)
    roll = rng.uniform(-0.6, 0.6) if rng.random() < 0.1 else rng.normal(0, 0.6 * sigma)
    turn = rotation(roll, rng.normal(0, sigma), rng.normal(0, 0.7 * sigma))
    zoom = np.exp(rng.normal(0, 0.04))
    target = network_camera(focal=FOCAL * zoom)
    if rng.random() < 0.25:  # a small shift of the principal point, as cropping does
        target[:2, 2] += rng.normal(0, 4, 2)
    return target @ turn @ np.linalg.inv(camera), turn


class PlaneDataset(torch.utils.data.Dataset):
    """(image, ids at 1/4, normals at 1/4). ids: 0 not planar, 1 planar, 255 unknown."""

    def __init__(self, path, split, augment, seed=0, limit=None):
        data = np.load(path)
        keep = np.nonzero(data["split"] == split)[0][:limit]
        self.images, self.ids, self.normals = (data[k][keep] for k in ("images", "ids", "normals"))
        self.camera = camera_matrix(*data["camera"])
        self.augment, self.seed, self.epoch = augment, seed, 0

    def __len__(self):
        return len(self.images)

    def __getitem__(self, i):
        image, ids, planes = self.images[i], self.ids[i], self.normals[i]
        if self.augment:
            rng = np.random.default_rng((self.seed, self.epoch, i))
            homography, turn = random_view(self.camera, rng)
            planes = planes @ turn.T.astype(np.float32)
            mode, border = random_border(rng)
            image, ids = warp(image, ids, homography, mode, border)
            if mode == cv2.BORDER_CONSTANT:
                image, ids = cut_off(image, ids, border, rng)
            if rng.random() < 0.5:
                image, ids, planes = image[:, ::-1], ids[:, ::-1], planes * np.array([-1, 1, 1], np.float32)
            image = colour(np.ascontiguousarray(image), rng)
        else:
            image, ids = warp(image, ids, network_camera() @ np.linalg.inv(self.camera), cv2.BORDER_REFLECT_101)
        return sample(image, ids, planes)


def sample(image, ids, planes):
    table = np.zeros((256, 3), np.float32)
    table[1:255] = planes
    normals = table[ids]
    planar = np.where((ids > 0) & (ids < UNKNOWN), 1, ids).astype(np.uint8)
    return to_tensor(image), torch.from_numpy(planar), torch.from_numpy(np.ascontiguousarray(normals.transpose(2, 0, 1)))
