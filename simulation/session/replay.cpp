#include "simulation/session/replay.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "simulation/device/recorded_device.h"
#include "simulation/session/living_tissues.h"
#include "simulation/session/time_histogram.h"

namespace arthro::simulation {
namespace {

constexpr double kTick = 0.001;  // s, the servo's

void Count(const ToolState& state, double dt, HandReport& hand) {
  if (state.fault != Fault::kNone) ++hand.faults[state.fault];
  hand.peak_hand_force = std::max(hand.peak_hand_force, glm::length(state.hand_force));
  if (state.contact < 0) return;
  const double force = glm::length(state.tip_force);
  hand.contact[state.contact] += dt;
  hand.time_in_contact += dt;
  hand.mean_force += force * dt;  // a sum until the end
  hand.peak_force = std::max(hand.peak_force, force);
  hand.deepest = std::max(hand.deepest, state.penetration);
}

void CountTissues(const WorldPicture& world, std::vector<TissueReport>& reports) {
  reports.resize(world.bodies.size());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const BodyPicture& body = world.bodies[i];
    TissueReport& report = reports[i];
    report.tissue = body.tissue;
    report.cut = body.cut;
    if (body.report.is_asleep) continue;
    ++report.steps;
    report.resets += body.report.was_reset;
    report.fallbacks += body.report.step.used_fallback;
    report.most_iterations = std::max(report.most_iterations, body.report.step.iterations);
    report.step_ms += body.step_ms;  // a sum until the end
    if (body.skin == nullptr) continue;
    for (std::size_t v = 0; v < body.positions.size(); ++v)
      report.deepest = std::max(report.deepest,
                                glm::distance(body.positions[v], body.skin->surface.vertices[v]));
  }
}

std::string ContactName(int contact, const Scene& scene) {
  if (contact < 0) return "none";
  if (contact == kBackdropContact) return "backdrop";
  const auto tissue = static_cast<std::size_t>(contact - 1);
  if (tissue < scene.tissues.size() && !scene.tissues[tissue].name.empty())
    return scene.tissues[tissue].name;
  return fmt::format("tissue {}", contact);
}

// The entry after the last region's is what lies in none.
std::string RegionName(const Scene& scene, int tissue, std::size_t index) {
  const auto& regions = scene.tissues[static_cast<std::size_t>(tissue)].regions;
  return index < regions.size() ? regions[index].name : kElsewhere;
}

// A name with a comma, a quote or a line break goes in quotes, its own quotes doubled (RFC 4180).
std::string CsvField(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::vector<ForceRow> Replay(const LoadedScene& loaded, const std::vector<TraceRow>& trace,
                             const SessionOptions& options, const Progress& progress,
                             ReplayReport* report, const std::vector<TissuePreset>& presets,
                             const ReplayWatch& watch) {
  using Clock = std::chrono::steady_clock;
  std::vector<ForceRow> forces;
  if (trace.empty()) return forces;
  forces.reserve(trace.size());
  Session session(loaded, options);
  ReplayReport counts;
  EnlivenTissues(session, loaded, presets, TissuePace::kInline, &counts.messages);
  RecordedDevice scope(trace, DeviceRole::kScope), instrument(trace, DeviceRole::kInstrument);
  TimeHistogram times;
  const WorldPicture* world = session.tissues();
  const auto tick = [&](double t, double dt) {
    const DeviceSample scope_sample = scope.At(t), instrument_sample = instrument.At(t);
    const Clock::time_point start = Clock::now();
    session.Tick(scope_sample, instrument_sample, dt);
    times.Add(std::chrono::duration<double>(Clock::now() - start).count());
    ++counts.ticks;
    session.TickTissues(dt);
    if (session.HasNewTissues()) CountTissues(*(world = session.tissues()), counts.tissues);
    if (scope_sample.valid) Count(session.snapshot().scope, dt, counts.hand[0]);
    if (instrument_sample.valid) Count(session.snapshot().instrument, dt, counts.hand[1]);
    if (watch) watch(t, session.snapshot(), session.instrument(), world);
  };

  const double begin = trace.front().sample.t, end = trace.back().sample.t;
  double now = begin;
  tick(now, kTick);
  for (std::size_t row = 0; row < trace.size();) {
    // Equal ticks from the last row to this one, the last of them on it.
    const double next = trace[row].sample.t;
    if (next > now) {
      const double gap = next - now;
      const long steps = std::max(1L, static_cast<long>(std::ceil(gap / kTick - 1e-6)));
      for (long i = 1; i <= steps; ++i) {
        tick(i == steps ? next : now + gap * (static_cast<double>(i) / static_cast<double>(steps)),
             gap / static_cast<double>(steps));
        if (counts.ticks % 1000 == 0) progress.Step("replay", (now - begin) / (end - begin));
      }
      now = next;
    }
    for (; row < trace.size() && trace[row].sample.t == next; ++row) {
      const bool is_scope = trace[row].device == DeviceRole::kScope;
      forces.push_back({next, trace[row].device,
                        is_scope ? session.snapshot().scope : session.snapshot().instrument});
      ++counts.hand[is_scope ? 0 : 1].rows;
    }
  }
  progress.Step("replay", 1.0);
  if (report != nullptr) {
    for (HandReport& hand : counts.hand)
      if (hand.time_in_contact > 0.0) hand.mean_force /= hand.time_in_contact;
    for (TissueReport& tissue : counts.tissues)
      if (tissue.steps > 0) tissue.step_ms /= static_cast<double>(tissue.steps);
    counts.duration = end - begin;
    counts.tick_median = times.Quantile(0.5);
    counts.tick_p99 = times.Quantile(0.99);
    *report = counts;
  }
  return forces;
}

std::string ForcesText(const std::vector<ForceRow>& rows, const Scene& scene) {
  std::string text =
      "t,device,tip_x,tip_y,tip_z,force_x,force_y,force_z,hand_x,hand_y,hand_z,u_px,v_px,contact,"
      "penetration,fault\n";
  for (const auto& [t, device, state] : rows) {
    const glm::dvec3 &tip = state.tip_in_portal, &force = state.tip_force;
    const glm::dvec3& hand = state.hand_force;
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},", t, Word(device),
                   tip.x, tip.y, tip.z, force.x, force.y, force.z, hand.x, hand.y, hand.z);
    // One word for all of not-a-number's bit patterns.
    for (double pixel : {state.pixel.x, state.pixel.y})
      text += std::isnan(pixel) ? std::string("nan,") : fmt::format("{},", pixel);
    fmt::format_to(std::back_inserter(text), "{},{},{}\n",
                   CsvField(ContactName(state.contact, scene)), state.penetration,
                   Word(state.fault));
  }
  return text;
}

std::string ReportText(const ReplayReport& report, const Scene& scene) {
  nlohmann::ordered_json json;
  json["schema"] = "arthroscene.replay/1";
  json["duration"] = report.duration;
  json["ticks"] = report.ticks;
  for (const DeviceRole role : {DeviceRole::kScope, DeviceRole::kInstrument}) {
    const HandReport& hand = report.hand[static_cast<std::size_t>(role)];
    if (hand.rows == 0) continue;
    nlohmann::ordered_json& entry = json["devices"][Word(role)];
    entry["rows"] = hand.rows;
    entry["peak_force"] = hand.peak_force;
    entry["mean_force"] = hand.mean_force;
    entry["peak_hand_force"] = hand.peak_hand_force;
    entry["time_in_contact"] = hand.time_in_contact;
    entry["deepest_penetration"] = hand.deepest;
    entry["contacts"] = nlohmann::ordered_json::object();
    for (const auto& [contact, seconds] : hand.contact)
      entry["contacts"][ContactName(contact, scene)] = seconds;
    entry["faults"] = nlohmann::ordered_json::object();
    for (const auto& [fault, ticks] : hand.faults) entry["faults"][Word(fault)] = ticks;
  }
  for (const TissueReport& tissue : report.tissues) {
    nlohmann::ordered_json& entry = json["tissues"][ContactName(1 + tissue.tissue, scene)];
    entry["steps_awake"] = tissue.steps;
    entry["resets"] = tissue.resets;
    entry["recoveries"] = tissue.fallbacks;
    entry["most_iterations"] = tissue.most_iterations;
    entry["mean_step_ms"] = tissue.step_ms;
    entry["largest_displacement"] = tissue.deepest;
    entry["removed_mm3"] = tissue.cut.removed * 1e9;
    for (std::size_t i = 0; i < tissue.cut.by_region.size(); ++i)
      entry["removed_mm3_by_region"][RegionName(scene, tissue.tissue, i)] =
          tissue.cut.by_region[i] * 1e9;
    entry["cuts"] = tissue.cut.cuts;
    entry["pieces"] = tissue.cut.pieces;
    entry["debris"] = tissue.cut.debris;
  }
  json["tick_us"] = {{"median", report.tick_median * 1e6}, {"p99", report.tick_p99 * 1e6}};
  return json.dump(2) + "\n";
}

}  // namespace arthro::simulation
