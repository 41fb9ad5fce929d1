#include "lsystem/prune.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace barkridge {

namespace {

// What stays of an internode is never nothing.
constexpr double kLeastShare = 1e-6;

Vec3 direction_of(const Internode& a) { return (a.tip - a.base) / glm::distance(a.base, a.tip); }
double length_of(const Internode& a) { return glm::distance(a.base, a.tip); }

void check(const CutRule& rule) {
  if (!(0 < rule.position && rule.position < 1)) {
    throw InputError(fmt::format("a cut's position {} is outside its range: 0 < position < 1", rule.position));
  }
  if (!(std::abs(rule.tilt_degrees) <= kSteepestCutDegrees)) {
    throw InputError(
        fmt::format("a cut's tilt of {} degrees is steeper than {}", rule.tilt_degrees, kSteepestCutDegrees));
  }
  if (!(0 <= rule.splinters && rule.splinters <= kLongestSplinters)) {
    throw InputError(fmt::format("a torn break's splinters {} are outside their range: 0 <= splinters <= {}",
                                 rule.splinters, kLongestSplinters));
  }
}

class Pruner {
 public:
  explicit Pruner(const Skeleton& skeleton) : skeleton_(skeleton) {
    const std::vector<Internode>& all = skeleton.internodes;
    share_.resize(all.size(), 1);
    cut_.resize(all.size());
    scar_.resize(all.size(), nullptr);
    next_.resize(all.size(), kNoInternode);
    first_.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      first_[i] = static_cast<InternodeId>(i);
      const InternodeId parent = all[i].parent;
      if (parent == kNoInternode) continue;
      const auto p = static_cast<std::size_t>(parent);
      if (all[p].order != all[i].order || next_[p] != kNoInternode) continue;
      next_[p] = static_cast<InternodeId>(i);
      first_[i] = first_[p];
    }
  }

  void apply(const CutRule& rule) {
    const Selector selector(skeleton_, rule.branches);
    for (std::size_t i = 0; i < first_.size(); ++i) {
      if (!selector.selects(i)) continue;
      if (!rule.branches.ids.empty()) {
        cut(i, rule.position, rule);
      } else if (begins_branch(i)) {
        cut_branch(i, rule);
      }
    }
  }

  void apply(const ScarRule& rule) {
    const Selector selector(skeleton_, rule.branches);
    for (std::size_t i = 0; i < first_.size(); ++i) {
      const bool concerned = !rule.branches.ids.empty() || begins_branch(i);
      if (concerned && skeleton_.internodes[i].parent != kNoInternode && selector.selects(i)) scar_[i] = &rule.shape;
    }
  }

  Skeleton run() {
    for (const CutEnd& end : skeleton_.cut_ends) {
      const auto i = static_cast<std::size_t>(end.internode);
      if (is_whole(i)) cut_[i] = end;
    }
    for (const Scar& scar : skeleton_.scars) scar_[static_cast<std::size_t>(scar.internode)] = &scar.shape;
    Skeleton left;
    left.dropped_internodes = skeleton_.dropped_internodes;
    std::vector<InternodeId> new_ids(first_.size(), kNoInternode);
    for (std::size_t i = 0; i < first_.size(); ++i) {
      const InternodeId parent = skeleton_.internodes[i].parent;
      if (parent != kNoInternode && is_gone_beyond(static_cast<std::size_t>(parent), new_ids)) continue;
      new_ids[i] = static_cast<InternodeId>(left.internodes.size());
      keep(i, parent == kNoInternode ? parent : new_ids[static_cast<std::size_t>(parent)], left);
    }
    for (const Organ& organ : skeleton_.organs) {
      if (organ.internode != kNoInternode && is_gone_beyond(static_cast<std::size_t>(organ.internode), new_ids))
        continue;
      left.organs.push_back(organ);
      if (organ.internode != kNoInternode) {
        left.organs.back().internode = new_ids[static_cast<std::size_t>(organ.internode)];
      }
    }
    return left;
  }

 private:
  bool begins_branch(std::size_t i) const { return first_[i] == static_cast<InternodeId>(i); }
  bool is_whole(std::size_t i) const { return cut_[i].internode == kNoInternode; }
  // Whether nothing that stood on the tip of an internode is left.
  bool is_gone_beyond(std::size_t i, const std::vector<InternodeId>& new_ids) const {
    return new_ids[i] == kNoInternode || !is_whole(i) || scar_[i];
  }

  void cut(std::size_t i, double share, const CutRule& rule) {
    if (share >= share_[i]) return;
    share_[i] = std::max(share, kLeastShare);
    const std::vector<Internode>& all = skeleton_.internodes;
    const Vec3 axis = direction_of(all[i]);
    const InternodeId carrier = all[static_cast<std::size_t>(first_[i])].parent;
    const Vec3 from = carrier == kNoInternode ? axis : direction_of(all[static_cast<std::size_t>(carrier)]);
    cut_[i] = {static_cast<InternodeId>(i), tilted_away(axis, from, rule.tilt_degrees), rule.splinters};
  }

  void cut_branch(std::size_t first, const CutRule& rule) {
    const auto next = [&](std::size_t i) { return static_cast<std::size_t>(next_[i]); };
    double total = 0;
    std::size_t last = first;
    for (std::size_t i = first;; i = next(i)) {
      total += length_of(skeleton_.internodes[last = i]);
      if (next_[i] == kNoInternode) break;
    }
    double left = rule.position * total;
    std::size_t i = first;
    for (; i != last && length_of(skeleton_.internodes[i]) <= left; i = next(i)) {
      left -= length_of(skeleton_.internodes[i]);
    }
    cut(i, std::min(left / length_of(skeleton_.internodes[i]), 1 - kLeastShare), rule);
  }

  void keep(std::size_t i, InternodeId parent, Skeleton& left) const {
    Internode internode = skeleton_.internodes[i];
    internode.parent = parent;
    internode.source = identity(skeleton_, i);
    const auto id = static_cast<InternodeId>(left.internodes.size());
    double share = share_[i];
    if (scar_[i]) {
      const double carrier_radius = left.internodes[static_cast<std::size_t>(parent)].tip_radius;
      share = std::min(1.0, stub_length(carrier_radius, internode.base_radius) / length_of(internode));
      left.scars.push_back({id, *scar_[i]});
    } else if (!is_whole(i)) {
      left.cut_ends.push_back({id, cut_[i].normal, cut_[i].splinters});
    }
    if (share < 1) {
      internode.tip = internode.base + share * (internode.tip - internode.base);
      internode.tip_radius = internode.base_radius + share * (internode.tip_radius - internode.base_radius);
    }
    left.internodes.push_back(internode);
  }

  const Skeleton& skeleton_;
  std::vector<InternodeId> next_, first_;  // by internode: its branch's next and first one
  std::vector<double> share_;              // of its length that stays
  std::vector<CutEnd> cut_;                // without an internode where it is whole
  std::vector<const ScarShape*> scar_;
};

}  // namespace

Vec3 tilted_away(const Vec3& axis, const Vec3& carrier, double degrees) {
  Vec3 away = glm::dot(carrier, axis) * axis - carrier, other;
  constexpr double kParallel = 1e-6;
  if (glm::length(away) < kParallel) complete_frame(axis, away, other);
  const double angle = degrees * std::numbers::pi / 180;
  return glm::normalize(std::cos(angle) * axis + std::sin(angle) * glm::normalize(away));
}

Skeleton with_scars_of_shed(Skeleton skeleton, double healing_steps, const ScarShape& shape) {
  check(shape);
  for (const ShedBranch& shed : skeleton.shed_branches) {
    if (shed.parent == kNoInternode || shed.age >= healing_steps) continue;
    const Internode& carrier = skeleton.internodes[static_cast<std::size_t>(shed.parent)];
    const double left = 1 - shed.age / healing_steps;
    Internode stub = carrier;
    stub.base = shed.base;
    stub.tip = shed.base + stub_length(carrier.tip_radius, shed.radius) * shed.heading;
    stub.base_radius = stub.tip_radius = shed.radius;
    stub.parent = shed.parent;
    ++stub.order;
    stub.source = kNoInternode;
    const auto id = static_cast<InternodeId>(skeleton.internodes.size());
    skeleton.scars.push_back({id, {shape.width, left * shape.depth, left * shape.stub}});
    skeleton.internodes.push_back(stub);
  }
  return skeleton;
}

double stub_length(double carrier_radius, double radius) { return carrier_radius + radius; }

Skeleton prune(Skeleton skeleton, std::span<const CutRule> cuts, std::span<const ScarRule> scars) {
  for (const CutRule& rule : cuts) check(rule);
  for (const ScarRule& rule : scars) check(rule.shape);
  if (cuts.empty() && scars.empty() && skeleton.cut_ends.empty() && skeleton.scars.empty()) return skeleton;
  Pruner pruner(skeleton);
  for (const CutRule& rule : cuts) pruner.apply(rule);
  for (const ScarRule& rule : scars) pruner.apply(rule);
  return pruner.run();
}

}  // namespace barkridge
