// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "sslam/manhattan/rotation.hpp"

int main() {
  // Unit surface normals in the camera frame (x right, y down, z forward), towards the camera: three of the
  // floor, three of the wall ahead and three of the wall to the right, by a camera turned 10 degrees right.
  const float xyz[] = {0.01F,  -1, 0,      -0.01F, -1, 0.01F,  0,      -1, -0.01F,
                       0.17F,  0,  -0.98F, 0.18F,  0,  -0.98F, 0.17F,  0,  -0.99F,
                       -0.98F, 0,  -0.17F, -0.99F, 0,  -0.17F, -0.98F, 0,  -0.18F};
  const sslam::NormalView<float> normals{xyz, xyz + 1, xyz + 2, nullptr, 9, 3};  // 9 normals, 3 floats apart
  const sslam::ManhattanPrior<float> prior;  // the rotation of the last frame; the identity at first
  const auto answer = sslam::track_manhattan<float, float>(normals, {}, prior);  // {}: no line segments
  const sslam::Vec3<float> ahead = answer.cam_from_manhattan.matrix().col(2);  // the room's axes are columns
  const float turn = sslam::degrees(std::atan2(-ahead.x(), ahead.z()));
  std::printf("%s: turned %.1f degrees to the right\n", sslam::name(answer.status),
              static_cast<double>(turn));
  return sslam::usable(answer.status) && std::abs(turn - 10) < 0.5F ? 0 : 1;
}
