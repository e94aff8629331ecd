#include "simulation/training/track/kept_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "simulation/core/byte_stream.h"
#include "simulation/training/track/deflated.h"

namespace arthro::simulation {
namespace {

constexpr double kLevels = std::numeric_limits<std::uint16_t>::max();
constexpr double kRoom = 0.1;        // share of the extent, on each side
constexpr double kLeastRoom = 1e-3;  // m

using Triangle = std::array<int, 3>;

void PutBox(std::string& raw, const SkinBox& box) {
  for (int i = 0; i < 3; ++i) PutBytes(raw, box.low[i]);
  for (int i = 0; i < 3; ++i) PutBytes(raw, box.high[i]);
}

bool TakeBox(std::string_view& raw, SkinBox& box) {
  for (int i = 0; i < 3; ++i)
    if (!TakeBytes(raw, box.low[i])) return false;
  for (int i = 0; i < 3; ++i)
    if (!TakeBytes(raw, box.high[i]) || !std::isfinite(box.high[i] - box.low[i])) return false;
  return true;
}

// Differences axis by axis, which deflate packs better than vertex by vertex.
template <class Before>
void PutPlaces(std::string& raw, const std::vector<Place16>& places, const Before& before) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < places.size(); ++i)
      PutSmall(raw, places[i][axis] - before(i, axis));
}

template <class Before>
bool TakePlaces(std::string_view& raw, std::vector<Place16>& places, const Before& before) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::int32_t difference = 0;
      if (!TakeSmall(raw, difference)) return false;
      places[i][axis] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(before(i, axis)) +
                                                   static_cast<std::uint32_t>(difference));
    }
  return true;
}

// Differences along the list of vertices.
struct Along {
  const std::vector<Place16>& places;
  int operator()(std::size_t i, std::size_t axis) const { return i == 0 ? 0 : places[i - 1][axis]; }
};
struct From {
  const std::vector<Place16>& places;
  int operator()(std::size_t i, std::size_t axis) const { return places[i][axis]; }
};

void PutFresh(std::string& raw, const std::vector<std::uint8_t>& is_fresh) {
  raw.append(reinterpret_cast<const char*>(is_fresh.data()), is_fresh.size());
}

bool TakeFresh(std::string_view& raw, std::vector<std::uint8_t>& is_fresh) {
  if (raw.size() < is_fresh.size()) return false;
  std::copy_n(raw.begin(), is_fresh.size(), is_fresh.begin());
  raw.remove_prefix(is_fresh.size());
  return true;
}

bool TakeIndex(std::string_view& raw, int& previous, std::size_t vertices) {
  std::int32_t difference = 0;
  if (!TakeSmall(raw, difference)) return false;
  const std::int64_t index = std::int64_t{previous} + difference;
  previous = static_cast<int>(index);
  return index >= 0 && index < static_cast<std::int64_t>(vertices);
}

bool TakeCount(std::string_view& raw, std::size_t& count) {
  std::uint32_t value = 0;
  if (!TakeBytes(raw, value) || value > kMostInSkin) return false;
  count = value;
  return true;
}

// Numbers of equal items before, where each item now is expected to follow the one before it.
// −1: there is none.
template <class Item, class Key, class Hash>
std::vector<int> NumbersBefore(const std::vector<Item>& before, const std::vector<Item>& now,
                               const Key& key, const Hash& hash) {
  std::unordered_map<std::uint64_t, int> numbers;
  numbers.reserve(before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    numbers.try_emplace(hash(key(before[i])), static_cast<int>(i));
  std::vector<int> found;
  found.reserve(now.size());
  std::size_t expected = 0;
  for (const Item& item : now) {
    int number = -1;
    if (expected < before.size() && key(before[expected]) == key(item)) {
      number = static_cast<int>(expected);
    } else if (const auto at = numbers.find(hash(key(item)));
               at != numbers.end() &&
               key(before[static_cast<std::size_t>(at->second)]) == key(item)) {
      number = at->second;
    }
    if (number >= 0) expected = static_cast<std::size_t>(number) + 1;
    found.push_back(number);
  }
  return found;
}

// Bytes of the numbers: 0 for none, else one more than the way from the expected number, with its
// sign.
void PutNumbers(std::string& raw, const std::vector<int>& numbers) {
  int expected = 0;
  for (const int number : numbers) {
    const int way = number - expected;
    PutSmall(raw, number < 0 ? 0 : way >= 0 ? way + 1 : way);
    if (number >= 0) expected = number + 1;
  }
}

bool TakeNumbers(std::string_view& raw, std::size_t before, std::vector<int>& numbers) {
  std::int64_t expected = 0;
  for (int& number : numbers) {
    std::int32_t way = 0;
    if (!TakeSmall(raw, way)) return false;
    number = -1;
    if (way == 0) continue;
    const std::int64_t at = expected + (way > 0 ? way - 1 : way);
    if (at < 0 || at >= static_cast<std::int64_t>(before)) return false;
    number = static_cast<int>(at);
    expected = at + 1;
  }
  return true;
}

std::uint64_t HashOf(const Place16& x) {
  return std::uint64_t{x[0]} << 32U | std::uint64_t{x[1]} << 16U | std::uint64_t{x[2]};
}
std::uint64_t HashOf(const Triangle& t) {
  std::uint64_t hash = 0;
  for (const int corner : t)
    hash = (hash ^ static_cast<std::uint32_t>(corner)) * 0x9E3779B97F4A7C15ULL;
  return hash;
}

// Triangles before in the numbers of the vertices now; a corner that is gone has the number −1.
std::vector<Triangle> Renumbered(const std::vector<Triangle>& triangles,
                                 std::size_t vertices_before,
                                 const std::vector<int>& vertex_before) {
  std::vector<int> now(vertices_before, -1);
  for (std::size_t i = 0; i < vertex_before.size(); ++i)
    if (vertex_before[i] >= 0)
      now[static_cast<std::size_t>(vertex_before[i])] = static_cast<int>(i);
  std::vector<Triangle> renumbered = triangles;
  for (Triangle& triangle : renumbered)
    for (int& corner : triangle) corner = now[static_cast<std::size_t>(corner)];
  return renumbered;
}

enum class Change : std::uint8_t { kPlaces, kSurface, kCoarsePlaces };

// Whether all places differ by whole coarse steps.
bool IsCoarse(const KeptSkin& before, const KeptSkin& now) {
  for (std::size_t i = 0; i < now.places.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((now.places[i][axis] - before.places[i][axis]) % kCoarse != 0) return false;
  return true;
}

void PutSurfaceChange(std::string& raw, const KeptSkin& before, const KeptSkin& now) {
  const auto same = [](const auto& item) -> const auto& { return item; };
  const auto hash = [](const auto& key) { return HashOf(key); };
  const std::vector<int> vertex = NumbersBefore(before.rest, now.rest, same, hash);
  PutBytes(raw, static_cast<std::uint32_t>(now.rest.size()));
  PutBytes(raw, static_cast<std::uint32_t>(now.triangles.size()));
  PutNumbers(raw, vertex);
  for (std::size_t i = 0; i < vertex.size(); ++i)
    if (vertex[i] < 0) PutBytes(raw, now.rest[i]);
  const std::vector<Triangle> old = Renumbered(before.triangles, before.rest.size(), vertex);
  const std::vector<int> triangle = NumbersBefore(old, now.triangles, same, hash);
  PutNumbers(raw, triangle);
  int previous = 0;
  for (std::size_t i = 0; i < triangle.size(); ++i)
    for (std::size_t k = 0; triangle[i] < 0 && k < 3; ++k)
      PutSmall(raw, now.triangles[i][k] - std::exchange(previous, now.triangles[i][k]));
  PutFresh(raw, now.is_fresh);
  PutPlaces(raw, now.places, [&](std::size_t i, std::size_t axis) -> int {
    return vertex[i] < 0 ? now.rest[i][axis]
                         : before.places[static_cast<std::size_t>(vertex[i])][axis];
  });
}

bool TakeSurfaceChange(std::string_view& raw, const KeptSkin& before, KeptSkin& now) {
  std::size_t vertices = 0, triangles = 0;
  if (!TakeCount(raw, vertices) || !TakeCount(raw, triangles)) return false;
  if (vertices + triangles > raw.size()) return false;  // each takes a byte at least
  std::vector<int> vertex(vertices), triangle(triangles);
  if (!TakeNumbers(raw, before.rest.size(), vertex)) return false;
  now.rest.resize(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    if (vertex[i] >= 0)
      now.rest[i] = before.rest[static_cast<std::size_t>(vertex[i])];
    else if (!TakeBytes(raw, now.rest[i]))
      return false;
  const std::vector<Triangle> old = Renumbered(before.triangles, before.rest.size(), vertex);
  if (!TakeNumbers(raw, old.size(), triangle)) return false;
  now.triangles.resize(triangles);
  int previous = 0;
  for (std::size_t i = 0; i < triangles; ++i)
    if (triangle[i] >= 0) {
      now.triangles[i] = old[static_cast<std::size_t>(triangle[i])];
      for (const int corner : now.triangles[i])
        if (corner < 0) return false;
    } else {
      for (int& corner : now.triangles[i]) {
        if (!TakeIndex(raw, previous, vertices)) return false;
        corner = previous;
      }
    }
  now.is_fresh.resize(vertices);
  now.places.resize(vertices);
  return TakeFresh(raw, now.is_fresh) &&
         TakePlaces(raw, now.places, [&](std::size_t i, std::size_t axis) -> int {
           return vertex[i] < 0 ? now.rest[i][axis]
                                : before.places[static_cast<std::size_t>(vertex[i])][axis];
         });
}

}  // namespace

Place16 SkinBox::Round(const glm::dvec3& x) const noexcept {
  Place16 place{};
  for (int i = 0; i < 3; ++i) {
    const double extent = high[i] - low[i];
    const double share = extent > 0 ? (x[i] - low[i]) / extent : 0.0;
    place[static_cast<std::size_t>(i)] =
        static_cast<std::uint16_t>(std::lround(kLevels * std::clamp(share, 0.0, 1.0)));
  }
  return place;
}

glm::dvec3 SkinBox::Place(const Place16& x) const noexcept {
  return low + (high - low) * (glm::dvec3(x[0], x[1], x[2]) / kLevels);
}

glm::dvec3 SkinBox::Step() const noexcept { return (high - low) / kLevels; }

bool SkinBox::Holds(const glm::dvec3& x) const noexcept {
  return glm::all(glm::lessThanEqual(low, x)) && glm::all(glm::lessThanEqual(x, high));
}

KeptSkin KeepSkin(const BodySkin& skin, std::span<const glm::dvec3> places, const SkinBox& box) {
  KeptSkin kept;
  kept.box = box;
  kept.rest.reserve(skin.surface.vertices.size());
  for (const glm::dvec3& x : skin.surface.vertices) kept.rest.push_back(box.Round(x));
  kept.places.reserve(places.size());
  for (const glm::dvec3& x : places) kept.places.push_back(box.Round(x));
  kept.triangles = skin.surface.triangles;
  kept.is_fresh = skin.is_fresh;
  kept.is_fresh.resize(kept.rest.size(), 0);
  return kept;
}

KeptSkin KeepSkin(const BodySkin& skin, std::span<const glm::dvec3> places) {
  constexpr double kFar = std::numeric_limits<double>::max();
  SkinBox box{glm::dvec3(kFar), glm::dvec3(-kFar)};
  for (const auto& points : {std::span<const glm::dvec3>(skin.surface.vertices), places})
    for (const glm::dvec3& x : points) {
      box.low = glm::min(box.low, x);
      box.high = glm::max(box.high, x);
    }
  if (box.low.x > box.high.x) box = {};
  const glm::dvec3 room = glm::max(kRoom * (box.high - box.low), glm::dvec3(kLeastRoom));
  return KeepSkin(skin, places, {box.low - room, box.high + room});
}

bool HasSameSurface(const KeptSkin& a, const KeptSkin& b) noexcept {
  return a.box == b.box && a.rest == b.rest && a.triangles == b.triangles &&
         a.is_fresh == b.is_fresh;
}

std::string WholeBytes(const KeptSkin& skin) {
  std::string raw;
  PutBox(raw, skin.box);
  PutBytes(raw, static_cast<std::uint32_t>(skin.rest.size()));
  PutBytes(raw, static_cast<std::uint32_t>(skin.triangles.size()));
  PutPlaces(raw, skin.rest, Along{skin.rest});
  int previous = 0;
  for (const Triangle& triangle : skin.triangles)
    for (const int corner : triangle) PutSmall(raw, corner - std::exchange(previous, corner));
  PutFresh(raw, skin.is_fresh);
  PutPlaces(raw, skin.places, From{skin.rest});
  return Deflated(raw);
}

std::string ChangeBytes(const KeptSkin& before, const KeptSkin& now) {
  std::string raw;
  if (!HasSameSurface(before, now)) {
    PutBytes(raw, Change::kSurface);
    PutSurfaceChange(raw, before, now);
    return Deflated(raw);
  }
  const int step = IsCoarse(before, now) ? kCoarse : 1;
  PutBytes(raw, step == 1 ? Change::kPlaces : Change::kCoarsePlaces);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < now.places.size(); ++i)
      PutSmall(raw, (now.places[i][axis] - before.places[i][axis]) / step);
  return Deflated(raw);
}

std::optional<KeptSkin> WholeSkin(std::string_view bytes) {
  const auto inflated = Inflated(bytes);
  if (!inflated) return std::nullopt;
  std::string_view raw = *inflated;
  KeptSkin skin;
  std::size_t vertices = 0, triangles = 0;
  if (!TakeBox(raw, skin.box) || !TakeCount(raw, vertices) || !TakeCount(raw, triangles))
    return std::nullopt;
  if (vertices + triangles > raw.size()) return std::nullopt;  // each takes a byte at least
  skin.rest.resize(vertices);
  skin.places.resize(vertices);
  skin.is_fresh.resize(vertices);
  skin.triangles.resize(triangles);
  if (!TakePlaces(raw, skin.rest, Along{skin.rest})) return std::nullopt;
  int previous = 0;
  for (Triangle& triangle : skin.triangles)
    for (int& corner : triangle) {
      if (!TakeIndex(raw, previous, vertices)) return std::nullopt;
      corner = previous;
    }
  if (!TakeFresh(raw, skin.is_fresh) || !TakePlaces(raw, skin.places, From{skin.rest}) ||
      !raw.empty())
    return std::nullopt;
  return skin;
}

void Coarsen(const KeptSkin& before, KeptSkin& now) {
  for (std::size_t i = 0; i < now.places.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int from = before.places[i][axis], way = now.places[i][axis] - from;
      // Stays within 16 bits: a step beyond is left out.
      int coarse = from + kCoarse * static_cast<int>(std::lround(1.0 * way / kCoarse));
      if (coarse > 0xffff) coarse -= kCoarse;
      if (coarse < 0) coarse += kCoarse;
      now.places[i][axis] = static_cast<std::uint16_t>(coarse);
    }
}

std::optional<KeptSkin> ChangedSkin(KeptSkin before, std::string_view bytes) {
  const auto inflated = Inflated(bytes);
  if (!inflated) return std::nullopt;
  std::string_view raw = *inflated;
  Change change = Change::kPlaces;
  if (!TakeBytes(raw, change) || change > Change::kCoarsePlaces) return std::nullopt;
  if (change != Change::kSurface) {
    const int step = change == Change::kCoarsePlaces ? kCoarse : 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (Place16& place : before.places) {
        std::int32_t steps = 0;
        if (!TakeSmall(raw, steps) || steps > 0xffff || steps < -0xffff) return std::nullopt;
        place[axis] = static_cast<std::uint16_t>(place[axis] + step * steps);
      }
    if (!raw.empty()) return std::nullopt;
    return before;
  }
  KeptSkin now;
  now.box = before.box;
  if (!TakeSurfaceChange(raw, before, now) || !raw.empty()) return std::nullopt;
  return now;
}

}  // namespace arthro::simulation
