// SPDX-License-Identifier: BSD-3-Clause
// `sslam calibrate IMAGES|VIDEO`: a camera file from views of a calibration board.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "cli/calibrate/board_print.hpp"
#include "cli/calibrate/board_views.hpp"
#include "cli/calibrate/calibration.hpp"
#include "cli/calibrate/coverage.hpp"
#include "cli/commands.hpp"
#include "cli/input/camera_yaml.hpp"
#include "cli/input/image_file.hpp"
#include "cli/input/open_images.hpp"
#include "cli/input/topic_options.hpp"
#include "cli/input/video_reader.hpp"
#include "cli/shell/choice_option.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/messages.hpp"
#include "cli/shell/number_checks.hpp"
#include "cli/shell/option_info.hpp"
#include "cli/shell/progress_options.hpp"
#include "sslam/core/types.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

struct CalibrateSettings {
  std::string images;
  io::BagTopics topics;
  std::string print;  // file for the board itself, instead of images; empty: none
  BoardSettings board;
  std::string out = "camera.yaml";
  double frame_rate = 0;  // 0: of the video, else left out
  bool fisheye = false, k3 = false;
  Verbosity verbosity = Verbosity::kNormal;
};

bool parse_board_size(const std::string& text, int& columns, int& rows) {
  int end = 0;
  return std::sscanf(text.c_str(), "%dx%d%n", &columns, &rows, &end) == 2 &&
         end == static_cast<int>(text.size()) && columns >= 3 && rows >= 3 && columns <= 100 && rows <= 100;
}

fs::path picture_path(const fs::path& out) {
  return out.parent_path() / (out.stem().string() + "_coverage.png");
}

void write_camera(const CalibrateSettings& settings, const io::Dataset& dataset,
                  const Calibration& calibration) {
  CameraFile file;
  file.camera = calibration.camera;
  file.wide = calibration.wide;
  file.frame_rate = settings.frame_rate;
  if (file.frame_rate == 0 && dataset.layout == io::Layout::kVideo)
    file.frame_rate = VideoReader(dataset.root).info().frame_rate;
  const std::string remarks =
      cv::format("# sslam calibrate: reprojection error %.3f pixels RMS over %zu views\n", calibration.error,
                 calibration.views.size());
  io::OutputFile out(settings.out);
  out.stream() << camera_yaml(file, remarks);
  out.commit();
  write_image(picture_path(settings.out), coverage_picture(calibration), {});
}

void print_camera(const Calibration& c) {
  const Pinhole<double>& pinhole = c.camera.pinhole;
  const RadTan<double>& lens = c.camera.distortion;
  const double across = degrees(2 * std::atan(0.5 * c.camera.width / pinhole.fx));
  const double down = degrees(2 * std::atan(0.5 * c.camera.height / pinhole.fy));
  std::printf("focal length     %.2f, %.2f pixels, standard deviation %.2f, %.2f\n", pinhole.fx, pinhole.fy,
              c.fx_sigma, c.fy_sigma);
  std::printf("principal point  %.2f, %.2f of %dx%d pixels\n", pinhole.cx, pinhole.cy, c.camera.width,
              c.camera.height);
  if (c.wide) {
    const WideLens& wide = *c.wide;
    std::printf("field of view    %.1f x %.1f degrees\n", degrees(wide.reach({-1, 0}) + wide.reach({1, 0})),
                degrees(wide.reach({0, -1}) + wide.reach({0, 1})));
    std::printf("fisheye          k1 %.5f, k2 %.5f, k3 %.5f, k4 %.5f\n", wide.k[0], wide.k[1], wide.k[2],
                wide.k[3]);
    return;
  }
  std::printf("field of view    %.1f x %.1f degrees\n", across, down);
  std::printf("distortion       k1 %.5f, k2 %.5f, p1 %.5f, p2 %.5f, k3 %.5f\n", lens.k1, lens.k2, lens.p1,
              lens.p2, lens.k3);
}

void print_summary(const CalibrateSettings& settings, const BoardViews& found,
                   const Calibration& calibration) {
  std::printf("views            %zu used of %zu images; %zu without a board, %zu like an earlier one\n",
              calibration.views.size(), found.searched, found.without, found.alike);
  print_camera(calibration);
  std::printf("coverage         %.0f %% of the image, boards tilted up to %.0f degrees\n",
              100 * coverage_share(calibration), calibration.largest_tilt);
  std::printf("reprojection     %.3f pixels RMS; of each view:\n", calibration.error);
  for (std::size_t v = 0; v < calibration.views.size(); ++v)
    std::printf("  %6.3f  %s\n", calibration.view_errors[v], calibration.views[v].name.c_str());
  std::printf("written to       %s, %s\n", settings.out.c_str(), picture_path(settings.out).c_str());
}

void print_board(const CalibrateSettings& settings) {
  const Board board(settings.board);
  io::prepare_output_folder(folder_of(settings.print));
  const PrintedBoard print = printed_board(board.settings(), board.charuco());
  const std::string sheet = write_board(settings.print, print);
  std::printf("written to       %s: %s, %g x %g mm, on %s; print at 100 %%\n", settings.print.c_str(),
              board.text().c_str(), print.width, print.height, sheet.c_str());
}

void run_calibrate(const CalibrateSettings& settings) {
  if (!settings.print.empty()) return print_board(settings);
  if (settings.images.empty()) throw CLI::RequiredError("IMAGES");
  if (settings.fisheye && settings.k3) throw UsageError("--k3: not with --model fisheye, which has k1 to k4");
  const LensKind kind = settings.fisheye ? LensKind::kFisheye
                        : settings.k3    ? LensKind::kThird
                                         : LensKind::kPinhole;
  const io::Dataset dataset = open_images(settings.images, settings.topics);
  print_warnings(dataset.warnings);
  const Board board(settings.board);
  io::prepare_output_folder(folder_of(settings.out));
  const BoardViews found = find_views(dataset, board, settings.verbosity);
  print_warnings(found.unreadable);
  if (found.views.size() < kLeastViews)
    throw Error(settings.images + ": " + std::to_string(found.views.size()) +
                " different views of the board, of " + std::to_string(found.searched) +
                " images; needs at least " + std::to_string(kLeastViews) + ", better 15 or more");
  Calibration calibration;
  try {
    calibration = calibrate(found.views, found.size, kind);
  } catch (const Error& error) {
    throw Error(settings.images + ": " + error.what());
  }
  for (std::size_t v = 0; v < calibration.left_out.size(); ++v)
    print_note(cv::format("left out %s: %.2f pixels, the others %.2f", calibration.left_out[v].name.c_str(),
                          calibration.left_out_errors[v], calibration.error));
  constexpr double kGoodCoverage = 0.6;
  if (const double share = coverage_share(calibration); share < kGoodCoverage)
    print_note(
        cv::format("the corners cover %.0f %% of the image; where there are none the distortion is a guess: "
                   "see %s and add views there",
                   100 * share, picture_path(settings.out).c_str()));
  write_camera(settings, dataset, calibration);
  print_summary(settings, found, calibration);
}

void add_board_options(CLI::App& command, BoardSettings& board) {
  const std::map<std::string, Pattern> patterns{{"chessboard", Pattern::kChessboard},
                                                {"charuco", Pattern::kCharuco}};
  command.add_option("--pattern", board.pattern, "chessboard or charuco; default chessboard")
      ->type_name(words_type({"chessboard", "charuco"}))
      ->transform(CLI::CheckedTransformer(patterns).description(""));
  command
      .add_option_function<std::string>(
          "--size",
          [&board](const std::string& text) { (void)parse_board_size(text, board.columns, board.rows); },
          "COLUMNSxROWS: inner corners of a chessboard, squares of a ChArUco board; default 9x6")
      ->check([](const std::string& text) {
        int columns = 0, rows = 0;
        return parse_board_size(text, columns, rows) ? std::string()
                                                     : "'" + text + "' is not a size such as 9x6 (3 to 100)";
      });
  command.add_option("--square", board.square, "side of a square in metres; default 0.025")
      ->check(finite_number())
      ->check(CLI::PositiveNumber);
  command
      .add_option("--marker", board.marker,
                  "side of a ChArUco marker in metres; default three quarters of a square")
      ->check(finite_number())
      ->check(CLI::PositiveNumber);
  command
      .add_option("--dictionary", board.dictionary,
                  "dictionary of the ChArUco markers: " + dictionary_names())
      ->capture_default_str();
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("calibrate", "Make a camera file from images of a chessboard or a ChArUco board");
  auto s = std::make_shared<CalibrateSettings>();
  CLI::Option* const images =
      command
          ->add_option("IMAGES", s->images, "folder of images, quoted glob, video, or bag; not with --print")
          ->type_name("FILE");
  add_topic_option(*command, s->topics);
  add_board_options(*command, s->board);
  command->add_option("-o,--out", s->out, "camera file; NAME_coverage.png is written beside it")
      ->capture_default_str()
      ->type_name("FILE");
  command
      ->add_option("--fps", s->frame_rate, "frames a second for the camera file; default those of the video")
      ->check(finite_number())
      ->check(CLI::PositiveNumber);
  command->add_flag(
      "--k3", s->k3,
      "estimate a third radial coefficient, for wide lenses with board corners up to the edge of the image");
  static const std::map<std::string, bool> kModels{{"pinhole", false}, {"fisheye", true}};
  add_choice(*command, "--model", s->fisheye, kModels,
             "pinhole, or fisheye (Kannala-Brandt, for lenses that see more than about 120 degrees); default "
             "pinhole");
  command
      ->add_option("--print", s->print,
                   "write the board itself, as PDF or SVG in its true size, and stop: --print board.pdf")
      ->excludes(images)
      ->type_name("FILE");
  add_progress_options(*command, s->verbosity, false);
  command->callback([s] { run_calibrate(*s); });
}

}  // namespace sslam::cli
