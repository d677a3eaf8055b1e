#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nanomap {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
[[nodiscard]] std::size_t editDistance(std::string_view a, std::string_view b);

/// The candidate that `word` was most likely meant to be, or an empty text if none is near: at most a third of its
/// letters are wrong.
[[nodiscard]] std::string nearestWord(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace nanomap
