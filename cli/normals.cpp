// SPDX-License-Identifier: BSD-3-Clause
// `sslam normals IMAGES`: what the normal network sees, as files for `--normals files:DIR` and as pictures.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/input/camera_options.hpp"
#include "cli/input/frame_reader.hpp"
#include "cli/input/image_camera.hpp"
#include "cli/input/image_file.hpp"
#include "cli/input/normal_files.hpp"
#include "cli/input/open_images.hpp"
#include "cli/input/shipped_model.hpp"
#include "cli/input/topic_options.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/progress_options.hpp"
#include "sslam/io/evaluation/statistics.hpp"
#include "sslam/opencv/normals/onnx_normals.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

struct NormalsSettings {
  std::string images;
  io::BagTopics topics;
  std::string model;  // ONNX file or manifest; empty: the one that comes with sslam
  CameraWish camera;  // empty: what is known about the images, else assumed
  std::string out = "normals";
  Verbosity verbosity = Verbosity::kNormal;
};

OnnxNormals open_model(const std::string& wanted) {
  OnnxNormals model(wanted.empty() ? shipped_model("name one with --model FILE") : fs::path(wanted));
  if (model.manifest().kind != NetworkOutput::kNormals)
    throw Error(model.manifest().file.string() + ": output.kind: sslam normals expected normals, not depth");
  return model;
}

// The field of view that the network knows.
double assumed_focal_per_width(const NetworkInput& input) {
  return input.focal > 0 ? input.focal / input.width : 0.8;
}

// Images must not be overwritten by their own normals.
void prepare_folder(const fs::path& out, const io::Dataset& dataset, const NormalManifest& manifest) {
  std::error_code ignored;
  for (const io::FrameEntry& frame : dataset.frames) {
    if (fs::equivalent(out, folder_of(frame.image), ignored))
      throw Error("--out " + out.string() + ": contains the images themselves; choose another folder");
  }
  io::prepare_output_folder(out);
  write_normal_encoding(out, manifest.plane_sigma_deg);
}

// Image after image through the network and into the folder.
class NormalWriter {
 public:
  std::vector<double> planar_shares, inference_ms;  // one for each image that was written
  std::size_t without_evidence = 0;                 // of these

  NormalWriter(OnnxNormals model, ImageCamera camera, fs::path out)
      : model_(std::move(model)), camera_(std::move(camera)), out_(std::move(out)) {}

  // False, with the reason in `why`, when the image has no normals. Throws Error when they cannot be
  // written.
  [[nodiscard]] bool write(cv::Mat image, const std::string& stem, std::string& why) {
    if (!stems_.insert(stem).second) {
      why = "an earlier image has the same name";
      return false;
    }
    const Camera<double> camera = camera_.of(image);
    const auto start = std::chrono::steady_clock::now();
    const NormalStatus status = model_.infer(image, camera, dense_);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    if (status != NormalStatus::kOk) {
      why = explain(status, image, camera);
      return false;
    }
    const cv::Mat_<cv::Vec3b> picture = normal_picture(dense_, camera, {model_.options.evidence.min_planar});
    write_image(out_ / (stem + ".png"), picture, fast_png());
    write_image(out_ / (stem + "_overlay.jpg"), overlay_normals(image, picture),
                {cv::IMWRITE_JPEG_QUALITY, 90});
    planar_shares.push_back(planar_share(picture));
    inference_ms.push_back(time.count());
    without_evidence += select_normals(dense_, model_.options.evidence, field_).enough ? 0U : 1U;
    return true;
  }

 private:
  [[nodiscard]] std::string explain(NormalStatus status, const cv::Mat& image,
                                    const Camera<double>& camera) const {
    const NetworkInput& input = model_.manifest().input;
    const std::string size = size_text(image.cols, image.rows);
    if (status == NormalStatus::kWrongSize)
      return "has " + size + " pixels, and the camera " + size_text(camera.width, camera.height);
    if (status == NormalStatus::kTooSmall)
      return std::string(name(status)) + ": " + size + " pixels, less than half of " +
             size_text(input.width, input.height);
    return name(status);
  }

  OnnxNormals model_;
  ImageCamera camera_;
  fs::path out_;
  DenseNormals dense_;
  NormalField field_;
  std::set<std::string> stems_;
};

void print_summary(const NormalWriter& writer, const fs::path& model, const fs::path& out,
                   std::size_t images) {
  std::printf("images           %zu of %zu\n", writer.planar_shares.size(), images);
  if (!writer.planar_shares.empty()) {
    std::printf("planar           %.1f %% of the pixels\n",
                100 * io::statistics_of(writer.planar_shares).mean);
    if (writer.without_evidence > 0)
      std::printf("no evidence      in %zu images: too few planar pixels, or normals that disagree\n",
                  writer.without_evidence);
    std::printf("inference        median %.1f ms an image\n", io::statistics_of(writer.inference_ms).median);
  }
  std::printf("model            %s\n", model.c_str());
  std::printf("written to       %s: NAME.png for --normals files:%s, NAME_overlay.jpg to look at\n",
              out.c_str(), out.c_str());
}

void run_normals(const NormalsSettings& settings) {
  const io::Dataset dataset = open_images(settings.images, settings.topics);
  print_warnings(dataset.warnings);
  OnnxNormals model = open_model(settings.model);
  const NormalManifest manifest = model.manifest();
  ImageCamera camera(settings.camera, dataset, assumed_focal_per_width(manifest.input));
  FrameReader reader(dataset);
  prepare_folder(settings.out, dataset, manifest);
  NormalWriter writer(std::move(model), std::move(camera), settings.out);
  std::vector<std::string> failures;
  const bool told = dataset.frames.size() > 1 || settings.verbosity == Verbosity::kJson;
  Progress progress(dataset.frames.size(), told ? settings.verbosity : Verbosity::kQuiet, "normals");
  const Interrupt interrupt;
  for (const io::FrameEntry& entry : dataset.frames) {
    if (Interrupt::asked()) break;
    std::string why;
    const cv::Mat image = reader.read(entry, why);
    if (!image.empty() && !writer.write(image, reader.stem(entry), why))
      why = (folder_of(entry.image) / reader.label(entry)).string() + ": " + why;
    if (!why.empty()) failures.push_back(why);
    progress.show(reader.label(entry));
  }
  progress.finish();
  const bool none = writer.planar_shares.empty(), interrupted = Interrupt::asked();
  if (none && failures.size() == 1 && !interrupted) throw Error(failures.front());
  print_warnings(failures);
  if (none && !interrupted) throw Error(settings.images + ": no image gave normals");
  print_summary(writer, manifest.model, settings.out, dataset.frames.size());
  if (interrupted) {
    print_warning("interrupted; the results until then were written");
    throw Stop{ExitCode::kInterrupted};
  }
}

}  // namespace

void add_normals_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "normals", "Run the normal network on images: normals for later runs, pictures for viewing");
  auto s = std::make_shared<NormalsSettings>();
  command->add_option("IMAGES", s->images, "image, folder of images, dataset, quoted glob, video, or bag")
      ->required();
  add_topic_option(*command, s->topics);
  command
      ->add_option("--model", s->model,
                   "ONNX file with its manifest (.json) beside it; default the network that comes with sslam")
      ->type_name("FILE");
  add_camera_options(*command, s->camera.file, s->camera.focal, s->camera.fov);
  add_undistort_option(*command, s->camera.undistort_fov);
  command->add_option("-o,--out", s->out, "folder for NAME.png (normals), NAME_overlay.jpg and encoding.txt")
      ->capture_default_str()
      ->type_name("DIR");
  add_progress_options(*command, s->verbosity, false);
  command->callback([s] { run_normals(*s); });
}

}  // namespace sslam::cli
