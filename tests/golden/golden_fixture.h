// What the tests of goldens share.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/golden/golden_store.h"

namespace usuzumi::golden {

inline const std::filesystem::path kFailures = USUZUMI_GOLDEN_FAILURES;

inline const Store& source_store() {
  static const Store store(Store::source_folder());
  return store;
}

/// The golden's name as GoogleTest takes it.
template <class Subject>
std::string test_name(const ::testing::TestParamInfo<Subject>& info) {
  std::string name = info.param.name;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

}  // namespace usuzumi::golden
