#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Exports a checkpoint to ONNX for OpenCV's DNN module, with the manifest that the C++ side reads.

Checks the file against PyTorch before it is kept, in OpenCV too where that is there.
"""
import argparse
import hashlib
import json
import os

import numpy as np
import onnx
import torch

import data as samples
import model as nets

OPSET = 10  # OpenCV 4.6 fails on three-input Clip and computed Pad of opset 11
OUTPUTS = ("planar", "normal", "confidence")


def inline_shared_constants(graph):
    """The exporter shares equal constants through Identity nodes, which OpenCV 4.6 cannot read: undoes that."""
    constants = {i.name for i in graph.initializer}
    renamed = {n.output[0]: n.input[0] for n in graph.node if n.op_type == "Identity" and n.input[0] in constants}
    nodes = [n for n in graph.node if n.output[0] not in renamed]
    for node in nodes:
        for i, name in enumerate(node.input):
            node.input[i] = renamed.get(name, name)
    del graph.node[:]
    graph.node.extend(nodes)


def to_onnx(net, path):
    for module in net.modules():
        if isinstance(module, nets.Conv):
            module.fold_gain()
    net = nets.Exportable(net).eval()
    image = torch.zeros(1, 3, samples.HEIGHT, samples.WIDTH)
    torch.onnx.export(net, image, path, opset_version=OPSET, input_names=["image"], output_names=list(OUTPUTS))
    graph = onnx.load(path)
    inline_shared_constants(graph.graph)
    for node in graph.graph.node:  # source lines; the producer's name stays: OpenCV reads Resize by it
        node.doc_string = ""
    onnx.checker.check_model(graph)
    onnx.save(graph, path)
    return net


def check_in_opencv(net, path):
    """Largest difference of any output between PyTorch and OpenCV on a random image; None without OpenCV."""
    try:
        import cv2
    except ImportError:
        return None
    image = torch.rand(1, 3, samples.HEIGHT, samples.WIDTH) * 2 - 1
    with torch.no_grad():
        expected = [x.numpy() for x in net(image)]
    reader = cv2.dnn.readNetFromONNX(path)
    reader.setInput(image.numpy())
    return max(float(np.abs(a - b).max()) for a, b in zip(expected, reader.forward(list(OUTPUTS))))


def manifest(model_path, plane_sigma_deg):
    digest = hashlib.sha256(open(model_path, "rb").read()).hexdigest()
    return {
        "format": "sslam-normals-1",
        "model": os.path.basename(model_path),
        "sha256": digest,
        "input": {
            "name": "image", "width": samples.WIDTH, "height": samples.HEIGHT, "channels": "rgb",
            "mean": [127.5] * 3, "scale": [1 / 127.5] * 3, "focal": samples.FOCAL,
        },
        "output": {
            "kind": "normals", "name": "normal", "axes": ["x", "y", "z"], "signs": [1, 1, 1],
            "plane_sigma_deg": plane_sigma_deg, "mask": "planar", "confidence": "confidence",
        },
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkpoint")
    parser.add_argument("--out", default=os.path.join(os.path.dirname(os.path.abspath(__file__)), "planar_normals.onnx"),
                        help="the .onnx to write; the manifest goes beside it as .json")
    parser.add_argument("--plane-sigma-deg", type=float, default=5,
                        help="what the normals of one plane get wrong together, as evaluate.py finds it on the validation split")
    args = parser.parse_args()
    net, state = nets.load_checkpoint(args.checkpoint)
    temporary = args.out + ".tmp"
    try:
        exported = to_onnx(net, temporary)
        difference = check_in_opencv(exported, temporary)
        if difference is not None and difference > 1e-3:
            raise SystemExit(f"{args.out}: OpenCV and PyTorch differ by {difference:.3g}; not written")
        os.replace(temporary, args.out)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)
    described = manifest(args.out, args.plane_sigma_deg)
    with open(os.path.splitext(args.out)[0] + ".json", "w") as file:
        json.dump(described, file, indent=2)
        file.write("\n")
    size = os.path.getsize(args.out) / 1e6
    print(f"{args.out}: step {state['step']}, {size:.2f} MB, sha256 {described['sha256']}, "
          f"OpenCV against PyTorch {difference if difference is not None else 'not checked'}")


if __name__ == "__main__":
    main()
