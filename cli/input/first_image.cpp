// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/first_image.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <vector>

#include "cli/input/frame_reader.hpp"
#include "cli/input/image_file.hpp"
#include "cli/input/size_text.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {
namespace {

struct FirstImage {
  std::string name;
  cv::Size stored;  // empty: no image can be read
  ImageTurn turn = kUpright;
  bool several = false;  // its file holds more than this one
  std::string why;       // of the first that cannot be read
};

FirstImage find_first_image(const io::Dataset& dataset, cv::Size camera) {
  constexpr std::size_t kTries = 10;
  FirstImage first;
  if (dataset.layout == io::Layout::kVideo) {
    const VideoInfo info = VideoReader(dataset.root).info();
    return {dataset.root.string(), info.size, info.turn, false, {}};
  }
  FrameReader reader(dataset);
  for (std::size_t i = 0; i < std::min(kTries, dataset.frames.size()); ++i) {
    first.name = dataset.frames[i].image;
    std::vector<std::uint8_t> bytes;
    ImageHeader header;
    std::string why;
    if (dataset.bag) {
      first.stored = reader.read(dataset.frames[i], why).size();
      if (!first.stored.empty()) return first;
    } else if (open_image(first.name, bytes, header, why, camera)) {
      if (header.size.empty())
        header.size = decode_image(first.name, bytes, header, cv::IMREAD_COLOR, why).size();
      first.stored = header.size;
      first.turn = header.turn;
      first.several = header.several;
      if (!first.stored.empty()) return first;
    }
    if (first.why.empty()) first.why = why;
  }
  return first;
}

// How far the principal point is from the middle of such an image, as a share of it.
double off_centre(const Pinhole<double>& pinhole, cv::Size size) {
  return std::max(std::abs(pinhole.cx / size.width - 0.5), std::abs(pinhole.cy / size.height - 0.5));
}

// A calibration without a size is of the stored or of the turned pixels: its principal point is near the
// middle.
cv::Size size_by_centre(const Pinhole<double>& pinhole, const FirstImage& first) {
  const cv::Size upright = turned_size(first.stored, first.turn);
  return off_centre(pinhole, upright) < off_centre(pinhole, first.stored) ? upright : first.stored;
}

void tell_turn(const FirstImage& first, ImageTurn used) {
  if (first.turn == kUpright) return;
  if (used == first.turn)
    print_note(first.name + ": images are " + turn_text(used) + ", as the file's orientation tag asks");
  else
    print_note(first.name + ": the orientation tag (" + turn_text(first.turn) +
               ") is ignored: the calibration is for the pixels as they are stored");
}

void tell_range(const io::Dataset& dataset, cv::Size camera) {
  if (dataset.layout == io::Layout::kVideo) return;
  FrameReader reader(dataset, camera);
  std::string ignored;
  (void)reader.read(dataset.frames.front(), ignored);
  if (reader.range())
    print_note(dataset.frames.front().image + ": 16 bit images: values from " + reader.range()->text() +
               ", found in the first frames, are scaled to 8 bit");
}

}  // namespace

CameraChoice camera_for_images(const CameraWish& wish, const io::Dataset& dataset) {
  const bool wished = wish.focal > 0 || wish.fov > 0;
  const std::optional<CameraChoice> known = wished ? std::nullopt : find_camera(wish.file, dataset);
  const bool placed = known && known->view_across == 0 && known->all.empty();  // tells how images are held
  const cv::Size claimed = placed ? cv::Size(known->camera.width, known->camera.height) : cv::Size();
  const FirstImage first = find_first_image(dataset, claimed);
  if (first.stored.empty()) {
    if (dataset.bag) throw Error(first.why);  // its other messages are alike
    if (claimed.empty()) throw Error(first.why + "; the camera's size is not known without it");
    CameraChoice choice = *known;  // each frame tells
    take_view(choice, wish.undistort_fov);
    return choice;
  }
  const cv::Size size = !claimed.empty() ? claimed
                        : placed         ? size_by_centre(known->camera.pinhole, first)
                                         : turned_size(first.stored, first.turn);
  const bool video = dataset.layout == io::Layout::kVideo;
  const ImageTurn used = placed ? turn_for_camera(first.stored, first.turn, size, video) : first.turn;
  const cv::Size images = turned_size(first.stored, used);
  CameraChoice choice = choose_camera(wish, dataset, images.width, images.height);
  if (first.several)
    print_note(first.name + ": holds several images; only one of them is used; " + kTakeApart);
  tell_turn(first, used);
  tell_range(dataset, images);
  return choice;
}

}  // namespace sslam::cli
