// OpenCV's own stitcher on frames that we prepared, as the peer that our registration is held
// against [OpenCV 4, stitching module]. It runs in a process of its own, under a limit of processor
// time and memory: on arthroscopic frames it may not end, and may abort.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "simulation/core/progress.h"

namespace arthro::app {

enum class PeerMode { kScans, kPanorama };  // affine, or a turning camera with bundle adjustment

struct PeerOptions {
  PeerMode mode = PeerMode::kScans;
  double cpu_limit = 60;      // s of processor time
  double memory_limit = 2e9;  // bytes on top of the program itself
};

struct PeerResult {
  std::string outcome;      // "done", or why there is nothing: its status, a signal, out of time
  std::vector<int> frames;  // that it placed
  std::vector<cv::Matx33d> mosaic_from_frame;  // px of the frames as given
  double cpu_seconds = 0;                      // of its estimation, reading not counted
  double peak_memory = 0;                      // bytes, the whole process
};

// `frames`: CV_8UC1, all of the size of `mask` (CV_8UC1). Throws Error when the child cannot be
// started or `progress` says stop.
PeerResult StitchWithPeer(const std::vector<cv::Mat>& frames, const cv::Mat& mask,
                          const PeerOptions& options, const Progress& progress);

// In the child: reads the frames of a folder, leaves the result there. Returns an exit status.
int RunStitcherWorker(const std::filesystem::path& folder, PeerMode mode, double cpu_limit,
                      double memory_limit) noexcept;

}  // namespace arthro::app
