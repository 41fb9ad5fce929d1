#include "lsystem/source_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace barkridge {

SourceText::FileId SourceText::add_file(std::string name, std::string text) {
  files_.push_back({std::move(name), std::move(text), {}});
  return static_cast<FileId>(files_.size() - 1);
}

void SourceText::mark_line(FileId file, std::size_t offset, int line, std::string name) {
  files_[file].markers.push_back({offset, line, std::move(name)});
}

void SourceText::append(char byte, FileId file, std::size_t offset) {
  const bool continues = !runs_.empty() && !runs_.back().expansion && runs_.back().file == file &&
                         runs_.back().offset + (text_.size() - runs_.back().begin) == offset;
  if (!continues) runs_.push_back({text_.size(), offset, file, false});
  text_ += byte;
}

void SourceText::append_expansion(std::string_view text, FileId file, std::size_t offset) {
  const bool continues =
      !runs_.empty() && runs_.back().expansion && runs_.back().file == file && runs_.back().offset == offset;
  if (!continues) runs_.push_back({text_.size(), offset, file, true});
  text_ += text;
}

SourceLocation SourceText::place(std::size_t offset) const {
  if (runs_.empty()) return files_.empty() ? SourceLocation{} : place_in_file(0, 0);
  offset = std::min(offset, text_.size() - 1);
  const auto after = std::upper_bound(runs_.begin(), runs_.end(), offset,
                                      [](std::size_t value, const Run& run) { return value < run.begin; });
  const Run& run = *(after == runs_.begin() ? after : after - 1);
  return place_in_file(run.file, run.expansion ? run.offset : run.offset + (offset - run.begin));
}

SourceLocation SourceText::place_in_file(FileId file, std::size_t offset) const {
  const File& source = files_[file];
  SourceLocation place = locate(source.text, offset, source.name);
  const auto after =
      std::upper_bound(source.markers.begin(), source.markers.end(), offset,
                       [](std::size_t value, const LineMarker& marker) { return value < marker.offset; });
  if (after != source.markers.begin()) {
    const LineMarker& marker = *(after - 1);
    place.line += marker.line - locate(source.text, marker.offset, source.name).line;
    place.file = marker.name;
  }
  return place;
}

std::string message_at(const SourceLocation& place, const std::string& message) {
  return fmt::format("{}:{}:{}: {}", place.file, place.line, place.column, message);
}

}  // namespace barkridge
