#include "simulation/practice/session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/finite.h"
#include "simulation/device/device_state.h"
#include "simulation/haptics/relief/shaft_hold.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::simulation {
namespace {

// Share of a change of the surfaces' push that a tick passes on to tissue and layers.
constexpr double kPushedAtOnce = 0.5;

// Offset by which surfaces and layers may press the tool between them; 0.25 N at 500 N/m.
constexpr double kSqueeze = 5e-4;  // m

// Limits the surfaces' push so that layers do not work against it. The offset of the proxy from the
// tip, `off`, is the sum of this push and of the layers' pull. Their scalar product is positive
// where the push ends inside the sphere with diameter `off`. Without the limit, a tool that fits
// between a layer and the backdrop nowhere would raise both without bound, and be held by the
// difference.
glm::dvec3 LimitSqueeze(const glm::dvec3& push, const glm::dvec3& off) noexcept {
  const glm::dvec3 from_centre = push - 0.5 * off;
  const double most = 0.5 * glm::length(off) + kSqueeze, length = glm::length(from_centre);
  return length > most ? 0.5 * off + most / length * from_centre : push;
}

glm::dvec2 PixelOrNan(const Projection& projection, const glm::dvec3& direction) noexcept {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return PixelFromDirection(projection, direction).value_or(glm::dvec2(kNan));
}

std::shared_ptr<const DepthField> MakeField(const LoadedScene& loaded,
                                            const DepthFieldOptions& options) {
  const Backdrop& backdrop = loaded.scene.backdrop;
  if (const DepthMap& depth = OrEmpty(loaded.depth); !depth.empty())
    return std::make_shared<const DepthField>(backdrop, depth, options,
                                              OrEmpty(loaded.depth_sigma));
  const ColourImage& panorama = OrEmpty(loaded.panorama);
  return std::make_shared<const DepthField>(backdrop, panorama.width, panorama.height, options);
}

// Compliance of deformable tissue along `force`, m/N; 0 where it is unknown.
double GiveAlong(const ToolCoupling& coupling, const glm::dvec3& force) noexcept {
  double stiffness = 0;
  for (int i = 0; i < std::min(coupling.count, kMaxToolContacts); ++i)
    stiffness += glm::dot(force, coupling.contact[static_cast<std::size_t>(i)].stiffness * force);
  return stiffness > 0 ? glm::dot(force, force) / stiffness : 0.0;
}

// A tip outside of its incision has a rod that points out of the joint (scope/rod_pose.h), whose
// shaft must not reach through the joint.
bool IsInJoint(const ToolState& state) noexcept { return state.pose.depth > 0.0; }

// Larger than the displacement of soft tissue by a tool.
constexpr double kHeldFromAfar = 5e-3;  // m

// Time in which the jaws close or open, so that tissue can enter between them.
constexpr double kJawTime = 0.15;  // s

// Rods are at most 0.5 m long, so a hand further from the incision is an invalid number.
constexpr double kFarthestHand = 10.0;  // m, from the incision

// Radius of the arthroscope's tube of 4 mm, with a round end.
constexpr double kScopeRadius = 2e-3;  // m

// Shape of the arthroscope: one capsule to the tip.
ToolShape ScopeShape() {
  constexpr double kLength = 0.12;  // m, longer than the part inside a joint
  ToolShape shape;
  shape.capsules = {{{0, 0, -kLength}, {0, 0, -kScopeRadius}, kScopeRadius}};
  return shape;
}

// Backdrop as the rigid obstacle of the tissues.
class BackdropObstacle : public RigidObstacle {
 public:
  explicit BackdropObstacle(std::shared_ptr<const DepthField> field) : field_(std::move(field)) {}
  double Gap(const glm::dvec3& x, glm::dvec3& normal) const noexcept override {
    // Skips the query where the whole backdrop is further away.
    const double clear = field_->free_radius() - glm::length(x);
    if (clear > kFar) return clear;
    const FieldQuery query = field_->Query(x);
    if (!(query.weight > 0.0)) return kFar;
    normal = query.normal;
    return query.clearance;
  }

 private:
  static constexpr double kFar = 2e-3;  // m
  std::shared_ptr<const DepthField> field_;
};

}  // namespace

Session::Session(const LoadedScene& loaded, const SessionOptions& options)
    : options_(options),
      field_(MakeField(loaded, options.depth)),
      projection_(loaded.scene.backdrop.projection),
      radius_(loaded.scene.backdrop.radius),
      spacing_(loaded.scene.portals.incision_spacing),
      view_angle_(loaded.scene.scope.view_angle) {
  const Scene& scene = loaded.scene;
  scope_.rig = scene.rig.scope;
  instrument_.rig = scene.rig.instrument;
  const std::size_t count = std::min(loaded.surfaces.size(), scene.tissues.size());
  for (std::size_t i = 0; i < count; ++i)
    meshes_.emplace_back(OrEmpty(loaded.surfaces[i]), scene.tissues[i].pose);
  away_.resize(count);
  is_live_.assign(count, 0);
  std::vector<ImplicitSpec> implicit = ImplicitOf(loaded);
  implicit_.reserve(implicit.size());
  for (ImplicitSpec& spec : implicit) {
    const auto i = static_cast<std::size_t>(spec.tissue);
    implicit_.emplace_back(std::move(spec), options.tissue);
    const ImplicitSpec& own = implicit_.back().spec();
    PlaceField(i, std::make_unique<FieldSurface>(
                      implicit_.back().solid(), PosedFunction{own.function, own.portal_from_body}));
  }
  scope_shape_ = ScopeShape();
  for (std::size_t kind = 0; kind < shapes_.size(); ++kind)
    shapes_[kind] = ShapeOf(static_cast<ToolKind>(kind));
  if (!scene.instruments.empty()) kind_ = ToolKindFromString(scene.instruments.front().kind);
}

void Session::SetInstrument(ToolKind kind) noexcept {
  if (kind == kind_) return;
  kind_ = kind;
  if (!instrument_.contact.has_started) return;  // it has not entered yet
  instrument_.is_remounted = true;
  instrument_.entry = 0.0;
}

void Session::SetIncisionSpacing(double spacing) noexcept {
  if (spacing == spacing_) return;
  spacing_ = spacing;
  instrument_.contact = ContactState{};
}

void Session::SetMount(DeviceRole role, const DeviceRig& mount) noexcept {
  Tool& tool = role == DeviceRole::kScope ? scope_ : instrument_;
  if (mount == tool.rig) return;
  tool.rig = mount;
  tool.is_remounted = true;
}

void Session::SetLiveTissues(std::span<const std::uint8_t> is_live) {
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    const std::uint8_t now = i < is_live.size() && is_live[i] != 0 ? 1 : 0;
    if (now == is_live_[i]) continue;
    std::swap(meshes_[i], away_[i]);
    is_live_[i] = now;
  }
}

void Session::Enliven(std::vector<BodySpec> bodies, TissuePace pace,
                      std::vector<LayerSpec> layers) {
  std::vector<LayerUnder> under;
  std::vector<std::uint8_t> is_live(meshes_.size(), 0);
  const auto take = [&is_live](int tissue) {
    if (tissue >= 0 && static_cast<std::size_t>(tissue) < is_live.size())
      is_live[static_cast<std::size_t>(tissue)] = 1;
  };
  for (const LayerSpec& layer : layers) {
    // A layer with an open surface has no inside, so it stays rigid.
    try {
      under.emplace_back(layer.surface, layer.portal_from_body, layer.layer, layer.tissue);
    } catch (const Error&) {
      continue;
    }
    take(layer.tissue);
  }
  for (const BodySpec& body : bodies) take(body.tissue);
  BodyOptions options = options_.tissue;
  options.contact.stiffness = options_.contact.stiffness;
  auto obstacle = field_->empty() ? nullptr : std::make_shared<const BackdropObstacle>(field_);
  TissueWorld world(std::move(bodies), options, std::move(obstacle), pace == TissuePace::kThread,
                    std::move(layers), implicit_);
  tissues_ = world.IsEmpty() ? nullptr : std::make_unique<TissueLoop>(std::move(world), pace);
  SetLiveTissues(is_live);
  layers_ = std::move(under);
  FeelSolids();
}

void Session::SetField(int tissue, std::shared_ptr<const ImplicitTissue> field) {
  const auto i = static_cast<std::size_t>(tissue);
  if (tissue < 0 || i >= meshes_.size()) return;
  PlaceField(i, field == nullptr ? nullptr : std::make_unique<FieldSurface>(std::move(field)));
}

void Session::PlaceField(std::size_t tissue, std::unique_ptr<FieldSurface> field) {
  fields_.resize(meshes_.size());
  instead_.resize(meshes_.size());
  fields_[tissue] = std::move(field);
  instead_[tissue] = fields_[tissue].get();
}

// Applies cuts from the tick after their step. The proxy follows by two pixels per tick
// (haptics/proxy.h), also out of a reset tissue, so the force does not jump.
void Session::FeelSolids() noexcept {
  if (!tissues_) return;
  for (std::size_t i = 0; i < tissues_->solid_count(); ++i)
    if (FieldSurface* felt = fields_[static_cast<std::size_t>(tissues_->TissueOfSolid(i))].get())
      felt->Become(tissues_->ReadSolid(i));
}

void Session::ResetTissues() {
  if (tissues_) tissues_->Reset();
}

void Session::SetCoupling(const ToolCoupling& coupling) noexcept {
  if (coupling.step != instrument_.tissue.to.step) TakeCoupling(instrument_.tissue, coupling);
}

// Updates age, speed and fault of the hand from its sample.
Fault Session::Receive(Tool& tool, const DeviceSample& sample, double dt) noexcept {
  if (!sample.valid) {
    tool.has_sample = false;
    return Fault::kNoSample;
  }
  const glm::dquat& q = sample.handle_in_device;
  if (!IsFinite(sample.hip_in_device) || !std::isfinite(q.w + q.x + q.y + q.z))
    return Fault::kNotFinite;
  if (!(glm::length(sample.hip_in_device - tool.rig.pivot) < kFarthestHand)) return Fault::kTooFar;
  tool.age += dt;
  if (!tool.has_sample || sample.t != tool.last.t) {
    const double way = glm::length(sample.hip_in_device - tool.last.hip_in_device);
    tool.hand_speed = tool.has_sample && tool.age > 0.0 ? way / tool.age : 0.0;
    tool.last = sample;
    tool.has_sample = true;
    tool.age = 0.0;
  }
  if (tool.age > options_.limiter.lost_after) return Fault::kLost;
  const double fresh_for = std::max(options_.limiter.max_sample_age, tool.fresh_for);
  if (tool.age >= fresh_for - kClockGrain) return Fault::kStale;
  return Fault::kNone;
}

// Computes where the layers hold a tool whose tip a spring pulls to `held`.
LayerHold Session::FeelLayers(Tool& tool, const glm::dvec3& portal, const glm::dvec3& held,
                              double stiffness, const ToolState& state) const noexcept {
  LayerHold hold;
  hold.tip = held;
  if (layers_.empty() || !IsInJoint(state)) return hold;
  // Pose as drawn: turned by the tip of the last tick, and moved along from there.
  const glm::dvec3 before = tool.let_be.value_or(portal);
  ToolInput as_drawn;
  as_drawn.is_present = true;
  as_drawn.opening = state.opening;
  as_drawn.portal_from_tool = PortalFromTool(portal, tool.let_be ? before : held, state.pose.roll);
  as_drawn.portal_from_tool.translation = glm::dvec3(0.0);
  std::array<Capsule, kMaxCapsules> capsules;
  const ToolShape& shape =
      &tool == &scope_ ? scope_shape_ : shapes_[static_cast<std::size_t>(kind_)];
  const int count = PosedCapsules(shape, as_drawn, capsules);
  hold = HoldOnLayers(layers_, {capsules.data(), static_cast<std::size_t>(count)}, held, before,
                      stiffness, options_.contact.sliding_friction);
  tool.let_be = hold.tip;
  tool.layer_push = hold.tip - held;
  return hold;
}

// Clears the contact of the tool, so that it enters anew.
void Session::Forget(Tool& tool) noexcept {
  tool.contact = ContactState{};
  tool.let_be.reset();
  tool.layer_push = tool.beside = tool.shaft_push = glm::dvec3(0.0);
}

// Turns the rod out of the relief, and adds the force of the ridge that holds its shaft: that of
// the spring between the tip where the surfaces leave it and the tip of the turned rod. The turn
// changes by at most `travel` per tick, as the proxy does, which bounds each step of the force.
void Session::TickShaft(Tool& tool, const glm::dvec3& portal, double travel, double stiffness,
                        ContactForce& contact, ToolState& state) const noexcept {
  const ShaftHold hold = HoldShaft(*field_, portal, tool.contact.proxy.position);
  const glm::dvec3 way = hold.tip - tool.contact.proxy.position - tool.shaft_push;
  const double length = glm::length(way);
  tool.shaft_push += length > travel ? travel / length * way : way;
  if (hold.held > 0.0) tool.shaft_weight = hold.weight;
  state.shaft_held = glm::length(tool.shaft_push);
  state.shaft_through = hold.through;
  if (!(state.shaft_held > 0.0)) return;
  const glm::dvec3 force = stiffness * tool.shaft_weight * tool.shaft_push;
  if (glm::length(force) > glm::length(contact.force)) contact.contact = kBackdropContact;
  contact.force += force;
}

void Session::TickTool(Tool& tool, const DeviceSample& sample, const glm::dvec3& portal, double dt,
                       ToolState& state) noexcept {
  if (tool.is_remounted) Forget(tool);
  Fault fault = Receive(tool, sample, dt);
  ContactForce contact;
  TipForce to_hand;
  if (fault == Fault::kNone || fault == Fault::kStale) {
    const RodPose pose =
        RodPoseFromHip(sample.hip_in_device, sample.handle_in_device, tool.rig, state.pose);
    const glm::dvec3 tip = portal + TipInOwnPortal(pose);
    if (IsFinite(tip)) {
      state.pose = pose;
      state.tip_in_portal = tip;
      to_hand.hand = tool.rig.portal_from_device * (sample.hip_in_device - tool.rig.pivot);
      const double travel = glm::distance(tip, tool.contact.tip) + 2.0 * field_->pixel_size();
      const Lever lever = LeverAt(to_hand.hand, tool.rig.rod_length, options_.lever);
      const double stiffness = std::min(options_.contact.stiffness, lever.max_stiffness);
      double give = 1.0 / options_.contact.stiffness;  // m/N, of all that yields
      // Tissue has the tool where everything else would let the hand put it, by the pushes of the
      // last ticks; so have the layers. Pushed by one half at a time: tissue that gives way less
      // than the spring to the hand would send the tool to and fro between itself and the backdrop.
      const bool is_pushed = tool.contact.contact >= 0;
      const glm::dvec3 push =
          is_pushed ? tool.contact.proxy.position - tool.contact.held : glm::dvec3(0.0);
      tool.beside = LimitSqueeze(tool.beside + kPushedAtOnce * (push - tool.beside),
                                 tool.contact.proxy.position - tip);
      const glm::dvec3 beside = tool.beside;
      state.tissue_tip_in_portal = tip + beside + tool.layer_push + tool.shaft_push;
      TissuePull pull;
      if (tool.tissue.to.step > 0) {
        const CoupledForce tissue =
            BlendedForce(tool.tissue, state.tissue_tip_in_portal, dt, kTissueFrame);
        pull = {tissue.force, tissue.tissue < 0 ? kNoContact : 1 + tissue.tissue};
        give = std::max(give, GiveAlong(tool.tissue.to, tissue.force));
        if (tool.tissue.to.is_faulty && fault == Fault::kNone) fault = Fault::kTissue;
      }
      const LayerHold layers = FeelLayers(
          tool, portal, tip + beside + tool.shaft_push + pull.force / options_.contact.stiffness,
          options_.contact.stiffness, state);
      if (layers.tissue >= 0) {
        if (glm::length(layers.force) > glm::length(pull.force)) pull.contact = 1 + layers.tissue;
        pull.force += layers.force;
        pull.normal = glm::normalize(layers.force);
        pull.depth = glm::length(tool.layer_push) + layers.depth;
        give = std::max(give, pull.depth / glm::length(layers.force));
        // A tool that is held from far off: would the layers hold it, had it just come in?
        if (glm::distance(tool.contact.proxy.position, tip) > kHeldFromAfar &&
            pull.force == layers.force) {
          const auto let_be = std::exchange(tool.let_be, std::nullopt);
          const glm::dvec3 layer_push = tool.layer_push;
          pull.is_free =
              FeelLayers(tool, portal, tip, options_.contact.stiffness, state).tissue < 0;
          tool.let_be = let_be;
          tool.layer_push = layer_push;
        }
      }
      contact = TickContact({*field_, meshes_, instead_}, options_.contact, stiffness, portal, tip,
                            dt, tool.contact, pull);
      if (tool.contact.was_let_go) {
        tool.let_be.reset();
        tool.layer_push = tool.beside = tool.shaft_push = glm::dvec3(0.0);
        contact = ContactForce{};
      }
      // The shaft of the scope starts at the centre of the relief, which it cannot cross.
      if (&tool == &instrument_) TickShaft(tool, portal, travel, stiffness, contact, state);
      if (layers.tissue >= 0) contact.penetration += layers.depth;
      state.is_layer_deep = layers.is_deep;
      state.layer = layers.tissue;
      state.layer_depth = layers.depth;
      to_hand.force = contact.force;
      to_hand.stiffness = stiffness / (options_.contact.stiffness * give);
      // Rigid surfaces alone store a known energy: that of a spring that the fade softens.
      to_hand.is_elastic = pull.force == glm::dvec3(0.0) && tool.shaft_push == glm::dvec3(0.0);
      if (to_hand.is_elastic && tool.contact.share > 0)
        to_hand.stiffness *= tool.contact.share * tool.contact.hold;
      to_hand.lever = lever;
    } else {
      fault = Fault::kNotFinite;
    }
  }
  // A tool that is gone, or not a number, enters anew when it comes back.
  if (fault != Fault::kNone && fault != Fault::kStale && fault != Fault::kTissue) Forget(tool);
  to_hand.hand_speed = tool.hand_speed;
  to_hand.fault = fault;
  to_hand.push = std::exchange(tool.is_remounted, false) ? HandPush::kNo : tool.push;
  const LimitedForce limited = ForceToHand({options_.passivity, options_.thermal, options_.limiter},
                                           to_hand, dt, tool.output);
  if (!tool.contact.has_started) {
    state.is_layer_deep = false;
    state.layer = -1;
  }
  if (!tool.contact.has_started) state.shaft_held = state.shaft_through = 0.0;
  state.proxy_in_portal = tool.contact.has_started ? tool.contact.proxy.position + tool.shaft_push
                                                   : state.tip_in_portal;
  state.tip_force = tool.entry * contact.force;
  if (tool.entry < 1.0)
    tool.entry = options_.limiter.ramp_time > 0.0
                     ? std::min(1.0, tool.entry + dt / options_.limiter.ramp_time)
                     : 1.0;
  state.hand_force = limited.force;
  state.contact = contact.contact;
  state.penetration = contact.penetration;
  state.fault = limited.fault;
}

// Moves the jaws by the button, and hands the tool to the tissue.
void Session::TickTissues(double dt) noexcept {
  ToolState& state = snapshot_.instrument;
  const bool is_pressed = instrument_.has_sample && (instrument_.last.buttons & 1u) != 0;
  state.opening = std::clamp(state.opening + (is_pressed ? -dt : dt) / kJawTime, 0.0, 1.0);
  state.is_running = is_pressed;
  if (!tissues_) return;
  Instrumentation hand;
  hand.kind = kind_;
  hand.now.is_present = instrument_.contact.has_started && IsInJoint(state);
  hand.now.portal_from_tool =
      PortalFromTool({spacing_, 0.0, 0.0}, state.tissue_tip_in_portal, state.pose.roll);
  hand.now.opening = state.opening;
  hand.now.is_running = state.is_running;
  if (state.layer >= 0)
    hand.press = {state.layer,
                  PortalFromTool({spacing_, 0.0, 0.0}, state.proxy_in_portal, state.pose.roll),
                  state.layer_depth};
  tissues_->Tick(hand, dt);
  ToolCoupling coupling;
  if (tissues_->TakeCoupling(coupling)) SetCoupling(coupling);
  FeelSolids();
}

void Session::Tick(const DeviceSample& scope, const DeviceSample& instrument, double dt) noexcept {
  const double step = dt > 0.0 && std::isfinite(dt) ? dt : 0.0;
  snapshot_.t += step;
  snapshot_.view_angle = view_angle_;
  snapshot_.incision_spacing = spacing_;
  snapshot_.head = head_;
  snapshot_.disturbances = disturbances_;
  snapshot_.kind = kind_;
  TickTool(scope_, scope, glm::dvec3(0.0), step, snapshot_.scope);
  TickTool(instrument_, instrument, {spacing_, 0.0, 0.0}, step, snapshot_.instrument);
  snapshot_.scope.pixel =
      PixelOrNan(projection_, CentreDirection(snapshot_.scope.pose, view_angle_, radius_));
  snapshot_.instrument.pixel = PixelOrNan(projection_, snapshot_.instrument.tip_in_portal);
}

}  // namespace arthro::simulation
