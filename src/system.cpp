// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/basic_system.hpp"

template class sslam::BasicSystem<sslam::ImageFrontend<sslam::NormalChoice>>;
