// SPDX-License-Identifier: BSD-3-Clause
// The few classes of rclcpp that the node uses, so that it is compiled where there is no ROS 2. A test hands
// messages to subscriptions, and hears what is published.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "../messages.hpp"

namespace rclcpp {

// By topic, whoever takes messages of that type: the node's subscriptions, and the test's.
template <class Message>
std::map<std::string, std::function<void(std::shared_ptr<const Message>)>>& listeners() {
  static std::map<std::string, std::function<void(std::shared_ptr<const Message>)>> all;
  return all;
}

enum ParameterType : std::uint8_t {
  PARAMETER_NOT_SET,
  PARAMETER_BOOL,
  PARAMETER_INTEGER,
  PARAMETER_DOUBLE,
  PARAMETER_STRING
};

class ParameterValue {
 public:
  template <class T>
  explicit ParameterValue(T value) : value_(std::move(value)) {}
  [[nodiscard]] ParameterType get_type() const { return static_cast<ParameterType>(value_.index() + 1); }
  template <class T>
  [[nodiscard]] T get() const {
    return std::get<T>(value_);
  }

 private:
  std::variant<bool, std::int64_t, double, std::string> value_;
};

// What a launch file would set.
inline std::map<std::string, ParameterValue>& overrides() {
  static std::map<std::string, ParameterValue> all;
  return all;
}

class Time {
 public:
  explicit Time(std::int64_t nanoseconds) : nanoseconds_(nanoseconds) {}
  Time(const builtin_interfaces::msg::Time& time) : nanoseconds_(time.sec * kSecond + time.nanosec) {}
  operator builtin_interfaces::msg::Time() const {
    return {static_cast<std::int32_t>(nanoseconds_ / kSecond),
            static_cast<std::uint32_t>(nanoseconds_ % kSecond)};
  }
  [[nodiscard]] double seconds() const { return static_cast<double>(nanoseconds_) / 1e9; }

 private:
  static constexpr std::int64_t kSecond = 1'000'000'000;
  std::int64_t nanoseconds_;
};

class QoS {
 public:
  QoS(std::size_t) {}
  QoS& transient_local() { return *this; }
  QoS& keep_last(std::size_t) { return *this; }
};
class SensorDataQoS : public QoS {
 public:
  SensorDataQoS() : QoS(5) {}
};

struct Logger {};
struct Clock {};

template <class Message>
class Publisher {
 public:
  using SharedPtr = std::shared_ptr<Publisher>;
  explicit Publisher(std::string topic) : topic_(std::move(topic)) {}
  void publish(const Message& message) {
    if (get_subscription_count() > 0) listeners<Message>()[topic_](std::make_shared<Message>(message));
  }
  [[nodiscard]] std::size_t get_subscription_count() const { return listeners<Message>().count(topic_); }

 private:
  std::string topic_;
};

template <class Message>
class Subscription {
 public:
  using SharedPtr = std::shared_ptr<Subscription>;
};

struct NodeParameters {
  [[nodiscard]] const std::map<std::string, ParameterValue>& get_parameter_overrides() const {
    return overrides();
  }
};

class Node {
 public:
  explicit Node(const std::string&) {}
  template <class T>
  T declare_parameter(const std::string& name, const T& usual) {
    const auto found = overrides().find(name);
    return found == overrides().end() ? usual : found->second.get<T>();
  }
  template <class Message>
  typename Publisher<Message>::SharedPtr create_publisher(const std::string& topic, const QoS&) {
    return std::make_shared<Publisher<Message>>(topic);
  }
  template <class Message, class Callback>
  typename Subscription<Message>::SharedPtr create_subscription(const std::string& topic, const QoS&,
                                                                Callback callback) {
    listeners<Message>()[topic] = callback;
    return std::make_shared<Subscription<Message>>();
  }
  [[nodiscard]] const NodeParameters* get_node_parameters_interface() const { return &parameters_; }
  [[nodiscard]] Logger get_logger() const { return {}; }
  [[nodiscard]] std::shared_ptr<Clock> get_clock() const { return clock_; }

 private:
  NodeParameters parameters_;
  std::shared_ptr<Clock> clock_ = std::make_shared<Clock>();
};

void init(int argc, char** argv);  // the test's, and so is what happens while a node waits for messages
void play();

template <class AnyNode>
void spin(const std::shared_ptr<AnyNode>&) {
  play();
}
inline void shutdown() {}

}  // namespace rclcpp

#define RCLCPP_ERROR_THROTTLE(logger, clock, duration, ...)                            \
  ((void)(logger), (void)(clock), (void)(duration), std::fprintf(stderr, __VA_ARGS__), \
   std::fputc('\n', stderr))
#define RCLCPP_WARN_THROTTLE RCLCPP_ERROR_THROTTLE
