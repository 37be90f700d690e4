// Embree's packet as wide as this instruction set's vectors; compiled once per instruction set.
#pragma once

#include "renderer/embree/embree_api.h"
#include "renderer/simd/simd_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace herr {
namespace HWY_NAMESPACE {

using Ray = RayPacket<kLanes>::Ray;
using RayHit = RayPacket<kLanes>::RayHit;

}  // namespace HWY_NAMESPACE
}  // namespace herr
HWY_AFTER_NAMESPACE();
