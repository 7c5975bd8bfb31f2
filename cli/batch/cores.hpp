// SPDX-License-Identifier: BSD-3-Clause
// Processor cores, claimed one by one, so that runs side by side keep to a core each and do not starve each
// other.
#pragma once

#include <sched.h>

#include <optional>
#include <vector>

namespace sslam::cli {

// A core that this process has to itself among all batches on this machine, until it is destroyed or the
// process ends, however it does.
class CoreClaim {
 public:
  CoreClaim(CoreClaim&& other) noexcept;
  CoreClaim& operator=(CoreClaim&& other) noexcept;
  ~CoreClaim();

  // The first free core of those that this process may use; nothing when each is claimed.
  [[nodiscard]] static std::optional<CoreClaim> take();

  [[nodiscard]] int core() const noexcept { return core_; }

 private:
  CoreClaim(int core, int socket) noexcept : core_(core), socket_(socket) {}
  int core_ = -1;
  int socket_ = -1;
};

// The cores that this process may use, as taskset, Slurm or a container has left them.
[[nodiscard]] std::vector<int> allowed_cores();

// While it lives, whatever this thread starts keeps to the core; without one, nothing changes.
class KeepToCore {
 public:
  explicit KeepToCore(const std::optional<CoreClaim>& claim) noexcept;
  KeepToCore(const KeepToCore&) = delete;
  KeepToCore& operator=(const KeepToCore&) = delete;
  ~KeepToCore();

 private:
  cpu_set_t before_{};
  bool changed_ = false;
};

}  // namespace sslam::cli
