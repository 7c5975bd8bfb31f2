// SPDX-License-Identifier: BSD-3-Clause
#include "cli/video/video_file.hpp"

#include <string>
#include <utility>
#include <vector>

#include "cli/shell/messages.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

struct Encoder {
  const char* fourcc;
  const char* note;  // for the user; empty: nothing to say
};

// path: as the user gave it.
std::vector<Encoder> encoders_for(const fs::path& path) {
  const std::string extension = io::lower_case(path.extension().string());
  if (extension == ".mp4")
    return {{"avc1", ""},
            {"mp4v", "no H.264 encoder here: the video is MPEG-4 part 2, which few browsers play"}};
  if (extension == ".avi") return {{"MJPG", ""}};
  throw Error(path.string() + ": is no name for a video; expected to end in .mp4 or .avi");
}

}  // namespace

VideoFile::VideoFile(fs::path path, cv::Size size, double frames_per_second)
    : path_(std::move(path)), size_(size) {
  const std::vector<Encoder> encoders = encoders_for(path_);
  const std::string extension = path_.extension().string();  // OpenCV chooses the container by it
  check_place();
  written_ = path_;
  written_ += ".part" + extension;
  for (const Encoder& encoder : encoders)
    if (open(encoder.fourcc, frames_per_second)) {
      if (*encoder.note != '\0') print_note(encoder.note);
      return;
    }
  std::error_code ignored;
  fs::remove(written_, ignored);
  throw Error(path_.string() + ": OpenCV here has no encoder for a video of " + std::to_string(size_.width) +
              "x" + std::to_string(size_.height) + " pixels in " + extension +
              "; try the other of .mp4 and .avi");
}

VideoFile::~VideoFile() {
  writer_.release();
  std::error_code ignored;
  if (!written_.empty()) fs::remove(written_, ignored);
}

void VideoFile::check_place() {
  std::error_code ignored;
  if (fs::is_symlink(path_, ignored)) path_ = fs::weakly_canonical(path_, ignored);
  const auto status = fs::status(path_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
    throw Error(path_.string() + ": is no ordinary file, and a video cannot be streamed");
  const io::OutputFile probe(path_);  // knows what is wrong with a place
}

bool VideoFile::open(const char* fourcc, double frames_per_second) {
  const int code = cv::VideoWriter::fourcc(fourcc[0], fourcc[1], fourcc[2], fourcc[3]);
  try {
    return writer_.open(written_.string(), code, frames_per_second, size_);
  } catch (const cv::Exception&) {
    return false;
  }
}

void VideoFile::write(const cv::Mat& frame) {
  writer_.write(frame);
  ++frames_;
}

// The encoder tells nobody about a full disk: the last frame must come back.
bool VideoFile::is_complete() const {
  cv::VideoCapture video;
  cv::Mat last;
  try {
    return video.open(written_.string()) &&
           static_cast<std::int64_t>(video.get(cv::CAP_PROP_FRAME_COUNT)) == frames_ &&
           video.set(cv::CAP_PROP_POS_FRAMES, static_cast<double>(frames_ - 1)) && video.read(last) &&
           last.size() == size_;
  } catch (const cv::Exception&) {
    return false;
  }
}

void VideoFile::commit() {
  writer_.release();
  std::error_code error;
  if (frames_ == 0) {
    fs::remove(path_, error);  // an older one must not pass for this one
    return;
  }
  if (!is_complete())
    throw Error(path_.string() + ": cannot write: not all frames have reached the file (a full disk?)");
  fs::rename(written_, path_, error);
  if (error) throw Error(path_.string() + ": cannot write: " + error.message());
  written_.clear();
}

}  // namespace sslam::cli
