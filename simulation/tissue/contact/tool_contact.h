// Where a tool touches a tissue: capsules against the deformed skin, and, where the skin was passed
// (a teleport, a fast hand), from inside by the rest shape's distance field. Mesh's own frame, m.
#pragma once

#include <span>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/tissue/contact/contact_point.h"
#include "simulation/tissue/contact/embedded_skin.h"
#include "simulation/tissue/contact/tool_shape.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

struct ToolContactOptions {
  double stiffness = 500.0;
  double friction = 0.03;
  double margin = 1e-3;
  template <class V>
  void Visit(V&& v) {
    v("tool_stiffness", stiffness, Range{1, 1e6}, "N/m",
      "Spring between the hand and the instrument that touches tissue.");
    v("tissue_friction", friction, Range{0, 2}, "", "Coulomb coefficient of tool on wet tissue.");
    v("contact_margin", margin, Range{1e-5, 0.01}, "m", "Nearer than this is watched.");
  }
};

// The skin with a tree over its triangles, refitted as it deforms.
class SkinContact {
 public:
  SkinContact(const EmbeddedSkin& skin, const TetMesh& mesh, const SolidField& field);
  // After the body moved: positions and normals of the skin's vertices, nodes at x.
  void Refit(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals,
             std::span<const glm::dvec3> x) noexcept;
  // Appends at most kMaxToolContacts contacts of the tool's capsules (in the mesh's frame already),
  // spread over the patch that they touch, stiffnesses summing to options.stiffness a patch.
  // `motion` is how far the tool went since the last step: friction drags along with it.
  void Find(std::span<const Capsule> capsules, const glm::dvec3& motion, int owner,
            const ToolContactOptions& options, std::vector<ContactPoint>& contacts) const;
  // Is any capsule within `distance` of the skin's box? Wakes a sleeping body.
  bool IsNear(std::span<const Capsule> capsules, double distance) const noexcept;

 private:
  // (the implementer's)
};

}  // namespace arthro::simulation
