#!/usr/bin/env python3
"""Normals by a network of your own, in ONNX Runtime (pip install onnxruntime): own_network.py DATASET MODEL.onnx.

This one has the inputs and outputs of planar_normals.onnx, which comes with sslam: an image of 256x192, RGB from -1 to 1,
taken with a focal length of 207.6 pixels; normals (3, h, w), and the probability of a plane (1, h, w). sslam itself can run
such a model as well (docs/normals.md); this way, any framework and any way to prepare an image will do. With PyTorch:

    output = network(torch.from_numpy(image))
    return output.numpy()
"""

import sys

import numpy as np
import onnxruntime
from numpy.typing import NDArray

import sslam

WIDTH, HEIGHT, FOCAL = 256, 192, 207.616


class Network:
    def __init__(self, model: str, camera: sslam.Camera) -> None:
        self.session = onnxruntime.InferenceSession(model, providers=["CPUExecutionProvider"])
        # The pixel of the image that each pixel of the input sees, and back: the nearest one is enough here.
        x = (np.arange(WIDTH) - (WIDTH - 1) / 2) / FOCAL * camera.fx + camera.cx
        y = (np.arange(HEIGHT) - (HEIGHT - 1) / 2) / FOCAL * camera.fy + camera.cy
        self.u = np.clip(np.round(x), 0, camera.width - 1).astype(int)
        self.v = np.clip(np.round(y), 0, camera.height - 1).astype(int)
        step = camera.width / 128
        self.grid_u = (np.arange(128) + 0.5) * step - 0.5
        self.grid_v = (np.arange(round(camera.height / step)) + 0.5) * step - 0.5
        self.camera = camera

    def __call__(self, image: NDArray[np.uint8]) -> NDArray[np.float32]:
        """(h, w, 4) in the shape of the image: normals towards the camera, zero where the network sees nothing, and the
        probability of a plane."""
        rgb = image[np.ix_(self.v, self.u)][:, :, ::-1].astype(np.float32) / 127.5 - 1
        normal, planar = self.session.run(["normal", "planar"], {"image": rgb.transpose(2, 0, 1)[None]})
        output = np.concatenate([normal[0], planar.reshape(1, *normal.shape[2:])]).transpose(1, 2, 0)
        rows, columns = output.shape[:2]
        x = (self.grid_u - self.camera.cx) / self.camera.fx * FOCAL / WIDTH + 0.5
        y = (self.grid_v - self.camera.cy) / self.camera.fy * FOCAL / HEIGHT + 0.5
        seen = np.outer((y >= 0) & (y < 1), (x >= 0) & (x < 1))
        u = np.clip((x * columns).astype(int), 0, columns - 1)
        v = np.clip((y * rows).astype(int), 0, rows - 1)
        found = output[np.ix_(v, u)] * seen[:, :, None]
        length = np.linalg.norm(found[:, :, :3], axis=2, keepdims=True)
        found[:, :, :3] /= np.maximum(length, 1e-6)
        return np.ascontiguousarray(found, np.float32)


def main() -> int:
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    dataset = sslam.open_dataset(sys.argv[1])
    system = sslam.System(dataset.camera, normals=Network(sys.argv[2], dataset.camera), normals_sigma_deg=5)
    for frame in dataset:
        result = system.track(frame.image, frame.stamp)
        print(f"{frame.name}: {result.normals} normals, {result.normals_status}, {result.state.name.lower()}")
    system.finish()
    return 0 if len(system.trajectory().stamps) else 1


if __name__ == "__main__":
    sys.exit(main())
