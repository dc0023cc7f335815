#include "hal/status.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace usuzumi {
namespace {

TEST(Status, IsOkUnlessACodeSaysOtherwise) {
  EXPECT_TRUE(Status{}.ok());
  EXPECT_TRUE(ok_status().ok());
  EXPECT_FALSE((Status{StatusCode::kDataLoss, "truncated", 12}.ok()));
}

TEST(Status, SpellsEveryCodeDifferently) {
  std::set<std::string> names;
  for (int code = 0; code <= static_cast<int>(StatusCode::kFailedPrecondition); ++code)
    names.insert(status_code_name(static_cast<StatusCode>(code)));
  EXPECT_EQ(names.size(), 8u);
  EXPECT_EQ(names.count("status code out of range"), 0u);
  EXPECT_STREQ(status_code_name(static_cast<StatusCode>(200)), "status code out of range");
}

TEST(Result, HoldsAValueOrTheReasonThereIsNone) {
  const Result<int> seven = 7;
  ASSERT_TRUE(seven.ok());
  EXPECT_EQ(*seven, 7);
  const Result<int> none = Status{StatusCode::kResourceExhausted, "list is full", 3};
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.status().where, 3u);
  EXPECT_EQ(none.value(), 0) << "the default value stands where there is none";
}

TEST(Result, ReachesMembersThroughTheArrow) {
  struct Pair {
    int a = 0, b = 0;
  };
  const Result<Pair> pair = Pair{1, 2};
  EXPECT_EQ(pair->b, 2);
}

}  // namespace
}  // namespace usuzumi
