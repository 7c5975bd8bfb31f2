// SPDX-License-Identifier: BSD-3-Clause
#include "cli/calibrate/board_views.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "cli/input/frame_reader.hpp"
#include "cli/input/image_camera.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/interrupt.hpp"

namespace sslam::cli {
namespace {

constexpr std::size_t kMostVideoFrames = 300;  // a video shows the same over and over
constexpr std::size_t kHintImages = 5;         // in which another board is looked for

// The board seen from the same place adds time, and weight to one view.
bool alike(const BoardView& a, const BoardView& b, int width) {
  constexpr double kLeastMove = 0.01;  // of the width, mean over the corners
  if (a.board != b.board) return false;
  double moved = 0;
  for (std::size_t i = 0; i < a.image.size(); ++i) moved += cv::norm(a.image[i] - b.image[i]);
  return moved < kLeastMove * width * static_cast<double>(a.image.size());
}

void check_size(const cv::Mat& image, const std::string& name, const std::string& first, cv::Size& size) {
  if (size.empty()) size = image.size();
  if (image.size() == size) return;
  throw Error(name + ": has " + size_text(image.cols, image.rows) + " pixels, and " + first + " " +
              size_text(size.width, size.height) +
              "; a camera is calibrated from images of one size and orientation");
}

std::string where_else(const std::vector<cv::Mat>& images, const Board& board) {
  for (const cv::Mat& grey : images)
    if (const std::string found = board.what_else(grey); !found.empty()) return "; " + found;
  return "; check --pattern and --size, that the whole board is in the image, sharp and with a white margin";
}

}  // namespace

BoardViews find_views(const io::Dataset& dataset, const Board& board, Verbosity verbosity) {
  BoardViews found;
  FrameReader reader(dataset);
  const bool video = dataset.layout == io::Layout::kVideo || dataset.bag;
  const std::size_t stride = video ? dataset.frames.size() / kMostVideoFrames + 1 : 1;
  Progress progress((dataset.frames.size() + stride - 1) / stride, verbosity, "calibrate");
  const Interrupt interrupt;
  std::vector<cv::Mat> boardless;
  std::string first;
  for (std::size_t i = 0; i < dataset.frames.size(); i += stride) {
    if (Interrupt::asked()) throw Stop{ExitCode::kInterrupted};
    const std::string name = reader.label(dataset.frames[i]);
    std::string why;
    const cv::Mat image = reader.read(dataset.frames[i], why);
    progress.show(name);
    if (image.empty()) {
      found.unreadable.push_back(why);
      continue;
    }
    if (first.empty()) first = name;
    check_size(image, name, first, found.size);
    ++found.searched;
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    BoardView view = board.find(grey);
    view.name = name;
    const bool seen_before =
        std::any_of(found.views.begin(), found.views.end(),
                    [&](const BoardView& earlier) { return alike(earlier, view, image.cols); });
    if (view.image.empty()) {
      ++found.without;
      if (boardless.size() < kHintImages) boardless.push_back(grey);
    } else if (seen_before) {
      ++found.alike;
    } else {
      found.views.push_back(std::move(view));
    }
  }
  progress.finish();
  if (found.searched == 0 && !found.unreadable.empty()) throw Error(found.unreadable.front());
  if (found.views.empty())
    throw Error(dataset.root.string() + ": no board of " + board.text() + " in any of " +
                std::to_string(found.searched) + " images" + where_else(boardless, board));
  return found;
}

}  // namespace sslam::cli
