// SPDX-License-Identifier: BSD-3-Clause
// Normals from one image by a network: any ONNX model that its manifest describes, run by cv::dnn.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/resized_camera.hpp"
#include "sslam/opencv/normals/depth_normals.hpp"
#include "sslam/opencv/normals/normal_evidence.hpp"
#include "sslam/opencv/normals/normal_manifest.hpp"
#include "sslam/opencv/normals/normal_source.hpp"
#include "sslam/opencv/normals/onnx_network.hpp"

namespace sslam {

struct OnnxNormalsOptions {
  double max_norm_error = 0.15;   // of an output vector from unit length: beyond, it is no normal
  double max_range_error = 0.01;  // of a mask or a confidence from [0, 1]: beyond, it is neither
  double max_bad_share = 0.05;    // of the output that is of no use: beyond, the frame is refused
  NormalEvidenceOptions evidence;
  DepthNormalsOptions depth;  // for models whose output is depth

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_norm_error", self.max_norm_error, Unit::kNumber, 0, 10,
          "of an output vector from unit length: beyond, it is no normal");
    visit("max_range_error", self.max_range_error, Unit::kNumber, 0, 10,
          "of a mask or a confidence from 0 to 1: beyond, it is neither");
    visit("max_bad_share", self.max_bad_share, Unit::kShare, 0, 1,
          "of the output that is of no use: beyond, the frame is refused");
    visit_within("evidence.", self.evidence, visit);
    visit_within("depth.", self.depth, visit);
  }
};
static_assert(Described<OnnxNormalsOptions>);

// Of the last frame.
struct OnnxNormalsReport {
  NormalEvidence evidence;
  double bad_share = 0;   // of the normals that are not finite or not unit; of the depth that is not finite
  double away_share = 0;  // of the unit normals that the camera could see, those that point away from it
  double bad_weight_share = 0;  // of mask and confidence, the worse of the two, that is not in [0, 1]
};

class OnnxNormals {
 public:
  OnnxNormalsOptions options;

  // `file` is the manifest, or the model with its manifest beside it (same name, .json). Runs the model once.
  // Throws NormalModelError with one line that names file and field when they do not fit.
  explicit OnnxNormals(const std::filesystem::path& file)
      : network_(read_normal_manifest(manifest_of(file))) {
    if (manifest().kind != NetworkOutput::kNormals) return;
    decode(dense_);
    demand("output.name", manifest().output, report_.bad_share,
           "not finite or not of unit length (see output.range)");
    demand("output.mask", manifest().mask, share_outside(dense_.planar), "not in [0, 1]");
    demand("output.confidence", manifest().confidence, share_outside(dense_.confidence), "not in [0, 1]");
  }

  [[nodiscard]] const NormalManifest& manifest() const noexcept { return network_.manifest(); }
  [[nodiscard]] const OnnxNormalsReport& report() const noexcept { return report_; }
  // The last frame's whole answer, for models whose output is normals; the others leave depth() one.
  [[nodiscard]] const DenseNormals& dense() const noexcept { return dense_; }
  [[nodiscard]] const DepthNormals& depth() const noexcept { return depth_; }

  // After kBadOutput and kNoEvidence, report() has the figures.
  [[nodiscard]] NormalStatus fill(const ImageInput& input, const Camera<double>& camera, NormalField& field) {
    field.clear();
    report_ = {};
    const NormalStatus status = manifest().kind == NetworkOutput::kNormals
                                    ? fill_from_normals(input, camera, field)
                                    : fill_from_depth(input, camera, field);
    field.plane_sigma = static_cast<float>(radians(manifest().plane_sigma_deg));
    return status;
  }

  // The whole answer, at the resolution of the output. For models whose output is normals.
  [[nodiscard]] NormalStatus infer(const cv::Mat& image, const Camera<double>& camera, DenseNormals& dense) {
    const NormalStatus status = network_.run(image, camera);
    if (status != NormalStatus::kOk) return status;
    decode(dense);
    const NormalStatus answer = judge(std::max(report_.bad_share, report_.bad_weight_share));
    return answer == NormalStatus::kOk && report_.away_share > kMostAway ? NormalStatus::kFacesAway : answer;
  }

 private:
  static constexpr double kMostAway = 0.5;  // a visible surface faces the camera: beyond, a sign is wrong

  static std::filesystem::path manifest_of(std::filesystem::path file) {
    if (file.extension() != ".onnx") return file;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
      throw NormalModelError(file.string() + ": no such model");
    return file.replace_extension(".json");
  }

  [[nodiscard]] NormalStatus judge(double bad_share) const noexcept {
    return bad_share > options.max_bad_share ? NormalStatus::kBadOutput : NormalStatus::kOk;
  }

  void demand(const char* field, const std::string& output, double bad_share, const char* what) const {
    if (judge(bad_share) == NormalStatus::kOk) return;
    throw NormalModelError(manifest().file.string() + ": " + field + ": " +
                           std::to_string(std::lround(100 * bad_share)) + " % of '" + output + "' is " +
                           what);
  }

  [[nodiscard]] double share_outside(const cv::Mat_<float>& weight) const {
    std::size_t outside = 0;
    for (const float w : weight)  // a comparison with NaN is false
      outside += w >= -options.max_range_error && w <= 1 + options.max_range_error ? 0U : 1U;
    return static_cast<double>(outside) / static_cast<double>(std::max<std::size_t>(weight.total(), 1));
  }

  // Fills the report's shares. Vectors that turn away from the camera, or show what the camera does not, are
  // dropped.
  void decode(DenseNormals& dense) {
    const NormalManifest& m = manifest();
    const std::array<cv::Mat_<float>, 3> channel{network_.channel(0), network_.channel(1),
                                                 network_.channel(2)};
    dense.pinhole = network_.output_pinhole();
    dense.normal.create(channel[0].size());
    dense.planar = network_.mask().clone();
    dense.confidence = network_.confidence().clone();
    const double low = m.range[0], to_unit = 2 / (m.range[1] - low);
    std::size_t bad = 0, judged = 0, away = 0;
    for (int v = 0; v < dense.normal.rows; ++v) {
      for (int u = 0; u < dense.normal.cols; ++u) {
        Vec3<double> n;
        for (std::size_t c = 0; c < 3; ++c)
          n[m.axis[c]] = m.sign[c] * ((static_cast<double>(channel[c](v, u)) - low) * to_unit - 1);
        const double norm = n.norm();
        const bool unit = std::abs(norm - 1) <= options.max_norm_error;
        bad += unit ? 0U : 1U;
        const bool seen = unit && std::isfinite(dense.weight(v, u)) && network_.inside(u, v);
        const bool faces = n.dot(dense.pinhole.unproject(Vec2<double>(u, v))) < 0;
        judged += seen ? 1U : 0U;
        away += seen && !faces ? 1U : 0U;
        const bool keep = seen && faces;
        if (keep) n /= norm;
        dense.normal(v, u) =
            keep ? cv::Vec3f(static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z()))
                 : cv::Vec3f();
      }
    }
    report_.bad_share = static_cast<double>(bad) / static_cast<double>(dense.normal.total());
    report_.away_share = static_cast<double>(away) / static_cast<double>(std::max<std::size_t>(judged, 1));
    report_.bad_weight_share = std::max(share_outside(dense.planar), share_outside(dense.confidence));
  }

  static constexpr int kDepthWidth = 320;  // pixels

  NormalStatus fill_from_normals(const ImageInput& input, const Camera<double>& camera, NormalField& field) {
    const NormalStatus status = infer(input.image, camera, dense_);
    if (status != NormalStatus::kOk) return status;
    report_.evidence = select_normals(dense_, options.evidence, field);
    return report_.evidence.enough ? NormalStatus::kOk : NormalStatus::kNoEvidence;
  }

  NormalStatus fill_from_depth(const ImageInput& input, const Camera<double>& camera, NormalField& field) {
    const NormalStatus status = network_.run(input.image, camera);
    if (status != NormalStatus::kOk) return status;
    const cv::Mat_<float> output = network_.channel(0);
    const auto bad = std::count_if(output.begin(), output.end(), [](float x) { return !std::isfinite(x); });
    report_.bad_share = static_cast<double>(bad) / static_cast<double>(output.total());
    if (judge(report_.bad_share) != NormalStatus::kOk) return judge(report_.bad_share);
    // Small maps are enlarged: the depth source fits its planes to blocks of pixels.
    const int factor = std::max(1, kDepthWidth / output.cols);
    ImageInput depth;
    cv::resize(output * manifest().depth_scale, depth.depth, {}, factor, factor, cv::INTER_LINEAR);
    if (manifest().kind == NetworkOutput::kInverseDepth) depth.depth = 1.0 / depth.depth;
    depth.depth.setTo(0, depth.depth != depth.depth);  // NaN: no measurement
    const double enlarged = factor;
    const Camera<double> seen{
        resized(network_.output_pinhole(), enlarged, enlarged), {}, depth.depth.cols, depth.depth.rows};
    depth_.options = options.depth;
    const NormalStatus answer = depth_.fill(depth, seen, field);
    report_.evidence.enough = field.size() > 0;
    return answer == NormalStatus::kOk && !report_.evidence.enough ? NormalStatus::kNoEvidence : answer;
  }

  OnnxNetwork network_;
  OnnxNormalsReport report_;
  DenseNormals dense_;
  DepthNormals depth_;
};
static_assert(NormalSource<OnnxNormals>);

}  // namespace sslam
