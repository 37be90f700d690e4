#include "server/inspect/acuity/acuity_json.h"

#include <nlohmann/json.hpp>

#include "server/statistics/latency_json.h"

namespace herr {
namespace {

using Json = nlohmann::ordered_json;

Json gaze_json(const AcuityOfGaze& of) {
  return {{"gaze", of.gaze},
          {"eye", of.eye == Eye::left ? "left" : "right"},
          {"theta_max_deg", of.theta_max_deg},
          {"columns", of.columns},
          {"rows", of.rows},
          {"k_radial_per_deg", of.reached.k_radial},
          {"k_angular_per_deg", of.reached.k_angular},
          {"k_angular_at_deg", of.reached.k_angular_at_deg}};
}

Json curves_json(const std::vector<AcuityPoint>& points) {
  Json theta = Json::array(), asked = Json::array(), radial = Json::array(), angular = Json::array(),
       display = Json::array();
  for (const AcuityPoint& point : points) {
    theta.push_back(point.theta_deg);
    asked.push_back(point.asked);
    radial.push_back(point.radial);
    angular.push_back(point.angular ? Json(*point.angular) : Json());
    display.push_back(point.display > 0 ? Json(point.display) : Json());
  }
  return {{"theta_deg", theta},
          {"acuity_per_deg", asked},
          {"radial_per_deg", radial},
          {"angular_per_deg", angular},
          {"display_per_deg", display}};
}

}  // namespace

Json acuity_json(const AcuityFacts& facts) {
  Json gazes = Json::array();
  for (const AcuityOfGaze& of : facts.gazes) gazes.push_back(gaze_json(of));
  Json json{{"k_asked_per_deg", kAcuityPixelsPerDegree}, {"gazes", gazes}};
  if (facts.frames) {
    json["frames"] = {{"theta_max_deg", distribution_json(facts.frames->theta_max)},
                      {"k_radial_per_deg", distribution_json(facts.frames->k_radial)},
                      {"k_angular_per_deg", distribution_json(facts.frames->k_angular)}};
  } else {
    json["frames"] = nullptr;
  }
  json["straight_ahead"] = curves_json(facts.ahead);
  return json;
}

}  // namespace herr
