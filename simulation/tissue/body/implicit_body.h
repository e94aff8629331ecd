// Tissue given by an implicit function in a session [paper, 3.4]. It does not deform, but bites and
// a running shaver remove parts of it, and loose parts are washed away. It is sampled on the grid
// that stores cuts. A step without a cut only tests a box. Own frame (the scene's tissue frame,
// scale applied), m, s; tools in the portal frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/scene/solids/solid_function.h"
#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/body/tool_cut.h"
#include "simulation/tissue/field/implicit_tissue.h"

namespace arthro::simulation {

struct ImplicitSpec {
  std::string name;
  int tissue = 0;       // index in the scene
  SurfaceMesh surface;  // own frame, closed
  // Function that the surface was made of, own frame; null: the surface alone is known.
  std::shared_ptr<const SolidFunction> function;
  Rigid3 portal_from_body;
  std::vector<Ball> fixed;      // pieces with a node in one of these stay; empty: the largest stays
  std::vector<Cut> cuts;        // author's cuts, made at the start
  std::vector<Region> regions;  // for the report's volumes
  bool is_cuttable = false;
};

class ImplicitBody {
 public:
  // Throws Error(kBadMesh), naming the tissue, for a surface that is open or not finite.
  ImplicitBody(ImplicitSpec spec, const BodyOptions& options);

  // is_asleep: nothing was removed.
  BodyReport Step(const WorldTool& tool, double dt) noexcept;
  void Reset();
  // Returns true after a cut ran out of memory; it becomes whole again at the first step with
  // enough.
  bool IsLost() const noexcept { return is_lost_; }

  const ImplicitSpec& spec() const { return spec_; }
  const PosedField& solid() const { return now_.solid(); }  // the shape that is felt
  std::span<const glm::dvec3> positions() const { return skin_->surface.vertices; }
  std::span<const glm::dvec3> normals() const { return normals_; }
  const std::shared_ptr<const BodySkin>& skin() const { return skin_; }
  std::uint64_t shape_version() const { return version_; }
  const CutReport& cut_report() const { return report_; }
  const SkinUpdate& skin_update() const { return update_; }  // cost of the last edit

 private:
  bool CutWith(const Capsule& tool, ToolCut cut, double time);
  void TakeSkin(const Box3& changed);

  ImplicitSpec spec_;
  BodyOptions options_;
  ImplicitTissue whole_, now_;
  std::shared_ptr<const BodySkin> skin_;  // shared with the pictures
  std::vector<glm::dvec3> normals_;
  CutReport report_;
  SkinUpdate update_;
  Shaver shaver_;
  CutTrigger trigger_;
  ToolKind kind_ = ToolKind::kNone;  // kind to which the trigger belongs
  std::uint64_t version_ = 1;
  bool is_lost_ = false;
};

}  // namespace arthro::simulation
