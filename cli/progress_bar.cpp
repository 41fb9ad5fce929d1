#include "cli/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <string_view>

namespace barkridge::cli {

namespace {

std::atomic<bool> line_visible{false};

void write_to_terminal(std::string_view text) noexcept {
  // A terminal that cannot be written to is no reason to end the job.
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text.data(), text.size());
}

std::string time_in_words(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

ProgressBar::ProgressBar(bool quiet) : shown_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear_progress_line(); }

Progress ProgressBar::stage(std::string name) {
  if (!shown_) return {};
  stage_ = std::move(name);
  start_ = Clock::now();
  last_drawn_ = {};
  return [this](double fraction) { return show(fraction); };
}

bool ProgressBar::show(double fraction) {
  constexpr auto kBetweenDrawings = std::chrono::milliseconds(100);
  constexpr std::size_t kWidth = 30;
  const Clock::time_point now = Clock::now();
  if (now - last_drawn_ < kBetweenDrawings) return true;
  last_drawn_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::size_t filled = static_cast<std::size_t>(fraction * kWidth);
  std::string line = fmt::format("\r{:<10} [{}{}] {:3.0f} %", stage_, std::string(filled, '#'),
                                 std::string(kWidth - filled, '-'), 100 * fraction);
  if (fraction > 0) line += fmt::format("  {} left", time_in_words(elapsed * (1 - fraction) / fraction));
  line_visible = true;
  write_to_terminal(line + "\x1b[K");
  return true;
}

void clear_progress_line() noexcept {
  if (line_visible.exchange(false)) write_to_terminal("\r\x1b[K");
}

}  // namespace barkridge::cli
