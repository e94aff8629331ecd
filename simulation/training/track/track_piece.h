// Piece of the tissue track of an attempt: its begin, or the skin of one tissue, whole or as the
// change from the piece of that tissue before. The log keeps the bytes without reading them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "simulation/core/byte_stream.h"

namespace arthro::simulation {

// Least time between two pieces of a tissue.
inline constexpr double kTrackStep = 1.0 / 15;  // s

enum class PieceKind : std::uint8_t { kBegin, kWhole, kChange };

struct TrackPiece {
  double t = 0;  // s after the begin of the attempt
  std::string bytes;
  friend bool operator==(const TrackPiece&, const TrackPiece&) = default;
};

struct PieceHead {
  PieceKind kind = PieceKind::kBegin;
  std::uint16_t tissue = 0;  // in the scene
};

inline TrackPiece MakePiece(double t, const PieceHead& head, std::string_view body) {
  TrackPiece piece{t, {}};
  PutBytes(piece.bytes, head.kind);
  PutBytes(piece.bytes, head.tissue);
  piece.bytes.append(body);
  return piece;
}

// Takes the head from the front. Returns false for bytes that are no piece.
inline bool TakePieceHead(std::string_view& bytes, PieceHead& head) {
  return TakeBytes(bytes, head.kind) && head.kind <= PieceKind::kChange &&
         TakeBytes(bytes, head.tissue);
}

}  // namespace arthro::simulation
