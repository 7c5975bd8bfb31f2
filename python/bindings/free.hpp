// SPDX-License-Identifier: BSD-3-Clause
// The interpreter's lock is not held while one of these lives, and Python does not end: a thread that came
// back after its end would take the process down.
#pragma once

#include <nanobind/nanobind.h>

namespace sslam::python {

class Free {
 public:
  Free() = default;  // throws Error when Python is ending
  Free(const Free&) = delete;
  Free& operator=(const Free&) = delete;

 private:
  struct Outside {
    Outside();
    ~Outside();
  };
  Outside outside_;  // counted with the lock held
  nanobind::gil_scoped_release lock_;
};

// At Python's end, waits for the threads that are outside.
void wait_at_exit();

}  // namespace sslam::python
