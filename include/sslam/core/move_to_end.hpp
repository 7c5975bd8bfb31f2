// SPDX-License-Identifier: BSD-3-Clause
// Moves what one list holds to the end of another.
#pragma once

#include <iterator>
#include <vector>

namespace sslam {

// `from` is empty afterwards.
template <class T>
void move_to_end(std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  from.clear();
}

}  // namespace sslam
