// One living tissue: elements, solver, skin, what holds it and what was cut away. A step finds what
// the tools touch, solves, moves the skin, and says how the servo will feel it until the next step.
// A tissue that nothing touches and that has come to rest sleeps: its step costs a look at a box.
// Own frame (the scene's tissue frame, scale applied), m, s, N; tools and couplings in the portal
// frame.
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
#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/scene/tet_mesh.h"
#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/contact/coupling.h"
#include "simulation/tissue/contact/rigid_obstacle.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::simulation {

struct BodySpec {
  std::string name;
  int tissue = 0;       // index in the scene
  TetMesh mesh;         // own frame
  SurfaceMesh surface;  // its fine skin, same frame, closed
  Material material;
  std::vector<Ball> fixed;  // nodes in any of these are held
  std::vector<Cut> cuts;    // of the author: it begins, and is reset to, with these made
  std::vector<Region> regions;
  Rigid3 portal_from_body;
  bool is_cuttable = false;
};

// One tool for one step, portal frame.
struct WorldTool {
  ToolShape shape;
  ToolInput now;
};

struct BodyReport {
  StepReport step;
  bool is_asleep = false;
  bool was_cut = false;    // in this step
  bool was_reset = false;  // the solver failed: back at the last good state; or lost
  int contacts = 0;
  double max_speed = 0;  // m/s
  int factor_age = 0;    // steps
};

// What was taken of a body so far, the author's cuts not counted.
struct CutReport {
  double removed = 0;        // m³ by tools, debris included
  int pieces = 1;            // that it has fallen into, debris not counted
  int debris = 0;            // loose fragments that were washed away
  double debris_volume = 0;  // m³
  int cuts = 0;              // bites, and updates of shaving
  // m³, one a region of the spec, then what lies in none; their sum is `removed`. Empty: no
  // regions.
  std::vector<double> by_region;
};

// The skin of a body at rest, whole or after a cut.
struct BodySkin {
  SurfaceMesh surface;
  std::vector<std::uint8_t> is_fresh;  // a vertex: 1 on a cut face; empty: whole
};

class DeformableBody {
 public:
  // Throws Error(kBadMesh) for a mesh that cannot be computed with and Error(kBadScene) where balls
  // are given but hold no node. With no ball it floats.
  DeformableBody(BodySpec spec, const BodyOptions& options);
  ~DeformableBody();
  DeformableBody(DeformableBody&&) noexcept;
  DeformableBody& operator=(DeformableBody&&) noexcept;

  // `coupling`: one a tool, contacts of this body are added. `obstacle`: what it rests on, or null.
  BodyReport Step(std::span<const WorldTool> tools, const RigidObstacle* obstacle, double dt,
                  std::span<ToolCoupling> coupling) noexcept;

  // The factor of the solver is made anew on another thread between Begin and Take.
  bool WantsRefresh() const noexcept;
  void BeginRefresh();
  void RunRefresh() noexcept;
  void TakeRefresh() noexcept;
  // A cut needs a new factor at once: `finish` is called before, to wait for one that is being made
  // elsewhere and take it.
  void WhenCut(std::function<void()> finish);

  void Reset();  // as it was before it was touched: the author's cuts stay
  // There was no memory for a cut: what it is now is not to be shown, and it is whole again at the
  // first step that has memory and no refresh under way.
  bool IsLost() const noexcept;

  const BodySpec& spec() const;
  const BodyState& state() const;
  std::span<const glm::dvec3> positions() const;  // of the skin's vertices
  std::span<const glm::dvec3> normals() const;
  const std::shared_ptr<const BodySkin>& skin() const;  // at rest; another one after a cut
  std::uint64_t shape_version() const;                  // grows when positions change
  const TetMesh& mesh() const;                          // as state() has nodes; cut or whole
  const CutReport& cut_report() const;
  int held_nodes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arthro::simulation
