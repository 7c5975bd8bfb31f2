// SPDX-License-Identifier: BSD-3-Clause
// A COLMAP model in text form, read by COLMAP's rules.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sslam/core/types.hpp"
#include "support/catch.hpp"

namespace sslam::testing {

struct ColmapPoint2 {
  double x, y;
  long id;
};
struct ColmapImage {
  double qw, qx, qy, qz, tx, ty, tz;
  long camera;
  std::string name;
  std::vector<ColmapPoint2> points;
};
struct ColmapPoint3 {
  double x, y, z, error;
  std::vector<std::pair<long, std::size_t>> track;
};
struct ColmapModel {
  std::map<long, std::array<double, 4>> cameras;
  std::map<long, ColmapImage> images;
  std::map<long, ColmapPoint3> points;
};

// The lines that are no comments. An image without features has an empty line, which counts.
inline std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  REQUIRE(file);
  for (std::string line; std::getline(file, line);)
    if (line.empty() || line.front() != '#') lines.push_back(line);
  return lines;
}

inline std::vector<double> numbers_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<double> numbers;
  for (double number = 0; in >> number;) numbers.push_back(number);
  return numbers;
}

inline ColmapModel read_model(const std::filesystem::path& folder) {
  ColmapModel model;
  for (const std::string& line : lines_of(folder / "cameras.txt")) {
    std::istringstream in(line);
    long id = 0;
    std::string kind;
    int width = 0, height = 0;
    std::array<double, 4> k{};
    REQUIRE(in >> id >> kind >> width >> height >> k[0] >> k[1] >> k[2] >> k[3]);
    REQUIRE(kind == "PINHOLE");
    REQUIRE((width > 0 && height > 0));
    model.cameras[id] = k;
  }
  const auto images = lines_of(folder / "images.txt");
  REQUIRE(images.size() % 2 == 0);
  for (std::size_t i = 0; i < images.size(); i += 2) {
    std::istringstream head(images[i]), tail(images[i + 1]);
    long id = 0;
    ColmapImage image;
    REQUIRE(head >> id >> image.qw >> image.qx >> image.qy >> image.qz >> image.tx >> image.ty >> image.tz >>
            image.camera >> image.name);
    for (ColmapPoint2 p{}; tail >> p.x >> p.y >> p.id;) image.points.push_back(p);
    REQUIRE(model.images.emplace(id, image).second);
  }
  for (const std::string& line : lines_of(folder / "points3D.txt")) {
    std::istringstream in(line);
    long id = 0, image = 0;
    int r = 0, g = 0, b = 0;
    ColmapPoint3 point{};
    REQUIRE(in >> id >> point.x >> point.y >> point.z >> r >> g >> b >> point.error);
    for (std::size_t feature = 0; in >> image >> feature;) point.track.emplace_back(image, feature);
    REQUIRE(model.points.emplace(id, point).second);
  }
  return model;
}

// By COLMAP's own rules: x_camera = R(q) X + t, pixel centres at one half.
inline double reprojection_error(const ColmapModel& model, const ColmapImage& image,
                                 const ColmapPoint3& point, std::size_t feature) {
  const double w = image.qw, x = image.qx, y = image.qy, z = image.qz;
  Mat3<double> r;
  r << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
      2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),   //
      2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
  const Vec3<double> seen =
      r * Vec3<double>(point.x, point.y, point.z) + Vec3<double>(image.tx, image.ty, image.tz);
  const auto& k = model.cameras.at(image.camera);
  const double u = k[0] * seen.x() / seen.z() + k[2], v = k[1] * seen.y() / seen.z() + k[3];
  return std::hypot(u - image.points[feature].x, v - image.points[feature].y);
}

}  // namespace sslam::testing
