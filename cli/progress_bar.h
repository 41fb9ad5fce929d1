#pragma once

#include <chrono>
#include <string>

#include "base/progress.h"

namespace barkridge::cli {

/// One line on the standard error that shows how far a job is and how long it will still take; nothing at all where
/// that is not a terminal. Gone when the bar is.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Starts a stage of the job: the listener to hand to it. The bar must outlive it.
  Progress stage(std::string name);

 private:
  using Clock = std::chrono::steady_clock;

  bool show(double fraction);

  bool shown_ = false;
  std::string stage_;
  Clock::time_point start_, last_drawn_;
};

/// Erases a progress bar that is on the screen. Safe to call from a signal handler.
void clear_progress_line() noexcept;

}  // namespace barkridge::cli
