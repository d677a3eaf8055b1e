#include "tools/doctor/arguments.h"

namespace nanomap::doctor {

void declare(CLI::App& app, Arguments& arguments) {
  constexpr double kShortest_s = 1.0;
  constexpr double kLongest_s = 600.0;
  constexpr int kFirstId = 2;  // 1 is the autopilot's
  constexpr int kLastId = 255;
  app.add_option(
      "LOG", arguments.logs,
      "LCM log to look at instead of network, machine and autopilot; several are the parts of one recording,\n"
      "and a folder of recordings is its latest flight");
  app.add_option("--config", arguments.config,
                 "configuration file (TOML); without it, the one in the log, or defaults");
  app.add_option("--set", arguments.overrides, "section.key=value: wins over the file; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--listen", arguments.listen_s, "how long to listen to network and autopilot [s]")
      ->capture_default_str()
      ->check(CLI::Range(kShortest_s, kLongest_s));
  app.add_option("--component-id", arguments.component_id,
                 "its own in MAVLink, 194 is MAV_COMP_ID_ONBOARD_COMPUTER4; not that of the flight process")
      ->capture_default_str()
      ->check(CLI::Range(kFirstId, kLastId));
  app.add_option("--record", arguments.record, "folder that flights are to be recorded in: is there room?");
}

}  // namespace nanomap::doctor
