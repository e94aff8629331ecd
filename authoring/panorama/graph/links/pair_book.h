// Record of the pairs that were tried, and their results. Requests many at once, on a few threads,
// in an order that does not depend on the threads.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/pair_estimate.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

enum class PairEffort {
  kNeighbours,  // little is known, but the frames are consecutive
  kPredicted,   // the position of b is known up to some tens of px
  kSearch,      // nothing is known: any rotation, other sizes
};

struct PairRequest {
  int a = 0, b = 0;  // a < b
  PairEffort effort = PairEffort::kNeighbours;
  cv::Matx33d predicted_b_from_a = cv::Matx33d::eye();  // with kPredicted
};

// Called from several threads at once; the result must not depend on the order of calls.
using PairMaker =
    std::function<std::optional<PairEstimate>(const PairRequest& request, std::string* why_not)>;

class PairBook {
 public:
  PairBook(PairMaker maker, int threads) : maker_(std::move(maker)), threads_(threads) {}

  // Estimates the pairs that are not in the book yet; `again` includes those that failed. Returns
  // the number of pairs found.
  int Ask(const std::vector<PairRequest>& requests, bool again, std::string_view stage,
          const Progress& progress);

  const std::vector<PairEstimate>& pairs() const { return pairs_; }  // in the order found
  int tried() const { return tried_; }
  bool WasTried(int a, int b) const { return tried_pairs_.contains({a, b}); }
  bool Has(int a, int b) const;
  const PairEstimate* Find(int a, int b) const;
  // Reason why the pair failed; empty when it succeeded or was not tried.
  std::string WhyNot(int a, int b) const;

  // Removes pairs that proved false; they count as tried.
  void Drop(const std::vector<bool>& is_false, const std::string& why);

 private:
  PairMaker maker_;
  int threads_ = 1;
  std::vector<PairEstimate> pairs_;
  std::map<std::pair<int, int>, std::string> tried_pairs_;  // reason of failure; empty: found
  int tried_ = 0;
};

}  // namespace arthro::authoring
