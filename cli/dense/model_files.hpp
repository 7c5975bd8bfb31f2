// SPDX-License-Identifier: BSD-3-Clause
// A textured model as files: binary glTF 2.0, Wavefront OBJ, and PLY with a colour at every vertex.
#pragma once

#include <filesystem>

#include "cli/dense/plane_texture.hpp"
#include "cli/results/textured_mesh.hpp"

namespace sslam::cli {

[[nodiscard]] TexturedMesh textured_mesh(const dense::DenseModel& model, const Atlas& atlas);

// One mesh, unlit; a node turns `up` (a unit vector of the map) to glTF's +y. Throws Error when it cannot be
// written.
void write_glb(const std::filesystem::path& path, const TexturedMesh& mesh, const Vec3<double>& up);

// The same mesh, turned so that `up` is +y, as the folder's kModelObjFile, kModelMaterialFile and
// kModelTextureFile. Throws Error.
void write_obj(const std::filesystem::path& folder, const TexturedMesh& mesh, const Vec3<double>& up);

// The cells of all planes as squares; their corners are a coloured cloud. Binary. Throws Error.
void write_model_ply(const std::filesystem::path& path, const dense::DenseModel& model, const Atlas& atlas);

}  // namespace sslam::cli
