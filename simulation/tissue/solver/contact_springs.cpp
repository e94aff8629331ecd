#include "simulation/tissue/solver/contact_springs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "simulation/core/finite.h"

namespace arthro::simulation {
namespace {

constexpr double kHardens = 0.1;    // depth over a bar's radius at which k has doubled
constexpr double kPastAxis = 0.25;  // fraction of a bar's radius
constexpr int kMostRounds = 60;     // limit of iterations for a tool's equilibrium
constexpr double kFarthest = 1e-2;  // m, limit per iteration
constexpr double kBalanced = 1e-9;  // m, last iteration

// Gap between a point and the object that it touches.
struct Gap {
  double gap = 0;
  glm::dvec3 normal{0, 0, 1};  // ∂g/∂x; unit except past a bar's axis
  glm::dmat3 turn{0.0};        // ∂²g/∂x²
};

Gap GapAt(const ContactPoint& contact, const glm::dvec3& at) noexcept {
  if (!contact.is_round) return {glm::dot(contact.normal, at - contact.foot), contact.normal, {}};
  const glm::dvec3 way = contact.b - contact.a;
  const double length2 = glm::dot(way, way);
  const double along = length2 > 0 ? glm::dot(at - contact.a, way) / length2 : 0;
  const bool is_beside = along > 0 && along < 1;
  const glm::dvec3 d = at - contact.a - std::clamp(along, 0.0, 1.0) * way;
  const double distance = glm::length(d), side = glm::dot(d, contact.normal);
  // Past the axis the way out is back the way it came, and found sooner the deeper the point is.
  // With t the distance beside the axis, g = t − r − side²/2c; from −c on it falls linearly.
  if (!(side > 0)) {
    const glm::dvec3 beside = d - side * contact.normal;
    const double t = glm::length(beside), c = kPastAxis * contact.radius;
    const bool is_even = side < -c;
    Gap gap{t - contact.radius + (is_even ? side + 0.5 * c : -0.5 * side * side / c),
            (is_even ? 1.0 : -side / c) * contact.normal, glm::dmat3(0.0)};
    if (t > 0) gap.normal += beside / t;
    if (is_beside) gap.normal -= glm::dot(way, gap.normal) / length2 * way;
    return gap;
  }
  Gap gap{distance - contact.radius, d / distance, glm::dmat3(1.0)};
  gap.turn -= glm::outerProduct(gap.normal, gap.normal);
  if (is_beside) gap.turn -= glm::outerProduct(way, way) / length2;
  gap.turn /= distance;
  return gap;
}

struct Push {
  double force = 0, stiffness = 0, energy = 0;
};

// Returns k g; for a round bar k g (1 + (g/g₀)²), so that no hand forces it through between the
// points.
Push PushAt(const ContactPoint& contact, double gap) noexcept {
  if (!(gap < 0)) return {};
  const double k = contact.stiffness, g = -gap, g2 = g * g;
  if (!contact.is_round) return {k * g, k, 0.5 * k * g2};
  const double hard = g2 / (kHardens * contact.radius * kHardens * contact.radius);
  return {k * g * (1 + hard), k * (1 + 3 * hard), 0.5 * k * g2 * (1 + 0.5 * hard)};
}

struct Balance {
  glm::dvec3 force{0.0};  // on the tool; zero in equilibrium
  glm::dmat3 stiffness{0.0}, turn{0.0};
  double energy = 0;
};

}  // namespace

bool InvertPositive(const glm::dmat3& m, glm::dmat3& inverse) noexcept {
  // Sylvester's criterion for a positive definite matrix.
  const double first = m[0][0], second = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const double third = glm::determinant(m);
  if (!(first > 0) || !(second > 0) || !(third > 0)) return false;
  inverse = glm::inverse(m);
  return std::isfinite(glm::length(inverse[0]) + glm::length(inverse[1]) + glm::length(inverse[2]));
}

glm::dvec3 ContactPosition(const ContactPoint& contact, std::span<const glm::dvec3> x) noexcept {
  glm::dvec3 point(0.0);
  for (int i = 0; i < contact.count; ++i) point += contact.weight[i] * x[contact.node[i]];
  return point;
}

glm::dvec3 PushOn(const ContactPoint& contact, const glm::dvec3& point,
                  const glm::dvec3& p) noexcept {
  const Gap gap = GapAt(contact, point - p);
  return PushAt(contact, gap.gap).force * gap.normal;
}

ContactSpring SpringAt(const ContactPoint& contact, const glm::dvec3& point, const glm::dvec3& p,
                       const glm::dvec3& pressing) noexcept {
  ContactSpring spring;
  spring.contact = &contact;
  spring.point = point;
  const Gap gap = GapAt(contact, point - p);
  spring.gap = gap.gap;
  spring.bears = gap.gap < 0;
  if (spring.gap < 0) {
    const Push push = PushAt(contact, spring.gap);
    spring.energy = push.energy;
    spring.push = push.force * gap.normal;
    spring.force = spring.push;
    spring.stiffness = push.stiffness * glm::outerProduct(gap.normal, gap.normal);
    spring.turn = -push.force * gap.turn;
  }
  const double pressed = glm::length(pressing), most = contact.friction * pressed;
  if (!(most > 0)) return spring;
  spring.bears = true;
  const glm::dvec3 n = pressing / pressed;
  const glm::dmat3 tangential = glm::dmat3(1.0) - glm::outerProduct(n, n);
  const glm::dvec3 slip = tangential * (point - contact.start - p);
  const double s = glm::length(slip), scale = contact.slip_scale;
  if (s < scale) {
    const double secant = 2.0 / scale - s / (scale * scale),
                 slope = 2.0 / scale * (1.0 - s / scale);
    spring.energy += most * s * s / scale * (1.0 - s / (3.0 * scale));
    spring.force -= most * secant * slip;
    spring.stiffness += most * secant * tangential;
    if (s > 0)
      spring.stiffness += most * (slope - secant) / (s * s) * glm::outerProduct(slip, slip);
  } else {
    spring.energy += most * (s - scale / 3.0);
    spring.force -= most / s * slip;
    spring.stiffness += most / s * (tangential - glm::outerProduct(slip, slip) / (s * s));
  }
  return spring;
}

void FindHolds(std::span<const ContactPoint> contacts, std::vector<ToolHold>& holds) {
  holds.clear();
  for (const ContactPoint& contact : contacts) {
    if (!(contact.hold > 0) || holds.size() >= kMostTools) continue;
    if (std::none_of(holds.begin(), holds.end(),
                     [&](const ToolHold& hold) { return hold.owner == contact.owner; }))
      holds.push_back({contact.owner, contact.hold, contact.offset, glm::dmat3(0.0)});
  }
}

void SetSprings(std::span<const ContactPoint> contacts, std::span<const glm::dvec3> x, bool renews,
                bool turns, std::span<glm::dvec3> pressing, std::span<ToolHold> holds,
                std::span<ContactSpring> springs) noexcept {
  const auto hold_of = [&](const ContactPoint& contact) noexcept {
    for (std::size_t h = 0; h < holds.size() && contact.hold > 0; ++h)
      if (holds[h].owner == contact.owner) return static_cast<int>(h);
    return -1;
  };
  const auto offset_of = [&](int hold) noexcept {
    return hold < 0 ? glm::dvec3(0.0) : holds[static_cast<std::size_t>(hold)].offset;
  };
  // Skips points that a tool has not reached: a gap shrinks by less than twice the tool's motion.
  std::array<glm::dvec3, kMostTools> began{};
  for (std::size_t h = 0; h < holds.size(); ++h) began[h] = holds[h].offset;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    springs[i].point = ContactPosition(contacts[i], x);
    if (const int hold = hold_of(contacts[i]); hold >= 0)
      springs[i].gap = GapAt(contacts[i], springs[i].point - offset_of(hold)).gap;
  }
  const auto is_clear = [&](std::size_t i, const glm::dvec3& p, int hold) noexcept {
    return springs[i].gap > 2.0 * glm::distance(p, began[static_cast<std::size_t>(hold)]) &&
           pressing[i] == glm::dvec3(0.0);
  };
  const auto balance = [&](int hold) noexcept {
    ToolHold& tool = holds[static_cast<std::size_t>(hold)];
    const auto at = [&](const glm::dvec3& p) noexcept {
      Balance sum;
      sum.energy = 0.5 * tool.stiffness * glm::dot(p, p);
      sum.force = tool.stiffness * p;
      sum.stiffness = glm::dmat3(tool.stiffness);
      for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (contacts[i].owner != tool.owner || !(contacts[i].hold > 0)) continue;
        if (is_clear(i, p, hold)) continue;
        const ContactSpring spring = SpringAt(contacts[i], springs[i].point, p, pressing[i]);
        sum.energy += spring.energy;
        sum.force += spring.force;
        sum.stiffness += spring.stiffness;
        sum.turn += spring.turn;
      }
      return sum;
    };
    // Limits the motion so that each point stays on its side of the tool.
    double reach = kFarthest;
    for (const ContactPoint& contact : contacts)
      if (contact.owner == tool.owner && contact.is_round)
        reach = std::min(reach, 0.5 * contact.radius);
    Balance now = at(tool.offset);
    for (int round = 0; round < kMostRounds; ++round) {
      glm::dmat3 inverse(0.0);
      if (!InvertPositive(now.stiffness + now.turn, inverse) &&
          !InvertPositive(now.stiffness, inverse))
        break;
      glm::dvec3 way = -inverse * now.force;
      const double length = glm::length(way);
      if (length > reach) way *= reach / length;
      double share = 1;
      Balance next = at(tool.offset + way);
      while (!(next.energy <= now.energy) && share > 1e-3) {
        share *= 0.5;
        next = at(tool.offset + share * way);
      }
      if (!(next.energy <= now.energy)) break;
      tool.offset += share * way;
      now = next;
      if (glm::length(share * way) < kBalanced) break;
    }
    if (!(turns && InvertPositive(now.stiffness + now.turn, tool.give)) &&
        !InvertPositive(now.stiffness, tool.give))
      tool.give = glm::dmat3(0.0);
  };
  for (int pass = renews ? 0 : 1; pass < 2; ++pass) {
    for (std::size_t h = 0; h < holds.size(); ++h) balance(static_cast<int>(h));
    if (pass > 0) break;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      pressing[i] = PushOn(contacts[i], springs[i].point, offset_of(hold_of(contacts[i])));
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const int hold = hold_of(contacts[i]);
    springs[i] = SpringAt(contacts[i], springs[i].point, offset_of(hold), pressing[i]);
    springs[i].hold = hold;
    if (!turns) springs[i].turn = glm::dmat3(0.0);
  }
}

double SpringEnergy(std::span<const ContactSpring> springs,
                    std::span<const ToolHold> holds) noexcept {
  double energy = 0;
  for (const ContactSpring& spring : springs) energy += spring.energy;
  for (const ToolHold& hold : holds)
    energy += 0.5 * hold.stiffness * glm::dot(hold.offset, hold.offset);
  return energy;
}

void AddStiffness(std::span<const ContactSpring> springs, std::span<const ToolHold> holds,
                  std::span<const glm::dvec3> p, std::span<glm::dvec3> y) noexcept {
  std::array<glm::dvec3, kMostTools> pulled{};
  for (const ContactSpring& spring : springs)
    if (spring.hold >= 0 && spring.bears)
      pulled[static_cast<std::size_t>(spring.hold)] +=
          (spring.stiffness + spring.turn) * ContactPosition(*spring.contact, p);
  for (std::size_t h = 0; h < holds.size(); ++h) pulled[h] = holds[h].give * pulled[h];
  for (const ContactSpring& spring : springs) {
    if (!spring.bears) continue;
    const ContactPoint& contact = *spring.contact;
    glm::dvec3 moved = ContactPosition(contact, p);
    if (spring.hold >= 0) moved -= pulled[static_cast<std::size_t>(spring.hold)];
    const glm::dvec3 pull = (spring.stiffness + spring.turn) * moved;
    for (int i = 0; i < contact.count; ++i) y[contact.node[i]] += contact.weight[i] * pull;
  }
}

bool IsUsable(const ContactPoint& contact, int node_count) noexcept {
  if (contact.count < 1 || contact.count > static_cast<int>(contact.node.size())) return false;
  for (int i = 0; i < contact.count; ++i)
    if (contact.node[i] < 0 || contact.node[i] >= node_count || !std::isfinite(contact.weight[i]))
      return false;
  return IsFinite(contact.foot) && IsFinite(contact.normal) && IsFinite(contact.start) &&
         IsFinite(contact.a) && IsFinite(contact.b) && IsFinite(contact.offset) &&
         std::isfinite(contact.radius) && std::isfinite(contact.hold) && contact.hold >= 0 &&
         std::isfinite(contact.stiffness) && contact.stiffness >= 0 &&
         std::isfinite(contact.friction) && contact.friction >= 0 && contact.slip_scale > 0;
}

}  // namespace arthro::simulation
