#include "simulation/tissue/body/tissue_world.h"

#include <array>
#include <utility>

#include "simulation/core/background_worker.h"
#include "simulation/core/error.h"
#include "simulation/core/free_memory.h"
#include "simulation/core/process_cost.h"

namespace arthro::simulation {
namespace {

// Steps from the start of work beside them to its use, whether ready or waited for. The constant
// number gives the same bits in fast and slow sessions.
constexpr int kSideWorkSteps = 2;

// Memory that cuts take. A meniscus of 504 elements took 43 MB more while it was cut.
constexpr std::size_t kCutMemory = std::size_t{16} << 20, kCutMemoryOfElement = 80 << 10;  // bytes

// Copies the changes of one tissue since `shown` was last filled.
template <class Body>
void TakeShape(const Body& body, BodyPicture& shown) {
  if (shown.shape == body.shape_version() && shown.skin == body.skin()) return;
  shown.shape = body.shape_version();
  shown.skin = body.skin();
  shown.positions.assign(body.positions().begin(), body.positions().end());
  shown.normals.assign(body.normals().begin(), body.normals().end());
}

// Creates a body and adds its name to errors.
DeformableBody MakeBody(BodySpec spec, const BodyOptions& options) {
  const std::string name = spec.name;
  try {
    return DeformableBody(std::move(spec), options);
  } catch (const Error& error) {
    throw Error(error.code(), name + ": " + error.sentence(), error.file());
  }
}

}  // namespace

struct TissueWorld::Impl {
  Impl(std::shared_ptr<const RigidObstacle> rests_on, bool second_thread)
      : obstacle(std::move(rests_on)), worker(second_thread) {
    for (std::size_t i = 0; i < tools.size(); ++i)
      tools[i].shape = ShapeOf(static_cast<ToolKind>(i));
  }

  struct Held {
    DeformableBody body;
    BodyReport report;
    double step_ms = 0;
  };

  void FinishSideWork() noexcept {
    if (worked_on == nullptr) return;
    worker.Wait();
    worked_on->TakeSideWork();
    worked_on = nullptr;
  }

  void BeginSideWork(DeformableBody& of) noexcept {
    worked_on = &of;
    work_age = 0;
    of.BeginSideWork();
    worker.Start([](void* body) noexcept { static_cast<DeformableBody*>(body)->RunSideWork(); },
                 &of);
  }

  // Does the work of one body at a time.
  void WorkBeside() noexcept {
    if (worked_on != nullptr) {
      if (++work_age < kSideWorkSteps) return;
      FinishSideWork();
    }
    for (Held& held : bodies)
      if (held.body.WantsSideWork()) return BeginSideWork(held.body);
  }

  // Begins what the next step needs of a body that got the shape of a cut in this one.
  void WorkAfterCut() noexcept {
    for (Held& held : bodies)
      if (worked_on == nullptr && held.report.took_shape && held.body.WantsSideWork())
        BeginSideWork(held.body);
  }

  struct HeldLayer {
    LayerSkin skin;
    double step_ms = 0;
  };

  // Steps the layers with the tool as drawn, i.e. as far as the layer lets it.
  void StepLayers(const WorldTool& tool, const LayerPress& press) noexcept {
    for (HeldLayer& held : layers) {
      const double begin = ThreadCpuMs();
      if (held.skin.spec().tissue != press.tissue || !(press.depth > 0.0)) {
        held.skin.Release();
      } else {
        ToolInput drawn = tool.now;
        drawn.portal_from_tool = press.portal_from_tool;
        std::array<Capsule, kMaxCapsules> capsules;
        const int count = PosedCapsules(tool.shape, drawn, capsules);
        held.skin.Press({capsules.data(), static_cast<std::size_t>(count)}, press.depth);
      }
      held.step_ms = ThreadCpuMs() - begin;
    }
  }

  // Reports and times are stored outside the bodies, which are contiguous for their readers.
  void StepImplicit(const WorldTool& tool, double dt) noexcept {
    for (std::size_t i = 0; i < implicit.size(); ++i) {
      const double begin = ThreadCpuMs();
      of_implicit[i].report = implicit[i].Step(tool, dt);
      of_implicit[i].step_ms = ThreadCpuMs() - begin;
    }
  }

  struct OfStep {
    BodyReport report;
    double step_ms = 0;
  };

  std::vector<Held> bodies;
  std::vector<HeldLayer> layers;
  std::vector<ImplicitBody> implicit;
  std::vector<OfStep> of_implicit;
  std::array<WorldTool, static_cast<std::size_t>(ToolKind::kGrasper) + 1> tools;  // one per kind
  std::shared_ptr<const RigidObstacle> obstacle;
  ToolCoupling coupling;
  std::uint64_t step = 0;
  DeformableBody* worked_on = nullptr;
  int work_age = 0;
  BackgroundWorker worker;
};

TissueWorld::TissueWorld(std::vector<BodySpec> specs, const BodyOptions& options,
                         std::shared_ptr<const RigidObstacle> obstacle, bool second_thread,
                         std::vector<LayerSpec> layers, std::vector<ImplicitBody> implicit)
    : impl_(std::make_unique<Impl>(std::move(obstacle), second_thread && !specs.empty())) {
  impl_->bodies.reserve(specs.size());
  for (BodySpec& spec : specs) {
    impl_->bodies.push_back({MakeBody(std::move(spec), options), {}, 0});
    impl_->bodies.back().body.SetFinishSideWork([own = impl_.get()] { own->FinishSideWork(); });
  }
  for (LayerSpec& layer : layers) impl_->layers.push_back({LayerSkin(std::move(layer)), 0});
  impl_->implicit = std::move(implicit);
  impl_->of_implicit.resize(impl_->implicit.size());
  for (Impl::OfStep& of : impl_->of_implicit) of.report.is_asleep = true;
}
TissueWorld::~TissueWorld() = default;
TissueWorld::TissueWorld(TissueWorld&&) noexcept = default;
TissueWorld& TissueWorld::operator=(TissueWorld&&) noexcept = default;

void TissueWorld::Step(const Instrumentation& instrument, double dt) noexcept {
  Impl& own = *impl_;
  WorldTool& tool = own.tools[static_cast<std::size_t>(instrument.kind)];
  tool.now = instrument.now;
  own.WorkBeside();
  ToolCoupling coupling;
  coupling.step = ++own.step;
  coupling.tip = instrument.now.portal_from_tool.translation;
  for (Impl::Held& held : own.bodies) {
    const double begin = ThreadCpuMs();
    held.report = held.body.Step({&tool, 1}, own.obstacle.get(), dt, {&coupling, 1});
    held.step_ms = ThreadCpuMs() - begin;
  }
  own.WorkAfterCut();
  own.coupling = coupling;
  own.StepLayers(tool, instrument.press);
  own.StepImplicit(tool, dt);
}

const ToolCoupling& TissueWorld::coupling() const noexcept { return impl_->coupling; }

void TissueWorld::Show(WorldPicture& picture) const {
  picture.step = impl_->step;
  const std::size_t before_implicit = impl_->bodies.size() + impl_->layers.size();
  picture.bodies.resize(before_implicit + impl_->implicit.size());
  for (std::size_t i = 0; i < impl_->bodies.size(); ++i) {
    const Impl::Held& held = impl_->bodies[i];
    BodyPicture& shown = picture.bodies[i];
    shown.tissue = held.body.spec().tissue;
    shown.report = held.report;
    shown.cut = held.body.cut_report();
    shown.step_ms = held.step_ms;
    shown.elements = held.body.mesh().ElementCount();
    if (!held.body.IsLost()) TakeShape(held.body, shown);
  }
  for (std::size_t i = 0; i < impl_->layers.size(); ++i) {
    const auto& [layer, step_ms] = impl_->layers[i];
    BodyPicture& shown = picture.bodies[impl_->bodies.size() + i];
    shown.tissue = layer.spec().tissue;
    shown.report.is_asleep = !layer.is_pressed();
    shown.report.contacts = layer.is_pressed() ? 1 : 0;
    shown.step_ms = step_ms;
    TakeShape(layer, shown);
  }
  for (std::size_t i = 0; i < impl_->implicit.size(); ++i) {
    const ImplicitBody& body = impl_->implicit[i];
    BodyPicture& shown = picture.bodies[before_implicit + i];
    shown.tissue = body.spec().tissue;
    shown.report = impl_->of_implicit[i].report;
    shown.cut = body.cut_report();
    shown.step_ms = impl_->of_implicit[i].step_ms;
    if (!body.IsLost()) TakeShape(body, shown);
  }
}

std::span<const ImplicitBody> TissueWorld::implicit() const noexcept { return impl_->implicit; }

bool TissueWorld::IsEmpty() const noexcept {
  return impl_->bodies.empty() && impl_->layers.empty() && impl_->implicit.empty();
}

void TissueWorld::Reset() {
  impl_->FinishSideWork();
  for (Impl::Held& held : impl_->bodies) held.body.Reset();
  for (Impl::HeldLayer& held : impl_->layers) held.skin.Release();
  for (ImplicitBody& body : impl_->implicit) body.Reset();
  ReturnFreeMemory();  // all that the cuts took
}

void TissueWorld::TakeMemory() noexcept {
  std::size_t bytes = 0;
  for (const Impl::Held& held : impl_->bodies)
    if (held.body.spec().is_cuttable)
      bytes += kCutMemory +
               kCutMemoryOfElement * static_cast<std::size_t>(held.body.spec().mesh.ElementCount());
  if (bytes > 0) TakeMemoryAhead(bytes);
}

}  // namespace arthro::simulation
