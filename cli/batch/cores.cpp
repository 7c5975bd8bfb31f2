// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/cores.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace sslam::cli {
namespace {

// The claim is a name in the kernel's space of abstract sockets: taken by one process at a time, gone with
// it, and no file. -1 where somebody has it.
int bind_name_of(int core) noexcept {
  const int handle = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (handle < 0) return -1;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const int length =
      std::snprintf(address.sun_path + 1, sizeof address.sun_path - 1, "sslam-batch-core-%d", core);
  const auto size =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + static_cast<std::size_t>(length));
  if (bind(handle, reinterpret_cast<const sockaddr*>(&address), size) == 0) return handle;
  close(handle);
  return -1;
}

}  // namespace

CoreClaim::CoreClaim(CoreClaim&& other) noexcept
    : core_(other.core_), socket_(std::exchange(other.socket_, -1)) {}

CoreClaim& CoreClaim::operator=(CoreClaim&& other) noexcept {
  std::swap(core_, other.core_);
  std::swap(socket_, other.socket_);
  return *this;
}

CoreClaim::~CoreClaim() {
  if (socket_ >= 0) close(socket_);
}

std::optional<CoreClaim> CoreClaim::take() {
  for (const int core : allowed_cores())
    if (const int handle = bind_name_of(core); handle >= 0) return CoreClaim(core, handle);
  return std::nullopt;
}

std::vector<int> allowed_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(core, &set)) cores.push_back(core);
  if (cores.empty()) cores.push_back(0);
  return cores;
}

KeepToCore::KeepToCore(const std::optional<CoreClaim>& claim) noexcept {
  if (!claim || sched_getaffinity(0, sizeof before_, &before_) != 0) return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(claim->core(), &one);
  changed_ = sched_setaffinity(0, sizeof one, &one) == 0;
}

KeepToCore::~KeepToCore() {
  if (changed_) sched_setaffinity(0, sizeof before_, &before_);
}

}  // namespace sslam::cli
