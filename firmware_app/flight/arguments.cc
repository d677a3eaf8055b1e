#include "firmware_app/flight/arguments.h"

namespace nanomap {

void declare(CLI::App& app, FlightArguments& arguments) {
  app.add_option("--config", arguments.config, "configuration file (TOML); without it, defaults");
  app.add_option("--set", arguments.overrides, "section.key=value: wins over the file; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--log", arguments.log,
                 "play this LCM log instead of listening to the network: for the bench; only a simulated\n"
                 "autopilot is told anything then");
  app.add_option("--record", arguments.record, "directory to record the flight in");
  app.add_flag("--allow-no-realtime", arguments.allow_no_realtime,
               "run as far as the machine grants real time: for the bench, never in flight");
  app.add_flag("--check", arguments.check, "check configuration and machine, say what is missing, and end");
}

}  // namespace nanomap
