// Odd triangles and voxels change nothing: duplicates, triangles without area, needles, corners far away,
// huge floors; voxels of 1e-4 m and of 1e4 m.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "renderer/frame_plan.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/place/similar_case.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/study/relations/rounding_share.h"
#include "server/study/relations/triangles/odd_triangles.h"

namespace herr {
namespace {

constexpr double kFewPixels = 1e-3;

// Shadows, occlusion and second rays start on these triangles; full meshes, since a mesh that reaches
// elsewhere is coarsened elsewhere.
RelationCase lit_case(const RelationCase& subject) {
  RelationCase lit = soft_light(subject, 4);
  lit.settings.occlusion_rays = 1;
  lit.settings.detail_error = 0;
  return lit;
}

class TriangleRelations {
 public:
  TriangleRelations(const DrawPicture& draw, const RelationCase& subject, RelationLog& log)
      : draw_(draw), subject_(lit_case(subject)), log_(log) {}

  void measure() {
    const bool any = !rigid_meshes(subject_.scene).empty();
    if (any) wanted_ = draw_(subject_);
    measure_duplicates();
    measure_added(relation_without_area(), any, add_triangles_without_area);
    measure_added(relation_of_far_corner(), any, [this](Scene& scene) { add_far_corner(scene, behind()); });
    // The last bit of a normal chooses which way a random ray goes, and how fast normals turn, which makes
    // the highlights of wide rays wider, each triangle knows from its own corners alone.
    subject_.settings.occlusion_rays = 0;
    subject_.settings.ray_width = 0;
    if (any) wanted_ = draw_(subject_);
    measure_added(relation_of_needles(), any, divide_into_needles);
    measure_floors();
    measure_voxels();
  }

 private:
  std::string why_no_mesh() const {
    const bool bent = !subject_.scene.deformations.empty();
    return bent ? "every mesh bends" : "no instance is a mesh";
  }

  void tell(const Relation& relation, const std::vector<LinearPicture>& got,
            const std::vector<LinearPicture>& wanted) {
    const PictureDistance apart = share_beyond_one_step(got, wanted, subject_.profile);
    log_.measured(relation, apart.error, apart.where,
                  worst_pictures(apart, got, wanted, "with them | without | difference"));
  }

  template <typename Add>
  void measure_added(Relation relation, bool any, const Add& add) {
    relation.unit = "share of pixels beyond one 8-bit step";
    if (!any) {
      log_.not_applicable(std::move(relation), why_no_mesh());
      return;
    }
    const auto drawn = [&](RelationCase odd) { return add(odd.scene), draw_(odd); };
    measure_but_for_rounding({.relation = std::move(relation),
                              .caption = "with them | without | difference",
                              .twins =
                                  [&](const RelationCase& a) {
                                    return TwinPictures{drawn(a), draw_(a), {}};
                                  },
                              .likeness = {},
                              .draw = draw_},
                             subject_, {drawn(subject_), wanted_, {}}, log_);
  }

  void measure_duplicates() {
    Relation relation;
    relation.name = "duplicate triangles";
    relation.holds = "each triangle a second time, with the same corners and material, changes nothing";
    relation.bound = kFewPixels;
    relation.bound_from =
        "a ray that meets two triangles at the same distance may take either: of duplicates no "
        "matter which; of neighbours, along their common edge, which has no area";
    const bool any_rigid = !rigid_meshes(subject_.scene).empty();
    if (any_rigid && solid_meshes(subject_.scene).empty()) {
      log_.not_applicable(std::move(relation), "every mesh blends");
      return;
    }
    measure_added(std::move(relation), any_rigid, add_duplicates);
  }

  static Relation relation_without_area() {
    Relation relation;
    relation.name = "triangles without area";
    relation.holds =
        "points, lines, edges of 1e-30 m and lines that reach 1e6 times a mesh's size away change "
        "nothing in any mesh";
    relation.bound = kFewPixels;
    relation.bound_from =
        "no ray meets them; the order in which others are met may change along common edges";
    return relation;
  }

  static Relation relation_of_needles() {
    Relation relation;
    relation.name = "needles";
    relation.holds =
        "triangles divided at a vertex very near an edge or corner show the same surface to rays "
        "of no width";
    relation.bound = kFewPixels;
    relation.bound_from =
        "a needle's vertex is rounded to floats, which tilts it by 1/1024 at most, and needles are "
        "1/1000 of the area";
    return relation;
  }

  static Relation relation_of_far_corner() {
    Relation relation;
    relation.name = "a corner 1e8 m away";
    relation.holds =
        "a triangle behind the head with one corner 1e8 m away does not spoil the rest of its mesh";
    relation.bound = kFewPixels;
    relation.bound_from = "what is rounded for one triangle is not for others; its own shadow is a line";
    return relation;
  }

  FarTriangle behind() const {
    const Pose head = subject_.scene.world_from_session * subject_.sample.head.world_from_head;
    const Bounds bounds = scene_bounds(subject_.scene);
    const double size = glm::length(bounds.upper - bounds.lower);
    FarTriangle triangle;
    triangle.away = head.orientation * glm::dvec3(0, 0, 1);
    triangle.across = head.orientation * glm::dvec3(1, 0, 0);
    triangle.from = head.position + 0.5 * size * triangle.away;
    triangle.width_m = 1e-3 * size;
    return triangle;
  }

  void measure_floors();
  void measure_voxels();

  const DrawPicture& draw_;
  RelationCase subject_;
  RelationLog& log_;
  std::vector<LinearPicture> wanted_;
};

// A level floor, and the rays that meet it within `reach_m` of the eye or look well above the horizon.
struct FloorView {
  double height_m = 0, reach_m = 0;
};

// Copies pixels of `from` to `to` where a ray through the pixel's middle comes near the horizon of the floor.
void hide_horizon(const RelationCase& subject, const FloorView& floor, const std::vector<LinearPicture>& from,
                  std::vector<LinearPicture>& to) {
  const Pose head = subject.scene.world_from_session * subject.sample.head.world_from_head;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Viewport& v = subject.profile.viewports[i];
    const Pose eye = head * subject.sample.head_from_eye[static_cast<std::size_t>(v.eye)];
    const double above_m = std::abs(eye.position.y - floor.height_m);
    for (int y = 0; y < v.height_px; ++y) {
      for (int x = 0; x < v.width_px; ++x) {
        const glm::dvec3 direction =
            eye.orientation *
            glm::normalize(glm::dvec3(v.tan_left + (x + 0.5) / v.width_px * (v.tan_right - v.tan_left),
                                      v.tan_up - (y + 0.5) / v.height_px * (v.tan_up - v.tan_down), -1));
        if (std::abs(direction.y) * floor.reach_m > above_m) continue;
        const std::size_t at =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(v.width_px) + static_cast<std::size_t>(x);
        for (std::size_t c = 0; c < 3; ++c) to[i].plane[c][at] = from[i].plane[c][at];
      }
    }
  }
}

void TriangleRelations::measure_floors() {
  RelationCase by_pixel = subject_;
  by_pixel.settings.foveation = Foveation::off;
  by_pixel.settings.scale = 1;
  const Bounds bounds = scene_bounds(by_pixel.scene);
  const double radius_m = std::max(0.5 * glm::length(bounds.upper - bounds.lower), 1e-6);
  glm::dvec3 middle = 0.5 * (bounds.lower + bounds.upper);
  middle.y = bounds.lower.y + 0.02 * (bounds.upper.y - bounds.lower.y);
  const auto with_floor = [&](double radii) {
    RelationCase on_floor = by_pixel;
    add_floor(on_floor.scene, middle, radii * radius_m);
    return draw_(on_floor);
  };
  const std::vector<LinearPicture> wanted = with_floor(1e3);
  for (const auto& [radii, text] : {std::pair{1e6, "1e6"}, {1e8, "1e8"}}) {
    Relation relation;
    relation.name = std::string("a floor ") + text + " times as wide";
    relation.holds =
        "a floor of two huge triangles just above the scene's lowest point looks as one 1e3 times as wide "
        "as the scene where a ray meets both, and is lit the same";
    relation.bound = kFewPixels;
    relation.unit = "share of pixels beyond one 8-bit step";
    relation.bound_from =
        "on a level plane heights are exact, and what is rounded along it is a 2^-23 of the distance";
    std::vector<LinearPicture> got = with_floor(radii);
    hide_horizon(by_pixel, {middle.y, 100 * radius_m}, wanted, got);
    tell(relation, got, wanted);
  }
}

// Metres; of the first grid that is there.
double voxel_edge_m(const Scene& scene) {
  const auto grid = std::find_if(
      scene.instances.begin(), scene.instances.end(),
      [](const Instance& instance) { return instance.present && instance.kind == ShapeKind::voxels; });
  return glm::length(grid->world_from_object[0]);
}

void TriangleRelations::measure_voxels() {
  RelationCase by_pixel = subject_;
  by_pixel.settings.foveation = Foveation::off;
  by_pixel.settings.scale = 1;
  const std::string why = why_left_out(plan_of(by_pixel), "voxels");
  const std::vector<LinearPicture> wanted = why.empty() ? draw_(by_pixel) : std::vector<LinearPicture>{};
  for (const auto& [edge_m, text] : {std::pair{1e-4, "1e-4"}, {1e4, "1e4"}}) {
    Relation relation;
    relation.name = std::string("voxels of ") + text + " m";
    relation.holds =
        "with every length of the scene scaled until voxels have this edge the picture is the same";
    relation.bound = 1e-2;
    relation.unit = "share of pixels beyond one 8-bit step";
    relation.bound_from =
        "no power of two: every number rounds anew, and a few rays that pass edges change sides";
    Similarity similarity;
    if (why.empty()) similarity.scale = edge_m / voxel_edge_m(by_pixel.scene);
    const std::string why_not = why.empty() ? why_not_similar(by_pixel, similarity) : why;
    if (!why_not.empty()) {
      log_.not_applicable(std::move(relation), why_not);
      continue;
    }
    tell(relation, draw_(similar_case(by_pixel, similarity)), wanted);
  }
}

}  // namespace

void measure_triangles_by(const DrawPicture& draw, const RelationCase& subject, RelationLog& log) {
  TriangleRelations(draw, subject, log).measure();
}

void measure_triangles(const RelationCase& subject, RelationLog& log) {
  measure_triangles_by(picture_of, subject, log);
}

}  // namespace herr
