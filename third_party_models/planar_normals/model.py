# SPDX-License-Identifier: BSD-3-Clause
"""The network: a MobileNetV2 encoder without batch normalisation and a light feature-pyramid decoder.

Input  : RGB, N x 3 x H x W, scaled to [-1, 1], H and W multiples of 32.
Output : N x 5 x H/4 x W/4 raw channels: planar logit, normal (x, y, z; not yet unit), log concentration.
`Exportable` turns the raw channels into what the ONNX file promises (see README.md).
"""
import math

import torch
import torch.nn.functional as F
from torch import nn

# expansion, channels, repeats, stride of MobileNetV2 (Sandler et al., CVPR 2018, table 2)
BLOCKS = ((1, 16, 1, 1), (6, 24, 2, 2), (6, 32, 3, 2), (6, 64, 4, 2), (6, 96, 3, 1), (6, 160, 3, 2), (6, 320, 1, 1))
WEIGHT_RMS = 0.1  # of the stored weights; a step of the optimiser is then equally large, relatively, in every channel
LOG_KAPPA_HALF = math.log(8.0)  # concentration with confidence 0.5: a mean error of 2 / 8 rad = 14 degrees


class Conv(nn.Module):
    """Convolution with bias whose weight is stored as gain * weight, with a fixed gain per output channel.

    Folding batch normalisation into weights leaves channels of very different scale; with the gain taken out, one
    learning rate suits all of them.
    """

    def __init__(self, cin, cout, kernel=1, stride=1, dilation=1, groups=1, gain_init=1.0):
        super().__init__()
        self.stride, self.dilation, self.groups = stride, dilation, groups
        self.padding = dilation * (kernel - 1) // 2
        self.weight = nn.Parameter(torch.randn(cout, cin // groups, kernel, kernel) * WEIGHT_RMS)
        self.bias = nn.Parameter(torch.zeros(cout))
        fan_in = cin // groups * kernel * kernel
        self.register_buffer("gain", torch.full((cout, 1, 1, 1), gain_init * math.sqrt(2 / fan_in) / WEIGHT_RMS))

    def load_plain(self, weight, bias):
        with torch.no_grad():
            rms = weight.pow(2).mean(dim=(1, 2, 3), keepdim=True).sqrt().clamp_min(1e-6)
            self.gain.copy_(rms / WEIGHT_RMS)
            self.weight.copy_(weight / self.gain)
            self.bias.copy_(bias)

    def plain_weight(self):
        return self.weight if self.gain is None else self.weight * self.gain

    def fold_gain(self):
        with torch.no_grad():
            self.weight.copy_(self.plain_weight())
        self.gain = None

    def forward(self, x):
        return F.conv2d(x, self.plain_weight(), self.bias, self.stride, self.padding, self.dilation, self.groups)


class Block(nn.Module):
    """Inverted residual."""

    def __init__(self, cin, cout, stride, expand, dilation):
        super().__init__()
        hidden = cin * expand
        self.residual = stride == 1 and cin == cout
        self.expand = Conv(cin, hidden) if expand != 1 else None
        self.depthwise = Conv(hidden, hidden, 3, stride, dilation, groups=hidden)
        self.project = Conv(hidden, cout, gain_init=0.5)

    def forward(self, x):
        y = relu6(self.expand(x)) if self.expand is not None else x
        y = self.project(relu6(self.depthwise(y)))
        return x + y if self.residual else y


class Encoder(nn.Module):
    """MobileNetV2 features 0 to 17. With `dilated` the last stage keeps stride 16 (as in the ADE20K weights)."""

    def __init__(self, dilated):
        super().__init__()
        self.stem = Conv(3, 32, 3, 2)
        blocks, cin, stage = [], 32, 0
        for expand, cout, repeats, stride in BLOCKS:
            stage += 1
            for i in range(repeats):
                first = i == 0
                s = stride if first else 1
                dilation = 1
                if dilated and stage >= 6:
                    s, dilation = 1, 1 if (stage == 6 and first) else 2
                blocks.append(Block(cin, cout, s, expand, dilation))
                cin = cout
        self.blocks = nn.ModuleList(blocks)

    def forward(self, x):
        x = relu6(self.stem(x))
        out = []
        for i, block in enumerate(self.blocks):
            x = block(x)
            if i in (2, 5, 12, 16):  # strides 4, 8, 16, and 16 or 32
                out.append(x)
        return out

    def load_torchvision(self, state):
        """Takes a state dict with torchvision's MobileNetV2 names; folds what batch normalisation there is."""
        if any(k.startswith("features.") for k in state):
            state = {k[len("features."):]: v for k, v in state.items() if k.startswith("features.")}

        def fold(conv, bn):
            scale = state[bn + ".weight"] / torch.sqrt(state[bn + ".running_var"] + 1e-5)
            return state[conv + ".weight"] * scale.view(-1, 1, 1, 1), state[bn + ".bias"] - state[bn + ".running_mean"] * scale

        self.stem.load_plain(*fold("0.0", "0.1"))
        for i, block in enumerate(self.blocks):
            p = f"{i + 1}.conv."
            j = 0
            if block.expand is not None:
                block.expand.load_plain(*fold(p + "0.0", p + "0.1"))
                j = 1
            block.depthwise.load_plain(*fold(p + f"{j}.0", p + f"{j}.1"))
            block.project.load_plain(*fold(p + f"{j + 1}", p + f"{j + 2}"))


class Separable(nn.Module):
    """Depthwise, then pointwise, with a residual connection."""

    def __init__(self, channels, kernel=3, dilation=1):
        super().__init__()
        self.depthwise = Conv(channels, channels, kernel, dilation=dilation, groups=channels, gain_init=0.7)
        self.pointwise = Conv(channels, channels)
        self.project = Conv(channels, channels, gain_init=0.5)

    def forward(self, x):
        return x + self.project(F.relu(self.pointwise(self.depthwise(x))))


class PlanarNormals(nn.Module):
    def __init__(self, channels=96, dilated=True):
        super().__init__()
        self.config = dict(channels=channels, dilated=dilated)
        self.encoder = Encoder(dilated)
        self.lateral = nn.ModuleList([Conv(c, channels, gain_init=0.5) for c in (24, 32, 96, 320)])
        self.context = Conv(320, channels, gain_init=0.5)
        # 5x5 and dilated at stride 16: wide view, where it is cheap
        self.deep = nn.Sequential(Separable(channels, 5), Separable(channels, 5, 2))
        self.mid = nn.Sequential(Separable(channels, 5), Separable(channels, 3))
        self.fine = nn.Sequential(Separable(channels, 3))
        self.head = Conv(channels, 5, gain_init=0.2)

    def forward(self, x):
        f4, f8, f16, deep = self.encoder(x)
        size16 = f16.shape[-2:]
        context = self.context(F.adaptive_avg_pool2d(deep, 1))
        y = self.lateral[3](deep)
        if y.shape[-2:] != size16:
            y = F.interpolate(y, scale_factor=2, mode="nearest")
        y = F.relu(y + self.lateral[2](f16) + context)
        y = self.deep(y)
        y = self.mid(up2(y) + self.lateral[1](f8))
        y = self.fine(up2(y) + self.lateral[0](f4))
        return self.head(F.relu(y))


class Bfloat16Relu6(torch.autograd.Function):
    """Older PyTorch has no bfloat16 gradient for relu6, and that of clamp is slow."""

    @staticmethod
    def forward(ctx, x):
        y = x.clamp(0, 6)
        ctx.save_for_backward(y)
        return y

    @staticmethod
    def backward(ctx, gradient):
        (y,) = ctx.saved_tensors
        gradient = torch.ops.aten.threshold_backward(gradient, y, 0)
        return torch.ops.aten.threshold_backward(gradient, 6 - y, 0)


def relu6(x):
    return Bfloat16Relu6.apply(x) if x.requires_grad and x.dtype == torch.bfloat16 else F.relu6(x)


def up2(x):
    return F.interpolate(x, scale_factor=2, mode="bilinear", align_corners=False)


class Exportable(nn.Module):
    """The network as it is shipped: planar probability, unit normal, confidence in [0, 1]."""

    def __init__(self, net):
        super().__init__()
        self.net = net

    def forward(self, x):
        raw = self.net(x)
        planar = torch.sigmoid(raw[:, 0:1])
        normal = F.normalize(raw[:, 1:4], dim=1)
        return planar, normal, torch.sigmoid(2.0 * (raw[:, 4:5] - LOG_KAPPA_HALF))


def load_checkpoint(path, weights="ema"):
    data = torch.load(path, map_location="cpu")
    net = PlanarNormals(**data["config"])
    net.load_state_dict(data[weights])
    return net.eval(), data
