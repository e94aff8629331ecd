// What is inside a DeformableBody, for the files that it is written in: stepping and cutting.
#pragma once

#include <functional>

#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/body/tool_cut.h"
#include "simulation/tissue/contact/embedded_skin.h"
#include "simulation/tissue/contact/obstacle_contact.h"
#include "simulation/tissue/contact/tool_contact.h"
#include "simulation/tissue/contact/uncut_surface.h"
#include "simulation/tissue/cut/cut_mesh.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/field/polygonise.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// All that a cut makes anew: elements, what is held, the skin and what finds contacts on it.
struct BodyShape {
  // `before`: of the shape before, or null; where it has the same elements only shares are new.
  BodyShape(TetMesh elements, std::span<const double> share, const BodySpec& spec,
            EmbeddedSkin carried, const SolidField& field, const FemModel* before);

  TetMesh mesh;
  std::shared_ptr<const FemModel> model;
  FixedAxes fixed;
  EmbeddedSkin skin;
  SkinContact skin_contact;
  ObstacleContact rest_contact;
  std::shared_ptr<const BodySkin> skin_at_rest;
};

// Kept from the author's first cut on, or from when a tool that cuts first comes near.
struct CutState {
  MeshCutter cutter;
  FieldSkin skin;
  SurfaceFinder uncut;
  SolidField original;                   // with the author's cuts, before the first tool's
  std::vector<int> element_of_vertex{};  // of the whole mesh, one a vertex of the field's skin
  std::vector<int>
      element_of_node{};  // of the whole mesh, one a node of the field; −1: far from it
  // Where in its element a node of the field is: kept, since a shaver asks ten times a second.
  std::vector<int> point_of_node{};  // index in `points`; −1: not asked yet
  std::vector<ElementPoint> points{};
  std::vector<unsigned char> is_near{};  // of the whole mesh: an element where the tool is now
  Shaver shaver{};
};

// A tool in the body's own frame.
struct PlacedTool {
  std::array<Capsule, kMaxCapsules> capsules;
  int count = 0;
  bool was_present = false;
  ToolKind kind = ToolKind::kNone;
  glm::dvec3 tip{0.0}, motion{0.0};
  ToolGrip grip;
  Capsule bite;  // what it takes when it closes or runs
  CutTrigger trigger;
  std::span<const Capsule> Capsules() const {
    return {capsules.data(), static_cast<std::size_t>(count)};
  }
};

struct DeformableBody::Impl {
  Impl(BodySpec given, const BodyOptions& chosen);

  void MoveSkin() noexcept;
  void TakeTools(std::span<const WorldTool> tools) noexcept;
  bool IsTouchedSoon() const noexcept;
  void AddCoupling(int tool, std::span<const ContactPoint> of_tools,
                   std::span<const ContactResult> results, ToolCoupling& coupling) noexcept;
  // Begins cutting, where a tool that cuts comes near: 50 ms that the first bite does not take.
  void PrepareToBeCut() noexcept;
  // Bites and shavings of this step; true when something was taken.
  bool CutWithTools(std::span<const WorldTool> tools, double dt);
  bool CutWith(const Capsule& tool, bool is_shaver, double dt);
  void BeginCutting();
  void MakeAuthorsCuts();
  void CountRegions();
  // The field changed within `box`: elements, state, solver and skin follow.
  void FollowField(const Box3& box);
  // For everything that has as many entries as the shape has nodes or the skin vertices.
  void MakeRoom();
  // At rest, of the elements that are where the tool is now; they are flagged in cut->is_near.
  Box3 RestBoxOf(const Capsule& tool);
  // Where a node of the field is now; false: not near the tool, or no tissue.
  bool PlaceOfNode(const glm::dvec3& rest, glm::dvec3& place);

  BodySpec spec;
  BodyOptions options;
  Rigid3 body_from_portal;
  ElementFinder finder;  // of the whole mesh
  SolidField field;
  std::unique_ptr<BodyShape> shape;
  std::unique_ptr<CutState> cut;  // null: whole
  CutReport taken;
  ImplicitSolver solver;
  ObstacleContactOptions on_obstacle;
  const RigidObstacle* lies_on = nullptr;  // that shape->rest_contact knows
  BodyState state, good;
  std::vector<glm::dvec3> load, positions, normals;
  std::vector<ContactPoint> contacts;
  std::vector<ContactResult> results;
  std::array<PlacedTool, 2> placed;
  std::size_t tool_count = 0;
  std::uint64_t shape_version = 0;
  bool is_asleep = true;  // at rest until it is touched
  int quiet = 0, since_good = 0, since_refresh = 0;
  bool wants_refresh = false;
  std::function<void()> finish_refresh;  // ends one that runs elsewhere
  bool is_refreshing = false;  // between Begin and Take another thread may work on the solver
  bool is_lost = false;        // a cut ended midway: to be made whole when nobody works on it
};

}  // namespace arthro::simulation
