// One simulated tissue: elements, solver, skin, fixed nodes and cuts. A step finds the contacts of
// the tools, solves, moves the skin and sets the coupling that the servo uses until the next step.
// An untouched tissue at rest sleeps; its step then only tests a box. Own frame (the scene's tissue
// frame, scale applied), m, s, N; tools and couplings in the portal frame.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/mesh/tet_mesh.h"
#include "simulation/scene/scene.h"
#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/contact/coupling.h"
#include "simulation/tissue/contact/obstacle_contact.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::simulation {

struct BodySpec {
  std::string name;
  int tissue = 0;       // index in the scene
  TetMesh mesh;         // own frame
  SurfaceMesh surface;  // fine skin, same frame, closed
  Material material;
  std::vector<Ball> fixed;  // nodes in any of these are fixed
  std::vector<Cut> cuts;    // author's cuts: made at the start and on reset
  std::vector<Region> regions;
  Rigid3 portal_from_body;
  bool is_cuttable = false;
};

// State of one tool in one step, portal frame.
struct WorldTool {
  ToolShape shape;
  ToolInput now;
};

struct BodyReport {
  StepReport step;
  bool is_asleep = false;
  bool was_cut = false;     // in this step
  bool took_shape = false;  // this step made the elements and the skin that the last one cut
  bool was_reset = false;   // the solver failed and the last good state was restored; or lost
  int contacts = 0;
  double max_speed = 0;  // m/s
  // Tools of this step that slipped off, so that the servo feels nothing of it; and over the others
  // the largest force, N, with the largest error of the servo's force where the step solved it, N.
  int slipped = 0;
  double tool_force = 0, servo_error = 0;
  int factor_age = 0;  // steps
};

// Volume removed from a body so far, without the author's cuts.
struct CutReport {
  double removed = 0;        // m³, by tools and as debris
  int pieces = 1;            // number of parts, without debris
  int debris = 0;            // loose fragments that were washed away
  double debris_volume = 0;  // m³
  int cuts = 0;              // bites and shaving updates
  // m³ per region of the spec, then outside all regions; the sum is `removed`. Empty without
  // regions.
  std::vector<double> by_region;
  // m³ in the same places before any tool cut, after the author's cuts. Empty without regions.
  std::vector<double> volume_by_region;
};

// Skin of a body at rest, whole or after a cut.
struct BodySkin {
  SurfaceMesh surface;
  std::vector<std::uint8_t> is_fresh;  // 1 per vertex on a cut face; empty: whole
};

class DeformableBody {
 public:
  // Throws Error(kBadMesh) for a mesh that cannot be computed with. Throws Error(kBadScene) if
  // balls are given but contain no node. Without a ball the body floats.
  DeformableBody(BodySpec spec, const BodyOptions& options);
  ~DeformableBody();
  DeformableBody(DeformableBody&&) noexcept;
  DeformableBody& operator=(DeformableBody&&) noexcept;

  // `coupling` has one entry per tool, to which contacts of this body are added. `obstacle`
  // supports the body, or is null. A step that cuts does no more than that, the next one makes the
  // new shape, and the third solves for the time of all, so that none takes the time of two. A cut
  // that is due meanwhile follows the third.
  BodyReport Step(std::span<const WorldTool> tools, const RigidObstacle* obstacle, double dt,
                  std::span<ToolCoupling> coupling) noexcept;

  // Work that another thread does between Begin and Take, beside the steps: the plan of the factor
  // that a cut makes necessary, a new factor, or the preparation of the first cut, when a cutting
  // tool comes near. Without it the step plans and the cut prepares.
  bool WantsSideWork() const noexcept;
  void BeginSideWork();
  void RunSideWork() noexcept;
  void TakeSideWork() noexcept;
  // Sets a function that is called before a cut and before the plan is used. It waits for work that
  // runs elsewhere and takes it.
  void SetFinishSideWork(std::function<void()> finish);

  void Reset();  // to the untouched state: the author's cuts stay
  // Returns true after a cut ran out of memory: the body must not be shown. It becomes whole again
  // at the first step with enough memory and no work beside it.
  bool IsLost() const noexcept;

  const BodySpec& spec() const;
  const BodyState& state() const;
  std::span<const glm::dvec3> positions() const;  // positions of the skin's vertices
  std::span<const glm::dvec3> normals() const;
  const std::shared_ptr<const BodySkin>& skin() const;  // at rest; replaced by a cut
  std::uint64_t shape_version() const;                  // grows when positions change
  const TetMesh& mesh() const;                          // nodes as in state(); cut or whole
  const CutReport& cut_report() const;
  int held_nodes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arthro::simulation
