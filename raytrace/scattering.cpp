#include "raytrace/scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace barkridge {

namespace {

constexpr double kPi = std::numbers::pi;
// Sharper lobes than the sun's own image would only make noise.
constexpr double kLeastAlpha = 1e-3;

double fresnel(double specular, double cosine) {
  const double x = 1 - std::clamp(cosine, 0.0, 1.0), x2 = x * x;
  return specular + (1 - specular) * x2 * x2 * x;
}

// GGX's density of facet normals.
double facet_density(double alpha, double cosine) {
  const double a2 = alpha * alpha, d = cosine * cosine * (a2 - 1) + 1;
  return a2 / (kPi * d * d);
}

// sqrt(alpha^2 + (1 - alpha^2) cosine^2), on which Smith's terms rest.
double smith_root(double alpha, double cosine) {
  return std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine);
}

// Density of the directions that `sample_facet` leads to.
double lobe_density(double alpha, double normal_view, double normal_half) {
  return facet_density(alpha, normal_half) / (2 * (normal_view + smith_root(alpha, normal_view)));
}

// A facet normal as seen from `view`, both in the frame whose z is the surface's normal.
// [Heitz 2018, "Sampling the GGX Distribution of Visible Normals"]
Vec3 sample_facet(double alpha, const Vec3& view, const glm::dvec2& u) {
  const Vec3 stretched = glm::normalize(Vec3(alpha * view.x, alpha * view.y, view.z));
  Vec3 across, along;
  complete_frame(stretched, across, along);
  // A disc across the stretched view, of which the part beyond the surface's horizon is squeezed away. `across` must
  // lie in the horizontal plane for that.
  const double flat = stretched.x * stretched.x + stretched.y * stretched.y;
  if (flat > 0) {
    across = Vec3(-stretched.y, stretched.x, 0) / std::sqrt(flat);
    along = glm::cross(stretched, across);
  }
  const double radius = std::sqrt(u.x), turn = 2 * kPi * u.y, s = 0.5 * (1 + stretched.z);
  const double x = radius * std::cos(turn);
  const double y = (1 - s) * std::sqrt(std::max(0.0, 1 - x * x)) + s * radius * std::sin(turn);
  const Vec3 facet = x * across + y * along + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
  return glm::normalize(Vec3(alpha * facet.x, alpha * facet.y, std::max(1e-9, facet.z)));
}

Vec3 sample_cosine(const glm::dvec2& u) {
  const double radius = std::sqrt(u.x), turn = 2 * kPi * u.y;
  return {radius * std::cos(turn), radius * std::sin(turn), std::sqrt(std::max(0.0, 1 - u.x))};
}

}  // namespace

Scattering::Scattering(const Material& material)
    : material_(material),
      diffuse_((1 - material.specular) / kPi * material.color),
      alpha_(std::max(material.roughness * material.roughness, kLeastAlpha)) {}

Color Scattering::evaluate(const Vec3& normal, const Vec3& view, const Vec3& light) const {
  const double normal_view = glm::dot(normal, view), normal_light = glm::dot(normal, light);
  if (normal_view <= 0 || normal_light <= 0) return Color(0);
  Color result = diffuse_;
  if (material_.specular > 0) {
    const Vec3 half = glm::normalize(view + light);
    const double visible =
        0.5 / (normal_light * smith_root(alpha_, normal_view) + normal_view * smith_root(alpha_, normal_light));
    result += Color(facet_density(alpha_, glm::dot(normal, half)) * visible *
                    fresnel(material_.specular, glm::dot(view, half)));
  }
  return normal_light * result;
}

std::optional<ScatteredDirection> Scattering::sample(const Vec3& normal, const Vec3& view, const glm::dvec2& u,
                                                     double choice) const {
  Vec3 across, along;
  complete_frame(normal, across, along);
  const double normal_view = glm::dot(normal, view);
  if (normal_view <= 0) return std::nullopt;

  double lobe_share = 0;
  if (material_.specular > 0) {
    const double mirrored = fresnel(material_.specular, normal_view);
    const double scattered = (material_.color.x + material_.color.y + material_.color.z) / 3;
    lobe_share = std::clamp(mirrored / (mirrored + scattered), 0.1, 0.9);
  }
  Vec3 light;
  if (choice < lobe_share) {
    const Vec3 facet = sample_facet(alpha_, {glm::dot(view, across), glm::dot(view, along), normal_view}, u);
    const Vec3 half = facet.x * across + facet.y * along + facet.z * normal;
    light = 2 * glm::dot(view, half) * half - view;
  } else {
    const Vec3 local = sample_cosine(u);
    light = local.x * across + local.y * along + local.z * normal;
  }
  light = glm::normalize(light);
  const double normal_light = glm::dot(normal, light);
  if (normal_light <= 0) return std::nullopt;
  const Vec3 half = glm::normalize(view + light);
  double density = (1 - lobe_share) * normal_light / kPi;
  if (lobe_share > 0) density += lobe_share * lobe_density(alpha_, normal_view, glm::dot(normal, half));
  return ScatteredDirection{light, evaluate(normal, view, light) / density};
}

}  // namespace barkridge
