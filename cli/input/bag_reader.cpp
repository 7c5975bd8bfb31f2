// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/bag_reader.hpp"

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "cli/input/bag_database.hpp"
#include "cli/input/chunk_codec.hpp"
#include "cli/input/image_file.hpp"
#include "cli/input/ros_image.hpp"

namespace sslam::cli {
namespace {

// `format`: what the message says of the file.
cv::Mat decode_file(std::string_view file, std::string_view format, int flags, const std::string& name,
                    cv::Size expected, std::string& why) {
  const std::vector<std::uint8_t> bytes(file.begin(), file.end());
  ImageHeader header;
  if (!check_image(name, bytes, header, why, expected)) return {};
  cv::Mat image = decode_image(name, bytes, header, flags, why);
  if (image.empty() && header.format == ImageFormat::kOther)
    why = name + ": has the format \"" + io::shown_word(format) +
          "\", which is not read; read are JPEG, PNG, WebP, TIFF and BMP";
  return image;
}

// Says whose reason it is.
cv::Mat named(cv::Mat image, const std::string& name, std::string& why) {
  if (image.empty()) why = name + ": " + why;
  return image;
}

}  // namespace

std::string_view BagReader::message(std::int64_t index) {
  const auto at = static_cast<std::size_t>(index);
  if (index < 0 || at >= stream_.places.size() || stream_.places[at].size == 0) return {};
  const io::MessagePlace& place = stream_.places[at];
  if (held_ != place.chunk) {
    held_.reset();
    if (!read_chunk(bag_.chunks[place.chunk])) return {};
    held_ = place.chunk;
  }
  if (place.begin > bytes_.size() || place.size > bytes_.size() - place.begin) return {};
  return std::string_view(bytes_).substr(place.begin, place.size);
}

bool BagReader::read_chunk(const io::ChunkPlace& chunk) {
  if (open_ != chunk.file) {
    const std::filesystem::path& path = bag_.files[chunk.file];
    database_ = chunk.in_database ? open_bag_database(path) : nullptr;
    if (!chunk.in_database) file_.emplace(path);
    open_ = chunk.file;
  }
  if (!chunk.in_database) return io::read_chunk(*file_, chunk, chunk_codec(), scratch_, bytes_);
  return io::read_database_message(*database_, static_cast<std::int64_t>(chunk.begin), chunk_codec(),
                                   scratch_, bytes_);
}

template <class Decode>
cv::Mat BagReader::read(std::int64_t index, const std::string& name, std::string& why, Decode decode) {
  try {
    const std::string_view bytes = message(index);
    if (bytes.empty()) throw Error("cannot be read from the bag");
    return decode(io::MessageFields(stream_.wire, bytes));
  } catch (const Error& error) {
    why = name + ": " + error.what();
    return {};
  }
}

cv::Mat BagReader::image(std::int64_t index, const std::string& frame, cv::Size expected, std::string& why) {
  const std::string name = frame + " on " + stream_.topic;
  return read(index, name, why,
              [&](const io::MessageFields& fields) { return decode(fields, name, expected, why); });
}

cv::Mat BagReader::decode(const io::MessageFields& fields, const std::string& name, cv::Size expected,
                          std::string& why) const {
  if (stream_.kind == io::BagKind::kImage)
    return named(colour_of(io::read_image_message(fields), expected, why), name, why);
  const io::CompressedImageMessage message = io::read_compressed_image(fields);
  return decode_file(message.data, message.format, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH, name, expected,
                     why);
}

cv::Mat BagReader::depth(std::int64_t index, const std::string& frame, std::string& why) {
  const std::string name = frame + " on " + stream_.topic;
  return read(index, name, why,
              [&](const io::MessageFields& fields) { return decode_depth(fields, name, why); });
}

cv::Mat BagReader::decode_depth(const io::MessageFields& fields, const std::string& name,
                                std::string& why) const {
  if (stream_.kind == io::BagKind::kImage)
    return named(depth_of(io::read_image_message(fields), why), name, why);
  const io::CompressedImageMessage message = io::read_compressed_image(fields);
  if (message.format.find("32FC1") != std::string_view::npos)
    throw Error("has floats as compressedDepth, which is not read; expected 16UC1");
  cv::Mat depth = decode_file(depth_file_of(message), message.format, cv::IMREAD_UNCHANGED, name, {}, why);
  if (!depth.empty() && depth.type() != CV_16UC1) throw Error("is no depth of 16 bit");
  return depth;
}

void list_bag_frames(io::Dataset& dataset, const io::BagTopics& topics) {
  io::fill_bag_frames(dataset, topics, chunk_codec(), open_bag_database);
}

}  // namespace sslam::cli
