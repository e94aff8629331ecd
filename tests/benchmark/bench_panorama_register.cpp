// Registration against exact truth: frames placed and right, their error, what was promised, and
// the CPU time per frame, for each folder given (frames/ and gt.json of the reference generator).
//   bench_panorama_register [--quick] [--method direct|features|both] [--stages pairs|loops|all]
//                           [--focal=FACTOR] [--NAME=VALUE] [--verbose] [FOLDER...]
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "authoring/footage/footage.h"
#include "authoring/lens/rectifier.h"
#include "authoring/panorama/graph/register.h"
#include "authoring/panorama/preparation/prepare.h"
#include "simulation/core/options_json.h"
#include "simulation/core/process_cost.h"
#include "tests/support/panorama/clip_score.h"

namespace {

using namespace arthro;
using namespace arthro::authoring;

struct Sequence {
  std::string name;
  Lens lens;
  std::vector<cv::Matx33d> panorama_from_undistorted;
  std::vector<bool> is_blank;
  double undistorted_cx = 0, undistorted_cy = 0, undistorted_f = 0;
};

Sequence ReadSequence(const std::filesystem::path& folder) {
  std::ifstream file(folder / "gt.json");
  const nlohmann::json gt = nlohmann::json::parse(file);
  Sequence sequence;
  sequence.name = folder.filename().string();
  Lens& lens = sequence.lens;
  lens.width = gt["params"]["w"];
  lens.height = gt["params"]["h"];
  lens.focal_px = gt["f"];
  lens.cx = gt["cx"];
  lens.cy = gt["cy"];
  lens.field_of_view = 2 * gt["half_fov_rad"].get<double>();
  lens.circle = {lens.cx, lens.cy, gt["radius"]};
  sequence.undistorted_cx = gt["undist"]["cx"];
  sequence.undistorted_cy = gt["undist"]["cy"];
  sequence.undistorted_f = gt["undist"]["f"];
  for (const auto& frame : gt["frames"]) {
    cv::Matx33d h;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) h(r, c) = frame["H"][r][c];
    sequence.panorama_from_undistorted.push_back(h);
    sequence.is_blank.push_back(frame["blank"]);
  }
  return sequence;
}

struct Args {
  std::vector<std::filesystem::path> folders;
  RegisterOptions options;
  double focal_factor = 1;
  bool is_verbose = false;
};

void Run(const std::filesystem::path& folder, const Args& args) {
  const Sequence sequence = ReadSequence(folder);
  Lens lens = sequence.lens;
  lens.focal_px *= args.focal_factor;
  const double begin = ProcessCpuMs();
  const RectifyOptions rectify;
  const Rectifier rectifier(lens, rectify, 0.5);
  Footage footage = Footage::Open(folder / "frames");
  std::vector<cv::Mat> pictures;
  double read_ms = 0;
  ClipLookBuilder looks;
  for (cv::Mat rgb;;) {
    const double before = ProcessCpuMs();
    if (!footage.Next(rgb)) break;
    read_ms += ProcessCpuMs() - before;
    pictures.emplace_back();
    rectifier.Rectify(rgb, pictures.back());
    looks.Add(pictures.back(), rectifier.mask());
  }
  const ClipLook look = looks.Finish();
  std::vector<WorkingFrame> frames;
  const PrepareOptions prepare;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    frames.push_back(
        Prepare(static_cast<int>(i), pictures[i], 0.5, rectifier.mask(), look, prepare));
    pictures[i].release();
  }
  const double prepared = ProcessCpuMs();
  RegisterReport report;
  const auto results =
      Register(frames, rectifier.view(), rectifier.mask(), args.options, &report, {}, &lens);
  const double registered = ProcessCpuMs();

  const RectifiedView& view = rectifier.view();
  // The nine points, one centre and a ring, as angles off the axis: what they are, and what the
  // lens that was used takes them for. On them a wrong focal length is a zoom.
  const double ring = 0.85 * sequence.lens.circle.r;
  const double tan_true = std::tan(2 * std::asin(ring / (2 * sequence.lens.focal_px))),
               tan_taken = std::tan(2 * std::asin(ring / (2 * lens.focal_px)));
  const double zoom = sequence.undistorted_f * tan_true / (view.focal_px * tan_taken);
  const cv::Matx33d undistorted_from_rectified(zoom, 0, sequence.undistorted_cx - zoom * view.cx, 0,
                                               zoom, sequence.undistorted_cy - zoom * view.cy, 0, 0,
                                               1);
  std::vector<cv::Matx33d> truth;
  for (const cv::Matx33d& h : sequence.panorama_from_undistorted)
    truth.push_back(h * undistorted_from_rectified);
  std::vector<cv::Point2d> nine{{view.cx, view.cy}};
  for (int i = 0; i < 8; ++i)
    nine.emplace_back(view.cx + view.focal_px * tan_taken * std::cos(CV_PI / 4 * i),
                      view.cy + view.focal_px * tan_taken * std::sin(CV_PI / 4 * i));
  const test::ClipScore score = test::ScorePlaces(nine, truth, sequence.is_blank, results);

  const double count = static_cast<double>(frames.size());
  double promised = 0;
  for (const FrameResult& result : results)
    if (result.component == 0) promised += result.expected_error_px / std::max(1, score.placed);
  std::printf(
      "%-18s %4d %4d %4d %7.3f %6.2f %5d %5.0f%% %6.2f  %6.1f %6.1f %6.1f %6.1f %5.1f  "
      "%4d %4d %4d %3d %6.1f %6.2f %5.1f %6.4f %5.2f %s\n",
      sequence.name.c_str(), score.frames, score.placed, score.right, score.mean_px, score.max_px,
      score.wrong_as_good, 100 * score.covered, promised, (prepared - begin) / count,
      (registered - prepared) / count, report.features_ms / count, report.pairs_ms / count,
      report.refine_ms / count, report.pairs_tried, report.pairs_kept, report.pairs_dropped,
      report.components, report.drift_px, report.closure_px, report.variance_factor,
      report.camera_deviation, report.drift_factor,
      report.focal.is_determined
          ? fmt::format("{:.4f} +- {:.4f}", report.focal.factor, report.focal.deviation).c_str()
          : "-");
  for (const std::string& warning : report.warnings) std::printf("    %s\n", warning.c_str());
  if (args.is_verbose)
    for (const PairEstimate& pair : report.pairs) {
      const cv::Matx33d exact =
          truth[static_cast<std::size_t>(pair.b)].inv() * truth[static_cast<std::size_t>(pair.a)];
      cv::Matx<double, 8, 1> off;
      for (int k = 0; k < 4; ++k) {
        const cv::Point2d& c = pair.control_in_a[static_cast<std::size_t>(k)];
        const cv::Point2d d = Apply(pair.b_from_a, c) - Apply(exact, c);
        off(2 * k) = d.x;
        off(2 * k + 1) = d.y;
      }
      double at_nine = 0;
      for (const cv::Point2d& p : nine)
        at_nine = std::max(at_nine, cv::norm(Apply(pair.b_from_a, p) - Apply(exact, p)));
      std::printf(
          "    pair %3d %3d  overlap %.2f similarity %.2f inliers %4d  error %6.2f px, nine "
          "%7.2f, times expected %5.2f, mean shift %5.2f %5.2f\n",
          pair.a, pair.b, pair.overlap, pair.similarity, pair.inliers, cv::norm(off) / 2, at_nine,
          std::sqrt((off.t() * pair.information * off)(0) / 8),
          (off(0) + off(2) + off(4) + off(6)) / 4, (off(1) + off(3) + off(5) + off(7)) / 4);
    }
  if (args.is_verbose)
    for (std::size_t i = 0; i < results.size(); ++i)
      std::printf("    %3zu component %2d error %7.2f expected %7.2f rms %5.2f inliers %4d %s\n", i,
                  results[i].component, score.worst_px[i], results[i].expected_error_px,
                  results[i].rms_px, results[i].inliers, results[i].reason.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Args args;
  nlohmann::json set = nlohmann::json::object();
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    if (word == "--quick") {
      continue;
    } else if (word == "--verbose") {
      args.is_verbose = true;
    } else if (word.starts_with("--focal=")) {
      args.focal_factor = std::stod(word.substr(equals + 1));
    } else if (word.starts_with("--") && equals != std::string::npos) {
      const std::string value = word.substr(equals + 1);
      const auto parsed = nlohmann::json::parse(value, nullptr, false);
      set[word.substr(2, equals - 2)] = parsed.is_discarded() ? nlohmann::json(value) : parsed;
    } else {
      args.folders.emplace_back(word);
    }
  }
  args.options = OptionsFromJson<RegisterOptions>(set);
  std::printf(
      "%-18s %4s %4s %4s %7s %6s %5s %6s %6s  %6s %6s %6s %6s %5s  %4s %4s %4s %3s %6s %6s "
      "%5s %6s %5s %s\n",
      "sequence", "all", "in", "ok", "mean", "max", "wrong", "cover", "promis", "prep", "reg",
      "look", "pairs", "refin", "tried", "kept", "drop", "cmp", "drift", "close", "factor",
      "camera", "loops", "focal");
  for (const auto& folder : args.folders) Run(folder, args);
  return 0;
}
