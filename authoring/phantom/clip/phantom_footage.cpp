#include "authoring/phantom/clip/phantom_footage.h"

#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/phantom/clip/board.h"
#include "authoring/phantom/phantom_io.h"
#include "simulation/core/option_fields.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::authoring {
namespace {

using Json = nlohmann::json;

ColourImage ImageOf(const cv::Mat& picture) {
  ColourImage image(picture.cols, picture.rows);
  const int channels = picture.channels();
  for (int y = 0; y < picture.rows; ++y) {
    const std::uint8_t* from = picture.ptr<std::uint8_t>(y);
    for (int x = 0; x < picture.cols; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = from[x * channels + (channels == 3 ? c : 0)];
  }
  return image;
}

std::vector<double> Nine(const cv::Matx33d& m) { return {m.val, m.val + 9}; }

// Writes the files into `folder` and returns their description; null without frames.
Json WriteFootage(const std::filesystem::path& folder, const Phantom& phantom,
                  const PhantomFootageOptions& options, const Progress& progress) {
  if (options.footage_frames == 0) return nullptr;
  const Clip clip = FootageClip(phantom, options);
  const RectifiedView view = ViewOf(clip.lens(), RectifyOptions{});
  const char* extension = phantom.options.picture == PictureFormat::kJpg ? "jpg" : "png";
  std::filesystem::create_directory(folder / "footage");
  Json frames = Json::array();
  for (int i = 0; i < clip.frames(); ++i) {
    progress.Step("filming", static_cast<double>(i) / clip.frames());
    const std::string name = fmt::format("footage/{:04d}.{}", i, extension);
    WriteColourImage(folder / name, ImageOf(clip.Frame(i)));
    frames.push_back(
        {{"file", name}, {"panorama_from_rectified", Nine(clip.PanoramaFromRectified(i, view))}});
  }
  const Board board;
  // Tilted view: a frontal picture does not determine the focal length.
  const ScopePose pose = BoardPoses(clip.lens(), board)[1];
  WriteColourImage(folder / "grid.png",
                   ImageOf(DrawBoard(clip.lens(), board, pose, phantom.options.seed)));
  WriteLens(folder / "lens.json", clip.lens());
  return Json{{"lens", "lens.json"},
              {"rectified",
               {{"width", view.width},
                {"height", view.height},
                {"focal_px", view.focal_px},
                {"cx", view.cx},
                {"cy", view.cy}}},
              {"frames", frames},
              {"grid",
               {{"file", "grid.png"},
                {"spacing", board.spacing},
                {"pose",
                 {{"at", {pose.at.x, pose.at.y}},
                  {"distance", pose.distance},
                  {"board_from_camera", Nine(pose.plane_from_camera)}}}}}};
}

}  // namespace

Clip FootageClip(const Phantom& phantom, const PhantomFootageOptions& options) {
  CheckOptions(options);
  const ClipPreset preset = phantom.options.difficulty == Difficulty::kEasy ? ClipPreset::kEasy
                            : phantom.options.difficulty == Difficulty::kMedium
                                ? ClipPreset::kMedium
                                : ClipPreset::kHard;
  const bool is_small = phantom.options.size == PhantomSize::kSmall;
  ClipOptions clip = ClipOptionsOf(preset, is_small ? 400 : 800, is_small ? 320 : 640);
  clip.seed = phantom.options.seed;
  clip.frames = options.footage_frames;
  clip.path = ClipPath::kLoop;
  clip.field_of_view = RadiansFromDegrees(75);
  const ColourImage& picture = phantom.without_tissues.colour;
  return Clip(clip, cv::Mat(picture.height, picture.width, CV_8UC3,
                            const_cast<std::uint8_t*>(picture.rgb.data())));
}

void WritePhantomWithFootage(const std::filesystem::path& folder, const Phantom& phantom,
                             const PhantomFootageOptions& options, const Progress& progress) {
  WritePhantom(folder, phantom, [&](const std::filesystem::path& partial) {
    return WriteFootage(partial, phantom, options, progress);
  });
}

}  // namespace arthro::authoring
