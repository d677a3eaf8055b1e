#include "tools/import/text_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace nanomap {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

TEST(ParseStamp, KeepsEveryNanosecond) {
  EXPECT_EQ(toNanoseconds(parseStamp("1305031102.160407")), 1'305'031'102'160'407'000);
  EXPECT_EQ(toNanoseconds(parseStamp("1305031102.123456789")), 1'305'031'102'123'456'789);
}

TEST(ParseStamp, CrossesSecondBoundaryInOrder) {
  EXPECT_EQ(toNanoseconds(parseStamp("1.999999999")), 1'999'999'999);
  EXPECT_EQ(toNanoseconds(parseStamp("2.0")), 2'000'000'000);
  EXPECT_EQ(toNanoseconds(parseStamp("2.000000001")), 2'000'000'001);
}

TEST(ParseStamp, ReadsWholeSecondsAndCutsBelowNanoseconds) {
  EXPECT_EQ(toNanoseconds(parseStamp("0")), 0);
  EXPECT_EQ(toNanoseconds(parseStamp("7")), 7'000'000'000);
  EXPECT_EQ(toNanoseconds(parseStamp("7.")), 7'000'000'000);
  EXPECT_EQ(toNanoseconds(parseStamp("1.0000000019")), 1'000'000'001);
}

TEST(ParseStamp, RefusesWhatIsNotPlainDecimal) {
  for (const char* text : {"", ".", ".5", "-1.0", "+1", "1e9", "1.5e3", "abc", "1.2.3", "0x10", "nan", "1,5",
                           "4611686019", "99999999999999999999"}) {
    EXPECT_THAT([text] { (void)parseStamp(text); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("'" + std::string(text) + "'")));
  }
}

TEST(ParseNumber, ReadsNumbersAsWritten) {
  EXPECT_EQ(parseNumber("-1.5e-3"), -0.0015);
  EXPECT_EQ(parseNumber("9.055373100000000397e-01"), 0.90553731);
}

TEST(ParseNumber, RefusesRestsAndNonFinite) {
  for (const char* text : {"", "1.0x", "one", "nan", "inf", "-inf", "1e999", "-1.#IND"}) {
    EXPECT_THROW((void)parseNumber(text), std::invalid_argument) << text;
  }
}

TEST(SplitFields, PartsAtAnyBlanks) {
  EXPECT_THAT(splitFields(" a\tbb  c \r"), ElementsAre("a", "bb", "c"));
  EXPECT_THAT(splitFields("one"), ElementsAre("one"));
  EXPECT_THAT(splitFields(" \t\r"), IsEmpty());
  EXPECT_THAT(splitFields(""), IsEmpty());
}

TEST(ForEachRecord, SkipsCommentsAndBlankLines) {
  const TemporaryFolder folder;
  const auto file = folder.write("list.txt", "# stamp file\n\n  # indented\na b\r\nc d");
  std::vector<std::string> first_fields;
  forEachRecord(file, [&](std::span<const std::string_view> fields) { first_fields.emplace_back(fields[0]); });
  EXPECT_THAT(first_fields, ElementsAre("a", "c"));
}

TEST(ForEachRecord, NamesFileAndLineOfFault) {
  const TemporaryFolder folder;
  const auto file = folder.write("list.txt", "# comment\n1.0\nwrong\n");
  EXPECT_THAT([&] { forEachRecord(file, [](auto fields) { (void)parseNumber(fields[0]); }); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("list.txt:3"), HasSubstr("'wrong'"))));
}

TEST(ForEachRecord, NamesMissingFile) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { forEachRecord(folder.path() / "absent.txt", [](auto) {}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("absent.txt: cannot be read")));
}

}  // namespace
}  // namespace nanomap
