// Tissue track of an attempt, read: the skins of the tissues at any moment of it. Frame of the
// bodies, m; times in s after the begin of the attempt.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/tissue/body/tissue_world.h"
#include "simulation/training/track/kept_skin.h"
#include "simulation/training/track/track_piece.h"

namespace arthro::simulation {

class TissueTrack {
 public:
  // Pieces in the order of their times. Pieces that cannot be read are left out.
  explicit TissueTrack(std::vector<TrackPiece> pieces);

  const std::vector<TrackPiece>& pieces() const noexcept { return pieces_; }
  // False: nothing was recorded of the tissue, which is not the same as tissue that never moved.
  bool has_begun() const noexcept { return has_begun_; }
  // Returns the tissues that ever moved, as they were at `t`; before they first moved, at rest.
  // Every skin marks which of its vertices are fresh. Valid until the next call.
  const WorldPicture& At(double t);
  // True once a piece could not be read. Its tissue is then as it was before, until it was recorded
  // whole again.
  bool is_damaged() const noexcept { return is_damaged_; }

 private:
  static constexpr std::size_t kRest = static_cast<std::size_t>(-1);
  struct Body {
    std::vector<std::size_t> pieces;  // rising
    std::optional<KeptSkin> kept;     // read last; none: nothing yet
    std::size_t at = kRest;           // number in `pieces` that `kept` is at; kRest: at none
    std::optional<std::size_t> shown;
  };
  PieceKind KindOf(std::size_t piece) const noexcept;
  void Read(Body& body, std::size_t number);
  void Show(const Body& body, bool at_rest, BodyPicture& picture);

  std::vector<TrackPiece> pieces_;
  std::vector<Body> bodies_;
  WorldPicture world_;
  bool has_begun_ = false, is_damaged_ = false;
  std::uint64_t shapes_ = 0;
};

}  // namespace arthro::simulation
