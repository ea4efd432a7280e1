#include "tools/studio/sitting.h"

#include <algorithm>

namespace argil::studio {

void Sitting::run(const std::string& text) {
  const io::SessionLine line = io::parse_session_line(text, "input", 1);
  if (line.tokens.empty()) return;
  const std::size_t depth = session->undo_depth();
  session->run_line(line);
  const std::string& name = line.tokens[0].text;
  if (name == "new" || name == "open" || name == "solidify") ++solids;
  if (name == "tool") ++tool_lines;
  if (sculpt::find_command(line).effect == sculpt::Effect::history)
    ++lines;
  else
    remember(io::format_line(line.tokens), depth, false);
}

void Sitting::remember(const std::string& line, std::size_t depth_before, bool repeats) {
  const std::size_t depth = session->undo_depth();
  if (depth > depth_before) std::erase_if(history, [&](const HistoryEntry& entry) { return entry.undone; });
  if (repeats && !history.empty() && history.back().line == line) {
    history.back().depth = depth;
    ++history.back().times;
  } else {
    history.push_back({.line = line, .depth = depth});
  }
  ++lines;
}

// A change cuts off what had been undone.
void Sitting::mark_change(std::size_t depth_before, bool joins_last) {
  const std::size_t depth = session->undo_depth();
  if (depth <= depth_before) return;
  std::erase_if(marks, [&](std::size_t mark) { return mark > depth_before; });
  if (joins_last && !marks.empty() && marks.back() == depth_before) marks.pop_back();
  marks.push_back(depth);
}

std::size_t Sitting::changes_to_undo() const {
  const std::size_t depth = session->undo_depth();
  std::size_t below = 0;
  for (const std::size_t mark : marks)
    if (mark < depth) below = std::max(below, mark);
  return depth - below;
}

std::size_t Sitting::changes_to_redo() const {
  const std::size_t depth = session->undo_depth();
  std::size_t above = depth + session->redo_depth();
  for (const std::size_t mark : marks)
    if (mark > depth) above = std::min(above, mark);
  return above - depth;
}

}  // namespace argil::studio
