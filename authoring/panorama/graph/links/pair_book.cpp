#include "authoring/panorama/graph/links/pair_book.h"

#include "authoring/panorama/graph/links/parallel.h"

namespace arthro::authoring {

int PairBook::Ask(const std::vector<PairRequest>& requests, bool again, std::string_view stage,
                  const Progress& progress) {
  std::vector<PairRequest> open;
  std::map<std::pair<int, int>, bool> asked;
  for (const PairRequest& request : requests) {
    const std::pair<int, int> key{request.a, request.b};
    const auto known = tried_pairs_.find(key);
    if (known != tried_pairs_.end() && (known->second.empty() || !again)) continue;
    if (!asked.emplace(key, true).second) continue;
    open.push_back(request);
  }
  struct Answer {
    std::optional<PairEstimate> pair;
    std::string why_not;
  };
  std::vector<Answer> answers(open.size());
  ForEachIndex(static_cast<int>(open.size()), threads_, progress, stage, [&](int i) {
    Answer& answer = answers[static_cast<std::size_t>(i)];
    answer.pair = maker_(open[static_cast<std::size_t>(i)], &answer.why_not);
  });
  int found = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    Answer& answer = answers[i];
    ++tried_;
    std::string& why = tried_pairs_[{open[i].a, open[i].b}];
    if (answer.pair) {
      pairs_.push_back(*answer.pair);
      why.clear();
      ++found;
    } else {
      why = answer.why_not.empty() ? "no agreement" : answer.why_not;
    }
  }
  return found;
}

bool PairBook::Has(int a, int b) const {
  const auto known = tried_pairs_.find({a, b});
  return known != tried_pairs_.end() && known->second.empty();
}

const PairEstimate* PairBook::Find(int a, int b) const {
  for (const PairEstimate& pair : pairs_)
    if (pair.a == a && pair.b == b) return &pair;
  return nullptr;
}

std::string PairBook::WhyNot(int a, int b) const {
  const auto known = tried_pairs_.find({a, b});
  return known == tried_pairs_.end() ? std::string() : known->second;
}

void PairBook::Drop(const std::vector<bool>& is_false, const std::string& why) {
  std::vector<PairEstimate> kept;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (is_false[i])
      tried_pairs_[{pairs_[i].a, pairs_[i].b}] = why;
    else
      kept.push_back(pairs_[i]);
  }
  pairs_ = std::move(kept);
}

}  // namespace arthro::authoring
