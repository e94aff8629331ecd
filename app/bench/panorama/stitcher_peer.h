// OpenCV's stitcher [OpenCV 4, stitching module] on prepared frames, for comparison with our
// registration. It runs in a process of its own, with limits of processor time and memory: on
// arthroscopic frames it may never end, or abort.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "simulation/core/progress.h"

namespace arthro::app {

enum class PeerMode { kScans, kPanorama };  // affine; rotating camera with bundle adjustment

struct PeerOptions {
  PeerMode mode = PeerMode::kScans;
  double cpu_limit = 60;      // s of processor time
  double memory_limit = 2e9;  // bytes, beyond those of the program
};

struct PeerResult {
  std::string outcome;      // "done", or the reason for no result: status, signal, time limit
  std::vector<int> frames;  // indices of the placed frames
  std::vector<cv::Matx33d> mosaic_from_frame;  // px of the given frames
  double cpu_seconds = 0;                      // s of estimation, without reading
  double peak_memory = 0;                      // bytes, the whole process
};

// `frames`: CV_8UC1, all of the size of `mask` (CV_8UC1). Throws Error when the child cannot be
// started or `progress` says stop.
PeerResult StitchWithPeer(const std::vector<cv::Mat>& frames, const cv::Mat& mask,
                          const PeerOptions& options, const Progress& progress);

// Reads the frames of a folder and writes the result there, in the child. Returns its exit status.
int RunStitcherWorker(const std::filesystem::path& folder, PeerMode mode, double cpu_limit,
                      double memory_limit) noexcept;

}  // namespace arthro::app
