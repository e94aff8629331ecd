#include "simulation/tissue/body/deformable_body.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/finite.h"
#include "simulation/scene/mesh/held_nodes.h"
#include "simulation/tissue/body/deformable_body_impl.h"
#include "simulation/tissue/body/tool_cut.h"
#include "simulation/tissue/cut/cutters.h"

namespace arthro::simulation {
namespace {

constexpr int kQuietSteps = 20;    // slow and untouched steps before it sleeps
constexpr int kGoodEvery = 30;     // steps between two saved good states
constexpr int kRefreshPause = 10;  // steps between two factors, so that none is wasted

FixedAxes FixedBy(const std::vector<Ball>& balls, const TetMesh& mesh) {
  FixedAxes fixed = HeldNodes(mesh.rest_positions, balls);
  for (std::uint8_t& axes : fixed) axes *= 7;  // all three axes of a fixed node
  return fixed;
}

// Returns the mean edge length of the elements' corners, m.
double MeanEdge(const TetMesh& mesh) {
  double sum = 0;
  for (int e = 0; e < mesh.ElementCount(); ++e) {
    const int* node = &mesh.elements[static_cast<std::size_t>(e) *
                                     static_cast<std::size_t>(mesh.NodesPerElement())];
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        sum += glm::distance(mesh.rest_positions[static_cast<std::size_t>(node[i])],
                             mesh.rest_positions[static_cast<std::size_t>(node[j])]);
  }
  return mesh.ElementCount() > 0 ? sum / (6.0 * mesh.ElementCount()) : 0.0;
}

std::unique_ptr<BodyShape> WholeShape(const BodySpec& spec, const ElementFinder& finder,
                                      const SolidField& field) {
  return std::make_unique<BodyShape>(spec.mesh, std::span<const double>{}, spec,
                                     EmbedSkin(spec.surface, spec.mesh, finder),
                                     std::vector<std::uint8_t>{}, field, nullptr);
}

std::shared_ptr<const FemModel> MakeModel(const TetMesh& mesh, std::span<const double> share,
                                          const Material& material, const FemModel* before) {
  if (before == nullptr || before->mesh().elements != mesh.elements ||
      before->mesh().rest_positions != mesh.rest_positions)
    return std::make_shared<const FemModel>(mesh, material, share);
  auto model = std::make_shared<FemModel>(*before);
  model->SetShares(share);
  return model;
}

}  // namespace

BodyShape::BodyShape(TetMesh elements, std::span<const double> share, const BodySpec& spec,
                     EmbeddedSkin carried, std::vector<std::uint8_t> fresh, const SolidField& field,
                     const FemModel* before)
    : mesh(std::move(elements)),
      model(MakeModel(mesh, share, spec.material, before)),
      fixed(FixedBy(spec.fixed, mesh)),
      skin(std::move(carried)),
      skin_contact(skin, mesh, field, spec.material.young_modulus),
      rest_contact(mesh, fixed, model->NodeShares()),
      skin_at_rest(std::make_shared<const BodySkin>(BodySkin{skin.rest, std::move(fresh)})) {}

DeformableBody::Impl::Impl(BodySpec given, const BodyOptions& chosen)
    : spec(std::move(given)),
      options(chosen),
      body_from_portal(Inverse(spec.portal_from_body)),
      finder(spec.mesh),
      field(SolidField::FromSurface(spec.surface, options.cut_spacing)),
      shape(WholeShape(spec, finder, field)),
      solver(shape->model, shape->fixed, options.solver) {
  on_obstacle.stiffness = spec.material.young_modulus * MeanEdge(spec.mesh);
  on_obstacle.friction = options.contact.friction;
  if (!spec.fixed.empty() &&
      std::none_of(shape->fixed.begin(), shape->fixed.end(), [](auto bits) { return bits != 0; }))
    throw Error(Code::kBadScene,
                fmt::format("none of the {} balls that should hold it contains a node of its "
                            "mesh; paint where it is held again",
                            spec.fixed.size()));
  state.x = spec.mesh.rest_positions;
  state.v.assign(state.x.size(), glm::dvec3(0.0));
  ResizeBuffers();
  taken.by_region.assign(spec.regions.empty() ? 0 : spec.regions.size() + 1, 0.0);
  if (!spec.cuts.empty()) MakeAuthorsCuts();
  if (!spec.regions.empty()) taken.volume_by_region = VolumeByRegion(field, spec.regions);
}

// Resizes everything that has one entry per node of the shape or per vertex of the skin.
void DeformableBody::Impl::ResizeBuffers() {
  load.assign(state.x.size(), glm::dvec3(0.0));
  contacts.reserve(state.x.size() + placed.size() * kMaxToolContacts);
  results.resize(contacts.capacity());
  solver.Reserve(contacts.capacity());
  good = state;
  since_good = 0;
  positions.resize(shape->skin.rest.vertices.size());
  normals.resize(positions.size());
  known_obstacle = nullptr;
  MoveSkin();
}

void DeformableBody::Impl::MoveSkin() noexcept {
  DeformSkin(shape->skin, shape->mesh, state.x, positions, normals);
  shape->skin_contact.Refit(positions, normals, state.x);
  ++shape_version;
}

void DeformableBody::Impl::TakeTools(std::span<const WorldTool> tools) noexcept {
  tool_count = std::min(tools.size(), placed.size());
  for (std::size_t i = 0; i < tool_count; ++i) {
    PlacedTool& tool = placed[i];
    tool.count = PosedCapsules(tools[i].shape, tools[i].now, tool.capsules);
    for (int k = 0; k < tool.count; ++k) {
      Capsule& capsule = tool.capsules[static_cast<std::size_t>(k)];
      capsule.a = body_from_portal * capsule.a;
      capsule.b = body_from_portal * capsule.b;
      if (!std::isfinite(glm::length(capsule.a) + glm::length(capsule.b))) tool.count = 0;
    }
    const Rigid3 body_from_tool = body_from_portal * tools[i].now.portal_from_tool;
    tool.bite = {body_from_tool * tools[i].shape.bite.a, body_from_tool * tools[i].shape.bite.b,
                 tools[i].shape.bite.radius};
    // Another instrument inherits neither the grip nor the unfinished bite.
    const bool goes_on = tool.was_present && tool.count > 0 && tool.kind == tools[i].shape.kind;
    tool.motion = goes_on ? body_from_tool.translation - tool.tip : glm::dvec3(0.0);
    if (!goes_on) {
      tool.grip = ToolGrip{};
      tool.felt = TissueContact{};
      tool.trigger = CutTrigger{};
      tool.due = ToolCut::kNone;
      tool.due_time = 0;
    }
    tool.kind = tools[i].shape.kind;
    tool.tip = body_from_tool.translation;
    tool.was_present = tool.count > 0;
  }
}

bool DeformableBody::Impl::IsTouchedSoon() const noexcept {
  for (std::size_t i = 0; i < tool_count; ++i) {
    const PlacedTool& tool = placed[i];
    const double reach = options.contact.margin + glm::length(tool.motion);
    if (tool.count > 0 && shape->skin_contact.IsNear(tool.Capsules(), reach)) return true;
  }
  return false;
}

void DeformableBody::Impl::LeaveUnsolved(std::span<const WorldTool> tools, double dt,
                                         std::span<ToolCoupling> coupling) noexcept {
  unsolved += dt;
  for (std::size_t i = 0; i < tool_count; ++i) {
    PlacedTool& tool = placed[i];
    tool.tip -= tool.motion;  // the next step's motion is that of all
    const glm::dvec3& tip = tools[i].now.portal_from_tool.translation;
    if (i < coupling.size() && tool.count > 0 && tool.felt.tissue >= 0)
      AddMoved(tool.felt, tip - tool.felt_at, coupling[i]);
  }
}

void DeformableBody::Impl::AddCoupling(int tool, std::span<const ContactPoint> of_tools,
                                       std::span<const ContactResult> of_results,
                                       ToolCoupling& coupling, BodyReport& report) noexcept {
  if (placed[static_cast<std::size_t>(tool)].has_slipped) {
    ++report.slipped;
    return;
  }
  const auto [normal, size] = PushOf(of_tools, of_results, tool);
  if (normal == glm::dvec3(0.0)) return;
  const SkinContact& on_skin = shape->skin_contact;
  const std::span<const Capsule> capsules = placed[static_cast<std::size_t>(tool)].Capsules();
  const TouchedSkin touched{solver.ToolStiffness(tool, normal, options.coupling_tolerance),
                            on_skin.Curvature(of_tools, of_results, tool),
                            size > 0.0 ? on_skin.DepthAtRest(capsules, normal) : 0.0};
  AddContacts(of_tools, of_results, tool, touched, options.contact.stiffness,
              spec.portal_from_body.rotation, spec.tissue, coupling);
  const TissueContact* contact = ContactWith(coupling, spec.tissue);
  if (contact == nullptr) return;  // others bear more
  glm::dvec3 force(0.0);
  for (std::size_t i = 0; i < of_tools.size(); ++i)
    if (of_tools[i].owner == tool) force -= of_results[i].force;
  const glm::dvec3 felt = ForceOf(*contact, glm::dvec3(0.0));
  report.tool_force = std::max(report.tool_force, glm::length(force));
  report.servo_error =
      std::max(report.servo_error, glm::distance(felt, spec.portal_from_body.rotation * force));
}

DeformableBody::DeformableBody(BodySpec spec, const BodyOptions& options)
    : impl_(std::make_unique<Impl>(std::move(spec), options)) {}
DeformableBody::~DeformableBody() = default;
DeformableBody::DeformableBody(DeformableBody&&) noexcept = default;
DeformableBody& DeformableBody::operator=(DeformableBody&&) noexcept = default;

BodyReport DeformableBody::Step(std::span<const WorldTool> tools, const RigidObstacle* obstacle,
                                double dt, std::span<ToolCoupling> coupling) noexcept {
  if (impl_->is_lost && impl_->side_work == SideWork::kNone) {
    try {
      Reset();
    } catch (const std::exception&) {  // still no memory: stays as it is until there is some
    }
  }
  Impl& own = *impl_;
  BodyReport report;
  const auto lost = [&] {
    own.is_lost = report.was_reset = true;
    for (ToolCoupling& of_tool : coupling) of_tool.is_faulty = true;
    return report;
  };
  if (own.is_lost) return lost();
  own.TakeTools(tools);
  own.WantPreparation();
  if (own.is_asleep && !own.IsTouchedSoon()) {
    for (PlacedTool& tool : own.placed) tool.felt = TissueContact{};
    report.is_asleep = true;
    return report;
  }
  own.is_asleep = false;
  if (own.spec.is_cuttable) {
    try {
      report.took_shape = !own.edited.empty();
      report.was_cut = own.CutWithTools(tools, dt, own.unsolved == 0.0);
      if (report.took_shape) own.FollowField(std::exchange(own.edited, kEmptyBox));
    } catch (const std::exception&) {  // no memory: restored soon, and reported
      return lost();
    }
  }

  if (report.was_cut || report.took_shape) {
    own.LeaveUnsolved(tools, dt, coupling);
    for (const ToolCoupling& of_tool : coupling)
      report.contacts += ContactWith(of_tool, own.spec.tissue) != nullptr;
    return report;
  }
  dt += std::exchange(own.unsolved, 0.0);
  if (own.side_work == SideWork::kPlan && own.finish_side_work) own.finish_side_work();
  own.wants_plan = false;

  // Finds the present contacts.
  own.contacts.clear();
  for (std::size_t i = 0; i < own.tool_count; ++i)
    if (own.placed[i].count > 0)
      own.shape->skin_contact.Find(own.placed[i].Capsules(), own.placed[i].motion,
                                   static_cast<int>(i), own.options.contact, own.contacts,
                                   &own.placed[i].grip);
  const std::size_t of_tools = own.contacts.size();
  report.contacts = static_cast<int>(of_tools);
  if (obstacle != nullptr) {
    if (obstacle != own.known_obstacle)
      own.shape->rest_contact.AcceptRestOverlap(*obstacle, own.spec.portal_from_body,
                                                own.shape->mesh.rest_positions);
    own.known_obstacle = obstacle;
    own.shape->rest_contact.Find(*obstacle, own.spec.portal_from_body, own.state.x, own.on_obstacle,
                                 own.contacts);
  }

  // Solves. A state that is not finite is replaced by the last good one and reported.
  const std::span<ContactResult> results(own.results.data(), own.contacts.size());
  report.step = own.solver.Step(own.state, own.load, own.contacts, {}, dt, results);
  if (!report.step.is_finite || !AllFinite(own.state.x)) {
    own.state = own.good;
    own.MoveSkin();
    report.was_reset = true;
    for (ToolCoupling& of_tool : coupling) of_tool.is_faulty = true;
    return report;
  }
  own.MoveSkin();
  for (std::size_t i = 0; i < own.tool_count; ++i) {
    PlacedTool& tool = own.placed[i];
    const auto owner = static_cast<int>(i);
    UpdateGrip(own.contacts, results, owner, own.options.contact, tool.grip);
    tool.has_slipped = HasSlippedOff(tool.Capsules(), own.contacts, results, owner, tool.grip);
    if (tool.has_slipped) tool.grip = ToolGrip{};
  }
  for (const glm::dvec3& v : own.state.v)
    report.max_speed = std::max(report.max_speed, glm::length(v));
  if (++own.since_good >= kGoodEvery && report.step.inverted == 0) {
    own.good = own.state;
    own.since_good = 0;
  }

  // Sets what the servo feels until the next step.
  for (std::size_t i = 0; i < own.tool_count && i < coupling.size(); ++i) {
    own.AddCoupling(static_cast<int>(i), {own.contacts.data(), of_tools}, results.first(of_tools),
                    coupling[i], report);
    const TissueContact* felt = ContactWith(coupling[i], own.spec.tissue);
    own.placed[i].felt = felt != nullptr ? *felt : TissueContact{};
    own.placed[i].felt_at = tools[i].now.portal_from_tool.translation;
  }

  // Refreshes an old preconditioner; lets a body at rest sleep.
  ++own.since_refresh;
  report.factor_age = own.solver.factor_age();
  if (report.step.iterations > own.options.refresh_iterations * std::max(1, report.step.newton) &&
      own.since_refresh >= kRefreshPause)
    own.wants_refresh = true;
  const bool is_quiet = of_tools == 0 && report.max_speed < own.options.sleep_speed;
  own.quiet = is_quiet ? own.quiet + 1 : 0;
  if (own.quiet >= kQuietSteps) {
    own.is_asleep = true;
    own.quiet = 0;
    std::fill(own.state.v.begin(), own.state.v.end(), glm::dvec3(0.0));
  }
  return report;
}

bool DeformableBody::WantsSideWork() const noexcept {
  return impl_->wants_plan || impl_->wants_refresh || impl_->wants_preparation;
}

void DeformableBody::BeginSideWork() {
  if (std::exchange(impl_->wants_plan, false)) {
    impl_->side_work = SideWork::kPlan;
    return;
  }
  if (std::exchange(impl_->wants_preparation, false)) {
    impl_->side_work = SideWork::kPreparation;
    return;
  }
  impl_->side_work = SideWork::kFactor;
  impl_->wants_refresh = false;
  impl_->since_refresh = 0;
  impl_->solver.BeginRefresh();
}

void DeformableBody::RunSideWork() noexcept {
  if (impl_->side_work == SideWork::kPlan) return impl_->solver.RunPlan();
  if (impl_->side_work == SideWork::kFactor) return impl_->solver.RunRefresh();
  try {
    impl_->prepared = impl_->PreparedCut();
  } catch (const std::exception&) {
    impl_->prepared.reset();
  }
}

void DeformableBody::TakeSideWork() noexcept {
  if (impl_->side_work == SideWork::kPlan) impl_->solver.TakePlan();
  if (impl_->side_work == SideWork::kFactor) impl_->solver.TakeRefreshed();
  if (impl_->cut == nullptr) impl_->cut = std::move(impl_->prepared);
  if (impl_->side_work == SideWork::kPreparation) impl_->could_not_prepare = impl_->cut == nullptr;
  impl_->side_work = SideWork::kNone;
}

void DeformableBody::SetFinishSideWork(std::function<void()> finish) {
  impl_->finish_side_work = std::move(finish);
}

void DeformableBody::Reset() {
  const std::uint64_t version = impl_->shape_version;
  std::function<void()> finish = impl_->finish_side_work;
  if (finish) finish();
  impl_ = std::make_unique<Impl>(impl_->spec, impl_->options);
  impl_->finish_side_work = std::move(finish);
  impl_->shape_version += version;
}

bool DeformableBody::IsLost() const noexcept { return impl_->is_lost; }

const BodySpec& DeformableBody::spec() const { return impl_->spec; }
const BodyState& DeformableBody::state() const { return impl_->state; }
std::span<const glm::dvec3> DeformableBody::positions() const { return impl_->positions; }
std::span<const glm::dvec3> DeformableBody::normals() const { return impl_->normals; }
const std::shared_ptr<const BodySkin>& DeformableBody::skin() const {
  return impl_->shape->skin_at_rest;
}
std::uint64_t DeformableBody::shape_version() const { return impl_->shape_version; }
const TetMesh& DeformableBody::mesh() const { return impl_->shape->mesh; }
const CutReport& DeformableBody::cut_report() const { return impl_->taken; }
int DeformableBody::held_nodes() const {
  return static_cast<int>(std::count_if(impl_->shape->fixed.begin(), impl_->shape->fixed.end(),
                                        [](auto bits) { return bits != 0; }));
}

}  // namespace arthro::simulation
