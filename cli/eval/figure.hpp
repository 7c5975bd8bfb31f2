// SPDX-License-Identifier: BSD-3-Clause
// A drawing of lines and words, and its files: SVG, PDF and PNG.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam::cli {

using FigureColour = std::array<std::uint8_t, 3>;  // red, green, blue

enum class FigureAnchor { kStart, kMiddle, kEnd };

// Places are in the figure's units from its upper left corner, y down.
struct FigureLine {
  std::vector<Vec2<double>> points;  // two or more
  FigureColour colour{};
  double width = 1;
};

struct FigureText {
  Vec2<double> at{0, 0};  // of its base line
  std::string text;       // UTF-8
  double size = 12;
  FigureAnchor anchor = FigureAnchor::kStart;
  FigureColour colour{};
};

// White where nothing is drawn.
struct Figure {
  double width = 0, height = 0;
  std::vector<FigureLine> lines;
  std::vector<FigureText> texts;
};

// Whether a file of this name can be written.
[[nodiscard]] bool is_figure_name(const std::filesystem::path& path);

// By its name: .svg, .pdf (a page of as many points), .png (two pixels a unit). PDF and PNG show what is not
// ASCII as '?'. Throws Error when it cannot be written.
void write_figure(const std::filesystem::path& path, const Figure& figure);

}  // namespace sslam::cli
