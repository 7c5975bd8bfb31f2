// SPDX-License-Identifier: BSD-3-Clause
#include "cli/report/surface_data.hpp"

#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cli/input/image_file.hpp"
#include "cli/report/packed.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Texture {
  std::vector<unsigned char> jpeg;
  double share = 1;  // of the side of model.glb's
  int quality = 0;   // 0: as it was
};

// As good as fits; nothing where the image cannot be read.
std::optional<Texture> fitted(const std::vector<unsigned char>& jpeg, std::size_t room,
                              std::string& problem) {
  constexpr int kQuality = 80;
  constexpr double kStep = 0.84, kLeast = 0.02;
  if (base64_size(jpeg.size()) <= room) return Texture{jpeg};
  ImageHeader header;
  cv::Mat whole;
  if (check_image("the texture", jpeg, header, problem))
    whole = decode_image("the texture", jpeg, header, cv::IMREAD_COLOR, problem);
  if (whole.empty()) return std::nullopt;
  for (double share = 1; share > kLeast; share *= kStep) {
    Texture texture{{}, share, kQuality};
    cv::Mat smaller = whole;
    if (share < 1) cv::resize(whole, smaller, {}, share, share, cv::INTER_AREA);
    cv::imencode(".jpg", smaller, texture.jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
    if (base64_size(texture.jpeg.size()) <= room) return texture;
  }
  problem = "the texture does not fit into the page";
  return std::nullopt;
}

template <int N>
std::vector<float> flat(const std::vector<Eigen::Matrix<float, N, 1>>& vectors) {
  std::vector<float> values;
  for (const auto& v : vectors) values.insert(values.end(), v.begin(), v.end());
  return values;
}

}  // namespace

Json surface_data(const TexturedMesh& mesh, std::size_t room, std::string& problem) {
  constexpr std::size_t kTextureAtLeast = 500'000;
  const std::size_t numbers =
      base64_size(3 * sizeof(float) * mesh.places.size() + 2 * sizeof(float) * mesh.textures.size() +
                  sizeof(std::uint32_t) * mesh.indices.size());
  if (numbers + kTextureAtLeast > room) {
    problem = std::to_string(mesh.indices.size() / 3) +
              " triangles are more than the page takes: it shows the map's planes as rectangles";
    return nullptr;
  }
  const std::optional<Texture> texture = fitted(mesh.jpeg, room - numbers, problem);
  if (!texture) return nullptr;
  const std::vector<float> places = flat<3>(mesh.places), textures = flat<2>(mesh.textures);
  const std::string_view jpeg(reinterpret_cast<const char*>(texture->jpeg.data()), texture->jpeg.size());
  return {{"places", packed<float, float>("f32", places)},
          {"textures", packed<float, float>("f32", textures)},
          {"indices", packed<std::uint32_t, std::uint32_t>("u32", mesh.indices)},
          {"jpeg", base64(jpeg)},
          {"share", texture->share},
          {"quality", texture->quality}};
}

}  // namespace sslam::cli
