#include "authoring/panorama/clip/text_boxes.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr double kJoined = 0.025;  // share of the picture's width: letters of one line are nearer
constexpr double kLeastSide = 0.006;    // share of the picture's width: smaller is dirt or noise
constexpr std::size_t kMostBoxes = 12;  // more are no text

// The raw pixels of one connected area.
cv::Rect RawBox(const std::vector<cv::Point>& area, const PreparedClip& clip) {
  const RectifiedView& view = clip.view;
  std::vector<cv::Point2f> raw;
  for (const cv::Point& p : area) {
    const glm::dvec2 rectified = (glm::dvec2(p.x, p.y) + 0.5) / clip.scale - 0.5;
    const glm::dvec3 ray((rectified.x - view.cx) / view.focal_px,
                         (rectified.y - view.cy) / view.focal_px, 1.0);
    if (const auto pixel = PixelFromRay(clip.lens.lens, ray))
      raw.emplace_back(static_cast<float>(pixel->x + clip.lens.part.x),
                       static_cast<float>(pixel->y + clip.lens.part.y));
  }
  return raw.empty() ? cv::Rect() : cv::boundingRect(raw);
}

cv::Rect Grown(const cv::Rect& box, int by) {
  return {box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by};
}

// Joins boxes until no two of them nearly touch.
void Join(std::vector<cv::Rect>& boxes, int gap) {
  for (bool has_joined = true; has_joined;) {
    has_joined = false;
    for (std::size_t i = 0; i < boxes.size() && !has_joined; ++i)
      for (std::size_t k = i + 1; k < boxes.size() && !has_joined; ++k)
        if ((Grown(boxes[i], gap) & boxes[k]).area() > 0) {
          boxes[i] |= boxes[k];
          boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(k));
          has_joined = true;
        }
  }
}

}  // namespace

std::vector<PixelBox> TextBoxes(const cv::Mat& cores, const PreparedClip& clip) {
  if (cores.empty()) return {};
  std::vector<std::vector<cv::Point>> areas;
  cv::findContours(cores, areas, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const cv::Rect whole(0, 0, clip.info.width, clip.info.height);
  std::vector<cv::Rect> boxes;
  for (const auto& area : areas)
    if (const cv::Rect box = RawBox(area, clip); box.area() > 0) boxes.push_back(box);
  Join(boxes, static_cast<int>(std::lround(kJoined * clip.info.width)));
  const int least = static_cast<int>(std::lround(kLeastSide * clip.info.width));
  std::erase_if(boxes,
                [&](const cv::Rect& box) { return std::min(box.width, box.height) < least; });
  // The middle of a stroke's last pixel was taken, and its edge is blurred by as much.
  const int edge = static_cast<int>(std::ceil(1.0 / clip.scale));
  for (cv::Rect& box : boxes) box = Grown(box, edge) & whole;
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const cv::Rect& a, const cv::Rect& b) { return a.area() > b.area(); });
  boxes.resize(std::min(boxes.size(), kMostBoxes));
  std::vector<PixelBox> found;
  found.reserve(boxes.size());
  for (const cv::Rect& box : boxes) found.push_back({box.x, box.y, box.width, box.height});
  return found;
}

std::vector<cv::Rect> BoxesIn(const std::vector<PixelBox>& boxes, const cv::Rect& whole) {
  std::vector<cv::Rect> inside;
  for (const PixelBox& box : boxes) {
    const cv::Rect part = cv::Rect(box.x, box.y, box.width, box.height) & whole;
    if (part.area() > 0) inside.push_back(part - whole.tl());
  }
  return inside;
}

}  // namespace arthro::authoring
