// SPDX-License-Identifier: BSD-3-Clause
#include "cli/dense/model_files.hpp"

#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/results/gltf_file.hpp"
#include "cli/results/run_folder.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  io::OutputFile file(path);
  file.stream() << bytes;
  file.commit();
}

// One row of an OBJ file.
template <int N>
void append_row(std::string& text, const char* key, const Eigen::Matrix<float, N, 1>& values) {
  text += key;
  for (const float value : values) {
    char number[32];
    std::snprintf(number, sizeof number, " %.6g", static_cast<double>(value));
    text += number;
  }
  text += '\n';
}

}  // namespace

TexturedMesh textured_mesh(const dense::DenseModel& model, const Atlas& atlas) {
  constexpr int kQuality = 92;
  TexturedMesh mesh;
  cv::imencode(".jpg", atlas.image, mesh.jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  for (const Chart& chart : atlas.charts) {
    const dense::DensePlane& plane = model.planes[chart.plane];
    const dense::Triangulator cut(plane.polygons[chart.polygon]);
    const auto first = static_cast<std::uint32_t>(mesh.places.size());
    const bool turned = plane.seen_from < 0;
    const Vec3<double> normal = (turned ? -1 : 1) * plane.cells.plane.normal;
    for (const Vec2<double>& u : cut.corners) {
      const Vec2<double> pixel = atlas.pixel(chart, u);
      mesh.places.push_back(plane.cells.place(u).cast<float>());
      mesh.normals.push_back(normal.cast<float>());
      mesh.textures.emplace_back(static_cast<float>((pixel.x() + 0.5) / atlas.image.cols),
                                 static_cast<float>((pixel.y() + 0.5) / atlas.image.rows));
    }
    for (const dense::Triangle& t : cut.triangles)
      for (const std::size_t k : {std::size_t{0}, turned ? std::size_t{2} : std::size_t{1},
                                  turned ? std::size_t{1} : std::size_t{2}})
        mesh.indices.push_back(first + t[k]);
  }
  return mesh;
}

void write_glb(const std::filesystem::path& path, const TexturedMesh& mesh, const Vec3<double>& up) {
  using namespace gltf_names;
  GltfBuffer buffer;
  const std::size_t places = buffer.add(bytes_of(mesh.places), kArrayBuffer),
                    normals = buffer.add(bytes_of(mesh.normals), kArrayBuffer),
                    textures = buffer.add(bytes_of(mesh.textures), kArrayBuffer),
                    triangles = buffer.add(bytes_of(mesh.indices), kIndexBuffer),
                    image = buffer.add({mesh.jpeg.begin(), mesh.jpeg.end()}, 0);
  const std::size_t vertices = mesh.places.size();
  const Json accessors = {
      places_accessor(places, mesh.places),
      {{"bufferView", normals}, {"componentType", kFloat}, {"count", vertices}, {"type", "VEC3"}},
      {{"bufferView", textures}, {"componentType", kFloat}, {"count", vertices}, {"type", "VEC2"}},
      {{"bufferView", triangles},
       {"componentType", kUnsigned},
       {"count", mesh.indices.size()},
       {"type", "SCALAR"}}};
  const Json primitive = {
      {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}, {"indices", 3}, {"material", 0}};
  const Json material = {
      {"name", "planes"},
      {"pbrMetallicRoughness",
       {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
      {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
  const auto list = [](Json element) { return Json::array({std::move(element)}); };
  Json gltf = {{"nodes", list({{"mesh", 0}, {"name", "model"}, {"rotation", turn_to_gltf(up)}})},
               {"meshes", list({{"primitives", list(primitive)}})},
               {"materials", list(material)},
               {"textures", list({{"source", 0}})},
               {"images", list({{"bufferView", image}, {"mimeType", "image/jpeg"}})},
               {"accessors", accessors}};
  write_gltf(path, std::move(gltf), buffer);
}

void write_obj(const std::filesystem::path& folder, const TexturedMesh& mesh, const Vec3<double>& up) {
  const Mat3<float> turn = turn_y_up(up).toRotationMatrix().cast<float>();
  std::string obj = std::string("# planes of a map with the images on them; y is up\nmtllib ") +
                    kModelMaterialFile + "\nusemtl planes\n";
  for (const Vec3<float>& place : mesh.places) append_row<3>(obj, "v", turn * place);
  for (const Vec3<float>& normal : mesh.normals) append_row<3>(obj, "vn", turn * normal);
  for (const Vec2<float>& texture : mesh.textures)  // from the lower left corner
    append_row<2>(obj, "vt", {texture.x(), 1 - texture.y()});
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    obj += 'f';
    for (std::size_t k = i; k < i + 3; ++k) {
      const std::string number = std::to_string(mesh.indices[k] + 1);
      obj += ' ' + number + '/' + number + '/' + number;
    }
    obj += '\n';
  }
  write_bytes(folder / kModelTextureFile,
              {reinterpret_cast<const char*>(mesh.jpeg.data()), mesh.jpeg.size()});
  write_bytes(folder / kModelMaterialFile,
              std::string("newmtl planes\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 0\nmap_Kd ") +
                  kModelTextureFile + "\n");
  write_bytes(folder / kModelObjFile, obj);
}

void write_model_ply(const std::filesystem::path& path, const dense::DenseModel& model, const Atlas& atlas) {
  std::string vertices, faces;
  std::uint32_t vertex_count = 0, face_count = 0;
  for (const Chart& chart : atlas.charts) {
    const dense::DensePlane& plane = model.planes[chart.plane];
    const dense::PlaneCells& cells = plane.cells;
    const dense::Polygon& polygon = plane.polygons[chart.polygon];
    std::vector<std::int64_t> ids(static_cast<std::size_t>((cells.columns + 1) * (cells.rows + 1)), -1);
    const auto vertex = [&](int c, int r) {
      std::int64_t& id = ids[static_cast<std::size_t>(r * (cells.columns + 1) + c)];
      if (id >= 0) return static_cast<std::int32_t>(id);
      const Vec2<double> u = cells.corner(c, r), pixel = atlas.pixel(chart, u);
      for (const float x : Vec3<float>(cells.place(u).cast<float>())) append_bytes(vertices, x);
      const cv::Vec3b& colour =
          atlas.image(std::clamp(static_cast<int>(std::lround(pixel.y())), 0, atlas.image.rows - 1),
                      std::clamp(static_cast<int>(std::lround(pixel.x())), 0, atlas.image.cols - 1));
      for (const int channel : {2, 1, 0}) append_bytes(vertices, colour[channel]);
      id = vertex_count++;
      return static_cast<std::int32_t>(id);
    };
    for (int r = 0; r < cells.rows; ++r)
      for (int c = 0; c < cells.columns; ++c) {
        const Vec2<double> middle = cells.corner(c, r) + Vec2<double>::Constant(cells.cell / 2);
        if (!cells.is_solid(c, r) || !dense::inside(polygon.outer, middle)) continue;
        std::array<std::int32_t, 4> ring{vertex(c, r), vertex(c + 1, r), vertex(c + 1, r + 1),
                                         vertex(c, r + 1)};
        if (plane.seen_from < 0) std::swap(ring[1], ring[3]);
        append_bytes(faces, std::uint8_t{4});
        for (const std::int32_t id : ring) append_bytes(faces, id);
        ++face_count;
      }
  }
  io::OutputFile file(path);
  file.stream()
      << "ply\nformat binary_little_endian 1.0\ncomment squares on the planes of a map\nelement vertex "
      << vertex_count
      << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar "
         "green\nproperty uchar blue\nelement face "
      << face_count << "\nproperty list uchar int vertex_indices\nend_header\n"
      << vertices << faces;
  file.commit();
}

}  // namespace sslam::cli
