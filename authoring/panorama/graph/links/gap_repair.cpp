#include "authoring/panorama/graph/links/gap_repair.h"

#include <algorithm>
#include <optional>

#include "authoring/panorama/graph/links/pair_graph.h"
#include "simulation/core/at.h"

namespace arthro::authoring {
namespace {

constexpr const char* kStage = "closing gaps";
constexpr int kTriesPerOrphan = 3;

cv::Matx33d Scaled(const cv::Matx33d& m) { return m * (1 / m(2, 2)); }

// Motion between usable[k] and usable[k + 1], if that pair was found.
std::optional<cv::Matx33d> MotionAt(const std::vector<int>& usable, const PairBook& book, int k) {
  if (k < 0 || k + 1 >= static_cast<int>(usable.size())) return std::nullopt;
  const PairEstimate* pair = book.Find(usable[At(k)], usable[At(k + 1)]);
  if (pair == nullptr) return std::nullopt;
  return pair->b_from_a;
}

}  // namespace

void RepairGaps(const std::vector<int>& usable, int frames, int searches, PairBook& book,
                const Progress& progress) {
  const int count = static_cast<int>(usable.size());
  std::vector<int> gaps;  // k: between usable[k] and usable[k + 1]
  for (int k = 0; k + 1 < count; ++k)
    if (!book.Has(usable[At(k)], usable[At(k + 1)])) gaps.push_back(k);

  // Steps in the order of their cost; a gap is closed when its two sides are connected. Usually a
  // single frame is faulty, so its neighbours are tried before any search.
  struct Step {
    int before, after;  // pair (k - before, k + 1 + after)
    int motion;         // -1 the motion before, 1 the one after, 2 as neighbours, 0 a search
  };
  const Step steps[] = {{0, 0, -1}, {0, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, 2}, {1, 0, 2},
                        {0, 0, 0},  {0, 1, 0}, {1, 0, 0},  {1, 1, 0}, {0, 2, 0}, {2, 0, 0}};
  int searched = 0;
  for (const Step& step : steps) {
    if (gaps.empty()) return;
    if (step.motion == 0) {
      if (searched++ >= searches) return;
      // Searches are expensive: only for gaps between pieces of more than one frame.
      const std::vector<int> piece = PiecesOf(frames, book.pairs());
      std::vector<int> size(piece.size(), 0);
      for (const int i : usable) ++size[At(piece[At(i)])];
      std::erase_if(gaps, [&](int k) {
        return size[At(piece[At(usable[At(k)])])] < 2 || size[At(piece[At(usable[At(k + 1)])])] < 2;
      });
      if (gaps.empty()) return;
    }
    std::vector<PairRequest> requests;
    for (const int k : gaps) {
      const int from = k - step.before, to = k + 1 + step.after;
      if (from < 0 || to >= count) continue;
      PairRequest request{usable[At(from)], usable[At(to)], PairEffort::kSearch,
                          cv::Matx33d::eye()};
      if (step.motion == 2) request.effort = PairEffort::kNeighbours;
      if (step.motion == -1 || step.motion == 1) {
        const auto motion = MotionAt(usable, book, k + step.motion);
        if (!motion) continue;
        request.effort = PairEffort::kPredicted;
        request.predicted_b_from_a = *motion;
        for (int i = 0; i < step.before + step.after; ++i)
          request.predicted_b_from_a = *motion * request.predicted_b_from_a;
        request.predicted_b_from_a = Scaled(request.predicted_b_from_a);
      }
      requests.push_back(request);
    }
    book.Ask(requests, true, kStage, progress);
    const std::vector<int> piece = PiecesOf(frames, book.pairs());
    std::erase_if(gaps,
                  [&](int k) { return piece[At(usable[At(k)])] == piece[At(usable[At(k + 1)])]; });
  }
}

int AdoptOrphans(const std::vector<int>& usable, const std::vector<cv::Matx33d>& plane_from_frame,
                 const std::vector<int>& piece, int main, const FrameWindow& window, PairBook& book,
                 const Progress& progress) {
  const int count = static_cast<int>(usable.size());
  const auto place = [&](int k) -> const cv::Matx33d* {
    if (k < 0 || k >= count || piece[At(usable[At(k)])] != main) return nullptr;
    return &plane_from_frame[At(usable[At(k)])];
  };
  std::vector<PairRequest> requests;
  for (int k = 0; k < count; ++k) {
    if (place(k) != nullptr) continue;
    std::vector<cv::Matx33d> guesses;
    const cv::Matx33d *before = place(k - 1), *after = place(k + 1);
    if (before && after) {
      guesses.push_back(Scaled(*before * (1 / (*before)(2, 2)) + *after * (1 / (*after)(2, 2))));
    } else if (before && place(k - 2)) {
      guesses.push_back(Scaled(*before * place(k - 2)->inv() * *before));
    } else if (after && place(k + 2)) {
      guesses.push_back(Scaled(*after * place(k + 2)->inv() * *after));
    }
    for (const cv::Matx33d& guess : guesses) {
      struct Choice {
        double overlap;
        int frame;
        cv::Matx33d frame_from_orphan;
      };
      std::vector<Choice> choices;
      for (int other = 0; other < count; ++other) {
        if (place(other) == nullptr) continue;
        const cv::Matx33d m = place(other)->inv() * guess;
        const double overlap = OverlapOf(window, m);
        if (overlap > 0.4) choices.push_back({overlap, usable[At(other)], Scaled(m)});
      }
      std::stable_sort(choices.begin(), choices.end(),
                       [](const Choice& x, const Choice& y) { return x.overlap > y.overlap; });
      for (int i = 0; i < std::min<int>(kTriesPerOrphan, static_cast<int>(choices.size())); ++i) {
        const Choice& choice = choices[At(i)];
        const int orphan = usable[At(k)];
        const bool is_first = orphan < choice.frame;
        requests.push_back(
            {std::min(orphan, choice.frame), std::max(orphan, choice.frame), PairEffort::kPredicted,
             is_first ? choice.frame_from_orphan : Scaled(choice.frame_from_orphan.inv())});
      }
    }
  }
  return book.Ask(requests, true, kStage, progress);
}

}  // namespace arthro::authoring
