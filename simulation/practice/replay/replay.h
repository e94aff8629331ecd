// A session driven by a recording on a fixed clock: ticks of 1 ms or slightly less, so that a tick
// falls on every row. Only the times of the report depend on the machine's clock. Portal frame, m,
// N, s.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "simulation/core/progress.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/practice/session.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::simulation {

// One row of forces.csv per row of the trace.
struct ForceRow {
  double t = 0;
  DeviceRole device = DeviceRole::kScope;
  ToolState state;
};

// Statistics of one hand, between its first and its last row.
struct HandReport {
  long rows = 0;
  double time_in_contact = 0;     // s
  double peak_force = 0;          // N, on the tip
  double mean_force = 0;          // N, on the tip while in contact
  double peak_hand_force = 0;     // N, after lever and limits
  double deepest = 0;             // m
  std::map<int, double> contact;  // s per surface: 0 the backdrop, 1 + i tissue i
  std::map<Fault, long> faults;   // ticks per fault
};

// Statistics of one deformable tissue.
struct TissueReport {
  int tissue = 0;              // index in the scene
  long steps = 0, resets = 0;  // steps while it was awake, and resets in them
  long fallbacks = 0;          // steps that recovered inverted elements
  int most_iterations = 0;     // conjugate-gradient iterations per step, largest
  double step_ms = 0;          // ms of processor time per step, mean while it was awake
  double deepest = 0;          // m, largest displacement of a skin vertex
  CutReport cut;
};

struct ReplayReport {
  double duration = 0;  // s of the trace
  long ticks = 0;
  std::array<HandReport, 2> hand;        // indexed by DeviceRole
  double tick_median = 0, tick_p99 = 0;  // s, without tissue, to 1/32 of their value
  std::vector<TissueReport> tissues;     // deformable tissues
  std::vector<std::string> messages;     // repairs made while reading tetrahedra, one sentence each
};

// Name of a surface that a tool touches: none, backdrop, or that of the tissue.
std::string ContactName(int contact, const Scene& scene);

// Called after each tick, which is at `t` in s. `world` is null where no tissue deforms.
using ReplayWatch = std::function<void(double t, const Snapshot&, const WorldPicture* world)>;

// Tissues deform by their `presets` and step inline; without presets all of them are rigid. View
// angle, incision spacing, instrument, resets of the tissue, camera head, disturbances and mounts
// follow the wishes of the recording; without wishes they stay as the scene has them. Options
// follow the recording, except those of `options` that are not at their default. A gap without any
// hand is ticked for its first minute; nothing moves in the rest of it, which is left out.
std::vector<ForceRow> Replay(const LoadedScene& loaded, const Recording& recording,
                             const SessionOptions& options = {}, const Progress& progress = {},
                             ReplayReport* report = nullptr,
                             const std::vector<TissuePreset>& presets = {},
                             const ReplayWatch& watch = {});

// Text of forces.csv [method.md, File formats]: contact none|backdrop|tissue name, fault none|…; a
// tool over no pixel has u_px and v_px nan.
std::string ForcesText(const std::vector<ForceRow>& rows, const Scene& scene);

// Text of the report as JSON, schema "arthroscene.replay/1".
std::string ReportText(const ReplayReport& report, const Scene& scene);

}  // namespace arthro::simulation
