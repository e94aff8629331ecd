#include "simulation/training/metrics/metric_collector.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace arthro::simulation {
namespace {

constexpr std::array kMetrics = {
    Metric{"task_time", "s", "Time of the attempt without its pauses."},
    Metric{"measured_share", "", "Share of that time in which the tool was in the joint and known.",
           true},
    Metric{"path", "m", "Length of the way of the tip."},
    Metric{"depth_path", "m", "Length of the tip's way along the rod."},
    Metric{"turn", "rad", "Sum of the turns of the rod about its incision."},
    Metric{"roll_path", "rad", "Sum of the turns of the tool about its own axis."},
    Metric{"moves_20", "1/min", "Movements a minute that reach 20 mm/s."},
    Metric{"moves_50", "1/min", "Movements a minute that reach 50 mm/s."},
    Metric{"moves_100", "1/min", "Movements a minute that reach 100 mm/s."},
    Metric{"sparc", "", "Smoothness: spectral arc length, median of the unbroken stretches.", true},
    Metric{"ldlj", "", "Smoothness: log dimensionless jerk, median of the unbroken stretches.",
           true},
    Metric{"idle_share", "", "Share of the time in which both tools move slower than 5 mm/s."},
    Metric{"bimanual_r", "", "Correlation of the speeds of both tools.", true},
    Metric{"peak_force", "N", "Largest force on the tip."},
    Metric{"mean_force", "N", "Mean force on the tip while it touches."},
    Metric{"over_time", "s", "Time with a force that may harm."},
    Metric{"over_count", "", "Times that the force rose above what may harm."},
    Metric{"contacts", "", "Contacts; one ends when nothing is touched for 0.3 s."},
    Metric{"contact_time", "s", "Time in contact."},
    Metric{"contact_path", "m", "Length of the way of the tip while it touches."},
    Metric{"contact_impulse", "N s", "Force on the tip, summed over the time in contact."},
    Metric{"band_share", "",
           "Share of the time on a target to press in which the force is within its limits.", true},
    Metric{"path_efficiency", "",
           "Straight legs between the ends of the steps, per path of the tip.", true},
    Metric{"tool_loss", "",
           "Share of the instrument's time in the joint in which its tip is not seen."},
    Metric{"loss_episodes", "", "Times that the tip was not seen for more than 0.5 s."},
    Metric{"triangulation", "s",
           "Mean time from the start of a step for the instrument until its tip is seen for 1 s."},
    Metric{"look_downs", "",
           "Times that the trainee looked at the hands, counted by the instructor."},
    Metric{"seen_share", "", "Share of the targets to see that were seen.", true},
    Metric{"probed_share", "", "Share of the targets to press that were pressed.", true},
    Metric{"centring", "", "Mean distance of the target from the picture's centre; 1 is the rim."},
    Metric{"distance_error", "m", "Mean distance of the lens from the range that is asked for."},
    Metric{"track_error", "m", "Distance from the moving goal, root mean square."},
    Metric{"line_error", "m", "Distance from the path, root mean square."},
    Metric{"measure_error", "m", "Mean error of the measured distances."},
    Metric{"horizon", "rad", "Mean turn of the camera head from upright."},
    Metric{"disturbed_share", "",
           "Share of the time in which haze takes 55 % of the green light at the target."},
    Metric{"lens_near", "s", "Time with the instrument's tip within 2 mm of the lens."},
    Metric{"marked_area", "m2", "Area touched with more than the force that may harm."},
    Metric{"taken_share", "", "Share of the volume of the target's regions that was removed.",
           true},
    Metric{"taken_outside", "m3", "Volume removed outside of the targets' regions."},
    Metric{"rim_min", "m", "Least distance of the cut faces from the wall that holds the tissue.",
           true},
    Metric{"contour_rms", "m",
           "Distance of the cut faces from the spheres of the regions, root mean square."},
    Metric{"bites", "", "Bites and passes that took tissue."},
    Metric{"empty_bites", "", "Bites that took nothing."},
    Metric{"bites_outside", "",
           "Bites and passes that took tissue outside of the targets' regions."},
    Metric{"drops", "", "Loose bodies that were dropped on the way."},
    Metric{"zone_entries", "", "Times that a tool touched a zone to avoid."},
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
