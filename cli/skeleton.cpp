#include "cli/progress_bar.h"
#include "cli/results.h"
#include "cli/verbs.h"
#include "cli/warning.h"
#include "scene/pipeline.h"

namespace barkridge::cli {

void run(const SkeletonArguments& arguments) {
  const Scene scene = load_scene(arguments.path, arguments.overrides);
  std::string text;
  {
    ProgressBar bar(arguments.quiet);
    text = write_skeleton_table(make_skeleton(scene, {bar.stage("growing"), warn}));
  }
  write_results(text);
}

}  // namespace barkridge::cli
