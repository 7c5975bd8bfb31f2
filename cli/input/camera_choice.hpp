// SPDX-License-Identifier: BSD-3-Clause
// Which calibration a run uses: --camera, --focal or --fov, else a camera file in the dataset, else what a
// bag says, else a published one for the dataset, else what the first image says about its lens, else a guess
// that is told.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sslam/geometry/camera.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/opencv/camera/camera_keys.hpp"
#include "sslam/opencv/camera/wide_lens.hpp"

namespace sslam::cli {

// What the command line says about the camera.
struct CameraWish {
  std::string file;          // a file or the name of a built-in calibration; empty: not given
  double focal = 0;          // pixels; 0: not given
  double fov = 0;            // degrees across; 0: not given
  double undistort_fov = 0;  // of a wide lens's pinhole view, degrees across; 0: the usual
};

struct CameraChoice {
  Camera<double> camera;    // width and height are 0 when the source does not give them
  double depth_factor = 0;  // depth image units a metre; 0: not known
  double frame_rate = 0;    // frames a second; 0: not known
  std::string source;       // for the report: a path or a name
  std::vector<std::string> notes, warnings;
  bool assumed = false;            // nobody knows this camera
  double focal_sigma = 0.05;       // how far the focal length may be off, as a part of it
  std::optional<WideLens> wide{};  // of the images, where `camera` is that of a view of them
  double view_fov = 0;             // of that view, degrees across
  std::vector<CameraFile> all{};  // of a file with several; `camera` is that of one when pick_camera has been
  double view_across = 0;         // radians, of a camera of which nothing else is known; 0: `camera` is
};

// Of a camera file, or of FILE#NAME with the name of one of its cameras. Throws Error when it is wrong.
[[nodiscard]] CameraChoice camera_from_file(const std::filesystem::path& path);

// A depth factor that the chosen file leaves out is taken from the published values of the dataset, where
// there are any. Nothing when nothing is known about the camera. Throws when the file is wrong.
[[nodiscard]] std::optional<CameraChoice> find_camera(const std::string& wanted, const io::Dataset& dataset);

// Standard deviation of a focal length that nobody has said, as a part of it.
inline constexpr double kUnknownFocal = 0.4;

// Square pixels, the principal point in the middle, no distortion.
[[nodiscard]] CameraChoice plain_camera(double focal, int width, int height, const std::string& source,
                                        double focal_sigma);

// What --focal or --fov make of images of this size; nothing where neither is given.
[[nodiscard]] std::optional<CameraChoice> wished_camera(const CameraWish& wish, int width, int height);

// Of several cameras, takes the one that is for images of this size, else of this shape, with a note. Throws
// Error where none is, or several are.
void pick_camera(CameraChoice& choice, int width, int height);

// Of a camera of which only the field of view is known: makes it that of images of this size.
void take_size(CameraChoice& choice, int width, int height);

// A wide lens is looked through a pinhole's view of its images: brings `camera` to it. Throws Error when the
// lens sees less than is asked for.
void take_view(CameraChoice& choice, double wanted);

// For images of this size. Throws Error when the camera cannot be theirs.
[[nodiscard]] CameraChoice choose_camera(const CameraWish& wish, const io::Dataset& dataset, int width,
                                         int height);

}  // namespace sslam::cli
