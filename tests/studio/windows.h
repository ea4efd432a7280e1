#pragma once
// The window off the screen, for tests: on a block or on one of the samples, in a folder of its own.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "io/file_bytes.h"
#include "sculpt/session.h"
#include "tools/studio/offscreen.h"

namespace argil::studio {

inline std::filesystem::path test_folder(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "studio" / name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

inline OffscreenOptions small_window(const std::string& name) {
  OffscreenOptions result;
  result.width = 960;
  result.height = 640;
  result.card = false;
  result.bench.out = test_folder(name);
  return result;
}

inline const sculpt::Document& document(Offscreen& window) {
  return window.workshop().bench().session().document();
}

inline std::uint64_t hash(Offscreen& window) {
  return document(window).state_hash();
}

/// What the journal of a window gives when a program replays it.
inline std::uint64_t hash_of_journal(Offscreen& window, const std::string& name) {
  sculpt::SessionOptions replay;
  replay.out = test_folder(name);
  sculpt::Session session(replay);
  const auto file = window.workshop().bench().session().journal_path();
  session.run_text(io::read_file(file), file.string());
  return session.document().state_hash();
}

inline Eigen::Vector2d pixel(Offscreen& window, const Eigen::Vector3d& place) {
  return window.studio().viewport().camera().pixel(place);
}

inline void click_at(Offscreen& window, const Eigen::Vector3d& place) {
  const Eigen::Vector2d at = pixel(window, place);
  window.click(at.x(), at.y());
  window.wait(2);
}

}  // namespace argil::studio
