#include "authoring/panorama/graph/place_frames.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include <fmt/format.h>

#include "authoring/panorama/graph/links/gap_repair.h"
#include "authoring/panorama/graph/links/loop_candidates.h"
#include "authoring/panorama/graph/links/pair_graph.h"
#include "authoring/panorama/graph/panorama_plane.h"
#include "authoring/panorama/graph/refinement/uncertainty.h"
#include "simulation/core/at.h"

namespace arthro::authoring {
namespace {

// Pairs of one piece, and their indices in the whole list.
struct PiecePairs {
  std::vector<PairEstimate> pairs;
  std::vector<std::size_t> at;
};

class Placer {
 public:
  Placer(const std::vector<std::string>& unusable, const PairMaker& maker,
         const FrameWindow& window, const std::optional<Pinhole>& camera,
         const GraphOptions& options, const CycleOptions& cycles, const RefineOptions& refine,
         int threads, const Progress& progress)
      : frames_(static_cast<int>(unusable.size())),
        unusable_(unusable),
        window_(window),
        camera_(camera),
        options_(options),
        cycles_(cycles),
        refine_(refine),
        progress_(progress),
        book_(maker, threads) {
    for (int i = 0; i < frames_; ++i)
      if (unusable[At(i)].empty()) usable_.push_back(i);
  }

  PlacedGraph Run() {
    AskNeighbours();
    RepairGaps(usable_, frames_, options_.searches_per_gap, book_, progress_);
    CheckCycles();
    Place();
    if (options_.stages != GraphStages::kPairs) {
      for (int round = 0; round < options_.loop_rounds; ++round) {
        AskLoops(round);
        AdoptOrphans(usable_, places_, piece_, 0, window_, book_, progress_);
        CheckCycles();
        Place();
        DropContradicted();
      }
      CheckBridges();
      DropContradicted();
    }
    return Finish();
  }

 private:
  void AskNeighbours() {
    std::vector<PairRequest> requests;
    for (std::size_t k = 0; k + 1 < usable_.size(); ++k)
      requests.push_back({usable_[k], usable_[k + 1], PairEffort::kNeighbours, cv::Matx33d::eye()});
    book_.Ask(requests, false, "matching neighbours", progress_);
  }

  void AskLoops(int round) {
    LoopLimits limits;
    limits.most_pairs = static_cast<int>(options_.loops_per_frame * frames_ + 0.5);
    limits.most_per_frame = std::max(2, static_cast<int>(2 * options_.loops_per_frame + 1));
    limits.smallest_overlap = options_.loop_overlap;
    limits.least_gain = options_.least_gain;
    const VarianceMap before(frames_, book_.pairs());
    const std::vector<PairRequest> requests =
        LoopCandidates(places_, piece_, book_, window_, limits);
    result_.loops += book_.Ask(requests, false, "closing loops", progress_);
    if (round > 0) return;
    std::vector<double> surprises;
    // Before any refinement, loops measure the drift of the chain of neighbours.
    for (const PairRequest& request : requests) {
      const PairEstimate* pair = book_.Find(request.a, request.b);
      if (pair == nullptr) continue;
      double square = 0;
      for (const cv::Point2d& c : pair->control_in_a) {
        const cv::Vec3d p = request.predicted_b_from_a * cv::Vec3d(c.x, c.y, 1),
                        q = pair->b_from_a * cv::Vec3d(c.x, c.y, 1);
        square += std::pow(p[0] / p[2] - q[0] / q[2], 2) + std::pow(p[1] / p[2] - q[1] / q[2], 2);
      }
      result_.drift_px = std::max(result_.drift_px, std::sqrt(square / 4));
      const double deviation = PairDeviation(*pair, 0.05);
      surprises.push_back(square / 4 / (before.From(pair->a)[At(pair->b)] + deviation * deviation));
    }
    if (!surprises.empty()) {
      std::sort(surprises.begin(), surprises.end());
      result_.drift_factor = surprises[surprises.size() / 2];
    }
  }

  void CheckCycles() {
    const CycleCheck check = CheckTriangles(frames_, book_.pairs(), cycles_);
    result_.closure_px = check.mean_closure_px;
    Drop(check.is_false, "contradicts the pairs around it");
  }

  void Drop(const std::vector<bool>& is_false, const std::string& why) {
    result_.dropped += static_cast<int>(std::count(is_false.begin(), is_false.end(), true));
    book_.Drop(is_false, why);
  }

  PiecePairs PairsOfPiece(int piece) const {
    PiecePairs own;
    for (std::size_t i = 0; i < book_.pairs().size(); ++i)
      if (piece_[At(book_.pairs()[i].a)] == piece) {
        own.pairs.push_back(book_.pairs()[i]);
        own.at.push_back(i);
      }
    return own;
  }

  // Puts every piece into the plane of its central frame; pieces of one frame keep theirs.
  void Place() {
    const std::clock_t begin = std::clock();
    const std::vector<PairEstimate>& pairs = book_.pairs();
    piece_ = PiecesOf(frames_, pairs);
    places_.assign(At(frames_), cv::Matx33d::eye());
    error_px_.assign(pairs.size(), 0);
    surprise_.assign(pairs.size(), 0);
    root_.clear();
    deviation_.clear();
    std::vector<int> size(At(frames_), 0), first(At(frames_), -1);
    for (int i = 0; i < frames_; ++i)
      if (size[At(piece_[At(i)])]++ == 0) first[At(piece_[At(i)])] = i;
    for (int piece = 0; piece < frames_ && size[At(piece)] > 1; ++piece) {
      progress_.Step("placing all frames", static_cast<double>(piece) / frames_);
      const PiecePairs own = PairsOfPiece(piece);
      const int root = CentralFrame(frames_, own.pairs, first[At(piece)]);
      root_.push_back(root);
      std::vector<cv::Matx33d> start = LeastVarianceTree(frames_, own.pairs, root).root_from_frame;
      if (options_.stages == GraphStages::kRefinement) {
        const Refined refined = Refine(own.pairs, start, root, refine_, camera_);
        start = refined.plane_from_frame;
        for (std::size_t i = 0; i < own.at.size(); ++i) {
          error_px_[own.at[i]] = refined.pair_error_px[i];
          surprise_[own.at[i]] = refined.pair_surprise[i];
        }
        if (piece == 0) {
          result_.variance_factor = refined.variance_factor;
          result_.camera_deviation = refined.camera_deviation;
        }
        deviation_.push_back(refined.camera_deviation);
      }
      for (int i = 0; i < frames_; ++i)
        if (piece_[At(i)] == piece) places_[At(i)] = start[At(i)];
    }
    result_.refine_ms += 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  // Drops pairs that all the others together contradict, the worst first.
  void DropContradicted() {
    if (options_.stages != GraphStages::kRefinement) return;
    for (int round = 0; round < 6; ++round) {
      double worst = 0;
      const auto is_contradicted = [&](std::size_t i) {
        return !(surprise_[i] <= options_.most_surprise || error_px_[i] <= options_.most_misfit);
      };
      for (std::size_t i = 0; i < surprise_.size(); ++i)
        if (is_contradicted(i)) worst = std::max(worst, error_px_[i]);
      if (worst == 0) return;
      std::vector<bool> is_false(surprise_.size(), false);
      for (std::size_t i = 0; i < surprise_.size(); ++i)
        is_false[i] = is_contradicted(i) && !(error_px_[i] < 0.5 * worst);
      Drop(is_false, "contradicts where all other pairs put its frames");
      Place();
    }
  }

  // No other pair checks a pair that alone joins two pieces. Requests more pairs across it; without
  // any, the pair must be good by itself.
  void CheckBridges() {
    std::vector<PairRequest> requests;
    const std::vector<bool> bridge = BridgesOf(frames_, book_.pairs());
    for (std::size_t i = 0; i < bridge.size(); ++i) {
      if (!bridge[i]) continue;
      const PairEstimate& pair = book_.pairs()[i];
      for (const auto& [da, db] : {std::pair{-1, 0}, {0, 1}, {1, 0}, {0, -1}, {-1, 1}}) {
        const int a = pair.a + da, b = pair.b + db;
        if (a < 0 || b >= frames_ || a >= b) continue;
        if (piece_[At(a)] != piece_[At(pair.a)] || piece_[At(b)] != piece_[At(pair.a)]) continue;
        const cv::Matx33d m = places_[At(b)].inv() * places_[At(a)];
        if (OverlapOf(window_, m) < 0.3) continue;
        requests.push_back({a, b, PairEffort::kPredicted, m * (1 / m(2, 2))});
      }
    }
    if (!requests.empty()) {
      book_.Ask(requests, false, "checking single joints", progress_);
      CheckCycles();
    }
    const std::vector<bool> still = BridgesOf(frames_, book_.pairs());
    std::vector<bool> is_false(still.size(), false);
    for (std::size_t i = 0; i < still.size(); ++i) {
      is_false[i] = still[i] && book_.pairs()[i].similarity < options_.bridge_similarity;
      result_.bridges_refused += is_false[i];
    }
    Drop(is_false, "is the only link of two parts and too uncertain");
    Place();
  }

  std::string ReasonOf(int frame) const {
    if (!unusable_[At(frame)].empty()) return unusable_[At(frame)];
    const auto here = std::lower_bound(usable_.begin(), usable_.end(), frame) - usable_.begin();
    std::string why;
    if (here > 0) why = book_.WhyNot(usable_[At(static_cast<int>(here)) - 1], frame);
    if (why.empty() && At(static_cast<int>(here)) + 1 < usable_.size())
      why = book_.WhyNot(frame, usable_[At(static_cast<int>(here)) + 1]);
    if (usable_.size() < 2) return "there is no other frame to compare it with";
    return "agrees with no other frame" + (why.empty() ? std::string() : ": " + why);
  }

  PlacedGraph Finish() {
    std::vector<int> size(At(frames_), 0);
    for (int i = 0; i < frames_; ++i) ++size[At(piece_[At(i)])];
    result_.component.assign(At(frames_), -1);
    result_.reason.assign(At(frames_), "");
    result_.expected_error_px.assign(At(frames_), 0);
    for (int i = 0; i < frames_; ++i) {
      const int piece = piece_[At(i)];
      if (size[At(piece)] > 1)
        result_.component[At(i)] = piece;
      else
        result_.reason[At(i)] = ReasonOf(i);
    }
    // A single usable frame is a panorama by itself.
    if (!usable_.empty() && size[0] <= 1) {
      result_.component[At(usable_[0])] = 0;
      result_.reason[At(usable_[0])].clear();
    }
    const std::clock_t begin = std::clock();
    for (int piece = 0; piece < static_cast<int>(root_.size()); ++piece) {
      Straighten(piece);
      const PiecePairs own = PairsOfPiece(piece);
      std::vector<double> weights;
      for (const std::size_t i : own.at) {
        // Weight of the pair under the Cauchy loss.
        const double over = surprise_[i] / refine_.loss_scale;
        weights.push_back(1 / (result_.variance_factor * (1 + over * over)));
      }
      const Uncertainty uncertainty =
          EstimateUncertainty(own.pairs, weights, places_, root_[At(piece)], window_.nine,
                              refine_.pair_floor, camera_, DeviationOf(piece));
      for (int i = 0; i < frames_; ++i)
        if (piece_[At(i)] == piece)
          result_.expected_error_px[At(i)] = uncertainty.error_px[At(i)] * Caution(piece);
    }
    result_.refine_ms += 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    result_.plane_from_frame = places_;
    result_.pairs = book_.pairs();
    result_.pair_error_px = error_px_;
    result_.tried = book_.tried();
    return result_;
  }

  // Correction for correlated errors: neighbours err alike, since light and relief bias them in the
  // same way. Two effects measure it: the distance by which loops miss the prediction of the chain,
  // and a widened rule of the camera, which shows that tissue is not flat. On clips with known
  // truth it is 0.1 to 0.3 for easy ones, and 0.6 to 2.7 for hard ones and for relief of 8 % of the
  // distance.
  double Caution(int piece) const {
    double caution = std::sqrt(1 + 1.5 * std::min(result_.drift_factor, 100.0));
    if (DeviationOf(piece) > 0)
      caution *= std::min(12.0, std::pow(DeviationOf(piece) / refine_.camera_deviation, 1.5));
    return caution;
  }

  double DeviationOf(int piece) const {
    return piece < static_cast<int>(deviation_.size()) ? deviation_[At(piece)] : 0.0;
  }

  // Maps the central frame's plane to the plane of the panorama.
  void Straighten(int piece) {
    std::vector<cv::Matx33d> own;
    for (int i = 0; i < frames_; ++i)
      if (piece_[At(i)] == piece) own.push_back(places_[At(i)]);
    // With the camera's rule the plane is the tissue's own; otherwise it is chosen.
    const cv::Matx33d plane =
        DeviationOf(piece) > 0 ? NaturalScale(own, window_) : LeastStretchedPlane(own, window_);
    for (int i = 0; i < frames_; ++i) {
      if (piece_[At(i)] != piece) continue;
      const cv::Matx33d m = plane * places_[At(i)];
      places_[At(i)] = m * (1 / m(2, 2));
    }
  }

  const int frames_;
  const std::vector<std::string>& unusable_;
  const FrameWindow& window_;
  const std::optional<Pinhole>& camera_;
  const GraphOptions& options_;
  const CycleOptions& cycles_;
  const RefineOptions& refine_;
  const Progress& progress_;
  std::vector<int> usable_;
  PairBook book_;
  PlacedGraph result_;
  std::vector<int> piece_, root_;
  std::vector<cv::Matx33d> places_;
  std::vector<double> error_px_, surprise_;
  std::vector<double> deviation_;  // deviation of the camera prior, per piece
};

}  // namespace

PlacedGraph PlaceFrames(const std::vector<std::string>& unusable, const PairMaker& maker,
                        const FrameWindow& window, const std::optional<Pinhole>& camera,
                        const GraphOptions& options, const CycleOptions& cycles,
                        const RefineOptions& refine, int threads, const Progress& progress) {
  if (unusable.empty()) return {};
  return Placer(unusable, maker, window, camera, options, cycles, refine, threads, progress).Run();
}

}  // namespace arthro::authoring
