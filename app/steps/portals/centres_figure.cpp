#include "app/steps/portals/centres_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::app {

CentresFigure CentresOf(const Backdrop& backdrop, const CentresChoice& choice,
                        const std::filesystem::path& file) {
  if (!std::isfinite(choice.view_angle + choice.latitude_deg + choice.longitude_deg))
    throw Error(Code::kBadArgument, "an angle is not a number; give it in degrees");
  for (const double mm : choice.insertion_mm)
    if (!(mm >= 0.0) || MetresFromMm(mm) > backdrop.radius * (1.0 + 1e-12))
      throw Error(Code::kBadArgument,
                  fmt::format("an insertion of {} mm is not between 0 and the backdrop's radius of "
                              "{:g} mm; beyond it the tip would be behind the picture",
                              mm, MmFromMetres(backdrop.radius)),
                  file);
  const auto pixel_of = [&](const simulation::RodPose& pose, double angle) {
    return PixelFromDirection(backdrop.projection,
                              simulation::CentreDirection(pose, angle, backdrop.radius));
  };
  CentresFigure figure;
  const double latitude = RadiansFromDegrees(choice.latitude_deg),
               longitude = RadiansFromDegrees(choice.longitude_deg);
  figure.rod = pixel_of({latitude, longitude, 0, 0}, 0.0);
  figure.table = "insertion,roll_deg,u_px,v_px\n";
  for (const double mm : choice.insertion_mm) {
    CentresLine& line = figure.lines.emplace_back(CentresLine{fmt::format("{:g} mm", mm), {}});
    for (int step = 0; step < choice.roll_steps; ++step) {
      const double roll_deg = 360.0 * step / choice.roll_steps;
      const simulation::RodPose pose{latitude, longitude, RadiansFromDegrees(roll_deg),
                                     MetresFromMm(mm)};
      const auto pixel = pixel_of(pose, choice.view_angle);
      line.pixel.push_back(pixel);
      figure.table += fmt::format("{:.10g},{:.10g},", pose.depth, roll_deg);
      figure.table += pixel ? fmt::format("{:.10g},{:.10g}\n", pixel->x, pixel->y) : ",\n";
      figure.without_pixel += pixel ? 0 : 1;
    }
  }
  return figure;
}

ColourImage GridOf(int width, int height) {
  return GridPicture(width, height, std::max(2, width / 32));
}

namespace {

// Apart from one another, from tissue and from a grey grid, for most eyes.
const std::array kColours{cv::Scalar(0, 114, 178), cv::Scalar(213, 94, 0), cv::Scalar(0, 158, 115),
                          cv::Scalar(204, 0, 167), cv::Scalar(86, 60, 233)};
constexpr int kShift = 4;  // OpenCV's coordinates in sixteenths of a pixel

cv::Point Sixteenths(const glm::dvec2& pixel) {
  return {static_cast<int>(std::lround(16 * pixel.x)), static_cast<int>(std::lround(16 * pixel.y))};
}

// Far outside there is nothing to see, and coordinates would overflow.
bool IsNear(const glm::dvec2& p, const ColourImage& picture) {
  return std::abs(p.x) < 8.0 * picture.width && std::abs(p.y) < 8.0 * picture.height;
}

}  // namespace

ColourImage GridPicture(int width, int height, int spacing) {
  ColourImage picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      std::fill_n(picture.at(x, y), 3,
                  static_cast<std::uint8_t>(x % spacing == 0 || y % spacing == 0 ? 160 : 255));
  return picture;
}

void DrawCentres(ColourImage& picture, const std::optional<glm::dvec2>& rod,
                 const std::vector<CentresLine>& lines) {
  cv::Mat canvas(picture.height, picture.width, CV_8UC3, picture.rgb.data());
  const int thick = std::max(1, picture.width / 700);
  const double letters = std::max(0.35, picture.width / 1800.0);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const cv::Scalar& colour = kColours[k % kColours.size()];
    const auto& pixel = lines[k].pixel;
    for (std::size_t i = 0; i < pixel.size(); ++i) {
      const auto &a = pixel[i], &b = pixel[(i + 1) % pixel.size()];
      if (!a || !IsNear(*a, picture)) continue;
      if (b && IsNear(*b, picture))
        cv::line(canvas, Sixteenths(*a), Sixteenths(*b), colour, thick, cv::LINE_AA, kShift);
      cv::circle(canvas, Sixteenths(*a), 16 * 2 * thick, colour, cv::FILLED, cv::LINE_AA, kShift);
    }
  }
  // Legend of the lines, in the upper left corner.
  const int row = static_cast<int>(32 * letters), count = static_cast<int>(lines.size());
  cv::rectangle(canvas, cv::Rect(0, 0, 6 * row, row * count + row / 2), cv::Scalar::all(255),
                cv::FILLED);
  for (int k = 0; k < count; ++k)
    cv::putText(canvas, lines[static_cast<std::size_t>(k)].words, cv::Point(row / 2, row * (k + 1)),
                cv::FONT_HERSHEY_SIMPLEX, letters,
                kColours[static_cast<std::size_t>(k) % kColours.size()], thick, cv::LINE_AA);
  if (rod && IsNear(*rod, picture))
    cv::drawMarker(
        canvas,
        cv::Point(static_cast<int>(std::lround(rod->x)), static_cast<int>(std::lround(rod->y))),
        cv::Scalar(0, 0, 0), cv::MARKER_CROSS, 12 * thick, thick, cv::LINE_AA);
}

}  // namespace arthro::app
