#pragma once
// Sessions for tests: each in a folder of its own, read from and written to.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

/// A new folder that goes when this does.
class TestFolder {
 public:
  TestFolder() {
    static int made = 0;
    path_ = std::filesystem::path(testing::TempDir()) /
            ("argil_session_" + std::to_string(getpid()) + "_" + std::to_string(made++));
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string text_of(const std::string& name) const {
    std::ifstream file(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path path_;
};

class TestSession {
 public:
  explicit TestSession(std::vector<std::string> lines = {}, SessionOptions options = {})
      : session_(in_folder(std::move(options))) {
    run(lines);
  }

  void run(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) session_.run_line(line);
  }
  /// What a line that must fail throws; without a message if it passes.
  Error fault_of(const std::string& line) {
    try {
      session_.run_line(line);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "accepted: " << line;
    return {ErrorCode::bad_input, ""};
  }
  double measure(const std::string& what) {
    session_.run_line("measure " + what);
    return session_.measures().back().value;
  }
  /// Moves the control points to where a map takes their rest positions: level 1 of a box follows it exactly.
  void deform(const Eigen::Matrix3d& map) {
    State next = state();
    auto motion = std::make_shared<fem::BodyState>(*next.motion);
    motion->positions = map * *next.rest;
    next.motion = motion;
    document().assign(std::move(next));
  }
  std::uint64_t hash() const { return session_.document().state_hash(); }
  Document& document() { return session_.document(); }
  const State& state() const { return session_.document().state(); }
  Session& session() { return session_; }
  Session* operator->() { return &session_; }
  const TestFolder& folder() const { return folder_; }

 private:
  SessionOptions in_folder(SessionOptions options) {
    options.read_root = options.out = folder_.path();
    return options;
  }

  TestFolder folder_;
  Session session_;
};

}  // namespace argil::sculpt
