// SPDX-License-Identifier: BSD-3-Clause
// An ONNX model with its manifest, run by cv::dnn: image in, output planes out.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sslam/core/sha256.hpp"
#include "sslam/geometry/resized_camera.hpp"
#include "sslam/opencv/normals/network_view.hpp"
#include "sslam/opencv/normals/normal_manifest.hpp"
#include "sslam/opencv/normals/normal_source.hpp"
#include "sslam/opencv/normals/output_planes.hpp"

namespace sslam {

class OnnxNetwork {
 public:
  double min_scale = 0.5;  // an image must have at least this share of the network's width and height

  // Reads the model and runs it once on a grey ramp, and checks the shapes of its outputs.
  // Throws NormalModelError with one line that names file and field.
  explicit OnnxNetwork(NormalManifest manifest) : manifest_(std::move(manifest)) {
    load();
    probe();
  }

  [[nodiscard]] const NormalManifest& manifest() const noexcept { return manifest_; }

  [[nodiscard]] NormalStatus run(const cv::Mat& image, const Camera<double>& camera) {
    const NetworkInput& in = manifest_.input;
    if (image.empty()) return NormalStatus::kNoInput;
    if (image.depth() != CV_8U || (image.channels() != 1 && image.channels() != 3 && image.channels() != 4))
      return NormalStatus::kWrongType;
    if (image.cols != camera.width || image.rows != camera.height) return NormalStatus::kWrongSize;
    if (image.cols < min_scale * in.width || image.rows < min_scale * in.height)
      return NormalStatus::kTooSmall;
    view_.set(camera, in);
    to_blob(view_.warp(image));
    net_.setInput(blob_);
    net_.forward(blobs_, wanted_);
    planes_.resize(blobs_.size());
    for (std::size_t i = 0; i < blobs_.size(); ++i) planes_[i] = output_planes(blobs_[i], channels(i));
    return NormalStatus::kOk;
  }

  // Planes of the last run, valid until the next.
  [[nodiscard]] const cv::Mat_<float>& channel(std::size_t c) const { return planes_[0][c]; }
  [[nodiscard]] cv::Mat_<float> mask() const {
    return manifest_.mask.empty() ? cv::Mat_<float>() : planes_[1][0];
  }
  [[nodiscard]] cv::Mat_<float> confidence() const {
    return manifest_.confidence.empty() ? cv::Mat_<float>() : planes_.back()[0];
  }

  // Of the outputs' pixels.
  [[nodiscard]] Pinhole<double> output_pinhole() const {
    const double sx = static_cast<double>(channel(0).cols) / manifest_.input.width,
                 sy = static_cast<double>(channel(0).rows) / manifest_.input.height;
    return resized(view_.pinhole(), sx, sy);
  }
  // Whether an output's pixel shows something that the camera sees.
  [[nodiscard]] bool inside(int u, int v) const {
    return view_.inside((2 * u + 1) * manifest_.input.width / (2 * channel(0).cols),
                        (2 * v + 1) * manifest_.input.height / (2 * channel(0).rows));
  }

 private:
  class Silence {  // of OpenCV's own lines on standard error while it reads a model
   public:
    ~Silence() { cv::utils::logging::setLogLevel(before_); }

   private:
    cv::utils::logging::LogLevel before_ =
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  };

  [[noreturn]] static void fail(const std::filesystem::path& file, const std::string& what) {
    throw NormalModelError(file.string() + ": " + what);
  }

  static std::string first_line(const cv::Exception& error) {
    return error.err.substr(0, error.err.find('\n'));
  }

  // Of the very file that the manifest means, where it says so by a checksum.
  [[nodiscard]] std::string model_bytes() const {
    std::ifstream file(manifest_.model, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad() || !file.is_open()) fail(manifest_.model, "cannot be read");
    if (const std::string& wanted = manifest_.sha256; !wanted.empty() && sha256(bytes) != wanted)
      fail(manifest_.file, "manifest.sha256: " + manifest_.model.string() +
                               " is another model than the one that is meant. Get both files from one place");
    return bytes;
  }

  void load() {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(manifest_.model, ignored))
      fail(manifest_.file, "manifest.model: no file " + manifest_.model.string());
    const std::string bytes = model_bytes();
    const Silence silence;
    try {
      net_ = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    } catch (const cv::Exception& error) {
      fail(manifest_.model, "no ONNX model that OpenCV " CV_VERSION " reads: " + first_line(error));
    }
    const std::vector<std::string> names = net_.getUnconnectedOutLayersNames();
    std::string list;
    for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
    wanted_.clear();
    for (const auto& [field, name] : {std::pair{"name", manifest_.output}, std::pair{"mask", manifest_.mask},
                                      std::pair{"confidence", manifest_.confidence}}) {
      if (name.empty()) continue;
      if (std::find(names.begin(), names.end(), name) == names.end())
        fail(manifest_.file,
             std::string("output.") + field + ": the model has no output '" + name + "', only " + list);
      wanted_.push_back(name);
    }
  }

  void probe() {
    const NetworkInput& in = manifest_.input;
    cv::Mat image(in.height, in.width, CV_8UC3);
    for (int v = 0; v < image.rows; ++v) image.row(v).setTo(cv::Scalar::all(255.0 * v / image.rows));
    const Camera<double> camera{
        {0.8 * in.width, 0.8 * in.width, 0.5 * in.width, 0.5 * in.height}, {}, in.width, in.height};
    {
      const Silence silence;
      try {
        if (run(image, camera) != NormalStatus::kOk)
          fail(manifest_.file, "input: cannot be made from an image");
      } catch (const cv::Exception& error) {
        fail(manifest_.file, "input: the model refuses " + std::to_string(in.width) + "x" +
                                 std::to_string(in.height) + " pixels: " + first_line(error));
      }
    }
    check_shape(0, "output.name");
    for (std::size_t i = 1; i < wanted_.size(); ++i)
      check_shape(i, i == 1 && !manifest_.mask.empty() ? "output.mask" : "output.confidence");
  }

  [[nodiscard]] std::size_t channels(std::size_t output) const {
    return output == 0 && manifest_.kind == NetworkOutput::kNormals ? 3 : 1;
  }

  void check_shape(std::size_t i, const char* field) const {
    const auto& planes = planes_[i];
    if (!planes.empty() && !planes_[0].empty() && planes[0].size() == planes_[0][0].size() &&
        planes[0].cols > 1)
      return;
    std::string shape;
    for (int d = 0; d < blobs_[i].dims; ++d) shape += (d > 0 ? "x" : "") + std::to_string(blobs_[i].size[d]);
    const std::string expected =
        channels(i) == 3 ? "1x3xHxW, 3xHxW, 1xHxWx3 or HxWx3" : "1x1xHxW, 1xHxW or HxW";
    fail(manifest_.file, std::string(field) + ": '" + wanted_[i] + "' has shape " + shape + ", expected " +
                             expected + " with the same H and W for all outputs");
  }

  void to_blob(const cv::Mat& bgr) {
    const NetworkInput& in = manifest_.input;
    const int shape[] = {1, 3, in.height, in.width};
    blob_.create(4, shape, CV_32F);
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      cv::Mat plane(in.height, in.width, CV_32F, blob_.ptr<float>(0, c));
      cv::extractChannel(bgr, channel_, in.rgb ? 2 - c : c);
      channel_.convertTo(plane, CV_32F, in.scale[i], -in.mean[i] * in.scale[i]);
    }
  }

  NormalManifest manifest_;
  cv::dnn::Net net_;
  std::vector<std::string> wanted_;  // outputs: normals or depth, then mask and confidence where there are
  std::vector<cv::Mat> blobs_;       // of wanted_
  std::vector<std::vector<cv::Mat_<float>>> planes_;  // of blobs_
  NetworkView view_;
  cv::Mat blob_, channel_;
};

}  // namespace sslam
