// Simulates the deformable tissues beside the servo [method.md, Threads]. At display rate a step
// reads the newest pose of the instrument and writes the coupling for the servo and the picture.
// Steps run on a thread of their own, or inline on the clock of the servo where output must be
// reproducible (replay, tests). The functions for the servo are noexcept and never wait. Portal
// frame, m, s.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "simulation/core/latest_value.h"
#include "simulation/tissue/body/tissue_world.h"

namespace arthro::simulation {

enum class TissuePace { kInline, kThread };

class TissueLoop {
 public:
  TissueLoop(TissueWorld world, TissuePace pace, double period = 1.0 / 60.0);
  ~TissueLoop();
  TissueLoop(const TissueLoop&) = delete;
  TissueLoop& operator=(const TissueLoop&) = delete;

  // Called by the servo, once per tick of length dt. A step begins when a period has passed. While
  // the thread is busy, the step is left out and the next one covers the time of both.
  void Tick(const Instrumentation& tool, double dt) noexcept;
  // Called by the servo. Returns true when a step has ended since the last call, with its
  // `coupling`.
  bool TakeCoupling(ToolCoupling& coupling) noexcept;

  // Called by the servo: present solids of the implicit tissues. A reference is valid until the
  // next call with this index.
  std::size_t solid_count() const noexcept { return solids_.size(); }
  int TissueOfSolid(std::size_t index) const noexcept { return solids_[index]->tissue; }
  const PosedField& ReadSolid(std::size_t index) noexcept { return solids_[index]->newest.Read(); }

  // Called by the picture: newest picture, valid until the next call.
  const WorldPicture& Read() noexcept { return pictures_.Read(); }
  bool HasNew() const noexcept { return pictures_.HasNew(); }

  void Reset();  // waits for the running step; not on the servo path

  double period() const { return period_; }

 private:
  struct Request {
    Instrumentation tool;
    double dt = 0;
  };
  void Step(const Request& request) noexcept;
  void TakeMemory() noexcept;  // on the thread; steps are left out meanwhile
  void Publish() noexcept;

  TissueWorld world_;
  double period_;
  double since_ = 0;  // s, time of ticks since a step began
  Request request_;
  WorldPicture shown_;  // used by the steps only
  LatestValue<ToolCoupling> couplings_;
  LatestValue<WorldPicture> pictures_;
  struct Solid {
    explicit Solid(const ImplicitBody& body)
        : tissue(body.spec().tissue), version(body.shape_version()), newest(body.solid()) {}
    int tissue = -1;            // index in the scene
    std::uint64_t version = 0;  // version that was written last
    LatestValue<PosedField> newest;
  };
  void PublishSolids() noexcept;
  std::vector<std::unique_ptr<Solid>> solids_;
  struct Thread;
  std::unique_ptr<Thread> thread_;  // last member: it uses the others
};

}  // namespace arthro::simulation
