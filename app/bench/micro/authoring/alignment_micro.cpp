// Poses of a phantom's tissues from landmarks that were clicked with noise.
#include <fmt/format.h>

#include "app/bench/micro/micro_bench.h"
#include "app/bench/quantile.h"
#include "simulation/core/units.h"
#include "tests/support/alignment/alignment_trials.h"

namespace arthro::app {

MicroGroup AlignmentMicro(bool quick) {
  MicroGroup group{"alignment", "median error of the position, mm", "true pose on a phantom", {}};
  const auto cases = MadeOnce([quick] { return test::MakeAlignmentCases(quick ? 1 : 3); });
  for (const auto& [count, has_wrong_pair] : {std::pair{4, false}, {8, false}, {8, true}}) {
    test::TrialOptions options;
    options.fewest = options.most = count;
    options.has_wrong_pair = has_wrong_pair;
    options.trials = quick ? 20 : 1000;
    const auto first = MadeOnce([cases, options] {
      test::TrialOptions one = options;
      one.trials = 1;
      return test::MakeTrials(cases(), one);
    });
    group.functions.push_back(
        {fmt::format("{} landmarks{}", count, has_wrong_pair ? ", one wrong" : ""),
         [first] {
           const test::Trial& trial = first().front();
           KeepAlive(authoring::AlignLandmarks(trial.pairs, {}, trial.one->tissue.surface));
         },
         [cases, options] {
           const test::TrialErrors errors = test::RunTrials(cases(), options);
           const double position = MmFromMetres(Quantile(errors.position, 0.5));
           std::string text =
               fmt::format("{:.2f} mm, p95 {:.2f} mm; {:.1f}°, p95 {:.1f}°; {:.0f} iterations",
                           position, MmFromMetres(Quantile(errors.position, 0.95)),
                           DegreesFromRadians(Quantile(errors.rotation, 0.5)),
                           DegreesFromRadians(Quantile(errors.rotation, 0.95)),
                           static_cast<double>(errors.iterations) / options.trials);
           if (options.has_wrong_pair)
             text += fmt::format("; named in {} of {}", errors.wrong_named, options.trials);
           return MicroError{position, text};
         }});
  }
  return group;
}

}  // namespace arthro::app
