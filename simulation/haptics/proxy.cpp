#include "simulation/haptics/proxy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

// Gap between proxy and surfaces, so that rounding never puts it behind one. 1 µm is 0.5 mN.
constexpr double kSkin = 1e-6;      // m
constexpr double kTouching = 2e-6;  // m; a surface nearer than this is in contact
// A foot with an error s is further from a tip at depth d by only s²/2d, so the surface must be met
// more precisely than the foot: 0.1 nm of height is 0.4 µm of foot at 1 mm.
constexpr double kOnSurface = 1e-10;  // m
constexpr double kNearer = 1e-11;     // m
constexpr double kArrived = 1e-8;     // m; 5 µN
constexpr double kNearEnough = 1e-7;  // m along the field; 50 µN, for a third of the queries
constexpr double kBlindStep = 1e-3;   // m; step where no pixel size is known
// Bounds of the work per tick; the rest is done in the next one.
constexpr int kMaxSlides = 48, kMaxHalvings = 5, kMaxMarch = 4096, kMaxFaces = 4;
constexpr int kMaxProjections = 4, kMaxBisections = 24;

class Mover {
 public:
  Mover(const Surroundings& surroundings, double radius, Proxy& proxy) noexcept
      : around_(surroundings), radius_(radius), proxy_(proxy) {}

  FieldQuery Query(const glm::dvec3& x) const noexcept {
    if (IsClearOfField(x)) return {};
    return around_.field.Query(x);
  }
  // Skips the query where the ball is nearer to the portal than any of the backdrop.
  bool IsClearOfField(const glm::dvec3& x) const noexcept { return ClearBy(x) > 0.0; }
  double ClearBy(const glm::dvec3& x) const noexcept {
    return around_.field.free_radius() - radius_ - kTouching - glm::length(x);
  }
  Plane FieldPlane(const FieldQuery& query, const glm::dvec3& x) const noexcept {
    return {query.normal, glm::dot(query.normal, x) - (query.clearance - radius_), 0, query.weight};
  }
  bool Bears(const FieldQuery& query) const noexcept {
    return query.weight > 0.0 && query.clearance - radius_ < kTouching;
  }

  // Finds the first mesh on the way. Returns true where `hit` and `plane` are set; the fraction is
  // that of the way.
  bool SweepMeshes(const glm::dvec3& from, const glm::dvec3& to, SweepHit& hit,
                   Plane& plane) noexcept {
    int met = -1;
    const auto count = static_cast<int>(around_.meshes.size());
    const auto sweep = [&](int mesh) {
      const int first = mesh == proxy_.last_mesh ? proxy_.last_triangle : -1;
      const auto i = static_cast<std::size_t>(mesh);
      const SweptSurface* other = i < around_.instead.size() ? around_.instead[i] : nullptr;
      if (other != nullptr ? other->Sweep(from, to, radius_ + kSkin, first, hit)
                           : around_.meshes[i].Sweep(from, to, radius_ + kSkin, first, hit))
        met = mesh;
    };
    if (proxy_.last_mesh >= 0 && proxy_.last_mesh < count) sweep(proxy_.last_mesh);
    for (int mesh = 0; mesh < count && hit.fraction > 0.0; ++mesh)
      if (mesh != proxy_.last_mesh) sweep(mesh);
    if (met < 0) return false;
    proxy_.last_mesh = met;
    proxy_.last_triangle = hit.triangle;
    const glm::dvec3 at = from + hit.fraction * (to - from);
    plane = {hit.normal, glm::dot(hit.normal, at) - hit.gap, 1 + met, 1.0};
    return true;
  }

  // Returns the free fraction of the way from `from`, which is outside the field, to `to`.
  double March(const glm::dvec3& from, const glm::dvec3& to) const noexcept {
    const double length = glm::length(to - from);
    if (IsClearOfField(from) && IsClearOfField(to)) return 1.0;  // a ball is convex
    double s = 0.0;
    FieldQuery query = Query(from);
    for (int step = 0; step < kMaxMarch && s < 1.0; ++step) {
      const glm::dvec3 x = from + s * (to - from);
      const double clear = ClearBy(x);
      const double pixel = query.px_per_m > 0.0 ? 1.0 / query.px_per_m : kBlindStep;
      const double next = std::min(1.0, s + std::max(clear + kArrived, pixel) / length);
      const bool was_free = query.weight > 0.0 ? query.clearance >= radius_ : clear > 0.0;
      query = Query(from + next * (to - from));
      if (was_free && query.weight > 0.0 && query.clearance < radius_) {
        // Refines the crossing between s and next.
        double low = s, high = next;
        for (int i = 0; i < kMaxBisections && (high - low) * length > 0.1 * kArrived; ++i) {
          const double middle = 0.5 * (low + high);
          const FieldQuery there = Query(from + middle * (to - from));
          (there.weight > 0.0 && there.clearance < radius_ ? high : low) = middle;
        }
        return low;
      }
      s = next;
    }
    return s;
  }

  // Moves x out of the field without entering a mesh. Returns false where this fails.
  bool Project(PlaneSet planes, glm::dvec3& x) noexcept {
    for (int i = 0; i < kMaxProjections; ++i) {
      const FieldQuery query = Query(x);
      if (query.weight <= 0.0 || query.clearance >= radius_ - kOnSurface) return true;
      PlaneSet both = planes;
      both.Add(FieldPlane(query, x));
      const glm::dvec3 out = NearestPoint(both, x, x).nearest;
      SweepHit hit;
      Plane plane;
      if (SweepMeshes(x, out, hit, plane)) {
        planes.Add(plane);
        x += hit.fraction * (out - x);
      } else {
        x = out;
      }
    }
    const FieldQuery query = Query(x);
    return query.weight <= 0.0 || query.clearance >= radius_ - kSkin;
  }

  // Moves x along the planes towards the goal and adds the planes of the surfaces that it meets.
  // `reach` limits the way, unless it `is_free` and no plane holds it. Returns true where x has
  // moved; adds to `travelled`.
  bool Slide(const glm::dvec3& goal, double reach, bool is_free, bool is_on_field, PlaneSet& planes,
             glm::dvec3& x, double& travelled) noexcept {
    bool has_moved = false;
    for (int face = 0; face < kMaxFaces; ++face) {
      glm::dvec3 way = NearestPoint(planes, goal, x).nearest - x;
      double length = glm::length(way);
      if (!(length > (is_on_field ? kNearEnough : kArrived))) return has_moved;
      const bool is_limited = planes.count > 0 || !is_free;
      if (is_limited && length > reach) way *= reach / length, length = reach;
      SweepHit hit;
      Plane plane;
      const bool is_met = SweepMeshes(x, x + way, hit, plane);
      double fraction = is_met ? hit.fraction : 1.0;
      bool is_in_field = false;
      if (!is_on_field && !around_.field.empty()) {
        const double free = March(x, x + fraction * way);
        is_in_field = free < 1.0;
        fraction *= free;
      }
      x += fraction * way;
      if (is_limited) {
        travelled += fraction * length;
        reach -= fraction * length;
      }
      has_moved |= fraction * length > kArrived;
      if (is_in_field || !is_met) return has_moved;
      if (!planes.Add(plane)) return has_moved;
    }
    return has_moved;
  }

 private:
  const Surroundings& around_;
  double radius_;
  Proxy& proxy_;
};

}  // namespace

void MoveProxy(const Surroundings& surroundings, double radius, const glm::dvec3& goal,
               double max_travel, bool is_free, Proxy& proxy) noexcept {
  Mover mover(surroundings, radius, proxy);
  glm::dvec3& x = proxy.position;
  double budget = max_travel;
  double stride = std::numeric_limits<double>::infinity();  // m; smaller near the goal
  for (int slide = 0; slide < kMaxSlides && budget > kArrived; ++slide) {
    const FieldQuery query = mover.Query(x);
    // Moves out along the normal first where a new surface covers the proxy.
    if (query.weight > 0.0 && query.clearance < radius - kSkin) {
      const glm::dvec3 before = x;
      const double depth = std::min(radius - query.clearance, budget);
      SweepHit hit;
      Plane plane;
      const glm::dvec3 out = x + depth * query.normal;
      x = mover.SweepMeshes(x, out, hit, plane) ? x + hit.fraction * (out - x) : out;
      budget -= std::max(glm::length(x - before), kArrived);
      continue;
    }
    PlaneSet planes;
    double travelled = 0.0;
    if (!mover.Bears(query)) {
      if (!mover.Slide(goal, budget, is_free, false, planes, x, travelled)) return;
      budget -= travelled;
      continue;
    }
    // Descends along the backdrop: one pixel at a time, back onto the surface, accepted only if it
    // comes nearer.
    planes.Add(mover.FieldPlane(query, x));
    const glm::dvec3 start = x;
    const double distance = glm::length(goal - start);
    double reach =
        std::min({budget, stride, query.px_per_m > 0.0 ? 1.0 / query.px_per_m : kBlindStep});
    bool is_nearer = false;
    for (int halving = 0; halving < kMaxHalvings && !is_nearer; ++halving, reach *= 0.5) {
      PlaneSet met = planes;
      glm::dvec3 trial = start;
      double way = 0.0;
      if (!mover.Slide(goal, reach, false, true, met, trial, way)) return;
      PlaneSet faces;  // planes of meshes only; Project finds that of the backdrop
      for (int i = 0; i < met.count; ++i)
        if (met.plane[static_cast<std::size_t>(i)].contact > 0)
          faces.Add(met.plane[static_cast<std::size_t>(i)]);
      is_nearer = mover.Project(faces, trial) && glm::length(goal - trial) < distance - kNearer;
      if (!is_nearer) continue;
      x = trial;
      budget -= glm::length(trial - start);
      stride = halving == 0 ? 2.0 * reach : reach;
    }
    if (!is_nearer) return;
  }
}

bool IsFree(const Surroundings& surroundings, double radius, const Proxy& proxy) noexcept {
  Proxy copy = proxy;
  const FieldQuery query = Mover(surroundings, radius, copy).Query(proxy.position);
  if (query.weight > 0.0 && query.clearance < radius - kTouching) return false;
  for (const SweptSurface* surface : surroundings.instead)
    if (surface != nullptr && !surface->IsFree(proxy.position, radius - kTouching)) return false;
  return true;
}

bool IsWayFree(const Surroundings& surroundings, double radius, const glm::dvec3& from,
               const glm::dvec3& to) noexcept {
  Proxy copy;
  Mover mover(surroundings, radius, copy);
  // Most tips that are far from their proxy are below the backdrop, which one query shows.
  const FieldQuery query = mover.Query(to);
  if (query.weight > 0.0 && query.clearance < radius) return false;
  SweepHit hit;
  Plane plane;
  if (mover.SweepMeshes(from, to, hit, plane)) return false;
  return surroundings.field.empty() || mover.March(from, to) >= 1.0;
}

PlaneSet PlanesAt(const Surroundings& surroundings, double radius, const glm::dvec3& goal,
                  Proxy& proxy) noexcept {
  Mover mover(surroundings, radius, proxy);
  PlaneSet planes;
  const glm::dvec3& x = proxy.position;
  const FieldQuery query = mover.Query(x);
  if (mover.Bears(query)) planes.Add(mover.FieldPlane(query, x));
  for (int face = 0; face < kMaxFaces; ++face) {
    const glm::dvec3 way = NearestPoint(planes, goal, x).nearest - x;
    const double length = glm::length(way);
    if (!(length > kArrived)) break;
    SweepHit hit;
    Plane plane;
    if (!mover.SweepMeshes(x, x + way, hit, plane) || hit.fraction * length > kTouching) break;
    if (!planes.Add(plane)) break;
  }
  return planes;
}

}  // namespace arthro::simulation
