#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace nanomap {

/// A path for a file of the running test, gone afterwards.
class TemporaryFile {
 public:
  TemporaryFile() : path_(std::filesystem::path(::testing::TempDir()) / uniqueName()) {}
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  void write(std::string_view bytes) const {
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  [[nodiscard]] std::string read() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

 private:
  /// Tests run side by side, each in a process of its own.
  static std::string uniqueName() {
    static int count = 0;
    const auto& test = *::testing::UnitTest::GetInstance()->current_test_info();
    return std::string("nanomap_") + test.test_suite_name() + "_" + test.name() + "_" + std::to_string(count++);
  }

  std::filesystem::path path_;
};

}  // namespace nanomap
