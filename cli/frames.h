#pragma once
// Sequences of outputs: which frames, when, and what their files are called.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace barkridge::cli {

/// Every `step`th number from `first` on, up to `last`.
struct FrameRange {
  int first = 0, last = 0, step = 1;
};

/// `A`, `A-B` or `A-B:STEP`, with A <= B <= 1000000 and STEP >= 1; nothing if the text is anything else.
std::optional<FrameRange> frame_range_of(std::string_view text);

/// The name of a frame's file: the one run of `#` in the last part of the pattern's path, or the one `%d`, `%4d` or
/// `%04d` there, replaced by the number, with zeros in front until it has as many digits. Nothing if there is not
/// exactly one such place.
std::optional<std::string> frame_path(const std::string& pattern, int frame);

/// One output of a verb, in all the files and formats that the user wants it in.
struct Frame {
  std::optional<double> time;  ///< instead of the scene's
  std::vector<std::string> outputs;
  std::string title;  ///< "frame 3 of 48: ", or nothing where there is one only
};

/// The frames to make; without a range the scene as it is. Throws `InputError` for outputs that would have one name in
/// all frames of several.
std::vector<Frame> frames_of(const std::optional<FrameRange>& range, const std::vector<std::string>& outputs,
                             const SceneSequence& sequence);

}  // namespace barkridge::cli
