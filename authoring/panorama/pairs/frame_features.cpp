#include "authoring/panorama/pairs/frame_features.h"

#include <algorithm>
#include <cmath>

#include <opencv2/features2d.hpp>
#include <opencv2/flann.hpp>
#include <opencv2/imgproc.hpp>

#include "authoring/panorama/pairs/pair_estimate.h"
#include "authoring/panorama/pairs/surf_detector.h"

namespace arthro::authoring {
namespace {

constexpr int kCells = 8;  // cells across the frame: each keeps its share of the points
// Factor of candidates over kept points, so that every cell has some to choose from.
constexpr int kCandidates = 2;
constexpr double kPredictedReach = 40;  // px: matches further from the prediction are false
constexpr int kChecks = 48;             // leaves of the index that a search visits

struct Candidates {
  std::vector<cv::KeyPoint> points;  // strongest first
  cv::Mat descriptors;
};

Candidates Find(const cv::Mat& grey, const cv::Mat& mask, const FeatureOptions& options) {
  Candidates out;
  const int most = kCandidates * options.features;
  if (options.detector == Detector::kSurf) {
    constexpr double kLeast = 10;  // dlib's response; the number of points is limited instead
    const SurfPoints surf = DetectSurf(grey, mask, most, kLeast);
    for (const SurfPoint& p : surf.points)
      out.points.emplace_back(p.at, p.scale, -1.0f, p.strength);
    out.descriptors = surf.descriptors;
    return out;
  }
  cv::Ptr<cv::Feature2D> detector;
  if (options.detector == Detector::kSift)
    detector = cv::SIFT::create(most, 3, 0.02);
  else if (options.detector == Detector::kAkaze)
    detector = cv::AKAZE::create(cv::AKAZE::DESCRIPTOR_MLDB, 0, 3, 0.0005f);
  else
    detector = cv::ORB::create(most, 1.2f, 6, 15, 0, 2, cv::ORB::HARRIS_SCORE, 31, 10);
  std::vector<cv::KeyPoint> points;
  detector->detect(grey, points, mask);
  std::sort(points.begin(), points.end(), [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    if (a.response != b.response) return a.response > b.response;
    return a.pt.y != b.pt.y ? a.pt.y < b.pt.y : a.pt.x < b.pt.x;
  });
  if (points.size() > static_cast<std::size_t>(most)) points.resize(static_cast<std::size_t>(most));
  detector->compute(grey, points, out.descriptors);  // may drop points
  out.points = points;
  return out;
}

// Selects candidates: in turn the strongest remaining one of every cell.
std::vector<int> SpreadOver(const std::vector<cv::KeyPoint>& points, cv::Size size, int most) {
  std::vector<std::vector<int>> cells(kCells * kCells);
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int x = std::clamp(static_cast<int>(points[i].pt.x * kCells / width), 0, kCells - 1);
    const int y = std::clamp(static_cast<int>(points[i].pt.y * kCells / height), 0, kCells - 1);
    cells[static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x)].push_back(
        static_cast<int>(i));
  }
  std::vector<int> kept;
  for (std::size_t round = 0; kept.size() < static_cast<std::size_t>(most); ++round) {
    const std::size_t before = kept.size();
    for (const auto& cell : cells)
      if (round < cell.size() && kept.size() < static_cast<std::size_t>(most))
        kept.push_back(cell[round]);
    if (kept.size() == before) break;
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

// OpenCV's index uses a random generator of the thread; the result must not depend on earlier
// draws.
class OwnRandom {
 public:
  explicit OwnRandom(int seed) : before_(cv::theRNG()) {
    cv::theRNG() = cv::RNG(static_cast<std::uint64_t>(seed) * 2654435761u + 88172645463325252u);
  }
  ~OwnRandom() { cv::theRNG() = before_; }
  OwnRandom(const OwnRandom&) = delete;
  OwnRandom& operator=(const OwnRandom&) = delete;

 private:
  cv::RNG before_;
};

}  // namespace

struct FrameFeatures::Index {
  // Searching does not change it, although OpenCV does not declare so.
  mutable cv::flann::Index flann;
  bool is_binary = false;

  struct Found {
    cv::Mat indices, distances;  // nearest two; squared for floats
  };
  Found Nearest(const cv::Mat& descriptors, int count) const {
    Found found;
    flann.knnSearch(descriptors, found.indices, found.distances, count,
                    cv::flann::SearchParams(kChecks));
    return found;
  }
  double Distance(const Found& found, int row, int column) const {
    return is_binary ? static_cast<float>(found.distances.at<int>(row, column))
                     : std::sqrt(std::max(0.0f, found.distances.at<float>(row, column)));
  }
};

FrameFeatures::FrameFeatures() = default;
FrameFeatures::FrameFeatures(FrameFeatures&&) noexcept = default;
FrameFeatures& FrameFeatures::operator=(FrameFeatures&&) noexcept = default;
FrameFeatures::~FrameFeatures() = default;

FrameFeatures DetectFeatures(const WorkingFrame& frame, const FeatureOptions& options) {
  FrameFeatures features;
  features.reach_ = 0.5 * std::max(frame.grey.cols, frame.grey.rows) / frame.scale;
  const cv::Rect inside = cv::boundingRect(frame.mask);
  constexpr int kSmallest = 64;  // px: a smaller frame has no room for any detector
  if (inside.width < kSmallest || inside.height < kSmallest || frame.texture <= 0) return features;
  const Candidates found = Find(frame.grey, frame.mask, options);
  const std::vector<int> kept = SpreadOver(found.points, frame.grey.size(), options.features);
  for (const int i : kept) {
    const cv::Point2f p = found.points[static_cast<std::size_t>(i)].pt;
    features.points_.emplace_back((p.x + 0.5) / frame.scale - 0.5, (p.y + 0.5) / frame.scale - 0.5);
    features.descriptors_.push_back(found.descriptors.row(i));
  }
  if (features.points_.size() < 4) return features;
  const OwnRandom random(options.seed);
  features.index_ = std::make_unique<FrameFeatures::Index>();
  features.index_->is_binary = features.descriptors_.type() == CV_8U;
  if (features.index_->is_binary)
    features.index_->flann.build(features.descriptors_, cv::flann::LshIndexParams(8, 14, 1),
                                 cvflann::FLANN_DIST_HAMMING);
  else
    features.index_->flann.build(features.descriptors_, cv::flann::KDTreeIndexParams(2));
  return features;
}

std::vector<FeatureMatch> MutualMatches(const FrameFeatures& a, const FrameFeatures& b,
                                        const FeatureOptions& options,
                                        const cv::Matx33d* predicted_b_from_a) {
  std::vector<FeatureMatch> matches;
  if (!a.index_ || !b.index_ || a.descriptors_.type() != b.descriptors_.type()) return matches;
  const auto forth = b.index_->Nearest(a.descriptors_, 2);
  std::vector<int> asked;  // points of b for which the nearest of a is needed
  cv::Mat asked_descriptors;
  for (int i = 0; i < a.descriptors_.rows; ++i) {
    const int near = forth.indices.at<int>(i, 0), next = forth.indices.at<int>(i, 1);
    if (near < 0 || near >= b.descriptors_.rows) continue;
    const bool has_next = next >= 0 && next < b.descriptors_.rows;
    if (has_next &&
        b.index_->Distance(forth, i, 0) >= options.ratio * b.index_->Distance(forth, i, 1))
      continue;
    if (predicted_b_from_a) {
      const cv::Point2d at = Apply(*predicted_b_from_a, a.points_[static_cast<std::size_t>(i)]);
      if (!(cv::norm(at - b.points_[static_cast<std::size_t>(near)]) < kPredictedReach)) continue;
    }
    matches.push_back({i, near});
    asked_descriptors.push_back(b.descriptors_.row(near));
  }
  if (matches.empty()) return matches;
  const auto back = a.index_->Nearest(asked_descriptors, 1);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < matches.size(); ++k)
    if (back.indices.at<int>(static_cast<int>(k), 0) == matches[k].a) matches[kept++] = matches[k];
  matches.resize(kept);
  return matches;
}

}  // namespace arthro::authoring
