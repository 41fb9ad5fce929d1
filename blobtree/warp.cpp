#include "blobtree/warp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

namespace barkridge {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadiansPerDegree = kPi / 180;

// The smallest box around the image of a box under a linear map and an offset.
Box image(const Mat3& linear, const Vec3& offset, const Box& box) {
  const Mat3 absolute(glm::abs(linear[0]), glm::abs(linear[1]), glm::abs(linear[2]));
  const Vec3 center = linear * box.center() + offset;
  const Vec3 extent = absolute * box.half_extent();
  return grown({center - extent, center + extent}, 1e-13 * (glm::length(center) + glm::length(extent)));
}

Mat3 frame_along(const Vec3& axis, const Vec3& toward) {
  const Vec3 x = glm::normalize(axis);
  const Vec3 y = glm::normalize(toward - glm::dot(toward, x) * x);
  return {x, y, glm::cross(x, y)};
}

Mat3 frame_along(const Vec3& axis) {
  const Vec3 x = glm::normalize(axis);
  Vec3 y, z;
  complete_frame(x, y, z);
  return {x, y, z};
}

// The largest singular value of a matrix: root of the largest eigenvalue of its symmetric square, by the trigonometric
// solution of the characteristic cubic.
double spectral_norm(const Mat3& m) {
  const Mat3 a = glm::transpose(m) * m;
  const double mean = (a[0][0] + a[1][1] + a[2][2]) / 3;
  const double off = a[1][0] * a[1][0] + a[2][0] * a[2][0] + a[2][1] * a[2][1];
  const Vec3 d(a[0][0] - mean, a[1][1] - mean, a[2][2] - mean);
  const double p = std::sqrt((glm::dot(d, d) + 2 * off) / 6);
  if (p <= 0) return std::sqrt(mean);
  const Mat3 b = (a - mean * Mat3(1)) / p;
  const double half_determinant = std::clamp(glm::determinant(b) / 2, -1.0, 1.0);
  return std::sqrt(mean + 2 * p * std::cos(std::acos(half_determinant) / 3)) * (1 + 1e-12);
}

// The distances from the origin to the points of a rectangle.
Interval distance_range(const Interval& a, const Interval& b) {
  const auto nearest = [](const Interval& i) { return i.contains(0) ? 0.0 : std::min(std::abs(i.lo), std::abs(i.hi)); };
  const auto farthest = [](const Interval& i) { return std::max(std::abs(i.lo), std::abs(i.hi)); };
  return {std::hypot(nearest(a), nearest(b)), std::hypot(farthest(a), farthest(b))};
}

}  // namespace

double arc_length(const Bend& bend) {
  const double angle = bend.angle_degrees * kRadiansPerDegree;
  return glm::distance(bend.base, bend.tip) / (2 * std::sin(angle / 2)) * angle;
}

Box Warp::Framed::to_local(const Box& box) const {
  const Mat3 inverse = glm::transpose(axes);
  return image(inverse, -(inverse * origin), box);
}

Box Warp::Framed::to_world(const Box& box) const { return image(axes, origin, box); }

// ---- Bend. In local coordinates the arc's centre lies at (chord / 2, -arc_radius cos(half_angle)); a point's polar
// ---- angle about it, counted from the bulge towards the tip, times the arc's radius is its axial coordinate.

Warp::Warp(const Bend& bend, const Box& child_support) {
  const Framed frame{bend.base, frame_along(bend.tip - bend.base, bend.direction)};
  const double half_angle = 0.5 * bend.angle_degrees * kRadiansPerDegree;
  const double chord = glm::distance(bend.base, bend.tip);
  const double arc_radius = chord / (2 * std::sin(half_angle));
  const Box local = child_support.empty() ? Box{Vec3(0), Vec3(0)} : frame.to_local(child_support);
  const double reach = distance_range({local.lo.y, local.hi.y}, {local.lo.z, local.hi.z}).hi;
  const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
  data_ = BendData{frame, half_angle, arc_radius, 2 * half_angle * arc_radius, chord,
                   reach, sine,       cosine,     -arc_radius * cosine};
}

WarpedPoint Warp::map_local(const BendData& d, const Vec3& q) {
  const double a = q.x - 0.5 * d.chord;
  const double b = q.y - d.center_height;
  const double angle = std::atan2(a, b);
  const double turn = std::clamp(angle, -d.half_angle, d.half_angle);
  const double axial = d.arc_radius * (turn + d.half_angle);
  WarpedPoint result;
  if (turn == angle) {
    const double rho = std::hypot(a, b);
    const double sine = rho > 0 ? a / rho : 0.0, cosine = rho > 0 ? b / rho : 1.0;
    const double stretch = rho > 0 ? d.arc_radius / rho : 1.0;
    result.point = {axial, rho - d.arc_radius, q.z};
    result.jacobian = Mat3(Vec3(stretch * cosine, sine, 0), Vec3(-stretch * sine, cosine, 0), Vec3(0, 0, 1));
  } else {
    // Coordinates in the frame that has turned with the arc: `along` its tangent, `out` from its centre.
    const double sine = turn < 0 ? -d.sine : d.sine, cosine = d.cosine;
    const double along = cosine * a - sine * b;
    const double out = sine * a + cosine * b;
    result.point = {axial + along, out - d.arc_radius, q.z};
    result.jacobian = Mat3(Vec3(cosine, sine, 0), Vec3(-sine, cosine, 0), Vec3(0, 0, 1));
  }
  return result;
}

WarpedBox Warp::map_local(const BendData& d, const Box& box) {
  const double center_height = d.center_height;
  const Interval a{box.lo.x - 0.5 * d.chord, box.hi.x - 0.5 * d.chord};
  const Interval b{box.lo.y - center_height, box.hi.y - center_height};
  // Polar angles of a rectangle that leaves out the centre and the cut behind it lie between those of its corners.
  Interval angle{-kPi, kPi};
  if (!a.contains(0) || b.lo > 0) {
    angle = {};
    for (const double x : {a.lo, a.hi}) {
      for (const double y : {b.lo, b.hi}) {
        angle = {std::min(angle.lo, std::atan2(x, y)), std::max(angle.hi, std::atan2(x, y))};
      }
    }
  }
  constexpr double kRounding = 1e-12;
  angle = {angle.lo - kRounding, angle.hi + kRounding};
  const Interval rho = distance_range(a, b);
  WarpedBox result;
  if (angle.hi >= -d.half_angle && angle.lo <= d.half_angle) {
    const double margin = kRounding * (d.arc_radius + rho.hi);
    const Interval turn{std::max(angle.lo, -d.half_angle), std::min(angle.hi, d.half_angle)};
    result.box = grown({{d.arc_radius * (turn.lo + d.half_angle), rho.lo - d.arc_radius, box.lo.z},
                        {d.arc_radius * (turn.hi + d.half_angle), rho.hi - d.arc_radius, box.hi.z}},
                       margin);
    // Nearer to the centre than the child reaches, the field is zero.
    const double nearest = std::max({rho.lo, d.arc_radius - d.reach, 1e-9 * d.arc_radius});
    result.stretch = std::max(1.0, d.arc_radius / nearest);
    // Across an end of the arc the Jacobian jumps.
    const bool is_within = angle.lo >= -d.half_angle && angle.hi <= d.half_angle;
    result.curvature = std::sqrt(1 + result.stretch * result.stretch) / nearest;
    if (!is_within) result.jump = 2 * std::max(result.stretch - 1, 1 - d.arc_radius / std::max(rho.hi, nearest));
  } else {
    result.curvature = 0;
  }
  const auto unite_straight_end = [&](double turn) {
    const double sine = std::sin(turn), cosine = std::cos(turn);
    const Mat3 linear(Vec3(cosine, sine, 0), Vec3(-sine, cosine, 0), Vec3(0, 0, 1));
    const Vec3 offset(d.arc_radius * (turn + d.half_angle), -d.arc_radius, 0);
    const Vec3 to_center(-0.5 * d.chord, -center_height, 0);
    result.box = unite(result.box, image(linear, linear * to_center + offset, box));
  };
  if (angle.lo < -d.half_angle) unite_straight_end(-d.half_angle);
  if (angle.hi > d.half_angle) unite_straight_end(d.half_angle);
  return result;
}

// Along a line the polar angle rises or falls, so that the ends tell where on the arc the piece is.
WarpedPiece Warp::map_local(const BendData& d, const Vec3& from, const Vec3& to) {
  WarpedPiece result{map_local(d, from).point, map_local(d, to).point};
  const glm::dvec2 center(0.5 * d.chord, d.center_height);
  const glm::dvec2 a = glm::dvec2(from) - center, way = glm::dvec2(to) - glm::dvec2(from);
  const double way2 = glm::dot(way, way);
  const double t = way2 > 0 ? std::clamp(-glm::dot(a, way) / way2, 0.0, 1.0) : 0.0;
  const double rho_lo = glm::length(a + t * way), rho_hi = std::max(glm::length(a), glm::length(a + way));
  const double nearest = std::max({rho_lo, d.arc_radius - d.reach, 1e-9 * d.arc_radius});
  // Behind the centre the angle jumps from one end to the other.
  const bool may_pass_behind = a.x * (a.x + way.x) <= 0 && std::min(a.y, a.y + way.y) <= 0;
  const auto lies_straight = [&](const auto& past) {
    return !may_pass_behind && past(result.from.x) && past(result.to.x);
  };
  if (lies_straight([](double x) { return x < 0; }) || lies_straight([&](double x) { return x > d.arc; })) {
    result.curvature = 0;
    return result;
  }
  // Nearer to the centre than the child reaches, the field is zero.
  result.stretch = std::max(1.0, d.arc_radius / nearest);
  result.curvature = std::sqrt(1 + result.stretch * result.stretch) / nearest;
  const bool is_within = std::min(result.from.x, result.to.x) >= 0 && std::max(result.from.x, result.to.x) <= d.arc;
  if (may_pass_behind || !is_within) {
    result.jump = 2 * std::max(result.stretch - 1, 1 - d.arc_radius / std::max(rho_hi, nearest));
  }
  return result;
}

Box Warp::support_local(const BendData& d, const Box& box) {
  // Straight parts move rigidly; the arc with all that reaches out from it stays within a box around the sector.
  const double center_height = d.center_height;
  Box result;
  if (box.hi.x >= 0 && box.lo.x <= d.arc) {
    const double lo = std::max(0.0, d.arc_radius + box.lo.y), hi = std::max(0.0, d.arc_radius + box.hi.y);
    const double from = std::max(0.0, box.lo.x) / d.arc_radius - d.half_angle;
    const double to = std::min(d.arc, box.hi.x) / d.arc_radius - d.half_angle;
    const auto add = [&](double turn) {
      for (const double rho : {lo, hi}) {
        const double x = rho * std::sin(turn) + 0.5 * d.chord, y = rho * std::cos(turn) + center_height;
        result = unite(result, Box{{x, y, box.lo.z}, {x, y, box.hi.z}});
      }
    };
    add(from);
    add(to);
    for (const double extreme : {-kPi / 2, 0.0, kPi / 2}) {
      if (from < extreme && extreme < to) add(extreme);
    }
  }
  const auto add_straight_end = [&](double turn, double lo_x, double hi_x) {
    if (lo_x > hi_x) return;
    const double sine = std::sin(turn), cosine = std::cos(turn);
    const Mat3 linear(Vec3(cosine, -sine, 0), Vec3(sine, cosine, 0), Vec3(0, 0, 1));
    const Vec3 offset(-d.arc_radius * (turn + d.half_angle), d.arc_radius, 0);
    const Vec3 from_center(0.5 * d.chord, center_height, 0);
    const Box part{{lo_x, box.lo.y, box.lo.z}, {hi_x, box.hi.y, box.hi.z}};
    result = unite(result, image(linear, linear * offset + from_center, part));
  };
  add_straight_end(-d.half_angle, box.lo.x, std::min(0.0, box.hi.x));
  add_straight_end(d.half_angle, std::max(d.arc, box.lo.x), box.hi.x);
  return grown(result, 1e-12 * (d.arc_radius + result.diagonal()));
}

// ---- Twist.

Warp::Warp(const Twist& twist)
    : data_(TwistData{{twist.origin, frame_along(twist.axis)}, twist.degrees_per_unit * kRadiansPerDegree}) {}

WarpedPoint Warp::map_local(const TwistData& d, const Vec3& q) {
  const double sine = std::sin(-d.radians_per_unit * q.x), cosine = std::cos(-d.radians_per_unit * q.x);
  const Vec3 point(q.x, cosine * q.y - sine * q.z, sine * q.y + cosine * q.z);
  return {point, Mat3(Vec3(1, d.radians_per_unit * point.z, -d.radians_per_unit * point.y), Vec3(0, cosine, sine),
                      Vec3(0, -sine, cosine))};
}

namespace {

// The boxes of everything that turning a box about the x axis, by any angle, can reach.
Box turned_about_x(const Box& box) {
  const double reach = distance_range({box.lo.y, box.hi.y}, {box.lo.z, box.hi.z}).hi;
  return {{box.lo.x, -reach, -reach}, {box.hi.x, reach, reach}};
}

}  // namespace

WarpedBox Warp::map_local(const TwistData& d, const Box& box) {
  const double reach = distance_range({box.lo.y, box.hi.y}, {box.lo.z, box.hi.z}).hi;
  const double shear = std::abs(d.radians_per_unit) * reach;
  const double stretch = 0.5 * (shear + std::sqrt(shear * shear + 4));
  const Vec3 center = map_local(d, box.center()).point;
  const Box near = grown({center, center}, stretch * glm::length(box.half_extent()) * (1 + 1e-12));
  return {intersect(near, turned_about_x(grown(box, 1e-12 * reach))), stretch};
}

Box Warp::support_local(const TwistData&, const Box& box) { return turned_about_x(box); }

// ---- Taper.

Warp::Warp(const Taper& taper)
    : data_(TaperData{
          {taper.base, frame_along(taper.tip - taper.base)}, glm::distance(taper.base, taper.tip), taper.tip_scale}) {}

WarpedPoint Warp::map_local(const TaperData& d, const Vec3& q) {
  const double t = std::clamp(q.x / d.length, 0.0, 1.0);
  const double scale = 1 + (d.tip_scale - 1) * t;
  const double slope = t == q.x / d.length ? (d.tip_scale - 1) / d.length : 0.0;
  const double by_x = -slope / (scale * scale);
  return {{q.x, q.y / scale, q.z / scale},
          Mat3(Vec3(1, q.y * by_x, q.z * by_x), Vec3(0, 1 / scale, 0), Vec3(0, 0, 1 / scale))};
}

WarpedBox Warp::map_local(const TaperData& d, const Box& box) {
  const auto scale_at = [&](double x) { return 1 + (d.tip_scale - 1) * std::clamp(x / d.length, 0.0, 1.0); };
  const Interval scale{std::min(scale_at(box.lo.x), scale_at(box.hi.x)),
                       std::max(scale_at(box.lo.x), scale_at(box.hi.x))};
  const auto divided = [&](double lo, double hi) {
    return Interval{std::min(lo / scale.lo, lo / scale.hi), std::max(hi / scale.lo, hi / scale.hi)};
  };
  const Interval y = divided(box.lo.y, box.hi.y), z = divided(box.lo.z, box.hi.z);
  const double reach = distance_range({box.lo.y, box.hi.y}, {box.lo.z, box.hi.z}).hi;
  const double slope = std::abs(d.tip_scale - 1) / d.length;
  const Box mapped{{box.lo.x, y.lo, z.lo}, {box.hi.x, y.hi, z.hi}};
  return {grown(mapped, 1e-13 * mapped.diagonal()),
          std::max(1.0, 1 / scale.lo) + reach * slope / (scale.lo * scale.lo)};
}

Box Warp::support_local(const TaperData& d, const Box& box) {
  const double widest = std::max(1.0, d.tip_scale), narrowest = std::min(1.0, d.tip_scale);
  const auto scaled = [&](double lo, double hi) {
    return Interval{std::min(lo * widest, lo * narrowest), std::max(hi * widest, hi * narrowest)};
  };
  const Interval y = scaled(box.lo.y, box.hi.y), z = scaled(box.lo.z, box.hi.z);
  return {{box.lo.x, y.lo, z.lo}, {box.hi.x, y.hi, z.hi}};
}

// ---- Affine.

Warp::Warp(const Affine& affine) {
  const Mat3 inverse = glm::inverse(affine.linear);
  data_ = AffineData{inverse, affine.offset, affine.linear, spectral_norm(inverse)};
}

// ---- All of them, in the world's coordinates.

WarpedPoint Warp::map_with_jacobian(const Vec3& p) const {
  return std::visit(
      [&](const auto& d) -> WarpedPoint {
        if constexpr (std::is_same_v<std::decay_t<decltype(d)>, AffineData>) {
          return {d.inverse * (p - d.offset), d.inverse};
        } else {
          const WarpedPoint local = map_local(d, d.frame.to_local(p));
          return {d.frame.to_world(local.point), d.frame.axes * local.jacobian * glm::transpose(d.frame.axes)};
        }
      },
      data_);
}

WarpedBox Warp::map(const Box& box) const {
  return std::visit(
      [&](const auto& d) -> WarpedBox {
        if constexpr (std::is_same_v<std::decay_t<decltype(d)>, AffineData>) {
          return {image(d.inverse, -(d.inverse * d.offset), box), d.stretch, 0, 0};
        } else {
          const WarpedBox local = map_local(d, d.frame.to_local(box));
          return {d.frame.to_world(local.box), local.stretch, local.curvature, local.jump};
        }
      },
      data_);
}

WarpedPiece Warp::map(const Vec3& from, const Vec3& to) const {
  if (const BendData* bend = std::get_if<BendData>(&data_)) {
    WarpedPiece piece = map_local(*bend, bend->frame.to_local(from), bend->frame.to_local(to));
    piece.from = bend->frame.to_world(piece.from);
    piece.to = bend->frame.to_world(piece.to);
    return piece;
  }
  const WarpedBox box = map({glm::min(from, to), glm::max(from, to)});
  return {map(from), map(to), box.stretch, box.curvature, box.jump};
}

Vec3 Warp::bent_axis(double height) const {
  const BendData& d = std::get<BendData>(data_);
  const double on_arc = std::clamp(height, 0.0, d.arc), turn = on_arc / d.arc_radius - d.half_angle;
  const double sine = std::sin(turn), cosine = std::cos(turn), past = height - on_arc;
  return d.frame.to_world(
      {0.5 * d.chord + d.arc_radius * sine + past * cosine, d.center_height + d.arc_radius * cosine - past * sine, 0});
}

Box Warp::bent_support(const Box& local) const { return support_local(std::get<BendData>(data_), local); }

Box Warp::support(const Box& child_support) const {
  if (child_support.empty()) return {};
  return std::visit(
      [&](const auto& d) -> Box {
        if constexpr (std::is_same_v<std::decay_t<decltype(d)>, AffineData>) {
          return image(d.linear, d.offset, child_support);
        } else {
          return d.frame.to_world(support_local(d, d.frame.to_local(child_support)));
        }
      },
      data_);
}

}  // namespace barkridge
