// SPDX-License-Identifier: BSD-3-Clause
// What one client has subscribed to, and what waits to be sent to it. A client that takes its messages too
// slowly gets the newest ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/foxglove/protocol.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {

using SharedBytes = std::shared_ptr<const std::string>;

struct StreamMessage {
  std::size_t channel = 0;
  std::int64_t time = 0;  // nanoseconds
  SharedBytes bytes;
};

class ClientQueue {
 public:
  // The channels outlive it.
  explicit ClientQueue(std::span<const StreamChannel> channels)
      : channels_(channels), ids_(channels.size()) {}

  // Throws Error for a channel that is not there, one that it has already, or an id that serves already.
  void subscribe(const Subscription& wish) {
    if (wish.channel >= ids_.size()) throw Error("there is no channel " + std::to_string(wish.channel));
    if (ids_[wish.channel])
      throw Error("channel " + std::to_string(wish.channel) + " is subscribed to already");
    for (const auto& id : ids_)
      if (id == wish.id) throw Error("subscription " + std::to_string(wish.id) + " is there already");
    ids_[wish.channel] = wish.id;
  }

  // Throws Error where there is no such subscription.
  void unsubscribe(std::uint32_t id) {
    for (std::size_t channel = 0; channel < ids_.size(); ++channel) {
      if (ids_[channel] != id) continue;
      ids_[channel].reset();
      std::erase_if(waiting_, [channel](const StreamMessage& m) { return m.channel == channel; });
      return;
    }
    throw Error("there is no subscription " + std::to_string(id));
  }

  [[nodiscard]] bool wants(std::size_t channel) const { return ids_[channel].has_value(); }

  // Ignores what it has not subscribed to.
  void add(StreamMessage message) {
    const std::size_t channel = message.channel;
    if (!wants(channel)) return;
    std::size_t before = 0;
    for (const StreamMessage& m : waiting_) before += m.channel == channel ? 1 : 0;
    if (before >= (channels_[channel].newest_only ? 1 : kMostWaiting)) {
      const auto same = [channel](const StreamMessage& m) { return m.channel == channel; };
      waiting_.erase(std::find_if(waiting_.begin(), waiting_.end(), same));
    }
    waiting_.push_back(std::move(message));
  }

  void tell(std::string text) { texts_.push_back(std::move(text)); }

  [[nodiscard]] bool empty() const { return texts_.empty() && waiting_.empty(); }

  // The next text, then the next message in full; `is_text` says which. Not of an empty queue.
  [[nodiscard]] std::string take(bool& is_text) {
    is_text = !texts_.empty();
    if (is_text) {
      std::string text = std::move(texts_.front());
      texts_.pop_front();
      return text;
    }
    const StreamMessage message = std::move(waiting_.front());
    waiting_.pop_front();
    return data_head(*ids_[message.channel], message.time) + *message.bytes;
  }

  // Texts wait in greater number than a client that reads them lets.
  [[nodiscard]] bool is_clogged() const { return texts_.size() > kMostTexts; }

 private:
  static constexpr std::size_t kMostWaiting = 1000, kMostTexts = 100;

  std::span<const StreamChannel> channels_;
  std::vector<std::optional<std::uint32_t>> ids_;  // of the subscription, by channel
  std::deque<std::string> texts_;
  std::deque<StreamMessage> waiting_;
};

}  // namespace sslam::cli
