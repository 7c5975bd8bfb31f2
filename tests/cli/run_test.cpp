// SPDX-License-Identifier: BSD-3-Clause
// `sslam run` on a rendered room: what it writes, and what bad input gets.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/room_copy.hpp"
#include "sslam/core/types.hpp"
#include "support/catch.hpp"

namespace run_test {

namespace fs = std::filesystem;
using namespace sslam::testing;
using Copy = RoomCopy;

TEST_CASE("run tracks a rendered room and writes every file") {
  const Copy copy;
  const Outcome outcome = copy.run();
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  for (const char* name : {"trajectory.txt", "trajectory_live.txt", "keyframes.txt", "map.ply", "frames.csv",
                           "metrics.json", "topview.svg", "report.html"})
    REQUIRE(fs::file_size(copy.out / name) > 0);
  const auto metrics = copy.metrics();
  REQUIRE(metrics["frames"] == kFrames);
  REQUIRE(metrics["share_tracked"].get<double>() >= 0.9);
  REQUIRE(metrics["read_out_s"] == 0);  // a global shutter
  REQUIRE(metrics["settings"]["parameters"].contains("rotation.squareness"));
  REQUIRE(text_of(copy.out / "trajectory.txt").find("nan") == std::string::npos);
}

TEST_CASE("run --live tracks with mapping in a thread of its own") {
  const Copy copy;
  const Outcome outcome = copy.run("--live");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto metrics = copy.metrics();
  REQUIRE(metrics["settings"]["live"] == true);
  REQUIRE(metrics["frames"] == kFrames);
  REQUIRE(metrics["share_tracked"].get<double>() >= 0.9);
  REQUIRE(metrics["keyframes_not_made"].is_number_unsigned());
  REQUIRE(metrics["times"]["wall_seconds"].get<double>() > (kFrames - 1) / 30.0);  // as long as the recording
  require_misused(copy.run("--live --preset paper"),
                  "--live: not with --preset paper; use one of structure, points, lines");
}

TEST_CASE("run --live hears Ctrl-C while it waits for an image that is an hour away") {
  const Copy copy;
  std::istringstream rows(text_of(copy.folder / "rgb.txt"));
  std::string list, row;
  for (int image = 0; std::getline(rows, row);) {
    if (row.empty() || row.front() == '#') continue;
    const auto blank = row.find(' ');
    list += std::to_string(std::stod(row) + (image++ == 0 ? 0 : 3600)) + row.substr(blank) + '\n';
  }
  write(copy.folder / "rgb.txt", list);
  std::filesystem::remove(copy.folder / "depth.txt");
  std::filesystem::remove(copy.folder / "groundtruth.txt");
  const Outcome outcome =
      interrupt_program("run " + copy.folder.string() + " --live --normals none --out " + copy.out.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 130);
  REQUIRE(copy.metrics()["interrupted"] == true);
  REQUIRE(copy.metrics()["states"]["initialising"] == 1);
  for (const char* name : {"trajectory.txt", "frames.csv", "report.html"})
    REQUIRE(fs::exists(copy.out / name));
}

TEST_CASE("run uses the network that comes with sslam where lines do not suffice, unless told otherwise") {
  const Copy copy;
  Outcome outcome = copy.run_by_default("--end 20");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto metrics = copy.metrics();
  REQUIRE(metrics["settings"]["normals"] == "on-demand");
  REQUIRE(metrics["warnings"].empty());
  const auto& asked = metrics["normals_asked"];
  REQUIRE(asked["frames"] < 20);
  int reasons = 0;
  for (const auto& [reason, count] : asked["reasons"].items()) reasons += count.get<int>();
  REQUIRE(asked["frames"] == reasons);
  outcome = copy.run("--end 20 --normals on-demand");
  REQUIRE(outcome.text.find("normals          computed in " + asked["frames"].dump() + " of 20 frames") !=
          std::string::npos);
  REQUIRE(copy.metrics()["normals_asked"] == asked);
  outcome = copy.run("--end 20 --normals onnx");
  REQUIRE(outcome.code == 0);
  REQUIRE(copy.metrics()["settings"]["normals"] == "onnx");
  REQUIRE(copy.metrics()["normals_asked"]["reasons"]["every frame"] == 20);
  outcome = copy.run_by_default("--end 20 --preset features");  // makes no use of normals
  REQUIRE(outcome.code == 0);
  REQUIRE(copy.metrics()["settings"]["normals"] == "none");
  outcome = copy.run("--end 20 --normals none");
  REQUIRE(outcome.code == 0);
  REQUIRE(copy.metrics()["settings"]["normals"] == "none");
  REQUIRE(copy.metrics()["normals_asked"]["frames"] == 0);
  outcome = copy.run("--end 20 --normals on-demand:files:" + (copy.folder / "normals").string());
  REQUIRE(outcome.code == 0);
  REQUIRE(copy.metrics()["normals_asked"]["frames"] < 20);
}

TEST_CASE("run goes on with lines and features where a network fails") {
  const Copy copy;
  // The tiny model of the tests: no normals from green, nothing planar without green.
  const auto tint = [&](const char* name, double green) {
    const std::string file = (copy.folder / "rgb" / name).string();
    cv::Mat image = cv::imread(file);
    std::vector<cv::Mat> channels;
    cv::split(image, channels);
    channels[0] *= 0.4;
    channels[2] *= 0.15;
    channels[1].setTo(green);
    cv::merge(channels, image);
    REQUIRE(cv::imwrite(file, image, {cv::IMWRITE_JPEG_QUALITY, 100}));
  };
  tint("000030.jpg", 255);
  tint("000031.jpg", 0);
  const fs::path fixtures = SSLAM_FIXTURES;
  std::string manifest = text_of(fixtures / "tiny_normals.json");
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = manifest.find(from);
    REQUIRE(at != std::string::npos);
    manifest.replace(at, from.size(), to);
  };
  replace("tiny_normals.onnx", (fixtures / "tiny_normals.onnx").string());
  replace("\"name\": \"normal\"", "\"name\": \"frail\"");
  write(copy.scratch.path() / "frail.json", manifest);
  const Outcome outcome = copy.run("--normals onnx:" + (copy.scratch.path() / "frail.json").string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("no Manhattan evidence in ") != std::string::npos);
  const auto metrics = copy.metrics();
  const std::string warnings = metrics["warnings"].dump();
  REQUIRE(
      warnings.find("000030.jpg: the network's output is not finite, not of unit length or not in [0, 1]; "
                    "lines alone for this frame") != std::string::npos);
  REQUIRE(warnings.find("000031.jpg") == std::string::npos);  // a view without planes is no fault
  REQUIRE(metrics["frames_without_normal_evidence"] >= 1);
  REQUIRE(metrics["share_tracked"].get<double>() > 0.5);
}

TEST_CASE("run gives the same bits again") {
  const Copy copy;
  REQUIRE(copy.run("--normals depth").code == 0);
  const std::string first = text_of(copy.out / "trajectory.txt"), map = text_of(copy.out / "map.ply");
  REQUIRE(copy.run("--normals depth").code == 0);
  REQUIRE(text_of(copy.out / "trajectory.txt") == first);
  REQUIRE(text_of(copy.out / "map.ply") == map);
}

TEST_CASE("run takes each source of normals and each preset") {
  const Copy copy;
  for (const std::string& options : std::vector<std::string>{
           "--normals depth", "--normals onnx", "--normals files:" + (copy.folder / "normals").string(),
           "--preset paper", "--preset points --normals depth", "--preset lines", "--preset features",
           "--preset odometry"}) {
    const Outcome outcome = copy.run(options);
    INFO(options << "\n" << outcome.text);
    REQUIRE(outcome.code == 0);
    REQUIRE(copy.metrics()["share_tracked"].get<double>() > 0.5);
  }
}

TEST_CASE("run takes its options from a file and its parameters from the command line") {
  const Copy copy;
  write(copy.scratch.path() / "run.toml",
        "stride = 2\npreset = \"features\"\n[set]\nkeyframes.max_turn = 9\nkeyframes.min_gap = 0.5\n");
  const Outcome outcome =
      copy.run("--config " + (copy.scratch.path() / "run.toml").string() + " --set keyframes.min_gap=0.25");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto settings = copy.metrics()["settings"];
  REQUIRE(settings["stride"] == 2);
  REQUIRE(settings["preset"] == "features");
  REQUIRE(settings["parameters"]["keyframes.min_gap"] == 0.25);
  REQUIRE(settings["parameters"]["keyframes.max_turn"].get<double>() == Approx(9));
  write(copy.scratch.path() / "typo.toml", "strid = 2\n");
  require_refused(copy.run("--config " + (copy.scratch.path() / "typo.toml").string()),
                  "'strid' is not an option");
}

TEST_CASE("run sets parameters of the front end") {
  const Copy copy;
  const Outcome outcome =
      copy.run("--end 10 --set points.points=200 --set lines.max_lines=20 --read-out 0.03");
  INFO(outcome.text);
  REQUIRE(fs::exists(copy.out / "frames.csv"));  // whether so few features start a map or not
  REQUIRE(copy.metrics()["settings"]["parameters"]["points.points"] == 200);
  REQUIRE(copy.metrics()["read_out_s"] == 0.03);
  std::istringstream table(text_of(copy.out / "frames.csv"));
  std::string header, row;
  std::getline(table, header);
  const auto column = [](const std::string& line, const std::string& names, const std::string& wanted) {
    std::istringstream cells(line), heads(names);
    std::string cell, head;
    while (std::getline(heads, head, ',') && std::getline(cells, cell, ','))
      if (head == wanted) return std::stoi(cell);
    return -1;
  };
  while (std::getline(table, row)) {
    REQUIRE(column(row, header, "points") > 0);
    REQUIRE(column(row, header, "points") <= 200);
    REQUIRE(column(row, header, "lines") <= 20);
  }
}

TEST_CASE("run lists its parameters without a dataset") {
  const Outcome outcome = run_program("run --list-parameters");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  for (const char* name : {"keyframes.min_shared", "points.points", "lines.merge.max_gap",
                           "normals.depth.noise", "normals.onnx.max_bad_share"})
    REQUIRE(outcome.text.find(name) != std::string::npos);
}

TEST_CASE("run goes on over a single bad frame and names it") {
  const Copy copy;
  const std::string bytes = text_of(copy.folder / "rgb/000030.jpg");
  write(copy.folder / "rgb/000030.jpg", bytes.substr(0, bytes.size() / 2));
  const Outcome outcome = copy.run("--end 40");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("000030.jpg: truncated image; frame skipped") != std::string::npos);
}

TEST_CASE("run tells many bad frames of one kind in one line, and decoders tell nothing") {
  const Copy copy;
  const std::string bytes = text_of(copy.folder / "rgb/000030.jpg");
  for (const char* name : {"rgb/000030.jpg", "rgb/000032.jpg", "rgb/000034.jpg"})
    write(copy.folder / name, bytes.substr(0, bytes.size() / 2));
  // A whole file whose pixels are damaged: libjpeg would complain.
  write(copy.folder / "rgb/000036.jpg", bytes.substr(0, bytes.size() / 2) + "\xff\xd9");
  const Outcome outcome = copy.run("--end 40");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("000030.jpg: truncated image; frame skipped (and 2 more like this)") !=
          std::string::npos);
  REQUIRE(outcome.text.find("000032.jpg") == std::string::npos);
  REQUIRE(outcome.text.find("Corrupt") == std::string::npos);
  REQUIRE(copy.metrics()["warnings"].size() == 3);
}

TEST_CASE("a camera for images of another size, or turned, gets one line before the first frame") {
  const Copy copy;
  const auto refused = [&](const std::string& size, const std::string& what) {
    const fs::path camera = copy.scratch.path() / "other.yaml";
    write(camera, "%YAML:1.0\n---\nCamera.fx: 360\nCamera.fy: 360\nCamera.cx: 180\nCamera.cy: 180\n" + size);
    require_refused(copy.run("--camera " + camera.string()), what);
    REQUIRE_FALSE(fs::exists(copy.out / "frames.csv"));
  };
  refused("Camera.width: 640\nCamera.height: 400\n",
          "other.yaml: is for 640x400 pixels, and the images have 480x360");
  refused("Camera.width: 360\nCamera.height: 480\n", "turned by 90 degrees");
}

TEST_CASE("a mask takes parts of the image out, and one that does not do is refused") {
  const Copy copy;
  const fs::path mask = copy.scratch.path() / "mask.png";
  cv::Mat pixels(360, 480, CV_8UC1, cv::Scalar(255));
  pixels.rowRange(180, 360).setTo(0);
  REQUIRE(cv::imwrite(mask.string(), pixels));
  const Outcome masked = copy.run("--mask " + mask.string());
  INFO(masked.text);
  REQUIRE(masked.code == 0);
  REQUIRE(cv::imwrite(mask.string(), cv::Mat::zeros(360, 480, CV_8UC1)));
  require_refused(copy.run("--mask " + mask.string()), "mask.png: leaves every pixel out");
  REQUIRE(cv::imwrite(mask.string(), cv::Mat::ones(48, 64, CV_8UC1)));
  require_refused(copy.run("--mask " + mask.string()),
                  "mask.png: the mask has 64x48 pixels, and the images 480x360");
  require_refused(copy.run("--mask " + (copy.scratch.path() / "none.png").string()),
                  "none.png: no such image");
}

TEST_CASE("run goes on over an image of another size and names it") {
  const Copy copy;
  const ScratchFolder other;
  REQUIRE(
      run_program("synth " + (other.path() / "small").string() + " --quiet --frames 2 --size 64x48").code ==
      0);
  fs::copy_file(other.path() / "small/rgb/000000.jpg", copy.folder / "rgb/000030.jpg",
                fs::copy_options::overwrite_existing);
  const Outcome outcome = copy.run("--end 40");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("000030.jpg: has 64x48 pixels, and the camera 480x360; frame skipped") !=
          std::string::npos);
}

TEST_CASE("run warns about depth of another shape and uses lines alone for that frame") {
  const Copy copy;
  const ScratchFolder other;
  REQUIRE(
      run_program("synth " + (other.path() / "small").string() + " --quiet --frames 2 --size 64x64").code ==
      0);
  fs::copy_file(other.path() / "small/depth/000000.png", copy.folder / "depth/000030.png",
                fs::copy_options::overwrite_existing);
  const Outcome outcome = copy.run("--end 40 --normals depth");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("000030.jpg: the shape of the normals' input does not fit") != std::string::npos);
}

TEST_CASE("run says when stored normals have another order of axes") {
  const Copy copy;
  write(copy.folder / "normals/encoding.txt", "r=-x g=-y b=-z\n");
  const Outcome outcome = copy.run("--end 40 --normals files:" + (copy.folder / "normals").string());
  INFO(outcome.text);
  REQUIRE(outcome.text.find("most normals point away from the camera") != std::string::npos);
}

TEST_CASE("run finds its place in the map of an earlier run") {
  const Copy copy;
  REQUIRE(copy.run().code == 0);
  const fs::path map = copy.scratch.path() / "map.sslam";
  fs::copy(copy.out / "map.sslam", map);
  const auto first = text_of(copy.out / "trajectory.txt");
  const Outcome again = copy.run("--start 30 --map " + map.string());
  INFO(again.text);
  REQUIRE(again.code == 0);
  REQUIRE(copy.metrics()["tracked_live"] > 25);
  REQUIRE(copy.metrics()["settings"]["map"] == map.string());
  // The same frame, at the same place as in the first run: in the coordinates and the scale of its map.
  const auto position = [](const std::string& trajectory, const std::string& stamp) {
    std::istringstream line(trajectory.substr(trajectory.find("\n" + stamp) + 1));
    sslam::Vec3<double> t;
    double seconds = 0;
    line >> seconds >> t.x() >> t.y() >> t.z();
    return t;
  };
  const auto second = text_of(copy.out / "trajectory.txt");
  const std::string stamp = second.substr(second.rfind('\n', second.size() - 2) + 1, 12);
  const auto path = (position(first, stamp) - position(first, first.substr(0, 12))).norm();
  REQUIRE((position(first, stamp) - position(second, stamp)).norm() < 0.03 * path);

  fs::resize_file(map, fs::file_size(map) / 2);
  require_refused(copy.run("--map " + map.string()), "map.sslam: holds");
  require_refused(copy.run("--map " + (copy.folder / "rgb.txt").string()), "rgb.txt: is no map");
}

TEST_CASE("run begins a new map in another room and says that the two stand apart") {
  const Copy copy;
  const fs::path other = copy.scratch.path() / "other";
  REQUIRE(run_program("synth " + other.string() + " --quiet --frames " + std::to_string(kFrames) +
                      " --seed 8 --size 480x360 --no-depth --no-normals")
              .code == 0);
  std::ofstream list(copy.folder / "rgb.txt", std::ios::app);
  for (int k = 0; k < kFrames; ++k) {
    const std::string name = std::to_string(1000000 + k).substr(1) + ".jpg";
    fs::copy(other / "rgb" / name, copy.folder / "rgb" / ("other_" + name));
    list << 3 + k / 30.0 << " rgb/other_" << name << '\n';
  }
  list.close();
  const Outcome outcome = copy.run("--set atlas.leave_after=0.33");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("maps apart       1, with ") != std::string::npos);
  const auto metrics = copy.metrics();
  REQUIRE(metrics["maps_apart"] == 1);
  REQUIRE(metrics["maps_joined"] == 0);
  REQUIRE(metrics["tracked"] >= metrics["frames_apart"]);
  REQUIRE(metrics["frames_apart"] > kFrames / 2);
  // Only poses of the world that was written.
  const double written_from = metrics["world"] == 0 ? 0 : 3;
  for (const char* name : {"trajectory.txt", "trajectory_live.txt"}) {
    std::istringstream poses(text_of(copy.out / name));
    double stamp = -1;
    for (std::string line; std::getline(poses, line);)
      if (line[0] != '#') {
        stamp = std::stod(line);
        REQUIRE((stamp >= written_from && stamp < written_from + 2.5));
      }
    REQUIRE(stamp > 0);
  }
}

TEST_CASE("run refuses what it cannot use with one line") {
  const Copy copy;
  const auto scratch = [&](const std::string& name) { return (copy.scratch.path() / name).string(); };
  require_refused(run_program("run " + scratch("nowhere")), "nowhere: no such file or folder");
  fs::create_directories(scratch("empty"));
  require_refused(run_program("run " + scratch("empty")), "empty: the folder is empty");
  require_misused(copy.run("--normals velvet"), "--normals velvet");
  require_refused(copy.run("--normals onnx:" + (copy.folder / "camera.yaml").string()), "camera.yaml");
  require_misused(copy.run("--preset velvet"), "--preset velvet");
  require_misused(copy.run("--set keyframes.min_gap=many"), "--set keyframes.min_gap=many");
  require_misused(copy.run("--set keyframes.min_gab=2"),
                  "--set keyframes.min_gab: no such parameter here; did you mean keyframes.min_gap?");
  require_misused(copy.run("--preset features --set rotation.frames=2"), "no such parameter");
  require_misused(copy.run("--set atlas.young_map=2.5"), "--set atlas.young_map=2.5: not a whole number");
  require_misused(copy.run("--set atlas.young_map=1e10"), "out of range: 0 to 1e+06, in count");
  require_misused(copy.run("--set keyframes.max_turn=-8"), "out of range: 0 to 180, in degrees");
  require_misused(copy.run("--set keyframes.min_shared=1.4"),
                  "--set keyframes.min_shared=1.4: out of range: 0 to 1, in share");
  require_misused(copy.run("--set rotation.squareness=3"),
                  "--set rotation.squareness: 3 is not below the 1.5 of rotation.max_sigma: no rotation "
                  "would be trusted");
  require_misused(copy.run("--set rotation.widest_kernel=1"),
                  "--set rotation.narrowest_kernel: 2 is not below the 1 of rotation.widest_kernel");
  require_refused(copy.run("--start 1000"), "no frame from 1000");
  REQUIRE_FALSE(fs::exists(copy.out));  // none of these has begun to write
  write(copy.folder / "camera.yaml",
        "%YAML:1.0\n---\nCamera.fx: 360.0\nCamera.fy: .nan\nCamera.cx: 239.5\nCamera.cy: 179.5\n");
  require_refused(copy.run(), "Camera.fy");
}

TEST_CASE("run refuses an output that cannot be written before it starts") {
  const Copy copy;
  write(copy.scratch.path() / "out", "a file, not a folder");
  require_refused(copy.run(), "out: cannot make this folder");
}

TEST_CASE("run leaves a ground truth on another clock out, with a warning") {
  const Copy copy;
  write(copy.folder / "groundtruth.txt", "9000.0 0 0 0 0 0 0 1\n9001.0 0 0 0 0 0 0 1\n");
  const Outcome outcome = copy.run();
  INFO(outcome.text);
  CHECK(outcome.code == 0);
  CHECK(outcome.text.find("groundtruth.txt: no overlap") != std::string::npos);
  CHECK_FALSE(copy.metrics().contains("trajectory"));
}

TEST_CASE("run writes what it has when it is interrupted") {
  const Copy copy;
  const Outcome outcome =
      interrupt_program("run " + copy.folder.string() + " --normals none --out " + copy.out.string());
  INFO(outcome.text);
  const bool interrupted =
      outcome.text.find("interrupted; the results until then were written") != std::string::npos;
  if (!interrupted) WARN("the run was over before it could be interrupted");
  REQUIRE(fs::exists(copy.out / "metrics.json"));
  REQUIRE(copy.metrics()["interrupted"] == interrupted);
}

TEST_CASE("demo renders, tracks and says where to look") {
  const ScratchFolder scratch;
  const Outcome outcome = run_program("demo " + (scratch.path() / "demo").string() + " --frames 60");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("report.html") != std::string::npos);
  REQUIRE(fs::exists(scratch.path() / "demo/run/map.ply"));
  REQUIRE(text_of(scratch.path() / "demo/run/metrics.json").find("\"normals\": \"on-demand\"") !=
          std::string::npos);
}

}  // namespace run_test
