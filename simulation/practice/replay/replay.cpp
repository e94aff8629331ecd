#include "simulation/practice/replay/replay.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "simulation/core/csv_field.h"
#include "simulation/device/recorded_device.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/practice/replay/option_numbers.h"
#include "simulation/practice/servo_loop.h"

namespace arthro::simulation {
namespace {

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

constexpr double kSameTime = 1e-6;  // s; times of the log are rounded

// An instrument that this program does not know is taken as the probe.
ToolKind KindOf(std::uint8_t number) {
  const auto kind = static_cast<ToolKind>(number);
  return number <= static_cast<std::uint8_t>(ToolKind::kGrasper) ? kind : ToolKind::kProbe;
}

// Gives the session the wishes and options that were in force before a tick.
class Wishes {
 public:
  // `chosen`: options of the caller, which take precedence where they are not at their default.
  Wishes(const Recording& recording, const SessionOptions& chosen)
      : recording_(recording), chosen_(NumbersOf(chosen)), options_(chosen) {
    // Relief and tissue are made once, so their options are taken from the begin.
    for (const TimedOption& timed : recording_.options)
      if (timed.t <= recording_.rows.front().sample.t + kServoPeriod)
        ++next_option_, Take(timed.option);
  }
  const SessionOptions& options() const { return options_; }

  void Apply(double t, Session& session) {
    for (; next_ < recording_.wishes.size() && recording_.wishes[next_].t < t - kSameTime; ++next_)
      Apply(recording_.wishes[next_].wish, session);
    const std::vector<TimedOption>& options = recording_.options;
    if (next_option_ == options.size() || !(options[next_option_].t < t - kSameTime)) return;
    for (; next_option_ < options.size() && options[next_option_].t < t - kSameTime; ++next_option_)
      Take(options[next_option_].option);
    session.SetOptions(options_);
  }

 private:
  void Apply(const LoggedWish& wish, Session& session) {
    session.SetViewAngle(wish.view_angle);
    session.SetIncisionSpacing(wish.incision_spacing);
    session.SetInstrument(KindOf(wish.instrument));
    if (wish.resets != resets_) session.ResetTissues();
    resets_ = wish.resets;
    if (!wish.is_complete) return;
    session.SetCameraHead({wish.is_head_upright, wish.head_turn});
    session.SetDisturbances(DisturbancesOf(wish.disturbance, wish.disturbance_seed));
    for (const DeviceRole role : kDeviceRoles) {
      const LoggedMount& mount = wish.mount[Index(role)];
      session.SetMount(role, {mount.pivot, mount.portal_from_device, mount.rod_length});
    }
  }
  void Take(const LoggedOption& option) {
    static const OptionNumbers kDefaults = NumbersOf({});
    for (int i = 0; i < chosen_.count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (chosen_.option[at].name == option.name && chosen_.option[at] == kDefaults.option[at])
        SetOption(option, options_);
    }
  }

  const Recording& recording_;
  const OptionNumbers chosen_;
  SessionOptions options_;
  std::size_t next_ = 0, next_option_ = 0;
  std::uint32_t resets_ = 0;
};

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

// Name of a region; the entry after the last region is the volume outside all of them.
std::string RegionName(const Scene& scene, int tissue, std::size_t index) {
  const auto& regions = scene.tissues[static_cast<std::size_t>(tissue)].regions;
  return index < regions.size() ? regions[index].name : kElsewhere;
}

}  // namespace

std::string ContactName(int contact, const Scene& scene) {
  if (contact < 0) return "none";
  if (contact == kBackdropContact) return "backdrop";
  const auto tissue = static_cast<std::size_t>(contact - 1);
  if (tissue < scene.tissues.size() && !scene.tissues[tissue].name.empty())
    return scene.tissues[tissue].name;
  return fmt::format("tissue {}", contact);
}

std::vector<ForceRow> Replay(const LoadedScene& loaded, const Recording& recording,
                             const SessionOptions& options, const Progress& progress,
                             ReplayReport* report, const std::vector<TissuePreset>& presets,
                             const ReplayWatch& watch) {
  const std::vector<TraceRow>& trace = recording.rows;
  std::vector<ForceRow> forces;
  if (trace.empty()) return forces;
  forces.reserve(trace.size());
  Wishes wishes(recording, options);
  Session session(loaded, wishes.options());
  ReplayReport counts;
  EnlivenTissues(session, loaded, presets, TissuePace::kInline, &counts.messages);
  RecordedDevice scope(trace, DeviceRole::kScope), instrument(trace, DeviceRole::kInstrument);
  ServoOptions servo_options;
  servo_options.period_without_force = kServoPeriod;
  ServoLoop servo(session, &scope, &instrument, servo_options);
  const WorldPicture* world = session.tissues();
  const auto tick = [&](double t, double dt) {
    wishes.Apply(t, session);
    servo.TickOnce(t, dt);
    ++counts.ticks;
    const Snapshot& snapshot = session.snapshot();
    if (session.HasNewTissues()) CountTissues(*(world = session.tissues()), counts.tissues);
    for (const DeviceRole role : kDeviceRoles) {
      const ToolState& state = ToolOf(snapshot, role);
      if (state.fault != Fault::kNoSample) Count(state, dt, counts.hand[Index(role)]);
    }
    if (watch) watch(t, snapshot, world);
  };

  const double begin = trace.front().sample.t, end = trace.back().sample.t;
  double now = begin;
  tick(now, kServoPeriod);
  for (std::size_t row = 0; row < trace.size();) {
    // Divides the time since the last row into equal ticks, the last of them on this row.
    const double next = trace[row].sample.t;
    const bool is_long = next - now > kLongestGap;
    for (long i = 0; is_long && i < std::lround(kLongestGap / kServoPeriod); ++i)
      tick(now += kServoPeriod, kServoPeriod);
    if (is_long) now = std::max(now, next - kServoPeriod);
    if (next > now) {
      const double gap = next - now;
      const long steps = std::max(1L, static_cast<long>(std::ceil(gap / kServoPeriod - 1e-6)));
      for (long i = 1; i <= steps; ++i) {
        tick(i == steps ? next : now + gap * (static_cast<double>(i) / static_cast<double>(steps)),
             gap / static_cast<double>(steps));
        if (counts.ticks % 1000 == 0) progress.Step("replay", (now - begin) / (end - begin));
      }
      now = next;
    }
    for (; row < trace.size() && trace[row].sample.t == next; ++row) {
      const DeviceRole role = trace[row].device;
      forces.push_back({next, role, ToolOf(session.snapshot(), role)});
      ++counts.hand[Index(role)].rows;
    }
  }
  progress.Step("replay", 1.0);
  if (report != nullptr) {
    for (HandReport& hand : counts.hand)
      if (hand.time_in_contact > 0.0) hand.mean_force /= hand.time_in_contact;
    for (TissueReport& tissue : counts.tissues)
      if (tissue.steps > 0) tissue.step_ms /= static_cast<double>(tissue.steps);
    counts.duration = end - begin;
    servo.Stop();  // publishes its report
    const TimeHistogram& times = servo.ReadReport().compute;
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
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},", t,
                   ToString(device), tip.x, tip.y, tip.z, force.x, force.y, force.z, hand.x, hand.y,
                   hand.z);
    // Writes every bit pattern of NaN alike.
    for (double pixel : {state.pixel.x, state.pixel.y})
      text += std::isnan(pixel) ? std::string("nan,") : fmt::format("{},", pixel);
    fmt::format_to(std::back_inserter(text), "{},{},{}\n",
                   CsvField(ContactName(state.contact, scene)), state.penetration,
                   ToString(state.fault));
  }
  return text;
}

std::string ReportText(const ReplayReport& report, const Scene& scene) {
  nlohmann::ordered_json json;
  json["schema"] = "arthroscene.replay/1";
  json["duration"] = report.duration;
  json["ticks"] = report.ticks;
  for (const DeviceRole role : kDeviceRoles) {
    const HandReport& hand = report.hand[Index(role)];
    if (hand.rows == 0) continue;
    nlohmann::ordered_json& entry = json["devices"][ToString(role)];
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
    for (const auto& [fault, ticks] : hand.faults) entry["faults"][ToString(fault)] = ticks;
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
