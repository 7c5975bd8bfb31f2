// SPDX-License-Identifier: BSD-3-Clause
// A depth map as square blocks: sums over each block from which planes in inverse depth are fitted to a block
// or to any window of blocks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/image/image_view.hpp"

namespace sslam {

// Inverse depth near a pixel: value + du * u + dv * v, u and v counted from that pixel.
struct InverseDepthPlane {
  float value = 0, du = 0, dv = 0;  // 1 / metres, and the same per pixel
};

// Moments of inverse depth w over pixels (u, v).
struct InverseDepthSums {
  float n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0, w = 0, uw = 0, vw = 0, ww = 0;

  // Adds the sums of pixels counted from another origin, which lies at (x, y) here.
  void add(const InverseDepthSums& s, float x, float y) noexcept {
    n += s.n;
    u += s.u + s.n * x;
    v += s.v + s.n * y;
    uu += s.uu + 2 * x * s.u + s.n * x * x;
    uv += s.uv + x * s.v + y * s.u + s.n * x * y;
    vv += s.vv + 2 * y * s.v + s.n * y * y;
    w += s.w;
    uw += s.uw + x * s.w;
    vw += s.vw + y * s.w;
    ww += s.ww;
  }

  // Least squares; false, and `plane` untouched, where the pixels do not span a plane.
  [[nodiscard]] bool solve(InverseDepthPlane& plane) const noexcept {
    if (!(n >= 3)) return false;
    const float mu = u / n, mv = v / n, mw = w / n;
    const float suu = uu - n * mu * mu, suv = uv - n * mu * mv, svv = vv - n * mv * mv;
    const float suw = uw - n * mu * mw, svw = vw - n * mv * mw;
    const float det = suu * svv - suv * suv;
    if (!(det > 0.05F * suu * svv) || !(suu > 0)) return false;
    plane.du = (svv * suw - suv * svw) / det;
    plane.dv = (suu * svw - suv * suw) / det;
    plane.value = mw - plane.du * mu - plane.dv * mv;
    return true;
  }

  // Mean square distance of the pixels from a plane that solve() gave.
  [[nodiscard]] float residual(const InverseDepthPlane& p) const noexcept {
    return std::max(0.0F, (ww - p.value * w - p.du * uw - p.dv * vw) / n);
  }
};

struct DepthBlock {
  InverseDepthSums sums;  // counted from the block's centre
  InverseDepthPlane plane;
  float mean = 0;       // inverse depth, 1 / metres
  bool planar = false;  // enough pixels, all on one plane
};

// The blocks of a window that lie on a common plane.
struct DepthWindow {
  InverseDepthSums sums;  // counted from the centre of the window's middle block
  float square_sum = 0;   // of the blocks' distances from the plane that gathered them
  int blocks = 0;
  int possible = 0;  // inside the image

  [[nodiscard]] float scatter() const noexcept {
    return blocks > 0 ? std::sqrt(square_sum / static_cast<float>(blocks)) : 0.0F;
  }
};

class InverseDepthBlocks {
 public:
  static constexpr int kBlock = 8;  // side, pixels

  // `depth` has `factor` to the metre. A block is planar when its pixels lie within `tolerance` (root mean
  // square, 1 / metres) of a plane.
  template <class Pixel>
  void build(ImageView<Pixel> depth, double factor, double min_depth, double max_depth, double tolerance) {
    columns_ = depth.width() / kBlock;
    rows_ = depth.height() / kBlock;
    blocks_.resize(static_cast<std::size_t>(columns_ * rows_));
    const auto scale = static_cast<float>(factor);
    const auto low = static_cast<float>(min_depth) * scale, high = static_cast<float>(max_depth) * scale;
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < columns_; ++c) {
        DepthBlock& block = blocks_[static_cast<std::size_t>(r * columns_ + c)];
        block = {};
        sum(depth, r, c, scale, low, high, block);
        finish(block, static_cast<float>(tolerance));
      }
    }
  }

  [[nodiscard]] int columns() const noexcept { return columns_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }
  [[nodiscard]] const DepthBlock& at(int r, int c) const noexcept {
    return blocks_[static_cast<std::size_t>(r * columns_ + c)];
  }

  // The planar blocks around (r, c) whose mean lies within `tolerance` of `plane`, which is counted from that
  // block's centre; `slack` lets the tolerance grow by as much for each block of distance.
  [[nodiscard]] DepthWindow gather(int r, int c, int radius, const InverseDepthPlane& plane, float tolerance,
                                   float slack) const noexcept {
    DepthWindow window;
    for (int rr = std::max(0, r - radius); rr <= std::min(rows_ - 1, r + radius); ++rr) {
      for (int cc = std::max(0, c - radius); cc <= std::min(columns_ - 1, c + radius); ++cc) {
        ++window.possible;
        const DepthBlock& block = at(rr, cc);
        if (!block.planar) continue;
        const auto x = static_cast<float>((cc - c) * kBlock), y = static_cast<float>((rr - r) * kBlock);
        const float mu = x + block.sums.u / block.sums.n, mv = y + block.sums.v / block.sums.n;
        const float off = block.mean - (plane.value + plane.du * mu + plane.dv * mv);
        const auto distance = static_cast<float>(std::max(std::abs(rr - r), std::abs(cc - c)));
        if (std::abs(off) > tolerance * (1 + slack * distance)) continue;
        window.sums.add(block.sums, x, y);
        window.square_sum += off * off;
        ++window.blocks;
      }
    }
    return window;
  }

 private:
  // Column by column, so that the compiler may use vector registers without reordering a sum.
  template <class Pixel>
  static void sum(ImageView<Pixel> depth, int r, int c, float scale, float low, float high,
                  DepthBlock& block) noexcept {
    constexpr auto kSide = static_cast<std::size_t>(kBlock);
    constexpr float kMiddle = (kBlock - 1) / 2.0F;
    float n[kSide] = {}, v[kSide] = {}, vv[kSide] = {}, w[kSide] = {}, vw[kSide] = {}, ww[kSide] = {};
    for (std::size_t row = 0; row < kSide; ++row) {
      const Pixel* d = depth.row(r * kBlock + static_cast<int>(row)) + c * kBlock;
      const float y = static_cast<float>(row) - kMiddle;
      for (std::size_t u = 0; u < kSide; ++u) {
        const auto raw = static_cast<float>(d[u]);
        const bool valid = raw >= low && raw <= high;
        const float one = valid ? 1.0F : 0.0F, inverse = one * scale / (valid ? raw : 1.0F);
        n[u] += one;
        v[u] += one * y;
        vv[u] += one * y * y;
        w[u] += inverse;
        vw[u] += inverse * y;
        ww[u] += inverse * inverse;
      }
    }
    InverseDepthSums& s = block.sums;
    for (std::size_t u = 0; u < kSide; ++u) {
      const float x = static_cast<float>(u) - kMiddle;
      s.n += n[u];
      s.u += x * n[u];
      s.v += v[u];
      s.uu += x * x * n[u];
      s.uv += x * v[u];
      s.vv += vv[u];
      s.w += w[u];
      s.uw += x * w[u];
      s.vw += vw[u];
      s.ww += ww[u];
    }
  }

  static void finish(DepthBlock& block, float tolerance) noexcept {
    const InverseDepthSums& s = block.sums;
    if (s.n < 0.6F * kBlock * kBlock || !s.solve(block.plane)) return;
    block.mean = s.w / s.n;
    block.planar = s.residual(block.plane) <= tolerance * tolerance;
  }

  int columns_ = 0, rows_ = 0;
  std::vector<DepthBlock> blocks_;
};

}  // namespace sslam
