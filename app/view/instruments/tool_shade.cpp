#include "app/view/instruments/tool_shade.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "app/view/instruments/probe_mesh.h"
#include "app/view/shaders/constants.h"

namespace arthro::app {

bool ShowsTool(const Picture& picture) {
  return picture.instrument && !picture.plain &&
         glm::distance(picture.instrument->proxy, picture.instrument->portal) > 1e-6;
}

LensShade ShadeOf(const Picture& picture, const simulation::ToolShape& shape) {
  LensShade shade;
  shade.lamp = kLampAside * glm::dvec3(std::sin(picture.notch), std::cos(picture.notch), 0.0);
  if (!ShowsTool(picture)) return shade;
  const auto in_lens = [&view = picture.view](const glm::dvec3& x) {
    const glm::dvec3 d = x - view.tip;
    return glm::dvec3(glm::dot(d, view.right), glm::dot(d, view.up), -glm::dot(d, view.view));
  };
  constexpr double kShaft = 1.7e-3;  // m, radius of the shaft of the others
  const InstrumentView& tool = *picture.instrument;
  const bool is_probe = tool.kind == simulation::ToolKind::kProbe;
  shade.rod = {in_lens(tool.portal), in_lens(tool.proxy), kShaft};
  const int head = is_probe ? 0 : shape.jaw.empty() ? -1 : shape.jaw.front();
  if (head < 0) return shade;
  const Pose pose = ProbePose(tool.portal, tool.proxy, tool.roll);
  simulation::Capsule capsules[simulation::kMaxCapsules];
  simulation::PosedCapsules(shape, {true, {pose.quaternion, pose.position}, tool.opening},
                            capsules);
  shade.head = {in_lens(capsules[head].a), in_lens(capsules[head].b), capsules[head].radius};
  if (is_probe) {
    shade.rod.to = shade.head.from;
    shade.rod.radius = shade.head.radius / (1.0 - kRodTaper);
  }
  return shade;
}

}  // namespace arthro::app
