#include <array>
#include <cmath>

#include "blobtree/field_model.h"
#include "blobtree/model_cells.h"
#include "blobtree/tree.h"

namespace barkridge {

namespace {

using ModelPtr = std::shared_ptr<const FieldModel>;

// Up to so many primitives, a region gets a program of its own.
constexpr std::size_t kMostAssembled = 256;

// The numbers of the primitives that may matter in a region; nothing where there are too many.
bool find_primitives(const FieldModel& model, const Box& region, std::vector<std::uint32_t>& found) {
  found.clear();
  return model.supports.find(region, kMostAssembled, found);
}

std::vector<std::uint32_t>& primitive_scratch() {
  thread_local std::vector<std::uint32_t> found;
  return found;
}

// A part of a model, in a region where not too many primitives matter.
class PartField final : public Field {
 public:
  /// Writes the program's rest in `box`, and remembers the bounds there, which are asked for next.
  PartField(ModelPtr model, const FieldProgram& program, const Box& support, const Box& box)
      : model_(std::move(model)), box_(box), bounds_(bound(*model_, program, box, &program_)) {
    if (!program_.code.empty()) support_ = intersect(support, box);
    program_.code.shrink_to_fit();
    program_.cones.shrink_to_fit();
  }

  Box support() const override { return support_; }

  void values(std::span<const Vec3> points, std::span<double> values) const override {
    evaluate(*model_, program_, points, values, {});
  }

  void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                            std::span<Vec3> gradients) const override {
    evaluate(*model_, program_, points, values, gradients);
  }

  FieldBounds bounds(const Box& box) const override {
    return box.lo == box_.lo && box.hi == box_.hi ? bounds_ : bound(*model_, program_, box);
  }

  std::shared_ptr<const Field> restricted(const Box& box) const override {
    return std::make_shared<PartField>(model_, program_, support_, box);
  }

  std::unique_ptr<const SurfaceCells> cells() const override { return cells_of(model_, support_); }

  std::size_t primitive_count() const override { return primitive_count_of(program_); }

 private:
  ModelPtr model_;
  FieldProgram program_;
  Box support_;
  Box box_;
  FieldBounds bounds_;
};

// The model where too many primitives matter for one program: everywhere, or in a large region.
class WholeField final : public Field {
 public:
  WholeField(ModelPtr model, const Box& support) : model_(std::move(model)), support_(support) {}

  Box support() const override { return support_; }

  void values(std::span<const Vec3> points, std::span<double> values) const override {
    evaluate_by_parts(points, values, {});
  }

  void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                            std::span<Vec3> gradients) const override {
    evaluate_by_parts(points, values, gradients);
  }

  FieldBounds bounds(const Box& box) const override {
    std::vector<std::uint32_t>& found = primitive_scratch();
    if (!find_primitives(*model_, box, found)) return model_->bounds;
    thread_local FieldProgram program;
    assemble(*model_, found, program);
    return bound(*model_, program, box);
  }

  std::shared_ptr<const Field> restricted(const Box& box) const override {
    std::vector<std::uint32_t>& found = primitive_scratch();
    const bool is_whole = box.contains(support_.lo) && box.contains(support_.hi);
    if (is_whole || !find_primitives(*model_, box, found)) {
      return std::make_shared<WholeField>(model_, intersect(support_, box));
    }
    thread_local FieldProgram program;
    assemble(*model_, found, program);
    return std::make_shared<PartField>(model_, program, support_, box);
  }

  std::unique_ptr<const SurfaceCells> cells() const override { return cells_of(model_, support_); }

  std::size_t primitive_count() const override { return model_->cones.size(); }

 private:
  // Neighbours in a batch are often near each other: one program serves as many of them as few primitives matter to.
  void evaluate_by_parts(std::span<const Vec3> points, std::span<double> values, std::span<Vec3> gradients) const {
    constexpr std::size_t kMostAtOnce = 64;
    constexpr std::size_t kFew = 16;
    std::vector<std::uint32_t>& found = primitive_scratch();
    thread_local FieldProgram program;
    for (std::size_t start = 0; start < points.size();) {
      std::size_t count = std::min(kMostAtOnce, points.size() - start);
      while (true) {
        Box around;
        for (std::size_t i = 0; i < count; ++i) around = unite(around, points[start + i]);
        found.clear();
        if (model_->supports.find(around, count == 1 ? model_->cones.size() : kFew, found)) break;
        count = std::max<std::size_t>(1, count / 8);
      }
      assemble(*model_, found, program);
      evaluate(*model_, program, points.subspan(start, count), values.subspan(start, count),
               gradients.empty() ? gradients : gradients.subspan(start, count));
      start += count;
    }
  }

  ModelPtr model_;
  Box support_;
};

}  // namespace

std::shared_ptr<const Field> compile(const BlobTree& tree) {
  check(tree);
  ModelPtr model = compile_model(tree);
  const Box support = model->support;
  return std::make_shared<WholeField>(std::move(model), support);
}

}  // namespace barkridge
