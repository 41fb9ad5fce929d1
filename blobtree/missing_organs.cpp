#include "blobtree/missing_organs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "base/random.h"
#include "blobtree/falloff.h"
#include "blobtree/neighbours.h"
#include "blobtree/primitive.h"

namespace barkridge {

namespace {

using Ids = std::vector<std::uint32_t>;

double value_at(const Field& field, const Vec3& p) {
  double value = 0;
  field.values({&p, 1}, {&value, 1});
  return value;
}

Vec3 end_axis(const Plant& plant, std::size_t i) { return end_tangent(plant.internode(i), plant.arc(i)); }

// ---- Cut ends.

// Splinters of a torn break: cones that rise from below the cut, higher towards one side.
std::vector<Cone> splinters(const Plant& plant, const CutEnd& end) {
  if (!(end.splinters > 0)) return {};
  const auto i = static_cast<std::size_t>(end.internode);
  const double radius = plant.internode(i).tip_radius;
  const Vec3 axis = end_axis(plant, i);
  const auto key = static_cast<std::uint64_t>(identity(plant.skeleton(), i));
  Vec3 x, y;
  complete_frame(axis, x, y);
  constexpr int kCount = 16;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0)), high_side = 2 * std::numbers::pi * random_unit(key, 0);
  std::vector<Cone> cones;
  for (int k = 0; k < kCount; ++k) {
    const auto random = [&](int what) { return random_unit(key, k + 1, what); };
    const double out = std::sqrt((k + 0.5) / kCount), turn = golden * k + 0.6 * random(0);
    const Vec3 side = std::cos(turn) * x + std::sin(turn) * y;
    const double slope = 0.5 * (1 + out * std::cos(turn - high_side));  // 0 on the low side, 1 on the high one
    const double height = end.splinters * radius * (0.15 + 0.85 * slope * slope) * (0.4 + 0.6 * random(1));
    const double drift = 0.08 * height * (random(2) - 0.5);
    const double rise = -glm::dot(side, end.normal) / glm::dot(axis, end.normal);  // of the cut, there
    const Vec3 foot = plant.internode(i).tip + 0.9 * out * radius * (side + rise * axis);
    cones.push_back({foot - 0.7 * radius * axis, foot + height * axis + drift * x, (0.32 + 0.24 * random(3)) * radius,
                     0.06 * radius});
  }
  return cones;
}

class Carver {
 public:
  Carver(const Plant& plant, BlobTree& tree) : plant_(plant), tree_(tree), neighbours_(plant) {}

  Carvings run() {
    for (const Scar& scar : plant_.skeleton().scars) carve(scar);
    for (const CutEnd& end : plant_.skeleton().cut_ends) carve(end);
    std::stable_sort(carvings_.nodes.begin(), carvings_.nodes.end(), [](const Carving& a, const Carving& b) {
      return a.internode != b.internode ? a.internode > b.internode : a.kind < b.kind;
    });
    return std::move(carvings_);
  }

 private:
  // Beyond the cut nothing is left but splinters and what would be there without the branch: so the face is plane to
  // its edge, wherever it is, and the bark around is whole.
  void carve(const CutEnd& end) {
    const Disc disc = cutter(plant_, end);
    Ids near = neighbours_.near(grown(Box{disc.center, disc.center}, disc.disc_radius + disc.radius));
    std::erase(near, static_cast<std::uint32_t>(end.internode));
    const InternodeId level = level_of(end, near);
    touch(static_cast<std::uint32_t>(end.internode), level);
    for (const std::uint32_t other : near) touch(other, level);
    std::vector<NodeId> parts{tree_.add(disc)};
    if (const auto rest = neighbours_.add_field_of(near, tree_)) parts.push_back(*rest);
    for (const Cone& cone : splinters(plant_, end)) parts.push_back(tree_.add(cone));
    const NodeId node = parts.size() > 1 ? tree_.add(Difference{}, std::move(parts)) : parts[0];
    carvings_.nodes.push_back({level, Carving::Kind::kSubtracted, node});
  }

  // An internode that is near what is carved at some level, and those on its way there.
  void touch(std::uint32_t near, InternodeId level) {
    carvings_.touched.push_back(near);
    std::vector<std::uint32_t> way;
    InternodeId at = static_cast<InternodeId>(near);
    for (; at > level; at = plant_.internode(static_cast<std::size_t>(at)).parent) {
      way.push_back(static_cast<std::uint32_t>(at));
    }
    if (at != level) return;
    way.push_back(static_cast<std::uint32_t>(level));
    carvings_.touched.insert(carvings_.touched.end(), way.begin(), way.end());
  }

  // The lowest internode whose subtree has all of the near ones that are not too far down the tree to be joined with
  // the branch before.
  InternodeId level_of(const CutEnd& end, const Ids& near) const {
    InternodeId level = end.internode;
    for (const std::uint32_t other : near) {
      constexpr int kMostSteps = 256;
      InternodeId a = end.internode, b = static_cast<InternodeId>(other);
      for (int step = 0; a != b && a != kNoInternode && b != kNoInternode && step < kMostSteps; ++step) {
        InternodeId& later = a < b ? b : a;
        later = plant_.internode(static_cast<std::size_t>(later)).parent;
      }
      if (a == b && a != kNoInternode) level = std::min(level, a);
    }
    return level;
  }

  // A ball ends where the stub is to end, whatever the bark's own field is there; discs take away what is above the
  // hollow's floor.
  void carve(const Scar& scar) {
    const auto i = static_cast<std::size_t>(scar.internode);
    const Internode& a = plant_.internode(i);
    const Vec3 axis = (a.tip - a.base) / glm::distance(a.base, a.tip);
    const double farthest = 4 * (carrier_radius(a) + a.base_radius);
    const Ids near = neighbours_.near(grown(unite(Box{a.base, a.base}, a.base + farthest * axis), 2 * a.base_radius));
    BlobTree around;
    if (!neighbours_.add_field_of(near, around)) return;
    const auto bark = reference_field(around);
    const std::optional<Place> place = bark_exit(*bark, a.base, axis, 0.25 * a.base_radius, farthest);
    if (!place) return;

    const double radius = a.base_radius, top = scar.shape.stub * radius;
    const double missing = std::clamp(kIsoValue - value_at(*bark, place->at(top)), 0.0, kIsoValue);
    const Vec3 center = place->at(top - 2 * radius * falloff_distance(missing));
    const Cone stub{center, center, radius, radius};
    carvings_.nodes.push_back({a.parent, Carving::Kind::kAdded, tree_.add(stub)});
    touch(static_cast<std::uint32_t>(a.parent), a.parent);
    for (const std::uint32_t other : near) touch(other, a.parent);

    const auto filled = [&](const Vec3& p) { return value_at(*bark, p) + sample(stub, p).value; };
    const double width = std::min(scar.shape.width * radius, carrier_radius(a));
    double depth = std::min({scar.shape.depth * radius, 0.5 * width, 0.5 * (carrier_radius(a) + top)});
    for (int shallower = 0; shallower < kMostAttempts && depth > 0; ++shallower, depth *= 0.7) {
      const std::vector<Disc> hollow = hollow_of(*place, top, depth, width, carrier_radius(a), filled);
      if (!keeps_axes(near, hollow, filled)) continue;
      for (const Disc& disc : hollow) carvings_.nodes.push_back({a.parent, Carving::Kind::kNegative, tree_.add(disc)});
      return;
    }
  }

  static constexpr int kMostAttempts = 12;

  // A place on the bark, and the height over it along its normal.
  struct Place {
    Vec3 point, normal;
    Vec3 at(double height) const { return point + height * normal; }
  };

  // Where a line that starts in the solid first leaves it; nothing if it does not start there or does not leave it.
  static std::optional<Place> bark_exit(const Field& bark, const Vec3& origin, const Vec3& axis, double step,
                                        double farthest) {
    const auto is_inside = [&](double y) { return value_at(bark, origin + y * axis) >= kIsoValue; };
    double outside = 0;
    while (outside < farthest && is_inside(outside)) outside += step;
    if (outside == 0 || outside >= farthest) return std::nullopt;
    double inside = outside - step;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (inside + outside);
      (is_inside(middle) ? inside : outside) = middle;
    }
    Place place{origin + inside * axis, axis};
    double value = 0;
    Vec3 gradient;
    bark.values_and_gradients({&place.point, 1}, {&value, 1}, {&gradient, 1});
    if (glm::length(gradient) > 0) place.normal = -glm::normalize(gradient);
    return place;
  }

  // Of what carries a shed branch, and goes on from there.
  double carrier_radius(const Internode& shed) const {
    const auto parent = static_cast<std::size_t>(shed.parent);
    const double below = plant_.internode(parent).tip_radius, beyond = plant_.neighbourhood_of(parent).thickest_child;
    return beyond > 0 ? std::min(below, beyond) : below;
  }

  // Discs at half the depth: what they take away on the floor is what the field exceeds the iso-value by there, and
  // above the floor that is enough. Where one disc cannot take away so much several do; the more, the less they reach
  // below the floor.
  template <typename Filled>
  static std::vector<Disc> hollow_of(const Place& place, double top, double depth, double width, double carrier,
                                     const Filled& filled) {
    const double excess = std::max(filled(place.at(top - depth)) - kIsoValue, 1e-3);
    for (std::size_t count = 1;; ++count) {
      const double share = excess / static_cast<double>(count);
      if (share >= 1) continue;
      const double radius = 0.5 * depth / (2 * falloff_distance(share));
      const bool fits = 2 * radius <= width && 2 * radius <= 0.75 * (carrier + top - 0.5 * depth);
      if (fits)
        return std::vector<Disc>(count, {place.at(top - 0.5 * depth), place.normal, width - 2 * radius, radius});
    }
  }

  // Whether all axes near a hollow stay inside: then it severs nothing.
  template <typename Filled>
  bool keeps_axes(const Ids& near, const std::vector<Disc>& hollow, const Filled& filled) const {
    const double reach = hollow[0].disc_radius + 2 * hollow[0].radius;
    for (const std::uint32_t i : near) {
      if (plant_.scar_of(i)) continue;
      const Internode& a = plant_.internode(i);
      const int steps = 1 + static_cast<int>(4 * glm::distance(a.base, a.tip) / std::min(a.base_radius, a.tip_radius));
      for (int k = 0; k <= steps; ++k) {
        const Vec3 p = point_on(a, plant_.arc(i), static_cast<double>(k) / steps);
        if (glm::distance(p, hollow[0].center) > reach) continue;
        const double whole = filled(p), taken = static_cast<double>(hollow.size()) * sample(hollow[0], p).value;
        constexpr double kMargin = 0.2;
        if (taken > 0 && whole - taken < std::min(whole, kIsoValue + kMargin)) return false;
      }
    }
    return true;
  }

  const Plant& plant_;
  BlobTree& tree_;
  Neighbours neighbours_;
  Carvings carvings_;
};

}  // namespace

Carvings add_carvings(const Plant& plant, BlobTree& tree) {
  if (plant.skeleton().cut_ends.empty() && plant.skeleton().scars.empty()) return {};
  return Carver(plant, tree).run();
}

}  // namespace barkridge
