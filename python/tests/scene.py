"""Points and lines before a camera, for the tests of kernels."""

import numpy as np

import sslam

CAMERA = sslam.Camera(260.0, 262.0, 159.5, 119.5, 320, 240, k1=-0.1, k2=0.02)


def turn(x, y, z):
    """A rotation by Rodrigues' formula."""
    v = np.array([x, y, z])
    angle = np.linalg.norm(v)
    k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]]) / angle
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def moved(rotation, translation):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, translation
    return pose


def project(points, world_from_cam):
    """Into the image of CAMERA, distortion and all."""
    x = (points - world_from_cam[:3, 3]) @ world_from_cam[:3, :3]
    m = x[:, :2] / x[:, 2:]
    r2 = (m**2).sum(axis=1, keepdims=True)
    return m * (1 + r2 * (CAMERA.k1 + r2 * CAMERA.k2)) * [CAMERA.fx, CAMERA.fy] + [CAMERA.cx, CAMERA.cy]


class Scene:
    def __init__(self):
        random = np.random.default_rng(7)
        self.points = random.uniform([-2, -1.5, 3], [2, 1.5, 7], (80, 3))
        self.poses = np.stack([np.eye(4), moved(turn(0.02, 0.05, -0.01), [0.5, 0.05, 0.1]), moved(turn(0, 0.1, 0), [0.9, 0, 0])])
        self.pixels = np.stack([project(self.points, pose) for pose in self.poses], axis=1)
        self.pixels += random.normal(0, 0.3, self.pixels.shape)
        self.room = turn(0.1, -0.15, 0.05)
        self.normals = np.repeat(-np.sign(self.room[2]) * self.room, 40, axis=1).T + random.normal(0, 0.05, (120, 3))
        self.normals /= np.linalg.norm(self.normals, axis=1, keepdims=True)
        starts = random.uniform([-1.5, -1, 4], [1.5, 1, 6], (30, 3))
        ends = starts + 0.8 * self.room.T[np.arange(30) % 3]
        self.segments = np.hstack([project(starts, np.eye(4)), project(ends, np.eye(4))])
        self.lines = np.stack([starts, ends], axis=1)
        self.views_of_lines = np.stack([np.hstack([project(starts, p), project(ends, p)]) for p in self.poses], axis=1)
        self.views_of_lines += random.normal(0, 0.3, self.views_of_lines.shape)


SCENE = Scene()
