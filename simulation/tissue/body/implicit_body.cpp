#include "simulation/tissue/body/implicit_body.h"

#include <cmath>
#include <exception>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/tissue/cut/cutters.h"

namespace arthro::simulation {
namespace {

ImplicitTissue Sampled(const ImplicitSpec& spec, double spacing) {
  try {
    SolidField field = spec.function == nullptr
                           ? SolidField::FromSurface(spec.surface, spacing)
                           : SolidField::FromFunction(
                                 spec.function->bounds(), spacing,
                                 [&](const glm::dvec3& x) { return spec.function->Value(x); });
    MakeCuts(field, spec.cuts, spec.fixed);
    return {std::move(field),
            {spec.portal_from_body.translation, spec.portal_from_body.rotation, 1.0}};
  } catch (const Error& error) {
    throw Error(error.code(), spec.name + ": " + error.sentence(), error.file());
  }
}

bool Meets(const Capsule& tool, const Box3& box, double margin) {
  const double reach = tool.radius + margin;
  return glm::all(glm::lessThanEqual(glm::min(tool.a, tool.b) - reach, box.high)) &&
         glm::all(glm::lessThanEqual(box.low, glm::max(tool.a, tool.b) + reach));
}

}  // namespace

ImplicitBody::ImplicitBody(ImplicitSpec spec, const BodyOptions& options)
    : spec_(std::move(spec)),
      options_(options),
      whole_(Sampled(spec_, options.cut_spacing)),
      now_(whole_) {
  if (!spec_.regions.empty())
    report_.volume_by_region = VolumeByRegion(whole_.field(), spec_.regions);
  TakeSkin(kEmptyBox);
}

BodyReport ImplicitBody::Step(const WorldTool& tool, double dt) noexcept {
  BodyReport report;
  report.is_asleep = true;
  try {
    if (is_lost_) Reset();
    const ToolKind kind = tool.now.is_present ? tool.shape.kind : ToolKind::kNone;
    if (kind != std::exchange(kind_, kind)) trigger_ = CutTrigger{};
    if (!spec_.is_cuttable || kind == ToolKind::kNone) return report;
    double time = 0;
    const ToolCut cut = TriggerCut(kind, tool.now, dt, trigger_, time);
    if (cut == ToolCut::kNone) return report;
    const Rigid3 body_from_tool = Inverse(spec_.portal_from_body) * tool.now.portal_from_tool;
    const Capsule& bite = tool.shape.bite;
    report.was_cut =
        CutWith({body_from_tool * bite.a, body_from_tool * bite.b, bite.radius}, cut, time);
  } catch (const std::exception&) {  // no memory: restored soon, and reported
    is_lost_ = report.was_reset = true;
  }
  report.is_asleep = !report.was_cut && !report.was_reset;
  return report;
}

bool ImplicitBody::CutWith(const Capsule& tool, ToolCut cut, double time) {
  if (!std::isfinite(glm::length(tool.a) + glm::length(tool.b))) return false;
  SolidField& field = now_.field_to_edit();
  const double margin = 3.0 * field.spacing();
  if (!Meets(tool, field.box(), margin)) return false;
  const CapsuleCut shape{tool.a, tool.b, tool.radius};
  FieldEdit edit;
  if (cut == ToolCut::kBite) {
    edit = Apply(field, shape);
  } else {
    const Deformation at_rest = [](const glm::dvec3& rest, glm::dvec3& place) {
      place = rest;
      return true;
    };
    edit = Shave(
        field, BoundsOf(shape, margin), at_rest,
        [&](const glm::dvec3& x) { return DistanceTo(shape, x); }, options_.shaver, time, shaver_);
  }
  if (!(edit.removed > 0.0)) return false;
  report_.removed += edit.removed;
  ++report_.cuts;

  const auto [gone, pieces] = RemoveLoosePieces(field, spec_.fixed);
  report_.debris += gone.crumbs;
  report_.debris_volume += gone.edit.removed;
  report_.removed += gone.edit.removed;
  report_.pieces = pieces;
  report_.by_region.clear();
  if (!spec_.regions.empty())
    for (const RegionVolume& region : RemovedByRegion(whole_.field(), field, spec_.regions))
      report_.by_region.push_back(region.removed);
  TakeSkin(Union(edit.changed, gone.edit.changed));
  return true;
}

// Recomputes normals in the changed box and one spacing around it; the others stay.
void ImplicitBody::TakeSkin(const Box3& changed) {
  const double around = now_.field().spacing();
  const Box3 turned{changed.low - around, changed.high + around};
  const auto has_turned = [&](const glm::dvec3& x) {
    return !changed.empty() && glm::all(glm::lessThanEqual(turned.low, x)) &&
           glm::all(glm::lessThanEqual(x, turned.high));
  };
  update_ = now_.UpdateSkin();
  const SurfaceMesh& surface = now_.skin().surface();
  const std::span<const int> previous = now_.skin().previous();
  std::vector<glm::dvec3> normals(surface.vertices.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const int before = v < previous.size() ? previous[v] : -1;
    const bool is_known = before >= 0 && static_cast<std::size_t>(before) < normals_.size();
    normals[v] = is_known && !has_turned(surface.vertices[v])
                     ? normals_[static_cast<std::size_t>(before)]
                     : now_.solid().NormalInField(surface.vertices[v]);
  }
  skin_ =
      std::make_shared<const BodySkin>(BodySkin{surface, MarkFreshVertices(surface, now_.field())});
  normals_ = std::move(normals);
  ++version_;
}

void ImplicitBody::Reset() {
  if (report_.cuts == 0 && !is_lost_) return;
  now_ = whole_;
  std::vector<double> volumes = std::move(report_.volume_by_region);
  report_ = CutReport{};
  report_.volume_by_region = std::move(volumes);
  shaver_ = Shaver{};
  trigger_ = CutTrigger{};
  normals_.clear();
  TakeSkin(kEmptyBox);
  is_lost_ = false;
}

}  // namespace arthro::simulation
