#include "base/error.h"
#include "cli/progress_bar.h"
#include "cli/results.h"
#include "cli/verbs.h"
#include "cli/warning.h"
#include "scene/pipeline.h"

namespace barkridge::cli {

void run(const GrowArguments& arguments) {
  const Scene scene = load_scene(arguments.path, arguments.overrides);
  if (!has_lsystem(scene)) {
    throw InputError({arguments.path, 0, 0, ""}, "expected an L-system to grow; this model is none");
  }
  std::string text;
  {
    ProgressBar bar(arguments.quiet);
    text = to_string(grow(scene, {bar.stage("growing"), warn}).word);
  }
  if (text.empty() || text.back() != '\n') text += '\n';
  write_results(text);
}

}  // namespace barkridge::cli
