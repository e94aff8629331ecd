// A clip for composition: windows cut out of a picture, as from a pinhole camera perpendicular to
// it. The panorama must show the picture itself.
#pragma once

#include <functional>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/panorama/compose/compose.h"

namespace arthro::test {

inline constexpr int kWindowWidth = 160, kWindowHeight = 120;

inline Lens PinholeLens() {
  Lens lens;
  lens.model = LensModel::kPinhole;
  lens.width = kWindowWidth;
  lens.height = kWindowHeight;
  lens.focal_px = 300;
  lens.cx = (kWindowWidth - 1) / 2.0;
  lens.cy = (kWindowHeight - 1) / 2.0;
  lens.field_of_view = 0.65;
  return lens;
}

inline const authoring::Rectifier& PinholeRectifier() {
  static const authoring::Rectifier rectifier(PinholeLens(), authoring::RectifyOptions{});
  return rectifier;
}

// Soft blobs of tissue colours, nowhere near black or white; the same on every run.
inline cv::Mat TissuePicture(int width, int height) {
  cv::Mat picture(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double a = std::sin(x * 0.11) * std::cos(y * 0.13 + x * 0.02);
      const double b = std::sin(x * 0.031 + 1) + std::cos(y * 0.043);
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b(cv::saturate_cast<uchar>(170 + 12 * a + 8 * b),
                                              cv::saturate_cast<uchar>(115 + 14 * a + 10 * b),
                                              cv::saturate_cast<uchar>(100 + 12 * a - 6 * b));
    }
  return picture;
}

struct SmallClip {
  cv::Mat picture;
  std::vector<cv::Point> corners;  // top left corner of each window
  // Changes a window's picture; may be empty.
  std::function<void(int index, cv::Mat& window)> spoil;

  std::vector<authoring::FrameResult> Places() const {
    const auto& view = PinholeRectifier().view();
    const Lens lens = PinholeLens();
    std::vector<authoring::FrameResult> places;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      authoring::FrameResult place;
      place.index = static_cast<int>(i);
      place.is_placed = true;
      place.component = 0;
      place.panorama_from_rectified = {
          1, 0, corners[i].x + lens.cx - view.cx, 0, 1, corners[i].y + lens.cy - view.cy, 0, 0, 1};
      places.push_back(place);
    }
    return places;
  }

  authoring::FrameSource Source() const {
    return [this, at = 0](int& index, cv::Mat& raw) mutable {
      if (at == static_cast<int>(corners.size())) {
        at = 0;
        return false;
      }
      index = at++;
      raw = picture({corners[index], cv::Size(kWindowWidth, kWindowHeight)}).clone();
      if (spoil) spoil(index, raw);
      return true;
    };
  }

  authoring::ComposedPanorama Compose(const authoring::ComposeOptions& options = {},
                                      authoring::ComposeReport* report = nullptr,
                                      const Progress& progress = {},
                                      const authoring::ComposeObserver& observer = {}) const {
    return authoring::Compose(Source(), PinholeRectifier(), Places(), options, report, progress,
                              observer);
  }
};

// The panorama as RGB on the picture's pixels, and its opaque area (eroded by 3 px).
inline cv::Mat OnPicture(const authoring::ComposedPanorama& panorama, const cv::Size& size,
                         cv::Mat& mask) {
  cv::Mat seen, rgb;
  cv::warpPerspective(panorama.rgba, seen, panorama.composed_from_panorama, size,
                      cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  cv::extractChannel(seen, mask, 3);
  cv::erode(mask == 255, mask, cv::Mat::ones(7, 7, CV_8U));
  cv::cvtColor(seen, rgb, cv::COLOR_RGBA2RGB);
  return rgb;
}

}  // namespace arthro::test
