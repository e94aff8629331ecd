// Skin of a tissue with 16 bits per coordinate in a box, as the tissue track keeps it, and its
// bytes: whole, or as the change from the skin before. Frame of the body, m.
//
// A change of the surface names the vertices and triangles that stay by their numbers before, so
// that a bite into a large skin takes few bytes. Bytes are deflated.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/tissue/body/deformable_body.h"

namespace arthro::simulation {

using Place16 = std::array<std::uint16_t, 3>;

struct SkinBox {
  glm::dvec3 low{0.0}, high{0.0};
  // Returns the place in the box; a place outside of it is clamped.
  Place16 Round(const glm::dvec3& x) const noexcept;
  glm::dvec3 Place(const Place16& x) const noexcept;
  // Distance between places that differ by one.
  glm::dvec3 Step() const noexcept;
  bool Holds(const glm::dvec3& x) const noexcept;
  friend bool operator==(const SkinBox&, const SkinBox&) = default;
};

struct KeptSkin {
  SkinBox box;
  std::vector<Place16> rest, places;  // one per vertex
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::uint8_t> is_fresh;  // one per vertex
  friend bool operator==(const KeptSkin&, const KeptSkin&) = default;
};

// A skin in a box about its rest and its places, with room to move.
KeptSkin KeepSkin(const BodySkin& skin, std::span<const glm::dvec3> places);
// The same in the box of another one.
KeptSkin KeepSkin(const BodySkin& skin, std::span<const glm::dvec3> places, const SkinBox& box);
bool HasSameSurface(const KeptSkin& a, const KeptSkin& b) noexcept;

std::string WholeBytes(const KeptSkin& skin);
// Both skins have one box.
std::string ChangeBytes(const KeptSkin& before, const KeptSkin& now);

// Moves the places of `now`, which has the surface of `before`, to steps of kCoarse about those of
// before: what moves takes fewer bytes, and is off by half of them at most.
inline constexpr int kCoarse = 8;
void Coarsen(const KeptSkin& before, KeptSkin& now);

// Return nothing for bytes that are no skin. More vertices or triangles than kMostInSkin are
// refused.
inline constexpr std::uint32_t kMostInSkin = 400'000;
std::optional<KeptSkin> WholeSkin(std::string_view bytes);
std::optional<KeptSkin> ChangedSkin(KeptSkin before, std::string_view bytes);

}  // namespace arthro::simulation
