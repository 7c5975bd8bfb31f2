// SPDX-License-Identifier: BSD-3-Clause
// `sslam export`: what it writes, read back by the rules of the programs that it is for.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/glb_file.hpp"
#include "cli/results/floor_plan.hpp"
#include "cli/results/map_glb.hpp"
#include "cli/room_copy.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "support/catch.hpp"
#include "support/colmap_model.hpp"
#include "support/map_scene.hpp"

namespace export_test {

namespace fs = std::filesystem;
using namespace sslam::testing;

namespace {

Outcome export_run(const fs::path& run, const std::string& options) {
  return run_program("export " + run.string() + " " + options);
}

// Of a part of a mesh, each with a place and a colour.
std::size_t vertices_of(const Glb& glb, const nlohmann::json& primitive) {
  const auto& accessors = glb.json["accessors"];
  const auto& places = accessors[primitive["attributes"]["POSITION"].get<std::size_t>()];
  const auto& colours = accessors[primitive["attributes"]["COLOR_0"].get<std::size_t>()];
  const std::size_t count = places["count"];
  REQUIRE(part(glb, places["bufferView"]).size() == 12 * count);
  REQUIRE(part(glb, colours["bufferView"]).size() == 4 * count);
  REQUIRE(colours["count"] == count);
  return count;
}

// One run for the tests that only read it.
const RoomCopy& tracked_room() {
  static const RoomCopy copy;
  static const Outcome outcome = copy.run("--normals depth");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  return copy;
}

}  // namespace

TEST_CASE("export writes a COLMAP model whose points project to its features") {
  const RoomCopy& room = tracked_room();
  const fs::path out = room.scratch.path() / "model";
  const Outcome outcome = export_run(room.out, "--format colmap --out " + out.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const ColmapModel model = read_model(out);
  const auto metrics = room.metrics();
  REQUIRE(model.cameras.size() == 1);
  REQUIRE(model.cameras.begin()->second[2] == Approx(240));  // the middle of 480 pixels, from their corner
  REQUIRE(model.images.size() == metrics["keyframes"]);
  REQUIRE(model.points.size() > 100);
  std::vector<double> errors;
  std::size_t tracks = 0, referred = 0;
  for (const auto& [id, point] : model.points) {
    REQUIRE(point.track.size() >= 2);
    double sum = 0;
    for (const auto& [image_id, feature] : point.track) {
      const ColmapImage& image = model.images.at(image_id);
      REQUIRE(image.points.at(feature).id == id);  // both files say the same
      errors.push_back(reprojection_error(model, image, point, feature));
      sum += errors.back();
    }
    tracks += point.track.size();
    REQUIRE(point.error == Approx(sum / static_cast<double>(point.track.size())).margin(2e-3));
  }
  for (const auto& [id, image] : model.images) {
    REQUIRE(fs::exists(room.folder / "rgb" / image.name));
    for (const ColmapPoint2& p : image.points) referred += p.id != -1 ? 1U : 0U;
  }
  REQUIRE(referred == tracks);
  std::sort(errors.begin(), errors.end());
  CHECK(errors[errors.size() / 2] < 1);
  CHECK(errors[errors.size() * 9 / 10] < 3);
}

TEST_CASE("export gives COLMAP points their colours, and the same model in binary form") {
  const RoomCopy& room = tracked_room();
  const fs::path out = room.scratch.path() / "coloured";
  REQUIRE(export_run(room.out, "--format colmap --out " + out.string()).code == 0);
  std::size_t grey = 0, all = 0;
  for (const std::string& line : lines_of(out / "points3D.txt")) {
    const auto numbers = numbers_of(line);
    ++all;
    grey += numbers.at(4) == 128 && numbers.at(5) == 128 && numbers.at(6) == 128 ? 1U : 0U;
  }
  CHECK(grey * 20 < all);
  const auto number_at = [](const std::string& bytes, std::size_t at, auto value) {
    REQUIRE(bytes.size() >= at + sizeof value);
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const ColmapModel model = read_model(out);
  const std::string cameras = text_of(out / "cameras.bin"), images = text_of(out / "images.bin"),
                    points = text_of(out / "points3D.bin");
  CHECK(cameras.size() == 8 + 4 + 4 + 8 + 8 + 4 * 8);
  CHECK(number_at(cameras, 12, std::int32_t{}) == 1);  // PINHOLE
  CHECK(number_at(cameras, 16, std::uint64_t{}) == 480);
  CHECK(number_at(cameras, 48, double{}) == Approx(240));
  CHECK(number_at(images, 0, std::uint64_t{}) == model.images.size());
  std::size_t size = 8;
  for (const auto& [id, image] : model.images) {
    CHECK(number_at(images, size, std::uint32_t{}) == static_cast<std::uint32_t>(id));
    CHECK(number_at(images, size + 36, double{}) == Approx(image.tx).margin(1e-11));
    CHECK(images.compare(size + 64, image.name.size() + 1, image.name.c_str(), image.name.size() + 1) == 0);
    size += 64 + image.name.size() + 1 + 8 + 24 * image.points.size();
  }
  CHECK(images.size() == size);
  CHECK(number_at(points, 0, std::uint64_t{}) == model.points.size());
  size = 8;
  for (const auto& [id, point] : model.points) {
    CHECK(number_at(points, size, std::uint64_t{}) == static_cast<std::uint64_t>(id));
    CHECK(number_at(points, size + 16, double{}) == Approx(point.y).margin(1e-6));
    CHECK(number_at(points, size + 43, std::uint64_t{}) == point.track.size());
    size += 8 + 24 + 3 + 8 + 8 + 8 * point.track.size();
  }
  CHECK(points.size() == size);
}

TEST_CASE("export gives the camera of the images, also where they were shrunk to be worked on") {
  const RoomCopy copy;
  const Outcome run = copy.run("--longest-side 320");
  INFO(run.text);
  REQUIRE(run.code == 0);
  REQUIRE(export_run(copy.out, "--format colmap").code == 0);
  const auto settings = copy.metrics()["settings"];
  REQUIRE(settings["working_size"][0] == 320);
  const ColmapModel model = read_model(copy.out / "colmap");
  REQUIRE(model.cameras.size() == 1);
  CHECK(model.cameras.begin()->second[0] == Approx(settings["pinhole"][0].get<double>()));
  CHECK(model.cameras.begin()->second[2] == Approx(240));
  CHECK(numbers_of(lines_of(copy.out / "colmap/cameras.txt")[0].substr(10)).at(0) == 480);
  std::vector<double> errors;
  double right = 0;
  for (const auto& [id, point] : model.points)
    for (const auto& [image, feature] : point.track) {
      errors.push_back(reprojection_error(model, model.images.at(image), point, feature));
      right = std::max(right, model.images.at(image).points.at(feature).x);
    }
  REQUIRE(errors.size() > 100);
  std::sort(errors.begin(), errors.end());
  CHECK(errors[errors.size() / 2] < 1.5);
  CHECK(right > 400);
}

TEST_CASE("export writes what nerfstudio reads: the images' camera, poses with y up and z back, points") {
  const RoomCopy& room = tracked_room();
  const fs::path out = room.scratch.path() / "nerf";
  const Outcome outcome = export_run(room.out, "--format nerfstudio --out " + out.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto json = nlohmann::json::parse(text_of(out / "transforms.json"));
  CHECK(json["camera_model"] == "OPENCV");
  CHECK(json["w"] == 480);
  CHECK(json["cx"].get<double>() == Approx(240));
  REQUIRE(json["frames"].size() == room.metrics()["keyframes"].get<std::size_t>());
  // The same points land on the same pixels as in COLMAP's model.
  REQUIRE(export_run(room.out, "--format colmap --out " + (out / "colmap").string()).code == 0);
  const ColmapModel model = read_model(out / "colmap");
  for (const auto& frame : json["frames"]) {
    const fs::path file = out / frame["file_path"].get<std::string>();
    CHECK(fs::exists(file));
    Eigen::Matrix4d world_from_gl;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) world_from_gl(r, c) = frame["transform_matrix"][r][c].get<double>();
    CHECK(world_from_gl.topLeftCorner<3, 3>().determinant() == Approx(1));
    const auto image = std::find_if(model.images.begin(), model.images.end(),
                                    [&](const auto& entry) { return entry.second.name == file.filename(); });
    REQUIRE(image != model.images.end());
    const Eigen::Matrix4d gl_from_world = world_from_gl.inverse();
    std::size_t seen = 0;
    for (const auto& [id, point] : model.points)
      for (const auto& [image_id, feature] : point.track) {
        if (image_id != image->first) continue;
        const Eigen::Vector4d x = gl_from_world * Eigen::Vector4d(point.x, point.z, -point.y, 1);
        CHECK(x.z() < 0);
        const double u = json["fl_x"].get<double>() * x.x() / -x.z() + json["cx"].get<double>();
        const double v = json["cy"].get<double>() - json["fl_y"].get<double>() * x.y() / -x.z();
        const auto& at = image->second.points.at(feature);
        seen += std::hypot(u - at.x, v - at.y) < 5 ? 1U : 0U;
      }
    CHECK(seen > 20);
  }
  CHECK(text_of(out / "points.ply").find("element vertex ") != std::string::npos);
}

TEST_CASE(
    "export --images writes the keyframes' images without the bend of the lens, and a camera without it") {
  const ScratchFolder scratch;
  const fs::path bent = scratch.path() / "bent", run = scratch.path() / "run", out = scratch.path() / "out";
  // The shared room through another lens.
  REQUIRE(run_program("synth " + bent.string() + " --quiet --frames " + std::to_string(kFrames) +
                      " --seed 3 --size 480x360 --lens -0.2,0.05")
              .code == 0);
  REQUIRE(run_program("run " + bent.string() + " --quiet --normals none --calibration fixed --out " +
                      run.string())
              .code == 0);
  for (const char* format : {"nerfstudio", "colmap"}) {
    const Outcome outcome =
        export_run(run, std::string("--images --format ") + format + " --out " + out.string());
    INFO(outcome.text);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.text.find(" undistorted images") != std::string::npos);
    CHECK(outcome.text.find("note") == std::string::npos);
  }
  const auto json = nlohmann::json::parse(text_of(out / "transforms.json"));
  CHECK(json["k1"] == 0);
  REQUIRE(json["frames"].size() > 2);
  const ColmapModel model = read_model(out);
  for (const auto& frame : json["frames"]) {
    const std::string path = frame["file_path"];
    const std::string name = fs::path(path).filename();
    CHECK(path == "images/" + name);
    CHECK(std::any_of(model.images.begin(), model.images.end(),
                      [&](const auto& entry) { return entry.second.name == name; }));
    const auto middle_of = [](const fs::path& file) {
      const cv::Mat image = cv::imread(file.string(), cv::IMREAD_COLOR);
      REQUIRE(image.size() == cv::Size(480, 360));
      return image(cv::Rect(40, 40, 400, 280)).clone();
    };
    const cv::Mat straight = middle_of(out / path), wanted = middle_of(room() / "rgb" / name),
                  through_lens = middle_of(bent / "rgb" / name);
    CHECK(cv::norm(straight, wanted, cv::NORM_L1) < 0.5 * cv::norm(through_lens, wanted, cv::NORM_L1));
  }
  require_misused(export_run(run, "--images --format ply"),
                  "--images: needs --format colmap, depth or nerfstudio");
  fs::remove_all(bent);
  require_refused(export_run(run, "--images --format colmap --out " + (out / "gone").string()),
                  bent.string());
  CHECK_FALSE(fs::exists(out / "gone/cameras.txt"));
}

TEST_CASE("export writes trajectories as TUM's and KITTI's tools read them") {
  const RoomCopy& room = tracked_room();
  REQUIRE(export_run(room.out, "--format tum").code == 0);
  std::vector<std::string> ignored;
  const auto poses = sslam::io::read_trajectory(room.out / "trajectory.txt", ignored);
  const auto tum = lines_of(room.out / "tum/trajectory.txt");
  REQUIRE(tum.size() == poses.size());
  for (std::size_t i = 0; i < tum.size(); ++i) {
    const auto numbers = numbers_of(tum[i]);
    REQUIRE(numbers.size() == 8);
    REQUIRE(numbers[0] == poses[i].stamp);
    const auto q = poses[i].world_from_cam.rotation.quaternion();
    const auto& t = poses[i].world_from_cam.translation;
    const double wanted[] = {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
    for (std::size_t j = 0; j < 7; ++j) REQUIRE(std::abs(numbers[j + 1] - wanted[j]) < 2e-9);
  }
  const Outcome outcome = export_run(room.out, "--format kitti");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const auto rows = lines_of(room.out / "kitti/poses.txt"), times = lines_of(room.out / "kitti/times.txt");
  REQUIRE(rows.size() == poses.size());
  REQUIRE(times.size() == poses.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto numbers = numbers_of(rows[i]);
    REQUIRE(numbers.size() == 12);
    REQUIRE(std::stod(times[i]) == poses[i].stamp);
    const sslam::SE3<double>& pose = poses[i].world_from_cam;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        REQUIRE(std::abs(numbers[static_cast<std::size_t>(4 * row + column)] -
                         pose.rotation.matrix()(row, column)) < 1e-7);
      REQUIRE(std::abs(numbers[static_cast<std::size_t>(4 * row + 3)] - pose.translation[row]) < 1e-7);
    }
  }
}

TEST_CASE("export writes the map that the run wrote") {
  const RoomCopy& room = tracked_room();
  REQUIRE(export_run(room.out, "--format ply").code == 0);
  REQUIRE(text_of(room.out / "ply/map.ply") == text_of(room.out / "map.ply"));
}

TEST_CASE("export writes the sparse map as a model that viewers can open") {
  const RoomCopy& room = tracked_room();
  const Outcome outcome = export_run(room.out, "--format glb");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const Glb glb = read_glb(room.out / "glb/model.glb");
  const auto& primitives = glb.json["meshes"][0]["primitives"];
  const auto metrics = room.metrics();
  CHECK(primitives[0]["mode"] == 0);
  CHECK(primitives[1]["mode"] == 1);
  CHECK(vertices_of(glb, primitives[0]) == metrics["points"]);
  CHECK(vertices_of(glb, primitives[1]) == 2 * metrics["lines"].get<std::size_t>());
  const std::size_t places = primitives[0]["attributes"]["POSITION"];
  const std::string bytes = part(glb, glb.json["accessors"][places]["bufferView"]);
  float first = 0;
  std::memcpy(&first, bytes.data(), sizeof first);
  const auto ply = lines_of(room.out / "map.ply");
  const auto head = std::find(ply.begin(), ply.end(), "end_header");
  REQUIRE(head != ply.end());
  CHECK(first == Approx(numbers_of(*(head + 1)).at(0)).margin(1e-5));
}

TEST_CASE("A model of a sparse map has its planes as sheets, and stands upright") {
  MapScene scene({}, sweep(4));
  sslam::Map<double> map = scene.make_landmarks();
  scene.add_planes(map);
  const ScratchFolder scratch;
  const sslam::cli::GlbCounts counts = sslam::cli::write_map_glb(scratch.path() / "map.glb", map, {});
  CHECK(counts.points == 600);
  CHECK(counts.lines == 80);
  REQUIRE(counts.planes == 6);
  const Glb glb = read_glb(scratch.path() / "map.glb");
  const auto& sheets = glb.json["meshes"][0]["primitives"][2];
  CHECK(sheets["mode"] == 4);
  REQUIRE(vertices_of(glb, sheets) == 24);
  const auto& indices = glb.json["accessors"][sheets["indices"].get<std::size_t>()];
  CHECK(indices["count"] == 36);
  const std::string triangles = part(glb, indices["bufferView"]);
  for (std::size_t i = 0; i < triangles.size(); i += 4) CHECK(word_at(triangles, i) < 24);
  const auto& q = glb.json["nodes"][0]["rotation"];
  const Eigen::Quaterniond turn(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(),
                                q[2].get<double>());
  CHECK((turn * -Eigen::Vector3d::UnitY()).y() == Approx(1));  // the map's y is down
}

TEST_CASE("A floor plan has the walls of a room, where they are and as long as they are") {
  MapScene scene({}, sweep(4));  // 8 x 6 metres, y down
  sslam::Map<double> map = scene.make_landmarks();
  scene.add_planes(map);
  const sslam::cli::FloorPlan plan = sslam::cli::make_floor_plan(map, {});
  REQUIRE(plan.walls.size() == 4);
  int along_x = 0;
  for (const auto& wall : plan.walls) {
    const bool x = std::abs(wall.start.x() - wall.end.x()) > 1;
    along_x += x;
    const double length = (wall.end - wall.start).norm();
    CHECK(std::abs(x ? wall.start.y() : wall.start.x()) == Approx(x ? 3 : 4).margin(1e-6));
    CHECK(length > (x ? 7 : 5));
    CHECK(length < (x ? 8 : 6));
  }
  CHECK(along_x == 2);
  CHECK(plan.points.size() == 600);
  CHECK_FALSE(plan.lines.empty());
  CHECK_FALSE(plan.uprights.empty());
}

TEST_CASE("export draws a floor plan") {
  const RoomCopy& room = tracked_room();
  const Outcome outcome = export_run(room.out, "--format floorplan");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  const std::string svg = text_of(room.out / "floorplan/floorplan.svg");
  CHECK(svg.find("<svg ") == 0);
  CHECK(svg.find("[map units]") != std::string::npos);
  CHECK(svg.find(">walls</text>") != std::string::npos);
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("export names the frames of a video, and those of an earlier run") {
  const RoomCopy copy;
  const fs::path video = copy.scratch.path() / "walk.mp4", camera = copy.folder / "camera.yaml";
  REQUIRE(copy.run("--video " + video.string()).code == 0);
  fs::copy_file(copy.out / "map.sslam", copy.scratch.path() / "map.sslam");
  // An overlay video is no recording to measure by, but one that can be tracked.
  write(camera,
        "%YAML:1.0\n---\nCamera.fx: 360\nCamera.fy: 360\nCamera.cx: 239.5\nCamera.cy: 179.5\nCamera.k1: "
        "-0.01\n");
  Outcome outcome = run_program("run " + video.string() + " --quiet --normals none --no-report --camera " +
                                camera.string() + " --out " + copy.out.string());
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  outcome = export_run(copy.out, "--format colmap");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("sslam: note: the model's features and camera are free of lens distortion") == 0);
  REQUIRE(text_of(copy.out / "colmap/images.txt").find(" walk_0000") != std::string::npos);

  fs::remove(camera);
  const RoomCopy other;
  REQUIRE(other.run("--start 30 --map " + (copy.scratch.path() / "map.sslam").string()).code == 0);
  outcome = export_run(other.out, "--format colmap");
  INFO(outcome.text);
  REQUIRE(outcome.code == 0);
  REQUIRE(outcome.text.find("keyframes are in no row of frames.csv") != std::string::npos);
  REQUIRE(text_of(other.out / "colmap/images.txt").find(" keyframe_000000.png\n") != std::string::npos);
}

TEST_CASE("export refuses what it cannot use with one line") {
  const RoomCopy copy;
  const fs::path& scratch = copy.scratch.path();
  require_refused(export_run(scratch / "nowhere", "--format tum"),
                  "nowhere: no such folder; expected the one that");
  require_refused(export_run(copy.folder, "--format tum"), "holds no run that can be read");
  REQUIRE(copy.run("--end 2").code == 1);
  for (const char* format : {"tum", "kitti", "ply", "colmap", "nerfstudio", "depth"})
    require_refused(export_run(copy.out, std::string("--format ") + format), "out: the run tracked no frame");
  REQUIRE(copy.run().code == 0);
  require_refused(export_run(copy.out, "--format depth"),
                  "out: has no model to take depth from: run again with --dense");
  REQUIRE_FALSE(fs::exists(copy.out / "depth"));
  write(scratch / "file", "not a folder");
  require_refused(export_run(copy.out, "--format kitti --out " + (scratch / "file").string()),
                  "file: cannot make this folder");
  fs::resize_file(copy.out / "map.sslam", fs::file_size(copy.out / "map.sslam") / 2);
  require_refused(export_run(copy.out, "--format colmap"), "map.sslam: holds ");
  fs::remove(copy.out / "trajectory.txt");
  require_refused(export_run(copy.out, "--format kitti"), "trajectory.txt: is missing");
  const Outcome unknown = export_run(copy.out, "--format bundler");
  REQUIRE(unknown.code == 2);
  const std::string names = "{colmap,depth,floorplan,glb,kitti,mcap,nerfstudio,ply,tum}";
  REQUIRE(unknown.text.find("sslam: error: --format: bundler not in " + names) == 0);
}

}  // namespace export_test
