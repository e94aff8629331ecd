#include "simulation/training/metrics/metric_collector.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace arthro::simulation {
namespace {

constexpr std::array kMetrics = {
    Metric{"task_time", "Time", "s", "Time of the attempt without its pauses."},
    Metric{"measured_share", "Share measured", "",
           "Share of that time in which the tool was in the joint and known.", true},
    Metric{"path", "Path length", "m", "Length of the way of the tip."},
    Metric{"depth_path", "Path along the rod", "m", "Length of the tip's way along the rod."},
    Metric{"turn", "Turning about the incision", "rad",
           "Sum of the turns of the rod about its incision."},
    Metric{"roll_path", "Rolling", "rad", "Sum of the turns of the tool about its own axis."},
    Metric{"moves_20", "Movements over 20 mm/s", "1/min", "Movements a minute that reach 20 mm/s."},
    Metric{"moves_50", "Movements over 50 mm/s", "1/min", "Movements a minute that reach 50 mm/s."},
    Metric{"moves_100", "Movements over 100 mm/s", "1/min",
           "Movements a minute that reach 100 mm/s."},
    Metric{"sparc", "Smoothness (SPARC)", "",
           "Smoothness: spectral arc length, median of the unbroken stretches.", true},
    Metric{"ldlj", "Smoothness (LDLJ)", "",
           "Smoothness: log dimensionless jerk, median of the unbroken stretches.", true},
    Metric{"idle_share", "Idle share", "",
           "Share of the time in which both tools move slower than 5 mm/s."},
    Metric{"bimanual_r", "Correlation of both hands", "",
           "Correlation of the speeds of both tools.", true},
    Metric{"peak_force", "Peak force", "N", "Largest force on the tip."},
    Metric{"mean_force", "Mean force", "N", "Mean force on the tip while it touches."},
    Metric{"over_time", "Time over the safe force", "s", "Time with a force that may harm."},
    Metric{"over_count", "Times over the safe force", "",
           "Times that the force rose above what may harm."},
    Metric{"contacts", "Contacts", "", "Contacts; one ends when nothing is touched for 0.3 s."},
    Metric{"contact_time", "Time in contact", "s", "Time in contact."},
    Metric{"contact_path", "Path in contact", "m",
           "Length of the way of the tip while it touches."},
    Metric{"contact_impulse", "Impulse in contact", "N s",
           "Force on the tip, summed over the time in contact."},
    Metric{"band_share", "Share in the force band", "",
           "Share of the time on a target to press in which the force is within its limits.", true},
    Metric{"path_efficiency", "Path efficiency", "",
           "Straight legs between the ends of the steps, per path of the tip.", true},
    Metric{"tool_loss", "Share with the tip out of view", "",
           "Share of the instrument's time in the joint in which its tip is not seen."},
    Metric{"loss_episodes", "Losses of the tip from view", "",
           "Times that the tip was not seen for more than 0.5 s."},
    Metric{"triangulation", "Time to find the tip", "s",
           "Mean time from the start of a step for the instrument until its tip is seen for 1 s."},
    Metric{"look_downs", "Looks at the hands", "",
           "Times that the trainee looked at the hands, counted by the instructor."},
    Metric{"seen_share", "Share of targets seen", "", "Share of the targets to see that were seen.",
           true},
    Metric{"probed_share", "Share of targets pressed", "",
           "Share of the targets to press that were pressed.", true},
    Metric{"centring", "Distance from the centre", "",
           "Mean distance of the target from the picture's centre; 1 is the rim."},
    Metric{"distance_error", "Error of the viewing distance", "m",
           "Mean distance of the lens from the range that is asked for."},
    Metric{"track_error", "Error of tracking", "m",
           "Distance from the moving goal, root mean square."},
    Metric{"line_error", "Error of the path", "m", "Distance from the path, root mean square."},
    Metric{"ghost_distance", "Distance from the expert's path", "m",
           "Mean distance of the tip from the way of the expert's tip in the same step."},
    Metric{"measure_error", "Error of measuring", "m", "Mean error of the measured distances."},
    Metric{"horizon", "Tilt of the horizon", "rad", "Mean turn of the camera head from upright."},
    Metric{"disturbed_share", "Share of disturbed view", "",
           "Share of the time in which haze takes 55 % of the green light at the target."},
    Metric{"lens_near", "Time with the tip near the lens", "s",
           "Time with the instrument's tip within 2 mm of the lens."},
    Metric{"marked_area", "Area pressed too hard", "m2",
           "Area touched with more than the force that may harm."},
    Metric{"taken_share", "Share removed", "",
           "Share of the volume of the target's regions that was removed.", true},
    Metric{"taken_outside", "Volume removed outside", "m3",
           "Volume removed outside of the targets' regions."},
    Metric{"rim_min", "Least rim left", "m",
           "Least distance of the cut faces from the wall that holds the tissue.", true},
    Metric{"contour_rms", "Error of the contour", "m",
           "Distance of the cut faces from the spheres of the regions, root mean square."},
    Metric{"bites", "Bites", "", "Bites and passes that took tissue."},
    Metric{"empty_bites", "Empty bites", "", "Bites that took nothing."},
    Metric{"bites_outside", "Bites outside", "",
           "Bites and passes that took tissue outside of the targets' regions."},
    Metric{"drops", "Drops", "", "Loose bodies that were dropped on the way."},
    Metric{"zone_entries", "Zone entries", "", "Times that a tool touched a zone to avoid."},
};

}  // namespace

std::span<const Metric> EveryMetric() { return kMetrics; }

void MetricCollector::Give(std::string_view id, std::string part, std::optional<double> value,
                           std::string_view why_none) {
  const auto metric = std::find_if(kMetrics.begin(), kMetrics.end(),
                                   [&](const Metric& each) { return each.id == id; });
  values_.push_back(
      {&*metric, std::move(part), value, value ? std::string() : std::string(why_none)});
}

std::vector<MetricValue> MetricCollector::InOrder() && {
  std::stable_sort(values_.begin(), values_.end(),
                   [](const auto& a, const auto& b) { return std::less<>{}(a.metric, b.metric); });
  return std::move(values_);
}

}  // namespace arthro::simulation
