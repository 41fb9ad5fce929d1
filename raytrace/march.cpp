#include "raytrace/march.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace barkridge {

Interval clip(const Ray& ray, const Box& box, Interval range) {
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis], direction = ray.direction[axis];
    if (direction == 0) {
      if (origin < box.lo[axis] || origin > box.hi[axis]) return {};
      continue;
    }
    const double a = (box.lo[axis] - origin) / direction;
    const double b = (box.hi[axis] - origin) / direction;
    range.lo = std::max(range.lo, std::min(a, b));
    range.hi = std::min(range.hi, std::max(a, b));
  }
  return range;
}

double FieldAlongRay::value(double t) const {
  const Vec3 point = at(t);
  double value = 0;
  field.values({&point, 1}, {&value, 1});
  return value;
}

FieldBounds FieldAlongRay::bounds(double from, double to) const {
  const Vec3 a = at(from), b = at(to);
  return field.bounds({glm::min(a, b), glm::max(a, b)});
}

namespace {

// A relaxed step ends a little before the clear stretches of its ends would just touch.
constexpr double kRelaxation = 0.95;

// A march: nothing before `t_` is inside.
class March {
 public:
  March(const FieldAlongRay& along, Interval range, double tolerance)
      : along_(along), t_(range.lo), end_(range.hi), tolerance_(tolerance), piece_(range.hi - range.lo) {}

  // `any`: a point inside that is met on the way will do, whether or not it is the first.
  std::optional<double> run(bool any) {
    if (!bound_piece()) return std::nullopt;
    while (true) {
      if (!value_known_) {
        value_ = along_.value(t_);
        if (value_ >= kIsoValue) return t_;
        value_known_ = true;
        trend_ = 0;
      }
      const double clear = (kIsoValue - value_) / slope_;
      const double ahead = piece_end_ - t_;
      if (clear >= ahead) {
        move_to(piece_end_);
        piece_ *= 2;
        if (t_ >= end_ || !bound_piece()) return std::nullopt;
      } else if (clear * patience_ < ahead && ahead > 4 * tolerance_) {
        const double old_slope = slope_;
        piece_ = std::max({4 * clear, ahead / 16, 2 * tolerance_});
        if (!bound_piece()) return std::nullopt;
        // A shorter piece has closer bounds; where it has not, wait longer before trying again.
        if (slope_ > 0.75 * old_slope) patience_ = std::min(2 * patience_, 256.0);
      } else if (const std::optional<double> hit = step(clear, any)) {
        return hit;
      }
    }
  }

 private:
  void move_to(double t) {
    t_ = t;
    value_known_ = false;
  }

  // Bounds for the next `piece_` of the way, passing what they show to be empty. False when that is all the rest.
  bool bound_piece() {
    while (true) {
      piece_end_ = std::min(t_ + piece_, end_);
      const FieldBounds bounds = along_.bounds(t_, piece_end_);
      slope_ = bounds.slope;
      if (bounds.value.hi >= kIsoValue) return true;
      if (piece_end_ >= end_) return false;
      move_to(piece_end_);
      piece_ *= 2;
    }
  }

  // One step ahead within the piece; the hit if it ends one. `clear` is the distance known to be empty.
  std::optional<double> step(double clear, bool any) {
    const double relaxed = kRelaxation * 2 * clear / (1 + trend_);
    double length = std::min(std::max({clear, relaxed, tolerance_}), piece_end_ - t_);
    double next = along_.value(t_ + length);
    trend_ = std::clamp((next - value_) / (length * slope_), -0.75, 1.0);
    const bool proven = length <= tolerance_ || length <= clear + (kIsoValue - next) / slope_;
    if (!proven && !(any && next >= kIsoValue)) {
      length = std::min(std::max(clear, tolerance_), piece_end_ - t_);
      next = along_.value(t_ + length);
    }
    if (next >= kIsoValue) return crossing(t_, value_, t_ + length, next);
    t_ += length;
    value_ = next;
    return std::nullopt;
  }

  // The crossing between `a` (outside) and `b` (inside), by the Illinois variant of the false position.
  double crossing(double a, double fa, double b, double fb) const {
    fa -= kIsoValue;
    fb -= kIsoValue;
    double root = b;
    for (int i = 0; i < 4 && fb > 0; ++i) {
      root = b - fb * ((b - a) / (fb - fa));
      if (!(root > a && root < b)) break;
      const double f = along_.value(root) - kIsoValue;
      if (f >= 0) {
        b = root;
        fb = f;
        fa *= 0.5;
      } else {
        a = root;
        fa = f;
        fb *= 0.5;
      }
    }
    return root;
  }

  const FieldAlongRay& along_;
  double t_;
  double end_;
  double tolerance_;
  double piece_;          // how far the next bounds reach
  double piece_end_ = 0;  // where the present ones end
  double slope_ = 0;      // Lipschitz constant up to there
  bool value_known_ = false;
  double value_ = 0;     // F at t_
  double trend_ = 0;     // estimate of dF/dt over slope_
  double patience_ = 8;  // bounds are renewed when the piece is this many times longer than the clear distance
};

}  // namespace

std::optional<double> first_inside(const FieldAlongRay& along, Interval range, double tolerance) {
  return March(along, range, tolerance).run(false);
}

bool any_inside(const FieldAlongRay& along, Interval range, double tolerance) {
  return March(along, range, tolerance).run(true).has_value();
}

}  // namespace barkridge
