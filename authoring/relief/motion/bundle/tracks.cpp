#include "authoring/relief/motion/bundle/tracks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "authoring/panorama/graph/links/parallel.h"

namespace arthro::authoring {
namespace {

constexpr int kWindow = 25;          // px, side of the patch that flow compares
constexpr int kPyramid = 4;          // levels above the first
constexpr double kMostReturn = 1.0;  // px between a point and its way there and back
constexpr int kMargin = 4;           // px that a point keeps from the mask's edge
constexpr double kSpacing = 7;       // px between two points of one frame
// Share of the strongest corner, which may be the outline of a bone before weak texture.
constexpr double kLeastCorner = 0.001;
constexpr int kFeatures = 700;               // SIFT features per frame
constexpr std::array kGaps = {2, 4, 7, 11};  // frames between which features are matched
constexpr double kRatio = 0.82;              // best over second-best descriptor distance

// One sighting of a point; sightings of one tissue point are joined later.
struct Sighting {
  int frame;
  cv::Point2f pixel;
  int feature = -1;  // number of the frame's feature; -1: followed by flow
};

// Joins sightings into points; a point that would be twice in one frame is given up.
class PointGroups {
 public:
  int Add(int frame, const cv::Point2f& pixel, int feature = -1) {
    sightings_.push_back({frame, pixel, feature});
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }
  void Join(int a, int b) { parent_[At(RootOf(std::max(a, b)))] = RootOf(std::min(a, b)); }
  const Sighting& sighting(int i) const { return sightings_[At(i)]; }

  std::vector<std::vector<Sighting>> Groups() {
    std::map<int, std::vector<Sighting>> by_root;
    for (std::size_t i = 0; i < sightings_.size(); ++i)
      by_root[RootOf(static_cast<int>(i))].push_back(sightings_[i]);
    std::vector<std::vector<Sighting>> groups;
    for (auto& [root, group] : by_root) {
      std::stable_sort(group.begin(), group.end(),
                       [](const Sighting& a, const Sighting& b) { return a.frame < b.frame; });
      bool is_unique = true;
      std::vector<Sighting> kept;
      for (const Sighting& s : group) {
        if (!kept.empty() && kept.back().frame == s.frame) {
          // Two ways to the same place agree; two places contradict each other.
          is_unique &= cv::norm(kept.back().pixel - s.pixel) < 2;
          continue;
        }
        kept.push_back(s);
      }
      if (is_unique && kept.size() >= 2) groups.push_back(std::move(kept));
    }
    return groups;
  }

 private:
  static std::size_t At(int i) { return static_cast<std::size_t>(i); }
  int RootOf(int i) {
    while (parent_[At(i)] != i) i = parent_[At(i)] = parent_[At(parent_[At(i)])];
    return i;
  }
  std::vector<Sighting> sightings_;
  std::vector<int> parent_;
};

struct FlowFrame {
  std::vector<cv::Mat> pyramid;
  cv::Mat inner;  // the mask without its margin
};

bool IsInside(const cv::Mat& mask, const cv::Point2f& p) {
  const int x = cvRound(p.x), y = cvRound(p.y);
  return x >= 0 && y >= 0 && x < mask.cols && y < mask.rows && mask.at<std::uint8_t>(y, x) != 0;
}

// Follows points there and back; where the way back does not return, `found` is 0. `arrived` and
// `returned` hold guesses when `levels` is small.
void FollowFrom(const FlowFrame& from, const FlowFrame& to, const std::vector<cv::Point2f>& points,
                int levels, int flags, double most_return, std::vector<cv::Point2f>& arrived,
                std::vector<cv::Point2f> returned, std::vector<std::uint8_t>& found) {
  found.assign(points.size(), 0);
  if (points.empty()) return;
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01);
  const cv::Size window(kWindow, kWindow);
  std::vector<std::uint8_t> there, back;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(from.pyramid, to.pyramid, points, arrived, there, error, window, levels,
                           criteria, flags, 1e-4);
  cv::calcOpticalFlowPyrLK(to.pyramid, from.pyramid, arrived, returned, back, error, window, levels,
                           criteria, flags, 1e-4);
  for (std::size_t i = 0; i < points.size(); ++i)
    found[i] = there[i] && back[i] && cv::norm(returned[i] - points[i]) < most_return &&
               IsInside(to.inner, arrived[i]);
}

// Follows points from one frame to another; those that are lost are tried again from where a
// homography of the others puts them, since the coarse levels hold little of a weak texture.
void Follow(const FlowFrame& from, const FlowFrame& to, const std::vector<cv::Point2f>& points,
            std::vector<cv::Point2f>& arrived, std::vector<std::uint8_t>& found) {
  arrived.clear();
  FollowFrom(from, to, points, kPyramid, 0, kMostReturn, arrived, {}, found);
  constexpr std::size_t kLeastFound = 12;
  constexpr double kOutlier = 8;              // px from the homography
  constexpr double kMostGuessedReturn = 0.5;  // px; a guess makes a wrong return likelier
  constexpr int kRounds = 2, kGuessedLevels = 2;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<cv::Point2f> had, got, lost, guess, back_guess;
    std::vector<std::size_t> lost_at;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (found[i]) {
        had.push_back(points[i]);
        got.push_back(arrived[i]);
      } else {
        lost.push_back(points[i]);
        lost_at.push_back(i);
      }
    }
    if (had.size() < kLeastFound || lost.empty()) return;
    const cv::Mat forth = cv::findHomography(had, got, cv::RANSAC, kOutlier);
    if (forth.empty() || std::abs(cv::determinant(forth)) < 1e-6) return;
    cv::perspectiveTransform(lost, guess, forth);
    // The way back begins a little off, so that a point that does not move proves nothing.
    for (const cv::Point2f& p : lost) back_guess.emplace_back(p.x + 3, p.y + 3);
    std::vector<std::uint8_t> again;
    FollowFrom(from, to, lost, kGuessedLevels, cv::OPTFLOW_USE_INITIAL_FLOW, kMostGuessedReturn,
               guess, back_guess, again);
    for (std::size_t i = 0; i < lost.size(); ++i) {
      if (!again[i]) continue;
      found[lost_at[i]] = 1;
      arrived[lost_at[i]] = guess[i];
    }
  }
}

// New points where a frame has none yet.
std::vector<cv::Point2f> NewPoints(const WorkingFrame& frame, const FlowFrame& flow,
                                   const std::vector<cv::Point2f>& taken, int most) {
  std::vector<cv::Point2f> corners;
  const int wanted = most - static_cast<int>(taken.size());
  if (wanted <= 0) return corners;
  cv::Mat free = flow.inner.clone();
  for (const cv::Point2f& p : taken)
    cv::circle(free, p, static_cast<int>(kSpacing), cv::Scalar(0), cv::FILLED);
  cv::goodFeaturesToTrack(frame.grey, corners, wanted, kLeastCorner, kSpacing, free, 7);
  return corners;
}

// Features of all frames, in order.
struct Features {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

std::vector<std::pair<int, int>> MatchFeatures(const Features& a, const Features& b) {
  std::vector<std::pair<int, int>> pairs;
  if (a.points.size() < 2 || b.points.size() < 2) return pairs;
  const cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<std::vector<cv::DMatch>> forward;
  matcher.knnMatch(a.descriptors, b.descriptors, forward, 2);
  std::vector<cv::DMatch> best;
  matcher.match(b.descriptors, a.descriptors, best);
  for (const auto& two : forward) {
    if (two.size() < 2 || two[0].distance > kRatio * two[1].distance) continue;
    if (best[static_cast<std::size_t>(two[0].trainIdx)].trainIdx != two[0].queryIdx) continue;
    pairs.emplace_back(two[0].queryIdx, two[0].trainIdx);
  }
  return pairs;
}

// Flow from each frame to the next, and over one frame for points that were lost in it. Holds the
// pyramids of a few frames at a time: they are seven times as large as a frame.
void AddFlow(const std::vector<WorkingFrame>& frames, const ReliefOptions& options,
             const Progress& progress, std::vector<FlowFrame>& flows, PointGroups& groups) {
  constexpr std::size_t kAtOnce = 16;  // pyramids that are built in parallel
  Progress quiet;                      // the loop below reports
  quiet.stop = progress.stop;
  std::vector<int> alive;  // last sightings
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (k % kAtOnce == 0)
      ForEachIndex(static_cast<int>(std::min(kAtOnce, frames.size() - k)), options.threads, quiet,
                   "following points", [&](int i) {
                     const std::size_t at = k + static_cast<std::size_t>(i);
                     cv::buildOpticalFlowPyramid(frames[at].grey, flows[at].pyramid,
                                                 {kWindow, kWindow}, kPyramid);
                   });
    if (k > 2) flows[k - 3].pyramid.clear();
    progress.Step("following points",
                  0.6 * static_cast<double>(k) / static_cast<double>(frames.size()));
    const int frame = static_cast<int>(k);
    std::vector<int> next;
    std::vector<cv::Point2f> taken;
    for (int back = 1; back <= 2 && frame - back >= 0; ++back) {
      std::vector<int> from;
      std::vector<cv::Point2f> points, arrived;
      for (const int id : alive)
        if (groups.sighting(id).frame == frame - back) {
          from.push_back(id);
          points.push_back(groups.sighting(id).pixel);
        }
      std::vector<std::uint8_t> found;
      Follow(flows[k - static_cast<std::size_t>(back)], flows[k], points, arrived, found);
      for (std::size_t i = 0; i < from.size(); ++i) {
        if (!found[i]) {
          if (back == 1) next.push_back(from[i]);  // one more trial, from the frame after
          continue;
        }
        const int id = groups.Add(frame, arrived[i]);
        groups.Join(from[i], id);
        next.push_back(id);
        taken.push_back(arrived[i]);
      }
    }
    for (const cv::Point2f& p : NewPoints(frames[k], flows[k], taken, options.points))
      next.push_back(groups.Add(frame, p));
    alive = std::move(next);
  }
}

std::vector<Features> AddFeatures(const std::vector<WorkingFrame>& frames,
                                  const std::vector<FlowFrame>& flows, const ReliefOptions& options,
                                  const Progress& progress, PointGroups& groups) {
  const int count = static_cast<int>(frames.size());
  std::vector<Features> features(frames.size());
  ForEachIndex(count, options.threads, progress, "finding features", [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    const auto sift = cv::SIFT::create(kFeatures, 3, 0.01, 10, 1.6);
    sift->detectAndCompute(frames[at].grey, flows[at].inner, features[at].points,
                           features[at].descriptors);
  });
  std::vector<std::pair<int, int>> pairs;
  for (const int gap : kGaps)
    for (int a = 0; a + gap < count; ++a) pairs.emplace_back(a, a + gap);
  std::vector<std::vector<std::pair<int, int>>> matches(pairs.size());
  ForEachIndex(static_cast<int>(pairs.size()), options.threads, progress, "matching features",
               [&](int i) {
                 const auto [a, b] = pairs[static_cast<std::size_t>(i)];
                 matches[static_cast<std::size_t>(i)] = MatchFeatures(
                     features[static_cast<std::size_t>(a)], features[static_cast<std::size_t>(b)]);
               });
  std::vector<std::map<int, int>> sighting_of(frames.size());
  const auto id_of = [&](int frame, int feature) {
    auto& known = sighting_of[static_cast<std::size_t>(frame)];
    const auto entry = known.find(feature);
    if (entry != known.end()) return entry->second;
    const auto& keypoint =
        features[static_cast<std::size_t>(frame)].points[static_cast<std::size_t>(feature)];
    return known[feature] = groups.Add(frame, keypoint.pt, feature);
  };
  for (std::size_t p = 0; p < pairs.size(); ++p)
    for (const auto& [a, b] : matches[p])
      groups.Join(id_of(pairs[p].first, a), id_of(pairs[p].second, b));
  return features;
}

// The descriptors of a point where it was first, half-way and last seen as a feature.
cv::Mat DescriptorsOf(const std::vector<Sighting>& group, const std::vector<Features>& features) {
  std::vector<const Sighting*> found;
  for (const Sighting& s : group)
    if (s.feature >= 0) found.push_back(&s);
  cv::Mat descriptors;
  const std::size_t last = found.size() - 1;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (i == 0 || i == last || i == last / 2) {
      cv::Mat row;  // SIFT has whole numbers up to 255
      features[static_cast<std::size_t>(found[i]->frame)]
          .descriptors.row(found[i]->feature)
          .convertTo(row, CV_8U);
      descriptors.push_back(row);
    }
  return descriptors;
}

double Reach(const std::vector<Sighting>& group) {
  double reach = 0;
  for (const Sighting& s : group) reach = std::max(reach, cv::norm(s.pixel - group.front().pixel));
  return reach;
}

}  // namespace

std::vector<Track> FollowPoints(const std::vector<WorkingFrame>& frames, const Lens& lens,
                                const ReliefOptions& options, const Progress& progress) {
  std::vector<FlowFrame> flows(frames.size());
  ForEachIndex(static_cast<int>(frames.size()), options.threads, progress, "following points",
               [&](int i) {
                 const auto at = static_cast<std::size_t>(i);
                 cv::Mat padded;
                 cv::copyMakeBorder(frames[at].mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
                 cv::erode(padded, padded, cv::Mat(), {-1, -1}, kMargin);
                 flows[at].inner =
                     padded(cv::Rect(1, 1, frames[at].mask.cols, frames[at].mask.rows)).clone();
               });
  PointGroups groups;
  AddFlow(frames, options, progress, flows, groups);
  for (FlowFrame& flow : flows) flow.pyramid.clear();
  const std::vector<Features> features = AddFeatures(frames, flows, options, progress, groups);

  std::vector<std::vector<Sighting>> all = groups.Groups();
  // The clip's own motion, from tracks of three frames and more.
  constexpr double kMoves = 5, kFixed = 0.6;  // px
  std::vector<double> reaches;
  for (const auto& group : all)
    if (group.size() >= 3) reaches.push_back(Reach(group));
  std::sort(reaches.begin(), reaches.end());
  const bool clip_moves = !reaches.empty() && reaches[reaches.size() / 2] > kMoves;

  std::vector<Track> tracks;
  for (const auto& group : all) {
    if (group.size() >= 3 && clip_moves && Reach(group) < kFixed) continue;
    Track track;
    for (const Sighting& s : group) {
      const auto ray = RayFromPixel(lens, {s.pixel.x, s.pixel.y});
      if (ray) track.seen.push_back({s.frame, {s.pixel.x, s.pixel.y}, {ray->x, ray->y, ray->z}});
    }
    track.descriptors = DescriptorsOf(group, features);
    if (track.seen.size() >= 2) tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace arthro::authoring
