// SPDX-License-Identifier: BSD-3-Clause
// Fills the cost grid of a view.
#pragma once

#include "sslam/dense/plane_cost.hpp"

namespace sslam::dense {

class ViewCosts {
 public:
  ViewCosts(std::span<const DenseView> views, std::span<const BoundedPlane> planes, double median_depth,
            const CostOptions& options)
      : views_(views), planes_(planes), depth_(median_depth), options_(options) {}

  // `views[view]`; replaces the grid.
  void fill(std::size_t view, CostGrid& grid) {
    const DenseView& v = views_[view];
    grid.columns = v.grey.width() / options_.block;
    grid.rows = v.grey.height() / options_.block;
    grid.planes = static_cast<int>(planes_.size());
    const auto blocks = static_cast<std::size_t>(grid.columns * grid.rows);
    grid.cost.assign(blocks * grid.labels(), kNoCost);
    grid.inverse_depth.assign(grid.cost.size(), 0);
    take_patches(v, grid);
    for (std::size_t p = 0; p < planes_.size(); ++p) fill_plane(v, p, grid);
    const auto none = static_cast<float>(options_.none * options_.photo_weight +
                                         (v.normals.normals.empty() ? 0 : 0.5 * options_.normal_weight));
    for (std::size_t b = 0; b < blocks; ++b) grid.cost[(b + 1) * grid.labels() - 1] = none;
    add_marks(v, grid);
  }

 private:
  [[nodiscard]] Vec2<double> centre(int column, int row) const {
    const double half = 0.5 * (options_.block - 1);
    return {column * options_.block + half, row * options_.block + half};
  }

  void take_patches(const DenseView& view, const CostGrid& grid) {
    patches_.assign(static_cast<std::size_t>(grid.columns * grid.rows), {});
    for (int r = 0; r < grid.rows; ++r)
      for (int c = 0; c < grid.columns; ++c) {
        Patch& patch = patches_[static_cast<std::size_t>(r * grid.columns + c)];
        const Vec2<double> at = centre(c, r);
        std::size_t i = 0;
        for (int dy = -Patch::kReach; dy <= Patch::kReach; ++dy)
          for (int dx = -Patch::kReach; dx <= Patch::kReach; ++dx, ++i)
            if (const Vec2<float> place((at + Vec2<double>(dx, dy)).cast<float>());
                detail::holds(view.grey, place.x(), place.y()))
              patch.value[i] = detail::sample(view.grey, place.x(), place.y());
            else
              patch.value[i] = 0;
        detail::centre_patch(patch);
      }
  }

  void fill_plane(const DenseView& view, std::size_t p, CostGrid& grid) {
    const BoundedPlane& bounded = planes_[p];
    const Plane3<double> in_cam = transform(view.cam_from_world, bounded.plane);
    const Vec3<double> form = inverse_depth_form(view.pinhole, in_cam);
    if (form.isZero()) return;
    const SE3<double> world_from_cam = view.cam_from_world.inverse();

    std::vector<Mat3<double>> homographies;
    for (const std::size_t other : view.near)
      homographies.push_back(plane_homography(view, views_[other], in_cam));
    for (int r = 0; r < grid.rows; ++r)
      for (int c = 0; c < grid.columns; ++c) {
        const Vec2<double> at = centre(c, r);
        const double inverse = form.dot(Vec3<double>(at.x(), at.y(), 1));
        if (!(inverse > 1e-9)) continue;
        const Vec3<double> ray = view.pinhole.unproject(at);
        if (std::abs(in_cam.normal.dot(ray)) < options_.grazing * ray.norm()) continue;
        const Vec2<double> u = bounded.basis.transpose() * (world_from_cam * Vec3<double>(ray / inverse));
        const double beyond = bounded.beyond(u) / depth_;
        if (beyond > options_.reach) continue;
        const std::size_t label = grid.at(c, r) + p;
        grid.inverse_depth[label] = static_cast<float>(inverse);
        grid.cost[label] =
            photo_cost(view, homographies, at, c, r, grid) + normal_cost(view, in_cam, ray) +
            static_cast<float>(options_.beyond_weight * std::min(1.0, beyond / options_.beyond));
      }
  }

  // The mean of the better half of the other views: the others may see something in front of it.
  [[nodiscard]] float photo_cost(const DenseView& view, const std::vector<Mat3<double>>& homographies,
                                 const Vec2<double>& at, int c, int r, const CostGrid& grid) const {
    const Patch& patch = patches_[static_cast<std::size_t>(r * grid.columns + c)];
    std::array<float, 8> costs{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < homographies.size() && count < costs.size(); ++k)
      if (patch_cost(patch, views_[view.near[k]].grey, homographies[k], at, options_.noise, costs[count]))
        ++count;
    if (count == 0) return static_cast<float>(0.8 * options_.none * options_.photo_weight);
    std::sort(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(count));
    const std::size_t half = (count + 1) / 2;
    float sum = 0;
    for (std::size_t k = 0; k < half; ++k) sum += costs[k];
    return static_cast<float>(options_.photo_weight) * sum / static_cast<float>(half);
  }

  [[nodiscard]] float normal_cost(const DenseView& view, const Plane3<double>& in_cam,
                                  const Vec3<double>& ray) const {
    const NormalImage& image = view.normals;
    if (image.normals.empty()) return 0;
    const auto half = static_cast<float>(0.5 * options_.normal_weight);
    const Vec2<double> at = image.pinhole.project(ray);
    const int x = static_cast<int>(std::lround(at.x())), y = static_cast<int>(std::lround(at.y()));
    if (x < 0 || y < 0 || x >= image.columns || y >= image.rows) return half;
    const Vec3<float>& n = image.normals[static_cast<std::size_t>(y * image.columns + x)];
    if (n.isZero()) return half;
    const double cosine = std::abs(n.cast<double>().dot(in_cam.normal));
    return static_cast<float>(options_.normal_weight *
                              std::min(1.0, (1 - cosine) / (1 - std::cos(options_.normal_angle))));
  }

  // In the block where a landmark is seen, planes that are not at its depth cost more.
  void add_marks(const DenseView& view, CostGrid& grid) const {
    constexpr double kOffPlanes = 0.15;  // cost of a landmark that is on none of the planes
    std::vector<std::vector<const DepthMark*>> marks(static_cast<std::size_t>(grid.columns * grid.rows));
    for (const DepthMark& mark : view.marks) {
      const int c = static_cast<int>(std::floor((mark.pixel.x() + 0.5) / options_.block)),
                r = static_cast<int>(std::floor((mark.pixel.y() + 0.5) / options_.block));
      if (mark.depth > 0 && c >= 0 && r >= 0 && c < grid.columns && r < grid.rows)
        marks[static_cast<std::size_t>(r * grid.columns + c)].push_back(&mark);
    }
    for (std::size_t b = 0; b < marks.size(); ++b) {
      if (marks[b].empty()) continue;
      for (std::size_t l = 0; l < grid.labels(); ++l) {
        float& cost = grid.cost[b * grid.labels() + l];
        if (cost == kNoCost) continue;
        double sum = 0;
        for (const DepthMark* const mark : marks[b])
          sum += l + 1 == grid.labels() ? kOffPlanes
                                        : mark_cost(*mark, grid.inverse_depth[b * grid.labels() + l]);
        cost += static_cast<float>(options_.mark_weight * sum / static_cast<double>(marks[b].size()));
      }
    }
  }

  [[nodiscard]] double mark_cost(const DepthMark& mark, double inverse_depth) const {
    const double slack = options_.depth_slack + mark.sigma / mark.depth;
    const double off = (mark.depth * inverse_depth - 1) / (2 * slack);
    return std::min(1.0, off * off);
  }

  std::span<const DenseView> views_;
  std::span<const BoundedPlane> planes_;
  double depth_;
  CostOptions options_;
  std::vector<Patch> patches_;
};

}  // namespace sslam::dense
