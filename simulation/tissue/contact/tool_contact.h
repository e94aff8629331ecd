// Where a tool touches a tissue: capsules against the deformed skin, and, where the skin was passed
// (a teleport, a rolled hook), from inside by the rest shape's distance field. Mesh's own frame, m.
//
// Points spread over the skin, closer together than the tool is round, are kept out of its
// capsules; each bears for its part of the area, with the stiffness of a layer of the tissue that
// is thinner than anything a hand can tell. All of them are on one tool, which a spring of k ties
// to the hand: how the force is shared out among them is the solver's to find, and nothing of it is
// remembered.
//
// A hand presses its tool into tissue by F/k, at the 3 N of a firm push deeper than a meniscus is
// thick. Which skin is near is therefore asked of the tool as the tissue holds it, hand + offset,
// where it lies on the surface. ToolGrip carries that offset from step to step.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "simulation/core/box_tree.h"
#include "simulation/core/options.h"
#include "simulation/tissue/contact/closest_points.h"
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

inline constexpr int kMaxPieces = 128;        // of a tool; 1.5 mm or more each
inline constexpr int kMaxToolContacts = 256;  // of a tool on one tissue

// What is remembered of one tool on one tissue. A tool that was away begins with an empty one.
struct ToolGrip {
  glm::dvec3 offset{0.0};  // from the hand's tool to the tool as the tissue holds it, F/k
  int count = 0;           // of normals, away from the tissue, that held it
  std::array<glm::dvec3, 8> normal{};
};

// The skin with a tree over its triangles, refitted as it deforms.
class SkinContact {
 public:
  // `skin` and `field` must outlive it; the mesh is copied. `modulus`: Young's, of the tissue, Pa.
  SkinContact(const EmbeddedSkin& skin, const TetMesh& mesh, const SolidField& field,
              double modulus);
  // After the body moved: positions and normals of the skin's vertices, nodes at x.
  void Refit(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals,
             std::span<const glm::dvec3> x) noexcept;
  // Appends at most kMaxToolContacts contacts of the tool's capsules (in the mesh's frame already,
  // where the hand has them): the patch that they touch and what is near it.
  // `motion` is how far the tool went since the last step: friction drags along with it, and the
  // grip's tool follows it as far as the skin lets it. Without a grip the hand's tool is taken, and
  // tissue that it has passed is found from inside. Allocates only where `contacts` must grow.
  void Find(std::span<const Capsule> capsules, const glm::dvec3& motion, int owner,
            const ToolContactOptions& options, std::vector<ContactPoint>& contacts,
            ToolGrip* grip = nullptr) const noexcept;
  // How the skin bends, at rest, around where `results` push the tool; turned to face as the push
  // does. 1/m, positive for a hollow.
  glm::dmat3 Curvature(std::span<const ContactPoint> contacts,
                       std::span<const ContactResult> results, int owner) const noexcept;
  // How far the capsules would have to go along `out`, unit, until they are out of the skin as it
  // is at rest, m.
  double DepthAtRest(std::span<const Capsule> capsules, const glm::dvec3& out) const noexcept;
  // Is any capsule within `distance` of the skin's box? Wakes a sleeping body.
  bool IsNear(std::span<const Capsule> capsules, double distance) const noexcept;

 private:
  struct Piece {  // of a capsule
    glm::dvec3 a{0.0}, b{0.0};
    double radius = 0;
    int capsule = 0;
    double from = 0, to = 1;  // of the capsule's axis
  };
  struct Touch {                 // of one piece in the tissue
    double gap = 0;              // m, of the tool as held; negative: in the tissue
    glm::dvec3 axis{0.0};        // the piece's point
    glm::dvec3 normal{0, 0, 1};  // away from the tissue
    EmbeddedPoint point;
  };
  struct Sample {  // of the skin, near a capsule
    int triangle = 0, capsule = 0;
    glm::dvec3 at{1, 0, 0};  // barycentric
    double gap = 0, area = 0;
  };
  static constexpr int kMaxSamples = 2048;
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
  bool TouchFromInside(const Piece& piece, Touch& touch) const noexcept;
  // Points of the skin that are nearest to this piece of all, within `margin` of it.
  void AddSamples(const Piece& piece, std::span<const Capsule> capsules, double margin,
                  std::span<Sample> samples, std::size_t& count) const noexcept;
  ContactPoint ContactAt(const Sample& sample) const noexcept;
  double Clearance(std::span<const Piece> pieces, const glm::dvec3& offset,
                   double limit) const noexcept;
  glm::dvec3 Follow(std::span<const Piece> pieces, const glm::dvec3& motion,
                    const ToolGrip& grip) const noexcept;

  const EmbeddedSkin* skin_;
  const SolidField* field_;
  double hardness_;  // N/m a square metre
  ElementFinder finder_;
  std::vector<glm::dvec3> positions_, normals_, rest_normals_;
  BoxTree tree_;
  std::vector<int> leaf_begin_, leaf_vertex_;  // of the tree's leaves, one more; the skin's
};

// After the step: how the tissue holds the tool now. `contacts` and `results` are those of the
// step; those of other owners are left out.
void UpdateGrip(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                int owner, const ToolContactOptions& options, ToolGrip& grip) noexcept;

}  // namespace arthro::simulation
