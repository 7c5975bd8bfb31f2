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
    look(v, grid);
    for (std::size_t p = 0; p < planes_.size(); ++p) fill_plane(v, p, grid);
    const auto none = static_cast<float>(options_.none * options_.photo_weight +
                                         (v.normals.normals.empty() ? 0 : 0.5 * options_.normal_weight));
    for (std::size_t b = 0; b < blocks; ++b) grid.cost[(b + 1) * grid.labels() - 1] = none;
    add_marks(v, grid);
  }

 private:
  // What the view shows in a block, whichever plane that is on.
  struct Block {
    Vec2<double> centre;
    Vec3<double> ray;  // z = 1
    double ray_length = 0;
    bool seen = false;  // the view looks at the world there
    bool has_patch = false;
    Patch patch;
    Vec3<double> normal = Vec3<double>::Zero();  // camera frame; zero: none
  };

  void look(const DenseView& view, const CostGrid& grid) {
    const double half = 0.5 * (options_.block - 1);
    blocks_.resize(static_cast<std::size_t>(grid.columns * grid.rows));
    for (int r = 0; r < grid.rows; ++r)
      for (int c = 0; c < grid.columns; ++c) {
        Block& block = blocks_[static_cast<std::size_t>(r * grid.columns + c)];
        block.centre = {c * options_.block + half, r * options_.block + half};
        block.ray = view.pinhole.unproject(block.centre);
        block.ray_length = block.ray.norm();
        block.seen = view.sees(block.centre.cast<float>());
        block.normal = normal_at(view.normals, block.ray);
        const detail::PatchPlaces places{block.centre.cast<float>(), {1, 0}, {0, 1}};
        block.has_patch = places.in(view.grey);
        if (!block.has_patch) continue;
        detail::sample(view.grey, places, block.patch.value);
        detail::centre_patch(block.patch);
      }
  }

  [[nodiscard]] static Vec3<double> normal_at(const NormalImage& image, const Vec3<double>& ray) {
    if (image.normals.empty()) return Vec3<double>::Zero();
    const Vec2<double> at = image.pinhole.project(ray);
    const int x = static_cast<int>(std::lround(at.x())), y = static_cast<int>(std::lround(at.y()));
    if (x < 0 || y < 0 || x >= image.columns || y >= image.rows) return Vec3<double>::Zero();
    return image.normals[static_cast<std::size_t>(y * image.columns + x)].cast<double>();
  }

  void fill_plane(const DenseView& view, std::size_t p, CostGrid& grid) {
    const BoundedPlane& bounded = planes_[p];
    const Plane3<double> in_cam = transform(view.cam_from_world, bounded.plane);
    const Vec3<double> form = inverse_depth_form(view.pinhole, in_cam);
    if (form.isZero()) return;
    // Coordinates in the plane: turned * ray / inverse depth + shift.
    const SE3<double> world_from_cam = view.cam_from_world.inverse();
    const Mat<double, 2, 3> turned = bounded.basis.transpose() * world_from_cam.rotation.matrix();
    const Vec2<double> shift = bounded.basis.transpose() * world_from_cam.translation;
    std::vector<Mat3<double>> homographies;
    for (const std::size_t other : view.near)
      homographies.push_back(plane_homography(view, views_[other], in_cam));
    const bool has_normals = !view.normals.normals.empty();
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Block& block = blocks_[b];
      const double inverse = form.dot(Vec3<double>(block.centre.x(), block.centre.y(), 1));
      if (!block.seen || !(inverse > 1e-9)) continue;
      // normal . ray = distance / depth
      if (std::abs(in_cam.distance) * inverse < options_.grazing * block.ray_length) continue;
      const Vec2<double> u = turned * block.ray / inverse + shift;
      const double beyond = bounded.beyond(u) / depth_;
      if (beyond > options_.reach) continue;
      const std::size_t label = b * grid.labels() + p;
      grid.inverse_depth[label] = static_cast<float>(inverse);
      grid.cost[label] = photo_cost(view, homographies, block) +
                         (has_normals ? normal_cost(in_cam, block) : 0) +
                         static_cast<float>(options_.beyond_weight * std::min(1.0, beyond / options_.beyond));
    }
  }

  // The mean of the better half of the other views: the others may see something in front of it.
  [[nodiscard]] float photo_cost(const DenseView& view, const std::vector<Mat3<double>>& homographies,
                                 const Block& block) const {
    std::array<float, 8> costs{};
    std::size_t count = 0;
    for (std::size_t k = 0; block.has_patch && k < homographies.size() && count < costs.size(); ++k)
      if (patch_cost(block.patch, views_[view.near[k]], homographies[k], block.centre, options_.noise,
                     costs[count]))
        ++count;
    if (count == 0) return static_cast<float>(0.8 * options_.none * options_.photo_weight);
    std::sort(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(count));
    const std::size_t half = (count + 1) / 2;
    float sum = 0;
    for (std::size_t k = 0; k < half; ++k) sum += costs[k];
    return static_cast<float>(options_.photo_weight) * sum / static_cast<float>(half);
  }

  [[nodiscard]] float normal_cost(const Plane3<double>& in_cam, const Block& block) const {
    if (block.normal.isZero()) return static_cast<float>(0.5 * options_.normal_weight);
    const double cosine = std::abs(block.normal.dot(in_cam.normal));
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
  std::vector<Block> blocks_;
};

}  // namespace sslam::dense
