#pragma once

#include <cstddef>

#include "core/camera_model.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/import/recording.h"

namespace nanomap {

struct ExportCounts {
  std::size_t poses = 0;
  std::size_t images = 0;
  std::size_t images_without_pose = 0;  ///< written, but outside the time that the poses span
};

/// Writes the camera, the poses as poses of the body (T_W_B = T_W_C * T_C_B), and the images, merged by log time: a
/// message's stamp and a fixed latency, so that the same folder gives the same bytes. Velocities are differences of
/// neighbouring poses; accelerations are left unknown.
/// @param camera    the model of every image; its size must be theirs
/// @param channels  where to
/// @throws std::runtime_error naming the image: unreadable, or of another size than the camera
/// @throws LogError if the log cannot be written
ExportCounts writeRecording(const Recording& recording, const CameraParameters& camera, const LcmParameters& channels,
                            LogWriter& log);

}  // namespace nanomap
