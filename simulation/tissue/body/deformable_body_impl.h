// Implementation of DeformableBody, shared by its source files for stepping and cutting.
#pragma once

#include <functional>

#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/body/tool_cut.h"
#include "simulation/tissue/contact/embedded_skin.h"
#include "simulation/tissue/contact/obstacle_contact.h"
#include "simulation/tissue/contact/tool_contact.h"
#include "simulation/tissue/cut/cut_mesh.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/field/carved_skin.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// Data that a cut rebuilds: elements, fixed nodes, skin and contact search.
struct BodyShape {
  // `before` is the previous shape's model, or null; if it has the same elements, only shares are
  // new. `fresh`: BodySkin::is_fresh.
  BodyShape(TetMesh elements, std::span<const double> share, const BodySpec& spec,
            EmbeddedSkin carried, std::vector<std::uint8_t> fresh, const SolidField& field,
            const FemModel* before);

  TetMesh mesh;
  std::shared_ptr<const FemModel> model;
  FixedAxes fixed;
  EmbeddedSkin skin;
  SkinContact skin_contact;
  ObstacleContact rest_contact;
  std::shared_ptr<const BodySkin> skin_at_rest;
};

// Data kept from the author's first cut on, or from when a cutting tool first comes near.
struct CutState {
  MeshCutter cutter;
  SkinCarver carver;
  SolidField original;                   // with the author's cuts, before the first tool's
  std::vector<int> element_of_vertex{};  // element of the whole mesh per vertex of the skin
  std::vector<int> whole_vertex{};       // CarvedSkin::whole_vertex of the skin
  CarvedSkin carved{};  // skin of the field since the last edit, for the next shape
  std::vector<int>
      element_of_node{};  // element of the whole mesh per node of the field; −1: far from it
  // Positions of field nodes in their elements; cached, since a shaver needs them ten times a
  // second.
  std::vector<int> point_of_node{};  // index in `points`; −1: not computed yet
  std::vector<ElementPoint> points{};
  std::vector<unsigned char> is_near{};  // per element of the whole mesh: near the tool now
  Shaver shaver{};
};

enum class SideWork { kNone, kPlan, kFactor, kPreparation };

// Tool in the body's own frame.
struct PlacedTool {
  std::array<Capsule, kMaxCapsules> capsules;
  int count = 0;
  bool was_present = false;
  bool has_slipped = false;  // off the tissue in the last step, which tells no force of it
  ToolKind kind = ToolKind::kNone;
  glm::dvec3 tip{0.0}, motion{0.0};
  ToolGrip grip;
  TissueContact felt;  // contact of the last solved step; tissue −1: none
  glm::dvec3 felt_at{0.0};
  Capsule bite;  // volume removed when it closes or runs
  CutTrigger trigger;
  ToolCut due = ToolCut::kNone;  // cut that waits for the step that may make it
  double due_time = 0;           // s, of a shaver's
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
                   std::span<const ContactResult> results, ToolCoupling& coupling,
                   BodyReport& report) noexcept;
  // Ends a step that cuts without solving: the contacts stay as the motion of the tools leaves
  // them.
  void LeaveUnsolved(std::span<const WorldTool> tools, double dt,
                     std::span<ToolCoupling> coupling) noexcept;
  bool IsAboutToCut(const PlacedTool& tool) const noexcept;
  // Asks for the preparation of the first cut when a cutting tool comes near; it takes longer than
  // a step.
  void WantPreparation() noexcept;
  // Returns whether the tool cuts some steps later, since the body is being prepared elsewhere.
  bool AwaitsPreparation(const PlacedTool& tool) const noexcept;
  // Takes the bites and shavings of this step, and applies them if it may; returns true if
  // something was removed.
  bool CutWithTools(std::span<const WorldTool> tools, double dt, bool may_cut);
  bool CutWith(const Capsule& tool, bool is_shaver, double dt);
  // Reads only what no step changes before the first cut.
  std::unique_ptr<CutState> PreparedCut() const;
  void MakeAuthorsCuts();
  void CountRegions();
  // Updates elements, state, solver and skin after the field changed within `box`, with the skin
  // that was carved. They still lack what changed in `edited`.
  void FollowField(const Box3& box);
  // Resizes everything that has one entry per node of the shape or per vertex of the skin.
  void ResizeBuffers();
  // Returns the box at rest of the elements near the tool and flags them in cut->is_near.
  Box3 RestBoxOf(const Capsule& tool);
  // Computes the present position of a field node; false: far from the tool, or no tissue.
  bool PlaceOfNode(const glm::dvec3& rest, glm::dvec3& place);

  BodySpec spec;
  BodyOptions options;
  Rigid3 body_from_portal;
  ElementFinder finder;  // for the whole mesh
  SolidField field;
  std::unique_ptr<BodyShape> shape;
  std::unique_ptr<CutState> cut;       // null: whole
  std::unique_ptr<CutState> prepared;  // made beside the steps
  bool could_not_prepare = false;      // no memory: the cut tries it again, and reports
  CutReport taken;
  ImplicitSolver solver;
  ObstacleContactOptions on_obstacle;
  const RigidObstacle* known_obstacle = nullptr;  // obstacle that shape->rest_contact knows
  BodyState state, good;
  std::vector<glm::dvec3> load, positions, normals;
  std::vector<ContactPoint> contacts;
  std::vector<ContactResult> results;
  std::array<PlacedTool, 2> placed;
  std::size_t tool_count = 0;
  std::uint64_t shape_version = 0;
  bool is_asleep = true;    // at rest until touched
  Box3 edited = kEmptyBox;  // box of the field that the shape does not follow yet
  double unsolved = 0;      // s, time of steps that cut, which the next one solves with its own
  int quiet = 0, since_good = 0, since_refresh = 0;
  bool wants_plan = false, wants_refresh = false, wants_preparation = false;
  std::function<void()> finish_side_work;  // waits for work that runs elsewhere
  SideWork side_work = SideWork::kNone;    // between Begin and Take another thread may do it
  bool is_lost = false;  // a cut failed midway: restored when no thread works on it
};

}  // namespace arthro::simulation
