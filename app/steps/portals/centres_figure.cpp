#include "app/steps/portals/centres_figure.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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

}  // namespace arthro::app
