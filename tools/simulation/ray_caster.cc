#include "tools/simulation/ray_caster.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace nanomap::simulation {
namespace {

// Depths differ in their last bits between instruction sets, so the one that every x86-64 machine of today has is
// pinned. Four rays are its native packet. Elsewhere there is only one instruction set to choose from.
#if defined(__x86_64__)
constexpr const char* kDeviceConfiguration = "threads=1,isa=sse4.2";
#else
constexpr const char* kDeviceConfiguration = "threads=1";
#endif
constexpr std::size_t kPacket = 4;

template <auto kRelease>
struct Releaser {
  template <typename T>
  void operator()(T* handle) const {
    kRelease(handle);
  }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Releaser<rtcReleaseDevice>>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, Releaser<rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Releaser<rtcReleaseGeometry>>;

void checkNoError(RTCDevice device, const char* step) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw std::runtime_error(std::string("Embree: ") + step + " failed with error " + std::to_string(error));
}

template <typename Element>
void fillBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<Element>& elements) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), elements.size());
  if (buffer != nullptr) std::copy(elements.begin(), elements.end(), static_cast<Element*>(buffer));
}

}  // namespace

struct RayCaster::Embree {
  Device device;
  SceneHandle scene;
};

RayCaster::RayCaster(const TriangleMesh& mesh) {
  Device device(rtcNewDevice(kDeviceConfiguration));
  checkNoError(device.get(), "opening the device");
  SceneHandle scene(rtcNewScene(device.get()));
  const Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  fillBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices_W);
  fillBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  checkNoError(device.get(), "building the scene");
  embree_.reset(new Embree{std::move(device), std::move(scene)});
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

std::vector<float> RayCaster::render(const CameraModel& camera, const Pose& T_W_C) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr int kTraced = -1;
  constexpr int kSkipped = 0;
  const Eigen::Matrix3f R_W_C = T_W_C.rotation.toRotationMatrix().cast<float>();
  const Vec3f origin_W = T_W_C.translation_m.cast<float>();
  const std::size_t pixels = camera.pixelCount();
  std::vector<float> depth_m(pixels);

#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  const auto intersect = [&](const int* valid, RTCRayHit4* packet) {
    rtcIntersect4(valid, embree_->scene.get(), packet, &arguments);
  };
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const auto intersect = [&](const int* valid, RTCRayHit4* packet) {
    rtcIntersect4(valid, embree_->scene.get(), &context, packet);
  };
#endif
  for (std::size_t first = 0; first < pixels; first += kPacket) {
    const std::size_t rays = std::min(kPacket, pixels - first);
    alignas(16) std::array<int, kPacket> valid{};
    RTCRayHit4 packet{};
    for (std::size_t i = 0; i < kPacket; ++i) {
      valid[i] = i < rays ? kTraced : kSkipped;
      if (valid[i] == kSkipped) continue;
      // With the direction's component along the optical axis being 1, the ray's parameter is the depth.
      const Vec3f direction_W = R_W_C * camera.rayTangents(first + i).homogeneous();
      packet.ray.org_x[i] = origin_W.x();
      packet.ray.org_y[i] = origin_W.y();
      packet.ray.org_z[i] = origin_W.z();
      packet.ray.dir_x[i] = direction_W.x();
      packet.ray.dir_y[i] = direction_W.y();
      packet.ray.dir_z[i] = direction_W.z();
      packet.ray.tfar[i] = kInfinity;
      packet.ray.mask[i] = ~0U;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(valid.data(), &packet);
    for (std::size_t i = 0; i < rays; ++i) depth_m[first + i] = packet.ray.tfar[i];
  }
  return depth_m;
}

}  // namespace nanomap::simulation
