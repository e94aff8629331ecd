// All living tissues of a scene and the tools among them, one step at a time [method.md, Threads].
// No clock and no threads of its own but one, on request, that makes factors anew; with it or
// without, the same inputs give the same bits. Portal frame, m, s, N.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/tissue/body/deformable_body.h"
#include "simulation/tissue/body/implicit_body.h"
#include "simulation/tissue/body/layer_skin.h"

namespace arthro::simulation {

// The thin layer that the instrument presses, as the servo says.
struct LayerPress {
  int tissue = -1;          // in the scene; −1: none
  Rigid3 portal_from_tool;  // where the layer lets it be
  double depth = 0;         // m, of the tool's deepest point in the layer
};

// The instrument in the hand at a step: any of the kinds, changed in mid-session.
struct Instrumentation {
  ToolKind kind = ToolKind::kProbe;
  ToolInput now;
  LayerPress press;
};

// Of one tissue, for the picture and the panels.
struct BodyPicture {
  int tissue = -1;                       // in the scene
  std::uint64_t shape = 0;               // another number: positions changed
  std::shared_ptr<const BodySkin> skin;  // at rest; another pointer: cut
  std::vector<glm::dvec3> positions,
      normals;  // of the skin's vertices, tissue frame, scale applied
  BodyReport report;
  CutReport cut;
  double step_ms = 0;  // of the processor
};

struct WorldPicture {
  std::uint64_t step = 0;
  std::vector<BodyPicture> bodies;
};

class TissueWorld {
 public:
  // `obstacle`: what tissue rests on, or null. `second_thread`: factors are made there. Layers and
  // what is a function of space are shown after the bodies, in this order: the servo has their
  // force itself.
  TissueWorld(std::vector<BodySpec> specs, const BodyOptions& options,
              std::shared_ptr<const RigidObstacle> obstacle, bool second_thread,
              std::vector<LayerSpec> layers = {}, std::vector<ImplicitBody> implicit = {});
  ~TissueWorld();
  TissueWorld(TissueWorld&&) noexcept;
  TissueWorld& operator=(TissueWorld&&) noexcept;

  // Advances all bodies by dt with the instrument as it is now; the scope pushes nothing aside.
  // noexcept: what goes wrong is in the reports.
  void Step(const Instrumentation& instrument, double dt) noexcept;

  const ToolCoupling& coupling() const noexcept;
  // Copies what changed since `picture` was last filled.
  void Show(WorldPicture& picture) const;

  // What the servo's proxy meets of these.
  std::span<const ImplicitBody> implicit() const noexcept;

  bool IsEmpty() const noexcept;
  void Reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arthro::simulation
