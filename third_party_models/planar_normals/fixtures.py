#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes what the C++ tests compare with: a tiny model with its manifest, and the shipped model's answer to one image.

The answer comes from evaluate.py's own preprocessing, so that the test holds two implementations against each other.
"""
import argparse
import json
import os

import cv2
import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

HERE = os.path.dirname(os.path.abspath(__file__))
TESTS = os.path.join(HERE, "..", "..", "tests", "opencv", "fixtures")
WIDTH, HEIGHT = 64, 48


def constant(name, values):
    return numpy_helper.from_array(np.array(values, np.float32), name)


def tiny_model():
    """Means over 4 x 4 pixels, then a different mixture of red, green and blue in each component of the normal."""
    mix = np.array([[0.9, 0.1, -0.3], [-0.2, 0.7, 0.4], [0.1, -0.1, 0.2]], np.float32)[..., None, None]
    planar = np.array([[0.0, 4.0, 0.0]], np.float32)[..., None, None]
    confidence = np.array([[0.0, 0.0, 2.0]], np.float32)[..., None, None]
    # its root is 1 where red and green are alike, more where there is more red, and not a number in green
    frail = np.array([[1.0, -1.0, 0.0]], np.float32)[..., None, None]
    constants = [constant("mix", mix), constant("mix_bias", [0.1, -0.1, -1.2]), constant("planar_w", planar),
                 constant("planar_b", [1.5]), constant("confidence_w", confidence), constant("confidence_b", [1.0]),
                 constant("frail_w", frail.repeat(3, 0)), constant("frail_b", [1.0] * 3),
                 constant("frail_mask_w", frail), constant("frail_mask_b", [1.0])]
    node = helper.make_node
    nodes = [
        node("AveragePool", ["image"], ["pooled"], kernel_shape=[4, 4], strides=[4, 4]),
        node("Conv", ["pooled", "mix", "mix_bias"], ["mixed"], kernel_shape=[1, 1]),
        # the chain that OpenCV 4.6 reads as one normalisation
        node("ReduceL2", ["mixed"], ["length"], axes=[1], keepdims=1),
        node("Clip", ["length"], ["positive"], min=1e-12),
        node("Shape", ["mixed"], ["shape"]),
        node("Expand", ["positive", "shape"], ["divisor"]),
        node("Div", ["mixed", "divisor"], ["normal"]),
        node("Conv", ["pooled", "mix", "mix_bias"], ["raw"], kernel_shape=[1, 1]),  # not of unit length
        node("Conv", ["pooled", "frail_w", "frail_b"], ["frail_square"], kernel_shape=[1, 1]),
        node("Sqrt", ["frail_square"], ["frail_length"]),
        node("Mul", ["normal", "frail_length"], ["frail"]),
        # a depth or a mask with the same faults
        node("Conv", ["pooled", "frail_mask_w", "frail_mask_b"], ["frail_mask_square"], kernel_shape=[1, 1]),
        node("Sqrt", ["frail_mask_square"], ["frail_mask"]),
        node("Conv", ["pooled", "planar_w", "planar_b"], ["planar_logit"], kernel_shape=[1, 1]),
        node("Sigmoid", ["planar_logit"], ["planar"]),
        node("Conv", ["pooled", "confidence_w", "confidence_b"], ["confidence_logit"], kernel_shape=[1, 1]),
        node("Sigmoid", ["confidence_logit"], ["confidence"]),
        node("Conv", ["pooled", "confidence_w", "confidence_b"], ["depth"], kernel_shape=[1, 1]),
    ]
    shape = [1, 3, HEIGHT // 4, WIDTH // 4]
    outputs = [helper.make_tensor_value_info(n, TensorProto.FLOAT, [1, c] + shape[2:])
               for n, c in (("normal", 3), ("planar", 1), ("confidence", 1), ("raw", 3), ("frail", 3),
                             ("depth", 1), ("frail_mask", 1))]
    image = helper.make_tensor_value_info("image", TensorProto.FLOAT, [1, 3, HEIGHT, WIDTH])
    graph = helper.make_graph(nodes, "tiny_normals", [image], outputs, constants)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 10)], producer_name="fixtures")
    model.ir_version = 5
    onnx.checker.check_model(model)
    return model


TINY_MANIFEST = {
    "format": "sslam-normals-1",
    "model": "tiny_normals.onnx",
    "input": {"width": WIDTH, "height": HEIGHT, "channels": "rgb", "mean": [127.5] * 3, "scale": [1 / 127.5] * 3},
    "output": {"kind": "normals", "name": "normal", "axes": ["x", "y", "z"], "signs": [1, 1, 1], "mask": "planar",
               "confidence": "confidence"},
}


def write_json(path, value):
    with open(path, "w") as file:
        json.dump(value, file, indent=2)
        file.write("\n")


def shipped_answer(model, image_path, focal):
    """Rows `u v x y z planar` for every fourth pixel of the output."""
    from evaluate import OpenCVPredictor, network_image

    image = cv2.cvtColor(cv2.imread(image_path), cv2.COLOR_BGR2RGB)
    height, width = image.shape[:2]
    camera = np.array([[focal, 0, (width - 1) / 2], [0, focal, (height - 1) / 2], [0, 0, 1]])
    planar, normal, _ = OpenCVPredictor(model)(network_image(image, camera)[0])
    rows = ["# u v x y z planar: the shipped model's answer to room.jpg, by fixtures.py\n"]
    for v in range(2, planar.shape[0], 4):
        for u in range(2, planar.shape[1], 4):
            rows.append(f"{u} {v} " + " ".join(f"{x:.5f}" for x in (*normal[v, u], planar[v, u])) + "\n")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=TESTS, help="folder of the fixtures; room.jpg is there")
    parser.add_argument("--model", default=os.path.join(HERE, "planar_normals.onnx"))
    parser.add_argument("--focal", type=float, default=260, help="of room.jpg, pixels")
    args = parser.parse_args()
    os.makedirs(args.out, exist_ok=True)
    onnx.save(tiny_model(), f"{args.out}/tiny_normals.onnx")
    write_json(f"{args.out}/tiny_normals.json", TINY_MANIFEST)
    if os.path.exists(args.model) and os.path.exists(f"{args.out}/room.jpg"):
        with open(f"{args.out}/room_normals.txt", "w") as file:
            file.writelines(shipped_answer(args.model, f"{args.out}/room.jpg", args.focal))
    print(f"written to {os.path.normpath(args.out)}")


if __name__ == "__main__":
    main()
