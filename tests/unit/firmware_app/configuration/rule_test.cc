#include "firmware_app/configuration/rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nanomap {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Rule, IntegerHasBothEnds) {
  const Rule rule = IntegerRule{1, 16};
  EXPECT_TRUE(accept(rule, std::int64_t{1}));
  EXPECT_TRUE(accept(rule, std::int64_t{16}));
  EXPECT_FALSE(accept(rule, std::int64_t{0}));
  EXPECT_FALSE(accept(rule, std::int64_t{17}));
  EXPECT_FALSE(accept(rule, 3.0));
  EXPECT_EQ(describe(rule), "an integer, 1 .. 16");
}

TEST(Rule, NumberRefusesNanAndInfinity) {
  const Rule rule = NumberRule{-kInfinity, kInfinity};
  EXPECT_FALSE(accept(rule, std::nan("")));
  EXPECT_FALSE(accept(rule, kInfinity));
  EXPECT_FALSE(accept(rule, -kInfinity));
  EXPECT_FALSE(accept(NumbersRule{1, {-kInfinity, kInfinity}}, std::vector<double>{std::nan("")}));
}

TEST(Rule, NumberMayExcludeItsLowerEnd) {
  EXPECT_TRUE(accept(NumberRule{0.0, 1.0}, 0.0));
  EXPECT_FALSE(accept(NumberRule{0.0, 1.0, true}, 0.0));
  EXPECT_TRUE(accept(NumberRule{0.0, 1.0, true}, std::numeric_limits<double>::denorm_min()));
  EXPECT_EQ(describe(NumberRule{0.0, 1.5, true}), "a number, above 0, up to 1.5");
}

TEST(Rule, NumberTakesAnIntegerForANumber) {
  EXPECT_EQ(accept(NumberRule{0.0, 10.0}, std::int64_t{7}), Value(7.0));
  EXPECT_EQ(accept(NumbersRule{2, {0.0, 10.0}}, std::vector<std::int64_t>{1, 2}), Value(std::vector<double>{1.0, 2.0}));
}

TEST(Rule, ListsHaveTheirCount) {
  EXPECT_FALSE(accept(NumbersRule{3, {0.0, 1.0}}, std::vector<double>{0.5, 0.5}));
  EXPECT_TRUE(accept(IntegersRule{2, {0, 9}}, std::vector<std::int64_t>{}));
  EXPECT_FALSE(accept(IntegersRule{2, {0, 9}}, std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_FALSE(accept(IntegersRule{2, {0, 9}}, std::vector<std::int64_t>{10}));
}

TEST(Rule, TextIsNeitherEmptyNorTooLong) {
  EXPECT_FALSE(accept(TextRule{3}, std::string()));
  EXPECT_TRUE(accept(TextRule{3}, std::string("abc")));
  EXPECT_FALSE(accept(TextRule{3}, std::string("abcd")));
}

TEST(Rule, ChoiceIsOneOfItsWords) {
  const Rule rule = ChoiceRule{{"flu", "frd"}};
  EXPECT_TRUE(accept(rule, std::string("frd")));
  EXPECT_FALSE(accept(rule, std::string("ned")));
  EXPECT_EQ(describe(rule), "\"flu\" or \"frd\"");
}

TEST(Rule, BooleanTakesNoNumber) {
  EXPECT_TRUE(accept(BooleanRule{}, false));
  EXPECT_FALSE(accept(BooleanRule{}, std::int64_t{0}));
}

TEST(ToToml, KeepsEveryBitAndTheType) {
  EXPECT_EQ(toToml(5.0), "5.0");
  EXPECT_EQ(toToml(-0.0), "0.0");
  EXPECT_EQ(toToml(0.1), "0.1");
  EXPECT_EQ(toToml(1e-300), "1e-300");
  EXPECT_EQ(toToml(std::vector<double>{1.0, 0.25}), "[1.0, 0.25]");
  EXPECT_EQ(toToml(std::vector<std::int64_t>{}), "[]");
  EXPECT_EQ(toToml(std::string("a\"b\\c\n")), "\"a\\\"b\\\\c\\u000A\"");
}

}  // namespace
}  // namespace nanomap
