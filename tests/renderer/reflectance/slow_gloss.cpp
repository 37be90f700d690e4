#include "tests/renderer/reflectance/slow_gloss.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace herr::test {
namespace {

constexpr double kPi = glm::pi<double>();

double random_of(std::uint32_t seed, std::uint32_t counter) {
  std::uint64_t h = (std::uint64_t{seed} << 32 | counter) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 32)) * 0x94d049bb133111ebu;
  return static_cast<double>((h ^ (h >> 31)) >> 11) * 0x1p-53;
}

// Place i of the R2 sequence (Roberts, 2018), turned by a random number of the seed and kind.
glm::dvec2 spread(int i, std::uint32_t seed, std::uint32_t kind) {
  const double x = random_of(seed, 2 * kind) + 0.7548776662466927 * i,
               y = random_of(seed, 2 * kind + 1) + 0.5698402909980532 * i;
  return {x - std::floor(x), y - std::floor(y)};
}

// The same in three dimensions: of the R3 sequence.
glm::dvec3 spread3(int i, std::uint32_t seed, std::uint32_t kind) {
  const auto at = [&](std::uint32_t axis, double step) {
    const double x = random_of(seed, 100 + 3 * kind + axis) + step * i;
    return x - std::floor(x);
  };
  return {at(0, 0.8191725133961645), at(1, 0.6710436067037893), at(2, 0.5497004779019703)};
}

struct Frame {
  glm::dvec3 t, b, n;
  glm::dvec3 out(const glm::dvec3& local) const { return t * local.x + b * local.y + n * local.z; }
  glm::dvec3 in(const glm::dvec3& d) const { return {glm::dot(t, d), glm::dot(b, d), glm::dot(n, d)}; }
};
Frame frame_of(const glm::dvec3& n) {
  const glm::dvec3 side = std::abs(n.x) < 0.6 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0};
  const glm::dvec3 t = glm::normalize(glm::cross(n, side));
  return {t, glm::cross(n, t), n};
}

// The surface at one place, seen from `v`; all in the frame of the normal.
struct Lobe {
  glm::dvec3 v, f0;
  double alpha, alpha2;

  void widen(double least_alpha) {
    alpha = std::max(alpha, least_alpha);
    alpha2 = alpha * alpha;
  }
  double distribution(double n_h) const {
    const double c = n_h * n_h * (alpha2 - 1) + 1;
    return alpha2 / (kPi * c * c);
  }
  glm::dvec3 fresnel(double l_h) const {
    const double k = 1 - std::min(l_h, 1.0), k2 = k * k;
    return f0 + (1.0 - f0) * (k2 * k2 * k);
  }
  // Heitz's density of visible normals over 4 l.h.
  double density(const glm::dvec3& l) const {
    const glm::dvec3 h = glm::normalize(l + v);
    const double masked = 2 / (v.z + std::sqrt(alpha2 + (1 - alpha2) * v.z * v.z));  // G1 / n.v
    return masked * distribution(h.z) / 4;
  }
  // GGX x cosine, joint visibility by Hammon, without Fresnel.
  double value(const glm::dvec3& l, double n_h) const {
    const double visibility = 0.5 / (alpha * (l.z + v.z) + (1 - alpha) * 2 * l.z * v.z);
    return distribution(n_h) * visibility * l.z;
  }
  glm::dvec3 draw(const glm::dvec2& u) const {
    const glm::dvec3 vh = glm::normalize(glm::dvec3{alpha * v.x, alpha * v.y, v.z});
    const double across2 = vh.x * vh.x + vh.y * vh.y;
    const glm::dvec3 t1 = across2 > 0 ? glm::dvec3{-vh.y, vh.x, 0} / std::sqrt(across2) : glm::dvec3{1, 0, 0};
    const glm::dvec3 t2 = glm::cross(vh, t1);
    const double r = std::sqrt(u.x), phi = 2 * kPi * u.y, p1 = r * std::cos(phi), s = 0.5 * (1 + vh.z);
    const double p2 = (1 - s) * std::sqrt(1 - p1 * p1) + s * r * std::sin(phi);
    const glm::dvec3 nh = t1 * p1 + t2 * p2 + vh * std::sqrt(std::max(0.0, 1 - p1 * p1 - p2 * p2));
    const glm::dvec3 h = glm::normalize(glm::dvec3{alpha * nh.x, alpha * nh.y, std::max(0.0, nh.z)});
    return 2 * glm::dot(v, h) * h - v;
  }
};

// Integral of t^2 / max(t^2, r^2) along the chord that a ray cuts through the lamp, and of t^2.
struct Chord {
  double light = 0, square = 0;
  double begin = 0;
};
Chord chord_of(const AreaLight& lamp, const glm::dvec3& from, const glm::dvec3& d) {
  double begin = 0, end = 1e30;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = 0.5 * lamp.size[axis], at = lamp.centre[axis] - from[axis];
    const double a = (at - half) / d[axis], b = (at + half) / d[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (end <= begin) return {};
  const auto cube = [](double x) { return x * x * x; };
  const double r = 0.5 * std::max({lamp.size.x, lamp.size.y, lamp.size.z}),
               near_end = std::clamp(r, begin, end);
  return {(cube(near_end) - cube(begin)) / (3 * r * r) + end - near_end, (cube(end) - cube(begin)) / 3,
          begin};
}

double volume_of(const AreaLight& lamp) {
  return double{lamp.size.x} * double{lamp.size.y} * double{lamp.size.z};
}

}  // namespace

struct SlowGloss::Hit {
  const GlossBall* ball = nullptr;
  double distance = 0;
  glm::dvec3 position;
  Frame frame;
  Lobe lobe;
  glm::dvec3 diffuse;
};

std::optional<SlowGloss::Hit> SlowGloss::nearest(const glm::dvec3& origin, const glm::dvec3& direction,
                                                 double farthest) const {
  Hit hit;
  hit.distance = farthest;
  for (const GlossBall& ball : balls) {
    const glm::dvec3 off = origin - ball.centre;
    const double b = glm::dot(off, direction), c = glm::dot(off, off) - ball.radius * ball.radius;
    const double inside = b * b - c;
    if (inside <= 0) continue;
    const double t = -b - std::sqrt(inside);
    if (t > 1e-6 * ball.radius && t < hit.distance) hit.distance = t, hit.ball = &ball;
  }
  if (hit.ball == nullptr) return std::nullopt;
  hit.position = origin + hit.distance * direction;
  hit.frame = frame_of(glm::normalize(hit.position - hit.ball->centre));
  const double metal = hit.ball->metallic, alpha = std::max(hit.ball->roughness * hit.ball->roughness, 1e-3);
  const glm::dvec3 f0 = glm::dvec3{0.04} * (1 - metal) + hit.ball->base * metal;
  hit.lobe = {hit.frame.in(-direction), f0, alpha, alpha * alpha};
  hit.diffuse = hit.ball->base * (1 - metal);
  return hit;
}

glm::dvec3 SlowGloss::radiance(const glm::dvec3& origin, const glm::dvec3& direction,
                               std::uint32_t seed) const {
  return arriving(origin, direction, seed, 0);
}

glm::dvec3 SlowGloss::arriving(const glm::dvec3& origin, const glm::dvec3& direction, std::uint32_t seed,
                               int depth) const {
  auto hit = nearest(origin, direction, 1e30);
  if (!hit) return sky ? sky->whole.radiance(direction) : glm::dvec3{0.0};
  if (depth == 3) return glm::dvec3{0.0};
  // What other balls send is a hundredth of the light: their lobes are widened so that no lamp in them is
  // found by chance alone (Kaplanyan & Dachsbacher, "Path Space Regularization", 2013).
  if (depth > 0) hit->lobe.widen(0.2);
  glm::dvec3 light = from_outside(*hit, seed, depth);
  if (lamp) light += from_lamp(*hit, seed, depth);
  return light;
}

// Everything but the lamp. The highlight is multiplied by 1 + F0 (1 - E) / E, E what it sends back of light
// from all sides with F = 1 (Turquin 2019); below it scatters what it leaves of all light, in its strongest
// channel. Roughness 0 is a mirror: E = 1.
SlowGloss::Scattering SlowGloss::scattering_of(const Hit& hit, int depth) const {
  const int for_table = depth == 0 ? 512 : 32;
  const Lobe& lobe = hit.lobe;
  Scattering out;
  out.mirror = sky != nullptr && depth == 0 && hit.ball->roughness == 0;
  out.gain = glm::dvec3{1.0};
  glm::dvec3 reflected = lobe.fresnel(lobe.v.z);
  if (!out.mirror) {
    double all = 0;
    reflected = glm::dvec3{0.0};
    for (int i = 0; i < for_table; ++i) {
      const glm::dvec3 l = lobe.draw(spread(i, 7, 40));
      if (l.z <= 0) continue;
      const glm::dvec3 h = glm::normalize(l + lobe.v);
      const double weight = lobe.value(l, h.z) / lobe.density(l) / for_table;
      all += weight;
      reflected += weight * lobe.fresnel(glm::dot(l, h));
    }
    out.gain = 1.0 + lobe.f0 * ((1 - all) / all);
    reflected *= out.gain;
  }
  const double left = 1 - std::max({reflected.x, reflected.y, reflected.z});
  out.diffuse = hit.diffuse * (left / kPi);
  return out;
}

// Of light from `l`, in the frame of the normal, per irradiance of a surface that faces it.
glm::dvec3 SlowGloss::sent_back(const Hit& hit, const Scattering& by, const glm::dvec3& l) const {
  if (by.mirror) return by.diffuse * l.z;
  const glm::dvec3 h = glm::normalize(l + hit.lobe.v);
  return by.gain * hit.lobe.fresnel(glm::dot(l, h)) * hit.lobe.value(l, h.z) + by.diffuse * l.z;
}

glm::dvec3 SlowGloss::from_outside(const Hit& hit, std::uint32_t seed, int depth) const {
  const int each = depth == 0 ? samples : depth == 1 ? 3 : 1;
  const Lobe& lobe = hit.lobe;
  const Scattering by = scattering_of(hit, depth);
  const bool scatters = hit.diffuse != glm::dvec3{0.0};
  // What the eye sees is lit by each bright texel apart: drawn directions find the rest of the picture.
  const bool apart = sky != nullptr && depth == 0;
  const PictureDirections* drawn = sky == nullptr ? nullptr : apart ? &sky->rest : &sky->whole;
  glm::dvec3 sum{0.0};
  const auto light = [&](const glm::dvec3& way, std::uint32_t number) {
    if (apart && !nearest(hit.position, way, 1e30)) return sky->rest.radiance(way);
    return arriving(hit.position, way, seed * 747796405u + number, depth + 1);
  };
  const auto take = [&](const glm::dvec3& l, std::uint32_t number) {
    if (l.z <= 0) return;
    const glm::dvec3 way = hit.frame.out(l);
    const double density = each * ((by.mirror ? 0.0 : lobe.density(l)) + (drawn ? drawn->density(way) : 0.0) +
                                   (scatters ? l.z / kPi : 0.0));
    sum += sent_back(hit, by, l) * light(way, number) / density;
  };
  for (int i = 0; i < each; ++i) {
    const auto number = static_cast<std::uint32_t>(3 * i);
    if (!by.mirror) take(lobe.draw(spread(i, seed, 0)), number);
    if (by.mirror && !scatters) break;
    if (drawn) take(hit.frame.in(drawn->draw(spread(i, seed, 1))), number + 1);
    if (!scatters) continue;
    const glm::dvec2 u = spread(i, seed, 2);
    const double r = std::sqrt(u.x), phi = 2 * kPi * u.y;
    take({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.x)}, number + 2);
  }
  if (by.mirror) {
    const glm::dvec3 way = hit.frame.out({-lobe.v.x, -lobe.v.y, lobe.v.z});
    sum += lobe.fresnel(lobe.v.z) * arriving(hit.position, way, seed * 747796405u + 5u, depth + 1);
  }
  return apart ? sum + from_bright_texels(hit, by) : sum;
}

// Sums over the bright texels. Where the lobe bends over a texel, over many points of it: half vectors turn
// by half of what directions do, q = off^2 + alpha^2 of GGX's 1 / q^2 changes by 16 / q of it, and the mean
// square of a tent of height h is h^2 / 24 there along each axis.
glm::dvec3 SlowGloss::from_bright_texels(const Hit& hit, const Scattering& by) const {
  const double texel2 = sky->texel_rad * sky->texel_rad;
  glm::dvec3 sum{0.0};
  std::vector<SlowSky::Point> points;
  for (const BrightTexel& texel : sky->bright) {
    const glm::dvec3 l = hit.frame.in(texel.direction);
    if (l.z < -1.5 * sky->texel_rad) continue;
    if (nearest(hit.position, texel.direction, 1e30)) continue;
    const double h_z = glm::normalize(l + hit.lobe.v).z, q = 1 - h_z * h_z + hit.lobe.alpha2;
    const bool even = by.mirror || q > 70 * texel2;
    if (even && l.z > 1.5 * sky->texel_rad) {
      sum += sent_back(hit, by, l) * texel.radiance * texel.solid_angle;
      continue;
    }
    sky->points_of(texel, even || q > 6 * texel2 ? 4 : 16, points);
    for (const SlowSky::Point& point : points) {
      const glm::dvec3 of_point = hit.frame.in(point.direction);
      if (of_point.z <= 0) continue;
      sum += sent_back(hit, by, of_point) * texel.radiance * point.solid_angle;
    }
  }
  return sum;
}

// Lambert and GGX of the lamp's box, which shines evenly from its volume: points of it, and directions of the
// lobe.
glm::dvec3 SlowGloss::from_lamp(const Hit& hit, std::uint32_t seed, int depth) const {
  const int each = depth == 0 ? 2 * samples : 16;
  const Lobe& lobe = hit.lobe;
  const double volume = volume_of(*lamp);
  glm::dvec3 sum{0.0};
  const auto take = [&](const glm::dvec3& l) {
    if (l.z <= 0) return;
    const glm::dvec3 way = hit.frame.out(l);
    const Chord chord = chord_of(*lamp, hit.position, way);
    if (chord.light <= 0 || nearest(hit.position, way, chord.begin)) return;
    const glm::dvec3 h = glm::normalize(l + lobe.v);
    const double density = each * (lobe.density(l) + chord.square / volume);
    const glm::dvec3 value = lobe.fresnel(glm::dot(l, h)) * lobe.value(l, h.z) + hit.diffuse * (l.z / kPi);
    sum += value * glm::dvec3(lamp->intensity_w_sr) * (chord.light / volume / density);
  };
  for (int i = 0; i < each; ++i) {
    take(lobe.draw(spread(i, seed, 3)));
    const glm::dvec3 point = lamp->centre + glm::dvec3(lamp->size) * (spread3(i, seed, 4) - 0.5);
    take(hit.frame.in(glm::normalize(point - hit.position)));
  }
  return sum;
}

}  // namespace herr::test
