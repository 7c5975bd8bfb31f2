// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/camera_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "cli/input/camera_fit.hpp"
#include "cli/input/exif_focal.hpp"
#include "cli/input/size_text.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/datasets/known_cameras.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/opencv/camera/camera_file.hpp"
#include "sslam/opencv/camera/wide_view.hpp"

namespace sslam::cli {
namespace {

CameraChoice choice_of(const CameraFile& file, const std::string& source) {
  CameraChoice choice{file.camera, file.depth_factor, file.frame_rate, source, file.notes, {}, false};
  choice.wide = file.wide;
  choice.view_across = file.view_across;
  return choice;
}

CameraChoice camera_from_text(const io::Dataset& dataset) {
  const std::string& source = dataset.camera_source;
  CameraChoice choice = choice_of(parse_wide_camera_text(dataset.camera_text, source), source);
  choice.notes.insert(choice.notes.begin(), "the camera is that of " + source);
  return choice;
}

CameraChoice camera_from_known(const io::KnownCamera& known) {
  return {known.camera, known.depth_factor, known.frame_rate, "built in: " + std::string(known.name), {}, {},
          false};
}

// Names that camera files have where programs put them beside the images.
constexpr std::array<std::string_view, 11> kOwnCameraFiles{
    "camera.yaml",      "camera.yml",        "camera.json", "camera.txt",
    "camera_info.yaml", "cam0/sensor.yaml",  "sensor.yaml", "cameras.txt",
    "transforms.json",  "camera_matrix.csv", "ost.yaml"};

// The camera file that lies in the dataset, or beside the video, else the one of its layout; empty: none.
std::filesystem::path own_camera_file(const io::Dataset& dataset) {
  if (dataset.layout == io::Layout::kStream) return {};  // lies nowhere
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(dataset.root, ignored);
  const std::filesystem::path place = folder ? dataset.root : dataset.root.parent_path();
  for (const std::string_view name : kOwnCameraFiles)
    if (std::filesystem::exists(place / name, ignored)) return place / name;
  return dataset.camera_file;
}

// Standard deviation of a focal length that a lens's label says, as a part of it.
constexpr double kRoughFocal = 0.1;

double focal_of_view(double degrees_across, int pixels) {
  return 0.5 * pixels / std::tan(0.5 * radians(degrees_across));
}

// Where the camera says nothing about depth, the dataset does.
void complete_depth(CameraChoice& choice, const io::Dataset& dataset) {
  if (choice.depth_factor == 0) choice.depth_factor = dataset.depth_factor;
  if (choice.depth_factor > 0) return;
  if (const auto known = io::known_camera_for(dataset)) choice.depth_factor = known->depth_factor;
}

}  // namespace

CameraChoice camera_from_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::string whole = path.string();
  const std::size_t mark = std::filesystem::exists(path, ignored) ? std::string::npos : whole.rfind('#');
  const std::string file = whole.substr(0, mark);
  CameraFile read = read_wide_camera_file(file);
  std::vector<CameraFile> all;
  if (!read.others.empty()) {
    all = std::exchange(read.others, {});
    all.insert(all.begin(), read);
  }
  if (mark == std::string::npos) {
    CameraChoice choice = choice_of(read, whole);
    choice.all = std::move(all);
    return choice;
  }
  const std::string name = whole.substr(mark + 1);
  std::string names;
  for (const CameraFile& camera : all) {
    if (camera.name == name) return choice_of(camera, whole);
    io::add_to_list(names, camera.name);
  }
  throw Error(file + ": has no camera '" + name + "'; " +
              (names.empty() ? "it has only one camera: leave '#" + name + "' out" : "it has " + names));
}

std::optional<CameraChoice> find_camera(const std::string& wanted, const io::Dataset& dataset) {
  const auto known = io::known_camera_for(dataset);
  const auto complete = [&dataset](CameraChoice choice) {
    complete_depth(choice, dataset);
    return choice;
  };
  if (!wanted.empty()) {
    std::error_code ignored;
    const auto named = io::find_known_camera(wanted);
    if (named && !std::filesystem::exists(wanted, ignored)) return camera_from_known(*named);
    return complete(camera_from_file(wanted));
  }
  if (const std::filesystem::path own = own_camera_file(dataset); !own.empty()) {
    CameraChoice choice = complete(camera_from_file(own));
    if (own.filename() != "camera.yaml")
      choice.notes.insert(choice.notes.begin(), "the camera is that of " + own.string());
    return choice;
  }
  if (!dataset.camera_text.empty()) return complete(camera_from_text(dataset));
  if (known) return camera_from_known(*known);
  return std::nullopt;
}

CameraChoice plain_camera(double focal, int width, int height, const std::string& source,
                          double focal_sigma) {
  CameraChoice choice;
  choice.focal_sigma = focal_sigma;
  choice.camera = {{focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)}, {}, width, height};
  choice.source = source;
  return choice;
}

std::optional<CameraChoice> wished_camera(const CameraWish& wish, int width, int height) {
  if (wish.focal > 0) return plain_camera(wish.focal, width, height, "--focal", kRoughFocal);
  if (wish.fov > 0) return plain_camera(focal_of_view(wish.fov, width), width, height, "--fov", kRoughFocal);
  return std::nullopt;
}

namespace {

// For a camera that nobody has calibrated. Phones and webcams see 55 to 70 degrees along their longer side.
CameraChoice assumed_camera(const io::Dataset& dataset, int width, int height) {
  char text[320];
  const double written = dataset.frames.empty() ? 0 : exif_focal(dataset.frames.front().image, width, height);
  if (written > 0) {
    CameraChoice choice = plain_camera(written, width, height, "the images' Exif", kRoughFocal);
    std::snprintf(
        text, sizeof text,
        "the camera is not calibrated: the images' Exif gives a focal length of %.0f pixels; distortion is "
        "not known (--camera FILE gives both)",
        written);
    choice.notes.emplace_back(text);
    return choice;
  }
  constexpr double kView = 60;  // degrees
  const double focal = focal_of_view(kView, std::max(width, height));
  CameraChoice choice = plain_camera(focal, width, height, "assumed: 60 degrees", kUnknownFocal);
  choice.assumed = true;
  std::snprintf(text, sizeof text,
                "the camera is not known: ASSUMING a field of view of %.0f degrees along the longer side (a "
                "focal length of %.0f pixels) and no distortion; set it by --camera FILE, --focal or --fov, "
                "or make a camera file by sslam calibrate",
                kView, focal);
  choice.warnings.emplace_back(text);
  return choice;
}

}  // namespace

void pick_camera(CameraChoice& choice, int width, int height) {
  if (choice.all.empty()) return;
  const auto fitting = [&](auto fits) {
    std::vector<const CameraFile*> found;
    for (const CameraFile& file : choice.all)
      if (fits(file.camera)) found.push_back(&file);
    return found;
  };
  std::vector<const CameraFile*> found =
      fitting([&](const Camera<double>& c) { return c.width == width && c.height == height; });
  if (found.empty())
    found = fitting([&](const Camera<double>& c) {
      return c.width > 0 && std::abs(static_cast<double>(width) * c.height / c.width - height) <= 1;
    });
  std::string all, fit;
  for (const CameraFile& file : choice.all) io::add_to_list(all, camera_names(file));
  for (const CameraFile* file : found) io::add_to_list(fit, file->name);
  const std::string images = size_text(width, height);
  if (found.size() != 1)
    throw Error(choice.source + ": has several cameras: " + all + "; for images of " + images + " " +
                (found.empty() ? "none fits" : "these fit: " + fit) + "; name one, as in --camera " +
                choice.source + "#" + (found.empty() ? choice.all.front() : *found.front()).name);
  CameraChoice picked = choice_of(*found.front(), choice.source);
  picked.depth_factor = choice.depth_factor;
  picked.notes.insert(picked.notes.begin(), choice.source + ": has several cameras: " + all + "; " + fit +
                                                " is taken, the only one for images of " + images);
  choice = std::move(picked);
}

void take_size(CameraChoice& choice, int width, int height) {
  if (choice.view_across == 0) return;
  const double focal = focal_of_view(degrees(choice.view_across), width);
  choice.camera = plain_camera(focal, width, height, {}, 0).camera;
}

void take_view(CameraChoice& choice, double wanted) {
  if (!choice.wide) {
    if (wanted > 0)
      choice.notes.push_back("--undistort-fov is for wide lenses, and " + choice.source +
                             " has none: ignored");
    return;
  }
  WideLens& lens = *choice.wide;
  lens.pinhole = choice.camera.pinhole;
  lens.width = choice.camera.width;
  lens.height = choice.camera.height;
  const double most = WideView::field_of(lens);
  constexpr double kLeast = 40;  // degrees
  char text[240];
  if (most < kLeast || wanted > most) {
    std::snprintf(text, sizeof text, ": this lens sees %.0f degrees across in images of %dx%d; %s", most,
                  lens.width, lens.height,
                  most < kLeast ? "are its coefficients those of another model or resolution?"
                                : "--undistort-fov asks for more");
    throw Error(choice.source + text);
  }
  choice.view_fov = wanted > 0 ? wanted : std::min(WideView::kUsual, most);
  choice.camera = view_camera(lens, choice.view_fov);
  std::snprintf(
      text, sizeof text,
      ": the lens sees %.0f degrees across; its images are undistorted to a pinhole's view of %.0f degrees "
      "(--undistort-fov), and what lies beyond is not used",
      most, choice.view_fov);
  choice.notes.push_back(choice.source + text);
}

CameraChoice choose_camera(const CameraWish& wish, const io::Dataset& dataset, int width, int height) {
  std::optional<CameraChoice> choice = wished_camera(wish, width, height);
  if (!choice) choice = find_camera(wish.file, dataset);
  if (!choice) choice = assumed_camera(dataset, width, height);
  complete_depth(*choice, dataset);
  pick_camera(*choice, width, height);
  take_size(*choice, width, height);
  fit_camera(choice->camera, width, height, choice->source, choice->notes, choice->warnings);
  take_view(*choice, wish.undistort_fov);
  return *choice;
}

}  // namespace sslam::cli
