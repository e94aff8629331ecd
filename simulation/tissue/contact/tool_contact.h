// Where a tool touches a tissue: capsules against the deformed skin, and, where the skin was passed
// (a teleport, a rolled hook), from inside by the rest shape's distance field. Mesh's own frame, m.
//
// A hand presses its tool into tissue by F/k, at the 3 N of a firm push deeper than a meniscus is
// thick. Which skin is touched is therefore asked of the tool as the tissue holds it, hand +
// offset, where it lies on the surface; how hard, of the hand's. ToolGrip carries that offset from
// step to step. A patch is shared by the pieces of the tool that lie on it, each with its part of
// k, so the forces on a patch go over from piece to piece without a jump.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/tissue/contact/box_tree.h"
#include "simulation/tissue/contact/closest_points.h"
#include "simulation/tissue/contact/contact_point.h"
#include "simulation/tissue/contact/coupling.h"
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

inline constexpr int kMaxPieces = 128;  // of a tool; 1.5 mm or more each

// How a piece of a tool meets the skin.
struct Facing {
  double along = 0.5;          // where on the piece, 0 to 1
  glm::dvec3 normal{0, 0, 1};  // away from the tissue
};

// What is remembered of one tool on one tissue. A tool that was away begins with an empty one.
struct ToolGrip {
  glm::dvec3 offset{0.0};  // from the hand's tool to the tool as the tissue holds it, F/k
  int count = 0;           // of normals, away from the tissue, where it was touched last
  std::array<glm::dvec3, kMaxToolContacts> normal{};
  // A piece: its part of the patch, and how it met the skin.
  std::array<double, kMaxPieces> share{};
  std::array<Facing, kMaxPieces> facing{};
};

// The skin with a tree over its triangles, refitted as it deforms.
class SkinContact {
 public:
  // `skin` and `field` must outlive it; the mesh is copied.
  SkinContact(const EmbeddedSkin& skin, const TetMesh& mesh, const SolidField& field);
  // After the body moved: positions and normals of the skin's vertices, nodes at x.
  void Refit(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals,
             std::span<const glm::dvec3> x) noexcept;
  // Appends at most kMaxToolContacts contacts of the tool's capsules (in the mesh's frame already,
  // where the hand has them), spread over the patch that they touch. Stiffnesses are such that no
  // motion of the tool feels more than options.stiffness; pressed on one side they sum to it.
  // `motion` is how far the tool went since the last step: friction drags along with it, and the
  // grip's tool follows it as far as the skin lets it. Without a grip the hand's tool is taken, and
  // tissue that it has passed is found from inside. Allocates only where `contacts` must grow.
  void Find(std::span<const Capsule> capsules, const glm::dvec3& motion, int owner,
            const ToolContactOptions& options, std::vector<ContactPoint>& contacts,
            ToolGrip* grip = nullptr) const noexcept;
  // Is any capsule within `distance` of the skin's box? Wakes a sleeping body.
  bool IsNear(std::span<const Capsule> capsules, double distance) const noexcept;

 private:
  struct Piece {  // of a capsule
    glm::dvec3 a{0.0}, b{0.0};
    double radius = 0;
  };
  struct Touch {  // of one piece
    int piece = 0;
    double gap = 0;              // m, of the tool as held; negative: in the tissue
    double weight = 0;           // of the patch
    double along = 0.5;          // where on the piece
    glm::dvec3 axis{0.0};        // the piece's point
    glm::dvec3 normal{0, 0, 1};  // away from the tissue
    glm::dvec3 skin{0.0};        // the tissue's point
    EmbeddedPoint point;
    double radius = 0;
    bool is_inside = false;  // found by the field
  };
  struct OnSkin {
    int triangle = -1;
    glm::dvec3 at{1, 0, 0};  // barycentric
    double distance2 = 0;
  };
  TriangleCorners Corners(int triangle) const noexcept;
  Box3 BoxOf(int triangle) const noexcept;
  OnSkin NearestTo(const glm::dvec3& x, double limit) const noexcept;
  double NearestAlong(const Piece& piece, double limit, double& along) const noexcept;
  bool IsInside(const glm::dvec3& x) const noexcept;
  glm::dvec3 Blend(const OnSkin& on, const std::vector<glm::dvec3>& of) const noexcept;
  bool TouchOf(const Piece& piece, double margin, const Facing* before, double turn,
               Touch& touch) const noexcept;
  bool TouchFromInside(const Piece& piece, Touch& touch) const noexcept;
  double Clearance(std::span<const Piece> pieces, const glm::dvec3& offset,
                   double limit) const noexcept;
  glm::dvec3 Follow(std::span<const Piece> pieces, const glm::dvec3& motion,
                    const ToolGrip& grip) const noexcept;

  const EmbeddedSkin* skin_;
  const SolidField* field_;
  ElementFinder finder_;
  std::vector<glm::dvec3> positions_, normals_;
  BoxTree tree_;
};

// After the step: how the tissue holds the tool now. `contacts` and `results` are those of the
// step; those of other owners are left out.
void UpdateGrip(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                int owner, const ToolContactOptions& options, ToolGrip& grip) noexcept;

}  // namespace arthro::simulation
