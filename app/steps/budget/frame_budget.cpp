#include "app/steps/budget/frame_budget.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/steps/practice/start_practice.h"
#include "app/steps/tissue/tissue_step.h"

namespace arthro::app {
namespace {

using Kind = BudgetChange::Kind;

constexpr double kManyMissed = 0.01;  // share of ticks above which a force trembles

// Share of the pixels, and so of the stages, that a small picture leaves out.
constexpr double kLessPixels = 1.0 - kSmallScale * kSmallScale;

double PictureOf(const FrameBudget& budget) {
  return budget.scene.median() + budget.occlusion.median() + budget.disturbances.median() +
         budget.camera.median();
}

double TissueTime(const FrameBudget& budget) {
  double sum = 0;
  for (const TissueCost& cost : budget.tissues) sum += cost.step.median();
  return sum;
}

bool IsAnyTissueMeasured(const FrameBudget& budget) {
  return std::ranges::any_of(budget.tissues,
                             [](const TissueCost& cost) { return !cost.step.empty(); });
}

// ms, with two digits after the point for the short times of a force loop.
std::string Ms(double seconds) {
  return fmt::format("{:.{}f}", 1e3 * seconds, seconds < 1e-3 ? 2 : 1);
}

// Sentences about a time and its allowance.
struct Sentences {
  const char *has_room, *is_tight, *is_over;
};
constexpr Sentences kOfTissue{"The tissue takes {} ms of {}: there is room.",
                              "The tissue takes {} ms of {}: it keeps up, with little room.",
                              "The tissue takes {} ms of {}: cuts will lag."};
constexpr Sentences kOfForce{"The force loop takes {} ms of {}: there is room.",
                             "The force loop takes {} ms of {}: it keeps up, with little room.",
                             "The force loop takes {} ms of {}: forces will come late."};
constexpr Sentences kOfPicture{"The picture takes {} ms of {}: there is room.",
                               "The picture takes {} ms of {}: it keeps up, with little room.",
                               "The picture takes {} ms of {}: motion will be jerky."};

Verdict Judged(BudgetPart part, const Sentences& sentences, double seconds, double allowance) {
  const double share = seconds / allowance;
  const char* sentence = share > 1.0      ? sentences.is_over
                         : share > kTight ? sentences.is_tight
                                          : sentences.has_room;
  return {part, share, fmt::format(fmt::runtime(sentence), Ms(seconds), Ms(allowance))};
}

Verdict TissueVerdict(const FrameBudget& budget, const Scene& scene) {
  const bool is_any =
      std::ranges::any_of(scene.tissues, [](const Tissue& t) { return !t.mesh.empty(); });
  if (!IsAnyTissueMeasured(budget))
    return {BudgetPart::kTissue, std::nullopt,
            is_any ? "The tissue is not measured yet: press on it with the instrument."
                   : "No tissue of this scene has tetrahedra: none takes time."};
  return Judged(BudgetPart::kTissue, kOfTissue, TissueTime(budget), kTissueAllowance);
}

Verdict ForceVerdict(const FrameBudget& budget) {
  if (!budget.force)
    return {BudgetPart::kForce, std::nullopt,
            "The force loop is not measured yet: it runs in a practice, and while you poke."};
  const ForceCost& force = *budget.force;
  if (force.missed > kManyMissed)
    return {BudgetPart::kForce, 1.0 + force.missed,
            fmt::format("The force loop leaves out {:.1f} % of its ticks: forces will tremble.",
                        100 * force.missed)};
  return Judged(BudgetPart::kForce, kOfForce, force.median, force.period);
}

Verdict PictureVerdict(const FrameBudget& budget) {
  if (budget.whole.empty())
    return {BudgetPart::kPicture, std::nullopt, "The picture is not measured yet: move the scope."};
  return Judged(BudgetPart::kPicture, kOfPicture, budget.whole.median(), kPictureAllowance);
}

// Changes of one part, the mildest first.
std::vector<BudgetChange> TissueChanges(const FrameBudget& budget, const Scene& scene) {
  std::vector<BudgetChange> changes;
  for (const TissueCost& cost : budget.tissues) {
    const auto at = static_cast<std::size_t>(cost.tissue);
    if (cost.step.empty() || cost.elements == 0 || at >= scene.tissues.size()) continue;
    const double now = cost.step.median();
    for (const auto size : {authoring::MeshSize::kFine, authoring::MeshSize::kDefault,
                            authoring::MeshSize::kCoarse}) {
      // A budget is met to an eighth; a mesh that is as coarse gains nothing.
      const int elements = authoring::BudgetOf(size).elements;
      if (8 * cost.elements <= 9 * elements) continue;
      const double share = authoring::StepTimeOf(elements) / authoring::StepTimeOf(cost.elements);
      changes.push_back({Kind::kCoarserTissue, cost.tissue, size, now * (1.0 - share)});
    }
    changes.push_back({Kind::kRigidTissue, cost.tissue, {}, now});
  }
  return changes;
}

std::vector<BudgetChange> PictureChanges(const FrameBudget& budget, MovingPicture picture) {
  std::vector<BudgetChange> changes;
  if (picture == MovingPicture::kAutomatic && !budget.occlusion.empty())
    changes.push_back({Kind::kPlainPicture, -1, {}, budget.occlusion.median()});
  if (picture != MovingPicture::kSmall)
    changes.push_back({Kind::kSmallPicture, -1, {}, kLessPixels * PictureOf(budget)});
  return changes;
}

}  // namespace

void NoteWorld(FrameBudget& budget, const simulation::WorldPicture& world) {
  if (std::exchange(budget.step, world.step) == world.step) return;
  for (const simulation::BodyPicture& body : world.bodies) {
    auto found = std::ranges::find(budget.tissues, body.tissue, &TissueCost::tissue);
    if (found == budget.tissues.end())
      found = budget.tissues.insert(found, TissueCost{body.tissue, body.elements});
    if (!body.report.is_asleep) found->step.Add(1e-3 * body.step_ms);
  }
}

void NoteForce(FrameBudget& budget, const simulation::ServoReport& report) {
  if (report.compute.count() == 0) return;
  const auto ticks = static_cast<double>(report.ticks + report.missed);
  budget.force =
      ForceCost{report.period, report.compute.Quantile(0.5), report.compute.Quantile(0.99),
                static_cast<double>(report.missed) / ticks};
}

void NoteFrame(FrameBudget& budget, const FrameCost& cost) {
  const PictureCost& picture = cost.picture;
  budget.scene.Add(picture.scene);
  budget.occlusion.Add(picture.occlusion);
  budget.disturbances.Add(picture.disturbances);
  budget.camera.Add(picture.camera);
  budget.overview.Add(cost.overview);
  budget.whole.Add(cost.whole);
  budget.rest.Add(std::max(0.0, cost.whole - picture.scene - picture.occlusion -
                                    picture.disturbances - picture.camera - cost.overview));
}

void KeepBudgetFresh(EditorState& state) {
  FrameBudget& budget = *state.steps.practice->budget;
  const simulation::Practice* live = LiveSession(state);
  if (!budget.is_shown || live == nullptr) return;
  if (std::exchange(budget.session, live) != live) {
    budget.tissues.clear();
    budget.force.reset();
    budget.step = 0;
  }
  if (const auto* world = live->tissues()) NoteWorld(budget, *world);
  if (const auto* report = live->servo_report()) NoteForce(budget, *report);
}

std::array<Verdict, 3> VerdictsOf(const FrameBudget& budget, const Scene& scene) {
  return {TissueVerdict(budget, scene), ForceVerdict(budget), PictureVerdict(budget)};
}

std::optional<BudgetChange> HelpfulChange(const FrameBudget& budget, const Scene& scene,
                                          MovingPicture picture) {
  // The force loop has no part that could be left out: its time is that of the contact.
  const double tissue = TissueTime(budget), whole = budget.whole.median();
  const bool is_tissue = tissue / kTissueAllowance >= whole / kPictureAllowance;
  const double over =
      is_tissue ? tissue - kTight * kTissueAllowance : whole - kTight * kPictureAllowance;
  if (over <= 0) return std::nullopt;
  const std::vector<BudgetChange> changes =
      is_tissue ? TissueChanges(budget, scene) : PictureChanges(budget, picture);
  const BudgetChange* best = nullptr;
  for (const BudgetChange& change : changes) {
    if (change.kind == Kind::kRigidTissue) continue;
    const bool is_enough = change.saving >= over;
    if (best == nullptr || (is_enough ? best->saving < over || change.saving < best->saving
                                      : best->saving < change.saving))
      best = &change;
  }
  // A tissue that cannot be coarser can only be rigid.
  if (best == nullptr && !changes.empty())
    best = &*std::ranges::max_element(changes, {}, &BudgetChange::saving);
  return best == nullptr ? std::nullopt : std::optional(*best);
}

std::string WordsOf(const BudgetChange& change, const Scene& scene) {
  const std::string saved = Ms(change.saving);
  const std::string name =
      change.tissue >= 0 ? scene.tissues[static_cast<std::size_t>(change.tissue)].name : "";
  switch (change.kind) {
    case Kind::kCoarserTissue:
      return fmt::format("About {} elements for {} save about {} ms.",
                         authoring::BudgetOf(change.size).elements, name, saved);
    case Kind::kRigidTissue:
      return fmt::format("{} as a solid that does not give way saves about {} ms.", name, saved);
    case Kind::kPlainPicture:
      return fmt::format("Moving pictures without soft shade save about {} ms.", saved);
    case Kind::kSmallPicture:
      return fmt::format("Moving pictures of half as many pixels save about {} ms.", saved);
  }
  return {};
}

void Make(EditorState& state, const BudgetChange& change) {
  switch (change.kind) {
    case Kind::kCoarserTissue:
      state.tissue = change.tissue;
      state.steps.tissue->mesh_size = change.size;
      return TetrahedraliseTissue(state);
    case Kind::kRigidTissue:
      state.tissue = change.tissue;
      SetSolid(state, change.tissue, true);
      return;
    case Kind::kPlainPicture:
      state.settings.moving_picture = MovingPicture::kPlain;
      return;
    case Kind::kSmallPicture:
      state.settings.moving_picture = MovingPicture::kSmall;
      return;
  }
}

}  // namespace arthro::app
