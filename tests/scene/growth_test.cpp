#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "scene/pipeline.h"
#include "scene/scene_hash.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;

namespace {

Scene growing_scene(const std::string& growth) {
  const ScratchFolder folder;
  return load_scene(folder.write("a.toml", R"(
[model]
lsystem_text = '''
Lsystem: 1
derivation length: 5
axiom: !(0.2)A
A --> F(1)[+(60)F(0.5)]A
endlsystem
'''
[growth]
)" + growth));
}

RenderScene look_at(const Scene& scene, double time) {
  const Scene then = at_time(scene, time);
  const Model model = make_model(then);
  return make_render_scene(then, model, *framed_field(then, compile(model.tree)));
}

double height(const Scene& scene) { return make_skeleton(scene).internodes.back().base.y; }

}  // namespace

TEST_CASE("a plant's time comes from the scene, and without one it is grown up") {
  CHECK(height(growing_scene("")) == Approx(5));
  CHECK(height(growing_scene("time = 3")) == Approx(3));
  CHECK(height(growing_scene("time = 2.5\ncurve = 'power'")) == Approx(2.5));
  CHECK(height(growing_scene("time = 77")) == Approx(5));
  CHECK(height(at_time(growing_scene("time = 3"), 2)) == Approx(2));
  CHECK(height(at_time(growing_scene("time = 3"), {})) == Approx(5));
  CHECK_THROWS_AS(at_time(growing_scene(""), 70000.0), LimitError);
}

TEST_CASE("camera and ground are the same at all times of a growing plant") {
  const Scene scene = growing_scene("tip_radius = 0.05");
  const RenderScene early = look_at(scene, 0.4), late = look_at(scene, 4.9);
  CHECK(early.camera.position == late.camera.position);
  CHECK(early.camera.target == late.camera.target);
  CHECK(early.ground.surrounded.hi == late.ground.surrounded.hi);
  const Model model = make_model(scene);
  const RenderScene grown_up = make_render_scene(scene, model, *compile(model.tree));
  CHECK(early.camera.position == grown_up.camera.position);
  const Scene framed = growing_scene("tip_radius = 0.05\nframed_time = 2");
  CHECK(look_at(framed, 1).camera.target.y < 0.6 * early.camera.target.y);
  CHECK(look_at(framed, 1).camera.target == look_at(framed, 2).camera.target);
}

TEST_CASE("cells of growing plants follow the tips that they will have, or are asked for") {
  const Scene by_pipes = at_time(growing_scene("tip_radius = 0.05"), 1.0001);
  CHECK(cell_size(by_pipes, make_model(by_pipes)) == 0.025);
  const Scene drawn = at_time(growing_scene(""), 1.5);
  CHECK_THROWS_AS(cell_size(drawn, make_model(drawn)), InputError);
}

TEST_CASE("the pipe model makes radii of skeletons from tables too") {
  const ScratchFolder folder;
  const std::string path = folder.write("a.skel",
                                        "# barkridge skeleton 1\n0 -1 0 0 0 0 1 0 9 9\n"
                                        "1 0 0 1 0 1 2 0 9 9\n2 0 0 1 0 -1 2 0 9 9\n");
  const std::vector<Override> overrides = {parse_override("growth.tip_radius=0.1"),
                                           parse_override("growth.pipe_exponent=3")};
  const Skeleton skeleton = make_skeleton(load_scene(path, overrides));
  CHECK(skeleton.internodes[0].base_radius == Approx(0.1 * std::cbrt(2.0)));
  CHECK(skeleton.internodes[2].tip_radius == Approx(0.1));
}

TEST_CASE("the time that the camera is fitted to counts in the hash of a growing plant's picture only") {
  const auto hash_of = [](const std::string& growth) {
    const Scene scene = growing_scene(growth);
    return scene_hash(scene, make_model(scene));
  };
  CHECK(hash_of("framed_time = 2") == hash_of(""));
  CHECK(hash_of("time = 2\nframed_time = 2") != hash_of("time = 2"));
}

TEST_CASE("a shed branch leaves a hollow in the bark, which closes without a jump") {
  // A lateral that the seventh step removes from a trunk of radius 1.
  const auto scene = [](const std::string& healing) {
    const ScratchFolder folder;
    return load_scene(folder.write("a.toml", R"(
[model]
lsystem_text = '''
Lsystem: 1
derivation length: 12
axiom: !(2)F(6)[!(0.8)+(90)C(0)F(3)]F(6)
C(n) : n < 5 --> C(n+1)
C(n) : n >= 5 --> %
endlsystem
'''
[growth]
elongation_steps = 0
thickening_steps = 0
)" + healing));
  };
  const auto scars_at = [&](const Scene& s, double time) { return make_model(at_time(s, time)).skeleton.scars; };
  const Scene healing = scene("healing_steps = 4");
  CHECK(scars_at(scene(""), 8).empty());
  CHECK(scars_at(healing, 4).empty());
  CHECK(scars_at(healing, 12).empty());
  double last = 1;
  int seen = 0;
  for (double time = 5; time < 12; time += 0.25) {
    const auto scars = scars_at(healing, time);
    if (scars.empty()) continue;
    REQUIRE(scars.size() == 1);
    CHECK(scars[0].shape.depth < last);
    if (seen > 0) CHECK(last - scars[0].shape.depth == Approx(0.3 * 0.25 / 4));
    last = scars[0].shape.depth;
    ++seen;
  }
  CHECK(seen >= 15);
  CHECK(last < 0.03);
}
