#include "authoring/phantom/phantom.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/core/option_fields.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// The portal lies outside the ellipsoid: follows the gradient of distance until the surface faces
// the portal.
glm::dvec3 NearestToPortal(const Cavity& cavity) {
  glm::dvec3 direction = glm::normalize(cavity.condyle.centre);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 x = CastEllipsoid(cavity.condyle, direction) * direction;
    direction =
        glm::normalize(direction - 0.3 * (NormalAt(cavity, Surface::kCondyle, x) + direction));
  }
  return CastEllipsoid(cavity.condyle, direction) * direction;
}

glm::dvec3 OnPlateau(const Cavity& cavity, double x, double y) {
  return cavity.plateau.portal_from_plateau * glm::dvec3(x, y, PlateauHeight(cavity.plateau, x, y));
}

}  // namespace

PhantomFrame FrameOf(const PhantomOptions& options) {
  PhantomFrame frame;
  frame.width = options.size == PhantomSize::kSmall    ? 1024
                : options.size == PhantomSize::kMedium ? 2048
                                                       : 4096;
  frame.height = frame.width / 4 * 3;
  frame.projection.type = options.projection;
  frame.projection.centre_px = {(frame.width - 1) / 2.0, (frame.height - 1) / 2.0};
  frame.projection.px_per_deg = frame.width / 200.0;
  frame.projection.focal_px = frame.width / (2.0 * std::tan(RadiansFromDegrees(60.0)));
  return frame;
}

Phantom MakePhantom(const PhantomOptions& options, const Progress& progress) {
  CheckOptions(options);
  Phantom phantom;
  phantom.options = options;
  phantom.cavity = MakeCavity(static_cast<std::uint32_t>(options.seed));
  const Cavity& cavity = phantom.cavity;
  const PhantomFrame frame = FrameOf(options);
  phantom.projection = frame.projection;
  phantom.meniscus = MakeMeniscus(cavity);
  phantom.cartilage = MakeCartilage(cavity);

  phantom.landmarks.push_back({"condyle apex, nearest to the portal", NearestToPortal(cavity)});
  phantom.landmarks.push_back(
      {"plateau, tibial spine", OnPlateau(cavity, cavity.plateau.eminence[0].centre.x,
                                          cavity.plateau.eminence[0].centre.y)});
  phantom.landmarks.push_back(
      {"plateau, middle of the cartilage bed",
       OnPlateau(cavity, cavity.plateau.bed.centre.x, cavity.plateau.bed.centre.y)});
  for (const PhantomTissue* tissue : {&phantom.meniscus, &phantom.cartilage})
    phantom.landmarks.insert(phantom.landmarks.end(), tissue->landmarks.begin(),
                             tissue->landmarks.end());

  TissueCaster tissues;
  tissues.Add(InPortal(phantom.meniscus), Surface::kMeniscus, phantom.meniscus.rims);
  tissues.Add(InPortal(phantom.cartilage), Surface::kCartilage, {});
  tissues.Sort();
  phantom.trace = MakeTrace(cavity, phantom.meniscus, phantom.incision_spacing);

  const VesselTrees vessels(cavity.seed);
  PhantomView view{cavity, vessels, nullptr, LookOf(options.difficulty)};
  const double exposure = ExposureOf(view, frame.projection, frame.width, frame.height);
  phantom.without_tissues =
      RenderPanorama(view, frame.projection, frame.width, frame.height, exposure, options.threads,
                     progress, "drawing the cavity");
  view.tissues = &tissues;
  phantom.with_tissues =
      RenderPanorama(view, frame.projection, frame.width, frame.height, exposure, options.threads,
                     progress, "drawing the tissues", &phantom.without_tissues);
  phantom.without_tissues.distances = {};
  return phantom;
}

}  // namespace arthro::authoring
