// SPDX-License-Identifier: BSD-3-Clause
// Normals stored as images, one for each frame: three 8 or 16 bit channels that stand for [-1, 1].
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <string_view>

#include "sslam/core/parameter.hpp"
#include "sslam/image/normal_grid.hpp"
#include "sslam/opencv/normals/normal_source.hpp"

namespace sslam {

struct FileNormalsOptions {
  std::filesystem::path folder;
  std::string extension = ".png";          // of FOLDER/NAME.EXTENSION, NAME as in ImageInput
  std::array<int, 3> channel{0, 1, 2};     // of the camera's x, y and z axis, in the order blue, green, red
  std::array<double, 3> sign{-1, -1, -1};  // of x, y and z against the stored value
  double plane_sigma = radians(5.0);       // what the normals of one plane get wrong together (NormalField)
  int step = 4;                            // between two normals that are used, pixels of the file
  double max_norm_error = 0.15;            // of a stored vector from unit length: beyond, it is no normal
  PlanarMaskOptions mask;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("plane_sigma", self.plane_sigma, Unit::kDegrees, 0, 89,
          "what the normals of one plane get wrong together");
    visit("step", self.step, Unit::kPixels, 1, 10000, "between two normals that are used, of the file");
    visit("max_norm_error", self.max_norm_error, Unit::kNumber, 0, 10,
          "of a stored vector from unit length: beyond, it is no normal");
    visit_within("mask.", self.mask, visit);
  }
};
static_assert(Described<FileNormalsOptions>);

// Which channel holds which axis: three cells such as "r=+x g=+y b=+z" in any order, and after them, where
// the normals are not exact, "plane_sigma_deg=4.7". False, with the options as they were, when the text is
// none.
[[nodiscard]] inline bool parse_normal_encoding(const std::string& text, FileNormalsOptions& options) {
  constexpr std::string_view kChannels = "bgr", kAxes = "xyz";
  FileNormalsOptions parsed = options;
  std::array<bool, 3> channel_seen{}, axis_seen{};
  parsed.plane_sigma = 0;
  std::istringstream cells(text);
  std::string cell;
  int count = 0;
  for (; count < 3 && cells >> cell; ++count) {
    if (cell.size() != 4 || cell[1] != '=' || (cell[2] != '+' && cell[2] != '-')) return false;
    const auto channel = kChannels.find(cell[0]), axis = kAxes.find(cell[3]);
    if (channel == kChannels.npos || axis == kAxes.npos || channel_seen[channel] || axis_seen[axis])
      return false;
    channel_seen[channel] = axis_seen[axis] = true;
    parsed.channel[axis] = static_cast<int>(channel);
    parsed.sign[axis] = cell[2] == '+' ? 1 : -1;
  }
  if (count != 3) return false;
  constexpr std::string_view kSigma = "plane_sigma_deg=";
  if (cells >> cell) {
    std::string more;
    if (!cell.starts_with(kSigma) || cells >> more) return false;
    std::istringstream number(cell.substr(kSigma.size()));
    double degrees = 0;
    if (!(number >> degrees) || !number.eof() || !(degrees >= 0 && degrees < 90)) return false;
    parsed.plane_sigma = radians(degrees);
  }
  options = parsed;
  return true;
}

class FileNormals {
 public:
  FileNormalsOptions options;

  // Of the last frame, before those off planes were left out.
  [[nodiscard]] const NormalGrid& grid() const noexcept { return grid_; }

  [[nodiscard]] NormalStatus fill(const ImageInput& input, const Camera<double>& camera, NormalField& field) {
    field.clear();
    const auto path = options.folder / (input.name + options.extension);
    std::error_code error;
    if (input.name.empty() || !std::filesystem::is_regular_file(path, error)) return NormalStatus::kNoInput;
    const cv::Mat stored = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
    if (stored.empty()) return NormalStatus::kUnreadable;
    return decode(stored, camera, field);
  }

  // `stored` may have any size of the camera image's shape. Normals that turn away from the camera are
  // dropped.
  [[nodiscard]] NormalStatus decode(const cv::Mat& stored, const Camera<double>& camera, NormalField& field) {
    field.clear();
    if (stored.channels() < 3 || (stored.depth() != CV_8U && stored.depth() != CV_16U))
      return NormalStatus::kWrongType;
    const double sx = static_cast<double>(camera.width) / stored.cols,
                 sy = static_cast<double>(camera.height) / stored.rows;
    if (std::abs(sx / sy - 1) > 0.02) return NormalStatus::kWrongSize;
    const int step = std::max(options.step, 1), first = step / 2;
    int facing = 0, away = 0;
    grid_.reset((stored.cols - first + step - 1) / step, (stored.rows - first + step - 1) / step);
    for (int r = 0; r < grid_.rows; ++r) {
      for (int c = 0; c < grid_.columns; ++c) {
        const int u = first + c * step, v = first + r * step;
        const Vec3<double> n = value(stored, u, v);
        const double norm = n.norm();
        const Vec2<double> pixel((u + 0.5) * sx - 0.5, (v + 0.5) * sy - 0.5);
        if (std::abs(norm - 1) > options.max_norm_error) continue;
        const bool faces = n.dot(camera.pinhole.unproject(pixel)) < 0;
        ++(faces ? facing : away);
        if (!faces) continue;
        const auto i = static_cast<std::size_t>(r * grid_.columns + c);
        grid_.normal[i] = (n / norm).cast<float>();
        grid_.weight[i] = 1;
      }
    }
    if (away > facing) return NormalStatus::kFacesAway;
    keep_planar(grid_, options.mask, field);
    field.plane_sigma = static_cast<float>(options.plane_sigma);
    return NormalStatus::kOk;
  }

 private:
  [[nodiscard]] Vec3<double> value(const cv::Mat& stored, int u, int v) const noexcept {
    Vec3<double> n;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const int i = u * stored.channels() + options.channel[a];
      const double level = stored.depth() == CV_8U ? stored.ptr<std::uint8_t>(v)[i] / 255.0
                                                   : stored.ptr<std::uint16_t>(v)[i] / 65535.0;
      n[axis] = options.sign[a] * (2 * level - 1);
    }
    return n;
  }

  NormalGrid grid_;
};
static_assert(NormalSource<FileNormals>);

}  // namespace sslam
