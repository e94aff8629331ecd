// Direct pair alignment: CPU time a pair beside the error against exact homographies, for frames
// next to each other and two to five apart, from a prediction that is off (20-60 px and about 3
// degrees) and from nothing. Arguments: folders of gen_scope.py clips; without any the developer's
// copies beside the checkout, with --quick or where those are missing a scene made here.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/panorama/pairs/direct_align.h"
#include "authoring/panorama/preparation/prepare.h"
#include "simulation/core/process_cost.h"
#include "tests/authoring/panorama/pairs/faint_scene.h"
#include "tests/support/build_paths.h"

using namespace arthro;
using namespace arthro::authoring;

namespace {

struct Clip {
  std::string name;
  std::vector<WorkingFrame> frames;
  std::vector<cv::Matx33d> scene_from_frame;  // rectified px
  std::vector<bool> is_blank;
  cv::Point2d centre;     // rectified px
  double rim = 0;         // radius of what the lens shows there
  double nine_reach = 0;  // reach of the eight outer points
};

Clip ReadClip(const std::filesystem::path& folder) {
  nlohmann::json truth;
  std::ifstream(folder / "gt.json") >> truth;
  const auto& params = truth["params"];
  Lens lens;
  lens.width = params["w"], lens.height = params["h"];
  lens.focal_px = truth["f"], lens.cx = truth["cx"], lens.cy = truth["cy"];
  lens.field_of_view = 2 * truth["half_fov_rad"].get<double>();
  lens.circle = {lens.cx, lens.cy, truth["radius"]};
  const double scale = 0.5;
  const Rectifier rectifier(lens, {}, scale);
  const RectifiedView& view = rectifier.view();

  Clip clip;
  clip.name = folder.filename();
  clip.centre = {view.cx, view.cy};
  const auto reach = [&](double share) {
    return view.focal_px * std::tan(2 * std::asin(share * lens.circle.r / (2 * lens.focal_px)));
  };
  clip.rim = reach(0.97);
  clip.nine_reach = reach(0.85);
  // Both are pinholes of one focal length: the truth's pixels differ by where the axis lies.
  const auto& ideal = truth["undist"];
  const cv::Matx33d ideal_from_rectified(1, 0, ideal["cx"].get<double>() - view.cx, 0, 1,
                                         ideal["cy"].get<double>() - view.cy, 0, 0, 1);
  std::vector<cv::Mat> pictures;
  ClipLookBuilder builder;
  for (std::size_t i = 0; i < truth["frames"].size(); ++i) {
    cv::Mat raw, rgb, rectified;
    for (const char* kind : {"png", "jpg"})
      if (const auto file = folder / "frames" / fmt::format("{:04}.{}", i, kind);
          std::filesystem::exists(file))
        raw = cv::imread(file.string());
    cv::cvtColor(raw, rgb, cv::COLOR_BGR2RGB);
    rectifier.Rectify(rgb, rectified);
    builder.Add(rectified, rectifier.mask());
    pictures.push_back(rectified);
    const auto& frame = truth["frames"][i];
    cv::Matx33d h;
    for (int k = 0; k < 9; ++k) h.val[k] = frame["H"][k / 3][k % 3];
    clip.scene_from_frame.push_back(h * ideal_from_rectified);
    clip.is_blank.push_back(frame["blank"]);
  }
  const ClipLook look = builder.Finish();
  for (std::size_t i = 0; i < pictures.size(); ++i)
    clip.frames.push_back(
        Prepare(static_cast<int>(i), pictures[i], scale, rectifier.mask(), look, {}));
  return clip;
}

Clip MadeClip() {
  const test::FaintScene scene;
  Clip clip;
  clip.name = "faint scene";
  const double middle = 0.5 * (test::FaintScene::kSide - 1);
  clip.centre = {middle, middle};
  clip.rim = middle - 6;
  clip.nine_reach = 0.85 * clip.rim;
  for (int i = 0; i < 4; ++i) {
    test::FaintLook look;
    look.seed = static_cast<std::uint64_t>(i) + 1;
    clip.scene_from_frame.push_back(test::FaintScene::Pose(-90 + 60 * i, 20 * i, 0.05 * i));
    clip.frames.push_back(scene.Frame(clip.scene_from_frame.back(), look));
    clip.is_blank.push_back(false);
  }
  return clip;
}

struct Tally {
  int pairs = 0, right = 0, wrong = 0;  // accepted with less than 2 px, with more than 10
  std::vector<double> errors, normalised;
  double cpu_ms = 0;
};

double Quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

// The worst of the nine points of frame a that frame b shows.
double WorstError(const Clip& clip, const cv::Matx33d& estimate, const cv::Matx33d& truth) {
  double worst = 0;
  for (int k = 0; k < 9; ++k) {
    const double r = k == 8 ? 0 : clip.nine_reach, angle = k * CV_PI / 4;
    const cv::Point2d p = clip.centre + r * cv::Point2d(std::cos(angle), std::sin(angle));
    const cv::Point2d there = Apply(truth, p);
    if (cv::norm(there - clip.centre) < clip.rim)
      worst = std::max(worst, cv::norm(Apply(estimate, p) - there));
  }
  return worst;
}

double NormalisedError(const PairEstimate& pair, const cv::Matx33d& truth) {
  cv::Matx<double, 8, 1> d;
  for (int i = 0; i < 4; ++i) {
    const cv::Point2d off =
        Apply(truth, pair.control_in_a[i]) - Apply(pair.b_from_a, pair.control_in_a[i]);
    d(2 * i) = off.x, d(2 * i + 1) = off.y;
  }
  return (d.t() * pair.information * d)(0);
}

// A shift of 20 to 60 px and a turn of some 3 degrees on top of the truth.
cv::Matx33d Off(std::mt19937& random, const cv::Point2d& centre) {
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const double turn = 0.09 * (2 * uniform() - 1), way = 2 * CV_PI * uniform(),
               shift = 20 + 40 * uniform(), c = std::cos(turn), s = std::sin(turn);
  return {c, -s, centre.x - c * centre.x + s * centre.y + shift * std::cos(way),
          s, c,  centre.y - s * centre.x - c * centre.y + shift * std::sin(way),
          0, 0,  1};
}

void Measure(const Clip& clip) {
  const DirectOptions options;
  double start = ProcessCpuMs();
  std::vector<DirectPyramid> pyramids;
  for (const WorkingFrame& frame : clip.frames) pyramids.emplace_back(frame, options);
  const int count = static_cast<int>(clip.frames.size());
  std::printf("%s: %d frames, pyramid %.1f CPU ms\n", clip.name.c_str(), count,
              (ProcessCpuMs() - start) / count);

  Tally tallies[2][2];
  std::mt19937 random(1);
  for (int gap = 1; gap <= 5; ++gap)
    for (int a = 0; a + gap < count; a += gap == 1 ? 1 : 2) {
      const int b = a + gap;
      if (clip.is_blank[a] || clip.is_blank[b]) continue;
      const cv::Matx33d truth = clip.scene_from_frame[b].inv() * clip.scene_from_frame[a];
      const cv::Matx33d predicted = Off(random, clip.centre) * truth;
      for (const bool is_predicted : {true, false}) {
        Tally& tally = tallies[gap > 1][is_predicted];
        start = ProcessCpuMs();
        const auto coarse =
            CoarseAlign(pyramids[a], pyramids[b], is_predicted ? &predicted : nullptr, options);
        std::optional<PairEstimate> pair;
        if (coarse) pair = AlignDirect(pyramids[a], pyramids[b], a, b, *coarse, options, nullptr);
        tally.cpu_ms += ProcessCpuMs() - start;
        ++tally.pairs;
        if (!pair) continue;
        const double error = WorstError(clip, pair->b_from_a, truth);
        tally.right += error < 2;
        tally.wrong += error > 10;
        tally.errors.push_back(error);
        tally.normalised.push_back(NormalisedError(*pair, truth));
      }
    }
  for (const bool is_apart : {false, true})
    for (const bool is_predicted : {false, true}) {
      const Tally& t = tallies[is_apart][is_predicted];
      if (t.pairs == 0) continue;
      double mean = 0;
      for (const double n : t.normalised) mean += n / static_cast<double>(t.normalised.size());
      std::printf(
          "  %-11s %-10s %3d pairs %3zu accepted %3d < 2 px %2d > 10 px | px median %.2f p95 %.2f "
          "max %.2f | d'Ld mean %.1f p95 %.1f (8 expected) | %.1f CPU ms\n",
          is_apart ? "2-5 apart" : "consecutive", is_predicted ? "predicted" : "from none", t.pairs,
          t.errors.size(), t.right, t.wrong, Quantile(t.errors, 0.5), Quantile(t.errors, 0.95),
          Quantile(t.errors, 1), mean, Quantile(t.normalised, 0.95), t.cpu_ms / t.pairs);
    }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  std::vector<std::filesystem::path> folders;
  bool is_quick = false;
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "--quick") == 0)
      is_quick = true;
    else
      folders.emplace_back(argv[i]);
  const auto shared = std::filesystem::path(ARTHRO_SOURCE_DIR).parent_path() / "shared" / "data";
  if (folders.empty() && !is_quick)
    for (const char* name : {"synthetic_easy1", "synthetic_medium1", "synthetic_hard1"})
      if (std::filesystem::exists(shared / name)) folders.push_back(shared / name);
  std::printf("# direct pair alignment | %s\n", ARTHRO_BUILD_TYPE);
  if (folders.empty()) Measure(MadeClip());
  for (const auto& folder : folders) Measure(ReadClip(folder));
}
