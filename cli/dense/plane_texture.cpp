// SPDX-License-Identifier: BSD-3-Clause
#include "cli/dense/plane_texture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "cli/dense/view_sharpness.hpp"

namespace sslam::cli {
namespace {

constexpr int kTile = 16;  // texels that share their views
constexpr std::size_t kViewsOfTile = 4;

class Painter {
 public:
  Painter(const TextureInput& input, Atlas& atlas)
      : input_(input), atlas_(atlas), sharpness_(sharpness_of(input.views)) {
    find_showing();
    find_gains();
  }

  void paint() {
    sum_.create(atlas_.image.size());
    sum_.setTo(cv::Scalar::all(0));
    choose();
    for (std::size_t v = 0; v < input_.views.size(); ++v) {
      if (tiles_[v].empty()) continue;
      const cv::Mat image = input_.image(v);
      for (const Tile& tile : tiles_[v]) add(v, tile, image);
    }
    for (int y = 0; y < atlas_.image.rows; ++y)
      for (int x = 0; x < atlas_.image.cols; ++x) {
        const cv::Vec4f& s = sum_(y, x);
        for (int c = 0; c < 3; ++c)
          atlas_.image(y, x)[c] = s[3] > 0 ? cv::saturate_cast<std::uint8_t>(s[c] / s[3]) : 128;
      }
  }

 private:
  struct Tile {
    std::size_t chart;
    cv::Rect texels;  // in the atlas
    double best;      // rating of the best view in its middle
  };

  [[nodiscard]] const dense::DensePlane& plane_of(const Chart& chart) const {
    return input_.model.planes[chart.plane];
  }
  [[nodiscard]] Vec3<double> place(const Chart& chart, double x, double y) const {
    const Vec2<double> u = chart.origin + atlas_.texel * Vec2<double>(x - chart.place.x, y - chart.place.y);
    return plane_of(chart).cells.place(u);
  }

  // What part of the surroundings of a pixel is labelled with the plane, 0 to 1.
  [[nodiscard]] double shown(std::size_t v, const Vec2<double>& pixel, std::size_t label) const {
    const dense::LabelGrid& grid = input_.model.labels[v];
    const double x = (pixel.x() + 0.5) / grid.block - 0.5, y = (pixel.y() + 0.5) / grid.block - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    double sum = 0;
    for (int dy = 0; dy < 2; ++dy)
      for (int dx = 0; dx < 2; ++dx) {
        const int c = std::clamp(x0 + dx, 0, grid.columns - 1), r = std::clamp(y0 + dy, 0, grid.rows - 1);
        if (grid.plane[static_cast<std::size_t>(r * grid.columns + c)] != static_cast<std::int16_t>(label))
          continue;
        sum += (dx == 0 ? 1 - (x - x0) : x - x0) * (dy == 0 ? 1 - (y - y0) : y - y0);
      }
    return sum;
  }

  // How well the view shows a place: pixels a unit of length, less at a slant, near the border, in a blurred
  // image, and where it shows something else. 0: not at all.
  [[nodiscard]] double rate(std::size_t v, const dense::DensePlane& plane, const Vec3<double>& x,
                            Vec2<double>& pixel) const {
    constexpr double kBorder = 12, kElse = 1e-3;  // pixels; for what nobody shows better
    const dense::DenseView& view = input_.views[v];
    const Vec3<double> in_cam = view.cam_from_world * x;
    if (!(in_cam.z() > 1e-9)) return 0;
    pixel = view.pinhole.project(in_cam);
    const double border =
        std::min(std::min(pixel.x(), pixel.y()),
                 std::min(view.grey.width() - 1 - pixel.x(), view.grey.height() - 1 - pixel.y()));
    if (!(border > 0) || !view.sees(pixel.cast<float>())) return 0;
    const double cosine =
        std::abs((view.cam_from_world.rotation * plane.fit.plane.normal).dot(in_cam.normalized()));
    return (shown(v, pixel, plane.label) + kElse) * std::min(1.0, border / kBorder) * sharpness_[v] * cosine /
           in_cam.norm();
  }

  // The views that show the middle of each tile best.
  void choose() {
    tiles_.assign(input_.views.size(), {});
    std::vector<std::pair<double, std::size_t>> rated;
    for (std::size_t c = 0; c < atlas_.charts.size(); ++c) {
      const Chart& chart = atlas_.charts[c];
      for (int y = chart.place.y; y < chart.place.br().y; y += kTile)
        for (int x = chart.place.x; x < chart.place.br().x; x += kTile) {
          const Vec3<double> middle = place(chart, x + kTile / 2, y + kTile / 2);
          rated.clear();
          Vec2<double> pixel;
          for (std::size_t v = 0; v < input_.views.size(); ++v)
            if (const double rating = rate(v, plane_of(chart), middle, pixel); rating > 0)
              rated.emplace_back(-rating, v);
          std::sort(rated.begin(), rated.end());
          for (std::size_t i = 0; i < rated.size() && i < kViewsOfTile; ++i)
            tiles_[rated[i].second].push_back(
                {c, cv::Rect(x, y, kTile, kTile) & chart.place, -rated.front().first});
        }
    }
  }

  void add(std::size_t v, const Tile& tile, const cv::Mat& image) {
    const Chart& chart = atlas_.charts[tile.chart];
    for (int y = tile.texels.y; y < tile.texels.br().y; ++y)
      for (int x = tile.texels.x; x < tile.texels.br().x; ++x) {
        Vec2<double> pixel;
        const double rating = rate(v, plane_of(chart), place(chart, x, y), pixel) / tile.best;
        if (!(rating > 0)) continue;
        const double squared = rating * rating, weight = std::max(1e-12, squared * squared * squared);
        const Vec2<double> at = ((pixel.array() + 0.5) * input_.scale - 0.5).matrix();
        const cv::Vec3d colour = sample(image, at);
        cv::Vec4f& sum = sum_(y, x);
        for (int c = 0; c < 3; ++c) sum[c] += static_cast<float>(weight * gains_[v] * colour[c]);
        sum[3] += static_cast<float>(weight);
      }
  }

  [[nodiscard]] static cv::Vec3d sample(const cv::Mat& image, const Vec2<double>& at) {
    const double x = std::clamp(at.x(), 0.0, image.cols - 1.001),
                 y = std::clamp(at.y(), 0.0, image.rows - 1.001);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const double fx = x - x0, fy = y - y0;
    const auto* const a = image.ptr<cv::Vec3b>(y0) + x0;
    const auto* const b = image.ptr<cv::Vec3b>(y0 + 1) + x0;
    cv::Vec3d out;
    for (int c = 0; c < 3; ++c)
      out[c] = (1 - fy) * ((1 - fx) * a[0][c] + fx * a[1][c]) + fy * ((1 - fx) * b[0][c] + fx * b[1][c]);
    return out;
  }

  // Of each plane, the views that are labelled with it somewhere.
  void find_showing() {
    for (const dense::DensePlane& plane : input_.model.planes) {
      const auto label = static_cast<std::int16_t>(plane.label);
      std::vector<std::size_t>& views = showing_.emplace_back();
      for (std::size_t v = 0; v < input_.views.size(); ++v)
        if (const auto& of = input_.model.labels[v].plane; std::find(of.begin(), of.end(), label) != of.end())
          views.push_back(v);
    }
  }

  // Exposures: log I(view, place) = log gain^-1(view) + log albedo(place), by alternating means over places
  // that several views show; gains are 1 on average and drawn towards 1.
  void find_gains() {
    struct Seen {
      std::size_t place, view;
      double log;
    };
    std::vector<Seen> seen;
    std::size_t places = 0;
    const int step =
        std::max(1, static_cast<int>(std::lround(6 * input_.model.planes.front().cells.cell / atlas_.texel)));
    for (const Chart& chart : atlas_.charts)
      for (int y = chart.place.y + step / 2; y < chart.place.br().y; y += step)
        for (int x = chart.place.x + step / 2; x < chart.place.br().x; x += step, ++places)
          for (const std::size_t v : showing_[chart.plane]) {
            Vec2<double> pixel;
            const dense::DensePlane& plane = plane_of(chart);
            if (!(rate(v, plane, place(chart, x, y), pixel) > 0) || shown(v, pixel, plane.label) < 0.99)
              continue;
            const double grey =
                input_.views[v].grey.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
            if (grey > 10 && grey < 245) seen.push_back({places, v, std::log(grey)});
          }
    constexpr int kRounds = 20;
    constexpr double kHold = 20;  // places that speak for a gain of 1
    std::vector<double> level(places, 0), gain(input_.views.size(), 0), sum, count;
    const auto average = [&](std::vector<double>& of, const std::vector<double>& other, auto own, auto others,
                             double hold) {
      sum.assign(of.size(), 0);
      count.assign(of.size(), hold);
      for (const Seen& s : seen) {
        sum[own(s)] += s.log - other[others(s)];
        count[own(s)] += 1;
      }
      for (std::size_t i = 0; i < of.size(); ++i) of[i] = count[i] > 0 ? sum[i] / count[i] : 0;
    };
    const auto place_of = [](const Seen& s) { return s.place; };
    const auto view_of = [](const Seen& s) { return s.view; };
    for (int round = 0; round < kRounds; ++round) {
      average(level, gain, place_of, view_of, 0);
      average(gain, level, view_of, place_of, kHold);
    }
    const double mean = std::accumulate(gain.begin(), gain.end(), 0.0) / static_cast<double>(gain.size());
    for (const double g : gain) gains_.push_back(std::exp(mean - g));
  }

  const TextureInput& input_;
  Atlas& atlas_;
  cv::Mat_<cv::Vec4f> sum_;               // weighted colours, and weights
  std::vector<std::vector<Tile>> tiles_;  // by view
  std::vector<double> gains_;             // by view
  std::vector<double> sharpness_;         // by view
  std::vector<std::vector<std::size_t>> showing_;
};

}  // namespace

Atlas make_atlas(const TextureInput& input) {
  Atlas atlas;
  if (input.model.planes.empty()) return atlas;
  ChartLayout layout = lay_out_charts(input.model, input.texel);
  atlas.texel = layout.texel;
  atlas.charts = std::move(layout.charts);
  atlas.image.create(layout.size);
  Painter(input, atlas).paint();
  return atlas;
}

}  // namespace sslam::cli
