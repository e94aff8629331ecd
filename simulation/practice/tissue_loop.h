// The living tissues beside the servo [method.md, Threads]: at display rate they take the newest
// pose of the instrument and leave what the servo needs to feel them by, and what the picture
// shows. On a thread of their own, or inline on the servo's clock where the same bytes must come
// out every time (replay, tests). The servo's side is noexcept and never waits for the tissue.
// Portal frame, m, s.
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

  // Servo's side, once a tick of length dt. A step begins whenever a period has passed; on a thread
  // that is still busy it is left out, and the next one covers the time of both.
  void Tick(const Instrumentation& tool, double dt) noexcept;
  // True when a step has ended since the last call; `coupling` is its.
  bool TakeCoupling(ToolCoupling& coupling) noexcept;

  // Servo's side: what of implicit() of the world is there now; valid until the next call with this
  // index. A copy is made by whoever cut it.
  std::size_t solid_count() const noexcept { return solids_.size(); }
  int TissueOfSolid(std::size_t index) const noexcept { return solids_[index]->tissue; }
  const PosedField& ReadSolid(std::size_t index) noexcept { return solids_[index]->newest.Read(); }

  // Picture's side: the newest; valid until the next call.
  const WorldPicture& Read() noexcept { return pictures_.Read(); }
  bool HasNew() const noexcept { return pictures_.HasNew(); }

  void Reset();  // waits for the step that runs; not on the servo path

  double period() const { return period_; }

 private:
  struct Request {
    Instrumentation tool;
    double dt = 0;
  };
  void Step(const Request& request) noexcept;
  void Publish() noexcept;

  TissueWorld world_;
  double period_;
  double since_ = 0;  // s of ticks since a step began
  Request request_;
  WorldPicture shown_;  // of the tissue's side
  LatestValue<ToolCoupling> couplings_;
  LatestValue<WorldPicture> pictures_;
  struct Solid {
    explicit Solid(const ImplicitBody& body)
        : tissue(body.spec().tissue), version(body.shape_version()), newest(body.solid()) {}
    int tissue = -1;            // in the scene
    std::uint64_t version = 0;  // that was written last
    LatestValue<PosedField> newest;
  };
  void PublishSolids() noexcept;
  std::vector<std::unique_ptr<Solid>> solids_;
  struct Thread;
  std::unique_ptr<Thread> thread_;  // last: it uses the rest
};

}  // namespace arthro::simulation
