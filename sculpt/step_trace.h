#pragma once
// What a simulation did, step by step, as numbers: `replay --trace FILE` writes one CSV row a step, for plots and
// for finding the step at which a method goes wrong.

#include <filesystem>
#include <fstream>
#include <string>

#include "sculpt/document.h"

namespace argil::sculpt {

struct StepRecord;

/// The columns, comma-separated, units after the last underscore. Energies: elastic and kinetic; of the springs of
/// tools and soft pins; of dead loads, gravity among them (0 at rest, falling as they do work); of contact, at
/// depth and in the springs of friction; what friction and plastic flow have taken for good since the body was
/// made; and their sum, which changes by what damping and the method itself take, and by the work of what is keyed
/// or led. Momenta and moments are about the origin. Reactions are what pins apply, tool forces what tools apply,
/// both to the body as it stands at the end of the step, without inertia. `min_volume_ratio` is the smallest det F
/// at a quadrature point. `residual` is Newton's last, relative to its first. Times are 0 where no clock runs.
[[nodiscard]] const std::string& step_trace_header();

/// One row, without the end of line. Numbers are the shortest that read back as the same double, in no locale.
/// `number` counts steps from 1; `line` is that of the session. Cost: two evaluations of the model.
[[nodiscard]] std::string step_trace_row(const Document& document, const fem::Loads& tool, const StepRecord& record,
                                         std::size_t number, int line);

class StepTrace {
 public:
  /// Begins the file anew with the header. @throws Error (bad_input) if it cannot be written.
  void open(const std::filesystem::path& path);
  bool is_open() const { return file_.is_open(); }
  /// Flushed, so that a killed program has written all its steps.
  void write(const std::string& row) { file_ << row << std::endl; }

 private:
  std::ofstream file_;
};

}  // namespace argil::sculpt
