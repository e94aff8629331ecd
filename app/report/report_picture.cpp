#include "app/report/report_picture.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "app/plot/svg_text.h"
#include "simulation/device/device_sample.h"

namespace arthro::app {
namespace {

// Words of a fault that a picture shows; empty: of another event. A force over the limit is many
// events, and its peak is shown once.
std::string FaultWords(const EventRow& event) {
  if (event.kind == "zone_in") return "zone entered: " + event.target;
  if (event.kind == "cut_outside") return "cut outside of the regions";
  if (event.kind == "drop") return "dropped: " + event.target;
  return "";
}

// A fault that the criteria are about, and allow.
bool IsAllowed(const AttemptRecord& attempt, const std::string& kind) {
  const std::vector<std::string> metrics =
      kind == "zone_in"       ? std::vector<std::string>{"zone_entries"}
      : kind == "cut_outside" ? std::vector<std::string>{"taken_outside", "bites_outside"}
                              : std::vector<std::string>{"drops"};
  bool is_asked = false;
  for (const CriterionRow& criterion : attempt.criteria) {
    if (std::ranges::find(metrics, criterion.metric) == metrics.end()) continue;
    if (!criterion.passed) return false;
    is_asked = true;
  }
  return is_asked;
}

// The frame in which the force on the instrument was largest.
std::size_t PeakOf(std::span<const simulation::AttemptFrame> frames) {
  std::size_t peak = 0;
  const auto force = [&](std::size_t i) {
    return frames[i].tool[Index(simulation::DeviceRole::kInstrument)].peak_force;
  };
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (force(i) > force(peak)) peak = i;
  return peak;
}

std::string Base64(const std::string& bytes) {
  constexpr const char* kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kLetters[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace

std::string StepNumber(const StepNames& names, const std::string& id) {
  const auto found = names.find(id);
  return found == names.end() ? id : fmt::format("{}", found->second.number);
}

std::string StepLine(const StepNames& names, const std::string& id) {
  const auto found = names.find(id);
  return found == names.end() ? id
                              : fmt::format("{}. {}", found->second.number, found->second.title);
}

std::vector<ReportMoment> MomentsOf(const AttemptRecord& attempt,
                                    std::span<const simulation::AttemptFrame> frames,
                                    const StepNames& names) {
  std::vector<ReportMoment> moments, faults;
  for (const StepRow& step : attempt.steps)
    if (step.ended && (step.outcome == "done" || step.outcome == "failed"))
      moments.push_back({*step.ended, StepLine(names, step.step) + ": " + step.outcome,
                         step.outcome == "failed"});
  for (const EventRow& event : attempt.events)
    if (const std::string words = FaultWords(event);
        !words.empty() && !IsAllowed(attempt, event.kind))
      faults.push_back({event.t, words, true});
  for (const CriterionRow& criterion : attempt.criteria)
    if (criterion.metric == "peak_force" && !criterion.passed && criterion.value &&
        !frames.empty()) {
      const std::size_t peak = PeakOf(frames);
      const double force = frames[peak].tool[Index(simulation::DeviceRole::kInstrument)].peak_force;
      faults.insert(faults.begin(), {simulation::kFrameTime * static_cast<double>(peak + 1),
                                     fmt::format("peak force: {:.3g} N", force), true});
      break;
    }
  if (faults.size() > kMostFaultPictures) faults.resize(kMostFaultPictures);
  moments.insert(moments.end(), faults.begin(), faults.end());
  std::ranges::stable_sort(moments, {}, &ReportMoment::t);
  return moments;
}

std::string PicturesHtml(std::span<const ReportPicture> pictures, bool has_tissue) {
  std::string html = "<div class=\"pictures\">\n";
  for (const ReportPicture& picture : pictures)
    html += fmt::format(
        "<figure{}><img alt=\"\" src=\"data:image/jpeg;base64,{}\"><figcaption>{:.1f} s, "
        "{}</figcaption></figure>\n",
        picture.moment.is_fault ? " class=\"fault\"" : "", Base64(picture.jpeg), picture.moment.t,
        XmlText(picture.moment.words));
  html += "</div>\n";
  if (!has_tissue)
    html += "<p class=\"small\">The tissue was not recorded; it is shown at rest.</p>\n";
  return html;
}

}  // namespace arthro::app
