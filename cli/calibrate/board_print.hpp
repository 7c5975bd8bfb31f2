// SPDX-License-Identifier: BSD-3-Clause
// A calibration board as a file for the printer, PDF or SVG: squares in their true size, and what they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <opencv2/aruco.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "cli/calibrate/board.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/pdf_page.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {

// Black rectangles, in millimetres from the board's upper left corner.
struct PrintedBoard {
  double width = 0, height = 0;  // millimetres
  std::vector<cv::Rect2d> black;
  std::string text;  // ASCII
};

namespace print_detail {

inline constexpr double kMillimetres = 1000;  // a metre

[[nodiscard]] inline PrintedBoard squares(int columns, int rows, double side) {
  PrintedBoard print;
  print.width = columns * side;
  print.height = rows * side;
  return print;
}

// A marker of a ChArUco board: its border and its dark bits, row by row.
inline void add_marker(const cv::Mat& bits, const std::array<cv::Point2d, 2>& diagonal, PrintedBoard& print) {
  const int modules = bits.rows + 2;
  const double side = (diagonal[1].x - diagonal[0].x) / modules;
  for (int row = 0; row < modules; ++row)
    for (int column = 0, end = 0; column < modules; column = end + 1) {
      const auto dark = [&](int c) {
        const bool border = row == 0 || c == 0 || row == modules - 1 || c == modules - 1;
        return border || bits.at<std::uint8_t>(row - 1, c - 1) == 0;
      };
      for (end = column; end < modules && dark(end);) ++end;
      if (end > column)
        print.black.emplace_back(diagonal[0].x + column * side, diagonal[0].y + row * side,
                                 (end - column) * side, side);
    }
}

// The smallest of A4 and A3 that holds the board, lying or standing; else a sheet of its own.
struct Sheet {
  double width, height;
  const char* name;
};

[[nodiscard]] inline Sheet sheet_for(const PrintedBoard& print) {
  constexpr double kMargin = 10, kText = 10;  // around, and below; a white margin helps to find the board
  const double width = print.width + 2 * kMargin, height = print.height + 2 * kMargin + kText;
  for (const Sheet& sheet :
       {Sheet{297, 210, "A4"}, Sheet{210, 297, "A4"}, Sheet{420, 297, "A3"}, Sheet{297, 420, "A3"}})
    if (width <= sheet.width && height <= sheet.height) return sheet;
  return {width, height, "a sheet of its own size"};
}

[[nodiscard]] inline std::string pdf_of(const PrintedBoard& print, const Sheet& sheet) {
  constexpr double kPoint = 72 / 25.4;  // a millimetre
  const double left = (sheet.width - print.width) / 2, top = (sheet.height - print.height) / 2;
  std::string drawing = cv::format("0 g %.6f 0 0 %.6f 0 0 cm\n", kPoint, kPoint);  // from now on millimetres
  for (const cv::Rect2d& r : print.black)
    drawing += cv::format("%.4f %.4f %.4f %.4f re\n", left + r.x, sheet.height - top - r.y - r.height,
                          r.width, r.height);
  drawing += cv::format("f\nBT /F 3.5 Tf %.2f 7 Td (%s) Tj ET\n", left, print.text.c_str());
  return pdf_page(sheet.width * kPoint, sheet.height * kPoint, drawing,
                  "/ViewerPreferences << /PrintScaling /None >> ");
}

[[nodiscard]] inline std::string svg_of(const PrintedBoard& print, const Sheet& sheet) {
  const double left = (sheet.width - print.width) / 2, top = (sheet.height - print.height) / 2;
  std::string svg = cv::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.4fmm\" height=\"%.4fmm\" viewBox=\"0 0 %.4f "
      "%.4f\">\n",
      sheet.width, sheet.height, sheet.width, sheet.height);
  for (const cv::Rect2d& r : print.black)
    svg += cv::format("<rect x=\"%.4f\" y=\"%.4f\" width=\"%.4f\" height=\"%.4f\"/>\n", left + r.x, top + r.y,
                      r.width, r.height);
  return svg +
         cv::format("<text x=\"%.2f\" y=\"%.2f\" font-size=\"3.5\" font-family=\"Helvetica,sans-serif\">",
                    left, sheet.height - 7) +
         print.text + "</text>\n</svg>\n";
}

}  // namespace print_detail

// The upper left square is black in both patterns.
[[nodiscard]] inline PrintedBoard printed_board(const BoardSettings& settings,
                                                const cv::Ptr<cv::aruco::CharucoBoard>& charuco) {
  namespace detail = print_detail;
  const double side = settings.square * detail::kMillimetres;
  const bool markers = settings.pattern == Pattern::kCharuco;
  const int columns = settings.columns + (markers ? 0 : 1), rows = settings.rows + (markers ? 0 : 1);
  PrintedBoard print = detail::squares(columns, rows, side);
  std::vector<bool> white(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), false);
  const auto at = [columns](int column, int row) { return static_cast<std::size_t>(row * columns + column); };
  if (markers) {
    for (std::size_t i = 0; i < charuco->ids.size(); ++i) {
      const auto& corners = charuco->objPoints[i];  // from the marker's upper left one, clockwise
      const cv::Point2d a(corners[0].x * detail::kMillimetres, corners[0].y * detail::kMillimetres);
      const cv::Point2d b(corners[2].x * detail::kMillimetres, corners[2].y * detail::kMillimetres);
      const cv::Ptr<cv::aruco::Dictionary>& dictionary = charuco->dictionary;
      detail::add_marker(
          cv::aruco::Dictionary::getBitsFromByteList(
              dictionary->bytesList.rowRange(charuco->ids[i], charuco->ids[i] + 1), dictionary->markerSize),
          {a, b}, print);
      white[at(static_cast<int>((a.x + b.x) / 2 / side), static_cast<int>((a.y + b.y) / 2 / side))] = true;
    }
  } else {
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) white[at(column, row)] = (row + column) % 2 != 0;
  }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      if (!white[at(column, row)]) print.black.emplace_back(column * side, row * side, side, side);
  print.text =
      cv::format("sslam calibrate %s--size %dx%d --square %g   print at 100 %%, then measure a square: %g mm",
                 markers ? "--pattern charuco " : "", settings.columns, settings.rows, settings.square, side);
  if (markers)
    print.text +=
        cv::format("   %s, markers %g mm", settings.dictionary.c_str(),
                   (settings.marker > 0 ? settings.marker : 0.75 * settings.square) * detail::kMillimetres);
  return print;
}

// Writes the file, and says on which sheet it is. Throws UsageError for another kind of file, Error when it
// cannot be written.
inline std::string write_board(const std::filesystem::path& file, const PrintedBoard& print) {
  const print_detail::Sheet sheet = print_detail::sheet_for(print);
  const std::string kind = file.extension().string();
  if (kind != ".pdf" && kind != ".svg")
    throw UsageError("--print " + file.string() + ": writes a .pdf or an .svg");
  io::write_text(file,
                 kind == ".pdf" ? print_detail::pdf_of(print, sheet) : print_detail::svg_of(print, sheet));
  return sheet.name;
}

}  // namespace sslam::cli
