#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/scene.h"
#include "tests/support/scratch_folder.h"

using namespace barkridge;
using namespace barkridge::test;
using Catch::Matchers::Contains;

namespace {

const std::string kModel = "model.tree = \"cone()\"\n";

Scene load_text(const std::string& text, const std::vector<std::string>& definitions = {}) {
  const ScratchFolder folder;
  std::vector<Override> overrides;
  for (const std::string& definition : definitions) overrides.push_back(parse_override(definition));
  return load_scene(folder.write("a.toml", text), overrides);
}

// The error that loading ends in; its file is called a.toml.
InputError error_of(const std::string& text, const std::vector<std::string>& definitions = {}) {
  try {
    load_text(text, definitions);
  } catch (const InputError& error) {
    return error;
  }
  FAIL("no error for\n" + text);
  return InputError("");
}

}  // namespace

TEST_CASE("a scene's values arrive where they belong") {
  const Scene scene = load_text(R"toml(version = 1
[model]
tree = "cone()"
[lsystem]
steps = 7
seed = -3
max_modules = 1000
[lsystem.defines]
N = 5
ANGLE = 22.5
NAME = "x"
[turtle]
angle_increment_degrees = 30
tapered_lines = false
[junction]
kind = "smooth"
joint = "paper"
width = 0.4
swelling = 0.1
[bend]
angle_degrees = 20
[mesh]
cell_size = 0.25
[camera]
projection = "orthographic"
position = [1, 2.5, -3]
up = [0, 0, 1]
height = 4
[sun]
direction = [0, 1, 0]
intensity = 3
[sky]
zenith = [0, 0, 1]
intensity = 0.5
[ground]
enabled = false
color = [1, 0, 0]
[material]
roughness = 0.25
[image]
width = 640
height = 480
samples_per_pixel = 4
seed = 11
)toml");
  CHECK(scene.model.kind == ModelSource::Kind::kTree);
  CHECK(scene.derivation.steps == 7);
  CHECK(scene.derivation.seed == -3);
  CHECK(scene.derivation.max_modules == 1000);
  CHECK(scene.defines == std::map<std::string, std::string>{{"N", "5"}, {"ANGLE", "22.5"}, {"NAME", "x"}});
  CHECK(scene.turtle.angle_increment_degrees == 30);
  CHECK_FALSE(scene.turtle.tapered_lines);
  CHECK(scene.tree.junction == JunctionKind::kSmooth);
  CHECK(scene.tree.joint == JointKind::kPaper);
  CHECK(scene.tree.contact == ContactShape{0.4, 0.1, false});
  CHECK(scene.tree.bend_angle_degrees == 20);
  CHECK(scene.cell_size == 0.25);
  CHECK(scene.camera.projection == Camera::Projection::kOrthographic);
  CHECK(scene.camera.position == Vec3(1, 2.5, -3));
  CHECK_FALSE(scene.camera.target);
  CHECK(scene.camera.up == Vec3(0, 0, 1));
  CHECK(scene.camera.height == 4.0);
  CHECK(scene.sun.direction == Vec3(0, 1, 0));
  CHECK(scene.sun.intensity == 3);
  CHECK(scene.sky.zenith == Vec3(0, 0, 1));
  CHECK(scene.sky.intensity == 0.5);
  CHECK_FALSE(scene.ground.enabled);
  CHECK(scene.ground.color == Vec3(1, 0, 0));
  CHECK(scene.material.roughness == 0.25);
  CHECK(scene.image.width == 640);
  CHECK(scene.image.height == 480);
  CHECK(scene.image.samples_per_pixel == 4);
  CHECK(scene.image.seed == 11);
}

TEST_CASE("overrides replace what the scene says, and the last of them wins") {
  const Scene scene = load_text(kModel + "sky.intensity = 2\nimage.width = 100\n",
                                {"sky.intensity=3", "junction.kind=smooth", "camera.position=[1,2,3]",
                                 "lsystem.defines.N=5", "ground.enabled = false", "sky.intensity = 4"});
  CHECK(scene.sky.intensity == 4);
  CHECK(scene.image.width == 100);
  CHECK(scene.tree.junction == JunctionKind::kSmooth);
  CHECK(scene.camera.position == Vec3(1, 2, 3));
  CHECK(scene.defines.at("N") == "5");
  CHECK_FALSE(scene.ground.enabled);
}

TEST_CASE("arrays of tables become lists of rules in their order") {
  const Scene scene = load_text(kModel + R"toml([[cut]]
position = 0.25
ids = [3, 7]
[[scar]]
[[cut]]
tilt_degrees = -20
order = 2
radius = [0.5, inf]
[bend]
angle_degrees = 10
rule = [{angle_degrees = 20, order = [1, 3]}, {fraction = 0.5, seed = 4}]
[[tip]]
kind = "bud"
)toml");
  REQUIRE(scene.cuts.size() == 2);
  CHECK(scene.cuts[0].position == 0.25);
  CHECK(scene.cuts[0].tilt_degrees == 0);
  CHECK(scene.cuts[0].branches.ids == std::vector<InternodeId>{3, 7});
  CHECK(scene.cuts[1].position == CutRule{}.position);
  CHECK(scene.cuts[1].tilt_degrees == -20);
  CHECK(scene.cuts[1].branches.order.from == 2);
  CHECK(scene.cuts[1].branches.order.to == 2);
  CHECK(scene.cuts[1].branches.radius.contains(1e9));
  CHECK(scene.scars.size() == 1);
  CHECK(scene.tree.bend_angle_degrees == 10);
  REQUIRE(scene.tree.bends.size() == 2);
  CHECK(scene.tree.bends[0].angle_degrees == 20);
  CHECK(scene.tree.bends[0].internodes.order.to == 3);
  CHECK(scene.tree.bends[1].internodes.seed == 4);
  REQUIRE(scene.tree.tips.size() == 1);
  CHECK(scene.tree.tips[0].kind == TipKind::kBud);
}

TEST_CASE("an override replaces a list, or a key in all of its rules") {
  const std::string text = kModel + "[[cut]]\nposition = 0.2\n[[cut]]\nposition = 0.3\ntilt_degrees = 9\n";
  const Scene replaced = load_text(text, {"cut=[{position = 0.7}]"});
  REQUIRE(replaced.cuts.size() == 1);
  CHECK(replaced.cuts[0].position == 0.7);
  CHECK(replaced.cuts[0].tilt_degrees == 0);
  CHECK(load_text(text, {"cut=[]"}).cuts.empty());
  const Scene changed = load_text(text, {"cut[].position=0.6"});
  REQUIRE(changed.cuts.size() == 2);
  CHECK(changed.cuts[0].position == 0.6);
  CHECK(changed.cuts[1].position == 0.6);
  CHECK(changed.cuts[1].tilt_degrees == 9);
  CHECK(load_text(kModel, {"scar[].width=2"}).scars.at(0).shape.width == 2);
}

TEST_CASE("mistakes in lists have their places") {
  const InputError unknown = error_of(kModel + "[[cut]]\nposition = 0.2\n[[cut]]\n  positon = 0.3\n");
  CHECK(unknown.message() == "unknown key cut[].positon; did you mean cut[].position?");
  CHECK(unknown.where().line == 5);
  const InputError range = error_of(kModel + "[[cut]]\n[[cut]]\nposition = 2\n");
  CHECK(range.message() == "cut[].position: expected a number above 0 and below 1, not 2");
  CHECK(range.where().line == 4);
  CHECK_THAT(error_of(kModel + "cut = 5\n").message(), Contains("cut: expected an array of tables, not 5"));
  CHECK_THAT(error_of(kModel + "[cut]\nposition = 0.5\n").message(), Contains("unknown key cut.position"));
  CHECK_THAT(error_of(kModel + "[[camera]]\n").message(), Contains("not an array of tables"));
  CHECK_THAT(error_of(kModel + "[[cut]]\norder = [3, 1]\n").message(), Contains("first and last of a range"));
  CHECK_THAT(error_of(kModel, {"cut=[{positon = 1}]"}).what(), Contains("-D cut=[{positon = 1}]"));
}

TEST_CASE("an override takes the place of what cannot stand beside it") {
  const Scene scene = load_text(kModel + "[sun]\nazimuth_degrees = 10\n[camera]\nposition = [1, 2, 3]\n",
                                {"sun.direction=[0,1,0]", "camera.zoom=2", "model.tree=disc()"});
  CHECK(scene.sun.direction == Vec3(0, 1, 0));
  CHECK_FALSE(scene.camera.position);
  CHECK(scene.camera.zoom == 2);
  CHECK(scene.model.text == "disc()");
}

TEST_CASE("the swelling is a quarter of the width unless it is given") {
  CHECK(load_text(kModel + "junction.width = 0.4\n").tree.contact.swelling == Approx(0.1));
  CHECK(load_text(kModel + "junction.width = 0.4\njunction.swelling = 0.07\n").tree.contact.swelling == 0.07);
}

TEST_CASE("models of every kind are files with the default look") {
  const ScratchFolder folder;
  using Kind = ModelSource::Kind;
  const std::vector<std::pair<std::string, Kind>> files = {{"a.l", Kind::kLsystem},
                                                           {"a.str", Kind::kString},
                                                           {"a.lstring", Kind::kString},
                                                           {"a.skel", Kind::kSkeleton},
                                                           {"a.lst", Kind::kLst}};
  for (const auto& [name, kind] : files) {
    const std::string path = folder.write(name, "content of " + name);
    const Scene scene = load_scene(path);
    CHECK(scene.model.kind == kind);
    CHECK(scene.model.text == "content of " + name);
    CHECK(scene.model.file == path);
    CHECK(scene.image.width == RenderOptions{}.width);
  }
  CHECK_THROWS_WITH(load_scene(folder.write("a.obj", "")),
                    Contains(".toml") && Contains(".lstring") && Contains(".skel"));
}

TEST_CASE("a model's path is relative to its scene") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("parts"));
  folder.write("parts/a.skel", "table");
  const Scene scene = load_scene(folder.write("parts/a.toml", "model.skeleton = 'a.skel'"));
  CHECK(scene.model.text == "table");
  const InputError error = [&] {
    try {
      load_scene(folder.write("b.toml", "\nmodel.skeleton = 'a.skel'"));
    } catch (const InputError& e) {
      return e;
    }
    return InputError("");
  }();
  CHECK(error.where().line == 2);
  CHECK(error.where().column == 18);
  CHECK_THAT(error.message(), Contains("a.skel") && Contains("No such file"));
}

TEST_CASE("a text in a scene keeps its lines and columns") {
  CHECK(load_text("\n[model]\ntree = '''\ncone()\n'''\n").model.text == "\n\n\ncone()\n");
  CHECK(load_text("\n[model]\ntree = '''\r\ncone()\n'''\n").model.text == "\n\n\ncone()\n");
  CHECK(load_text("[model]\ntree = '''cone()\n'''\n").model.text == "\n          cone()\n");
  CHECK(load_text("[model]\ntree = \"cone()\"\n").model.text == "\n        cone()");
}

TEST_CASE("a scene needs exactly one model") {
  CHECK_THAT(error_of("").what(),
             Contains("a.toml: there is no model") && Contains("model.lsystem") && Contains("model.tree"));
  const InputError both = error_of("[model]\ntree = 'cone()'\nstring = 'a.str'\n");
  CHECK(both.message() == "model.string cannot be given together with model.tree");
  CHECK(both.where().line == 3);
}

TEST_CASE("directions and angles of the sun, and places and angles of the camera, exclude each other") {
  CHECK_THAT(error_of(kModel + "sun.direction = [0, 1, 0]\nsun.elevation_degrees = 3\n").what(),
             Contains(":3:5: sun.elevation_degrees cannot be given together with sun.direction"));
  CHECK_THAT(error_of(kModel, {"camera.zoom=2", "camera.position=[0,1,2]"}).what(),
             Contains("-D camera.position=[0,1,2]: camera.position cannot be given together with camera.zoom"));
}

TEST_CASE("an unknown key has its place and a suggestion") {
  const InputError error = error_of(kModel + "[sun]\n  intensty = 2\n");
  CHECK(error.message() == "unknown key sun.intensty; did you mean sun.intensity?");
  CHECK(error.where().line == 3);
  CHECK(error.where().column == 3);
  CHECK_THAT(error.what(), Contains("a.toml:3:3: ") && Contains("\n    intensty = 2\n    ^"));
  CHECK(error_of(kModel + "cell_size = 2\n").message() == "unknown key cell_size; did you mean mesh.cell_size?");
  CHECK(error_of(kModel + "zzzzzzzzzzzzzzzzzzzzzzzz = 2\n").message() == "unknown key zzzzzzzzzzzzzzzzzzzzzzzz");
  CHECK_THAT(error_of(kModel + "[leaves]\n").what(), Contains("unknown key leaves"));
  CHECK_THAT(error_of(kModel + "\"sun.intensity\" = 2\n").what(), Contains("unknown key \"sun.intensity\""));
}

TEST_CASE("a value of the wrong kind says what was expected") {
  const auto message = [](const std::string& line) { return error_of(kModel + line + '\n').message(); };
  CHECK(message("sky.intensity = 'bright'") ==
        "sky.intensity: expected a finite number of at least 0, not the text \"bright\"");
  CHECK(message("image.width = 640.0") == "image.width: expected an integer from 1 to 65536, not 640.0");
  CHECK(message("ground.enabled = 1") == "ground.enabled: expected true or false, not 1");
  CHECK(message("junction.kind = 'rigde'") ==
        "junction.kind: expected \"ridge\" or \"smooth\", not the text \"rigde\"");
  CHECK(message("camera.position = [1, 2]") ==
        "camera.position: expected three finite numbers, like [0, 1, 0], not [1, 2]");
  CHECK(message("camera.position = [1, 'a', 2]") ==
        "camera.position: expected three finite numbers, like [0, 1, 0], not an array of other things than numbers");
  CHECK_THAT(message("sun = 5"), Contains("sun: expected a table with keys like sun.direction, not 5"));
  CHECK_THAT(message("sun.intensity = {a = 1}"), Contains("unknown key sun.intensity.a"));
  CHECK_THAT(message("sun.intensity = {}"), Contains("sun.intensity: expected") && Contains("not a table"));
  CHECK_THAT(message("bend.angle_degrees = 1979-05-27"), Contains("not a date or time"));
}

TEST_CASE("a number out of range says the range") {
  const auto message = [](const std::string& line) { return error_of(kModel + line + '\n').message(); };
  CHECK(message("mesh.cell_size = 0") == "mesh.cell_size: expected a finite number above 0, not 0");
  CHECK(message("bend.angle_degrees = 180") ==
        "bend.angle_degrees: expected a number of at least 0 and below 180, not 180");
  CHECK(message("material.roughness = 0") == "material.roughness: expected a number above 0 and up to 1, not 0");
  CHECK(message("material.specular = 1.5") == "material.specular: expected a number from 0 to 1, not 1.5");
  CHECK(message("image.samples_per_pixel = 0") ==
        "image.samples_per_pixel: expected an integer from 1 to 65536, not 0");
  CHECK(message("camera.up = [0, 0, 0]") ==
        "camera.up: expected three finite numbers that are not all 0, like [0, 1, 0], not [0, 0, 0]");
  CHECK(message("version = 2") == "version: expected 1, not 2");
}

TEST_CASE("numbers that are not finite are refused everywhere") {
  for (const char* line :
       {"sky.intensity = nan", "sky.intensity = inf", "camera.position = [0, nan, 0]", "sun.direction = [inf, 0, 0]",
        "turtle.step = -inf", "lsystem.defines.N = nan", "material.color = [0.5, 0.5, nan]"}) {
    const InputError error = error_of(kModel + line + '\n');
    CAPTURE(line);
    CHECK_THAT(error.message(), Contains("expected") && Contains("finite") || Contains("number"));
    CHECK(error.where().line == 2);
    CHECK(error.where().column > 1);
  }
}

TEST_CASE("ridge rules keep their order and get what they leave to the scene") {
  const std::string text = kModel + R"toml([junction]
width = 0.4
[[ridge]]
order = [0, 1]
swelling = 0.08
[[ridge]]
angle_degrees = [60, 180]
radius_ratio = [0.5, 1]
width = 0.2
)toml";
  const Scene scene = load_text(text);
  REQUIRE(scene.tree.ridge_rules.size() == 2);
  const RidgeRule& first = scene.tree.ridge_rules[0];
  const RidgeRule& second = scene.tree.ridge_rules[1];
  CHECK(first.contact == ContactShape{0.4, 0.08, false});
  CHECK(first.orders.to == 1);
  CHECK(second.contact == ContactShape{0.2, 0.05, false});
  CHECK(second.fits({7, 90, 0.6}));
  CHECK_FALSE(second.fits({7, 50, 0.6}));
  CHECK_FALSE(second.fits({7, 90, 0.4}));
  CHECK(load_text(text, {"ridge[].width=0.3"}).tree.ridge_rules[1].contact == ContactShape{0.3, 0.075, false});
  CHECK(load_text(kModel, {"ridge[].width=0.3"}).tree.ridge_rules.size() == 1);
}

TEST_CASE("a mistake in a ridge rule is reported where it is written") {
  const InputError error = error_of(kModel + "[[ridge]]\n[[ridge]]\nwidth = 0.3\nswelling = 0.2\n");
  CHECK(error.where().line == 5);
  CHECK_THAT(error_of(kModel + "[[ridge]]\norder = [2, 1]\n").what(),
             Contains("ridge[].order: expected a number of at least 0, or two"));
  CHECK_THAT(error_of(kModel + "[[ridge]]\nangle = 3\n").what(), Contains("unknown key ridge[].angle"));
  CHECK_THAT(error_of(kModel + "[ridge]\nwidth = 0.3\n").what(), Contains("unknown key ridge.width; did you mean ridge[].width?"));
}

TEST_CASE("a swelling outside its range is reported where it is written") {
  const InputError error = error_of(kModel + "[junction]\nswelling = 0.3\n");
  CHECK(error.where().line == 3);
  CHECK(load_text(kModel + "[junction]\nswelling = 0.3\nallow_large_swelling = true\n").tree.contact.swelling == 0.3);
  CHECK_THAT(error_of(kModel, {"junction.swelling=0.01"}).what(), Contains("-D junction.swelling=0.01: "));
}

TEST_CASE("errors in overrides name the override") {
  CHECK_THAT(error_of(kModel, {"sky.intensity=-1"}).what(),
             Contains("-D sky.intensity=-1: sky.intensity: expected a finite number of at least 0, not -1"));
  CHECK_THAT(error_of(kModel, {"sky.intesity=1"}).what(),
             Contains("-D sky.intesity=1: unknown key sky.intesity; did you mean sky.intensity?"));
  CHECK_THAT(error_of(kModel, {"camera.position=[1,2"}).what(), Contains("not the text \"[1,2\""));
  CHECK_THROWS_WITH(parse_override("sky.intensity"), Contains("-D sky.intensity: expected key=value"));
  CHECK_THROWS_WITH(parse_override("=3"), Contains("expected key=value"));
}

TEST_CASE("what is not TOML has a place, counted in characters and not in bytes") {
  const InputError error = error_of("# \xC3\xA4\n[model]\ntree = 'cone()'\n[sun\nintensity = 1\n");
  CHECK(error.where().line == 4);
  const InputError behind_umlaut = error_of(kModel + "junction = {kind = \"\xC3\xA4\xC3\xB6\", width = 7}\n");
  CHECK(behind_umlaut.where().line == 2);
  CHECK_THAT(behind_umlaut.what(), Contains("not the text \"\xC3\xA4\xC3\xB6\""));
  const InputError after = error_of(kModel + "junction = {joint = 'faded', kind = \"ridge\", width = 7} # \xC3\xA4\n");
  CHECK(after.where().column == 54);
  CHECK_THROWS_AS(load_text("model.tree = \"\xFF\"\n"), InputError);
  CHECK_THROWS_AS(load_text(kModel + "sky.intensity = 1\nsky.intensity = 2\n"), InputError);
}

TEST_CASE("a missing or unreadable scene is bad input") {
  const ScratchFolder folder;
  CHECK_THROWS_AS(load_scene(folder.path("none.toml")), InputError);
  CHECK_THROWS_WITH(load_scene(folder.path("none.skel")), Contains("none.skel") && Contains("No such file"));
  std::filesystem::create_directory(folder.path("folder.toml"));
  CHECK_THROWS_AS(load_scene(folder.path("folder.toml")), InputError);
}

TEST_CASE("keys and tables nested without end do not overflow the stack") {
  std::string dots = "a";
  for (int i = 0; i < 200000; ++i) dots += ".a";
  CHECK_THAT(error_of(dots + " = 1\n").message(), Contains("parts"));
  CHECK_THROWS_AS(load_text('[' + dots + "]\n"), InputError);
  CHECK_THROWS_AS(load_text("x = " + std::string(100000, '[') + '\n'), InputError);
  std::string tables = "x = ";
  for (int i = 0; i < 100000; ++i) tables += "{a=";
  CHECK_THROWS_AS(load_text(tables + '\n'), InputError);
  CHECK_THROWS_AS(load_text(kModel + "[\"a\" . \"b\" . 'c']\nd = 1\n"), InputError);
}

TEST_CASE("a picture has at most 2^31 pixels") {
  CHECK_THROWS_AS(load_text(kModel + "image = {width = 65536, height = 65536}\n"), LimitError);
  CHECK_NOTHROW(load_text(kModel + "image = {width = 65536, height = 32768}\n"));
}

TEST_CASE("the camera cannot stand where it looks") {
  CHECK_THAT(error_of(kModel + "[camera]\nposition = [1, 2, 3]\ntarget = [1, 2, 3]\n").what(),
             Contains("a.toml:4:10: camera.target"));
}

TEST_CASE("a bark's image is found from the scene's folder, and from the working directory in an override") {
  const ScratchFolder folder;
  folder.write("bark.png", "not looked into");
  folder.write("a.toml", "model.tree = 'cone()'\n[bark]\nkind = \"image\"\nimage = \"bark.png\"\n");
  CHECK(load_scene(folder.path("a.toml")).bark.image == folder.path("bark.png"));
  const std::vector<Override> overrides = {parse_override("bark.image=" + folder.path("bark.png"))};
  CHECK(load_scene(folder.path("a.toml"), overrides).bark.image == folder.path("bark.png"));

  folder.write("b.toml", "model.tree = 'cone()'\n[bark]\nkind = \"image\"\nimage = \"none.png\"\n");
  CHECK_THROWS_WITH(load_scene(folder.path("b.toml")), Contains("b.toml:4:") && Contains("none.png"));
  folder.write("c.toml", "model.tree = 'cone()'\n[bark]\nkind = \"image\"\n");
  CHECK_THROWS_WITH(load_scene(folder.path("c.toml")), Contains("c.toml:3:") && Contains("bark.image"));
}
