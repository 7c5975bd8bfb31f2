# SPDX-License-Identifier: BSD-3-Clause
"""Training losses: balanced cross-entropy on the planar mask, cosine and angular likelihood on planar pixels."""
import math

import torch
import torch.nn.functional as F

LOG_KAPPA_LIMITS = (-1.5, 4.5)


LONE_CLASS_WEIGHT = 0.25  # of an image that shows planes alone, as rendered rooms do: it says little about the border


def mask_loss(logit, planar, known):
    """Cross-entropy in which planar and non-planar pixels weigh the same (section III-B of the paper)."""
    loss = F.binary_cross_entropy_with_logits(logit, planar.float(), reduction="none")
    positive, negative = (planar & known).float(), (~planar & known).float()
    both = negative.sum(dim=(1, 2), keepdim=True) > 0
    positive = positive * torch.where(both, 1.0, LONE_CLASS_WEIGHT)
    return 0.5 * sum((loss * w).sum() / w.sum().clamp_min(1) for w in (positive, negative))


def normal_loss(raw, log_kappa, target, planar, cosine_weight):
    """Negative cosine, and the likelihood of the angle under a concentration that the network also predicts.

    The likelihood is the angular von Mises-Fisher density of Bae, Budvytis and Cipolla (ICCV 2021):
    p(angle) ~ (kappa^2 + 1) exp(-kappa angle) / (1 + exp(-kappa pi)); its mean angle is about 2 / kappa.
    """
    unit = F.normalize(raw, dim=1)
    cosine = (unit * target).sum(dim=1)[planar]
    if cosine.numel() == 0:
        return raw.sum() * 0, raw.sum() * 0
    kappa = log_kappa[planar].clamp(*LOG_KAPPA_LIMITS).exp()
    angle = torch.acos(cosine.clamp(-1 + 1e-5, 1 - 1e-5))
    likelihood = -torch.log(kappa * kappa + 1) + kappa * angle + torch.log1p(torch.exp(-kappa * math.pi))
    return cosine_weight * (1 - cosine).mean() + likelihood.mean(), (1 - cosine).mean()


def total_loss(output, ids, normals, mask_weight=1.0, cosine_weight=3.0):
    known, planar = ids != 255, ids == 1
    mask = mask_loss(output[:, 0], planar, known)
    normal, cosine = normal_loss(output[:, 1:4], output[:, 4], normals, planar, cosine_weight)
    return mask_weight * mask + normal, {"mask": float(mask), "normal": float(normal), "cosine": float(cosine)}
