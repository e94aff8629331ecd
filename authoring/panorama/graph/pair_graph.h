// Frames as nodes, pair estimates as edges: which frames hang together, from which frame errors add
// up least, and where every frame lies if one follows the best-known pairs only.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

// Worst standard deviation of a control point that the pair's information admits, px; never below
// `floor_px`, infinity where some direction is not held at all.
double PairDeviation(const PairEstimate& pair, double floor_px);

// Number of the piece that each frame belongs to. Largest piece first (0), then the next; of two
// equally large ones, that of the earlier frame.
std::vector<int> PiecesOf(int frames, const std::vector<PairEstimate>& pairs);

// Of one piece: the frame from which the farthest other is nearest, by accumulated variance.
int CentralFrame(int frames, const std::vector<PairEstimate>& pairs, int member);

struct Tree {
  std::vector<cv::Matx33d> root_from_frame;  // identity where unreached
  std::vector<double> variance;              // accumulated on the way, px^2; infinity: unreached
  std::vector<int> pair_to_parent;           // index of the pair; -1: root or unreached
};

// The way of least accumulated variance from the root to every frame that pairs reach.
Tree LeastVarianceTree(int frames, const std::vector<PairEstimate>& pairs, int root);

// Variance of each pair as an edge's length, px^2, and what adds up on the way from one frame to
// all others (infinity: no way).
std::vector<double> EdgeVariances(const std::vector<PairEstimate>& pairs);
class VarianceMap {
 public:
  VarianceMap(int frames, const std::vector<PairEstimate>& pairs);
  std::vector<double> From(int frame) const;

 private:
  struct Edge {
    int to;
    double variance;
  };
  std::vector<std::vector<Edge>> edges_;
};

// Pairs whose loss would take their piece apart (bridges).
std::vector<bool> BridgesOf(int frames, const std::vector<PairEstimate>& pairs);

}  // namespace arthro::authoring
