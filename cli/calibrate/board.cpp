// SPDX-License-Identifier: BSD-3-Clause
#include "cli/calibrate/board.hpp"

#include <algorithm>
#include <array>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "cli/input/image_camera.hpp"
#include "cli/shell/exit_code.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

struct NamedDictionary {
  const char* name;
  cv::aruco::PREDEFINED_DICTIONARY_NAME number;
};

// The small ones first: a large one holds the codes of the smaller ones of its kind.
constexpr std::array<NamedDictionary, 11> kDictionaries{{{"4x4_50", cv::aruco::DICT_4X4_50},
                                                         {"4x4_100", cv::aruco::DICT_4X4_100},
                                                         {"4x4_250", cv::aruco::DICT_4X4_250},
                                                         {"5x5_50", cv::aruco::DICT_5X5_50},
                                                         {"5x5_100", cv::aruco::DICT_5X5_100},
                                                         {"5x5_250", cv::aruco::DICT_5X5_250},
                                                         {"5x5_1000", cv::aruco::DICT_5X5_1000},
                                                         {"6x6_50", cv::aruco::DICT_6X6_50},
                                                         {"6x6_250", cv::aruco::DICT_6X6_250},
                                                         {"6x6_1000", cv::aruco::DICT_6X6_1000},
                                                         {"original", cv::aruco::DICT_ARUCO_ORIGINAL}}};

constexpr int kChessboardFlags = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY;

// The detectors' own corners are off by a tenth of a pixel and more on tilted boards. The window is a share
// of the distance between corners, so that it stays within the squares around one, and off their markers.
void refine(const cv::Mat& grey, double share, std::vector<cv::Point2f>& corners) {
  double nearest = grey.cols;
  for (std::size_t i = 1; i < corners.size(); ++i)
    nearest = std::min(nearest, cv::norm(corners[i] - corners[i - 1]));
  const int half = std::clamp(static_cast<int>(share * nearest), 2, 8);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 0.001});
}

bool has_chessboard(const cv::Mat& grey, int columns, int rows, std::vector<cv::Point2f>& corners) {
  if (!cv::findChessboardCornersSB(grey, {columns, rows}, corners, kChessboardFlags)) return false;
  refine(grey, 0.25, corners);
  return true;
}

// What somebody may have meant by a side of so many metres: " for 25 mm --square 0.025", in the units that
// make a board that one can hold.
std::string in_other_units(double square, double marker) {
  constexpr double kSmallest = 0.004, kLargest = 0.3;  // metres
  std::string text;
  for (const auto& [unit, per_metre] : {std::pair{"mm", 1000.0}, {"cm", 100.0}, {"in", 1 / 0.0254}}) {
    const double metres = square / per_metre;
    if (metres < kSmallest || metres > kLargest || (per_metre < 100 && !text.empty())) continue;
    text += cv::format("%s for %g %s type --square %g", text.empty() ? "" : ",", square, unit, metres);
    if (marker > 0) text += cv::format(" --marker %g", marker / per_metre);
  }
  return text;
}

// The side of a square is in metres, and people measure it in millimetres.
void refuse_huge(const BoardSettings& settings) {
  constexpr double kLargest = 6;  // metres; what hangs on walls of laboratories is smaller
  const int squares =
      std::max(settings.columns, settings.rows) + (settings.pattern == Pattern::kChessboard ? 1 : 0);
  if (squares * settings.square <= kLargest) return;
  const std::string other = in_other_units(settings.square, settings.marker);
  throw UsageError(cv::format("--square %g: is in metres, and makes a board %g m long;", settings.square,
                              squares * settings.square) +
                   (other.empty() ? " expected the side of one square in metres, such as 0.025" : other));
}

}  // namespace

std::string dictionary_names() {
  std::string names;
  for (const NamedDictionary& known : kDictionaries) io::add_to_list(names, known.name);
  return names;
}

Board::Board(const BoardSettings& settings) : settings_(settings) {
  refuse_huge(settings);
  if (settings.pattern == Pattern::kChessboard) return;
  const auto* const dictionary =
      std::find_if(kDictionaries.begin(), kDictionaries.end(),
                   [&](const NamedDictionary& known) { return known.name == settings.dictionary; });
  if (dictionary == kDictionaries.end())
    throw UsageError("--dictionary " + settings.dictionary + ": not known; use one of " + dictionary_names());
  if (settings_.marker == 0) settings_.marker = 0.75 * settings_.square;
  if (!(settings_.marker < settings_.square))
    throw UsageError(
        cv::format("--marker %g: must be smaller than --square %g", settings_.marker, settings_.square));
  const auto codes = cv::aruco::getPredefinedDictionary(dictionary->number);
  const int markers = settings.columns * settings.rows / 2;
  if (markers > codes->bytesList.rows)
    throw UsageError("--size " + size_text(settings.columns, settings.rows) + ": has " +
                     std::to_string(markers) + " markers, and --dictionary " + settings.dictionary + " " +
                     std::to_string(codes->bytesList.rows));
  charuco_ =
      cv::aruco::CharucoBoard::create(settings.columns, settings.rows, static_cast<float>(settings_.square),
                                      static_cast<float>(settings_.marker), codes);
}

std::string Board::text() const {
  return size_text(settings_.columns, settings_.rows) +
         (settings_.pattern == Pattern::kChessboard ? " inner corners" : " squares");
}

BoardView Board::find(const cv::Mat& grey) const {
  return settings_.pattern == Pattern::kChessboard ? find_chessboard(grey) : find_charuco(grey);
}

BoardView Board::find_chessboard(const cv::Mat& grey) const {
  BoardView view;
  if (!has_chessboard(grey, settings_.columns, settings_.rows, view.image)) return {};
  const auto square = static_cast<float>(settings_.square);
  for (int row = 0; row < settings_.rows; ++row)
    for (int column = 0; column < settings_.columns; ++column)
      view.board.emplace_back(static_cast<float>(column) * square, static_cast<float>(row) * square, 0.0F);
  return view;
}

BoardView Board::find_charuco(const cv::Mat& grey) const {
  constexpr std::size_t kLeast = 8;  // four give a pose, and nothing to calibrate with
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey, charuco_->dictionary, markers, ids);
  if (ids.empty()) return {};
  BoardView view;
  std::vector<int> corners;
  cv::aruco::interpolateCornersCharuco(markers, ids, grey, charuco_, view.image, corners);
  if (corners.size() < kLeast) return {};
  refine(grey, 0.1, view.image);
  for (const int corner : corners)
    view.board.push_back(charuco_->chessboardCorners[static_cast<std::size_t>(corner)]);
  return view;
}

std::string Board::what_else(const cv::Mat& grey) const {
  return settings_.pattern == Pattern::kChessboard ? other_chessboard(grey) : other_markers(grey);
}

// Boards are often counted in squares, or named the other way round, or miscounted by one.
std::string Board::other_chessboard(const cv::Mat& grey) const {
  std::vector<cv::Point2f> corners;
  for (const int more : {-1, 1, -2, 2}) {
    for (const auto& [columns, rows] : {std::pair{settings_.columns + more, settings_.rows + more},
                                        std::pair{settings_.columns + more, settings_.rows},
                                        std::pair{settings_.columns, settings_.rows + more}}) {
      if (columns >= 3 && rows >= 3 && has_chessboard(grey, columns, rows, corners))
        return "one of " + size_text(columns, rows) + " is there: --size counts inner corners, not squares";
    }
  }
  return "";
}

std::string Board::other_markers(const cv::Mat& grey) const {
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  for (const NamedDictionary& known : kDictionaries) {
    cv::aruco::detectMarkers(grey, cv::aruco::getPredefinedDictionary(known.number), markers, ids);
    if (ids.size() < 4) continue;
    if (known.name != settings_.dictionary)
      return "markers of --dictionary " + std::string(known.name) + " are there";
    return "markers are there, up to number " + std::to_string(*std::max_element(ids.begin(), ids.end())) +
           ", where a board of " + text() + " has numbers 0 to " + std::to_string(charuco_->ids.size() - 1);
  }
  return "";
}

}  // namespace sslam::cli
