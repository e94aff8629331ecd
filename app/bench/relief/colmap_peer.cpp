#include "app/bench/relief/colmap_peer.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "authoring/tissue/tetrahedra/child_process.h"
#include "simulation/core/process_cost.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr double kTimeLimit = 3600;  // s of one step
constexpr double kRim = 3;           // px of the round window's soft rim that are masked

std::vector<std::string> NamesOf(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& file : fs::directory_iterator(folder))
    names.push_back(file.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// Lines without comments. An image without points has an empty second line, which counts.
std::vector<std::string> LinesOf(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream text(file);
  for (std::string line; std::getline(text, line);)
    if (!line.starts_with('#')) lines.push_back(line);
  return lines;
}

// Equisolid as the polynomial of OPENCV_FISHEYE: 2 sin(a/2) = a - a³/24 + a⁵/1920 - a⁷/322560.
// COLMAP's origin is the corner of the first pixel.
std::string CameraOf(const Lens& lens) {
  return fmt::format("{0:.9g},{0:.9g},{1:.9g},{2:.9g},{3:.12g},{4:.12g},{5:.12g},0", lens.focal_px,
                     lens.cx + 0.5, lens.cy + 0.5, -1.0 / 24, 1.0 / 1920, -1.0 / 322560);
}

}  // namespace

std::optional<fs::path> FindProgram(std::string_view name, std::string_view path) {
  std::istringstream folders{std::string(path)};
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    std::error_code fault;
    if (fs::is_regular_file(file, fault) && ::access(file.c_str(), X_OK) == 0) return file;
  }
  return std::nullopt;
}

ColmapModel ReadColmapModel(const fs::path& folder, const std::vector<std::string>& names) {
  ColmapModel model;
  const std::vector<std::string> images = LinesOf(folder / "images.txt");
  for (std::size_t i = 0; i < images.size(); i += 2) {
    std::istringstream line(images[i]);
    int image = 0, camera = 0;
    double w = 1, x = 0, y = 0, z = 0;
    Eigen::Vector3d shift;
    std::string name;
    line >> image >> w >> x >> y >> z >> shift.x() >> shift.y() >> shift.z() >> camera >> name;
    const auto at = std::find(names.begin(), names.end(), name);
    if (!line || at == names.end()) continue;
    // x_camera = turn · x_world + shift
    const Eigen::Matrix3d turn = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
    const Eigen::Vector3d centre = -turn.transpose() * shift;
    authoring::PosedFrame frame;
    frame.index = static_cast<int>(at - names.begin());
    frame.is_posed = true;
    for (int k = 0; k < 9; ++k) frame.rotation[static_cast<std::size_t>(k)] = turn(k % 3, k / 3);
    frame.centre = {centre.x(), centre.y(), centre.z()};
    model.frames.push_back(frame);
  }
  for (const std::string& text : LinesOf(folder / "points3D.txt")) {
    std::istringstream line(text);
    double number = 0;
    Eigen::Vector3d point;
    if (line >> number >> point.x() >> point.y() >> point.z()) model.points.push_back(point);
  }
  return model;
}

ColmapModel RunColmap(const fs::path& program, const fs::path& footage, const Lens& lens,
                      const Progress& progress) {
  ColmapModel best;
  if (lens.model != LensModel::kEquisolid) {
    best.outcome = "this comparison knows equisolid lenses only";
    return best;
  }
  const test::TempFolder folder;
  const fs::path database = folder / "colmap.db", mask = folder / "mask.png",
                 sparse = folder / "sparse", text = folder / "text";
  fs::create_directory(sparse);
  fs::create_directory(text);
  cv::Mat window = cv::Mat::zeros(lens.height, lens.width, CV_8U);
  cv::circle(window,
             {static_cast<int>(std::lround(lens.cx)), static_cast<int>(std::lround(lens.cy))},
             static_cast<int>(lens.circle.r - kRim), cv::Scalar(255), cv::FILLED);
  cv::imwrite(mask.string(), window);
  const std::vector<std::string> names = NamesOf(footage);
  const double before = ChildrenCpuMs();
  const auto step = [&](const std::vector<std::string>& words) {
    const authoring::ChildResult ended = authoring::RunChild(program, words, kTimeLimit, progress);
    if (ended.end == authoring::ChildResult::End::kExited && ended.code == 0) return true;
    best.outcome = ended.end == authoring::ChildResult::End::kTimedOut
                       ? fmt::format("{} took more than {:.0f} s", words.front(), kTimeLimit)
                       : fmt::format("{} failed", words.front());
    return false;
  };
  const bool has_run =
      step({"feature_extractor",
            "--database_path",
            database.string(),
            "--image_path",
            footage.string(),
            "--ImageReader.camera_model",
            "OPENCV_FISHEYE",
            "--ImageReader.single_camera",
            "1",
            "--ImageReader.camera_params",
            CameraOf(lens),
            "--ImageReader.camera_mask_path",
            mask.string(),
            "--SiftExtraction.use_gpu",
            "0",
            "--SiftExtraction.num_threads",
            "2",
            "--SiftExtraction.max_num_features",
            "3000",
            "--SiftExtraction.peak_threshold",
            "0.001"}) &&
      step({"exhaustive_matcher", "--database_path", database.string(), "--SiftMatching.use_gpu",
            "0", "--SiftMatching.num_threads", "2"}) &&
      step({"mapper", "--database_path", database.string(), "--image_path", footage.string(),
            "--output_path", sparse.string(), "--Mapper.num_threads", "2",
            "--Mapper.ba_refine_focal_length", "0", "--Mapper.ba_refine_extra_params", "0"});
  if (has_run)
    for (const std::string& name : NamesOf(sparse)) {
      if (!step({"model_converter", "--input_path", (sparse / name).string(), "--output_path",
                 text.string(), "--output_type", "TXT"}))
        continue;
      ColmapModel model = ReadColmapModel(text, names);
      if (model.frames.size() > best.frames.size()) best = std::move(model);
    }
  best.cpu_ms = ChildrenCpuMs() - before;
  if (best.frames.empty() && best.outcome == "done") best.outcome = "no frame has a pose";
  return best;
}

}  // namespace arthro::app
