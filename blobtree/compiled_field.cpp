#include "blobtree/field_program.h"
#include "blobtree/operator_bounds.h"

namespace barkridge {

namespace {

class CompiledField final : public Field {
 public:
  CompiledField(FieldProgram program, const Box& support)
      : program_(std::move(program)), depth_(depth_of(program_)), support_(program_.code.empty() ? Box{} : support) {}

  Box support() const override { return support_; }

  void values(std::span<const Vec3> points, std::span<double> values) const override {
    evaluate(program_, depth_, points, values, {});
  }

  void values_and_gradients(std::span<const Vec3> points, std::span<double> values,
                            std::span<Vec3> gradients) const override {
    evaluate(program_, depth_, points, values, gradients);
  }

  FieldBounds bounds(const Box& box) const override { return bound(program_, box); }

  std::shared_ptr<const Field> restricted(const Box& box) const override {
    FieldProgram rest{program_.data, {}};
    bound(program_, box, &rest.code);
    rest.code.shrink_to_fit();
    return std::make_shared<CompiledField>(std::move(rest), intersect(support_, box));
  }

  std::size_t primitive_count() const override {
    std::size_t count = 0;
    for (const FieldInstruction& instruction : program_.code) {
      count += instruction.op == FieldInstruction::Op::kCone || instruction.op == FieldInstruction::Op::kFadedCone ||
               instruction.op == FieldInstruction::Op::kOther;
    }
    return count;
  }

 private:
  FieldProgram program_;
  FieldProgramDepth depth_;
  Box support_;
};

}  // namespace

std::shared_ptr<const Field> compile(const BlobTree& tree) {
  check(tree);
  const Box support = tree.nodes.empty() ? Box{} : supports_of(tree)[tree.root];
  return std::make_shared<CompiledField>(compile_program(tree), support);
}

}  // namespace barkridge
