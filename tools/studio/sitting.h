#pragma once
// A session with what the window remembers of it: which changes one action of the sculptor was, what stands in the
// history, and what of it is saved.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sculpt/session.h"
#include "tools/studio/snapshot.h"

namespace argil::studio {

struct Sitting {
  std::unique_ptr<sculpt::Session> session;
  std::vector<std::size_t> marks;  // depths of the undo stack at which an action ended
  std::vector<HistoryEntry> history;
  std::filesystem::path file;                // that it was opened from or saved to; empty: none
  std::size_t lines = 0, saved_lines = 0;    // of the journal
  std::uint64_t solids = 0, tool_lines = 0;  // lines that began a solid, that took a tool

  /// Runs a line and remembers it; one without a command is passed over. @throws what Session::run_line throws.
  void run(const std::string& line);
  /// A line has been journaled; with `repeats` it counts with the one before, if that is the same.
  void remember(const std::string& line, std::size_t depth_before, bool repeats);
  /// An action has ended that began at this depth of the undo stack; with `joins_last` it is one with that before
  /// it.
  void mark_change(std::size_t depth_before, bool joins_last);
  /// How many changes of the session the last action was, or the next one that was undone; 0: there is none.
  [[nodiscard]] std::size_t changes_to_undo() const;
  [[nodiscard]] std::size_t changes_to_redo() const;
};

}  // namespace argil::studio
