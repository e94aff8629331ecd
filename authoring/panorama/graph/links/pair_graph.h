// Graph with frames as nodes and pair estimates as edges: connected pieces, the frame from which
// errors accumulate least, and the position of every frame along the best-known pairs.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

// Largest standard deviation of a control point under the pair's information, px; never below
// `floor_px`, infinity when a direction is undetermined.
double PairDeviation(const PairEstimate& pair, double floor_px);

// Number of the piece that each frame belongs to. The largest piece is 0; among equally large
// pieces, the one with the earlier frame comes first.
std::vector<int> PiecesOf(int frames, const std::vector<PairEstimate>& pairs);

// Frame of one piece from which the farthest other frame is nearest, by accumulated variance.
int CentralFrame(int frames, const std::vector<PairEstimate>& pairs, int member);

struct Tree {
  std::vector<cv::Matx33d> root_from_frame;  // identity for unreached frames
  std::vector<double> variance;     // accumulated along the path, px^2; infinity: unreached
  std::vector<int> pair_to_parent;  // index of the pair; -1: root or unreached
};

// Path of least accumulated variance from the root to every reachable frame.
Tree LeastVarianceTree(int frames, const std::vector<PairEstimate>& pairs, int root);

// Variance of each pair as an edge's length, px^2, and the sum along the path from one frame to all
// others (infinity: no path).
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

// Pairs whose removal would split their piece (bridges).
std::vector<bool> BridgesOf(int frames, const std::vector<PairEstimate>& pairs);

}  // namespace arthro::authoring
