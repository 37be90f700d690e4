// Records of relations for tests of their reports.
#pragma once

#include <limits>
#include <string>
#include <utility>

#include "server/study/stability/report/stability_record.h"

namespace herr::test {

inline RelationResult result_of(std::string name, double error, double bound) {
  RelationResult result;
  result.group = "light";
  result.relation.name = std::move(name);
  result.relation.holds = "what must hold of " + result.relation.name;
  result.relation.bound = bound;
  result.relation.unit = "largest relative difference";
  result.relation.bound_from = "each value is rounded once";
  result.error = error;
  result.seconds = 0.25;
  return result;
}

// 4 x 2 pixels, grey, but for one that is `got` and ought to be `wanted`.
inline RelationPictures pictures_of(float got, float wanted) {
  RelationPictures pictures;
  pictures.caption = "got | wanted | difference";
  for (LinearPicture* picture : {&pictures.got, &pictures.wanted}) {
    picture->width_px = 4, picture->height_px = 2;
    for (auto& plane : picture->plane) plane.assign(8, 0.25f);
  }
  for (auto& plane : pictures.got.plane) plane[5] = got;
  for (auto& plane : pictures.wanted.plane) plane[5] = wanted;
  return pictures;
}

// One of each verdict, of two groups: three hold, three fail, one fails of what is off, one is not asked.
inline StabilityRecord rich_stability() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  StabilityRecord record;
  record.program = "herr 0.1";
  record.command_line = "herr study --stability s --scene room.scene.json";
  record.session = "walk", record.scene = "room", record.profile = "xr1-half";
  record.cpu = "a processor", record.isa = "avx2", record.triangles = 1380, record.threads = 2;
  record.settings = "polar 394x192, light samples 1", record.viewports = "left 123x123";
  record.frame = {101, 1.0 / 3, 13.1, 9.9};
  record.seconds = 61.4;
  record.results = {result_of("quiet", 0, 0), result_of("near its limit", 0.83e-3, 1e-3),
                    result_of("half way", 0.5, 1.0), result_of("too large", 0.1 + 0.2, 0.1)};
  record.results[1].relation.kind = RelationKind::statistical;
  record.results[3].where = "left, pixel (3, 5): 0.3 instead of 0.2";
  RelationResult off = result_of("adaptive mean", 9, 4);
  off.relation.option = "adaptive light samples";
  RelationResult absent = result_of("sum of lights", 0, 1e-5);
  absent.not_applicable = "the scene has one light";
  record.results.insert(record.results.end(),
                        {off, absent, result_of("no number", std::numeric_limits<double>::quiet_NaN(), 1),
                         result_of("beyond all", kInfinity, 1)});
  for (std::size_t i = 4; i < record.results.size(); ++i) record.results[i].group = "samples";
  record.pictures = {
      {"light: too large", "what it looks like", 3, 2, {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}}};
  record.warnings = {"the session was cut off"};
  return record;
}

inline StabilityRecord hostile_stability() {
  const std::string name = "<script>alert('x')</script>\"&\n\x1b[2J\xff";
  StabilityRecord record = rich_stability();
  record.session = record.scene = record.profile = record.settings = record.command_line = name;
  record.warnings = {name};
  for (RelationResult& result : record.results) {
    result.group = result.relation.name = result.relation.unit = result.relation.bound_from = name;
    result.relation.holds = result.where = name;
    if (!result.relation.option.empty()) result.relation.option = name;
    if (!result.not_applicable.empty()) result.not_applicable = name;
  }
  record.pictures.front().title = record.pictures.front().caption = name;
  return record;
}

}  // namespace herr::test
