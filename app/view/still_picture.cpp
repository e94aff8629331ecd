#include "app/view/still_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/view/exposure/footage_light.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/practice/cut_skin.h"

namespace arthro::app {
namespace {

ColourImage Halved(const ColourImage& image) {
  ColourImage half(image.width / 2, image.height / 2);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < 3; ++c)
        half.at(x, y)[c] = static_cast<std::uint8_t>(
            (image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
             image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c] + 2) /
            4);
  return half;
}

void CheckInside(double depth, double radius) {
  if (!(depth <= radius * (1.0 + 1e-12)))
    throw Error(Code::kBadArgument,
                fmt::format("the scope's tip is {:.1f} mm from the portal, outside the backdrop's "
                            "sphere of {:.1f} mm; insert it less",
                            MmFromMetres(depth), MmFromMetres(radius)));
}

}  // namespace

Picture PictureFromPose(const simulation::RodPose& pose, double view_angle, double field_of_view,
                        std::optional<double> head_roll) {
  Picture picture;
  picture.view = simulation::ViewFromPose(pose, view_angle, head_roll);
  picture.field_of_view = field_of_view;
  picture.notch = head_roll ? pose.roll - *head_roll : 0.0;
  return picture;
}

Picture PictureOf(const simulation::Snapshot& snapshot, const simulation::RodPose& seen_from,
                  simulation::ToolKind kind, const simulation::ScopeOptics& optics,
                  const simulation::CameraHead& head) {
  const simulation::ToolState& tool = snapshot.instrument;
  Picture picture = PictureFromPose(seen_from, snapshot.view_angle, optics.field_of_view,
                                    simulation::HeadRoll(head, seen_from.roll));
  picture.lens = optics.lens;
  picture.camera = optics.camera;
  picture.relief = kUsualRelief;
  picture.instrument = InstrumentView{{snapshot.incision_spacing, 0.0, 0.0},
                                      tool.proxy_in_portal,
                                      tool.pose.roll,
                                      kind,
                                      tool.opening};
  return picture;
}

StillPictures::StillPictures(const LoadedScene& loaded,
                             std::span<const simulation::TissueLook> looks)
    : loaded_(loaded) {
  const DepthMap& depth = OrEmpty(loaded.depth);
  view_.SetBackdrop(OrEmpty(loaded.panorama), depth, WithKnownLight(loaded.scene.backdrop, depth),
                    OrEmpty(loaded.depth_sigma));
  const auto& tissues = loaded.scene.tissues;
  view_.SetTissues(tissues, loaded.surfaces, looks);
  for (std::size_t i = 0; i < std::min(tissues.size(), loaded.surfaces.size()); ++i) {
    const SurfaceMesh& surface = OrEmpty(loaded.surfaces[i]);
    if (!simulation::HasCutsMade(tissues[i]) || surface.triangles.empty()) continue;
    const simulation::BodySkin skin = simulation::CutSkin(tissues[i], surface);
    view_.SetTissueSurface(static_cast<int>(i), skin.surface, skin.is_fresh);
  }
}

simulation::ScopeEye& StillPictures::eye() {
  if (!eye_) eye_.emplace(loaded_);
  return *eye_;
}

simulation::RodPose StillPictures::Hold(const simulation::RodPose& pose) {
  CheckInside(std::abs(pose.depth), loaded_.scene.backdrop.radius);
  eye().Leave();
  return eye().MoveTo(pose, simulation::TipInOwnPortal(pose));
}

ColourImage StillPictures::Draw(const Picture& picture, int size) {
  if (size < kMinSize || size > kMaxSize)
    throw Error(Code::kBadArgument,
                fmt::format("a picture of {} pixels a side cannot be drawn; ask for {} to {}", size,
                            kMinSize, kMaxSize));
  CheckInside(glm::length(picture.view.tip), loaded_.scene.backdrop.radius);
  if (picture.camera && !picture.plain) {
    Picture fine = picture;
    fine.rays = 2;
    view_.Render(fine, size);
    return view_.ReadPixels();
  }
  view_.Render(picture, 2 * size);
  return Halved(view_.ReadPixels());
}

}  // namespace arthro::app
