#include "app/view/attempt_picture.h"

#include <cmath>

#include "app/view/still_picture.h"

namespace arthro::app {

Picture PictureOfFrame(const simulation::AttemptFrame& frame,
                       const simulation::ScopeOptics& optics) {
  const simulation::ToolFrame& scope = frame.tool[0];
  const simulation::ToolFrame& instrument = frame.tool[1];
  const glm::dvec3 axis(scope.axis);
  const simulation::RodPose pose{std::atan2(-axis.y, std::hypot(axis.x, axis.z)),
                                 std::atan2(axis.x, axis.z), scope.roll, scope.depth};
  Picture picture = PictureFromPose(pose, frame.view_angle, optics.field_of_view, frame.head_roll);
  picture.view.tip = glm::dvec3(frame.lens);
  picture.lens = optics.lens;
  picture.camera = optics.camera;
  picture.relief = kUsualRelief;
  picture.instrument = InstrumentView{{frame.incision_spacing, 0, 0},
                                      glm::dvec3(instrument.drawn_tip),
                                      instrument.roll,
                                      frame.instrument,
                                      frame.opening};
  picture.disturbances.haze = frame.haze;
  picture.disturbances.fog = frame.fog;
  return picture;
}

}  // namespace arthro::app
