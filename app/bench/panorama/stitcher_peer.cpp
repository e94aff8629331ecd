#include "app/bench/panorama/stitcher_peer.h"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <sys/resource.h>

#include <fmt/format.h>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/stitching.hpp>

#include "app/state/scratch_folder.h"
#include "authoring/tissue/tetrahedra/child_process.h"
#include "authoring/tissue/tetrahedra/tetrahedralize.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr int kFeatures = 1500;  // per frame

std::string FrameName(std::size_t i) { return fmt::format("{:04d}.png", i); }

double OwnCpuSeconds() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(use.ru_utime) + seconds(use.ru_stime);
}

double OwnPeakBytes() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return 1024.0 * static_cast<double>(use.ru_maxrss);
}

const char* WordsOf(cv::Stitcher::Status status) {
  switch (status) {
    case cv::Stitcher::OK:
      return "done";
    case cv::Stitcher::ERR_NEED_MORE_IMGS:
      return "it needs more images";
    case cv::Stitcher::ERR_HOMOGRAPHY_EST_FAIL:
      return "its homography estimation failed";
    case cv::Stitcher::ERR_CAMERA_PARAMS_ADJUST_FAIL:
      return "its camera adjustment failed";
  }
  return "it failed";
}

void Limit(int what, double most) {
  const auto value = static_cast<rlim_t>(most);
  const rlimit limit{value, value};
  setrlimit(what, &limit);
}

void Work(const fs::path& folder, PeerMode mode) {
  std::vector<cv::Mat> frames, masks;
  const cv::Mat mask = cv::imread((folder / "mask.png").string(), cv::IMREAD_GRAYSCALE);
  for (std::size_t i = 0; fs::exists(folder / FrameName(i)); ++i) {
    frames.push_back(cv::imread((folder / FrameName(i)).string(), cv::IMREAD_COLOR));
    masks.push_back(mask);
  }
  const bool scans = mode == PeerMode::kScans;
  const cv::Ptr<cv::Stitcher> stitcher =
      cv::Stitcher::create(scans ? cv::Stitcher::SCANS : cv::Stitcher::PANORAMA);
  stitcher->setFeaturesFinder(cv::SIFT::create(kFeatures));
  if (!scans) stitcher->setWarper(cv::makePtr<cv::PlaneWarper>());
  const double start = OwnCpuSeconds();
  const cv::Stitcher::Status status = stitcher->estimateTransform(frames, masks);
  const double spent = OwnCpuSeconds() - start;
  std::ofstream out(folder / "result.txt");
  out.precision(17);
  out << spent << ' ' << OwnPeakBytes() << '\n';
  if (status == cv::Stitcher::OK) {
    const double scale = stitcher->workScale();
    const cv::Matx33d work_from_frame(scale, 0, 0, 0, scale, 0, 0, 0, 1);
    const auto cameras = stitcher->cameras();
    const auto component = stitcher->component();
    for (std::size_t k = 0; k < component.size(); ++k) {
      cv::Mat rotation, intrinsics;
      cameras[k].R.convertTo(rotation, CV_64F);
      cameras[k].K().convertTo(intrinsics, CV_64F);
      const cv::Matx33d r(rotation), c(intrinsics);
      // The affine warper maps mosaic to frame; the plane warper maps by R K⁻¹ onto z = 1.
      const cv::Matx33d mosaic_from_frame =
          scans ? r.inv() * work_from_frame : r * c.inv() * work_from_frame;
      out << component[k];
      for (int e = 0; e < 9; ++e) out << ' ' << mosaic_from_frame.val[e];
      out << '\n';
    }
  }
  out << "status " << WordsOf(status) << '\n';
  out.close();
  if (!out) throw std::runtime_error("the result was not written to its end");
}

}  // namespace

int RunStitcherWorker(const fs::path& folder, PeerMode mode, double cpu_limit,
                      double memory_limit) noexcept {
  Limit(RLIMIT_CPU, cpu_limit);
  Limit(RLIMIT_AS, OwnPeakBytes() + memory_limit + 1e9);  // + address space of the libraries
  try {
    Work(folder, mode);
  } catch (const std::exception&) {
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

PeerResult StitchWithPeer(const std::vector<cv::Mat>& frames, const cv::Mat& mask,
                          const PeerOptions& options, const Progress& progress) {
  ScratchFolder scratch;
  cv::imwrite((scratch.path() / "mask.png").string(), mask);
  for (std::size_t i = 0; i < frames.size(); ++i)
    cv::imwrite((scratch.path() / FrameName(i)).string(), frames[i],
                {cv::IMWRITE_PNG_COMPRESSION, 1});
  // On a busy machine, wall-clock time exceeds processor time.
  const authoring::ChildResult child = authoring::RunChild(
      authoring::kThisProgram,
      {"stitcher-worker", scratch.path().string(),
       options.mode == PeerMode::kScans ? "scans" : "panorama",
       fmt::format("{}", options.cpu_limit), fmt::format("{}", options.memory_limit)},
      4 * options.cpu_limit, progress);

  PeerResult result;
  if (child.end == authoring::ChildResult::End::kSignalled)
    result.outcome = child.code == SIGKILL || child.code == SIGXCPU
                         ? fmt::format("stopped after {:g} s of processor time", options.cpu_limit)
                         : fmt::format("it was ended by signal {}", child.code);
  else if (child.end == authoring::ChildResult::End::kTimedOut)
    result.outcome = fmt::format("stopped after {:g} s", 4 * options.cpu_limit);
  else if (child.code != EXIT_SUCCESS)
    result.outcome = "it threw";
  if (!result.outcome.empty()) {
    result.cpu_seconds = options.cpu_limit;
    return result;
  }
  std::ifstream in(scratch.path() / "result.txt");
  in >> result.cpu_seconds >> result.peak_memory;
  for (std::string word; in >> word;) {
    if (word == "status") {
      std::getline(in >> std::ws, result.outcome);
      break;
    }
    cv::Matx33d h;
    bool is_finite = true;
    for (double& e : h.val) {  // bundle adjustment can give "nan", which streams do not read
      std::string number;
      in >> number;
      e = std::strtod(number.c_str(), nullptr);
      is_finite = is_finite && std::isfinite(e);
    }
    if (!is_finite) continue;
    result.frames.push_back(std::stoi(word));
    result.mosaic_from_frame.push_back(h);
  }
  return result;
}

}  // namespace arthro::app
