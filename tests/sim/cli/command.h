// Runs the usuzumi command as a person would: in a folder of its own, looking at what it prints and how it ends.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace usuzumi::testing {

struct Ran {
  int exit_code = -1;
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

class CommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / (std::string("usuzumi-") + info->test_suite_name() + "-" +
                                                        info->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// `arguments` as typed in a shell, in the test's folder. What `streams` sends elsewhere is empty in the result.
  Ran usuzumi(const std::string& arguments, const std::string& streams = ">stdout.txt 2>stderr.txt") const {
    const std::string command = "cd '" + folder_.string() + "' && timeout 120 '" USUZUMI_COMMAND "' " + arguments +
                                " " + streams + " </dev/null";
    const int status = std::system(command.c_str());
    Ran ran;
    ran.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    ran.out = text("stdout.txt");
    ran.err = text("stderr.txt");
    std::filesystem::remove(folder_ / "stdout.txt");
    std::filesystem::remove(folder_ / "stderr.txt");
    return ran;
  }

  std::string text(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    std::stringstream s;
    s << file.rdbuf();
    return s.str();
  }
  nlohmann::json json_file(const std::string& name) const { return nlohmann::json::parse(text(name)); }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }
  const std::filesystem::path& folder() const { return folder_; }

  /// A height field of 2 n^2 faces as a Wavefront file.
  void write_hills(const std::string& name, int n) const {
    std::ostringstream s;
    s << "o hills\n";
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) s << "v " << i << " " << (i * i + 2 * j * i) % 7 * 0.05 << " " << j << "\n";
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = j * (n + 1) + i + 1, b = a + 1, c = a + n + 1, d = c + 1;
        s << "f " << a << " " << c << " " << b << "\nf " << b << " " << c << " " << d << "\n";
      }
    write(name, s.str());
  }

 private:
  std::filesystem::path folder_;
};

/// Bad input gets one line: it names the program, ends without a period, and tells the exit code documented for it.
inline void expect_one_line_error(const Ran& ran, int exit_code, const std::string& about) {
  EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_TRUE(ran.err.starts_with("usuzumi: ")) << ran.err;
  EXPECT_NE(ran.err.find(about), std::string::npos) << ran.err;
  EXPECT_EQ(ran.out, "");
}

}  // namespace usuzumi::testing
