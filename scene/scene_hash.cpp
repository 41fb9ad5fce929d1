#include "scene/scene_hash.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <bit>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "base/output_file.h"
#include "scene/scene_keys.h"

namespace barkridge {

namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw std::runtime_error("SHA-256 is not available in the system's libcrypto");
    }
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string hexadecimal() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    return fmt::format("{:02x}", fmt::join(digest.data(), digest.data() + size, ""));
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

// Little-endian on every machine.
void append(std::string& bytes, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(value >> (8 * i));
}
void append(std::string& bytes, double value) { append(bytes, std::bit_cast<std::uint64_t>(value)); }
void append(std::string& bytes, const Vec3& v) {
  append(bytes, v.x);
  append(bytes, v.y);
  append(bytes, v.z);
}

void add_skeleton(Sha256& hash, const Skeleton& skeleton) {
  std::string bytes;
  for (const Internode& internode : skeleton.internodes) {
    bytes.clear();
    append(bytes, internode.base);
    append(bytes, internode.tip);
    append(bytes, internode.base_radius);
    append(bytes, internode.tip_radius);
    append(bytes, static_cast<std::uint64_t>(internode.parent));
    if (internode.ridge != kNoRidge) {
      const Ridge& ridge = skeleton.ridges[static_cast<std::size_t>(internode.ridge)];
      append(bytes, ridge.width);
      append(bytes, ridge.swelling);
    }
    hash.add(bytes);
  }
  for (const CutEnd& end : skeleton.cut_ends) {
    bytes.clear();
    append(bytes, static_cast<std::uint64_t>(end.internode));
    append(bytes, end.normal);
    append(bytes, end.splinters);
    hash.add(bytes);
  }
  for (const Scar& scar : skeleton.scars) {
    bytes.clear();
    append(bytes, static_cast<std::uint64_t>(scar.internode));
    append(bytes, scar.shape.width);
    append(bytes, scar.shape.depth);
    append(bytes, scar.shape.stub);
    hash.add(bytes);
  }
}

bool is_seen(std::string_view key) {
  if (key == "bark.image") return false;  // what stands there is
  for (const std::string_view section :
       {"surface.", "junction.", "ridge", "bend.", "tip", "displacement.", "cut", "scar", "camera.", "sun.", "sky.",
        "ground.", "material.", "bark.", "wood.", "texture."}) {
    if (key.starts_with(section)) return true;
  }
  return false;
}

}  // namespace

std::string scene_hash(const Scene& scene, const Model& model) {
  Sha256 hash;
  hash.add("barkridge scene 1\n");
  for (const SceneKey& key : scene_keys()) {
    const bool fits_camera = scene.turtle.growth.time && key.name == "growth.framed_time";
    if (is_seen(key.name) || fits_camera) hash.add(fmt::format("{} = {}\n", key.name, key.value(scene)));
  }
  if (scene.bark.kind == BarkKind::kImage) hash.add(read_file(scene.bark.image));
  if (scene.model.kind == ModelSource::Kind::kTree) {
    hash.add(to_string(model.tree));
  } else {
    add_skeleton(hash, model.skeleton);
  }
  return hash.hexadecimal();
}

}  // namespace barkridge
