#include "cli/frames.h"

#include <fmt/format.h>

#include <charconv>

#include "base/error.h"
#include "cli/option_values.h"

namespace barkridge::cli {

namespace {

constexpr int kLastFrame = 1'000'000;
constexpr std::size_t kMostDigits = 20;

// Where a name has a frame's number, and with how many digits.
struct NumberPlace {
  std::size_t begin = 0, length = 0, digits = 1;
};

// The place at `begin`, which is a `#` or `%`, if there is one.
std::optional<NumberPlace> place_at(std::string_view name, std::size_t begin) {
  if (name[begin] == '#') {
    const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
    return NumberPlace{begin, end - begin, end - begin};
  }
  const std::size_t end = name.find_first_not_of("0123456789", begin + 1);
  if (end == name.npos || name[end] != 'd') return std::nullopt;
  std::size_t digits = 1;
  std::from_chars(name.data() + begin + 1, name.data() + end, digits);
  return NumberPlace{begin, end + 1 - begin, digits};
}

std::optional<NumberPlace> only_place(std::string_view name) {
  std::optional<NumberPlace> found;
  for (std::size_t i = name.find_first_of("#%"); i < name.size(); i = name.find_first_of("#%", i)) {
    const std::optional<NumberPlace> place = place_at(name, i);
    if (place && found) return std::nullopt;
    if (place) found = place;
    i += place ? place->length : 1;
  }
  return found && found->digits <= kMostDigits ? found : std::nullopt;
}

}  // namespace

std::optional<FrameRange> frame_range_of(std::string_view text) {
  for (const std::string_view separators : {"", "-", "-:"}) {
    const std::optional<std::vector<int>> numbers = integers_between(text, separators);
    if (!numbers) continue;
    FrameRange range{numbers->front(), numbers->size() > 1 ? (*numbers)[1] : numbers->front()};
    if (numbers->size() > 2) range.step = (*numbers)[2];
    if (range.first > range.last || range.last > kLastFrame || range.step < 1) return std::nullopt;
    return range;
  }
  return std::nullopt;
}

std::optional<std::string> frame_path(const std::string& pattern, int frame) {
  const std::size_t name = pattern.rfind('/') + 1;  // 0 where there is none
  const std::optional<NumberPlace> place = only_place(std::string_view(pattern).substr(name));
  if (!place) return std::nullopt;
  std::string path = pattern;
  return path.replace(name + place->begin, place->length, fmt::format("{:0{}}", frame, place->digits));
}

std::vector<Frame> frames_of(const std::optional<FrameRange>& range, const std::vector<std::string>& outputs,
                             const SceneSequence& sequence) {
  if (!range) return {{std::nullopt, outputs, ""}};
  const int count = (range->last - range->first) / range->step + 1;
  std::vector<Frame> frames(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const int number = range->first + k * range->step;
    Frame& frame = frames[static_cast<std::size_t>(k)];
    frame.time = number * sequence.steps_per_frame;
    if (count > 1) frame.title = fmt::format("frame {} of {}: ", k + 1, count);
    for (const std::string& output : outputs) {
      const std::optional<std::string> path = frame_path(output, number);
      if (!path && count > 1) {
        throw InputError({output, 0, 0, ""},
                         "expected one place for the number of the frame in the name, like tree_####.png or "
                         "tree_%04d.png");
      }
      frame.outputs.push_back(path.value_or(output));
    }
  }
  return frames;
}

}  // namespace barkridge::cli
