#include "authoring/panorama/graph/place_frames.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

#include "tests/authoring/panorama/graph/simulated_clip.h"

namespace arthro::authoring {
namespace {

using namespace arthro::test;

const RectifiedView kView{800, 800, kFocal, kCentre, kCentre};

FrameWindow Window() {
  FrameWindow window = WindowOf(kView, cv::Mat());
  window.radius = kRadius;
  return window;
}

// Pairs of a simulated clip: found when the frames overlap enough. The noise depends on the pair
// only, so the order of calls has no effect.
class Simulation {
 public:
  explicit Simulation(std::vector<cv::Matx33d> places, double sigma = 0.2)
      : places_(std::move(places)), sigma_(sigma), window_(Window()) {}

  std::set<std::pair<int, int>> wrong;  // pairs that come out well off
  std::set<int> blurred;                // frames that match no other

  std::optional<PairEstimate> operator()(const PairRequest& request, std::string* why_not) const {
    const cv::Matx33d truth = places_[static_cast<std::size_t>(request.b)].inv() *
                              places_[static_cast<std::size_t>(request.a)];
    const double overlap = OverlapOf(window_, truth);
    if (overlap < 0.2 || blurred.contains(request.a) || blurred.contains(request.b)) {
      *why_not = "the frames do not look alike";
      return std::nullopt;
    }
    std::mt19937 random(static_cast<unsigned>(1000 * request.a + request.b));
    PairEstimate pair = NoisyPair(places_, request.a, request.b, sigma_, random);
    pair.overlap = overlap;
    if (wrong.contains({request.a, request.b}))
      pair.b_from_a = cv::Matx33d(1, 0.02, 30, -0.02, 1, -20, 0, 0, 1) * pair.b_from_a;
    return pair;
  }

  const std::vector<cv::Matx33d>& places() const { return places_; }

 private:
  std::vector<cv::Matx33d> places_;
  double sigma_;
  FrameWindow window_;
};

PlacedGraph Place(const Simulation& clip, int threads = 1, GraphOptions options = {}) {
  return PlaceFrames(std::vector<std::string>(clip.places().size()), clip, Window(),
                     Pinhole{kFocal, kCentre, kCentre}, options, {}, {}, threads, {});
}

// Worst error of each frame of a component; 0 for the others.
std::vector<double> ErrorsOf(const PlacedGraph& graph, const Simulation& clip, int component) {
  std::vector<cv::Matx33d> truth, found;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < graph.component.size(); ++i)
    if (graph.component[i] == component) {
      truth.push_back(clip.places()[i]);
      found.push_back(graph.plane_from_frame[i]);
      which.push_back(i);
    }
  const std::vector<double> errors = WorstErrors(found, truth);
  std::vector<double> all(graph.component.size(), 0);
  for (std::size_t k = 0; k < which.size(); ++k) all[which[k]] = errors[k];
  return all;
}

TEST(PlaceFrames, ARingClosesBelowHalfAPixel) {
  const Simulation clip(TruePlaces(32, true));
  const PlacedGraph graph = Place(clip);
  for (const double error : ErrorsOf(graph, clip, 0)) EXPECT_LT(error, 0.5);
  EXPECT_GT(graph.loops, 0);
  EXPECT_GT(graph.drift_px, 0.5);  // before the loops were closed
}

TEST(PlaceFrames, LoopsWithRefinementBeatEitherStageBefore) {
  // Loops alone move only the place at which the ring misses its beginning; joint refinement
  // spreads the error over the ring.
  const Simulation clip(TruePlaces(32, true));
  GraphOptions options;
  const auto worst_with = [&](GraphStages stages) {
    options.stages = stages;
    const auto errors = ErrorsOf(Place(clip, 1, options), clip, 0);
    return *std::max_element(errors.begin(), errors.end());
  };
  const double pairs = worst_with(GraphStages::kPairs), loops = worst_with(GraphStages::kLoops),
               all = worst_with(GraphStages::kRefinement);
  std::printf("worst %.2f px by pairs, %.2f with loops, %.2f refined\n", pairs, loops, all);
  EXPECT_LT(all, 0.5 * pairs);
  EXPECT_LT(all, 0.5 * loops);
}

// PAN-06: a strip that never returns. 30 frames over 3000 px.
TEST(PlaceFrames, AStripDriftsLessThanSixPixelsOver3000) {
  const Simulation clip(TruePlaces(30, false));
  for (const double error : ErrorsOf(Place(clip), clip, 0)) EXPECT_LT(error, 6.0);
}

TEST(PlaceFrames, FalsePairsAreLeftOut) {
  Simulation clip(TruePlaces(32, true));
  clip.wrong = {{7, 8}, {19, 20}, {0, 31}};
  const PlacedGraph graph = Place(clip);
  for (const PairEstimate& pair : graph.pairs) {
    const bool is_false = clip.wrong.contains({pair.a, pair.b});
    EXPECT_FALSE(is_false) << pair.a << " " << pair.b;
  }
  const auto errors = ErrorsOf(graph, clip, 0);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_EQ(graph.component[i], 0);
    EXPECT_LT(errors[i], 1.5);
  }
}

TEST(PlaceFrames, BlurredFramesAreNamedAndStepped) {
  Simulation clip(TruePlaces(24, false, 60));
  clip.blurred = {6, 15};
  const PlacedGraph graph = Place(clip);
  for (int i = 0; i < 24; ++i) {
    const bool is_blurred = clip.blurred.contains(i);
    EXPECT_EQ(graph.component[static_cast<std::size_t>(i)], is_blurred ? -1 : 0) << i;
    EXPECT_EQ(graph.reason[static_cast<std::size_t>(i)].empty(), !is_blurred) << i;
  }
}

// PAN-03 without overlap: two pieces, each right by itself.
TEST(PlaceFrames, AJumpWithoutOverlapGivesTwoPieces) {
  auto places = TruePlaces(28, false, 70);
  for (std::size_t i = 12; i < places.size(); ++i)
    places[i] = cv::Matx33d(1, 0, 100, 0, 1, 2500, 0, 0, 1) * places[i];
  const Simulation clip(places);
  const PlacedGraph graph = Place(clip);
  for (int i = 0; i < 28; ++i)
    EXPECT_EQ(graph.component[static_cast<std::size_t>(i)], i < 12 ? 1 : 0) << i;
  for (const int component : {0, 1})
    for (const double error : ErrorsOf(graph, clip, component)) EXPECT_LT(error, 1.5);
}

TEST(PlaceFrames, SameAnswerOnAnyNumberOfThreads) {
  Simulation clip(TruePlaces(32, true));
  clip.wrong = {{7, 8}};
  const PlacedGraph one = Place(clip, 1), four = Place(clip, 4);
  for (std::size_t i = 0; i < one.plane_from_frame.size(); ++i)
    EXPECT_EQ(one.plane_from_frame[i], four.plane_from_frame[i]);
}

TEST(PlaceFrames, NoFrameOneFrameAndUselessFrames) {
  const Simulation none({}), one({cv::Matx33d::eye()});
  EXPECT_TRUE(Place(none).component.empty());
  EXPECT_EQ(Place(one).component, std::vector<int>{0});
  const std::vector<std::string> unusable{"blank", "blank"};
  const PlacedGraph graph = PlaceFrames(unusable, none, Window(), std::nullopt, {}, {}, {}, 1, {});
  EXPECT_EQ(graph.component, (std::vector<int>{-1, -1}));
  EXPECT_EQ(graph.reason[1], "blank");
}

TEST(PlaceFrames, StopsWhenAsked) {
  const Simulation clip(TruePlaces(32, true));
  std::atomic<bool> stop{true};
  Progress progress;
  progress.stop = &stop;
  EXPECT_THROW(PlaceFrames(std::vector<std::string>(32), clip, Window(), std::nullopt, {}, {}, {},
                           2, progress),
               Error);
}

TEST(PanoramaPlane, LooksStraightAtTheTissue) {
  // In a tilted frame's plane the others would grow towards one side.
  const auto places = TruePlaces(32, true);
  const Simulation clip(places, 1e-6);
  const PlacedGraph graph = Place(clip);
  double least = 1e9, most = 0;
  for (const cv::Matx33d& m : graph.plane_from_frame) {
    const cv::Point2d c{kCentre, kCentre};
    const double across = cv::norm(Move(m, c + cv::Point2d(10, 0)) - Move(m, c));
    least = std::min(least, across / 10);
    most = std::max(most, across / 10);
  }
  EXPECT_GT(least, 0.9);  // the scope's distance varies by 6 % either way
  EXPECT_LT(most, 1.1);
}

}  // namespace
}  // namespace arthro::authoring
