// A light inside a body, on a surface, just above it and in its plane: E = (I / N) sum V cos / max(d^2, r^2),
// r half its longest edge, so that whatever the distance nothing reflects more than albedo / pi * I / r^2;
// and one that lies r above a surface lights it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/study/relations/light/counted_pictures.h"
#include "server/study/relations/light/plain_scene.h"
#include "server/study/relations/light/surface_search.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/study/report/figure_text.h"

namespace herr {
namespace {

constexpr double kPi = 3.14159265358979324;
constexpr int kNearLightSamples = 16;
// So wide that several rays fall where an unlimited falloff would be too bright: within (1e-3)^(1/3) r = 0.1
// r of a light that lies 1e-3 r above a surface.
constexpr double kRadiusOfDistance = 0.125;
constexpr double kAlongAxis = 1 - 1e-9;  // a plane that leaves an axis by 4e-5 is none of it
constexpr double kLeastLit = 0.1;
constexpr double kAboutSpot = 0.25;  // of r, as the eye sees it: 1.8 degrees, which a pixel meets

// A white world without light, and the eye in it.
struct NearScene {
  RelationCase white;
  SurfaceSearch search;
  glm::dvec3 eye, gaze, right, up;

  explicit NearScene(RelationCase world) : white(std::move(world)), search(white.scene) {
    const auto e = static_cast<std::size_t>(white.profile.viewports.front().eye);
    const Pose world_from_eye =
        white.scene.world_from_session * white.sample.head.world_from_head * white.sample.head_from_eye[e];
    eye = world_from_eye.position;
    gaze = white.scene.world_from_session.orientation *
           (white.sample.head.world_from_head.orientation * white.sample.gaze.head_direction[e]);
    right = world_from_eye.orientation * glm::dvec3(1, 0, 0);
    up = world_from_eye.orientation * glm::dvec3(0, 1, 0);
  }

  NearScene(const NearScene&) = delete;  // the search is one of `white`
  NearScene& operator=(const NearScene&) = delete;

  std::optional<SeenSpot> beside(const glm::dvec3& way, double tangent, int turn) const {
    const double angle = kPi / 4 * turn;
    return search.first_along(
        {eye, glm::normalize(way + tangent * (std::cos(angle) * right + std::sin(angle) * up))});
  }
};

// The pixel of a viewport in which its eye sees a place.
std::optional<glm::ivec2> pixel_of(const NearScene& near, const Viewport& viewport, const glm::dvec3& place) {
  const glm::dvec3 way = place - near.eye;
  const double ahead = glm::dot(way, glm::cross(near.up, near.right));
  if (viewport.eye != near.white.profile.viewports.front().eye || !(ahead > 0)) return std::nullopt;
  const double x = (glm::dot(way, near.right) / ahead - viewport.tan_left) /
                   (viewport.tan_right - viewport.tan_left),
               y = (viewport.tan_up - glm::dot(way, near.up) / ahead) / (viewport.tan_up - viewport.tan_down);
  if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) return std::nullopt;
  return glm::ivec2(static_cast<int>(x * viewport.width_px), static_cast<int>(y * viewport.height_px));
}

bool is_in_view(const NearScene& near, const glm::dvec3& place) {
  const std::vector<Viewport>& viewports = near.white.profile.viewports;
  return std::any_of(viewports.begin(), viewports.end(),
                     [&](const Viewport& viewport) { return pixel_of(near, viewport, place).has_value(); });
}

// The brightest of 9 pixels about a place, in the viewport where it is darkest.
double seen_at(const NearScene& near, const std::vector<LinearPicture>& pictures, const glm::dvec3& place) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < pictures.size(); ++v) {
    const auto pixel = pixel_of(near, near.white.profile.viewports[v], place);
    if (!pixel) continue;
    double brightest = 0;
    for (int y = std::max(0, pixel->y - 1); y < std::min(pictures[v].height_px, pixel->y + 2); ++y) {
      for (int x = std::max(0, pixel->x - 1); x < std::min(pictures[v].width_px, pixel->x + 2); ++x) {
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(pictures[v].width_px) +
                       static_cast<std::size_t>(x);
        brightest = std::max(brightest, double{pictures[v].plane[1][i]});
      }
    }
    least = std::min(least, brightest);
  }
  return least;
}

// Looks where the gaze of the first viewport's eye goes, then farther and farther around it, for a surface in
// view that is not seen at a grazing angle and that will do.
std::optional<SeenSpot> seen_spot(const NearScene& near,
                                  const std::function<bool(const SeenSpot&)>& will_do) {
  for (const double tangent : {0.0, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0}) {
    for (int turn = 0; turn < (tangent > 0 ? 8 : 1); ++turn) {
      const auto spot = near.beside(near.gaze, tangent, turn);
      if (!spot || !(glm::dot(spot->normal, glm::normalize(spot->place - near.eye)) < -0.3)) continue;
      if (is_in_view(near, spot->place) && will_do(*spot)) return spot;
    }
  }
  return std::nullopt;
}

// I = pi r^2 W/sr: white surfaces send back 1 at most.
AreaLight light_at(const glm::dvec3& centre, const glm::vec3& size) {
  AreaLight light;
  light.name = "near";
  light.centre = centre;
  light.size = size;
  const double r = 0.5 * double{std::max({size.x, size.y, size.z})};
  light.intensity_w_sr = glm::vec3(static_cast<float>(kPi * r * r));
  return light;
}

struct NearPlace {
  const char* name;
  AreaLight light;
};

double radius_at(const SeenSpot& spot) {
  return kRadiusOfDistance * spot.distance_m;
}

std::vector<NearPlace> near_places(const SeenSpot& spot) {
  const double r = radius_at(spot);
  const glm::vec3 cube(static_cast<float>(2 * r));
  return {{"just above a surface", light_at(spot.place + 1e-3 * r * spot.normal, cube)},
          {"on a surface", light_at(spot.place, cube)},
          {"inside a body", light_at(spot.place - r * spot.normal, cube)}};
}

// The axis of the world along which a normal lies; lights have no thickness along an axis alone.
std::optional<int> axis_along(const glm::dvec3& normal) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(normal[axis]) > kAlongAxis) return axis;
  }
  return std::nullopt;
}

std::vector<NearPlace> place_in_plane(const SeenSpot& spot) {
  glm::vec3 flat(static_cast<float>(2 * radius_at(spot)));
  flat[axis_along(spot.normal).value()] = 0;
  return {{"in the plane of a surface", light_at(spot.place, flat)}};
}

// One light in a white world.
RelationCase white_world(const RelationCase& subject) {
  RelationCase white = hard_light(subject);
  show_plainly(white);
  paint_all(white.scene, 1);
  take_catchers_away(white.scene);
  stop_emission(white.scene);
  make_environment_black(white.scene);
  white.scene.ambient = glm::vec3(0.0f);
  return white;
}

std::vector<LinearPicture> at_most_one(std::vector<LinearPicture> pictures) {
  for (LinearPicture& picture : pictures) limit_to_white(picture);
  return pictures;
}

Relation stays_below(std::string name, const std::string& light) {
  Relation relation;
  relation.name = std::move(name);
  relation.holds =
      "a light " + light +
      " a white surface: nothing is brighter than 1 / pi * I / r^2, r half its longest edge, with "
      "1 and 16 samples";
  relation.bound = 0x1p-10;
  relation.unit = "of I / (pi r^2), beyond it";
  relation.bound_from =
      "E = (I / N) sum V cos / max(d^2, r^2) <= I / r^2; sample and pixel are rounded to half floats";
  return relation;
}

void measure_below(const Relation& relation, RelationCase white, std::span<const NearPlace> places,
                   CountedPictures& counted, RelationLog& log) {
  double brightest = -1;
  std::string where;
  std::optional<RelationPictures> pictures;
  for (const int samples : {1, kNearLightSamples}) {
    white.settings.light_samples = samples;
    white.scene.lights = {places[0].light};
    const auto renderer = renderer_of(white);
    for (const NearPlace& near : places) {
      white.state.lights = {near.light};
      const std::vector<LinearPicture> got = counted.next(*renderer, white), wanted = at_most_one(got);
      const double largest = largest_value(got);
      if (largest <= brightest) continue;
      brightest = largest;
      const PictureDistance beyond = largest_relative(got, wanted, 1, white.profile);
      where = std::string(near.name) + ", " + std::to_string(samples) +
              (samples == 1 ? " sample: " : " samples: ") + figure(brightest) + " of I / (pi r^2)" +
              (beyond.where.empty() ? "" : ", " + beyond.where);
      pictures = worst_pictures(beyond, got, wanted, "got | limited to I / (pi r^2) | difference");
    }
  }
  log.measured(relation, std::max(0.0, brightest - 1), where, std::move(pictures));
}

// What the darkest of 9 points about a spot sends back of a light at `centre`, in I / (pi r^2): 0 where one
// of them is in shadow, or is shaded by another normal than it lies.
double least_lit(const NearScene& near, const SeenSpot& spot, const glm::dvec3& centre) {
  const double r = radius_at(spot);
  double least = 1;
  for (int turn = 0; turn < 9; ++turn) {
    const auto point = near.beside((spot.place - near.eye) / spot.distance_m,
                                   turn < 8 ? kAboutSpot * kRadiusOfDistance : 0, turn);
    if (!point || !point->shaded_as_it_lies || !near.search.is_open(*point, centre)) return 0;
    const glm::dvec3 way = centre - point->place;
    const double square = glm::dot(way, way), cosine = glm::dot(point->normal, way) / std::sqrt(square);
    least = std::min(least, cosine * r * r / std::max(square, r * r));
  }
  return std::max(least, 0.0);
}

// The light of one sample, so that it is all at its centre.
void measure_lit(const NearScene& near, CountedPictures& counted, RelationLog& log) {
  Relation relation;
  relation.name = "light above a surface lights it";
  relation.holds = "a light half its edge above an open white surface is seen on it";
  relation.bound = 0.5;
  relation.unit = "of what the surface sends back, missing";
  relation.bound_from =
      "the darkest of 9 points within 1.8 degrees, none in shadow, by E = I cos / max(d^2, r^2); pixels that "
      "mix samples keep half of it";
  const auto centre_of = [](const SeenSpot& spot) { return spot.place + radius_at(spot) * spot.normal; };
  const auto spot = seen_spot(near, [&](const SeenSpot& candidate) {
    return least_lit(near, candidate, centre_of(candidate)) > kLeastLit;
  });
  if (!spot) return log.not_applicable(relation, "no open surface is seen around the gaze");
  const double wanted = least_lit(near, *spot, centre_of(*spot));
  RelationCase white = near.white;
  white.state.lights =
      white.scene.lights = {light_at(centre_of(*spot), glm::vec3(static_cast<float>(2 * radius_at(*spot))))};
  const double seen = seen_at(near, counted.of(white), spot->place);
  log.measured(relation, std::max(0.0, 1 - seen / wanted),
               figure(seen) + " of I / (pi r^2), of " + figure(wanted) + " or more");
}

}  // namespace

void measure_light_near(const RelationCase& subject, RelationLog& log) {
  const Relation anywhere = stays_below("light near a surface stays below I / r^2",
                                        "inside, on and 1e-3 of its radius above"),
                 in_plane = stays_below("light in the plane of a surface stays below I / r^2",
                                        "without thickness in the plane of"),
                 numbers = only_numbers("light near a surface gives numbers",
                                        "lights inside, on, above and in the plane of a surface give finite "
                                        "values and rays");
  const NearScene near(white_world(subject));
  CountedPictures counted;
  const auto any = seen_spot(near, [](const SeenSpot&) { return true; });
  if (any) {
    measure_below(anywhere, near.white, near_places(*any), counted, log);
  } else {
    log.not_applicable(anywhere, "no surface is seen around the gaze");
  }
  const auto along =
      seen_spot(near, [](const SeenSpot& spot) { return axis_along(spot.normal).has_value(); });
  if (along) {
    measure_below(in_plane, near.white, place_in_plane(*along), counted, log);
  } else {
    log.not_applicable(in_plane, "no surface seen around the gaze lies along the axes that lights have");
  }
  measure_lit(near, counted, log);
  if (any) return log.measured(numbers, counted.no_numbers());
  log.not_applicable(numbers, "no surface is seen around the gaze");
}

}  // namespace herr
