// Contact of a tool with a tissue: capsules against the deformed skin. A piece that has passed the
// skin (a jump, a rolled hook) is found from inside by the rest shape's distance field. Mesh's own
// frame, m.
//
// Skin samples, closer together than the tool's radius, are kept out of its capsules. Each sample
// bears for its part of the area with the stiffness of a tissue layer too thin to be felt. All of
// them act on one tool, which a spring of stiffness k ties to the hand. The solver finds how the
// force is distributed; nothing of that is stored.
//
// A hand presses its tool into tissue by F/k; at a firm push of 3 N that exceeds the thickness of a
// meniscus. Nearby skin is therefore searched around the tool as the tissue holds it (hand +
// offset), which lies on the surface. ToolGrip carries that offset from step to step.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "simulation/core/geometry/box_tree.h"
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
    v("contact_margin", margin, Range{1e-5, 0.01}, "m",
      "Distance within which skin is watched for contact.");
  }
};

inline constexpr int kMaxPieces = 128;        // per tool; 1.5 mm or more each
inline constexpr int kMaxToolContacts = 256;  // per tool on one tissue

// Memory of one tool on one tissue. A tool that was away starts with an empty grip.
struct ToolGrip {
  glm::dvec3 offset{0.0};  // from the commanded tool to the tool as the tissue holds it, F/k
  int count = 0;           // number of holding normals, pointing away from the tissue
  std::array<glm::dvec3, 8> normal{};
};

// Skin with a tree over its triangles, refitted as it deforms.
class SkinContact {
 public:
  // `skin` and `field` must outlive it; the mesh is copied. `modulus`: Young's modulus of the
  // tissue, Pa.
  SkinContact(const EmbeddedSkin& skin, const TetMesh& mesh, const SolidField& field,
              double modulus);
  // Call after the body has moved: positions and normals of the skin's vertices, nodes at x.
  void Refit(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals,
             std::span<const glm::dvec3> x) noexcept;
  // Appends at most kMaxToolContacts contacts of the tool's capsules: the touched patch and its
  // surroundings. Capsules are in the mesh's frame, at the commanded pose.
  // `motion` is the tool's motion since the last step. Friction acts along it, and the grip's tool
  // follows it as far as the skin permits. Without a grip the commanded tool is used, and tissue
  // that it has passed is found from inside. Allocates only if `contacts` must grow.
  void Find(std::span<const Capsule> capsules, const glm::dvec3& motion, int owner,
            const ToolContactOptions& options, std::vector<ContactPoint>& contacts,
            ToolGrip* grip = nullptr) const noexcept;
  // Returns the curvature of the skin at rest around the place where `results` push the tool,
  // rotated to face as the push does. 1/m, positive for a hollow.
  glm::dmat3 Curvature(std::span<const ContactPoint> contacts,
                       std::span<const ContactResult> results, int owner) const noexcept;
  // Returns how far the capsules would have to move along the unit vector `out` to leave the skin
  // at rest, m.
  double DepthAtRest(std::span<const Capsule> capsules, const glm::dvec3& out) const noexcept;
  // Returns whether any capsule is within `distance` of the skin's box, which wakes a sleeping
  // body.
  bool IsNear(std::span<const Capsule> capsules, double distance) const noexcept;

 private:
  struct Piece {  // part of a capsule
    glm::dvec3 a{0.0}, b{0.0};
    double radius = 0;
    int capsule = 0;
    double from = 0, to = 1;  // range on the capsule's axis
  };
  struct Touch {                 // contact of one piece inside the tissue
    double gap = 0;              // m, of the held tool; negative: in the tissue
    glm::dvec3 axis{0.0};        // point on the piece's axis
    glm::dvec3 normal{0, 0, 1};  // away from the tissue
    EmbeddedPoint point;
  };
  struct Sample {  // point of the skin near a capsule
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
  // Adds the skin points within `margin` of this piece that are nearer to it than to all other
  // pieces.
  void AddSamples(const Piece& piece, std::span<const Capsule> capsules, double margin,
                  std::span<Sample> samples, std::size_t& count) const noexcept;
  ContactPoint ContactAt(const Sample& sample) const noexcept;
  double Clearance(std::span<const Piece> pieces, const glm::dvec3& offset,
                   double limit) const noexcept;
  glm::dvec3 Follow(std::span<const Piece> pieces, const glm::dvec3& motion,
                    const ToolGrip& grip) const noexcept;

  const EmbeddedSkin* skin_;
  const SolidField* field_;
  double hardness_;  // N/m per m²
  ElementFinder finder_;
  std::vector<glm::dvec3> positions_, normals_, rest_normals_;
  BoxTree tree_;
  std::vector<int> leaf_begin_, leaf_vertex_;  // first vertex per leaf, and the end; the vertices
};

// Returns true where the points that push the tool lie away from it as they would hold it, and
// further than from the commanded tool: a tool that slips off crosses tissue in a step, and a
// contact is linear from where it was found. Such a push may be ten times what the skin can give.
// `capsules` are at the commanded pose, `grip` is that of UpdateGrip, arguments else as there.
bool HasSlippedOff(std::span<const Capsule> capsules, std::span<const ContactPoint> contacts,
                   std::span<const ContactResult> results, int owner,
                   const ToolGrip& grip) noexcept;

// Stores how the tissue holds the tool after the step. `contacts` and `results` are those of the
// step; other owners' contacts are ignored.
void UpdateGrip(std::span<const ContactPoint> contacts, std::span<const ContactResult> results,
                int owner, const ToolContactOptions& options, ToolGrip& grip) noexcept;

}  // namespace arthro::simulation
