// Undo and redo of whole documents. Every edit is a named step that holds the complete document, so
// undo covers every field. Heavy parts are shared between steps and counted once; the oldest steps
// are dropped when all steps together exceed a memory limit. Not thread-safe.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "authoring/project/document.h"

namespace arthro::authoring {

class History {
 public:
  static constexpr std::size_t kMemoryLimit = std::size_t{1} << 30;  // bytes

  explicit History(Document document, std::size_t memory_limit = kMemoryLimit);

  const Document& current() const { return steps_[position_].document; }

  // Makes `next` current as a step that a person can read ("Move medial meniscus"); steps that were
  // undone are gone. Pushes in a row with one non-empty `merge_key` ("depth.gamma") are one step
  // until EndMerge, so that a slider's drag is undone at once.
  void Push(Document next, const std::string& name, const std::string& merge_key = "");
  void EndMerge() { merge_key_.clear(); }  // the slider was let go

  // Replaces the current step's document, its name kept: for a product that was computed after the
  // edit that asked for it, so that both are undone at once. Steps that were undone stay.
  void Amend(Document document);

  bool CanUndo() const { return position_ > 0; }
  bool CanRedo() const { return position_ + 1 < steps_.size(); }
  // Name of the step that Undo or Redo would apply to; "" if there is none.
  std::string UndoName() const { return CanUndo() ? steps_[position_].name : ""; }
  std::string RedoName() const { return CanRedo() ? steps_[position_ + 1].name : ""; }
  void Undo();  // nothing happens where there is nothing to undo
  void Redo();

  std::string StepName() const { return steps_[position_].name; }  // the current one

  // For a list of steps: their names, oldest first (the first is how the document began), and which
  // one is current. GoTo clamps.
  std::vector<std::string> StepNames() const;
  int Position() const { return static_cast<int>(position_); }
  void GoTo(int position);

  // The current document is on disk. `saved` replaces it where saving changed where its files lie.
  void MarkSaved();
  void MarkSaved(Document saved);
  // Differs for each state of the document, and is the same again after undo and redo.
  long long StateId() const { return steps_[position_].id; }
  long long IdOf(int position) const { return steps_[static_cast<std::size_t>(position)].id; }
  bool IsSaved() const { return steps_[position_].id == saved_id_; }
  // Steps between the current document and the one that was saved; all of them where that one is
  // gone.
  int StepsFromSaved() const;

  // Files that some step needs and that no step holds in memory: tetrahedra, lenses.
  std::set<std::filesystem::path> FilesOnlyOnDisk() const;

  // Bytes of the big parts of all steps, each part once.
  std::size_t MemoryUsed() const;

 private:
  struct Step {
    Document document;
    std::string name;
    long long id = 0;  // identifies this state of the document
  };

  void DropOldest();

  std::vector<Step> steps_;
  std::size_t position_ = 0, memory_limit_;
  long long last_id_ = 0, saved_id_ = -1;
  std::string merge_key_;
};

}  // namespace arthro::authoring
