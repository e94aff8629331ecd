// A whole session again from a recording, on a fixed clock: one tick a millisecond or a little
// less, so that a tick falls on every row. Nothing in it depends on the machine's clock but the
// tick times of the report. Portal frame, m, N, s.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "simulation/core/progress.h"
#include "simulation/device/trace_io.h"
#include "simulation/session/session.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::simulation {

// One row of forces.csv, for one row of the trace.
struct ForceRow {
  double t = 0;
  DeviceRole device = DeviceRole::kScope;
  ToolState state;
};

// What one hand met, between its first and its last row.
struct HandReport {
  long rows = 0;
  double time_in_contact = 0;     // s
  double peak_force = 0;          // N, on the tip
  double mean_force = 0;          // N, on the tip while in contact
  double peak_hand_force = 0;     // N, after lever and limits
  double deepest = 0;             // m
  std::map<int, double> contact;  // s a surface: 0 the backdrop, 1 + i tissue i
  std::map<Fault, long> faults;   // ticks
};

// What became of one living tissue.
struct TissueReport {
  int tissue = 0;              // in the scene
  long steps = 0, resets = 0;  // of the steps that it was awake
  long fallbacks = 0;          // steps that recovered inverted elements
  int most_iterations = 0;     // of conjugate gradients, a step
  double step_ms = 0;          // mean of the steps it was awake, of this machine's processor
  double deepest = 0;          // m, the furthest that a vertex of its skin was from rest
  CutReport cut;
};

struct ReplayReport {
  double duration = 0;  // s of the trace
  long ticks = 0;
  std::array<HandReport, 2> hand;        // by DeviceRole
  double tick_median = 0, tick_p99 = 0;  // s of this machine, to a 32nd, without tissue
  std::vector<TissueReport> tissues;     // those that live
  std::vector<std::string> messages;     // repairs made while reading tetrahedra, one sentence each
};

// Called after each tick, its t in s; they are a millisecond or a little less apart, and one is on
// each row of the trace. `world` is null where nothing lives.
using ReplayWatch =
    std::function<void(double t, const Snapshot&, ToolKind, const WorldPicture* world)>;

// Tissues live by their `presets` and step inline; without presets all of them are rigid.
std::vector<ForceRow> Replay(const LoadedScene& loaded, const std::vector<TraceRow>& trace,
                             const SessionOptions& options = {}, const Progress& progress = {},
                             ReplayReport* report = nullptr,
                             const std::vector<TissuePreset>& presets = {},
                             const ReplayWatch& watch = {});

// forces.csv [method.md, File formats]: contact none|backdrop|tissue name, fault none|…; a tool
// over no pixel has u_px and v_px nan.
std::string ForcesText(const std::vector<ForceRow>& rows, const Scene& scene);

// JSON, "arthroscene.replay/1".
std::string ReportText(const ReplayReport& report, const Scene& scene);

}  // namespace arthro::simulation
