// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/textured_mesh.hpp"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cli/results/gltf_file.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  if (at + sizeof(std::uint32_t) > bytes.size()) throw Error("ends too early");
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

// A glTF container: a head, a chunk of JSON, a chunk of bytes.
class GlbReader {
 public:
  explicit GlbReader(std::string_view file) {
    constexpr std::size_t kHead = 12, kChunk = 8;
    if (!file.starts_with("glTF") || word_at(file, 4) != 2) throw Error("is no binary glTF 2.0");
    const std::size_t json_size = word_at(file, kHead), second = kHead + kChunk + json_size;
    const std::size_t binary_size = word_at(file, second);
    if (second + kChunk + binary_size > file.size()) throw Error("ends too early");
    json_ = Json::parse(file.substr(kHead + kChunk, json_size));
    binary_ = file.substr(second + kChunk, binary_size);
  }

  [[nodiscard]] const Json& json() const noexcept { return json_; }

  [[nodiscard]] std::string_view part(std::size_t view) const {
    const Json& entry = json_.at("bufferViews").at(view);
    const auto at = entry.at("byteOffset").get<std::size_t>(),
               size = entry.at("byteLength").get<std::size_t>();
    if (at > binary_.size() || size > binary_.size() - at) throw Error("ends too early");
    return binary_.substr(at, size);
  }

  // The numbers of an accessor, `size` of them together.
  template <class Number>
  [[nodiscard]] std::vector<Number> numbers(const Json& accessor, int component, std::size_t size) const {
    const Json& entry = json_.at("accessors").at(accessor.get<std::size_t>());
    const auto count = entry.at("count").get<std::size_t>();
    const std::string_view bytes = part(entry.at("bufferView").get<std::size_t>());
    if (entry.at("componentType") != component || bytes.size() / sizeof(Number) / size != count)
      throw Error("is not as `sslam run --dense` writes it");
    std::vector<Number> numbers(count * size);
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
    return numbers;
  }

  template <int N>
  [[nodiscard]] std::vector<Eigen::Matrix<float, N, 1>> vectors(const Json& accessor) const {
    const std::vector<float> all = numbers<float>(accessor, gltf_names::kFloat, N);
    std::vector<Eigen::Matrix<float, N, 1>> result;
    for (std::size_t i = 0; i < all.size(); i += N) {
      result.emplace_back(Eigen::Map<const Eigen::Matrix<float, N, 1>>(all.data() + i));
      if (!result.back().allFinite()) throw Error("has a number that is none");
    }
    return result;
  }

 private:
  Json json_;
  std::string_view binary_;
};

TexturedMesh mesh_of(std::string_view file) {
  const GlbReader glb(file);
  const Json& primitive = glb.json().at("meshes").at(0).at("primitives").at(0);
  const Json& attributes = primitive.at("attributes");
  TexturedMesh mesh;
  mesh.places = glb.vectors<3>(attributes.at("POSITION"));
  mesh.normals = glb.vectors<3>(attributes.at("NORMAL"));
  mesh.textures = glb.vectors<2>(attributes.at("TEXCOORD_0"));
  mesh.indices = glb.numbers<std::uint32_t>(primitive.at("indices"), gltf_names::kUnsigned, 1);
  const std::size_t count = mesh.places.size();
  const bool whole =
      mesh.normals.size() == count && mesh.textures.size() == count && mesh.indices.size() % 3 == 0;
  if (!whole || std::any_of(mesh.indices.begin(), mesh.indices.end(), [&](auto i) { return i >= count; }))
    throw Error("has triangles whose corners are missing");
  const std::string_view jpeg = glb.part(glb.json().at("images").at(0).at("bufferView").get<std::size_t>());
  mesh.jpeg.assign(jpeg.begin(), jpeg.end());
  return mesh;
}

}  // namespace

TexturedMesh read_glb(const std::filesystem::path& path) {
  const std::string file = io::read_text(path);
  try {
    return mesh_of(file);
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  } catch (const Json::exception&) {
    throw Error(path.string() + ": is not as `sslam run --dense` writes it");
  }
}

}  // namespace sslam::cli
