// SPDX-License-Identifier: BSD-3-Clause
// Archives from the network, which are not trusted: nothing of them lands outside the folder.
#pragma once

#include <filesystem>
#include <string>

#include "sslam/core/error.hpp"

namespace sslam::cli {

// What is wrong with the archive itself, and not with the disk.
struct BadArchive : Error {
  using Error::Error;
};

// The files of a tar archive with gzip's checksum into the folder; a first folder of the archive that is
// called `name` is left out. Throws BadArchive when it is damaged, or holds a path that leads elsewhere.
void unpack(const std::filesystem::path& archive, const std::filesystem::path& folder,
            const std::string& name);

}  // namespace sslam::cli
