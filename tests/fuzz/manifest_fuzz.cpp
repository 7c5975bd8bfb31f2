// SPDX-License-Identifier: BSD-3-Clause
// Manifests of networks: what is taken is finite, and names an axis for each channel.
#include <cmath>

#include "fuzz/fuzz_input.hpp"
#include "fuzz/seeds.hpp"
#include "sslam/opencv/normals/normal_manifest.hpp"

namespace manifest_fuzz {

inline const std::vector<std::string>& seeds() {
  static const std::vector<std::string> kSeeds{
      R"({"format": "sslam-normals-1", "model": "a.onnx", "sha256": "", "input": {"name": "image", "width": 320, "height": 240,
          "channels": "rgb", "mean": [123.7, 116.3, 103.5], "scale": [0.017, 0.0175, 0.0174], "focal": 300},
          "output": {"kind": "normals", "name": "normals", "axes": ["x", "y", "z"], "signs": [1, -1, -1], "range": [0, 1],
          "plane_sigma_deg": 5, "mask": "mask", "confidence": "sure"}})",
      R"({"format": "sslam-normals-1", "model": "a.onnx", "input": {"width": 64, "height": 48, "channels": "bgr"},
          "output": {"kind": "inverse_depth", "name": "depth", "scale": 2.5}})"};
  return kSeeds;
}

}  // namespace manifest_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(manifest_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return sslam::fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    const sslam::NormalManifest manifest = sslam::read_normal_manifest(path);
    const auto finite = [](const auto& values) {
      for (const double value : values)
        if (!std::isfinite(value)) std::abort();
    };
    finite(manifest.input.mean);
    finite(manifest.input.scale);
    finite(manifest.range);
    if ((1 << manifest.axis[0] | 1 << manifest.axis[1] | 1 << manifest.axis[2]) != 7) std::abort();
    if (!(manifest.plane_sigma_deg > 0) || !std::isfinite(manifest.depth_scale) ||
        !(manifest.input.focal >= 0))
      std::abort();
  });
}
