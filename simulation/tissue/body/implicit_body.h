// A tissue that is a function of space in a session [paper, 3.4]: it does not give way, but bites
// and a running shaver take of it, and what they loosen is washed away. It is sampled on the grid
// that cuts are kept on. A step that takes nothing costs a look at a box. Own frame (the scene's
// tissue frame, scale applied), m, s; tools in the portal frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/body/tool_cut.h"
#include "simulation/tissue/field/implicit_tissue.h"

namespace arthro::simulation {

struct ImplicitSpec {
  std::string name;
  int tissue = 0;       // index in the scene
  SurfaceMesh surface;  // own frame, closed
  Rigid3 portal_from_body;
  std::vector<Ball> fixed;      // pieces with a node in one of these stay; none: the largest does
  std::vector<Cut> cuts;        // the author's: it begins with them
  std::vector<Region> regions;  // that the report counts by
  bool is_cuttable = false;
};

class ImplicitBody {
 public:
  // Throws Error(kBadMesh), with the tissue's name, for a surface that is open or not finite.
  ImplicitBody(ImplicitSpec spec, const BodyOptions& options);

  // is_asleep: nothing was taken.
  BodyReport Step(const WorldTool& tool, double dt) noexcept;
  void Reset();
  // There was no memory for a cut: it is whole again at the first step that has.
  bool IsLost() const noexcept { return is_lost_; }

  const ImplicitSpec& spec() const { return spec_; }
  const PosedField& solid() const { return now_.solid(); }  // what is felt
  std::span<const glm::dvec3> positions() const { return skin_->surface.vertices; }
  std::span<const glm::dvec3> normals() const { return normals_; }
  const std::shared_ptr<const BodySkin>& skin() const { return skin_; }
  std::uint64_t shape_version() const { return version_; }
  const CutReport& cut_report() const { return report_; }
  const SkinUpdate& skin_update() const { return update_; }  // what the last edit had to make anew

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
  ToolKind kind_ = ToolKind::kNone;  // that the trigger is of
  std::uint64_t version_ = 1;
  bool is_lost_ = false;
};

}  // namespace arthro::simulation
