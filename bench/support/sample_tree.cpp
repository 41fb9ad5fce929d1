#include "bench/support/sample_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

#include "base/random.h"

namespace barkridge::bench {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Habit of the tree: lengths against the internode before, angles, and how much axes turn upwards.
constexpr double kLeaderLength = 0.93, kLateralLength = 0.72, kLengthSpread = 0.08;
constexpr double kDivergence = 137.5 * kRadiansPerDegree, kRollSpread = 0.1;
constexpr double kBranching = 48 * kRadiansPerDegree, kBranchingSpread = 9 * kRadiansPerDegree;
constexpr double kWobble = 7 * kRadiansPerDegree;
constexpr double kTrunkRise = 0.02, kLeaderRise = 0.06, kLateralRise = 0.03;
constexpr int kBareNodes = 2;

// What the random numbers are for, and one of many trees.
enum class Purpose { kToWobble, kToRoll, kToBranch, kToStretch };
constexpr int kSeed = 1;

Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
}

// How an internode stands at its tip, for all that grows on it. `side` is a unit vector across `heading`.
struct Node {
  Vec3 heading{0, 1, 0}, side{1, 0, 0};
  double length = 0;
  int place = 0;  // nodes before it on its axis
};

// What may grow at a node: shoot 0 leads on, the others are laterals. Its place is worked out only when it grows.
struct Bud {
  double length;
  InternodeId parent;
  int shoot;

  bool operator<(const Bud& other) const {
    return length != other.length ? length < other.length : parent > other.parent;
  }
};

// From -spread to spread, decided by the place in the tree.
double jitter(Purpose purpose, const Bud& bud, double spread) {
  return spread * (2 * random_unit(kSeed, static_cast<int>(purpose), bud.parent, bud.shoot) - 1);
}

class Growth {
 public:
  explicit Growth(std::size_t internodes) : wanted_(internodes) {
    skeleton_.internodes.reserve(internodes);
    nodes_.reserve(internodes);
  }

  Skeleton grow() {
    sprout({1, kNoInternode, 0});
    while (skeleton_.internodes.size() < wanted_) {
      const Bud longest = buds_.top();
      buds_.pop();
      sprout(longest);
    }
    return std::move(skeleton_);
  }

 private:
  Vec3 heading_of(const Bud& bud, const Node& below, int order) const {
    if (bud.shoot == 0) {
      return turned(below.heading, below.side, jitter(Purpose::kToWobble, bud, kWobble)) +
             Vec3(0, order > 0 ? kLeaderRise : kTrunkRise, 0);
    }
    return turned(below.heading, hinge_of(bud, below), kBranching + jitter(Purpose::kToBranch, bud, kBranchingSpread)) +
           Vec3(0, kLateralRise, 0);
  }

  static Vec3 hinge_of(const Bud& bud, const Node& below) {
    if (bud.shoot < 2) return below.side;
    return turned(below.side, below.heading, std::numbers::pi * (1 + jitter(Purpose::kToRoll, bud, kRollSpread)));
  }

  void sprout(const Bud& bud) {
    Internode internode;
    Node node;
    node.length = bud.length;
    if (bud.parent != kNoInternode) {
      const Internode& parent = skeleton_.internodes[static_cast<std::size_t>(bud.parent)];
      const Node& below = nodes_[static_cast<std::size_t>(bud.parent)];
      internode.base = parent.tip;
      internode.parent = bud.parent;
      internode.order = parent.order + (bud.shoot > 0 ? 1 : 0);
      node.place = bud.shoot > 0 ? 0 : below.place + 1;
      node.heading = glm::normalize(heading_of(bud, below, internode.order));
      const Vec3 side = hinge_of(bud, below);
      node.side = glm::normalize(side - glm::dot(side, node.heading) * node.heading);
    }
    internode.tip = internode.base + bud.length * node.heading;
    node.side = turned(node.side, node.heading, kDivergence);
    open_buds(node, internode.order);
    skeleton_.internodes.push_back(internode);
    nodes_.push_back(node);
  }

  // On the internode that comes next.
  void open_buds(const Node& node, int order) {
    const InternodeId id = static_cast<InternodeId>(skeleton_.internodes.size());
    buds_.push({kLeaderLength * node.length, id, 0});
    if (order == 0 && node.place < kBareNodes) return;
    const int laterals = order > 0 && node.place % 2 == 1 ? 1 : 2;
    for (int shoot = 1; shoot <= laterals; ++shoot) {
      Bud bud{kLateralLength * node.length, id, shoot};
      bud.length *= 1 + jitter(Purpose::kToStretch, bud, kLengthSpread);
      buds_.push(bud);
    }
  }

  std::size_t wanted_;
  Skeleton skeleton_;
  std::vector<Node> nodes_;
  std::priority_queue<Bud> buds_;
};

std::vector<std::size_t> tips_carried(const Skeleton& skeleton) {
  const std::vector<Internode>& internodes = skeleton.internodes;
  std::vector<std::size_t> tips(internodes.size(), 0);
  for (std::size_t i = internodes.size(); i-- > 0;) {
    if (tips[i] == 0) tips[i] = 1;  // nothing grew on it
    if (internodes[i].parent != kNoInternode) tips[static_cast<std::size_t>(internodes[i].parent)] += tips[i];
  }
  return tips;
}

// All twigs are equally thin, so the rule says r = r_trunk (tips / all tips)^(1/e).
double set_radii(Skeleton& skeleton, const std::vector<std::size_t>& tips, const SampleTreeOptions& options) {
  const double all = static_cast<double>(tips.front());
  const double exponent = options.exponent > 0 ? options.exponent : std::log(all) / std::log(options.thinness);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    Internode& a = skeleton.internodes[i];
    a.base_radius = options.trunk_radius;
    if (all > 1) a.base_radius *= std::pow(static_cast<double>(tips[i]) / all, 1 / exponent);
    a.tip_radius = 0;
    if (a.parent == kNoInternode) continue;
    Internode& parent = skeleton.internodes[static_cast<std::size_t>(a.parent)];
    parent.tip_radius = std::max(parent.tip_radius, a.base_radius);
  }
  for (Internode& a : skeleton.internodes) {
    if (!(a.tip_radius > 0)) a.tip_radius = a.base_radius;
  }
  return exponent;
}

}  // namespace

SampleTree sample_tree(const SampleTreeOptions& options) {
  SampleTree tree;
  tree.skeleton = Growth(std::max<std::size_t>(options.internodes, 1)).grow();
  const Box box = bounding_box(tree.skeleton);
  const double scale = 1 / std::max({box.hi.y, box.hi.x - box.lo.x, box.hi.z - box.lo.z});
  for (Internode& a : tree.skeleton.internodes) {
    a.base *= scale;
    a.tip *= scale;
  }
  const std::vector<std::size_t> tips = tips_carried(tree.skeleton);
  tree.tips = tips.front();
  tree.exponent = set_radii(tree.skeleton, tips, options);
  tree.thinnest_radius = options.trunk_radius;
  for (const Internode& a : tree.skeleton.internodes) {
    tree.thinnest_radius = std::min(tree.thinnest_radius, a.base_radius);
  }
  return tree;
}

double median_length(const Skeleton& skeleton) {
  std::vector<double> lengths;
  lengths.reserve(skeleton.internodes.size());
  for (const Internode& a : skeleton.internodes) lengths.push_back(glm::distance(a.base, a.tip));
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

Box bounding_box(const Skeleton& skeleton) {
  Box box;
  for (const Internode& a : skeleton.internodes) box = unite(unite(box, a.base), a.tip);
  return box;
}

}  // namespace barkridge::bench
