// Records the tissue track of an attempt that runs: the skin of each tissue that has moved, at
// 15 Hz at most, so that a look back shows it without simulating anything again. Nothing is
// recorded of tissue that rests. Steps, metrics and score do not read the track.
//
// A vertex that has moved less than kTrackStill since it was recorded stays as it was, as the live
// picture hardly follows it; tissue that has come to rest is recorded once more, exactly.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "simulation/tissue/body/tissue_world.h"
#include "simulation/training/track/kept_skin.h"
#include "simulation/training/track/track_piece.h"

namespace arthro::simulation {

inline constexpr double kTrackStill = 25e-6;  // m

class TrackRecorder {
 public:
  // Appends the pieces of a moment; times rise from call to call. The first call begins the track.
  void Record(double t, const WorldPicture& world, std::vector<TrackPiece>& pieces);

 private:
  struct Body {
    std::uint64_t shape = 0;               // looked at last
    std::shared_ptr<const BodySkin> skin;  // the same
    std::optional<KeptSkin> kept;          // in the track; none: at rest since the begin
    std::vector<glm::dvec3> places;        // shown by the track
    bool is_exact = true;                  // to the last bit of the skin
    int changes = 0;                       // since it was recorded whole
  };
  static void RecordBody(double t, const BodyPicture& now, Body& body,
                         std::vector<TrackPiece>& pieces);

  std::vector<Body> bodies_;
  bool has_begun_ = false;
  double last_ = 0;  // s
};

}  // namespace arthro::simulation
