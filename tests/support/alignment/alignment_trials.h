// Alignments of a phantom's tissues by landmarks that are clicked with noise in the scope's
// picture, held against the true pose. The relief is that of the phantom with its tissues in place,
// so clicks beside an outline fall onto what lies behind it. m, rad, s.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "authoring/alignment/landmark_alignment.h"
#include "authoring/phantom/shape/phantom_tissue.h"

namespace arthro::test {

// A phantom's relief, with the tissue whose pose is to be found.
struct AlignmentCase {
  LoadedScene scene;
  authoring::PhantomTissue tissue;
  // The same with the relief that the editor estimates from the brightness of the phantom's
  // picture. A click takes its range from there, and falls on what `scene` shows.
  std::optional<LoadedScene> guess;
};
// Meniscus and cartilage of phantoms 1 to `phantoms`, in the relief or left out of it.
std::vector<AlignmentCase> MakeAlignmentCases(int phantoms, bool shows_tissues = true);
// The same with guessed ranges.
std::vector<AlignmentCase> MakeGuessedCases(int phantoms);

struct TrialOptions {
  int trials = 1000;
  int fewest = 4, most = 8;  // landmarks
  double click_noise = 2.0;  // px, standard deviation per axis, in a picture of 512 px
  double model_noise = 0;    // m, standard deviation per axis of a click on the model
  // m; as the scene states it for its relief, which is exact. 0: it states none.
  double relief_sigma = 0;
  bool has_wrong_pair = false;  // one partner is another visible place, 5 mm off or more
  std::uint64_t seed = 1;
  authoring::LandmarkOptions options;
};

struct TrialErrors {
  // One per trial, unsorted.
  std::vector<double> position, rotation, seconds;
  std::vector<double> position_over_sigma, rotation_over_sigma;
  int wrong_found = 0;   // trials in which exactly the wrong pair was left out
  int wrong_named = 0;   // trials in which the wrong pair was left out, perhaps among others
  int false_alarms = 0;  // good pairs that were left out
  int good_pairs = 0;
  int refused = 0;  // trials without a pose
  int iterations = 0, most_iterations = 0;
};
struct Trial {
  const AlignmentCase* one = nullptr;
  std::vector<authoring::LandmarkPair> pairs;
  std::size_t wrong = 0;  // the wrong pair, where there is one
};
// `cases` must outlive the trials.
std::vector<Trial> MakeTrials(const std::vector<AlignmentCase>& cases, const TrialOptions& options);
TrialErrors RunTrials(const std::vector<AlignmentCase>& cases, const TrialOptions& options);

}  // namespace arthro::test
