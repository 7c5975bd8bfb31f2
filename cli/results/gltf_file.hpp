// SPDX-License-Identifier: BSD-3-Clause
// Binary glTF 2.0: one buffer in parts, and the container around it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sslam/core/types.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {

namespace gltf_names {
inline constexpr int kArrayBuffer = 34962, kIndexBuffer = 34963;
inline constexpr int kByte = 5121, kUnsigned = 5125, kFloat = 5126;
}  // namespace gltf_names

template <class T>
void append_bytes(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Vector>
[[nodiscard]] std::string bytes_of(const std::vector<Vector>& vectors) {
  std::string bytes;
  for (const Vector& v : vectors)
    for (const auto x : v) append_bytes(bytes, x);
  return bytes;
}

[[nodiscard]] inline std::string bytes_of(const std::vector<std::uint32_t>& indices) {
  std::string bytes;
  for (const std::uint32_t i : indices) append_bytes(bytes, i);
  return bytes;
}

// Each part begins at a multiple of four.
class GltfBuffer {
 public:
  std::string bytes;
  nlohmann::ordered_json views = nlohmann::ordered_json::array();

  // The number of its view. target 0: neither vertices nor indices.
  std::size_t add(const std::string& part, int target) {
    nlohmann::ordered_json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", part.size()}};
    if (target != 0) view["target"] = target;
    bytes += part;
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    views.push_back(view);
    return views.size() - 1;
  }
};

// Of positions, which glTF wants with their bounds.
[[nodiscard]] inline nlohmann::ordered_json places_accessor(std::size_t view,
                                                            const std::vector<Vec3<float>>& places) {
  Vec3<float> low = Vec3<float>::Zero(), high = low;
  if (!places.empty()) low = high = places.front();
  for (const Vec3<float>& x : places) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return {
      {"bufferView", view}, {"componentType", gltf_names::kFloat}, {"count", places.size()},
      {"type", "VEC3"},     {"min", {low.x(), low.y(), low.z()}},  {"max", {high.x(), high.y(), high.z()}}};
}

// The turn from the map to a world with y up; `up` is a unit vector of the map.
[[nodiscard]] inline Eigen::Quaterniond turn_y_up(const Vec3<double>& up) {
  return Eigen::Quaterniond::FromTwoVectors(up, Vec3<double>::UnitY());
}

// The same as glTF writes it: x, y, z, w.
[[nodiscard]] inline std::array<double, 4> turn_to_gltf(const Vec3<double>& up) {
  const Eigen::Quaterniond q = turn_y_up(up);
  return {q.x(), q.y(), q.z(), q.w()};
}

// `gltf` has one node, its mesh, unlit materials and accessors; the rest is added. Throws Error when it
// cannot be written.
inline void write_gltf(const std::filesystem::path& path, nlohmann::ordered_json gltf,
                       const GltfBuffer& buffer) {
  using Json = nlohmann::ordered_json;
  gltf["asset"] = {{"version", "2.0"}, {"generator", std::string("sslam ") + SSLAM_VERSION}};
  gltf["extensionsUsed"] = {"KHR_materials_unlit"};
  gltf["scene"] = 0;
  gltf["scenes"] = Json::array({{{"nodes", {0}}}});
  gltf["bufferViews"] = buffer.views;
  gltf["buffers"] = Json::array({{{"byteLength", buffer.bytes.size()}}});
  std::string json = gltf.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string head;
  append_bytes(head, std::uint32_t{0x46546C67});  // "glTF"
  append_bytes(head, std::uint32_t{2});
  append_bytes(head, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.bytes.size()));
  append_bytes(head, static_cast<std::uint32_t>(json.size()));
  append_bytes(head, std::uint32_t{0x4E4F534A});  // "JSON"
  std::string second;
  append_bytes(second, static_cast<std::uint32_t>(buffer.bytes.size()));
  append_bytes(second, std::uint32_t{0x004E4942});  // "BIN"
  io::OutputFile file(path);
  file.stream() << head << json << second << buffer.bytes;
  file.commit();
}

}  // namespace sslam::cli
