// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/pipe_stream.hpp"

#include <utility>
#include <vector>

#include "sslam/core/error.hpp"

namespace sslam::cli {

PipeStream::PipeStream(const StreamName& name, Patience& patience) : pipe_(name.text, patience) {
  const std::string shown = shown_name(name);
  std::vector<std::uint8_t> first(kBytesToTell);
  std::size_t filled = 0;
  while (filled < first.size()) {
    const std::size_t got = pipe_.read(first.data() + filled, first.size() - filled);
    if (got == 0) throw Error(shown + ": ended before the first image");
    filled += got;
  }
  if (begins_image(first))
    splitter_.add(first);
  else
    video_ = std::make_unique<AvStream>(shown, pipe_, std::move(first), patience);
}

bool PipeStream::read(StreamFrame& out) {
  if (video_) return video_->read(out);
  constexpr std::size_t kPiece = 1 << 16;
  std::vector<std::uint8_t> piece(kPiece);
  for (;;) {
    if (auto image = splitter_.next()) {
      out = {};
      out.file = std::move(*image);
      return true;
    }
    const std::size_t got = splitter_.hopeless() ? 0 : pipe_.read(piece.data(), piece.size());
    if (got == 0) return false;
    splitter_.add(Bytes(piece).first(got));
  }
}

}  // namespace sslam::cli
