// The camera feed in mirrors and glass. A ray that leaves the scene shows what the feed shows where it meets
// the feed's sphere about the eye; one that meets a catcher shows the feed there, times the catcher's ratio.
// Outside the camera's view they bring what they bring without a camera. Before: second_rays traced a batch.
// After: direct_light lights its hits, among them those catchers.
#pragma once

#include "renderer/direct_light/shadow_rays-inl.h"
#include "renderer/environment/environment-inl.h"
#include "renderer/feed/feed_texels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

// What a thing shows of the feed lies on the feed's sphere, but no nearer to the thing than the eye is: on
// the sphere itself a mirror would look transparent.
constexpr float kLeastReach = 2.0f;  // of the way from the eye to the thing

// Where rays leave that sphere, from the eye.
HWY_INLINE V3 where_feed_lies(const FeedInScene& feed, const V3& origin, const V3& direction) {
  const auto distance = static_cast<float>(feed.view.distance_m);
  const V3 from_eye = sub(origin, set3(feed.eye));
  const VF along = dot(from_eye, direction), place2 = dot(from_eye, from_eye);
  const VF reach2 = hn::Max(set(distance * distance), hn::Mul(set(kLeastReach * kLeastReach), place2));
  const VF way = hn::Sub(hn::Sqrt(hn::MulAdd(along, along, hn::Sub(reach2, place2))), along);
  return mul_add(way, direction, from_eye);
}

// The feed's radiance in directions from the eye; returns where the camera sees. Lenses are computed lane by
// lane, in double precision, as the composite does: few rays come here.
HWY_NOINLINE inline MF feed_radiance(const FeedInScene& feed, const V3& from_eye, MF lanes, V3& radiance) {
  alignas(64) float px[kMaxLanes], py[kMaxLanes], pz[kMaxLanes];
  alignas(64) std::int32_t asked[kMaxLanes], offset[kMaxLanes];
  hn::Store(from_eye.x, kF, px), hn::Store(from_eye.y, kF, py), hn::Store(from_eye.z, kF, pz);
  hn::Store(hn::VecFromMask(kI, hn::RebindMask(kI, lanes)), kI, asked);
  alignas(64) float x[kMaxLanes], y[kMaxLanes], sees[kMaxLanes];
  for (std::size_t i = 0; i < static_cast<std::size_t>(kLanes); ++i) {
    x[i] = y[i] = sees[i] = 0;
    if (asked[i] == 0) continue;
    const auto pixel = camera_pixel(feed, glm::dvec3(px[i], py[i], pz[i]));
    if (!pixel) continue;
    x[i] = static_cast<float>(pixel->x);
    y[i] = static_cast<float>(pixel->y);
    sees[i] = 1;
  }
  const CameraImage& image = *feed.view.image;
  const FeedPlace at = place_in_feed(image, load(x), load(y));
  const MF seen = hn::And(at.in_image, hn::Gt(load(sees), hn::Zero(kF)));
  if (hn::AllFalse(kF, seen)) return seen;
  hn::Store(at.x, kF, x), hn::Store(at.y, kF, y), hn::Store(at.offset, kI, offset);
  alignas(64) float r[kMaxLanes], g[kMaxLanes], b[kMaxLanes];
  for (std::size_t i = 0; i < static_cast<std::size_t>(kLanes); ++i) {
    alignas(16) float texel[4];
    hn::Store(bilinear(image.rgba_half.data() + 4 * static_cast<std::size_t>(offset[i]),
                       static_cast<std::size_t>(image.width_px), x[i], y[i]),
              kF4, texel);
    r[i] = texel[0], g[i] = texel[1], b[i] = texel[2];
  }
  radiance = scale(V3{load(r), load(g), load(b)}, set(feed.view.white));
  return seen;
}

// What rays of `lanes` bring that leave the scene; `otherwise` outside the camera's view, or without one.
HWY_INLINE V3 feed_or(const TileJob& job, const V3& origin, const V3& direction, MF lanes,
                      const V3& otherwise) {
  const FeedInScene* feed = job.grid->feed;
  if (feed == nullptr) return otherwise;
  V3 radiance = otherwise;
  const MF seen = feed_radiance(*feed, where_feed_lies(*feed, origin, direction), lanes, radiance);
  return select(hn::And(lanes, seen), radiance, otherwise);
}

// Looks up the feed for second rays [0, rays), just traced from the queue: where they left the scene, and on
// catchers, which are lit as such from here on. A catcher keeps its stated colour where the camera does not
// see, and on sides that the eye does not see. What catchers mirror asks for virtual objects alone.
HWY_NOINLINE inline void show_feed(const TileJob& job, int rays) {
  const FeedInScene& feed = *job.grid->feed;
  const ShadingInputs& shading = *job.shading;
  TileScratch& scratch = *job.scratch;
  SecondRays& second = *scratch.second;
  HitBatch& hits = second.hits;
  for (int slot = 0; slot < rays; slot += kLanes) {
    const MF used = first_lanes(rays - slot);
    const VI sender = hn::IfThenElseZero(hn::RebindMask(kI, used), hn::LoadU(kI, &second.sender[slot]));
    const MF by_catcher =
        hn::RebindMask(kF, hn::Eq(hn::GatherIndex(kI, scratch.first.kind.data(), sender),
                                  hn::Set(kI, static_cast<std::int32_t>(HitKind::catcher))));
    const MF asks = hn::AndNot(by_catcher, used);
    const MF leaves = hn::And(asks, of_kind(hits, slot, HitKind::miss));
    MF catcher = hn::And(hn::And(asks, of_kind(hits, slot, HitKind::object)),
                         hn::Gt(load(&hits.is_catcher[slot]), hn::Zero(kF)));
    const V3 on_surface = sub(load3(hits.position, slot), set3(feed.eye));
    catcher = hn::And(catcher, hn::Lt(dot(on_surface, load3(hits.geometric_normal, slot)), hn::Zero(kF)));
    const MF lanes = hn::Or(leaves, catcher);
    if (hn::AllFalse(kF, lanes)) continue;
    const V3 direction = scale(load3(hits.viewer, slot), set(-1.0f));
    V3 light{hn::Zero(kF), hn::Zero(kF), hn::Zero(kF)};
    const V3 outside = where_feed_lies(feed, load3(scratch.queue.origin, slot), direction);
    const MF seen = hn::And(lanes, feed_radiance(feed, select(leaves, outside, on_surface), lanes, light));
    const MF unseen = hn::AndNot(seen, leaves);
    if (!hn::AllFalse(kF, unseen)) light = select(unseen, environment_radiance(shading, direction), light);
    store3(light, second.feed->radiance, slot);
    const VI kind = hn::Load(kI, &hits.kind[slot]),
             shown = hn::Set(kI, static_cast<std::int32_t>(HitKind::catcher));
    hn::Store(hn::IfThenElse(hn::RebindMask(kI, hn::And(catcher, seen)), shown, kind), kI, &hits.kind[slot]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
