// Poses of a phantom's tissues from landmarks that were clicked with noise.
#include <algorithm>

#include <fmt/format.h>

#include "app/bench/micro/micro_bench.h"
#include "app/bench/quantile.h"
#include "simulation/core/units.h"
#include "tests/support/alignment/alignment_trials.h"

namespace arthro::app {

MicroGroup AlignmentMicro(bool quick) {
  MicroGroup group{"alignment", "median error of the position, mm", "true pose on a phantom", {}};
  struct Kind {
    int count;
    bool has_wrong_pair, is_guessed;
  };
  const auto cases_of = [quick](bool is_guessed) {
    return MadeOnce([quick, is_guessed] {
      const int phantoms = quick ? 1 : 3;
      return is_guessed ? test::MakeGuessedCases(phantoms) : test::MakeAlignmentCases(phantoms);
    });
  };
  const auto measured = cases_of(false), guessed = cases_of(true);
  for (const auto& [count, has_wrong_pair, is_guessed] : {Kind{4, false, false},
                                                          {8, false, false},
                                                          {8, true, false},
                                                          {4, false, true},
                                                          {8, false, true}}) {
    const auto cases = is_guessed ? guessed : measured;
    test::TrialOptions options;
    options.fewest = options.most = count;
    options.has_wrong_pair = has_wrong_pair;
    options.trials = quick ? 20 : is_guessed ? 300 : 1000;
    const auto first = MadeOnce([cases, options] {
      test::TrialOptions one = options;
      one.trials = 1;
      return test::MakeTrials(cases(), one);
    });
    group.functions.push_back(
        {fmt::format("{} landmarks{}{}", count, has_wrong_pair ? ", one wrong" : "",
                     is_guessed ? ", relief from brightness" : ""),
         [first] {
           const test::Trial& trial = first().front();
           KeepAlive(authoring::AlignLandmarks(trial.pairs, {}, trial.one->tissue.surface));
         },
         [cases, options, is_guessed = is_guessed] {
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
           if (is_guessed)
             text +=
                 fmt::format("; {:.0f} % within twice the predicted error, {} refused",
                             100.0 *
                                 static_cast<double>(std::ranges::count_if(
                                     errors.position_over_sigma, [](double x) { return x <= 2; })) /
                                 static_cast<double>(errors.position_over_sigma.size()),
                             errors.refused);
           return MicroError{position, text};
         }});
  }
  return group;
}

}  // namespace arthro::app
