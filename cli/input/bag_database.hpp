// SPDX-License-Identifier: BSD-3-Clause
// Bags of ROS 2 in SQLite, by libsqlite3.
#pragma once

#include <filesystem>
#include <memory>

#include "sslam/io/bags/bag_database.hpp"

namespace sslam::cli {

// Nothing is written. Throws Error, in a few words, where the file is no such bag.
[[nodiscard]] std::unique_ptr<io::BagDatabase> open_bag_database(const std::filesystem::path& path);

}  // namespace sslam::cli
