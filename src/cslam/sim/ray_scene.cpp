// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/sim/ray_scene.h"

#include "cslam/util/check.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace cslam {
namespace {

constexpr std::size_t kPacket = 4;  // what SSE holds

// -1 marks a valid lane, 0 an idle one.
using Lanes = std::array<int, kPacket>;

struct alignas(16) AlignedLanes {
  Lanes valid{};
};

AlignedLanes FillLanes(std::size_t count) {
  AlignedLanes lanes;
  std::fill_n(lanes.valid.begin(), std::min(count, kPacket), -1);
  return lanes;
}

// The first rays of directions as a packet; idle lanes repeat the last one.
RTCRay4 MakePacket(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                   float t_far) {
  RTCRay4 packet{};
  for (std::size_t i = 0; i < kPacket; ++i) {
    const Eigen::Vector3f& d = directions[std::min(i, directions.size() - 1)];
    packet.org_x[i] = origin.x();
    packet.org_y[i] = origin.y();
    packet.org_z[i] = origin.z();
    packet.dir_x[i] = d.x();
    packet.dir_y[i] = d.y();
    packet.dir_z[i] = d.z();
    packet.tnear[i] = 0.0F;
    packet.tfar[i] = t_far;
    packet.mask[i] = 0xFFFFFFFFU;
  }
  return packet;
}

RTCIntersectContext MakeContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

struct DeviceDeleter {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneDeleter {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

void AttachObject(RTCDevice device, RTCScene scene, const PlacedObject& object, bool is_brief) {
  const Mesh& mesh = *object.mesh;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), object.positions_m.size()));
  auto* indices = static_cast<unsigned int*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned int), mesh.triangles.size()));
  CSLAM_CHECK(positions != nullptr && indices != nullptr, "Embree buffers of object {}",
              object.instance);
  for (const Eigen::Vector3d& p : object.positions_m) {
    const Eigen::Vector3f rounded = p.cast<float>();
    positions = std::copy_n(rounded.data(), 3, positions);
  }
  for (const Triangle& triangle : mesh.triangles)
    indices = std::copy_n(triangle.vertices.data(), 3, indices);
  if (is_brief) rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, static_cast<unsigned int>(object.instance));
  rtcReleaseGeometry(geometry);
}

}  // namespace

struct RayScene::Embree {
  std::unique_ptr<RTCDeviceTy, DeviceDeleter> device;
  std::unique_ptr<RTCSceneTy, SceneDeleter> scene;
};

RayScene::RayScene(const Scene& scene) : RayScene(PlaceAll(scene)) {}

RayScene::RayScene(std::span<const PlacedObject> objects, Use use)
    : embree_(std::make_unique<Embree>()) {
  embree_->device.reset(rtcNewDevice("isa=sse4.2,threads=1"));
  CSLAM_CHECK(embree_->device != nullptr, "Embree gives no device (error {})",
              static_cast<int>(rtcGetDeviceError(nullptr)));
  embree_->scene.reset(rtcNewScene(embree_->device.get()));
  rtcSetSceneFlags(embree_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  const bool is_brief = use == Use::kOneFrame;
  if (is_brief) rtcSetSceneBuildQuality(embree_->scene.get(), RTC_BUILD_QUALITY_LOW);
  for (const PlacedObject& object : objects) {
    if (object.mesh->triangles.empty()) continue;
    AttachObject(embree_->device.get(), embree_->scene.get(), object, is_brief);
  }
  rtcCommitScene(embree_->scene.get());
  const RTCError error = rtcGetDeviceError(embree_->device.get());
  CSLAM_CHECK(error == RTC_ERROR_NONE, "Embree error {}", static_cast<int>(error));
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::vector<RayHit> RayScene::Cast(const Eigen::Vector3f& origin,
                                   std::span<const Eigen::Vector3f> directions) const {
  std::vector<RayHit> hits(directions.size());
  RTCIntersectContext context = MakeContext();
  for (std::size_t i = 0; i < directions.size(); i += kPacket) {
    const std::size_t count = std::min(kPacket, directions.size() - i);
    const AlignedLanes lanes = FillLanes(count);
    RTCRayHit4 packet{};
    packet.ray =
        MakePacket(origin, directions.subspan(i, count), std::numeric_limits<float>::infinity());
    std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect4(lanes.valid.data(), embree_->scene.get(), &context, &packet);
    for (std::size_t k = 0; k < count; ++k)
      hits[i + k] = {packet.hit.geomID[k], packet.hit.primID[k]};
  }
  return hits;
}

std::vector<bool> RayScene::AreBlocked(const Eigen::Vector3f& origin,
                                       std::span<const Eigen::Vector3f> directions) const {
  std::vector<bool> blocked(directions.size());
  RTCIntersectContext context = MakeContext();
  for (std::size_t i = 0; i < directions.size(); i += kPacket) {
    const std::size_t count = std::min(kPacket, directions.size() - i);
    const AlignedLanes lanes = FillLanes(count);
    RTCRay4 packet = MakePacket(origin, directions.subspan(i, count), 1.0F);
    rtcOccluded4(lanes.valid.data(), embree_->scene.get(), &context, &packet);
    // Embree marks an occluded ray with a negative end.
    for (std::size_t k = 0; k < count; ++k)
      blocked[i + k] = packet.tfar[k] < 0.0F;
  }
  return blocked;
}

}  // namespace cslam
