#include "simulation/scene/tissue_parts.h"

namespace arthro {
namespace {

struct Scale {
  double by;
  void operator()(CapsuleCut& cut) const {
    cut.a *= by;
    cut.b *= by;
    cut.radius *= by;
  }
  void operator()(BoxCut& cut) const {
    cut.rest_from_box.translation *= by;
    cut.half *= by;
  }
  void operator()(TearCut& cut) const {
    for (glm::dvec3& x : cut.path) x *= by;
    cut.depth *= by;
    cut.width *= by;
    cut.lead *= by;
  }
};

}  // namespace

Ball Scaled(Ball ball, double scale) {
  ball.centre *= scale;
  ball.radius *= scale;
  return ball;
}

Cut Scaled(Cut cut, double scale) {
  std::visit(Scale{scale}, cut);
  return cut;
}

}  // namespace arthro
