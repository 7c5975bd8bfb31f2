// SPDX-License-Identifier: BSD-3-Clause
// The options that say which topics of a bag are meant.
#pragma once

#include <CLI/CLI.hpp>

#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

inline void add_topic_option(CLI::App& command, io::BagTopics& topics) {
  command.add_option("--topic", topics.images, "Topic of a bag's images; not needed if there is only one")
      ->type_name("NAME");
}

inline void add_depth_topic_option(CLI::App& command, io::BagTopics& topics) {
  command
      .add_option("--depth-topic", topics.depth,
                  "Topic of a bag's depth images, registered to the images; not needed if there is only one")
      ->type_name("NAME");
}

}  // namespace sslam::cli
