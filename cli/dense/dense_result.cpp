// SPDX-License-Identifier: BSD-3-Clause
#include "cli/dense/dense_result.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <span>

#include "cli/dense/model_files.hpp"
#include "cli/results/run_folder.hpp"
#include "sslam/dense/map_samples.hpp"
#include "sslam/dense/map_views.hpp"
#include "sslam/map/vertical.hpp"
#include "sslam/opencv/camera/undistorter.hpp"
#include "sslam/opencv/normals/normal_picture.hpp"
#include "sslam/opencv/view_of.hpp"
#include "sslam/system/wall_timer.hpp"

namespace sslam::cli {
namespace {

constexpr int kWidth = 320;  // of the images that planes are compared in, pixels, about

dense::NormalImage unpack_normals(const KeyframePicture& picture) {
  dense::NormalImage normals;
  if (picture.normals.empty()) return normals;
  const cv::Mat_<cv::Vec3b> image = cv::imdecode(picture.normals, cv::IMREAD_COLOR);
  normals.columns = image.cols;
  normals.rows = image.rows;
  normals.pinhole = picture.normal_pinhole;
  for (const cv::Vec3b& pixel : image) {
    const Vec3<float> n = (Vec3<float>(pixel[2], pixel[1], pixel[0]).array() / 127.5F - 1).matrix();
    normals.normals.push_back(pixel == no_normal() ? Vec3<float>(Vec3<float>::Zero()) : n.normalized());
  }
  return normals;
}

class DenseRun {
 public:
  DenseRun(const Map<double>& map, std::size_t first, const KeyframePictures& pictures,
           const Camera<double>& camera)
      : map_(map), first_(first), pictures_(pictures), camera_(camera) {}

  [[nodiscard]] DenseResult run() {
    WallTimer timer;
    timer.begin();
    DenseResult result;
    result.up = up_direction(map_);
    gather(result);
    const double depth = dense::median_depth(map_);
    const dense::DenseOptions options;
    dense::connect_views(map_, ids_, depth, options.cost.views, views_);
    result.model = dense::DenseBuilder(options).build(map_, depth, views_);
    if (result.empty()) {
      result.warnings.push_back(views_.empty() ? "--dense: no keyframe has an image: no model is written"
                                               : "--dense: the map shows no planes: no model is written");
    } else {
      paint(depth, result);
    }
    result.seconds = timer.total() * 1e-3;
    return result;
  }

 private:
  void gather(DenseResult& result) {
    const double scale = std::min(1.0, static_cast<double>(kWidth) / camera_.width);
    for (std::size_t k = first_; k < map_.keyframes.size(); ++k) {
      const Keyframe<double>& keyframe = map_.keyframes[k];
      if (!keyframe.alive()) continue;
      const KeyframePicture* const picture = pictures_.of(keyframe.frame);
      if (picture == nullptr) continue;
      const cv::Mat image = straight_image(*picture);
      cv::Mat grey;
      cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
      if (scale < 1) cv::resize(grey, grey, {kWidth, rounded(scale * camera_.height)}, 0, 0, cv::INTER_AREA);
      greys_.push_back(grey.clone());
      views_.push_back(dense::view_of_keyframe(map_, keyframe, scale));
      views_.back().grey = view_of<std::uint8_t>(greys_.back());
      seen_.push_back(seen_of(*picture, greys_.back().size()));
      views_.back().seen = view_of<std::uint8_t>(seen_.back());
      views_.back().normals = unpack_normals(*picture);
      ids_.push_back(keyframe.id);
      packed_.push_back(picture);
      result.colour = result.colour || picture->colour;
      result.normals = result.normals || !picture->normals.empty();
    }
    result.keyframes = views_.size();
    scale_ = scale;
    if (!views_.empty() && !result.colour)
      result.warnings.emplace_back("--dense: the images have no colour: the model is grey");
  }

  // Where the image shows the world: what the mask leaves, as far as the lens sees. Less a rim, so that the
  // patch around a pixel is whole. Empty: everywhere.
  [[nodiscard]] cv::Mat seen_of(const KeyframePicture& picture, cv::Size size) {
    if (!seen_.empty() && picture.mask == packed_.back()->mask) return seen_.back();
    cv::Mat seen = picture.mask.empty() ? cv::Mat() : cv::imdecode(picture.mask, cv::IMREAD_GRAYSCALE) != 0;
    if (!camera_.distortion.is_identity()) {
      if (lens_view_.empty()) lens_view_ = lens_view();
      seen = seen.empty() ? lens_view_ : undistorter_.undistort(seen, camera_) & lens_view_;
    }
    if (seen.empty()) return seen;
    if (seen.size() != size) cv::resize(seen, seen, size, 0, 0, cv::INTER_AREA);
    constexpr int kRim = 2 * dense::Patch::kReach + 1;
    cv::Mat whole;
    cv::erode(seen == 255, whole,
              cv::Mat::ones(kRim, kRim, CV_8UC1));  // a pixel left out in part is left out
    return cv::countNonZero(whole) == static_cast<int>(whole.total()) ? cv::Mat() : whole;
  }

  // The pixels of the straight image that the lens sees; beyond, the undistorter repeats the border. The way
  // back excludes the far field, which the distortion model folds into the image.
  [[nodiscard]] cv::Mat lens_view() const {
    cv::Mat seen(camera_.height, camera_.width, CV_8UC1, cv::Scalar(0));
    for (int v = 0; v < seen.rows; ++v)
      for (int u = 0; u < seen.cols; ++u) {
        const Vec2<double> straight(u, v), pixel = camera_.distort_pixel(straight);
        const bool inside = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera_.width - 1 &&
                            pixel.y() <= camera_.height - 1 &&
                            (camera_.undistort_pixel(pixel) - straight).norm() < 0.5;
        if (inside) seen.at<std::uint8_t>(v, u) = 255;
      }
    return seen;
  }

  [[nodiscard]] static int rounded(double x) { return static_cast<int>(std::lround(x)); }

  [[nodiscard]] cv::Mat straight_image(const KeyframePicture& picture) {
    return undistorter_.undistort(cv::imdecode(picture.image, cv::IMREAD_COLOR), camera_).clone();
  }

  void paint(double depth, DenseResult& result) {
    const TextureInput input{result.model, views_, depth / camera_.pinhole.fx,
                             [this](std::size_t v) { return straight_image(*packed_[v]); }, 1 / scale_};
    result.atlas = make_atlas(input);
  }

  const Map<double>& map_;
  std::size_t first_;
  const KeyframePictures& pictures_;
  const Camera<double>& camera_;
  Undistorter undistorter_;
  cv::Mat lens_view_;  // of the images; empty: not made yet, or without distortion
  double scale_ = 1;
  std::vector<cv::Mat> greys_, seen_;
  std::vector<dense::DenseView> views_;
  std::vector<KeyframeId> ids_;
  std::vector<const KeyframePicture*> packed_;
};

}  // namespace

DenseResult make_dense(const Map<double>& map, std::size_t first, const KeyframePictures& pictures,
                       const Camera<double>& camera) {
  return DenseRun(map, first, pictures, camera).run();
}

void write_dense(const std::filesystem::path& folder, const DenseResult& result) {
  if (result.empty()) return;
  const TexturedMesh mesh = textured_mesh(result.model, result.atlas);
  write_glb(folder / kModelFile, mesh, result.up);
  write_obj(folder, mesh, result.up);
  write_model_ply(folder / kModelPlyFile, result.model, result.atlas);
}

nlohmann::ordered_json dense_json(const DenseResult& result) {
  nlohmann::ordered_json planes = nlohmann::ordered_json::array();
  for (const dense::DensePlane& plane : result.model.planes) {
    const Vec3<double>& n = plane.fit.plane.normal;
    planes.push_back({{"normal", {n.x(), n.y(), n.z()}},
                      {"distance", plane.fit.plane.distance},
                      {"distance_sigma", std::sqrt(plane.fit.covariance(2, 2))},
                      {"axis", plane.axis},
                      {"area", plane.cells.area()}});
  }
  return {{"candidates", result.model.candidates},
          {"area", result.model.area()},
          {"keyframes", result.keyframes},
          {"seconds", result.seconds},
          {"normals", result.normals},
          {"colour", result.colour},
          {"texture_size", {result.atlas.image.cols, result.atlas.image.rows}},
          {"planes", planes}};
}

}  // namespace sslam::cli
