#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A long sequence in one place: the images of a TUM-layout folder, forwards and backwards, as often as it takes.

  bench/endless.py FOLDER OUT --frames 20000
  /usr/bin/time -f '%M kB' sslam run OUT --normals none

Shows whether memory grows with time where the map does not.
"""
import argparse
import os
import shutil


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="with rgb.txt and camera.yaml, as sslam synth writes it")
    parser.add_argument("out", help="new folder: lists alone, the images stay where they are")
    parser.add_argument("--frames", type=int, default=5000)
    parser.add_argument("--fps", type=float, default=30)
    args = parser.parse_args()
    with open(os.path.join(args.folder, "rgb.txt")) as lines:
        images = [line.split()[1] for line in lines if line.strip() and not line.startswith("#")]
    if len(images) < 2:
        raise SystemExit(f"{args.folder}/rgb.txt: names fewer than two images")
    there_and_back = images + images[-2:0:-1]
    os.makedirs(args.out)
    os.symlink(os.path.abspath(os.path.join(args.folder, "rgb")), os.path.join(args.out, "rgb"))
    shutil.copy(os.path.join(args.folder, "camera.yaml"), args.out)
    with open(os.path.join(args.out, "rgb.txt"), "w") as out:
        for i in range(args.frames):
            out.write(f"{i / args.fps:.6f} {there_and_back[i % len(there_and_back)]}\n")


if __name__ == "__main__":
    main()
