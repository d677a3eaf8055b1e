#include "tests/integration/doctor/recorded_flight.h"

#include <unistd.h>

#include <variant>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "drivers/recording/log_reader.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/generate/flight_log.h"
#include "tools/generate/paper_camera.h"

namespace nanomap::test {
namespace {

std::vector<RecordedMessage> record() {
  generate::FlightLogOptions options;
  options.scene = "forest";
  options.camera = generate::paperCamera(160, 120);
  options.duration = std::chrono::seconds(8);
  options.vio.drift = {.horizontal_std_m = 0.3, .vertical_std_m = 0.3, .after = std::chrono::seconds(5)};
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("nanomap_doctor_flight_" + std::to_string(getpid()));
  LogWriter log(path);
  generate::FlightLog(options).write(LcmParameters(), log);
  log.close();

  std::vector<RecordedMessage> messages;
  LogReader reader(path);
  for (const LogEvent& event : reader.mergedByTime()) {
    if (reader.channelOf(event) == generate::SensedFlight::kTruthChannel) continue;  // no vehicle knows it
    RecordedMessage& message = messages.emplace_back();
    message.channel = reader.channelOf(event);
    message.arrival = event.log_stamp;
    reader.read(event, message.bytes);
  }
  std::filesystem::remove(path);
  return messages;
}

template <class Message>
Message decoded(const RecordedMessage& message) {
  return std::get<Message>(decode<Message>(message.bytes));
}

}  // namespace

const std::vector<RecordedMessage>& healthyFlight() {
  static const std::vector<RecordedMessage> flight = record();
  return flight;
}

std::filesystem::path writeFlight(const std::filesystem::path& path, const Mistake& mistake) {
  const LcmParameters lcm;
  LogWriter log(path);
  for (const RecordedMessage& message : healthyFlight()) {
    if (message.channel == lcm.camera_channel) {
      auto camera = decoded<camera_model_t>(message);
      mistake.camera(camera);
      log.write(message.channel, message.arrival, camera);
    } else if (message.channel == lcm.depth_channel) {
      auto depth = decoded<depth_image_t>(message);
      mistake.depth(depth);
      log.write(message.channel, message.arrival, depth);
    } else if (message.channel == lcm.pose_channel && mistake.pose_t) {
      const auto pose = std::get<BodyPose>(toBodyPose(decoded<body_pose_t>(message)));
      log.write(message.channel, message.arrival, toPoseMessage(pose, *mistake.pose_t));
    } else {
      log.writeEncoded(message.channel, message.arrival, message.bytes);
    }
  }
  log.close();
  return path;
}

}  // namespace nanomap::test
