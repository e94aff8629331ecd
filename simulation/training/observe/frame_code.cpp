#include "simulation/training/observe/frame_code.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "simulation/core/byte_stream.h"

namespace arthro::simulation {
namespace {

constexpr int kWholeEvery = 1000;  // frames

// Visits the values of a frame in the order of the words, except the flags of the targets.
template <class Frame, class V>
void VisitFrame(Frame& frame, V&& v) {
  const auto vector = [&](auto& x) {
    for (int i = 0; i < 3; ++i) v(x[i]);
  };
  for (auto& tool : frame.tool) {
    vector(tool.tip);
    vector(tool.drawn_tip);
    vector(tool.axis);
    v(tool.mean_force);
    v(tool.peak_force);
    v(tool.roll);
    v(tool.depth);
    v(tool.contact);
    v(tool.contact_share);
    v(tool.is_valid);
  }
  v(frame.is_paused);
  v(frame.instrument);
  v(frame.opening);
  v(frame.view_angle);
  v(frame.head_roll);
  v(frame.incision_spacing);
  v(frame.haze);
  v(frame.fog);
  v(frame.taken);
  vector(frame.lens);
  v(frame.sight.targets);
  v(frame.sight.is_tip_visible);
  for (auto& target : frame.sight.target) {
    vector(target.place);
    v(target.centre);
    v(target.distance);
    v(target.incidence);
  }
}

constexpr std::size_t kOutside = kMostTargets, kRim = kMostTargets + 1, kContour = kMostTargets + 2;

TakenWords TakenOf(const AttemptFrame& frame) {
  TakenWords taken{};
  for (std::size_t i = 0; i < frame.sight.target.size(); ++i)
    taken[i] = frame.sight.target[i].taken_share;
  taken[kOutside] = frame.taken_outside;
  taken[kRim] = frame.rim;
  taken[kContour] = frame.contour;
  return taken;
}

// First byte of a frame. kHasSmall: its values are distances as numbers of few bytes. kHasOldMask:
// the mask of the frame before counts, and is left out.
constexpr unsigned kWhole = 1, kHasTaken = 2, kHasSmall = 4, kHasOldMask = 8;
constexpr unsigned kAllFlags = kWhole | kHasTaken | kHasSmall | kHasOldMask;

struct Packer {
  FrameWords& words;
  std::size_t next = 0;
  void operator()(float value) { words[next++] = std::bit_cast<std::uint32_t>(value); }
  void operator()(int value) { words[next++] = std::bit_cast<std::uint32_t>(value); }
  void operator()(bool value) { words[next++] = value ? 1 : 0; }
  void operator()(ToolKind value) { words[next++] = static_cast<std::uint32_t>(value); }
};

struct Unpacker {
  const FrameWords& words;
  std::size_t next = 0;
  bool is_good = true;
  void operator()(float& value) {
    value = std::bit_cast<float>(words[next++]);
    is_good = is_good && !std::isnan(value);
  }
  void operator()(int& value) { value = std::bit_cast<int>(words[next++]); }
  void operator()(bool& value) {
    is_good = is_good && words[next] <= 1;
    value = words[next++] == 1;
  }
  void operator()(ToolKind& value) {
    is_good = is_good && words[next] <= static_cast<std::uint32_t>(ToolKind::kGrasper);
    value = is_good ? static_cast<ToolKind>(words[next]) : ToolKind::kProbe;
    ++next;
  }
};

// Flags of the targets, one bit per target, in the last two words.
constexpr std::size_t kClear = kFrameWords - 2, kGone = kFrameWords - 1;
static_assert(kMostTargets < 32);

// Words of a frame that mostly equal others: the drawn tip is the tip while nothing is touched, the
// lens is the drawn tip of the scope, and the camera head turns with the scope.
constexpr std::size_t kTool = 16, kDrawn = 3, kRoll = 11, kHeadRoll = 36, kLens = 41;

void TakeFrom(FrameWords& words, std::size_t to, std::size_t from, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) words[to + i] ^= words[from + i];
}
// Replaces these words by their difference, and back.
void ToDifferences(FrameWords& words) {
  TakeFrom(words, kHeadRoll, kRoll, 1);
  TakeFrom(words, kLens, kDrawn, 3);
  for (const std::size_t tool : {std::size_t{0}, kTool}) TakeFrom(words, tool + kDrawn, tool, 3);
}
void FromDifferences(FrameWords& words) {
  for (const std::size_t tool : {std::size_t{0}, kTool}) TakeFrom(words, tool + kDrawn, tool, 3);
  TakeFrom(words, kLens, kDrawn, 3);
  TakeFrom(words, kHeadRoll, kRoll, 1);
}

bool HasChanged(const FrameMask& mask, std::size_t i) {
  return (static_cast<unsigned>(mask[i / 8]) >> i % 8 & 1U) != 0;
}

// Word that a straight line through the two frames before leads to: hands move smoothly, and the
// bits of a float follow its value.
std::uint32_t Expected(const FramesBefore& before, std::size_t i) {
  return 2 * before.words[i] - before.older[i];
}

}  // namespace

TakenWords NothingTaken() { return TakenOf(AttemptFrame()); }

void FrameEncoder::Encode(const AttemptFrame& frame, std::string& bytes) {
  FrameWords words{};
  VisitFrame(frame, Packer{words});
  for (std::size_t i = 0; i < frame.sight.target.size(); ++i) {
    words[kClear] |= (frame.sight.target[i].is_clear ? 1u : 0u) << i;
    words[kGone] |= (frame.sight.target[i].is_gone ? 1u : 0u) << i;
  }
  ToDifferences(words);
  const bool is_whole = since_whole_ == 0;
  since_whole_ = (since_whole_ + 1) % kWholeEvery;
  if (is_whole) before_ = {};
  const TakenWords taken = TakenOf(frame);
  FrameMask mask{};
  std::size_t changed = 0;
  values_.clear();
  for (std::size_t i = 0; i < kFrameWords; ++i) {
    if (words[i] == before_.words[i]) continue;
    mask[i / 8] = static_cast<std::uint8_t>(mask[i / 8] | 1U << i % 8);
    PutSmall(values_, static_cast<std::int32_t>(words[i] - Expected(before_, i)));
    ++changed;
  }
  const bool has_taken = taken != before_.taken, has_old_mask = !is_whole && mask == before_.mask,
             has_small = values_.size() < changed * sizeof(std::uint32_t);
  bytes.assign(1,
               static_cast<char>((is_whole ? kWhole : 0) | (has_taken ? kHasTaken : 0) |
                                 (has_small ? kHasSmall : 0) | (has_old_mask ? kHasOldMask : 0)));
  if (!has_old_mask) PutBytes(bytes, mask);
  if (has_small) {
    bytes.append(values_);
  } else {
    for (std::size_t i = 0; i < kFrameWords; ++i)
      if (HasChanged(mask, i)) PutBytes(bytes, words[i]);
  }
  if (has_taken) PutBytes(bytes, taken);
  before_ = {words, before_.words, mask, taken};
}

bool FrameDecoder::Decode(std::string_view bytes, AttemptFrame& frame) {
  std::uint8_t head = 0;
  if (!TakeBytes(bytes, head) || head > kAllFlags) return false;
  if ((head & kWhole) != 0) before_ = {};
  if ((head & kHasOldMask) == 0 && !TakeBytes(bytes, before_.mask)) return false;
  const bool has_small = (head & kHasSmall) != 0;
  FrameWords words = before_.words;
  for (std::size_t i = 0; i < kFrameWords; ++i) {
    if (!HasChanged(before_.mask, i)) continue;
    std::int32_t distance = 0;
    if (has_small ? !TakeSmall(bytes, distance) : !TakeBytes(bytes, words[i])) return false;
    if (has_small) words[i] = Expected(before_, i) + static_cast<std::uint32_t>(distance);
  }
  if ((head & kHasTaken) != 0 && !TakeBytes(bytes, before_.taken)) return false;
  before_.older = before_.words;
  before_.words = words;
  FromDifferences(words);
  Unpacker unpacker{words};
  VisitFrame(frame, unpacker);
  const TakenWords& taken = before_.taken;
  for (std::size_t i = 0; i < frame.sight.target.size(); ++i)
    frame.sight.target[i].taken_share = taken[i];
  frame.taken_outside = taken[kOutside];
  frame.rim = taken[kRim];
  frame.contour = taken[kContour];
  for (const float value : taken)
    if (std::isnan(value)) return false;
  for (std::size_t i = 0; i < frame.sight.target.size(); ++i) {
    frame.sight.target[i].is_clear = (words[kClear] >> i & 1u) != 0;
    frame.sight.target[i].is_gone = (words[kGone] >> i & 1u) != 0;
  }
  return bytes.empty() && unpacker.is_good && (words[kClear] | words[kGone]) >> kMostTargets == 0 &&
         frame.sight.targets >= 0 && frame.sight.targets <= kMostTargets;
}

}  // namespace arthro::simulation
