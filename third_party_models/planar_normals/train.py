#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Trains the network for a given time, with checkpoints, resume and a log of validation scores.

The learning rate follows the share of the time budget that is used up, so that a run ends on time on a busy machine.
A run that was cut off goes on from its last checkpoint (the time used so far is kept) when it is started again.
On a CPU that is shared with other jobs, --processes 2 --threads 1 is faster than two threads, which wait for each other
in every operation.
"""
import argparse
import copy
import csv
import json
import math
import os
import tempfile
import time

import cv2
import numpy as np
import torch
import torch.distributed
import torch.multiprocessing

from data import PlaneDataset
from evaluate import TorchPredictor, evaluate_planes
from losses import total_loss
from model import PlanarNormals


class Mixture(torch.utils.data.Dataset):
    """Items are addressed by (source, index, seed), so that a batch is the same whatever the number of workers."""

    def __init__(self, sources):
        self.sources = sources

    def __getitem__(self, key):
        source, index, seed = key
        self.sources[source].epoch = seed
        return self.sources[source][index]


class Batches(torch.utils.data.Sampler):
    """This process's part of every batch; all processes draw the same batches."""

    def __init__(self, sizes, shares, batch, seed, first_step, rank, processes):
        self.sizes, self.batch, self.seed, self.step = sizes, batch, seed, first_step
        self.rank, self.processes = rank, processes
        self.shares = np.array(shares, float) / sum(shares)
        self.queues = [[] for _ in sizes]

    def __iter__(self):
        while True:
            self.step += 1
            rng = np.random.default_rng((self.seed, self.step))
            keys = []
            for source in rng.choice(len(self.sizes), self.batch, p=self.shares):
                if not self.queues[source]:
                    self.queues[source] = list(rng.permutation(self.sizes[source]))
                keys.append((int(source), int(self.queues[source].pop()), self.step))
            yield keys[self.rank::self.processes]


def start_worker(_):
    cv2.setNumThreads(1)
    torch.set_num_threads(1)


def rate(progress, warmup=0.02, floor=0.01):
    if progress < warmup:
        return progress / warmup
    return floor + (1 - floor) * 0.5 * (1 + math.cos(math.pi * min(1.0, (progress - warmup) / (1 - warmup))))


def update_average(average, net, step, decay):
    decay = min(decay, (1 + step) / (10 + step))
    with torch.no_grad():
        for a, p in zip(average.parameters(), net.parameters()):
            a.lerp_(p, 1 - decay)


def save(path, **data):
    torch.save(data, path + ".tmp")
    os.replace(path + ".tmp", path)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", nargs="+", required=True, help=".npz files of prepare.py; the first one also validates")
    parser.add_argument("--shares", nargs="+", type=float, help="share of each file in a batch (default: equal)")
    parser.add_argument("--encoder", help="weights to start the encoder from (torchvision's MobileNetV2 names)")
    parser.add_argument("--start", help="checkpoint whose averaged weights to start from")
    parser.add_argument("--out", required=True, help="folder for checkpoints and scores.csv")
    parser.add_argument("--minutes", type=float, default=120, help="time budget, validation included")
    parser.add_argument("--steps", type=int, default=10**9, help="end after this many steps at the latest")
    parser.add_argument("--batch", type=int, default=8)
    parser.add_argument("--rate", type=float, default=1e-3, help="peak learning rate of the decoder")
    parser.add_argument("--encoder-rate", type=float, default=3e-4)
    parser.add_argument("--decay", type=float, default=0.02, help="weight decay")
    parser.add_argument("--average", type=float, default=0.998, help="decay of the running average of the weights")
    parser.add_argument("--cosine-weight", type=float, default=3.0)
    parser.add_argument("--channels", type=int, default=96, help="width of the decoder")
    parser.add_argument("--no-dilation", action="store_true", help="last encoder stage at stride 32 (ImageNet weights)")
    parser.add_argument("--validate-minutes", type=float, default=8, help="time between validations and checkpoints")
    parser.add_argument("--validate-images", type=int, help="images per validation (default: all)")
    parser.add_argument("--bf16", action="store_true", help="bfloat16 activations")
    parser.add_argument("--threads", type=int, default=2, help="of each process")
    parser.add_argument("--processes", type=int, default=1, help="that share a batch")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--device", default="cuda" if torch.cuda.is_available() else "cpu")
    parser.add_argument("--seed", type=int, default=1)
    return parser.parse_args()


class Trainer:
    def __init__(self, args, rank):
        self.args, self.rank = args, rank
        torch.manual_seed(args.seed)
        torch.set_num_threads(args.threads)
        self.net = PlanarNormals(args.channels, not args.no_dilation)
        if args.encoder:
            self.net.encoder.load_torchvision(torch.load(args.encoder, map_location="cpu"))
        if args.start:
            self.net.load_state_dict(torch.load(args.start, map_location="cpu")["ema"])
        self.net.to(args.device, memory_format=torch.channels_last)
        self.average = copy.deepcopy(self.net).requires_grad_(False)
        encoder = list(self.net.encoder.parameters())
        known = {id(p) for p in encoder}
        decoder = [p for p in self.net.parameters() if id(p) not in known]
        self.optimizer = torch.optim.AdamW([{"params": encoder, "peak": args.encoder_rate}, {"params": decoder, "peak": args.rate}],
                                           lr=0.0, weight_decay=args.decay)
        self.step, self.used = 0, 0.0
        self.checkpoint = f"{args.out}/last.pt"
        if os.path.exists(self.checkpoint):
            self.resume()

    def resume(self):
        state = torch.load(self.checkpoint, map_location="cpu")
        self.net.load_state_dict(state["net"])
        self.average.load_state_dict(state["ema"])
        self.optimizer.load_state_dict(state["optimizer"])
        self.step, self.used = state["step"], state["used"]
        print(f"resuming at step {self.step}, {self.used / 60:.1f} minutes used", flush=True)

    def train_step(self, batch):
        images, ids, normals = (x.to(self.args.device, non_blocking=True) for x in batch)
        images = images.contiguous(memory_format=torch.channels_last)
        share = self.used / (60 * self.args.minutes)
        for group in self.optimizer.param_groups:
            group["lr"] = group["peak"] * rate(share)
        with torch.autocast(self.args.device.split(":")[0], torch.bfloat16, enabled=self.args.bf16):
            output = self.net(images)
        loss, parts = total_loss(output.float(), ids, normals, cosine_weight=self.args.cosine_weight)
        self.optimizer.zero_grad(set_to_none=True)
        loss.backward()
        self.share_gradients()
        norm = torch.nn.utils.clip_grad_norm_(self.net.parameters(), 5.0)
        if not torch.isfinite(norm):
            print(f"step {self.step}: gradient not finite, skipped", flush=True)
            return parts
        self.optimizer.step()
        self.step += 1
        if self.rank == 0:
            update_average(self.average, self.net, self.step, self.args.average)
        return parts

    def share_gradients(self):
        """Mean over the processes; they also agree on the time, so that their learning rates and ends are the same."""
        if self.args.processes == 1:
            return
        gradients = [p.grad for p in self.net.parameters()]
        flat = torch.cat([g.reshape(-1) for g in gradients] + [torch.tensor([self.used / 60])]).div_(self.args.processes)
        torch.distributed.all_reduce(flat)
        start = 0
        for g in gradients:
            g.copy_(flat[start:start + g.numel()].view_as(g))
            start += g.numel()
        self.used = 60 * float(flat[-1])

    def validate(self, losses):
        net = copy.deepcopy(self.average).to("cpu", memory_format=torch.contiguous_format).eval()
        scores = evaluate_planes(TorchPredictor(net), self.args.data[0], "validation", self.args.validate_images)
        row = {"step": self.step, "minutes": round(self.used / 60, 2),
               **{k: round(float(v), 4) for k, v in {**losses, **scores}.items()}}
        print(json.dumps(row), flush=True)
        path = f"{self.args.out}/scores.csv"
        fresh = not os.path.exists(path)
        with open(path, "a", newline="") as file:
            writer = csv.DictWriter(file, row.keys())
            if fresh:
                writer.writeheader()
            writer.writerow(row)

    def save(self):
        save(self.checkpoint, net=self.net.state_dict(), ema=self.average.state_dict(), optimizer=self.optimizer.state_dict(),
             step=self.step, used=self.used, config=self.net.config, args=vars(self.args))

    def run(self):
        args = self.args
        sources = [PlaneDataset(p, "training", True, args.seed) for p in args.data]
        shares = args.shares or [1.0] * len(sources)
        batches = Batches([len(s) for s in sources], shares, args.batch, args.seed, self.step, self.rank, args.processes)
        loader = iter(torch.utils.data.DataLoader(Mixture(sources), batch_sampler=batches, num_workers=args.workers,
                                                  worker_init_fn=start_worker))
        sums, count, last, validated = {}, 0, time.monotonic(), self.used
        done, parent = False, os.getppid()
        while not done:
            if os.getppid() != parent:  # the process that started this one was ended
                return
            now = time.monotonic()
            self.used, last = self.used + now - last, now
            for key, value in self.train_step(next(loader)).items():
                sums[key] = sums.get(key, 0.0) + value
            count += 1
            done = self.used >= 60 * args.minutes or self.step >= args.steps
            if self.rank != 0:
                continue
            if self.step % 50 == 0:
                print(f"step {self.step} minutes {self.used / 60:.1f} " + " ".join(f"{k} {v / count:.4f}" for k, v in sums.items()), flush=True)
            if done or self.used - validated > 60 * args.validate_minutes:
                self.save()
                self.validate({k: v / count for k, v in sums.items()})
                sums, count, validated = {}, 0, self.used


def work(rank, args, meeting_place):
    if args.processes > 1:
        torch.distributed.init_process_group("gloo", init_method=f"file://{meeting_place}", rank=rank, world_size=args.processes)
    Trainer(args, rank).run()


def main():
    args = arguments()
    os.makedirs(args.out, exist_ok=True)
    if args.processes == 1:
        work(0, args, None)
        return
    if args.device != "cpu":
        raise SystemExit("--processes is for the CPU")
    with tempfile.TemporaryDirectory() as folder:
        torch.multiprocessing.spawn(work, (args, f"{folder}/meet"), args.processes)


if __name__ == "__main__":
    main()
