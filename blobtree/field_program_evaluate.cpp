#include <algorithm>
#include <cmath>

#include <hwy/aligned_allocator.h>

#include <glm/common.hpp>

#include "blobtree/bend_kernels.h"
#include "blobtree/disc_kernels.h"
#include "blobtree/noise_kernels.h"
#include "blobtree/operator_kernels.h"
#include "blobtree/primitive.h"

namespace barkridge {

namespace {

using Op = FieldInstruction::Op;

std::size_t padded(std::size_t count) { return (count + kBatchGranule - 1) / kBatchGranule * kBatchGranule; }

// Memory for one thread's evaluations, kept between calls.
struct Scratch {
  hwy::AlignedFreeUniquePtr<float[]> numbers;
  std::size_t capacity = 0;
  std::vector<LocalCone> cones;
  std::vector<LineCone> line_cones;
  std::vector<FieldColumns> fields;
  std::vector<Vec3> origins;  // by level of warps, for what is being evaluated
  std::vector<Vec3> entered;  // under each warp of the program

  float* take(std::size_t count) {
    if (count > capacity) {
      numbers = hwy::AllocateAligned<float>(count);
      capacity = count;
    }
    return numbers.get();
  }
};

Scratch& scratch_of_thread() {
  thread_local Scratch scratch;
  return scratch;
}

// How many columns a machine has: points, fields, and, where something is displaced, a noise and points on a line.
std::size_t column_count(const FieldProgramDepth& depth, bool gradients) {
  const std::size_t of_field = gradients ? 4 : 1;
  return 3 * (depth.warps + 1) + of_field * depth.fields + (depth.displaces ? of_field + 3 : 0);
}

// Runs a program on batches of up to `capacity` points.
class Machine {
 public:
  Machine(const FieldModel& model, const FieldProgram& program, std::size_t capacity, bool gradients, Scratch& scratch)
      : model_(model), program_(program), gradients_(gradients), capacity_(capacity), scratch_(scratch) {
    const FieldProgramDepth depth = depth_of(program);
    numbers_ = scratch.take(capacity * column_count(depth, gradients));
    fields_ = numbers_ + 3 * capacity * (depth.warps + 1);
    noise_fields_ = depth.fields;
    has_warps_ = depth.warps > 0;
    scratch.origins.resize(depth.warps + 1);
    scratch.fields.resize(depth.fields);
    for (std::size_t level = 0; level < depth.fields; ++level) scratch.fields[level] = slot(level);
  }

  float* point_column(std::size_t axis, std::size_t level = 0) { return numbers_ + (3 * level + axis) * capacity_; }
  const FieldColumns& result() const { return scratch_.fields[0]; }

  /// What the points to come are relative to. Under warps every set of points has an origin of its own, which follows
  /// from it.
  void set_origin(const Vec3& origin) {
    scratch_.origins[0] = origin;
    scratch_.entered.clear();
    scratch_.cones.resize(program_.cones.size());
    std::size_t level = 0;
    for (const FieldInstruction& instruction : program_.code) {
      const Vec3& here = scratch_.origins[level];
      switch (instruction.op) {
        case Op::kCones:
          localize(instruction, here);
          break;
        case Op::kEnterWarp:
          scratch_.entered.push_back(origin_under(model_.warps[instruction.index], here));
          scratch_.origins[++level] = scratch_.entered.back();
          break;
        case Op::kLeaveWarp:
          --level;
          break;
        default:
          break;
      }
    }
  }

  /// Whether a line's points can be told by their parameter alone: where nothing but cones is evaluated, unwarped.
  bool can_follow_line() const {
    return !has_warps_ && std::none_of(program_.code.begin(), program_.code.end(),
                                       [](const FieldInstruction& i) { return i.op == Op::kOther; });
  }

  /// From now on the first column of points is the parameter along a line, in units of the model from `origin` on.
  void follow_line(const Vec3& origin, const Vec3& direction, double reach) {
    std::vector<LineCone>& cones = scratch_.line_cones;
    cones.clear();
    for (const ConeReference& reference : program_.cones) {
      cones.push_back(line_cone(model_.cones[reference.cone], static_cast<ConeKind>(reference.kind), origin, direction,
                                model_.units.scale, reach));
    }
    is_on_line_ = true;
    scratch_.origins[0] = origin;
    line_direction_ = direction;
  }

  /// Runs the program on the first `size` points, relative to the origin, in units of the model.
  void run(std::size_t size) {
    const std::size_t whole = padded(size);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::fill(point_column(axis) + size, point_column(axis) + whole, 0.0f);
    }
    std::size_t top = 0, level = 0, entered = 0;
    noise_ = nullptr;
    PointBatch points = points_at(0, whole);
    std::vector<FieldColumns>& fields = scratch_.fields;
    for (const FieldInstruction& instruction : program_.code) {
      switch (instruction.op) {
        case Op::kZero:
          clear(fields[top++], whole);
          break;
        case Op::kCones:
          evaluate_cones(instruction, points, fields[top++]);
          break;
        case Op::kOther:
          evaluate_other(model_.others[instruction.index], points, fields[top++]);
          break;
        case Op::kNegate:
          negate(fields[top - 1], whole);
          break;
        case Op::kDisplace: {
          const Displacement& displacement = model_.displacements[instruction.index];
          displace(displacement.amount, noise_at(points, displacement.noise, level), fields[top - 1], whole);
          break;
        }
        case Op::kEnterWarp:
          scratch_.origins[level + 1] = scratch_.entered[entered++];
          enter(model_.warps[instruction.index], points, level);
          points = points_at(++level, whole);
          break;
        case Op::kLeaveWarp:
          points = points_at(--level, whole);
          if (gradients_) leave(model_.warps[instruction.index], points, fields[top - 1]);
          break;
        default:
          top -= instruction.count;
          apply_operator(instruction, model_, std::span(fields).subspan(top, instruction.count), whole);
          ++top;
      }
    }
  }

 private:
  std::size_t columns() const { return gradients_ ? 4 : 1; }

  FieldColumns slot(std::size_t level) const {
    float* start = fields_ + columns() * capacity_ * level;
    if (!gradients_) return {start, {}};
    return {start, {start + capacity_, start + 2 * capacity_, start + 3 * capacity_}};
  }

  PointBatch points_at(std::size_t level, std::size_t size) {
    return {scratch_.origins[level], {point_column(0, level), point_column(1, level), point_column(2, level)}, size};
  }

  // The values of a noise. Those at the program's own points are kept, as most displacements share one noise.
  FieldColumns noise_at(PointBatch points, const SolidNoise& noise, std::size_t level) {
    const FieldColumns out = slot(noise_fields_);
    if (level == 0 && noise_ && *noise_ == noise) return out;
    noise_ = level == 0 ? &noise : nullptr;
    if (is_on_line_) points = points_on_line(points);
    sample_noise(noise, model_.units.scale, points, out);
    return out;
  }

  // The points whose parameters are known.
  PointBatch points_on_line(PointBatch points) {
    const float* const t = points.at[0];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points.at[axis] = slot(noise_fields_ + 1).f + axis * capacity_;
      const auto slope = static_cast<float>(line_direction_[static_cast<int>(axis)]);
      for (std::size_t i = 0; i < points.size; ++i) points.at[axis][i] = slope * t[i];
    }
    return points;
  }

  template <typename Change>
  void for_each_number(const FieldColumns& field, std::size_t size, Change change) const {
    std::for_each_n(field.f, size, change);
    if (!gradients_) return;
    for (float* column : field.gradient) std::for_each_n(column, size, change);
  }
  void clear(const FieldColumns& field, std::size_t size) const {
    for_each_number(field, size, [](float& x) { x = 0; });
  }
  void negate(const FieldColumns& field, std::size_t size) const {
    for_each_number(field, size, [](float& x) { x = -x; });
  }

  void localize(const FieldInstruction& cones, const Vec3& origin) {
    for (std::size_t k = cones.index; k < cones.index + cones.count; ++k) {
      const ConeReference& reference = program_.cones[k];
      scratch_.cones[k] =
          local_cone(model_.cones[reference.cone], static_cast<ConeKind>(reference.kind), origin, model_.units.scale);
    }
  }

  // Under a bend the same for all, near to all that happens at the bend.
  static Vec3 origin_under(const Warp& warp, const Vec3& origin) {
    const Warp::BendData* bend = warp.bend();
    return bend ? bend->straight_middle() : warp.map(origin);
  }

  void evaluate_cones(const FieldInstruction& instruction, const PointBatch& points, const FieldColumns& out) {
    const auto of = [&](const auto& cones) { return std::span(cones).subspan(instruction.index, instruction.count); };
    if (is_on_line_) {
      sum_cones_along(of(scratch_.line_cones), points.at[0], out.f);
    } else {
      sum_cones(of(scratch_.cones), points, out);
    }
  }

  Vec3 place(const PointBatch& p, std::size_t i) const {
    return p.origin + Vec3(p.at[0][i], p.at[1][i], p.at[2][i]) / model_.units.scale;
  }

  void evaluate_other(const FieldModel::Other& other, const PointBatch& p, const FieldColumns& out) const {
    std::visit(
        [&](const auto& shape) {
          if constexpr (std::is_constructible_v<RoundShape, decltype(shape)>) {
            sample_round(shape, model_.units.scale, p, out);
          } else {
            evaluate_each(shape, p, out);
          }
        },
        other.shape);
  }

  template <typename Shape>
  void evaluate_each(const Shape& shape, const PointBatch& p, const FieldColumns& out) const {
    for (std::size_t i = 0; i < p.size; ++i) {
      const FieldSample at = sample(shape, place(p, i));
      out.f[i] = static_cast<float>(at.value);
      if (gradients_) store_gradient(at.gradient / model_.units.scale, out, i);
    }
  }

  static void store_gradient(const Vec3& gradient, const FieldColumns& out, std::size_t i) {
    for (int axis = 0; axis < 3; ++axis) out.gradient[axis][i] = static_cast<float>(gradient[axis]);
  }

  void enter(const Warp& warp, const PointBatch& p, std::size_t level) {
    const PointBatch to = points_at(level + 1, p.size);
    if (const Warp::BendData* bend = warp.bend()) return bend_points(*bend, model_.units.scale, p, to);
    for (std::size_t i = 0; i < p.size; ++i) {
      const Vec3 q = model_.units.scale * (warp.map(place(p, i)) - to.origin);
      for (std::size_t axis = 0; axis < 3; ++axis) to.at[axis][i] = static_cast<float>(q[static_cast<int>(axis)]);
    }
  }
  void leave(const Warp& warp, const PointBatch& p, const FieldColumns& field) const {
    if (const Warp::BendData* bend = warp.bend()) return bend_gradients(*bend, model_.units.scale, p, field);
    for (std::size_t i = 0; i < p.size; ++i) {
      const Mat3 jacobian = warp.map_with_jacobian(place(p, i)).jacobian;
      const Vec3 gradient(field.gradient[0][i], field.gradient[1][i], field.gradient[2][i]);
      store_gradient(gradient * jacobian, field, i);  // transposed Jacobian times gradient
    }
  }

  const FieldModel& model_;
  const FieldProgram& program_;
  bool gradients_;
  std::size_t capacity_;
  Scratch& scratch_;
  float* numbers_;
  float* fields_;
  bool has_warps_;
  bool is_on_line_ = false;
  Vec3 line_direction_{0};
  std::size_t noise_fields_ = 0;       // the slot of noises, behind all fields
  const SolidNoise* noise_ = nullptr;  // whose values stand there
};

// The grid point next to a point, about which it is evaluated.
Vec3 origin_of(const Vec3& p, double spacing) { return spacing * glm::floor(p / spacing + 0.5); }

// The points of a batch by their origins. Nearly always there is but one.
class OriginGroups {
 public:
  OriginGroups(std::span<const Vec3> points, double spacing) : points_(points), spacing_(spacing) {
    Box box;
    for (const Vec3& p : points) box = unite(box, p);
    is_single_ = origin_of(box.lo, spacing) == origin_of(box.hi, spacing);
  }

  // Calls `evaluate(origin, indices)` for each group; no indices stand for all points.
  template <typename Evaluate>
  void for_each(Evaluate evaluate) const {
    if (is_single_) {
      evaluate(origin_of(points_.front(), spacing_), std::span<const std::uint32_t>());
      return;
    }
    std::vector<std::uint32_t> left(points_.size()), group, others;
    for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
    while (!left.empty()) {
      const Vec3 origin = origin_of(points_[left.front()], spacing_);
      group.clear();
      others.clear();
      // The first belongs to its own group even if it is no number.
      group.push_back(left.front());
      for (const std::uint32_t i : std::span(left).subspan(1)) {
        (origin_of(points_[i], spacing_) == origin ? group : others).push_back(i);
      }
      evaluate(origin, std::span<const std::uint32_t>(group));
      left.swap(others);
    }
  }

 private:
  std::span<const Vec3> points_;
  double spacing_;
  bool is_single_;
};

// As many points at once as fit into the inner caches, fewer where the stack is deep.
std::size_t batch_size(const FieldProgram& program, std::size_t points, bool gradients) {
  constexpr std::size_t kLargestBatch = 768;
  constexpr std::size_t kScratchNumbers = std::size_t{1} << 16;
  const std::size_t columns = column_count(depth_of(program), gradients);
  return padded(std::clamp<std::size_t>(kScratchNumbers / columns, 1, std::min(kLargestBatch, points)));
}

}  // namespace

FieldProgramDepth depth_of(const FieldProgram& program) {
  std::size_t fields = 0, warps = 0;
  FieldProgramDepth deepest;
  for (const FieldInstruction& instruction : program.code) {
    switch (instruction.op) {
      case Op::kZero:
      case Op::kCones:
      case Op::kOther:
        ++fields;
        break;
      case Op::kNegate:
        break;
      case Op::kDisplace:
        deepest.displaces = true;
        break;
      case Op::kEnterWarp:
        ++warps;
        break;
      case Op::kLeaveWarp:
        --warps;
        break;
      default:
        fields -= instruction.count - 1;
    }
    deepest.fields = std::max(deepest.fields, fields);
    deepest.warps = std::max(deepest.warps, warps);
  }
  return deepest;
}

std::size_t primitive_count_of(const FieldProgram& program) {
  std::size_t count = 0;
  for (const FieldInstruction& instruction : program.code) {
    count += instruction.op == Op::kCones ? instruction.count : instruction.op == Op::kOther;
  }
  return count;
}

void evaluate(const FieldModel& model, const FieldProgram& program, std::span<const Vec3> points,
              std::span<double> values, std::span<Vec3> gradients) {
  if (points.empty()) return;
  if (program.code.empty()) {
    std::fill(values.begin(), values.end(), 0.0);
    std::fill(gradients.begin(), gradients.end(), Vec3(0));
    return;
  }
  const bool wants_gradients = !gradients.empty();
  const std::size_t batch = batch_size(program, points.size(), wants_gradients);
  Machine machine(model, program, batch, wants_gradients, scratch_of_thread());
  const FieldColumns& result = machine.result();
  const auto run = [&](const Vec3& origin, std::size_t count, auto index) {
    machine.set_origin(origin);
    for (std::size_t start = 0; start < count; start += batch) {
      const std::size_t size = std::min(batch, count - start);
      for (std::size_t i = 0; i < size; ++i) {
        const Vec3 p = model.units.scale * (points[index(start + i)] - origin);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          machine.point_column(axis)[i] = static_cast<float>(p[static_cast<int>(axis)]);
        }
      }
      machine.run(size);
      for (std::size_t i = 0; i < size; ++i) {
        values[index(start + i)] = static_cast<double>(result.f[i]);
        if (!wants_gradients) continue;
        gradients[index(start + i)] =
            model.units.scale * Vec3(result.gradient[0][i], result.gradient[1][i], result.gradient[2][i]);
      }
    }
  };
  OriginGroups(points, model.units.origin_spacing / model.units.scale)
      .for_each([&](const Vec3& origin, std::span<const std::uint32_t> group) {
        if (group.empty()) {
          run(origin, points.size(), [](std::size_t i) { return i; });
        } else {
          run(origin, group.size(), [&](std::size_t i) { return group[i]; });
        }
      });
}

namespace {

static_assert(kSearchSamples == kBatchGranule);

// Samples of a program along a ray, by parameters of the ray.
class RaySampler {
 public:
  RaySampler(Machine& machine, const FieldModel& model, const Ray& ray, const Interval& range)
      : machine_(machine),
        scale_(model.units.scale),
        direction_(ray.direction),
        middle_(0.5 * (range.lo + range.hi)),
        follows_(machine.can_follow_line()) {
    follows_ ? machine_.follow_line(ray.at(middle_), direction_, 0.5 * scale_ * (range.hi - range.lo))
             : machine_.set_origin(ray.at(middle_));
  }

  void operator()(const Interval& part, std::array<float, kSearchSamples>& values) const {
    const auto first = static_cast<float>(scale_ * (part.lo - middle_));
    const auto step = static_cast<float>(scale_ * (part.hi - part.lo) / (kSearchSamples - 1));
    for (std::size_t axis = 0; axis < (follows_ ? 1 : 3); ++axis) {
      const float slope = follows_ ? 1 : static_cast<float>(direction_[static_cast<int>(axis)]);
      float* column = machine_.point_column(axis);
      for (std::size_t i = 0; i < kSearchSamples; ++i) column[i] = slope * (first + step * static_cast<float>(i));
    }
    machine_.run(kSearchSamples);
    std::copy_n(machine_.result().f, kSearchSamples, values.begin());
  }

 private:
  Machine& machine_;
  double scale_;
  Vec3 direction_;
  double middle_;
  bool follows_;
};

}  // namespace

RayLanes search_along(const FieldModel& model, const FieldProgram& program, const FieldBounds& bounds,
                      const RayBundle& bundle, RayLanes rays, const RayRanges& ranges, double tolerance, SearchAim aim,
                      std::array<RayRoot, RayBundle::kWidth>& found) {
  Machine machine(model, program, kSearchSamples, false, scratch_of_thread());
  RayLanes hits = 0;
  for_each_lane(rays, [&](std::size_t lane) {
    const RaySampler sampler(machine, model, bundle.ray(lane), ranges[lane]);
    const RaySearch<float, RaySampler> search(sampler, bounds, tolerance, aim);
    const std::optional<RayRoot> root = search.run(ranges[lane]);
    if (!root) return;
    found[lane] = *root;
    hits |= RayLanes{1} << lane;
  });
  return hits;
}

}  // namespace barkridge
