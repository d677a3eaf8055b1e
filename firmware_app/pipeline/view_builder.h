#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/view.h"
#include "core/view_pool.h"
#include "firmware_app/pipeline/message_intake.h"

namespace nanomap {

/// What became of a message that describes the camera.
enum class CameraVerdict : std::uint8_t {
  kFirst,        ///< frames become views from now on
  kUnchanged,    ///< said before
  kChanged,      ///< another model of the same camera: used from now on
  kOverridden,   ///< not used: the configuration says what the camera is
  kOtherCamera,  ///< not used: named otherwise than the first one
  kInvalid,      ///< not used: no such camera can be; lastCameraFault() says why
};
inline constexpr std::size_t kCameraVerdictCount = 6;

[[nodiscard]] std::string_view toString(CameraVerdict verdict);

/// Why a depth frame has no camera to be seen through.
enum class CameraFault : std::uint8_t {
  kNoCamera,     ///< no camera model yet
  kOtherCamera,  ///< the frame is of a camera with another name
};
inline constexpr std::size_t kCameraFaultCount = 2;

[[nodiscard]] std::string_view toString(CameraFault fault);

/// Stage T2: depth frames to indexed views, through the one camera that is known, from the configuration or from its
/// own messages. Threads: one.
class ViewBuilder {
 public:
  /// @param configured  empty: the camera's messages say what it is
  /// @param reserved_views  how many views to have storage for as soon as the camera is known
  /// @throws std::invalid_argument if the configured camera cannot be
  explicit ViewBuilder(const std::optional<CameraParameters>& configured, IndexKind index = IndexKind::kImage,
                       std::size_t reserved_views = 0);

  [[nodiscard]] CameraVerdict setCamera(const CameraInput& input);

  /// Allocates only if more views are in use than there is storage for.
  [[nodiscard]] std::variant<ViewPtr, ImageFault, CameraFault> build(const DepthInput& input);

  /// Null until it is known.
  [[nodiscard]] const std::shared_ptr<const CameraModel>& camera() const { return camera_; }

  /// What was wrong with the last kInvalid camera model; empty if there was none.
  [[nodiscard]] const std::string& lastCameraFault() const { return last_camera_fault_; }

 private:
  void use(const CameraParameters& camera);

  IndexKind index_;
  std::size_t reserved_views_;
  std::shared_ptr<const CameraModel> camera_;
  std::optional<ViewPool> pool_;  ///< of camera_
  bool configured_ = false;
  std::string name_;              ///< of the camera in use; empty if configured, or unnamed
  CameraParameters as_received_;  ///< what camera_ was made from
  std::string last_camera_fault_;
};

}  // namespace nanomap
