// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/byte_pipe.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sslam/core/error.hpp"

namespace sslam::cli {

BytePipe::BytePipe(const std::string& name, Patience& patience) : patience_(patience) {
  own_ = name != "-";
  // Without a writer, opening a named pipe would wait.
  file_ = own_ ? open(name.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC) : STDIN_FILENO;
  if (file_ < 0 || fcntl(file_, F_GETFD) < 0) throw Error(name + ": cannot read: " + std::strerror(errno));
  if (isatty(file_) != 0)
    throw Error(
        "standard input is a terminal; pipe images in, such as from ffmpeg -f image2pipe -c:v mjpeg -");
}

BytePipe::~BytePipe() {
  if (own_) close(file_);
}

std::size_t BytePipe::read(std::uint8_t* bytes, std::size_t size) {
  while (!patience_.over()) {
    pollfd wait{file_, POLLIN, 0};
    // A named pipe hangs up when its last writer goes, not before the first comes.
    if (poll(&wait, 1, static_cast<int>(Patience::kLook.count())) <= 0) continue;
    const ssize_t got = ::read(file_, bytes, size);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    patience_.heard();
    return got < 0 ? 0 : static_cast<std::size_t>(got);
  }
  return 0;
}

}  // namespace sslam::cli
