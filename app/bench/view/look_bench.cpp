#include "app/bench/view/look_bench.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "app/bench/machine_words.h"
#include "app/platform/resource_folder.h"
#include "app/view/still_picture.h"
#include "authoring/footage/find_circle.h"
#include "authoring/footage/footage.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scope/window_lens.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::app {
namespace {

// Centres of the views, as shares of the imaged part's extent in longitude and latitude.
constexpr std::array kLongitudes{0.26, 0.42, 0.58, 0.74};
constexpr std::array kLatitudes{0.34, 0.5, 0.66};
constexpr std::array kDepths{0.24, 0.4};  // share of the radius
constexpr int kMostFrames = 24;
constexpr int kCircleFrames = 12;

// Extent of the imaged part between its 2nd and 98th percentile, rad.
struct PartExtent {
  double low = 0, high = 0;
  double at(double share) const { return low + share * (high - low); }
};
PartExtent ExtentOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return {values[static_cast<std::size_t>(0.02 * last)],
          values[static_cast<std::size_t>(0.98 * last)]};
}

PictureStatistics MeasureWindow(const ColourImage& picture) {
  const double middle = 0.5 * (kStatisticsSize - 1);
  return MeasurePicture(picture, DiscMask(kStatisticsSize, kStatisticsSize, middle, middle,
                                          kMeasuredRadius * 0.5 * kStatisticsSize));
}

LookRow MeasureScene(const LoadedScene& loaded, LookBench& bench, const Progress& progress) {
  LookRow row{"scene", {}, {}};
  // Drawn like the job `view` does it.
  StillPictures pictures(
      loaded,
      simulation::LooksOf(loaded.scene.tissues,
                          simulation::ReadTissuePresets(ResourceFolder() / "presets" / "tissues")));
  bench.drawn_by = pictures.context().description();
  bench.poses = LookPoses(loaded);
  const ScopeSpec& scope = loaded.scene.scope;
  const simulation::ScopeOptics optics = simulation::OpticsOf(scope, loaded.lens);
  for (const simulation::RodPose& pose : bench.poses) {
    progress.Step("scene", static_cast<double>(row.pictures.size()) /
                               static_cast<double>(2 * bench.poses.size()));
    Picture picture = PictureFromPose(pictures.Hold(pose), scope.view_angle, optics.field_of_view);
    picture.lens = optics.lens;
    picture.camera = optics.camera;
    picture.relief = kUsualRelief;
    picture.flecks = FlecksIn(loaded.scene.backdrop);
    row.pictures.push_back(MeasureWindow(pictures.Draw(picture, kStatisticsSize)));
  }
  row.mean = MeanOf(row.pictures);
  return row;
}

// One frame, scaled so that its round window, or else its shorter side, has kStatisticsSize px.
PictureStatistics MeasureFrame(const cv::Mat& rgb, const authoring::ClipCircle& clip) {
  const bool is_round = clip.circle.r > 0;
  const cv::Rect whole(0, 0, rgb.cols, rgb.rows);
  const cv::Rect lit = clip.lit.area() > 0 ? clip.lit & whole : whole;
  const double side = is_round ? 2.0 * clip.circle.r : std::min(lit.width, lit.height);
  const double scale = kStatisticsSize / side;
  cv::Mat scaled;
  cv::resize(rgb(lit), scaled, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  ColourImage picture(scaled.cols, scaled.rows);
  for (int y = 0; y < scaled.rows; ++y)
    std::copy_n(scaled.ptr<std::uint8_t>(y), 3 * scaled.cols, picture.at(0, y));
  const double beyond = 2.0 * (picture.width + picture.height);
  const PictureMask mask =
      is_round ? DiscMask(picture.width, picture.height, scale * (clip.circle.cx + 0.5 - lit.x),
                          scale * (clip.circle.cy + 0.5 - lit.y),
                          kMeasuredRadius * 0.5 * kStatisticsSize)
               : DiscMask(picture.width, picture.height, 0, 0, beyond);
  return MeasurePicture(picture, mask);
}

LookRow MeasureFrames(const std::filesystem::path& path, const Progress& progress) {
  LookRow row{"real frames", {}, {}};
  authoring::Footage footage = authoring::Footage::Open(path);
  cv::Mat rgb;
  int count = 0;
  while (footage.Skip()) ++count;
  const auto every = [&](int wanted) { return std::max(1, (count + wanted - 1) / wanted); };
  authoring::CircleFinder finder;
  footage.Rewind();
  const auto for_each = [&](int step, const auto& take) {
    footage.Rewind();
    for (int i = 0; i < count; ++i) {
      if (i % step != 0) {
        footage.Skip();
        continue;
      }
      if (footage.Next(rgb) && !rgb.empty()) take(rgb);
      progress.Step("real frames", 0.5 + 0.5 * i / count);
    }
  };
  for_each(every(kCircleFrames), [&](const cv::Mat& frame) { finder.Add(frame); });
  const authoring::ClipCircle circle = finder.Find();
  for_each(every(kMostFrames),
           [&](const cv::Mat& frame) { row.pictures.push_back(MeasureFrame(frame, circle)); });
  row.mean = MeanOf(row.pictures);
  if (row.mean.pictures == 0)
    throw Error(Code::kBadData, "no frame shows a picture that could be measured", path);
  return row;
}

nlohmann::json JsonOf(const PictureStatistics& of) {
  return {{"p1", of.p1},           {"p50", of.p50},      {"p99", of.p99},
          {"clipped", of.clipped}, {"black", of.black},  {"gradient", of.gradient},
          {"flat", of.flat},       {"chroma", of.chroma}};
}

}  // namespace

std::vector<simulation::RodPose> LookPoses(const LoadedScene& loaded) {
  const Backdrop& backdrop = loaded.scene.backdrop;
  const ColourImage& panorama = OrEmpty(loaded.panorama);
  const DepthMap& depth = OrEmpty(loaded.depth);
  std::vector<double> longitudes, latitudes;
  const int step = std::max(1, std::max(panorama.width, panorama.height) / 256);
  for (int y = 0; y < panorama.height; y += step)
    for (int x = 0; x < panorama.width; x += step) {
      if (!depth.empty() && x < depth.width && y < depth.height && std::isnan(depth.at(x, y)))
        continue;
      const glm::dvec3 d = DirectionFromPixel(backdrop.projection, glm::dvec2(x, y));
      longitudes.push_back(std::atan2(d.x, d.z));
      latitudes.push_back(-std::asin(std::clamp(d.y, -1.0, 1.0)));
    }
  const PartExtent longitude = ExtentOf(std::move(longitudes)),
                   latitude = ExtentOf(std::move(latitudes));
  std::vector<simulation::RodPose> poses;
  for (const double share : kDepths)
    for (const double row : kLatitudes)
      for (const double column : kLongitudes) {
        simulation::RodPose pose;
        pose.depth = share * backdrop.radius;
        pose.longitude = longitude.at(column);
        // Without a roll the view tilts from the rod towards north.
        pose.latitude = latitude.at(row) - simulation::CentreAngle(loaded.scene.scope.view_angle,
                                                                   pose.depth, backdrop.radius);
        poses.push_back(pose);
      }
  return poses;
}

LookBench RunLookBench(const std::filesystem::path& scene, const std::filesystem::path& frames,
                       const Progress& progress) {
  LookBench bench;
  bench.scene = scene.string();
  bench.frames = frames.string();
  bench.rows.push_back(MeasureScene(LoadScene(scene), bench, progress));
  if (!frames.empty()) bench.rows.push_back(MeasureFrames(frames, progress));
  return bench;
}

std::string TableOf(const LookBench& bench) {
  std::string table = fmt::format(
      "# look of {} | {} poses, window of {} px | {} | drawn by {}\n"
      "{:<14}{:>9}{:>7}{:>7}{:>7}{:>9}{:>8}{:>10}{:>9}{:>9}\n",
      bench.scene, bench.poses.size(), kStatisticsSize, MachineWords(), bench.drawn_by, "",
      "pictures", "p1", "p50", "p99", ">=250 %", "<=5 %", "gradient", "flat %", "chroma");
  for (const LookRow& row : bench.rows) {
    const PictureStatistics& of = row.mean;
    table += fmt::format(
        "{:<14}{:>9}{:>7.1f}{:>7.1f}{:>7.1f}{:>9.2f}{:>8.2f}{:>10.2f}{:>9.1f}"
        "{:>9.1f}\n",
        row.words, of.pictures, of.p1, of.p50, of.p99, 100 * of.clipped, 100 * of.black,
        of.gradient, 100 * of.flat, of.chroma);
  }
  table +=
      "p1, p50, p99: percentiles of grey, 0 to 255; gradient: grey levels per px; flat: share with "
      "at most half a\ngrey level per px; chroma: rms distance of the colours from their mean. "
      "Each value is a mean over the pictures.\n";
  return table;
}

nlohmann::json JsonOf(const LookBench& bench) {
  nlohmann::json rows = nlohmann::json::array();
  for (const LookRow& row : bench.rows) {
    nlohmann::json pictures = nlohmann::json::array();
    for (const PictureStatistics& of : row.pictures)
      if (of.pictures > 0) pictures.push_back(JsonOf(of));
    rows.push_back({{"of", row.words}, {"mean", JsonOf(row.mean)}, {"pictures", pictures}});
  }
  nlohmann::json poses = nlohmann::json::array();
  for (const simulation::RodPose& pose : bench.poses)
    poses.push_back({{"latitude_deg", DegreesFromRadians(pose.latitude)},
                     {"longitude_deg", DegreesFromRadians(pose.longitude)},
                     {"insertion_mm", MmFromMetres(pose.depth)}});
  return {{"schema", "arthroscene.bench.look/1"},
          {"machine", MachineWords()},
          {"drawn_by", bench.drawn_by},
          {"scene", bench.scene},
          {"frames", bench.frames},
          {"poses", poses},
          {"rows", rows}};
}

}  // namespace arthro::app
