#include "blobtree/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"

namespace barkridge {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Influence reaches two radii from the axis; a bent axis keeps at least this multiple of it to its arc's centre.
constexpr double kBendClearance = 1.25;
// An arc of more than so many radii of its internode is straight: single precision has no digits for such a bend.
constexpr double kFlattestArc = 3e4;
// What is nearer to a straight line is one; in radians.
constexpr double kCollinear = 1e-6;

double length_of(const Internode& a) { return glm::distance(a.base, a.tip); }
Vec3 direction_of(const Internode& a) { return (a.tip - a.base) / length_of(a); }
Vec3 across(const Vec3& v, const Vec3& axis) { return v - glm::dot(v, axis) * axis; }
// What an arc's tangent at one end of its chord is at the other.
Vec3 mirrored(const Vec3& tangent, const Vec3& chord) { return 2 * glm::dot(tangent, chord) * chord - tangent; }

double widest_angle(const Internode& a) {
  const double clearance = kBendClearance * 4 * std::max(a.base_radius, a.tip_radius);
  return 2 * std::asin(std::min(1.0, length_of(a) / clearance)) / kRadiansPerDegree;
}

// The arc with a given tangent at its start, as far as the internode is long enough for its radius.
Arc arc_from(const Internode& a, const Vec3& tangent) {
  const Vec3 chord = direction_of(a), bulge = across(tangent, chord);
  const double sine = glm::length(bulge);
  if (sine < kCollinear) return {};
  if (length_of(a) > 2 * sine * kFlattestArc * std::min(a.base_radius, a.tip_radius)) return {};
  const double angle = 2 * std::atan2(sine, glm::dot(tangent, chord)) / kRadiansPerDegree;
  return {bulge / sine, std::min(angle, widest_angle(a))};
}

// The tangent of an internode that starts off farther from its parent's direction. [GMW04, section 3.6]
Vec3 leaving(const Internode& a, const Internode& parent, double angle_degrees) {
  const Vec3 axis = direction_of(a), away = -across(direction_of(parent), axis);
  if (glm::length(away) < kCollinear) return axis;
  const double half = 0.5 * kRadiansPerDegree * std::min(angle_degrees, widest_angle(a));
  return std::cos(half) * axis + std::sin(half) * glm::normalize(away);
}

// The point between two arcs of which one leaves `base` along `start` and the other reaches `tip` along `end`, with a
// common tangent there and equal distances from the tangents' corners. [Bolton 1975, biarcs]
Vec3 biarc_middle(const Vec3& base, const Vec3& tip, const Vec3& start, const Vec3& end) {
  const Vec3 v = tip - base;
  const double b = glm::dot(v, start + end), a = 2 * (1 - glm::dot(start, end)), c = glm::dot(v, v);
  const double d = c / (b + std::sqrt(b * b + a * c));
  return 0.5 * (base + tip + d * (start - end));
}

void check(double angle_degrees) {
  if (0 <= angle_degrees && angle_degrees < 180) return;
  throw InputError(fmt::format("bend angle {} is outside its range: 0 <= angle_degrees < 180", angle_degrees));
}

class AxisMaker {
 public:
  AxisMaker(const Skeleton& skeleton, const TreeOptions& options)
      : given_(skeleton), all_(skeleton.internodes), options_(options), table_(child_table(skeleton)) {
    new_ids_.resize(all_.size());
    ends_.resize(all_.size());
    for (const CutEnd& end : given_.cut_ends) ends_[static_cast<std::size_t>(end.internode)] = true;
    for (const Scar& scar : given_.scars) ends_[static_cast<std::size_t>(scar.internode)] = true;
  }

  Axes run() {
    find_angles();
    find_tangents();
    const std::vector<const TipRule*> tips = find_tips();
    made_.skeleton.dropped_internodes = given_.dropped_internodes;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      Internode internode = all_[i];
      if (internode.parent != kNoInternode) internode.parent = new_ids_[static_cast<std::size_t>(internode.parent)];
      add_bent(internode, tangents_[i]);
      new_ids_[i] = last();
      if (tips[i]) add_tip(*tips[i]);
    }
    made_.skeleton.cut_ends = given_.cut_ends;
    for (CutEnd& end : made_.skeleton.cut_ends) turn_with_axis(end);
    made_.skeleton.scars = given_.scars;
    for (Scar& scar : made_.skeleton.scars) scar.internode = new_ids_[static_cast<std::size_t>(scar.internode)];
    return std::move(made_);
  }

 private:
  struct Tangents {
    std::optional<Vec3> start, end;
  };

  InternodeId last() const { return static_cast<InternodeId>(made_.skeleton.internodes.size()) - 1; }
  std::size_t child_count(std::size_t i) const { return table_.first[i + 1] - table_.first[i]; }

  void find_angles() {
    angles_.assign(all_.size(), options_.bend_angle_degrees);
    for (const BendRule& rule : options_.bends) {
      const Selector selector(given_, rule.internodes);
      for (std::size_t i = 0; i < all_.size(); ++i) {
        if (selector.selects(i)) angles_[i] = rule.angle_degrees;
      }
    }
    for (const Scar& scar : given_.scars) angles_[static_cast<std::size_t>(scar.internode)] = 0;
  }

  // Whether an internode alone goes on where its parent ends.
  bool continues_parent(std::size_t i) const {
    const InternodeId parent = all_[i].parent;
    return parent != kNoInternode && child_count(static_cast<std::size_t>(parent)) == 1 &&
           all_[static_cast<std::size_t>(parent)].tip == all_[i].base;
  }

  void find_tangents() {
    tangents_.resize(all_.size());
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (all_[i].parent == kNoInternode) continue;
      const auto parent = static_cast<std::size_t>(all_[i].parent);
      if (!continues_parent(i)) {
        if (angles_[i] > 0) tangents_[i].start = leaving(all_[i], all_[parent], angles_[i]);
        continue;
      }
      // That of the circle through the three nodes, or that of the one which is straight.
      const double before = angles_[i] > 0 ? length_of(all_[i]) : 0,
                   after = angles_[parent] > 0 ? length_of(all_[parent]) : 0;
      const Vec3 sum = before * direction_of(all_[parent]) + after * direction_of(all_[i]);
      if (glm::length(sum) <= kCollinear * (before + after)) continue;
      if (angles_[i] > 0) tangents_[i].start = glm::normalize(sum);
      if (angles_[parent] > 0) tangents_[parent].end = glm::normalize(sum);
    }
  }

  std::vector<const TipRule*> find_tips() const {
    std::vector<const TipRule*> tips(all_.size(), nullptr);
    for (const TipRule& rule : options_.tips) {
      const Selector selector(given_, rule.internodes);
      for (std::size_t i = 0; i < all_.size(); ++i) {
        if (child_count(i) == 0 && !ends_[i] && selector.selects(i)) tips[i] = &rule;
      }
    }
    return tips;
  }

  void add(const Internode& internode, const Arc& arc) {
    made_.skeleton.internodes.push_back(internode);
    made_.arcs.push_back(arc);
  }

  void add_bent(const Internode& a, const Tangents& tangents) {
    if (!tangents.start && !tangents.end) return add(a, {});
    const Vec3 chord = direction_of(a);
    const Vec3 start = tangents.start ? *tangents.start : mirrored(*tangents.end, chord);
    const Vec3 end = tangents.end ? *tangents.end : mirrored(start, chord);
    if (!(glm::dot(start, chord) > 0 && glm::dot(end, chord) > 0)) return add(a, {});  // it would turn back
    if (glm::distance(mirrored(start, chord), end) < kCollinear) return add(a, arc_from(a, start));
    Internode lower = a, upper = a;
    lower.tip = upper.base = biarc_middle(a.base, a.tip, start, end);
    const double share = length_of(lower) / (length_of(lower) + length_of(upper));
    lower.tip_radius = upper.base_radius = a.base_radius + share * (a.tip_radius - a.base_radius);
    add(lower, arc_from(lower, start));
    upper.parent = last();
    add(upper, arc_from(upper, mirrored(end, direction_of(upper))));
  }

  void add_tip(const TipRule& rule) {
    const Internode carrier = made_.skeleton.internodes.back();
    const Vec3 axis = end_tangent(carrier, made_.arcs.back());
    const double length = rule.length * carrier.tip_radius;
    if (rule.kind == TipKind::kPointed) {
      add_cone(carrier.tip + length * axis, kPointRadius * carrier.tip_radius);
    } else if (rule.kind == TipKind::kBud) {
      add_cone(carrier.tip + kBudWidest * length * axis, kBudRadius * carrier.tip_radius);
      add_cone(carrier.tip + length * axis, kPointRadius * carrier.tip_radius);
    }
  }

  // A cone from the last tip on, in pieces which the thin end's small radius concerns but little: along one cone
  // internodes leave no trace.
  void add_cone(const Vec3& tip, double tip_radius) {
    constexpr double kMostThinner = 2.53;  // a third root of 1 / kPointRadius is less
    const Internode carrier = made_.skeleton.internodes.back();
    const double ratio = tip_radius / carrier.tip_radius;
    const int count = std::max(1, static_cast<int>(std::ceil(-std::log(ratio) / std::log(kMostThinner))));
    for (int k = 1; k <= count; ++k) {
      Internode piece = made_.skeleton.internodes.back();
      piece.parent = last();
      piece.base = piece.tip;
      piece.base_radius = piece.tip_radius;
      piece.tip_radius = carrier.tip_radius * std::pow(ratio, static_cast<double>(k) / count);
      const double share = (carrier.tip_radius - piece.tip_radius) / (carrier.tip_radius - tip_radius);
      piece.tip = carrier.tip + share * (tip - carrier.tip);
      add(piece, {});
    }
  }

  void turn_with_axis(CutEnd& end) const {
    const auto given = static_cast<std::size_t>(end.internode), made = static_cast<std::size_t>(new_ids_[given]);
    const Vec3 from = direction_of(all_[given]), to = end_tangent(made_.skeleton.internodes[made], made_.arcs[made]);
    end.internode = new_ids_[given];
    // The turn that takes one direction straight to the other.
    const Vec3 between = from + to;
    const Vec3 once = mirrored(end.normal, from);
    end.normal = glm::normalize(2 * glm::dot(once, between) / glm::dot(between, between) * between - once);
  }

  const Skeleton& given_;
  const std::vector<Internode>& all_;
  const TreeOptions& options_;
  const ChildTable table_;
  std::vector<double> angles_;        // by internode
  std::vector<Tangents> tangents_;    // by internode; at a free end the arc's own
  std::vector<bool> ends_;            // cut or shed
  std::vector<InternodeId> new_ids_;  // of the last piece
  Axes made_;
};

Vec3 tangent(const Internode& internode, const Arc& arc, double sign) {
  const double half = 0.5 * kRadiansPerDegree * arc.angle_degrees;
  return std::cos(half) * direction_of(internode) + sign * std::sin(half) * arc.direction;
}

}  // namespace

Vec3 start_tangent(const Internode& internode, const Arc& arc) { return tangent(internode, arc, 1); }
Vec3 end_tangent(const Internode& internode, const Arc& arc) { return tangent(internode, arc, -1); }

Vec3 point_on(const Internode& internode, const Arc& arc, double share) {
  if (!(arc.angle_degrees > 0)) return internode.base + share * (internode.tip - internode.base);
  const double half = 0.5 * kRadiansPerDegree * arc.angle_degrees, turn = (2 * share - 1) * half;
  const double radius = length_of(internode) / (2 * std::sin(half));
  return 0.5 * (internode.base + internode.tip) + radius * std::sin(turn) * direction_of(internode) +
         radius * (std::cos(turn) - std::cos(half)) * arc.direction;
}

bool shapes_axes(const TreeOptions& options) {
  return options.bend_angle_degrees != 0 || !options.bends.empty() || !options.tips.empty();
}

Axes axes_of(const Skeleton& skeleton, const TreeOptions& options) {
  check(options.bend_angle_degrees);
  for (const BendRule& rule : options.bends) check(rule.angle_degrees);
  for (const TipRule& rule : options.tips) {
    if (!(rule.length >= kShortestTip)) {
      throw InputError(fmt::format("a tip's length {} is less than {}", rule.length, kShortestTip));
    }
  }
  return AxisMaker(skeleton, options).run();
}

}  // namespace barkridge
