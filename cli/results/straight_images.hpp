// SPDX-License-Identifier: BSD-3-Clause
// The images of a run's keyframes as the exported camera sees them: without the bend of the lens.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cli/input/frame_reader.hpp"
#include "cli/input/image_file.hpp"
#include "cli/input/open_images.hpp"
#include "cli/results/keyframe_images.hpp"
#include "cli/results/run_camera.hpp"
#include "sslam/opencv/camera/undistorter.hpp"

namespace sslam::cli {

inline constexpr const char* kStraightFolder = "images";  // of an export

namespace straight_detail {

struct ExportedRun {
  std::string dataset, topic;
  Camera<double> camera;
};

[[nodiscard]] inline ExportedRun exported_run(const RunFolder& run) {
  ExportedRun of;
  try {
    const auto& settings = run.metrics.at("settings");
    if (settings.contains("undistorted_to_degrees") && settings["undistorted_to_degrees"].is_number())
      throw Error(
          "--images: the run's images are of a wide lens, which are not undistorted here; leave it out");
    of.dataset = settings.at("dataset").get<std::string>();
    of.topic = settings.value("topic", std::string());
  } catch (const nlohmann::json::exception&) {
    throw Error("metrics.json: lacks the dataset of the run (settings)");
  }
  of.camera = camera_of(run);
  return of;
}

}  // namespace straight_detail

// Of the known keyframes, by their names, into a new folder. How many were written. Throws Error where the
// run's dataset is no longer there or has other images, and where the run saw a pinhole's view of a wide
// lens.
inline std::size_t write_straight_images(const RunFolder& run, const KeyframeImages& names,
                                         const std::filesystem::path& folder) {
  constexpr int kQuality = 95;
  const straight_detail::ExportedRun of = straight_detail::exported_run(run);
  std::map<std::int64_t, std::filesystem::path> wanted;  // by the number of the frame
  for (const auto& keyframe : run.map.keyframes)
    if (const std::size_t id = Map<double>::index(keyframe.id); keyframe.alive() && names.known[id])
      wanted[keyframe.frame.index] = std::filesystem::path(names.names[id]).filename();
  const io::Dataset dataset = open_frames(of.dataset, {}, {of.topic, ""});
  std::filesystem::create_directories(folder);
  FrameReader reader(dataset, {of.camera.width, of.camera.height});
  Undistorter undistorter;
  std::size_t written = 0;
  for (const io::FrameEntry& entry : dataset.frames) {
    const auto name = wanted.find(entry.index);
    if (name == wanted.end()) continue;
    std::string why;
    const cv::Mat image = reader.read(entry, why);
    if (image.empty()) throw Error(why);
    if (image.cols != of.camera.width || image.rows != of.camera.height)
      throw Error(reader.label(entry) + ": has another size than the run's images: of another dataset?");
    write_image(folder / name->second, undistorter.undistort(image, of.camera),
                {cv::IMWRITE_JPEG_QUALITY, kQuality, cv::IMWRITE_PNG_COMPRESSION, 1});
    ++written;
  }
  if (written < wanted.size())
    throw Error(of.dataset + ": has no longer all images of the run: " + std::to_string(written) + " of " +
                std::to_string(wanted.size()) + " keyframes");
  return written;
}

}  // namespace sslam::cli
