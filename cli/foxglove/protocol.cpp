// SPDX-License-Identifier: BSD-3-Clause
#include "cli/foxglove/protocol.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "cli/shell/json_text.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/bags/definitions.hpp"
#include "sslam/io/maps/byte_archive.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

std::uint32_t id_in(const Json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
    throw Error("an id is no number from 0 to 4294967295");
  return value.get<std::uint32_t>();
}

const Json& list_in(const Json& message, const char* name) {
  const auto list = message.find(name);
  if (list == message.end() || !list->is_array()) throw Error(std::string("lacks the list ") + name);
  return *list;
}

const Json& field_in(const Json& entry, const char* name) {
  if (!entry.is_object() || !entry.contains(name)) throw Error(std::string("an entry lacks ") + name);
  return entry[name];
}

}  // namespace

std::string server_info(const std::string& session) {
  return Json{{"op", "serverInfo"},
              {"name", "sslam " SSLAM_VERSION},
              {"capabilities", Json::array()},
              {"sessionId", session}}
      .dump();
}

std::string advertisement(std::span<const StreamChannel> channels) {
  Json list = Json::array();
  for (const StreamChannel& channel : channels)
    list.push_back({{"id", list.size()},
                    {"topic", channel.topic.name},
                    {"encoding", "cdr"},
                    {"schemaName", full_type(channel.topic)},
                    {"schema", io::full_definition(channel.topic.type)},
                    {"schemaEncoding", "ros2msg"}});
  return json_text({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string error_status(const std::string& message) {
  constexpr int kError = 2;
  return json_text({{"op", "status"}, {"level", kError}, {"message", message}});
}

std::string data_head(std::uint32_t subscription, std::int64_t nanoseconds) {
  constexpr std::uint8_t kMessageData = 1;
  io::ByteWriter head;
  head(kMessageData);
  head(subscription);
  head(static_cast<std::uint64_t>(nanoseconds));
  return head.bytes;
}

ClientRequest parse_request(std::string_view text) {
  constexpr int kDeepest = 8;
  const auto shallow = [](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest) throw Error("is nested too deeply");
    return true;
  };
  const Json message = Json::parse(text, shallow, false);
  if (!message.is_object() || !message.contains("op") || !message["op"].is_string())
    throw Error("is no JSON object with an op");
  ClientRequest request;
  const auto op = message["op"].get<std::string>();
  if (op == "subscribe")
    for (const Json& entry : list_in(message, "subscriptions"))
      request.subscribe.push_back({id_in(field_in(entry, "id")), id_in(field_in(entry, "channelId"))});
  if (op == "unsubscribe")
    for (const Json& id : list_in(message, "subscriptionIds")) request.unsubscribe.push_back(id_in(id));
  return request;
}

}  // namespace sslam::cli
