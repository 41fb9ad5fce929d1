#pragma once
// The plants of the comparison, as L-systems whose joints all ways of dressing a skeleton can do.

#include <cstddef>
#include <string>
#include <vector>

namespace barkridge {

struct StudyModel {
  std::string name;     ///< a word, of files
  std::string meaning;  ///< what it stands for
  std::string lsystem;  ///< its text
};

/// The two models of the thesis' Table 8.1 in kind [MacM04, section 8.1], with and without the stubs of shed branches:
/// of about as many coarse triangles, 9 580 and 4 602, as his; and trees of 255, 2 047, 16 383 and 131 071 internodes,
/// as far as they do not exceed `most_internodes`.
std::vector<StudyModel> study_models(std::size_t most_internodes);

}  // namespace barkridge
