// SPDX-License-Identifier: BSD-3-Clause
// A drawing of trajectories from above: the two world axes along which they extend most, to one scale, as
// SVG.
#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "sslam/core/types.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/plots/plot_view.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

// Everything in one world frame. Empty parts are left out.
struct TopView {
  std::string title;
  std::string unit = "m";
  Trajectory truth;
  Trajectory estimate;
  std::vector<Vec3<double>> points;  // of the map, drawn faintly
  double max_gap = 0;  // the estimate is not joined over a longer pause in stamps; 0: always joined
};

namespace svg {

inline void draw_path(std::ostream& out, const View& view, const Trajectory& poses, const char* style,
                      double max_gap) {
  if (poses.empty()) return;
  out << "<path fill=\"none\" " << style << " d=\"";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec2<double> p = view(poses[i].world_from_cam.translation);
    const bool joined = i > 0 && (max_gap <= 0 || poses[i].stamp - poses[i - 1].stamp <= max_gap);
    out << format("%c%.1f %.1f", joined ? 'L' : 'M', p.x(), p.y());
  }
  out << "\"/>\n";
  const Vec2<double> start = view(poses.front().world_from_cam.translation);
  out << format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"#fff\" ", start.x(), start.y()) << style
      << "/>\n";
}

inline void draw_points(std::ostream& out, const View& view, const std::vector<Vec3<double>>& points) {
  if (points.empty()) return;
  out << "<path stroke=\"#c9a227\" stroke-opacity=\"0.5\" stroke-width=\"2\" stroke-linecap=\"round\" d=\"";
  for (const Vec3<double>& point : points) {
    const Vec2<double> p = view(point);
    const bool inside = p.x() >= 0 && p.x() <= kWidth && p.y() >= 0 && p.y() <= kHeight;
    if (inside) out << format("M%.1f %.1fh0", p.x(), p.y());
  }
  out << "\"/>\n";
}

// One sample of the line and its name, from x on.
inline void draw_legend(std::ostream& out, double x, const char* style, const char* text) {
  out << format("<path d=\"M%.0f 44h26\" ", x) << style << "/>"
      << format("<text x=\"%.0f\" y=\"48\" font-size=\"13\">%s</text>\n", x + 32, text);
}

// The head of the page: its grid and title, and a group that is cut to the grid, which the caller closes.
inline void begin_page(std::ostream& out, const View& view, std::string_view unit, std::string_view title) {
  out << format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
             "font-family=\"sans-serif\">\n",
             kWidth, kHeight)
      << format(
             "<clipPath id=\"page\"><rect x=\"%.0f\" y=\"%.0f\" width=\"%.0f\" "
             "height=\"%.0f\"/></clipPath>\n",
             kLeft, kTop, kWidth - kLeft - kRight, kHeight - kTop - kBottom)
      << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  draw_grid(out, view, unit);
  out << format("<text x=\"%.0f\" y=\"26\" font-size=\"16\">", kLeft) << escaped(title) << "</text>\n";
  out << "<g clip-path=\"url(#page)\">\n";
}

}  // namespace svg

// Throws Error when it cannot be written.
inline void write_top_view(const std::filesystem::path& path, const TopView& content) {
  constexpr const char* kTruthStyle = "stroke=\"#888\" stroke-width=\"2.5\"";
  constexpr const char* kEstimateStyle = "stroke=\"#1f6fb4\" stroke-width=\"1.8\"";
  const std::vector<Vec3<double>> truth = positions_of(content.truth);
  const std::vector<Vec3<double>> estimate = positions_of(content.estimate);
  const svg::View view = truth.empty() ? svg::fit(estimate, truth) : svg::fit(truth, estimate);
  OutputFile file(path);
  std::ostream& out = file.stream();
  svg::begin_page(out, view, content.unit, content.title);
  svg::draw_points(out, view, content.points);
  svg::draw_path(out, view, content.truth, kTruthStyle, 0);
  svg::draw_path(out, view, content.estimate, kEstimateStyle, content.max_gap);
  out << "</g>\n";
  if (!truth.empty()) svg::draw_legend(out, svg::kLeft, kTruthStyle, "ground truth");
  if (!estimate.empty()) svg::draw_legend(out, svg::kLeft + 140, kEstimateStyle, "estimate");
  out << "</svg>\n";
  file.commit();
}

}  // namespace sslam::io
