// SPDX-License-Identifier: BSD-3-Clause
// `sslam fetch NAME...`: public recordings from the network.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/fetch/download.hpp"
#include "cli/fetch/public_sequences.hpp"
#include "cli/fetch/unpack.hpp"
#include "cli/input/open_images.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

struct FetchSettings {
  std::vector<std::string> names;
  std::string out = "data";
  std::string mirror;  // address of a folder with the archives; empty: the publishers'
  bool keep_archive = false;
  Verbosity verbosity = Verbosity::kNormal;
};

std::string sequence_names() {
  std::string names;
  for (const PublicSequence& known : kPublicSequences) io::add_to_list(names, known.name);
  return names;
}

const PublicSequence& find_sequence(const std::string& name) {
  const auto* const found = std::find_if(kPublicSequences.begin(), kPublicSequences.end(),
                                         [&](const PublicSequence& known) { return known.name == name; });
  if (found == kPublicSequences.end())
    throw Error("'" + name + "' is not a sequence that can be fetched; known: " + sequence_names());
  return *found;
}

void list_sequences() {
  for (const PublicSequence& known : kPublicSequences)
    std::printf("%-11s %s%s (%s)\n", std::string(known.name).c_str(), std::string(known.place).c_str(),
                std::string(known.archive).c_str(), std::string(known.terms).c_str());
}

// Throws Error when it is no dataset with ground truth.
io::Dataset open_complete(const fs::path& folder) {
  io::Dataset dataset = dataset_at(folder);
  if (dataset.ground_truth.empty()) throw Error(folder.string() + ": has no ground truth");
  return dataset;
}

void check_unpacked(const fs::path& folder, const fs::path& archive) {
  try {
    (void)open_complete(folder);
  } catch (const Error& error) {
    throw BadArchive(archive.string() + ": does not hold the sequence (" + error.what() + ")");
  }
}

std::string address_of(const FetchSettings& settings, const PublicSequence& sequence) {
  std::string place = settings.mirror.empty() ? std::string(sequence.place) : settings.mirror;
  if (place.back() != '/') place += '/';
  return place + std::string(sequence.archive);
}

// The folder appears under its name when it is complete.
void fetch(const FetchSettings& settings, const PublicSequence& sequence) {
  const fs::path out = settings.out, folder = out / sequence.folder, archive = out / sequence.archive;
  const fs::path unpacked = folder.string() + ".unpacking";
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) {
    if (!fs::exists(archive, ignored)) download(address_of(settings, sequence), archive, settings.verbosity);
    fs::remove_all(unpacked);
    try {
      unpack(archive, unpacked, std::string(sequence.folder));
      check_unpacked(unpacked, archive);
    } catch (const BadArchive& error) {
      fs::remove_all(unpacked, ignored);
      fs::remove(archive, ignored);
      throw Error(std::string(error.what()) + "; removed, fetch it again");
    }
    fs::rename(unpacked, folder);
    if (!settings.keep_archive) fs::remove(archive, ignored);
  }
  const io::Dataset dataset = open_complete(folder);
  std::printf("%-11s %s: %zu frames, %s, with ground truth (%s)\n", std::string(sequence.name).c_str(),
              folder.c_str(), dataset.frames.size(), std::string(layout_name(dataset.layout)).c_str(),
              std::string(sequence.terms).c_str());
}

void run_fetch(const FetchSettings& settings) {
  std::vector<const PublicSequence*> wanted;
  for (const std::string& name : settings.names) wanted.push_back(&find_sequence(name));
  io::prepare_output_folder(settings.out);
  for (const PublicSequence* const sequence : wanted) fetch(settings, *sequence);
}

}  // namespace

void add_fetch_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("fetch", "Download public sequences, verify and unpack them");
  auto s = std::make_shared<FetchSettings>();
  command->add_option("NAMES", s->names, "of sequences: " + sequence_names())->required();
  command->add_option("-o,--out", s->out, "folder for the sequences")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_option("--mirror", s->mirror,
                      "address of a folder with the archives; default the publishers' addresses");
  command->add_flag("--keep-archive", s->keep_archive, "keep the archive beside the unpacked folder");
  const auto list = [] {
    list_sequences();
    throw CLI::Success();
  };
  command->add_flag_callback("--list", list, "print names, addresses and terms, and stop")
      ->trigger_on_parse();
  command->add_flag_callback(
      "--quiet", [s] { s->verbosity = Verbosity::kQuiet; }, "no progress");
  command->callback([s] { run_fetch(*s); });
}

}  // namespace sslam::cli
