#include "tools/simulation/scene_catalogue.h"

#include <stdexcept>
#include <string>

#include "tools/simulation/forest.h"
#include "tools/simulation/urban.h"
#include "tools/simulation/wall.h"
#include "tools/simulation/warehouse.h"

namespace nanomap::simulation {

Scene makeScene(std::string_view name, std::uint64_t seed) {
  if (name == "forest") return makeForest(seed);
  if (name == "wall") return makeWall(seed);
  if (name == "warehouse") return makeWarehouse(seed);
  if (name == "urban") return makeUrban(seed);
  std::string message = "no scene is called '" + std::string(name) + "'; there are";
  for (const std::string_view known : kSceneNames) message.append(" ").append(known);
  throw std::invalid_argument(message);
}

}  // namespace nanomap::simulation
