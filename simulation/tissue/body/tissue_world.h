// All simulated tissues of a scene and the tools among them, advanced step by step [method.md,
// Threads]. Uses no clock and at most one thread, on request, to make factors. The same inputs give
// the same bits with and without it. Portal frame, m, s, N.
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

// Thin layer that the instrument presses, from the servo.
struct LayerPress {
  int tissue = -1;          // in the scene; −1: none
  Rigid3 portal_from_tool;  // equilibrium pose on the layer
  double depth = 0;         // m, of the tool's deepest point in the layer
};

// Instrument in the hand at a step: any kind, which may change during the session.
struct Instrumentation {
  ToolKind kind = ToolKind::kProbe;
  ToolInput now;
  LayerPress press;
};

// State of one tissue for the picture and the panels.
struct BodyPicture {
  int tissue = -1;                       // in the scene
  std::uint64_t shape = 0;               // changes when positions change
  std::shared_ptr<const BodySkin> skin;  // at rest; replaced by a cut
  std::vector<glm::dvec3> positions,
      normals;  // skin vertices, tissue frame, scale applied
  BodyReport report;
  CutReport cut;
  double step_ms = 0;  // processor time
  int elements = 0;    // number of elements, with those that cuts have added
};

struct WorldPicture {
  std::uint64_t step = 0;
  std::vector<BodyPicture> bodies;
};

class TissueWorld {
 public:
  // `obstacle` supports tissue, or is null. With `second_thread`, factors are made there. Layers
  // and implicit tissues are shown after the bodies, in this order; the servo computes their force
  // itself.
  TissueWorld(std::vector<BodySpec> specs, const BodyOptions& options,
              std::shared_ptr<const RigidObstacle> obstacle, bool second_thread,
              std::vector<LayerSpec> layers = {}, std::vector<ImplicitBody> implicit = {});
  ~TissueWorld();
  TissueWorld(TissueWorld&&) noexcept;
  TissueWorld& operator=(TissueWorld&&) noexcept;

  // Advances all bodies by dt with the present instrument; the scope does not push tissue.
  // noexcept: the reports tell what went wrong.
  void Step(const Instrumentation& instrument, double dt) noexcept;

  const ToolCoupling& coupling() const noexcept;
  // Copies the changes since `picture` was last filled.
  void Show(WorldPicture& picture) const;

  // Returns the implicit tissues, which the servo's proxy collides with.
  std::span<const ImplicitBody> implicit() const noexcept;

  bool IsEmpty() const noexcept;
  void Reset();
  // Takes the memory that cuts will need from the system, so that no step waits for it. Call it on
  // the thread that steps, before the first step and after Reset; takes up to 0.1 s. It changes no
  // result, and does nothing for tissues that cannot be cut.
  void TakeMemory() noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace arthro::simulation
