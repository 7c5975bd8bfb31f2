// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/opencv/camera/camera_file.hpp"

#include <cmath>

#include "fuzz/fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return sslam::fuzzing::read_as_file(data, size, [](const std::filesystem::path& path) {
    const sslam::CameraFile file = sslam::read_camera_file(path);
    if (!(file.camera.pinhole.fx > 0) || !std::isfinite(file.camera.distortion.k1)) std::abort();
  });
}
