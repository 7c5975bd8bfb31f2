// SPDX-License-Identifier: BSD-3-Clause
#include "cli/eval/eval_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cli/eval/plot_panel.hpp"
#include "sslam/io/plots/comparison_view.hpp"
#include "sslam/io/plots/plot_view.hpp"

namespace sslam::cli {
namespace {

using io::svg::Range;

constexpr FigureColour kTruth{150, 150, 150};
constexpr std::array<FigureColour, 8> kInks{{{53, 87, 214},
                                             {214, 69, 65},
                                             {18, 140, 140},
                                             {192, 120, 0},
                                             {138, 63, 252},
                                             {31, 157, 87},
                                             {194, 56, 143},
                                             {107, 91, 75}}};
// Roll, pitch and yaw about x, y and z: R = Rz Ry Rx; degrees.
Vec3<double> angles_of(const SO3<double>& rotation) {
  const Mat3<double> r = rotation.matrix();
  return Vec3<double>(std::atan2(r(2, 1), r(2, 2)), -std::asin(std::clamp(r(2, 0), -1.0, 1.0)),
                      std::atan2(r(1, 0), r(0, 0))) *
         (180 / std::numbers::pi);
}

// The whole name, or so many bytes of its end, where paths differ; characters of UTF-8 stay whole.
std::string ending_of(const std::string& name, std::size_t most) {
  static const std::string kCut = "...";
  if (name.size() <= std::max(most, kCut.size())) return name;
  std::size_t from = name.size() - (std::max(most, kCut.size()) - kCut.size());
  while (from < name.size() && (static_cast<unsigned char>(name[from]) & 0xC0U) == 0x80U) ++from;
  return kCut + name.substr(from);
}

class EvalPage {
 public:
  EvalPage(const io::Trajectory& truth, const std::vector<PlottedEstimate>& estimates, double per_stamp)
      : estimates_(estimates), per_stamp_(per_stamp) {
    figure_.width = 1400;
    figure_.height = 900;
    double from = std::numeric_limits<double>::infinity(), to = -from;
    for (const PlottedEstimate& estimate : estimates)
      for (const io::StampedPose& pose : estimate.poses) {
        from = std::min(from, pose.stamp);
        to = std::max(to, pose.stamp);
      }
    first_ = from;
    for (const io::StampedPose& pose : truth)
      if (pose.stamp >= from && pose.stamp <= to) truth_.push_back(pose);
    time_ = {0, std::max((to - from) * per_stamp, 1e-9)};
  }

  [[nodiscard]] Figure draw() {
    draw_legend();
    draw_paths();
    draw_errors();
    for (int k = 0; k < 3; ++k) draw_component(k);
    return std::move(figure_);
  }

 private:
  static constexpr double kLeft = 70, kRight = 770, kWidth = 580, kTop = 74;

  [[nodiscard]] static FigureColour ink(std::size_t estimate) { return kInks[estimate % kInks.size()]; }

  [[nodiscard]] double seconds(double stamp) const { return (stamp - first_) * per_stamp_; }

  // A curve of one number of each pose, for the truth and each estimate.
  template <class Number>
  [[nodiscard]] std::vector<PlotCurve> curves_of(Number number, double max_step) const {
    std::vector<PlotCurve> curves;
    const auto add = [&](const io::Trajectory& poses, const FigureColour& colour, double width) {
      PlotCurve curve{{}, {}, colour, width, io::ordinary_gap(poses) * per_stamp_, max_step};
      for (const io::StampedPose& pose : poses) {
        curve.x.push_back(seconds(pose.stamp));
        curve.y.push_back(number(pose.world_from_cam));
      }
      curves.push_back(std::move(curve));
    };
    add(truth_, kTruth, 2.2);
    for (std::size_t i = 0; i < estimates_.size(); ++i) add(estimates_[i].poses, ink(i), 1.2);
    return curves;
  }

  static Range range_of(const std::vector<PlotCurve>& curves, Range range = kNoRange) {
    for (const PlotCurve& curve : curves) extend(range, curve.y);
    return range;
  }

  // On one row: each name has its share of the page.
  void draw_legend() {
    constexpr double kLetter = 7.5, kSample = 60;
    const double share = (kRight + kWidth - kLeft) / static_cast<double>(estimates_.size() + 1);
    const auto most = static_cast<std::size_t>(std::max(1.0, (share - kSample) / kLetter));
    double x = kLeft;
    const auto add = [&](const std::string& name, const FigureColour& colour) {
      figure_.lines.push_back({{{x, 26}, {x + 26, 26}}, colour, 2.5});
      const std::string shown = ending_of(name, most);
      figure_.texts.push_back({{x + 32, 30}, shown, 13, FigureAnchor::kStart, kFigureInk});
      x += kSample + kLetter * static_cast<double>(shown.size());
    };
    add("ground truth", kTruth);
    for (std::size_t i = 0; i < estimates_.size(); ++i) add(estimates_[i].name, ink(i));
  }

  // Along the two axes of the world along which the truth extends most, to one scale.
  void draw_paths() {
    constexpr double kHeight = 420;
    const io::svg::View view = io::svg::fit(io::positions_of(truth_), {});
    std::vector<PlotCurve> curves;
    const auto add = [&](const io::Trajectory& poses, const FigureColour& colour, double width) {
      const double gap = io::ordinary_gap(poses);
      PlotCurve curve{{}, {}, colour, width};
      for (std::size_t i = 0; i < poses.size(); ++i) {
        if (i > 0 && gap > 0 && poses[i].stamp - poses[i - 1].stamp > gap) {
          curves.push_back(curve);
          curve.x.clear();
          curve.y.clear();
        }
        curve.x.push_back(poses[i].world_from_cam.translation[view.across]);
        curve.y.push_back(poses[i].world_from_cam.translation[view.up]);
      }
      curves.push_back(std::move(curve));
    };
    add(truth_, kTruth, 2.2);
    for (std::size_t i = 0; i < estimates_.size(); ++i) add(estimates_[i].poses, ink(i), 1.2);
    Range x = kNoRange, y = kNoRange;
    for (const PlotCurve& curve : curves) {
      extend(x, curve.x);
      extend(y, curve.y);
    }
    x = widened(x, 0.05);
    y = widened(y, 0.05);
    const double scale = std::max(x.size() / kWidth, y.size() / kHeight);
    x = widened(x, (scale * kWidth / x.size() - 1) / 2);
    y = widened(y, (scale * kHeight / y.size() - 1) / 2);
    constexpr char kNames[] = "xyz";
    draw_panel(figure_, {kLeft, kTop, kWidth, kHeight},
               std::string("path, ") + kNames[view.up] + " over " + kNames[view.across] + ", m", curves, x,
               y);
  }

  void draw_errors() {
    std::vector<PlotCurve> position, rotation;
    for (std::size_t i = 0; i < estimates_.size(); ++i) {
      const PlottedEstimate& one = estimates_[i];
      PlotCurve curve{{}, one.position_errors, ink(i), 1.2, io::ordinary_gap(one.poses) * per_stamp_};
      for (const double stamp : one.error_stamps) curve.x.push_back(seconds(stamp));
      position.push_back(curve);
      for (std::size_t k = 0; k < curve.y.size(); ++k) curve.y[k] = degrees(one.rotation_errors[k]);
      rotation.push_back(std::move(curve));
    }
    const auto draw = [&](double top, const char* title, const std::vector<PlotCurve>& curves) {
      Range range = widened(range_of(curves, {0, 0}), 0.05);
      range.low = 0;
      draw_panel(figure_, {kLeft, top, kWidth, 120}, title, curves, time_, range);
    };
    draw(kTop + 480, "position error, m, over seconds", position);
    draw(kTop + 660, "rotation error after a constant offset, degrees, over seconds", rotation);
  }

  // One coordinate and one angle.
  void draw_component(int k) {
    constexpr double kHeight = 88, kStep = 136;
    constexpr char kNames[] = "xyz";
    const char* const kAngles[] = {"roll", "pitch", "yaw"};
    const auto draw = [&](int row, const std::string& title, const std::vector<PlotCurve>& curves) {
      draw_panel(figure_, {kRight, kTop + row * kStep, kWidth, kHeight}, title, curves, time_,
                 widened(range_of(curves), 0.08));
    };
    draw(k, std::string(1, kNames[k]) + ", m",
         curves_of([k](const SE3<double>& pose) { return pose.translation[k]; }, 0));
    draw(k + 3, std::string(kAngles[k]) + ", degrees",
         curves_of([k](const SE3<double>& pose) { return angles_of(pose.rotation)[k]; }, 180));
  }

  Figure figure_;
  const std::vector<PlottedEstimate>& estimates_;
  io::Trajectory truth_;  // while the estimates last
  double per_stamp_, first_ = 0;
  Range time_;
};

}  // namespace

Figure eval_figure(const io::Trajectory& truth, const std::vector<PlottedEstimate>& estimates,
                   double seconds_per_stamp) {
  return EvalPage(truth, estimates, seconds_per_stamp).draw();
}

}  // namespace sslam::cli
