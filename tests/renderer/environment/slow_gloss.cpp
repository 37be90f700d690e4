#include "tests/renderer/environment/slow_gloss.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace herr::test {
namespace {

constexpr double kPi = glm::pi<double>();

glm::dvec2 place_of(const glm::dvec3& d) {
  return {std::atan2(d.x, -d.z) / (2 * kPi) + 0.5, std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi};
}

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

  double distribution(double n_h) const {
    const double c = n_h * n_h * (alpha2 - 1) + 1;
    return alpha2 / (kPi * c * c);
  }
  glm::dvec3 fresnel(double l_h) const { return f0 + (1.0 - f0) * std::pow(1 - std::min(l_h, 1.0), 5); }
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

PictureDirections::PictureDirections(const EnvironmentImage& picture) : picture_(picture) {
  const int width = picture.width_px, height = picture.height_px;
  double all = 0;
  for (int y = 0; y < height; ++y) {
    const double solid_angle =
        2 * kPi / width * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height));
    double row = 0;
    for (int x = 0; x < width; ++x) {
      // Of the neighbours too: bilinear look-ups carry their light here.
      double bright = 1e-6;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const int column = (x + i + width) % width, line = std::clamp(y + j, 0, height - 1);
          const float* texel =
              picture.rgba.data() + 4 * (static_cast<std::size_t>(line) * static_cast<std::size_t>(width) +
                                         static_cast<std::size_t>(column));
          bright = std::max(bright, double{texel[0]} + double{texel[1]} + double{texel[2]});
        }
      }
      columns_.push_back(row += bright * solid_angle);
    }
    for (int x = 0; x < width; ++x) columns_[columns_.size() - 1 - static_cast<std::size_t>(x)] /= row;
    rows_.push_back(all += row);
  }
  for (double& row : rows_) row /= all;
}

glm::dvec3 PictureDirections::draw(const glm::dvec2& random) const {
  const auto inside = [](auto begin, auto end, double u, double& rest) {
    const auto at = std::min(std::upper_bound(begin, end, u), end - 1);
    const double below = at == begin ? 0 : *(at - 1);
    rest = (u - below) / (*at - below);
    return at - begin;
  };
  double in_row = 0, in_column = 0;
  const auto y = inside(rows_.begin(), rows_.end(), random.y, in_row);
  const auto first = columns_.begin() + y * picture_.width_px;
  const auto x = inside(first, first + picture_.width_px, random.x, in_column);
  const double upper = std::cos(kPi * static_cast<double>(y) / picture_.height_px),
               lower = std::cos(kPi * static_cast<double>(y + 1) / picture_.height_px);
  const double cosine = upper + (lower - upper) * in_row,
               sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double azimuth = 2 * kPi * ((static_cast<double>(x) + in_column) / picture_.width_px - 0.5);
  return {sine * std::sin(azimuth), cosine, -sine * std::cos(azimuth)};
}

double PictureDirections::density(const glm::dvec3& direction) const {
  const glm::dvec2 at = place_of(direction);
  const int width = picture_.width_px, height = picture_.height_px;
  const int x = std::clamp(static_cast<int>(at.x * width), 0, width - 1),
            y = std::clamp(static_cast<int>(at.y * height), 0, height - 1);
  const auto share = [](const std::vector<double>& sums, std::size_t first, int i) {
    const std::size_t at_i = first + static_cast<std::size_t>(i);
    return sums[at_i] - (i == 0 ? 0 : sums[at_i - 1]);
  };
  const double row = share(rows_, 0, y),
               column = share(columns_, static_cast<std::size_t>(y) * static_cast<std::size_t>(width), x);
  return row * column * width / (2 * kPi * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height)));
}

glm::dvec3 PictureDirections::radiance(const glm::dvec3& direction) const {
  const glm::dvec2 at = place_of(direction);
  const int width = picture_.width_px, height = picture_.height_px;
  const double x = at.x * width - 0.5, y = at.y * height - 0.5, left = std::floor(x), upper = std::floor(y);
  glm::dvec3 sum{0.0};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const int column = (static_cast<int>(left) + i + width) % width,
                row = std::clamp(static_cast<int>(upper) + j, 0, height - 1);
      const double weight = (i == 0 ? 1 - (x - left) : x - left) * (j == 0 ? 1 - (y - upper) : y - upper);
      const float* texel =
          picture_.rgba.data() + 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                      static_cast<std::size_t>(column));
      sum += weight * glm::dvec3{texel[0], texel[1], texel[2]};
    }
  }
  return sum;
}

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
  const auto hit = nearest(origin, direction, 1e30);
  if (!hit) return picture ? picture->radiance(direction) : glm::dvec3{0.0};
  if (depth == 3) return glm::dvec3{0.0};
  glm::dvec3 light = from_outside(*hit, seed, depth);
  if (lamp) light += from_lamp(*hit, seed, depth);
  return light;
}

// Everything but the lamp. The highlight is multiplied by 1 + F0 (1 - E) / E, E what it sends back of light
// from all sides with F = 1 (Turquin 2019); below it scatters what it leaves of all light, in its strongest
// channel.
glm::dvec3 SlowGloss::from_outside(const Hit& hit, std::uint32_t seed, int depth) const {
  const int each = depth == 0 ? samples : depth == 1 ? 3 : 1, for_table = depth == 0 ? 512 : 32;
  const Lobe& lobe = hit.lobe;
  double all = 0;
  glm::dvec3 reflected{0.0};
  for (int i = 0; i < for_table; ++i) {
    const glm::dvec3 l = lobe.draw(spread(i, 7, 40));
    if (l.z <= 0) continue;
    const glm::dvec3 h = glm::normalize(l + lobe.v);
    const double weight = lobe.value(l, h.z) / lobe.density(l) / for_table;
    all += weight;
    reflected += weight * lobe.fresnel(glm::dot(l, h));
  }
  const glm::dvec3 gain = 1.0 + lobe.f0 * ((1 - all) / all);
  reflected *= gain;
  const double left = 1 - std::max({reflected.x, reflected.y, reflected.z});
  const bool scatters = hit.diffuse != glm::dvec3{0.0};
  glm::dvec3 sum{0.0};
  const auto take = [&](const glm::dvec3& l, std::uint32_t number) {
    if (l.z <= 0) return;
    const glm::dvec3 h = glm::normalize(l + lobe.v), way = hit.frame.out(l);
    const double density =
        each * (lobe.density(l) + (picture ? picture->density(way) : 0.0) + (scatters ? l.z / kPi : 0.0));
    const glm::dvec3 value =
        gain * lobe.fresnel(glm::dot(l, h)) * lobe.value(l, h.z) + hit.diffuse * (left * l.z / kPi);
    sum += value * arriving(hit.position, way, seed * 747796405u + number, depth + 1) / density;
  };
  for (int i = 0; i < each; ++i) {
    const auto number = static_cast<std::uint32_t>(3 * i);
    take(lobe.draw(spread(i, seed, 0)), number);
    if (picture) take(hit.frame.in(picture->draw(spread(i, seed, 1))), number + 1);
    if (!scatters) continue;
    const glm::dvec2 u = spread(i, seed, 2);
    const double r = std::sqrt(u.x), phi = 2 * kPi * u.y;
    take({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.x)}, number + 2);
  }
  return sum;
}

// Lambert and GGX of the lamp's box, which shines evenly from its volume: points of it, and directions of the
// lobe.
glm::dvec3 SlowGloss::from_lamp(const Hit& hit, std::uint32_t seed, int depth) const {
  const int each = depth == 0 ? 4 * samples : 16;
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
    const glm::dvec2 a = spread(i, seed, 4);
    const double c = random_of(seed, 100u + static_cast<std::uint32_t>(i));
    const glm::dvec3 point = lamp->centre + glm::dvec3(lamp->size) * (glm::dvec3{a, c} - 0.5);
    take(hit.frame.in(glm::normalize(point - hit.position)));
  }
  return sum;
}

}  // namespace herr::test
